// The node tree: that it is one, and where each node of the drawn scene lies in the world. Internal to the glTF loader.
#pragma once

#include "scene/gltf_json.hpp"

namespace dioptre::gltf {

struct PlacedNode {
    std::size_t node = 0;
    glm::mat4 worldFromNode{1.0f};  // finite
};

/// Checks all nodes (one parent at most, no cycle, depth, transforms) and all scenes, and returns the nodes of the
/// scene to draw, parents before children. `sceneName` becomes that of the scene, if it has one.
std::vector<PlacedNode> placeNodes(const Element& root, std::string& sceneName);

}  // namespace dioptre::gltf
