// A GLFW window and its GL context.
#pragma once

#include <memory>
#include <string>

#include "gl/context.hpp"

struct GLFWwindow;

namespace dioptre {

class Window final : public Context {
  public:
    /// Opens a window and makes its 4.5 core context current. RunError where there is no display or no such GL.
    Window(int width, int height, const std::string& title);

    GLFWwindow* handle() const { return window_.get(); }

  private:
    struct Library {
        Library();
        ~Library();
        Library(const Library&) = delete;
        Library& operator=(const Library&) = delete;
    };
    struct Close {
        void operator()(GLFWwindow* window) const;
    };
    Library library_;
    std::unique_ptr<GLFWwindow, Close> window_;
};

}  // namespace dioptre
