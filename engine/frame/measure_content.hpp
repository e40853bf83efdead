// The hash by which the pictures of a scene are found again.
#pragma once

#include <string>

#include "scene/scene.hpp"

namespace dioptre {

/// Hash of everything in a scene that can change a picture of a given view: geometry, textures, materials, lights.
std::string contentOf(const Scene& scene);

}  // namespace dioptre
