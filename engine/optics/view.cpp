#include "optics/view.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"

namespace dioptre {

PoseNumbers numbersOf(const Pose& pose) {
    const auto& [p, q] = pose;
    return {p.x, p.y, p.z, q.x, q.y, q.z, q.w};
}

Pose poseOf(const PoseNumbers& n) {
    return {{n[0], n[1], n[2]}, glm::normalize(glm::dquat(n[6], n[3], n[4], n[5]))};
}

Frustum symmetricFrustum(Radians yfov, double aspect) {
    if (!(yfov.value > 0.0 && yfov.value < std::numbers::pi))
        throw InputError(fmt::format("view: vertical field of view {} rad, must be between 0 and pi", yfov.value));
    if (!std::isfinite(aspect) || aspect <= 0.0)
        throw InputError(fmt::format("view: aspect {}, must be finite and > 0", aspect));
    const double top = std::tan(0.5 * yfov.value);
    return {-top * aspect, top * aspect, -top, top};
}

void validate(const View& view) {
    const auto& [position, orientation] = view.pose;
    for (int i = 0; i < 3; ++i)
        if (!std::isfinite(position[i]))
            throw InputError(
                fmt::format("view: position {}, {}, {}, must be finite", position.x, position.y, position.z));
    // 1e-6: what a quaternion keeps that was written with seven digits or as floats.
    if (const double length = glm::length(orientation); !(std::abs(length - 1.0) < 1e-6))
        throw InputError(fmt::format("view: orientation of length {}, must be a unit quaternion", length));
    const Frustum& f = view.frustum;
    if (!(std::isfinite(f.left) && std::isfinite(f.right) && f.left < f.right))
        throw InputError(
            fmt::format("view: frustum from left {} to right {}, must be finite and increase", f.left, f.right));
    if (!(std::isfinite(f.bottom) && std::isfinite(f.top) && f.bottom < f.top))
        throw InputError(
            fmt::format("view: frustum from bottom {} to top {}, must be finite and increase", f.bottom, f.top));
    if (!std::isfinite(view.near.value) || view.near.value <= 0.0)
        throw InputError(fmt::format("view: near plane at {} m, must be finite and > 0", view.near.value));
    if (view.width < 1 || view.height < 1)
        throw InputError(fmt::format("view: {}x{} pixels, must be at least 1x1", view.width, view.height));
}

glm::dmat4 worldFromView(const Pose& pose) {
    glm::dmat4 m = glm::mat4_cast(pose.orientation);
    m[3] = glm::dvec4(pose.position, 1.0);
    return m;
}

glm::dmat4 viewFromWorld(const Pose& pose) {
    // Rigid: the rotation's inverse is its conjugate.
    glm::dmat4 m = glm::mat4_cast(glm::conjugate(pose.orientation));
    m[3] = m * glm::dvec4(-pose.position, 1.0);
    return m;
}

glm::dmat4 clipFromView(const View& view) {
    const auto& [left, right, bottom, top] = view.frustum;
    glm::dmat4 m(0.0);  // m[column][row]
    m[0][0] = 2.0 / (right - left);
    m[1][1] = 2.0 / (top - bottom);
    m[2][0] = (right + left) / (right - left);
    m[2][1] = (top + bottom) / (top - bottom);
    m[2][3] = -1.0;  // w = -z = d
    m[3][2] = view.near.value;
    return m;
}

glm::dvec2 focalLengthPixels(const View& view) {
    const auto& [left, right, bottom, top] = view.frustum;
    return {view.width / (right - left), view.height / (top - bottom)};
}

}  // namespace dioptre
