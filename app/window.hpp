// A GLFW window and its GL context.
#pragma once

#include <string>

#include "gl/context.hpp"

struct GLFWwindow;

namespace dioptre {

class Window final : public Context {
  public:
    /// Opens a window and makes its 4.5 core context current. RunError where there is no display or no such GL.
    Window(int width, int height, const std::string& title);
    ~Window() override;

    GLFWwindow* handle() const { return window_; }

  private:
    GLFWwindow* window_ = nullptr;
};

}  // namespace dioptre
