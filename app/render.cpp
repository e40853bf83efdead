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
    const Scene scene = loadScene(command);
    const auto context = openHeadlessContext(command);
    FrameMaker maker(scene, command.settings);
    std::vector<FrameReport> shown;
    if (command.frames == 1) {
        shown.push_back(maker.make({}));
        writeImage(command.out, maker.composed());
    } else {
        shown = renderSequence(maker, {scene.name, command.frames, command.fps, command.out});
        logInfo(fmt::format("{} frames in {}, to look at: {}", shown.size(), command.out.string(),
                            (command.out / "index.html").string()));
    }
    if (!command.log.empty()) writeFileAtomically(command.log, frameLogCsv(shown));
}

}  // namespace dioptre
