// Normals and tangents for vertices that came without.
#pragma once

#include <vector>

#include "scene/scene.hpp"

namespace dioptre {

/// Gives each triangle three vertices (and extras) of its own and each vertex the normal of its face (counter-clockwise
/// is front). A triangle without area gets +z.
void makeFlat(Primitive& primitive);

/// Gives each vertex marked in `missing` the area-weighted normal of the faces around it, +z where they
/// have no area or there are none.
void fillNormals(Primitive& primitive, const std::vector<bool>& missing);

/// Tangents along increasing u, orthogonal to the normal, w = handedness: bitangent = w * cross(normal, tangent) runs
/// along decreasing v, up in the picture (glTF 2.0, 3.9.3), with u and v as `slot` reads its image. Vertices whose
/// texture coordinates do not span a plane get some tangent.
void computeTangents(Primitive& primitive, const TextureSlot& slot = {});

/// Some unit vector orthogonal to the unit vector `normal`.
glm::vec3 anyOrthogonal(const glm::vec3& normal);

}  // namespace dioptre
