// Borders between the primitives of a mesh, which have a material each.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "scene/scene.hpp"

namespace dioptre {

/// Of each primitive, of each vertex: 1 where another primitive of the mesh has a vertex in the same place, else 0; an
/// empty list where it has none such. Of no use once `stopped`.
std::vector<std::vector<std::uint8_t>> sharedVertices(const Mesh& mesh, const std::function<bool()>& stopped);

}  // namespace dioptre
