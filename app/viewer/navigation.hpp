// Moving the head through a scene by hand: arithmetic on poses, no window.
#pragma once

#include <glm/glm.hpp>

#include "optics/view.hpp"
#include "scene/scene.hpp"

namespace dioptre {

/// Where the head is, and how far before it lies what it turns around.
struct Stance {
    Pose pose;
    Metres pivot{1.0};  // > 0, along the view's axis
};

/// A turn to the right and upwards, radians. The head keeps its roll and never tips over: the axis of the view stays a
/// degree away from straight up and straight down.
struct Turn {
    double right = 0.0, up = 0.0;
};

/// Turns the head on the spot.
Stance look(const Stance& stance, const Turn& turn);
/// Turns the head and moves it, so that the pivot stays where it is in the world and in the picture.
Stance orbit(const Stance& stance, const Turn& turn);
/// Moves the head across its axis: what lies at the pivot's depth moves by `tangents` (x right, y up) in the picture.
Stance pan(const Stance& stance, glm::dvec2 tangents);
/// Moves the head along its axis: with each step a tenth of the way to the pivot, back with negative ones. The pivot
/// stays where it is, and is never reached.
Stance zoom(const Stance& stance, double steps);
/// Moves the head along its own axes: x right, y up, z backwards.
Stance fly(const Stance& stance, const glm::dvec3& metres);

/// The depth to turn around: of what is in focus, within what a scene of this size makes sense of.
Metres pivotAt(Dioptres focus, const Bounds& scene);
/// How fast to fly through a scene, m/s: at a walk, slower where the scene is small.
double flyingSpeed(const Bounds& scene);

}  // namespace dioptre
