// Where the files that come with the program are: shaders/, config/, assets/.
#pragma once

#include <filesystem>

namespace dioptre {

/// Full path of a file or folder that comes with the program, e.g. resource("shaders/scene/lit.frag.glsl"). It is
/// looked for in the nearest folder above the executable that holds shaders/ and config/, else where the program was
/// built. Throws RunError if it is not there.
std::filesystem::path resource(const std::filesystem::path& relative);

}  // namespace dioptre
