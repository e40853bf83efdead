// dioptre measure: the speed-accuracy trade of every technique, as tables and a page.
#include <fmt/format.h>

#include "commands.hpp"
#include "core/error.hpp"
#include "core/log.hpp"
#include "frame/measure.hpp"
#include "gl/context.hpp"
#include "gl/pass.hpp"
#include "interrupt.hpp"
#include "scene/builtin.hpp"
#include "scene/lod.hpp"

namespace dioptre {

namespace {

// So that --quick ends within two minutes on two cores.
constexpr double kQuickRowMilliseconds = 1500.0;

std::string nameOf(const std::string& scene) {
    if (const auto builtin = builtinName(scene)) return *builtin;
    return std::filesystem::path(scene).stem().string();
}

std::vector<std::string> scenesOf(const Command& command) {
    if (!command.measure.scenes.empty()) return command.measure.scenes;
    if (command.measure.quick) return {"builtin:studio"};
    std::vector<std::string> all;
    for (const std::string_view name : builtinNames()) all.push_back("builtin:" + std::string(name));
    return all;
}

MeasureRequest requestOf(const Command& command, std::size_t scenes) {
    const MeasureOptions& options = command.measure;
    MeasureRequest request;
    request.folder = command.out;
    request.sizes = options.sizes;
    if (request.sizes.empty()) request.sizes.push_back(options.quick ? PictureSize{320, 240} : PictureSize{640, 480});
    request.samplesPerHalf = options.samples.value_or(options.quick ? 64 : 256);
    if (options.quick) request.rowMilliseconds = kQuickRowMilliseconds;
    request.exposureEv = command.settings.render.exposureEv;
    request.view = command.settings.view;
    request.resume = options.resume;
    request.scenes = scenes;
    if (const auto cache = cacheFolder(); !cache.empty()) request.cache = cache / "references";
    request.lods = lodFolder();
    request.program = programVersion();
    request.commit = sourceCommit();
    request.context = contextName(command);
    request.stopped = interrupted;
    return request;
}

void requireDifferentNames(const std::vector<std::string>& scenes) {
    for (std::size_t i = 0; i < scenes.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (nameOf(scenes[i]) == nameOf(scenes[j]))
                throw InputError(
                    fmt::format("measure: {} and {} would both be called {}", scenes[j], scenes[i], nameOf(scenes[i])));
}

}  // namespace

void runMeasure(const Command& command) {
    watchInterrupts();
    const std::vector<std::string> scenes = scenesOf(command);
    requireDifferentNames(scenes);
    const double start = nowMilliseconds();
    const auto context = openHeadlessContext(command);
    Measuring measuring(requestOf(command, scenes.size()));
    for (const std::string& name : scenes) {
        if (interrupted()) break;
        Command one = command;
        one.scene = name;
        try {
            if (!measuring.add(nameOf(name), loadScene(one))) break;
        } catch (...) {
            // What the others gave is kept.
            if (!measuring.measurements().rows.empty()) measuring.finish();
            throw;
        }
    }
    measuring.finish();
    const std::size_t rows = measuring.measurements().rows.size();
    const std::string page = (command.out / "index.html").string();
    if (interrupted())
        throw RunError(fmt::format("stopped with {} of {} rows measured, in {}; --resume goes on from there", rows,
                                   measuring.rowsWanted(), command.out.string()));
    logInfo(fmt::format("{} rows, {} of them new, in {}; to look at: {}", rows, measuring.rowsAdded(),
                        durationText((nowMilliseconds() - start) * 1e-3), page));
}

}  // namespace dioptre
