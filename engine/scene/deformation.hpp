// What bends a mesh: the pull of joints on its vertices (skins) and morph targets. Beside the vertices, so that rigid
// meshes have nothing of it. The formula (glTF 2.0, 3.7.2.2 and 3.7.3): a vertex v becomes
//   sum over its influences i of w_i M_joint(i) (v + sum over targets k of m_k d_k(v)).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "scene/scene.hpp"

namespace dioptre {

/// The pull of a joint on a vertex.
struct Influence {
    std::uint32_t joint = 0;  // in Skin::joints
    float weight = 0.0f;      // 0 or more; those of a vertex add up to 1
};

/// What one unit of weight adds to each vertex; an empty list adds nothing.
struct MorphTarget {
    std::vector<glm::vec3> positions, normals, tangents;
};

/// How far a deformation can reach, kept when its vertices are gone.
struct DeformedExtent {
    struct Joint {
        std::uint32_t joint = 0;
        Bounds rest;  // of the vertices that it pulls
    };
    Bounds rest;                  // of all vertices
    std::vector<Joint> joints;    // those that pull
    std::vector<Bounds> targets;  // of what each target adds to a position, 0 among it
};

/// Of one primitive.
struct Deformation {
    std::size_t influencesPerVertex = 0;  // 0: no skin
    std::vector<Influence> influences;    // that many for each vertex
    std::vector<MorphTarget> targets;
    // Its normals are those of faces, which have three vertices each, in order: found anew for each pose. Otherwise
    // normals and tangents follow the joints and targets.
    bool flat = false;
    DeformedExtent extent;  // findExtent

    std::size_t bytes() const;
};

/// Whether an instance bends this primitive of its mesh.
bool bends(const Instance& instance, const Primitive& primitive);

/// The vertices that makeFlat makes of a primitive with these indices.
Deformation unshared(const Deformation& shared, std::span<const std::uint32_t> indices);

DeformedExtent findExtent(const Deformation& deformation, const Primitive& primitive);
/// As an instance has it: without a skin no joint pulls, and a rigid primitive has neither joints nor targets.
DeformedExtent extentOf(const Instance& instance, const Primitive& primitive);

/// A box around the posed vertices, in the frame that `originFromMesh` (by joint; empty for an unskinned mesh) leads
/// to. Conservative, for any weights of targets: a skinned vertex is a weighted mean, with weights of 0 or more, of
/// where its joints alone would put it, so it lies inside the union of each joint's transformed box of the vertices
/// that it pulls; each box is grown before by the sum of the weighted boxes of what the targets add.
Bounds posedBounds(const DeformedExtent& extent, std::span<const float> targetWeights,
                   std::span<const glm::mat4> originFromMesh);

}  // namespace dioptre
