#include "window.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <vector>

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

void Window::toggleFullScreen() {
    GLFWwindow* window = window_.get();
    if (glfwGetWindowMonitor(window)) {
        glfwSetWindowMonitor(window, nullptr, before_.x, before_.y, before_.width, before_.height, GLFW_DONT_CARE);
        return;
    }
    glfwGetWindowPos(window, &before_.x, &before_.y);
    glfwGetWindowSize(window, &before_.width, &before_.height);
    int count = 0;
    GLFWmonitor** monitors = glfwGetMonitors(&count);
    std::vector<DesktopBox> boxes;
    for (int i = 0; i < count; ++i) {
        const GLFWvidmode* mode = glfwGetVideoMode(monitors[i]);
        DesktopBox& box = boxes.emplace_back();
        glfwGetMonitorPos(monitors[i], &box.x, &box.y);
        if (mode) box = {box.x, box.y, mode->width, mode->height};
    }
    if (boxes.empty()) return;
    const std::size_t best = monitorOf(before_, boxes);
    glfwSetWindowMonitor(window, monitors[best], 0, 0, boxes[best].width, boxes[best].height, GLFW_DONT_CARE);
}

}  // namespace dioptre
