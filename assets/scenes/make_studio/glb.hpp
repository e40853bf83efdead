// The model as binary glTF 2.0: one node, mesh and material per object, cameras, punctual lights.
#pragma once

#include <string>
#include <vector>

#include "textures.hpp"

namespace studio {

/// Writes to a temporary name beside `path` and renames. Throws std::runtime_error if the file cannot be written.
/// Returns the number of bytes.
std::size_t writeGlb(const std::string& path, const Model& model, const std::vector<ObjectPictures>& pictures);

/// A picture as PNG on disk.
void writePng(const std::string& path, const Picture& picture);

}  // namespace studio
