#include "commands.hpp"

#include <cstdint>
#include <string>

#include "core/log.hpp"
#include "scene/builtin.hpp"
#include "scene/gltf_loader.hpp"

namespace dioptre {

Scene loadScene(const Command& command, const std::function<void(double)>& progress) {
    const std::string name = command.scene.empty() ? "builtin:studio" : command.scene;
    const auto builtin = builtinName(name);
    LoadLimits limits;
    limits.maxTotalBytes = static_cast<std::uint64_t>(command.settings.system.maxSceneMb) << 20;
    limits.maxImageSide = command.settings.system.maxTextureSide;
    BuiltinOptions making;
    making.loaded = progress;
    if (progress)
        making.done = [&progress](std::size_t done, std::size_t parts) {
            progress(static_cast<double>(done) / static_cast<double>(parts));
        };
    Scene scene = builtin ? loadBuiltin(*builtin, cacheFolder(), making) : loadGltf(name, limits, progress);
    for (const std::string& warning : scene.warnings) logWarning(warning);
    return scene;
}

std::string_view contextName(const Command& command) {
    switch (command.settings.system.context) {
        case ContextChoice::automatic:
            return "auto";
        case ContextChoice::osmesa:
            return "osmesa";
        case ContextChoice::egl:
            return "egl";
    }
    return "auto";
}

std::unique_ptr<Context> openHeadlessContext(const Command& command) {
    return createHeadlessContext(contextName(command));
}

}  // namespace dioptre
