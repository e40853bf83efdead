// A primitive's triangles as surfaces that a simplifier can walk on: vertices of equal position are one point, and each
// edge has one face or two. What is not so in the source (an edge of three faces, surfaces that touch in one vertex) is
// taken apart, and its points are marked.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "scene/scene.hpp"

namespace dioptre {

struct WeldedFace {
    std::array<std::uint32_t, 3> point;  // in WeldedMesh::points, all different
    std::array<std::uint32_t, 3> wedge;  // the vertex of the primitive that the corner shows
};

/// Flags of a point.
constexpr std::uint8_t kFixed = 1;      // stays
constexpr std::uint8_t kUntouched = 2;  // stays, and nothing is moved onto it
constexpr std::uint8_t kSeam = 4;       // its corners show more than one vertex

constexpr std::uint32_t kNoTwin = 0xFFFFFFFF;

struct WeldedMesh {
    std::vector<WeldedFace> faces;  // of source triangles whose corners are apart
    std::vector<glm::vec3> points;
    std::vector<std::uint8_t> flags;  // of each point
    // Half-edge 3 f + k runs from corner k of face f to the next; its twin runs back in the neighbour, kNoTwin at a
    // border.
    std::vector<std::uint32_t> twins;
};

/// `fixed`: of each vertex, those that must stay; or empty. Vertices that are equal in every attribute become one, the
/// first. Empty once `stopped`.
WeldedMesh weld(const Primitive& primitive, std::span<const std::uint8_t> fixed, const std::function<bool()>& stopped);

}  // namespace dioptre
