// One primitive's levels of detail: lists of indices into its own vertices.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "scene/scene.hpp"

namespace dioptre {

/// Fewer triangles of a primitive, made of its own vertices.
struct LodLevel {
    std::vector<std::uint32_t> indices;  // 3 per triangle
    // Metres in mesh space: no point of this surface is farther than that from level 0 (its triangles that have an
    // area), and none of level 0 is from this.
    float error = 0.0f;
    float seconds = 0.0f;  // of one processor core, to make it from the level before
};

/// A chain ends where it would get to fewer.
constexpr std::size_t kFewestTriangles = 64;

struct SimplifyRequest {
    const Primitive& primitive;           // of triangles
    std::span<const std::uint8_t> fixed;  // of each vertex: other primitives have one in this place; or empty
    std::function<void(LodLevel)> made;   // called with level 1, 2, ... as soon as each is there
    std::function<bool()> stopped;        // asked often; the rest is not made once it says so
};

/// Each level has half the triangles of the one before, or what is left where not so many can go; but for rounding none
/// is off by more than half the diagonal of the primitive's bounds. A chain ends at kFewestTriangles, or where a level
/// would keep more than three of four triangles. What stays as it is:
///   vertices, with all their attributes: a level has fewer of them;
///   the sides of a seam (of texture coordinates or normals), which share its vertices at every level; a seam loses
///     vertices only along itself, and ends where it did;
///   open borders, but for vertices on a straight line that no other primitive has;
///   the direction of faces; closed surfaces stay closed;
///   what is no surface: edges of three faces, and surfaces where they touch.
/// Triangles with two corners in one place are left out.
void simplify(const SimplifyRequest& request);

}  // namespace dioptre
