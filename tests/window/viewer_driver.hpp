// Runs the viewer in this process, turn by turn, and gives it input as a user does: through the X server.
#pragma once

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>

#include <chrono>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

#include "gl/api.hpp"
#include "viewer/viewer.hpp"

// After all others: Xlib defines None, Bool, Status, ...
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <X11/Xlib.h>
#include <X11/Xutil.h>
#undef None
#undef Bool
#undef Status
#undef Success

// GLFW/glfw3native.h, which wants the headers of X extensions that nothing else here needs
extern "C" Display* glfwGetX11Display(void);
extern "C" Window glfwGetX11Window(GLFWwindow* window);

namespace dioptre::test {

/// The settings that a program without options has, of a scene in a small window.
inline Command viewCommand(const std::string& scene) {
    Command command;
    command.which = Command::Which::view;
    command.scene = scene;
    command.settings.view.size = {160, 120};
    command.settings.render.technique = TechniqueChoice::mipmap;
    command.settings.focus.dynamics = DynamicsChoice::instant;
    return command;
}

class ViewerDriver {
  public:
    /// Opens the window; the pointer is in the middle of the left eye's picture.
    explicit ViewerDriver(const Command& command) : viewer(command) {
        glDebugMessageCallback(complain, this);
        window_ = glfwGetX11Window(glfwGetCurrentContext());
        until([&] { return viewer.drawn().pictures > 0; }, "a picture");
        xdotool("windowfocus $W mousemove --window $W 80 60");
        settle();
    }

    /// Turns until nothing was drawn for a while: the view is still, and finished.
    void settle() {
        int idle = 0;
        until(
            [&] {
                const int before = viewer.drawn().frames;
                turn();
                idle = viewer.drawn().frames == before ? idle + 1 : 0;
                return idle >= 2;
            },
            "a still view");
    }

    /// Turns, so many frames; fewer where there is nothing to draw.
    void draw(int frames) {
        const int last = viewer.drawn().frames + frames;
        for (int i = 0; i < 3 * frames && viewer.drawn().frames < last; ++i) turn();
    }

    /// One turn. Throws where the GL complained, or the window was closed.
    void turn() {
        if (!viewer.step()) throw std::runtime_error("the window was closed");
        if (!complaint_.empty()) throw std::runtime_error("the GL complained: " + complaint_);
        if (const GLenum error = glGetError(); error != GL_NO_ERROR)
            throw std::runtime_error(fmt::format("GL error {:#x}", error));
    }

    template <class Condition>
    void until(Condition met, const std::string& what) {
        // Of nobody's time but a hung program's
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(200);
        while (!met()) {
            turn();
            if (std::chrono::steady_clock::now() > end) throw std::runtime_error("waited in vain for " + what);
        }
    }

    /// Commands of xdotool; $W is the window. The server has all of it when this returns.
    void xdotool(const std::string& commands) {
        const std::string line = fmt::format("W={}; xdotool {}", window_, commands);
        if (std::system(line.c_str()) != 0) throw std::runtime_error(line);
    }

    /// A file is dropped onto the window, which must turn to take it.
    void drop(const std::string& file) {
        const std::string window = std::to_string(window_);
        const char* const argv[] = {DIOPTRE_DROP, window.c_str(), file.c_str(), nullptr};
        pid_t child = 0;
        if (::posix_spawn(&child, argv[0], nullptr, nullptr, const_cast<char* const*>(argv), environ) != 0)
            throw std::runtime_error("cannot run " DIOPTRE_DROP);
        int status = 0;
        until([&] { return ::waitpid(child, &status, WNOHANG) == child; }, "a drop");
        if (status != 0) throw std::runtime_error("nobody took " + file);
    }

    /// What the window shows: 0xRRGGBB, row by row from the top.
    std::vector<unsigned long> shown() const {
        Display* display = glfwGetX11Display();
        XWindowAttributes attributes{};
        XGetWindowAttributes(display, window_, &attributes);
        XImage* image = XGetImage(display, window_, 0, 0, static_cast<unsigned>(attributes.width),
                                  static_cast<unsigned>(attributes.height), AllPlanes, ZPixmap);
        if (!image) throw std::runtime_error("the window cannot be looked at");
        std::vector<unsigned long> pixels;
        for (int y = 0; y < attributes.height; ++y)
            for (int x = 0; x < attributes.width; ++x) pixels.push_back(XGetPixel(image, x, y) & 0xFFFFFF);
        XDestroyImage(image);
        return pixels;
    }

    Viewer viewer;

  private:
    static void GLAPIENTRY complain(GLenum, GLenum type, GLuint, GLenum, GLsizei, const GLchar* text,
                                    const void* driver) {
        if (type == GL_DEBUG_TYPE_ERROR || type == GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR)
            static_cast<ViewerDriver*>(const_cast<void*>(driver))->complaint_ = text;
    }

    ::Window window_ = 0;
    std::string complaint_;
};

}  // namespace dioptre::test
