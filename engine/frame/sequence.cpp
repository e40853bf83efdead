#include "frame/sequence.hpp"

#include <fmt/format.h>

#include "core/file.hpp"
#include "core/image.hpp"
#include "core/log.hpp"

namespace dioptre {

std::vector<FrameReport> renderSequence(FrameMaker& maker, const SequenceRequest& request) {
    std::vector<FrameReport> shown;
    ProgressLine progress("frame", static_cast<std::size_t>(request.frames));
    for (int i = 0; i < request.frames && !request.stopped(); ++i) {
        FrameMaker::Input input;
        input.time = request.start + i / request.fps;
        input.budgetMilliseconds = request.budgetMs;
        if (i == 0) maker.warmUp(input, 1.0 / request.fps);
        shown.push_back(maker.make(input));
        writeImage(request.folder / fmt::format("frame_{:04d}.png", i), maker.composed());
        progress.update(static_cast<std::size_t>(i) + 1);
    }
    if (!shown.empty()) writeFileAtomically(request.folder / "index.html", sequencePage(request, shown));
    return shown;
}

std::string frameLogCsv(std::span<const FrameReport> frames) {
    std::string csv = "t_s,gaze_x,gaze_y,gaze_valid,under_gaze_D,focus_D,pupil_mm,plan,ms\n";
    for (const FrameReport& f : frames)
        csv += fmt::format("{:.6f},{:.5f},{:.5f},{},{},{:.6f},{:.4f},\"{}\",{:.3f}\n", f.time, f.gaze.position.x,
                           f.gaze.position.y, f.gaze.valid ? 1 : 0,
                           f.underGaze ? fmt::format("{:.6f}", f.underGaze->value) : "", f.lens.lens.focus.value,
                           f.lens.apertureDiameter.value * 1e3, planText(f.plan), f.milliseconds);
    return csv;
}

}  // namespace dioptre
