// The node tree: that it is one, and where each node of the drawn scene lies in the world. Internal to the glTF loader.
#pragma once

#include "scene/animation.hpp"
#include "scene/gltf_json.hpp"

namespace dioptre::gltf {

struct PlacedNode {
    std::size_t node = 0;
    int parent = -1;                // its place in the list; -1: a root
    glm::mat4 worldFromNode{1.0f};  // finite
};

/// Where a node is in its parent's frame; fails where the file says no such thing.
NodeTransform readTransform(const Element& node);

/// Checks all nodes (one parent at most, no cycle, depth, transforms) and all scenes, and returns the nodes of the
/// scene to draw, parents before children. `sceneName` becomes that of the scene, if it has one.
std::vector<PlacedNode> placeNodes(const Element& root, std::string& sceneName);

}  // namespace dioptre::gltf
