#include "viewer/monitor.hpp"

#include <algorithm>

namespace dioptre {

std::size_t monitorOf(const DesktopBox& window, std::span<const DesktopBox> monitors) {
    const auto shared = [&](const DesktopBox& m) {
        const int width = std::min(window.x + window.width, m.x + m.width) - std::max(window.x, m.x);
        const int height = std::min(window.y + window.height, m.y + m.height) - std::max(window.y, m.y);
        return static_cast<long>(std::max(width, 0)) * std::max(height, 0);
    };
    std::size_t best = 0;
    for (std::size_t i = 1; i < monitors.size(); ++i)
        if (shared(monitors[i]) > shared(monitors[best])) best = i;
    return best;
}

}  // namespace dioptre
