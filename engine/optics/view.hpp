// One eye's or camera's view: where it stands, what it sees, in how many pixels; and the matrices that follow.
// Right-handed; a camera looks along its -z, y up. Matrices are destinationFromSource on column vectors.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "optics/units.hpp"

namespace dioptre {

/// World from camera, rigid: p_world = orientation * p_camera + position. Metres; the quaternion has unit length.
struct Pose {
    glm::dvec3 position{0.0};
    glm::dquat orientation{1.0, 0.0, 0.0, 0.0};  // w, x, y, z

    bool operator==(const Pose&) const = default;
};

/// x, y, z of its position and x, y, z, w of its quaternion, which need not have unit length but must not be 0.
using PoseNumbers = std::array<double, 7>;
PoseNumbers numbersOf(const Pose& pose);
Pose poseOf(const PoseNumbers& numbers);

/// The four edges as tangents, i.e. x or y at unit distance; left < right, bottom < top, off-axis allowed.
struct Frustum {
    double left = -1.0, right = 1.0, bottom = -1.0, top = 1.0;

    bool operator==(const Frustum&) const = default;
};

/// aspect = width / height. Throws InputError unless 0 < yfov < pi and aspect > 0.
Frustum symmetricFrustum(Radians yfov, double aspect);

struct View {
    Pose pose;
    Frustum frustum;
    Metres near{0.01};          // > 0; there is no far plane
    int width = 0, height = 0;  // pixels, >= 1

    bool operator==(const View&) const = default;
};

/// Throws InputError naming the first value out of the ranges above.
void validate(const View& view);

glm::dmat4 viewFromWorld(const Pose& pose);
glm::dmat4 worldFromView(const Pose& pose);

/// Reversed Z, infinite far plane, for zero-to-one clip control: ndc z = near / d, 1 at the near plane, 0 at infinity.
/// clip.w = d, the distance along the axis. P00 = 2 / (right - left), P02 = (right + left) / (right - left), same in y.
glm::dmat4 clipFromView(const View& view);

/// (P00 W/2, P11 H/2): pixels per unit tangent. x and y differ where pixels are not square (half-width side by side).
glm::dvec2 focalLengthPixels(const View& view);

}  // namespace dioptre
