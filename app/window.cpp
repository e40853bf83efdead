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

Window::Window(int width, int height, const std::string& title) {
    if (!glfwInit()) throw RunError("window: " + glfwReason());
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    window_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
    if (!window_) {
        const std::string reason = glfwReason();
        glfwTerminate();
        throw RunError("window: " + reason);
    }
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(1);
    loadGl(glfwGetProcAddress);
}

Window::~Window() {
    glfwDestroyWindow(window_);
    glfwTerminate();
}

}  // namespace dioptre
