// dioptre render: one picture, or a sequence along head and gaze traces, headless.
#include <fmt/format.h>

#include "commands.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "core/image.hpp"
#include "core/log.hpp"
#include "frame/frame_maker.hpp"
#include "frame/sequence.hpp"
#include "gl/context.hpp"

namespace dioptre {

void runRender(const Command& command) {
    if (!command.log.empty()) requireWritableName(command.log);
    Scene scene = loadScene(command);
    const auto context = openHeadlessContext(command);
    FrameMaker maker(scene, command.settings);
    scene.releaseBulk();
    std::vector<FrameReport> shown;
    const auto warnIfLimited = [](const ResolvedLens& lens) {
        if (lens.focusLimited)
            logWarning(fmt::format("the lens cannot focus there: {:.2f} D was asked for, {:.2f} D is in reach",
                                   lens.lens.focus.value + lens.residual.value, lens.lens.focus.value));
    };
    if (command.frames == 1) {
        shown.push_back(maker.make({}));
        warnIfLimited(shown.back().lens);
        writeImage(command.out, maker.composed());
    } else {
        shown = renderSequence(maker, {scene.name, command.frames, command.fps, command.out});
        logInfo(fmt::format("{} frames in {}, to look at: {}", shown.size(), command.out.string(),
                            (command.out / "index.html").string()));
    }
    if (!command.log.empty()) writeFileAtomically(command.log, frameLogCsv(shown));
}

}  // namespace dioptre
