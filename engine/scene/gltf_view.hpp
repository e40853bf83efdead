// Cameras and lights (KHR_lights_punctual). Internal to the glTF loader.
#pragma once

#include "scene/gltf_json.hpp"

namespace dioptre::gltf {

/// As in the file, not placed yet; nothing for an orthographic camera.
std::vector<std::optional<Camera>> readCameras(const Element& root);
std::vector<Light> readLights(const Element& root);

/// Puts it in the world, with scale and shear taken out; false where a singular matrix leaves no direction.
bool place(Camera& camera, const glm::mat4& worldFromNode);
bool place(Light& light, const glm::mat4& worldFromNode);

}  // namespace dioptre::gltf
