// Dear ImGui in a window: text, keys and mouse to it, its drawing over the picture.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <vector>

struct GLFWwindow;

namespace dioptre {

class Gui {
  public:
    /// Takes over none of the window's callbacks: whoever does calls key() and, for the others, those of ImGui's GLFW
    /// backend.
    explicit Gui(GLFWwindow* window);
    ~Gui();
    Gui(const Gui&) = delete;
    Gui& operator=(const Gui&) = delete;

    void key(int key, int scancode, int action, int mods) { keys_.push_back({key, scancode, action, mods}); }
    /// Whether keys were told of that wait for another frame.
    bool keysWait() const { return !keys_.empty(); }

    /// A button of the mouse went down or up, with the pointer there: a press is of what was there then, however far the
    /// pointer came within a slow frame.
    void mouse(int button, int action, int mods, glm::dvec2 pointer);

    /// A frame of the interface, its text `scale` times as large as usual. Between the two, ImGui's own functions.
    void begin(double scale);
    void end();

    /// Letters that are typed go into a text, or a menu is open, which Escape closes.
    bool takesKeys() const;

  private:
    struct KeyEvent {
        int key, scancode, action, mods;
    };
    void feedKeys();
    void setScale(double scale);

    GLFWwindow* window_;
    double scale_ = 0.0;
    std::vector<KeyEvent> keys_;
    std::optional<glm::dvec2> pressedAt_;
};

}  // namespace dioptre
