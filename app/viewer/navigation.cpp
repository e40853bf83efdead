#include "viewer/navigation.hpp"

#include <algorithm>
#include <cmath>

namespace dioptre {

namespace {

const double kSteepest = glm::radians(89.0);
constexpr double kZoomStep = 0.9;  // of the distance to the pivot is left
constexpr double kWalk = 1.5;      // m/s

glm::dvec3 forward(const Pose& pose) {
    return pose.orientation * glm::dvec3(0.0, 0.0, -1.0);
}

glm::dvec3 pivotOf(const Stance& stance) {
    return stance.pose.position + forward(stance.pose) * stance.pivot.value;
}

/// Half the diagonal of the scene's box; 1 m where there is nothing.
double radiusOf(const Bounds& scene) {
    const double radius = scene.empty() ? 1.0 : 0.5 * glm::length(glm::dvec3(scene.size()));
    return std::isfinite(radius) && radius > 0.0 ? radius : 1.0;
}

}  // namespace

Stance look(const Stance& stance, const Turn& turn) {
    Stance turned = stance;
    const glm::dvec3 axis = forward(stance.pose);
    const double elevation = std::asin(std::clamp(axis.y, -1.0, 1.0));
    // A view that begins steeper than that may only come back.
    const double up = std::clamp(elevation + turn.up, std::min(-kSteepest, elevation), std::max(kSteepest, elevation));
    const glm::dquat aroundUp = glm::angleAxis(-turn.right, glm::dvec3(0.0, 1.0, 0.0));
    const glm::dquat aroundRight = glm::angleAxis(up - elevation, glm::dvec3(1.0, 0.0, 0.0));
    turned.pose.orientation = glm::normalize(aroundUp * stance.pose.orientation * aroundRight);
    return turned;
}

Stance orbit(const Stance& stance, const Turn& turn) {
    Stance turned = look(stance, turn);
    turned.pose.position = pivotOf(stance) - forward(turned.pose) * stance.pivot.value;
    return turned;
}

Stance pan(const Stance& stance, glm::dvec2 tangents) {
    return fly(stance, glm::dvec3(-tangents * stance.pivot.value, 0.0));
}

Stance zoom(const Stance& stance, double steps) {
    Stance moved = stance;
    moved.pivot = stance.pivot * std::pow(kZoomStep, steps);
    moved.pose.position = pivotOf(stance) - forward(stance.pose) * moved.pivot.value;
    return moved;
}

Stance fly(const Stance& stance, const glm::dvec3& metres) {
    Stance moved = stance;
    moved.pose.position += stance.pose.orientation * metres;
    return moved;
}

Metres pivotAt(Dioptres focus, const Bounds& scene) {
    const double radius = radiusOf(scene);
    const double farthest = 2.0 * radius, nearest = 1e-3 * radius;
    return Metres(focus.value > 1.0 / farthest ? std::max(distance(focus).value, nearest) : farthest);
}

double flyingSpeed(const Bounds& scene) {
    return std::min(0.5 * radiusOf(scene), kWalk);
}

}  // namespace dioptre
