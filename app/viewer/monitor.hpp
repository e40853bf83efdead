// Which monitor a window is on, and which one is meant.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace dioptre {

/// A box on the desktop, in its coordinates.
struct DesktopBox {
    int x = 0, y = 0, width = 0, height = 0;
};
struct Monitor {
    std::string name;  // more than one may have the same
    DesktopBox box;
};

/// Which of the monitors shows most of a window; 0 where none does.
std::size_t monitorOf(const DesktopBox& window, std::span<const Monitor> monitors);

/// The one with that name, else with that number, counted from 1; none where it is not there.
std::optional<std::size_t> findMonitor(std::string_view nameOrNumber, std::span<const Monitor> monitors);

/// "1 DELL U2720Q, 2 HDMI-1"
std::string monitorList(std::span<const Monitor> monitors);

}  // namespace dioptre
