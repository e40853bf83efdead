// A Scene as binary glTF 2.0.
#pragma once

#include <filesystem>
#include <string>

#include "scene/scene.hpp"

namespace dioptre {

/// Interleaved vertices (position, normal, texture coordinates; no tangents), 16 or 32-bit indices, pictures as JPEG;
/// KHR_lights_punctual, KHR_materials_emissive_strength and KHR_materials_unlit where they are needed, none required.
/// The JSON chunk holds a checksum of the whole file: asset.extras.checksum.
/// RunError beyond the 4 GiB of a GLB.
std::string writeGlb(const Scene& scene, const std::string& generator, unsigned threads);

/// Whether the checksum in a file from writeGlb is that of its bytes; false for one that cannot be read.
bool checksumHolds(const std::filesystem::path& file);

}  // namespace dioptre
