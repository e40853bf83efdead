// The one table of keys and of what the mouse does: the window acts by it, and F1 shows it.
#pragma once

#include <span>
#include <string_view>

namespace dioptre {

enum class Action {
    none,
    help,
    panel,
    fullScreen,
    picture,
    record,
    nextCamera,
    reset,
    nextDisplay,
    swapEyes,
    compare,
    difference,
    fitSize,
    search,
    undo,
    redo,
    close,
};

struct KeyBinding {
    Action action = Action::none;  // none: a line of the list alone
    int key = 0;                   // as GLFW has it
    bool control = false;          // with the control key
    std::string_view keys, what;   // as the list shows them
};

/// In the order of the list.
std::span<const KeyBinding> keyMap();

/// What a key does; none where it does nothing.
Action actionOf(int key, bool control);

/// Keys that move the head while they are held, and where to: x right, y up, z backwards.
struct FlyKey {
    int key = 0;
    int axis = 0;      // 0 x, 1 y, 2 z
    double way = 1.0;  // 1 or -1
};
std::span<const FlyKey> flyKeys();

}  // namespace dioptre
