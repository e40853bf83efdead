// JOINTS_n, WEIGHTS_n and morph targets of a primitive. Internal to the glTF loader.
#pragma once

#include "scene/deformation.hpp"
#include "scene/gltf_accessor.hpp"

namespace dioptre::gltf {

/// What is to be read of a mesh's deformations: what some node of the scene puts to use.
struct DeformationNeeds {
    std::size_t fewestJoints = 0;  // of the skins that it is drawn with; 0: none
    std::size_t skin = 0;          // that has so few
    bool morphed = false;

    bool any() const { return fewestJoints > 0 || morphed; }
};

/// What of the base vertices the targets' counterparts are added to.
struct DeformedVertices {
    std::uint64_t count = 0;
    bool normals = false, tangents = false;  // are in the file, and read
};

/// Checks types, counts and the numbering of a primitive's JOINTS_n and WEIGHTS_n, all in fours, and of its targets;
/// reads nothing yet. `quantized`: KHR_mesh_quantization is declared.
void checkDeformation(const Element& primitive, const Accessors& accessors, std::uint64_t vertexCount, bool quantized);

/// What the needs ask for, charged to the context; null where the primitive has nothing of it. Weights are normalised,
/// with a warning where they were not; a vertex that no joint pulls follows the skin's first, with a warning.
std::shared_ptr<Deformation> readDeformation(const Element& primitive, const Accessors& accessors,
                                             const DeformationNeeds& needs, const DeformedVertices& vertices);

}  // namespace dioptre::gltf
