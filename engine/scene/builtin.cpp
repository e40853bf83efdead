#include "scene/builtin.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <future>
#include <thread>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/log.hpp"
#include "core/resources.hpp"
#include "core/text.hpp"
#include "scene/builtin/model.hpp"
#include "scene/builtin/write_glb.hpp"
#include "scene/gltf_loader.hpp"

namespace dioptre {

namespace fs = std::filesystem;

namespace {

// Part of the file's name. To be raised with every change of what is made, so that older files are not taken for it.
constexpr int kGeneratorVersion = 1;
constexpr std::string_view kPrefix = "builtin:", kStudio = "studio", kStudioFile = "assets/scenes/studio.glb";
constexpr std::size_t kLargestFile = 1u << 30;

struct Maker {
    std::string_view name;
    void (*make)(builtin::Model&);
    float detail;  // of its meshes, so that the scene has the triangles it is meant to have
};
constexpr Maker kMakers[] = {{"toys", builtin::makeToys, 0.54f},
                             {"fishes", builtin::makeFishes, 0.58f},
                             {"dragons", builtin::makeDragons, 0.9f}};

unsigned threadsOf(const BuiltinOptions& options) {
    return options.threads > 0 ? options.threads : std::max(1u, std::thread::hardware_concurrency());
}

BuiltinOptions withProgress(BuiltinOptions options, const std::string& name, std::optional<ProgressLine>& line) {
    if (options.done) return options;
    options.done = [&line, name](std::size_t done, std::size_t total) {
        if (!line) line.emplace(fmt::format("making builtin:{}, part", name), total);
        line->update(done);
    };
    return options;
}

std::string glbOf(const Scene& scene, const std::string& name, const BuiltinOptions& options) {
    return writeGlb(scene, fmt::format("Dioptre builtin:{} {}", name, kGeneratorVersion), threadsOf(options));
}

/// The scene in a file that is whole, or why it is not.
struct Cached {
    std::optional<Scene> scene;
    std::string problem;
};

Cached readCached(const fs::path& path, const BuiltinOptions& options) {
    // Its checksum is taken while it is loaded.
    auto whole = std::async(std::launch::async, [&path] { return checksumHolds(path); });
    try {
        Scene scene = loadGltf(path, {}, options.loaded);
        if (whole.get()) return {std::move(scene), {}};
        return {std::nullopt, fmt::format("{}: its checksum is wrong", path.string())};
    } catch (const InputError& error) {
        return {std::nullopt, error.what()};
    }
}

}  // namespace

std::vector<std::string_view> builtinNames() {
    std::vector<std::string_view> names{kStudio};
    for (const Maker& maker : kMakers) names.push_back(maker.name);
    return names;
}

std::string requireBuiltinName(std::string_view name) {
    if (name.starts_with(kPrefix)) name.remove_prefix(kPrefix.size());
    const auto names = builtinNames();
    if (std::find(names.begin(), names.end(), name) == names.end())
        throw InputError(fmt::format("no built-in scene {}; there are {}", quote(name), fmt::join(names, ", ")));
    return std::string(name);
}

std::optional<std::string> builtinName(std::string_view scene) {
    if (!scene.starts_with(kPrefix)) return std::nullopt;
    return requireBuiltinName(scene);
}

Scene makeBuiltin(const std::string& name, const BuiltinOptions& options) {
    const auto maker =
        std::find_if(std::begin(kMakers), std::end(kMakers), [&](const Maker& m) { return m.name == name; });
    if (maker == std::end(kMakers)) throw InputError(fmt::format("{} is not made, it is a file", quote(name)));
    builtin::Model model(builtin::Detail{options.detail * maker->detail}, std::min(1.0f, options.detail));
    maker->make(model);
    return model.make(name, threadsOf(options), options.done);
}

std::string builtinGlb(const std::string& name, const BuiltinOptions& options) {
    if (name == kStudio) return readFile(resource(kStudioFile), kLargestFile);
    return glbOf(makeBuiltin(name, options), name, options);
}

fs::path cacheFolder() {
    // As the XDG base directory specification has it: a relative path is not valid
    const char* cache = std::getenv("XDG_CACHE_HOME");
    if (cache && fs::path(cache).is_absolute()) return fs::path(cache) / "dioptre";
    const char* home = std::getenv("HOME");
    if (home && fs::path(home).is_absolute()) return fs::path(home) / ".cache" / "dioptre";
    return {};
}

Scene loadBuiltin(const std::string& name, const fs::path& folder, const BuiltinOptions& given) {
    if (name == kStudio) return loadGltf(resource(kStudioFile), {}, given.loaded);
    const fs::path path = folder / fmt::format("{}-v{}.glb", name, kGeneratorVersion);
    std::error_code error;
    if (!folder.empty() && fs::exists(path, error)) {
        Cached cached = readCached(path, given);
        if (cached.scene) {
            cached.scene->name = name;
            return std::move(*cached.scene);
        }
        logWarning(cached.problem + ": it is made anew");
    }
    std::optional<ProgressLine> line;
    const BuiltinOptions options = withProgress(given, name, line);
    Scene made = makeBuiltin(name, options);
    line.reset();
    try {
        if (folder.empty()) throw RunError("no cache folder: neither XDG_CACHE_HOME nor HOME is set");
        fs::create_directories(folder, error);
        requireWritableName(path);
        writeFileAtomically(path, glbOf(made, name, options));
    } catch (const std::runtime_error& failure) {
        logWarning(fmt::format("{}; builtin:{} is made in memory each time", failure.what(), name));
        return made;
    }
    made = {};
    Cached cached = readCached(path, given);
    if (!cached.scene) throw RunError(cached.problem);
    cached.scene->name = name;
    return std::move(*cached.scene);
}

}  // namespace dioptre
