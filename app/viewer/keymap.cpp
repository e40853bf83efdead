#include "viewer/keymap.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace dioptre {

namespace {

constexpr KeyBinding kMap[] = {
    {Action::help, GLFW_KEY_F1, false, "F1", "this list"},
    {Action::panel, GLFW_KEY_F2, false, "F2", "settings"},
    {Action::search, GLFW_KEY_F, true, "Ctrl F", "search the settings"},
    {Action::undo, GLFW_KEY_Z, true, "Ctrl Z", "take back the last edit of a setting"},
    {Action::redo, GLFW_KEY_Y, true, "Ctrl Y", "make it again"},
    {Action::none, 0, false, "pointer", "the gaze: focus follows it"},
    {Action::none, 0, false, "left drag", "turn around what is in focus"},
    {Action::none, 0, false, "right drag", "look around"},
    {Action::none, 0, false, "middle or Shift left drag", "move sideways"},
    {Action::none, 0, false, "wheel", "nearer, farther"},
    {Action::none, 0, false, "W A S D, Q E", "fly; down, up; with Shift faster"},
    {Action::reset, GLFW_KEY_HOME, false, "Home", "back to the camera"},
    {Action::nextCamera, GLFW_KEY_C, false, "C", "the scene's next camera"},
    {Action::nextDisplay, GLFW_KEY_V, false, "V", "the next way to show two eyes"},
    {Action::swapEyes, GLFW_KEY_X, false, "X", "left and right eye change places"},
    {Action::compare, GLFW_KEY_T, false, "T", "compare with another technique, right of a line; the next one"},
    {Action::difference, GLFW_KEY_G, false, "G", "that line, or the difference \u00d7 4"},
    {Action::fitSize, GLFW_KEY_F3, false, "F3", "a picture as large as the window"},
    {Action::fullScreen, GLFW_KEY_F11, false, "F11", "full screen, and back"},
    {Action::picture, GLFW_KEY_F12, false, "F12", "write the picture: PNG, EXR, and the settings that draw it again"},
    {Action::record, GLFW_KEY_R, false, "R", "record head and gaze to CSV, and stop"},
    {Action::none, 0, false, "a file dropped", "a scene (.glb, .gltf) or settings (.json)"},
    {Action::close, GLFW_KEY_ESCAPE, false, "Escape", "close this list, a message, the window"},
};

constexpr FlyKey kFlyKeys[] = {{GLFW_KEY_D, 0, 1.0},  {GLFW_KEY_A, 0, -1.0}, {GLFW_KEY_E, 1, 1.0},
                               {GLFW_KEY_Q, 1, -1.0}, {GLFW_KEY_S, 2, 1.0},  {GLFW_KEY_W, 2, -1.0}};

}  // namespace

std::span<const KeyBinding> keyMap() {
    return kMap;
}

Action actionOf(int key, bool control) {
    for (const KeyBinding& binding : kMap)
        if (binding.action != Action::none && binding.key == key && binding.control == control) return binding.action;
    return Action::none;
}

std::span<const FlyKey> flyKeys() {
    return kFlyKeys;
}

}  // namespace dioptre
