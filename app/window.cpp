#include "window.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "core/error.hpp"

namespace dioptre {

namespace {

std::string glfwReason() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text ? text : "no reason given";
}

}  // namespace

Window::Library::Library() {
    if (!glfwInit()) throw RunError("window: " + glfwReason());
}

Window::Library::~Library() {
    glfwTerminate();
}

void Window::Close::operator()(GLFWwindow* window) const {
    glfwDestroyWindow(window);
}

Window::Window(int width, int height, const std::string& title) {
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    window_.reset(glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr));
    if (!window_) throw RunError("window: " + glfwReason());
    glfwMakeContextCurrent(window_.get());
    glfwSwapInterval(1);
    loadGl(glfwGetProcAddress);
}

double Window::refreshMilliseconds() const {
    GLFWmonitor* monitor = glfwGetPrimaryMonitor();
    const GLFWvidmode* mode = monitor ? glfwGetVideoMode(monitor) : nullptr;
    constexpr int kUsual = 60;  // Hz
    return 1000.0 / (mode && mode->refreshRate > 0 ? mode->refreshRate : kUsual);
}

DesktopBox Window::box() const {
    DesktopBox box;
    glfwGetWindowPos(window_.get(), &box.x, &box.y);
    glfwGetWindowSize(window_.get(), &box.width, &box.height);
    return box;
}

std::vector<Monitor> Window::monitors() const {
    int count = 0;
    GLFWmonitor** handles = glfwGetMonitors(&count);
    std::vector<Monitor> monitors;
    for (int i = 0; i < count; ++i) {
        const GLFWvidmode* mode = glfwGetVideoMode(handles[i]);
        const char* name = glfwGetMonitorName(handles[i]);
        Monitor& monitor = monitors.emplace_back(Monitor{name ? name : "", {}});
        glfwGetMonitorPos(handles[i], &monitor.box.x, &monitor.box.y);
        if (!mode) continue;
        monitor.box.width = mode->width;
        monitor.box.height = mode->height;
    }
    return monitors;
}

bool Window::isFullScreen() const {
    return glfwGetWindowMonitor(window_.get()) != nullptr;
}

bool Window::fillMonitor(const std::string& nameOrNumber) {
    const std::vector<Monitor> connected = monitors();
    const auto meant = findMonitor(nameOrNumber, connected);
    if (!isFullScreen()) before_ = box();
    const std::size_t chosen = meant.value_or(monitorOf(box(), connected));
    int count = 0;
    GLFWmonitor** handles = glfwGetMonitors(&count);
    if (chosen < static_cast<std::size_t>(count)) {
        const DesktopBox& all = connected[chosen].box;
        glfwSetWindowMonitor(window_.get(), handles[chosen], 0, 0, all.width, all.height, GLFW_DONT_CARE);
    }
    return meant || nameOrNumber.empty();
}

void Window::leaveFullScreen() {
    glfwSetWindowMonitor(window_.get(), nullptr, before_.x, before_.y, before_.width, before_.height, GLFW_DONT_CARE);
}

}  // namespace dioptre
