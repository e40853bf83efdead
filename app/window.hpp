// A GLFW window and its GL context.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gl/context.hpp"
#include "viewer/monitor.hpp"

struct GLFWwindow;

namespace dioptre {

class Window final : public Context {
  public:
    /// Opens a window and makes its 4.5 core context current. RunError where there is no display or no such GL.
    Window(int width, int height, const std::string& title);

    GLFWwindow* handle() const { return window_.get(); }

    /// Of the first screen; 60 Hz where it does not say.
    double refreshMilliseconds() const;
    /// Those that are connected.
    std::vector<Monitor> monitors() const;
    bool isFullScreen() const;
    /// To all of a monitor (findMonitor); where that is not there, or none is named, of the one that shows most of the
    /// window. False: it is not there.
    bool fillMonitor(const std::string& nameOrNumber);
    /// Back to where it was.
    void leaveFullScreen();

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
    DesktopBox box() const;

    DesktopBox before_;  // full screen
};

}  // namespace dioptre
