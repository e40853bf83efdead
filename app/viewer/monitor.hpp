// Which monitor a window is on.
#pragma once

#include <cstddef>
#include <span>

namespace dioptre {

/// A box on the desktop, in its coordinates.
struct DesktopBox {
    int x = 0, y = 0, width = 0, height = 0;
};
/// Which of the monitors shows most of a window; 0 where none does.
std::size_t monitorOf(const DesktopBox& window, std::span<const DesktopBox> monitors);

}  // namespace dioptre
