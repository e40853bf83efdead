#include "frame/budget_run.hpp"

#include <fmt/format.h>

#include "core/file.hpp"
#include "core/log.hpp"
#include "frame/measure_pictures.hpp"
#include "metrics/metrics.hpp"

namespace dioptre {

namespace {

// Wide enough to tell blur from none in either eye.
constexpr int kPictureWidth = 480, kPictureQuality = 80;

BudgetFrame noteOf(const FrameReport& report) {
    BudgetFrame frame;
    frame.time = report.time;
    frame.gaze = report.gaze;
    if (report.underGaze) frame.underGazeD = report.underGaze->value;
    frame.focusD = report.lens.lens.focus.value;
    frame.pupilMm = report.lens.apertureDiameter.value * 1e3;
    frame.plan = report.plan;
    frame.milliseconds = report.milliseconds;
    if (const auto& d = report.decision)
        frame.governed = BudgetFrame::Governed{d->change, d->why, report.foreseenMs, 1.0 - d->expectedError};
    return frame;
}

}  // namespace

void playBudget(FrameMaker& maker, double start, const std::function<bool()>& stopped, BudgetRun& run) {
    const Plan reference{TechniqueChoice::reference, {}, run.referenceSamples, {}};
    ProgressLine progress("frame", static_cast<std::size_t>(run.framesWanted));
    for (int i = 0; i < run.framesWanted && !stopped(); ++i) {
        FrameMaker::Input input;
        input.time = start + i / run.hz;
        input.budgetMilliseconds = run.budgetMs;
        if (i == 0) maker.warmUp(input, 1.0 / run.hz);
        BudgetFrame frame = noteOf(maker.make(input));
        // The last of each k, so that the first, which knows no price yet, is not the one that is judged.
        if (run.referenceEvery > 0 && (i + 1) % run.referenceEvery == 0) {
            const Image shown = maker.composed();
            frame.ssim = ssim(maker.pictureBy(reference, kMostSamples), shown);
            frame.picture = jpegDataUri(encodeJpeg(smaller(shown, kPictureWidth), kPictureQuality));
        }
        progress.update(static_cast<std::size_t>(i) + 1,
                        fmt::format("{:.1f} ms, {}", frame.milliseconds, planText(frame.plan)));
        run.frames.push_back(std::move(frame));
    }
}

void writeBudget(const BudgetRun& run, const std::filesystem::path& folder) {
    writeFileAtomically(folder / "frames.csv", budgetCsv(run));
    writeFileAtomically(folder / "budget.json", budgetJson(run));
    writeFileAtomically(folder / "index.html", budgetPage(run));
}

}  // namespace dioptre
