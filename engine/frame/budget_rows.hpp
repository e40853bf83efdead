// What `dioptre budget` writes down, and the arithmetic on it. No GL.
//
// budget.json, schema 1. All keys are always there; null is what was not measured.
//   schema, program, commit, renderer, version, context, cpu, cores, memory_bytes, system, date, load: as in trade.json
//   scene, width, height (of ONE eye), eye, display, head_trace, gaze_trace
//   technique     "auto", or the plan that was held
//   hz            of the moments: frame i is i / hz seconds after the first, however long it took
//   frames, frames_wanted: fewer where the run was stopped
//   budget_ms     of a frame, all eyes
//   p50_ms, p90_ms, p99_ms, max_ms: finished frames, by a monotonic clock
//   missed, missed_share (0..1): frames that took longer than the budget
//   technique_changes: frames drawn by another technique than the frame before
//   changes       {"up": frames}: what the governor did, PlanChange; null without it
//   reference_every, reference_samples, compared: frames that were compared with the reference
//   mean_ssim, worst_ssim: of these, on sRGB, as metrics/metrics.hpp has it
//   plans         {"mipmap, msaa 4": frames}, the most frequent first
// frames.csv has a line for each frame, budgetCsv().
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/settings.hpp"
#include "focus/traces.hpp"
#include "frame/measure_rows.hpp"
#include "quality/governor.hpp"

namespace dioptre {

struct BudgetFrame {
    /// What the governor said of it.
    struct Governed {
        PlanChange change = PlanChange::none;
        std::string_view why;  // a literal
        double foreseenMs = 0.0;
        double foreseenSsim = 0.0;
    };
    double time = 0.0;  // seconds
    GazeSample gaze;
    std::optional<double> underGazeD;
    double focusD = 0.0, pupilMm = 0.0;  // DIAMETER
    Plan plan;                           // that was shown
    double milliseconds = 0.0;
    std::optional<Governed> governed;  // none where a plan was held
    std::optional<double> ssim;        // against the reference
    std::string picture;               // "data:image/jpeg;base64,..." of a frame that was compared; empty: none
};

struct BudgetRun {
    MeasuredWith with;  // program and machine
    std::string scene;
    PictureSize size;  // of one eye
    std::string eye, display, technique, headTrace, gazeTrace;
    double budgetMs = 0.0, hz = 0.0;  // > 0
    int framesWanted = 0;
    int referenceEvery = 0, referenceSamples = 0;  // every 0: no frame was compared
    std::vector<BudgetFrame> frames;

    bool missed(const BudgetFrame& frame) const { return frame.milliseconds > budgetMs; }
};

/// "up"
std::string_view changeName(PlanChange change);

struct BudgetSummary {
    double p50 = 0.0, p90 = 0.0, p99 = 0.0, most = 0.0;  // milliseconds
    std::size_t frames = 0, missed = 0, compared = 0, techniqueChanges = 0;
    double missedShare = 0.0;                                // 0..1
    std::optional<double> meanSsim, worstSsim;               // none where nothing was compared
    std::vector<std::pair<std::string, std::size_t>> plans;  // frames of each, most frequent first
    std::map<std::string, std::size_t> changes;              // but for none; empty without a governor
};
BudgetSummary summaryOf(const BudgetRun& run);

/// What a run must keep; none: anything goes.
struct BudgetLimits {
    std::optional<double> missedPercent;  // at most
    std::optional<double> meanSsim;       // at least
};
/// What was not kept, as one line; empty where all was. An SSIM that was not measured is not kept.
std::string brokenLimits(const BudgetSummary& summary, const BudgetLimits& limits);

std::string budgetJson(const BudgetRun& run);
/// frame, t_s, plan, technique, samples, ms, budget_ms, missed, change, why, foreseen_ms, foreseen_ssim, ssim, focus_D,
/// pupil_mm, gaze_x, gaze_y, gaze_valid, under_gaze_D; empty where there is none.
std::string budgetCsv(const BudgetRun& run);
/// index.html: everything in one file, without a network. RunError: the installation is incomplete.
std::string budgetPage(const BudgetRun& run);

}  // namespace dioptre
