// Chains of levels as files, each named by a hash of what it was made of.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scene/simplify.hpp"

namespace dioptre {

/// Names all that the levels of a primitive depend on; `fixed` as in SimplifyRequest.
std::string lodKey(const Primitive& primitive, std::span<const std::uint8_t> fixed);

/// KEY.lod, in the byte order of this machine: magic, version, number of vertices, of triangles and of levels, then of
/// each level the number of indices, error, seconds and the indices, then a checksum (64 bits, ContentHash) of all
/// that.
std::string lodBytes(const Primitive& primitive, std::span<const LodLevel> levels);

/// None where there is no file. InputError, with what is wrong, for one that is not whole or not of this primitive.
std::optional<std::vector<LodLevel>> readLods(const std::filesystem::path& file, const Primitive& primitive);

}  // namespace dioptre
