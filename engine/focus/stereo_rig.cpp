#include "focus/stereo_rig.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/error.hpp"

namespace dioptre {

namespace {

void requirePositive(const char* what, Metres length) {
    if (!std::isfinite(length.value) || length.value <= 0.0)
        throw InputError(fmt::format("screen: {} {} m, must be finite and > 0", what, length.value));
}

/// The pyramid from an eye at x = offset through the screen's window.
Frustum throughScreen(const Frustum& head, double offset, const ScreenGeometry& screen) {
    const double aspect = (head.right - head.left) / (head.top - head.bottom);
    const double halfWidth = 0.5 * screen.width.value;
    const double halfHeight = halfWidth / aspect;
    const double d = screen.distance.value;
    return {(-halfWidth - offset) / d, (halfWidth - offset) / d, -halfHeight / d, halfHeight / d};
}

}  // namespace

Metres eyeOffset(Eye eye, Metres ipd) {
    switch (eye) {
        case Eye::left:
            return ipd * -0.5;
        case Eye::right:
            return ipd * 0.5;
        case Eye::centre:
            break;
    }
    return Metres(0.0);
}

View eyeView(Eye eye, const View& centre, Metres ipd, const std::optional<ScreenGeometry>& screen) {
    if (!std::isfinite(ipd.value) || ipd.value < 0.0)
        throw InputError(fmt::format("eyes: interpupillary distance {} m, must be finite and not negative", ipd.value));
    if (screen) {
        requirePositive("width", screen->width);
        requirePositive("distance", screen->distance);
    }
    View view = centre;
    const double offset = eyeOffset(eye, ipd).value;
    // Not for 0: adding +0 or -0 could still change a position's bits.
    if (offset != 0.0) view.pose.position += centre.pose.orientation * glm::dvec3(offset, 0.0, 0.0);
    if (screen) view.frustum = throughScreen(centre.frustum, offset, *screen);
    return view;
}

}  // namespace dioptre
