// Animations: channels and their samplers. Internal to the glTF loader.
#pragma once

#include "scene/animation.hpp"
#include "scene/gltf_accessor.hpp"

namespace dioptre::gltf {

/// Checks and reads all animations; their channels' nodes are those of the file. `targetCounts`: of each node in the
/// file, how many morph targets its mesh has. Left out, with a warning where the file is odd: channels that aim at no
/// node or by an extension, animations without a channel.
std::vector<Animation> readAnimations(const Element& root, const Accessors& accessors,
                                      const std::vector<std::size_t>& targetCounts);

}  // namespace dioptre::gltf
