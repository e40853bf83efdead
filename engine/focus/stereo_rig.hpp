// Two eyes from one head: parallel axes, the eyes apart along the head's own x.
#pragma once

#include <optional>

#include "optics/view.hpp"

namespace dioptre {

enum class Eye { left, right, centre };  // centre: the cyclopean eye, midway

/// A screen that stands square before the head, its middle on the head's axis.
struct ScreenGeometry {
    Metres width{0.6};     // of one eye's picture, > 0
    Metres distance{0.7};  // from the head, > 0
};

/// The eye's shift along the head's x: -IPD/2, +IPD/2 or 0.
Metres eyeOffset(Eye eye, Metres ipd);

/// One eye's view from the head's (`centre`): shifted sideways, size and near plane kept. Without a screen the frustum
/// is kept: points at infinity have no disparity, nearer ones ipd * f_px * D pixels. With a screen both frusta pass
/// through the same window of width x width/aspect, the aspect of the head's frustum: points at the screen's distance
/// have no disparity, infinity has at most the IPD on the screen. IPD 0 gives identical views to the bit. Throws
/// InputError unless ipd >= 0 and the screen's lengths are > 0, all finite.
View eyeView(Eye eye, const View& centre, Metres ipd, const std::optional<ScreenGeometry>& screen = std::nullopt);

}  // namespace dioptre
