// Scenes that come with the program: `builtin:NAME`. All but the studio are made on first use and kept as GLB files in
// the user's cache folder. They stand in for the scenes of Jeong et al. 2013, "Real-time defocus rendering with level
// of detail and sub-sample blur": many detailed things from 0.4 m to 15 m, for a strong blur in front and behind.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/scene.hpp"

namespace dioptre {

/// "studio", "toys", "fishes", "dragons".
std::vector<std::string_view> builtinNames();

/// The name in "builtin:toys"; none where `scene` is a file. InputError: an unknown name, with those there are.
std::optional<std::string> builtinName(std::string_view scene);
/// The same, "builtin:" not required.
std::string requireBuiltinName(std::string_view name);

struct BuiltinOptions {
    float detail = 1.0f;                                      // < 1: fewer triangles, smaller pictures
    unsigned threads = 0;                                     // 0: as many as there are
    std::function<void(std::size_t, std::size_t)> done = {};  // parts finished, of so many
    std::function<void(double)> loaded = {};                  // share of its file, 0..1, once there is one
};

/// Makes a scene; the same, to the byte, at any number of threads. Not for the studio, which is a file.
Scene makeBuiltin(const std::string& name, const BuiltinOptions& options = {});
/// The same as a GLB file's bytes.
std::string builtinGlb(const std::string& name, const BuiltinOptions& options = {});

/// $XDG_CACHE_HOME/dioptre, else ~/.cache/dioptre; empty where neither is known.
std::filesystem::path cacheFolder();

/// Loads a scene from its file in `folder`, which is made if it is missing or, with a warning, if it is broken. Where
/// no file can be written the scene is made in memory, with a warning. Shows progress.
Scene loadBuiltin(const std::string& name, const std::filesystem::path& folder, const BuiltinOptions& options = {});

}  // namespace dioptre
