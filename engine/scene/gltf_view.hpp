// Cameras and lights (KHR_lights_punctual). Internal to the glTF loader.
#pragma once

#include "scene/gltf_json.hpp"

namespace dioptre::gltf {

/// As in the file, not placed yet; nothing for an orthographic camera.
std::vector<std::optional<Camera>> readCameras(const Element& root);
std::vector<Light> readLights(const Element& root);

}  // namespace dioptre::gltf
