// Skins: joints and where they were when the mesh was bound to them. Internal to the glTF loader.
#pragma once

#include "scene/animation.hpp"
#include "scene/gltf_accessor.hpp"

namespace dioptre::gltf {

/// Checks and reads all skins; their joints are nodes of the file. `skeleton` is checked, but says nothing about where
/// anything is.
std::vector<Skin> readSkins(const Element& root, const Accessors& accessors);

}  // namespace dioptre::gltf
