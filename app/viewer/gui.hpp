// Dear ImGui in a window: text, keys and mouse to it, its drawing over the picture.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

struct GLFWwindow;

namespace dioptre {

class Gui {
  public:
    /// Takes over none of the window's callbacks: whoever does calls key(), button() and, for the others, those of
    /// ImGui's GLFW backend.
    explicit Gui(GLFWwindow* window);
    ~Gui();
    Gui(const Gui&) = delete;
    Gui& operator=(const Gui&) = delete;

    void key(int key, int scancode, int action, int mods) { keys_.push_back({key, scancode, action, mods}); }
    /// A button of the mouse went down or up with the pointer there, in the window's coordinates.
    void button(int button, bool down, glm::dvec2 pointer) { buttons_.push_back({button, down, pointer}); }
    /// Whether some of what was told waits for another frame.
    bool inputWaits() const { return !keys_.empty() || !buttons_.empty(); }

    /// A frame of the interface, its text `scale` times as large as usual. Between the two, ImGui's own functions.
    void begin(double scale);
    void end();

    /// Letters that are typed go into a text, or a menu is open, which Escape closes.
    bool takesKeys() const;

  private:
    struct KeyEvent {
        int key, scancode, action, mods;
    };
    struct ButtonEvent {
        int button;
        bool down;
        glm::dvec2 pointer;
    };
    void feedKeys();
    void feedMouse();
    void setScale(double scale);

    GLFWwindow* window_;
    double scale_ = 0.0;
    std::vector<KeyEvent> keys_;
    std::vector<ButtonEvent> buttons_;
    bool held_[5] = {};        // the buttons that ImGui knows
    glm::dvec2 pointer_{0.0};  // of the last frame
};

}  // namespace dioptre
