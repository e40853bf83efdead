// dioptre render: one picture, or a sequence along head and gaze traces, headless.
#include <fmt/format.h>

#include <chrono>
#include <optional>

#include "commands.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "core/image.hpp"
#include "core/log.hpp"
#include "frame/frame_maker.hpp"
#include "frame/sequence.hpp"
#include "gl/context.hpp"
#include "interrupt.hpp"
#include "scene/lod.hpp"

namespace dioptre {

namespace {

// A picture that takes longer tells how far it is.
constexpr std::chrono::seconds kSilence(3);
constexpr std::size_t kPercent = 100;

std::filesystem::path normal(const std::filesystem::path& folder) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute("." / folder / ""));
}

}  // namespace

void runRender(const Command& command) {
    const bool sequence = command.frames > 1;
    const bool logInFolder = sequence && normal(command.log.parent_path()) == normal(command.out);
    if (!command.log.empty() && !logInFolder) requireWritableName(command.log);
    Scene scene = loadScene(command);
    const auto context = openHeadlessContext(command);
    FrameMaker maker(scene, command.settings);
    const auto named = planOf(command.settings.render);
    const auto addLevels = [&] { maker.addLevels(buildLevels(scene, {lodFolder()})); };
    if (named ? usesLevels(*named) : sequence) addLevels();
    std::vector<FrameReport> shown;
    const auto warnIfLimited = [](const ResolvedLens& lens) {
        if (lens.focusLimited)
            logWarning(fmt::format("the lens cannot focus there: {:.2f} D was asked for, {:.2f} D is in reach",
                                   lens.lens.focus.value + lens.residual.value, lens.lens.focus.value));
    };
    if (!sequence) {
        FrameMaker::Input input;
        input.time = command.settings.view.time;
        input.budgetMilliseconds = command.settings.render.budgetMs.value_or(kPictureMs);
        input.alone = true;
        std::optional<ProgressLine> line;
        input.onDrawn = [&line, start = std::chrono::steady_clock::now()](double share) {
            if (std::chrono::steady_clock::now() - start < kSilence) return;
            if (!line) line.emplace("drawing, percent", kPercent);
            line->update(static_cast<std::size_t>(share * kPercent));
        };
        shown.push_back(maker.make(input));
        // Levels of detail take long to build: only for a plan that draws them
        if (!named && usesLevels(shown.back().plan)) {
            addLevels();
            shown.back() = maker.make(input);
        }
        line.reset();
        warnIfLimited(shown.back().lens);
        writeImage(command.out, maker.composed());
    } else {
        scene.releaseBulk();
        makeFolder(command.out, "--out");
        if (!command.log.empty()) requireWritableName(command.log);
        watchInterrupts();
        shown = renderSequence(maker, {scene.name, command.frames, command.fps,
                                       command.settings.render.budgetMs.value_or(1000.0 / command.fps), command.out,
                                       command.settings.view.time, interrupted});
        if (!shown.empty())
            logInfo(fmt::format("{} frame{} in {}, to look at: {}", shown.size(), shown.size() == 1 ? "" : "s",
                                command.out.string(), (command.out / "index.html").string()));
    }
    if (!command.log.empty()) writeFileAtomically(command.log, frameLogCsv(shown));
    if (shown.size() < static_cast<std::size_t>(command.frames))
        throw RunError(fmt::format("stopped with {} of {} frames drawn", shown.size(), command.frames));
}

}  // namespace dioptre
