#include "viewer/monitor.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/text.hpp"

namespace dioptre {

std::size_t monitorOf(const DesktopBox& window, std::span<const Monitor> monitors) {
    const auto shared = [&](const DesktopBox& m) {
        const int width = std::min(window.x + window.width, m.x + m.width) - std::max(window.x, m.x);
        const int height = std::min(window.y + window.height, m.y + m.height) - std::max(window.y, m.y);
        return static_cast<long>(std::max(width, 0)) * std::max(height, 0);
    };
    std::size_t best = 0;
    for (std::size_t i = 1; i < monitors.size(); ++i)
        if (shared(monitors[i].box) > shared(monitors[best].box)) best = i;
    return best;
}

std::optional<std::size_t> findMonitor(std::string_view nameOrNumber, std::span<const Monitor> monitors) {
    for (std::size_t i = 0; i < monitors.size(); ++i)
        if (monitors[i].name == nameOrNumber) return i;
    const auto number = parseInteger(nameOrNumber);
    if (!number || *number < 1 || static_cast<std::size_t>(*number) > monitors.size()) return std::nullopt;
    return static_cast<std::size_t>(*number - 1);
}

std::string monitorList(std::span<const Monitor> monitors) {
    std::string list;
    for (std::size_t i = 0; i < monitors.size(); ++i)
        list += fmt::format("{}{} {}", i ? ", " : "", i + 1, monitors[i].name);
    return list;
}

}  // namespace dioptre
