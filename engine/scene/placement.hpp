// Things of a scene put where the nodes that they hang from are.
#pragma once

#include "scene/animation.hpp"
#include "scene/scene.hpp"

namespace dioptre {

/// Puts it in the world, with scale and shear taken out; false where a singular matrix leaves no direction, which
/// stays the one before.
bool place(Camera& camera, const glm::mat4& worldFromNode);
bool place(Light& light, const glm::mat4& worldFromNode);

/// All instances, cameras and lights that hang from a node.
void place(Scene& scene, const MotionPose& pose);

/// The box that a scene in motion stays inside, as far as looked at: its boxes of up to 128 moments of the longest
/// animation together. For framing it; what is drawn has the bounds of its own moment.
Bounds motionBounds(const Scene& scene);

}  // namespace dioptre
