// What the governor is worth: frames inside the budget and their error, against every fixed plan that keeps as many; and
// how seen its changes are.
//
//   bench_governor [CASE...]      cases SCENE:MS, default studio:30 studio:60 studio:120 studio:400 toys:200 toys:400
//   bench_governor sizes          what smaller pictures lose, without levels of detail and with those they are drawn with
//   bench_governor switches       frame-to-frame SSIM through changes of plan, against the reference's over the same motion
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bench_common.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "core/resources.hpp"
#include "core/text.hpp"
#include "frame/frame_maker.hpp"
#include "frame/measure_frames.hpp"
#include "frame/measure_lens.hpp"
#include "gl/context.hpp"
#include "metrics/metrics.hpp"
#include "quality/trade_table.hpp"
#include "scene/builtin.hpp"
#include "scene/lod.hpp"

namespace dioptre {
namespace {

constexpr int kSettling = 10;  // frames, not counted: after the step from nothing
constexpr int kFrames = 60, kCompared = 10;
constexpr int kReferenceSamples = 128;

struct Stage {
    Scene scene;
    std::vector<BuiltLevel> levels;

    explicit Stage(const std::string& name)
        : scene(loadBuiltin(name, cacheFolder())), levels(buildLevels(scene, {lodFolder()})) {}
};

Settings settingsFor(const std::optional<Plan>& plan) {
    Settings s;
    s.focus.headTrace = resource("assets/traces/seated.head.csv");
    s.focus.gazeTrace = resource("assets/traces/seated.gaze.csv");
    if (!plan) return s;
    s.render.technique = plan->technique;
    if (plan->msaa) s.render.msaa = *plan->msaa;
    s.render.samples = plan->samples;
    if (plan->subsamples) s.render.subsamples = *plan->subsamples;
    return s;
}

struct Run {
    std::vector<double> milliseconds;
    double inside = 0.0, used = 0.0, meanSsim = 0.0;
    int changes = 0;
    std::vector<std::string> methods;
};

/// Plays the trace; `references` of the compared frames are drawn where they are missing.
Run play(const Stage& stage, const std::optional<Plan>& plan, double budget, std::vector<Image>& references) {
    FrameMaker maker(stage.scene, settingsFor(plan));
    maker.addLevels(stage.levels);
    Run run;
    double ssimSum = 0.0;
    int compared = 0;
    for (int i = 0; i < kSettling + kFrames; ++i) {
        FrameMaker::Input input;
        input.time = i * budget * 1e-3;
        input.budgetMilliseconds = budget;
        if (i == 0) maker.warmUp(input, budget * 1e-3);
        const FrameReport& report = maker.make(input);
        const std::string method = planText(methodOf(report.plan));
        if (run.methods.empty() || run.methods.back() != method) run.methods.push_back(method);
        if (report.decision && report.decision->change == PlanChange::up) ++run.changes;
        if (i < kSettling) continue;
        run.milliseconds.push_back(report.milliseconds);
        if ((i - kSettling) % kCompared != 0) continue;
        const auto at = static_cast<std::size_t>((i - kSettling) / kCompared);
        if (at == references.size())
            references.push_back(
                maker.pictureBy({TechniqueChoice::reference, {}, kReferenceSamples, {}}, kMostSamples));
        ssimSum += ssim(maker.composed(), references[at]);
        ++compared;
    }
    for (const double ms : run.milliseconds) {
        run.inside += ms <= budget ? 1.0 / kFrames : 0.0;
        run.used += ms / budget / kFrames;
    }
    run.meanSsim = ssimSum / compared;
    return run;
}

/// The most samples with which frames of the trace's first second fit, by a straight line through two numbers of samples.
int samplesThatFit(const Stage& stage, Plan plan, double budget) {
    double at[2] = {};
    const int samples[2] = {4, 16};
    for (int k = 0; k < 2; ++k) {
        plan.samples = samples[k];
        FrameMaker maker(stage.scene, settingsFor(plan));
        maker.addLevels(stage.levels);
        std::vector<double> times;
        for (int i = 0; i < 7; ++i) {
            FrameMaker::Input input;
            input.time = 0.15 * i;
            const double ms = maker.make(input).milliseconds;
            if (i > 0) times.push_back(ms);
        }
        at[k] = median(times);
    }
    const double each = std::max(1e-3, (at[1] - at[0]) / (samples[1] - samples[0]));
    return static_cast<int>((0.93 * budget - at[0]) / each) + samples[0];
}

void judge(const std::string& name, double budget) {
    const Stage stage(name);
    std::vector<Image> references;
    const Run governed = play(stage, std::nullopt, budget, references);
    fmt::print(
        "{}, {:g} ms\n  auto: {:.1f} % inside, {:.0f} % of the budget used, SSIM {:.4f}, {} upward changes; {}\n", name,
        budget, 100.0 * governed.inside, 100.0 * governed.used, governed.meanSsim, governed.changes,
        fmt::join(governed.methods, " > "));
    std::vector<Plan> fixed;
    for (const TechniqueChoice choice : {TechniqueChoice::pinhole, TechniqueChoice::mipmap})
        for (const int msaa : {0, 4}) fixed.push_back({choice, msaa, {}, {}});
    for (Plan plan : {Plan{TechniqueChoice::accumulate, {}, {}, 0}, Plan{TechniqueChoice::accumulate, {}, {}, 4},
                      Plan{TechniqueChoice::accumulate, {}, {}, 8}, Plan{TechniqueChoice::reference, {}, {}, {}}}) {
        plan.samples = samplesThatFit(stage, plan, budget);
        if (*plan.samples >= 2) fixed.push_back(plan);
    }
    std::optional<double> best;
    std::string bestPlan;
    double foreign = 0.0;
    for (Plan plan : fixed) {
        Run run = play(stage, plan, budget, references);
        // A plan that hardly misses may do with a few samples less.
        for (int tries = 0; tries < 3 && run.inside < governed.inside && plan.samples && *plan.samples > 4; ++tries) {
            plan.samples = *plan.samples * 17 / 20;
            run = play(stage, plan, budget, references);
        }
        fmt::print("  {:42} {:.1f} % inside, SSIM {:.4f}, median {:.1f} ms\n", planText(plan), 100.0 * run.inside,
                   run.meanSsim, median(run.milliseconds));
        std::fflush(stdout);
        // One picture's work hardly varies: what is far above its median was somebody else's.
        if (plan.technique == TechniqueChoice::pinhole) {
            const double usual = median(run.milliseconds);
            foreign =
                std::max(foreign, static_cast<double>(std::count_if(run.milliseconds.begin(), run.milliseconds.end(),
                                                                    [&](double ms) { return ms > 1.25 * usual; })) /
                                      kFrames);
        }
        if (run.inside < governed.inside || (best && *best >= run.meanSsim)) continue;
        best = run.meanSsim;
        bestPlan = planText(plan);
    }
    fmt::print("  foreign load: {:.1f} % of a pinhole's frames took 1.25 times their median\n", 100.0 * foreign);
    if (best)
        fmt::print("  best fixed plan that keeps as many: {}, SSIM {:.4f}; margin {:+.4f}\n", bestPlan, *best,
                   governed.meanSsim - *best);
    else
        fmt::print("  no fixed plan keeps as many\n");
    std::fflush(stdout);
}

/// 1 - SSIM beyond that of the whole size, against 200 points of the lens; `sharp`: without blur, the best that
/// fits all views as quality/trade_table.cpp has it.
void sizes() {
    constexpr int kSizes[] = {7, 6, 5, 4, 3, 2};
    fmt::print("mipmap, msaa 0, 640x480; by eighths of the size\n{:34} {:>8}", "", "CoC, px");
    for (const int eighths : kSizes) fmt::print("{:>7}", eighths);
    fmt::print("\n");
    for (const bool levels : {false, true}) {
        std::map<int, double> sharp, weights;
        for (const char* name : {"studio", "toys"}) {
            const Stage stage(name);
            for (const double diameterMm : {3.0, 8.0}) {
                for (const double metres : {0.7, 1.5, 3.0}) {
                    Settings s;
                    s.view.eye = EyeChoice::centre;
                    s.lens.apertureMm = diameterMm;
                    s.focus.focus = {FocusMode::metres, metres};
                    s.render.technique = TechniqueChoice::mipmap;
                    FrameMaker maker(stage.scene, s);
                    if (levels) maker.addLevels(stage.levels);
                    const FrameReport& report = maker.make({});
                    const Image reference = maker.pictureBy({TechniqueChoice::reference, {}, 200, {}}, 0);
                    const Plan plan{TechniqueChoice::mipmap, 0, {}, {}};
                    const double whole = ssim(maker.pictureBy(plan, 0), reference);
                    const View& view = maker.eyeViews().front();
                    const Lens& lens = report.lens.lens;
                    const double off = visibleVergences(maker.scene(), view).meanDifference(lens.focus.value);
                    const double coc = 2.0 * std::abs(cocRadiusPixels(lens, focalLengthPixels(view).x,
                                                                      Dioptres(lens.focus.value + off)));
                    fmt::print("{:6} {} levels, {:g} mm, {:3g} m {:8.1f}", name, levels ? "with   " : "without",
                               diameterMm, metres, coc);
                    for (const int eighths : kSizes) {
                        Plan smaller = plan;
                        smaller.eighths = eighths;
                        const double lost = whole - ssim(maker.pictureBy(smaller, 0), reference);
                        const double seen = scaleSeen(eighths, coc);
                        sharp[eighths] += lost * seen;
                        weights[eighths] += seen * seen;
                        fmt::print("{:7.3f}", lost);
                    }
                    fmt::print("\n");
                    std::fflush(stdout);
                }
            }
        }
        fmt::print("sharp, {} levels                      ", levels ? "with   " : "without");
        for (const int eighths : kSizes) fmt::print("{:7.3f}", sharp[eighths] / weights[eighths]);
        fmt::print("\n");
    }
}

/// A slow dolly while budgets come and go. A technique that flickers by itself does so in every frame: what a change adds
/// is the dip of the frames after it beyond the usual dip of the plans on both sides.
void switches() {
    const Stage stage("studio");
    Settings s;
    s.view.size = {320, 240};
    s.view.eye = EyeChoice::centre;
    s.focus.focus = {FocusMode::metres, 0.8};
    FrameMaker maker(stage.scene, s);
    maker.addLevels(stage.levels);
    struct Frame {
        std::string method, from;  // in a fade
        double dip = 0.0;
        bool changed = false;
    };
    std::vector<Frame> frames;
    Image before, referenceBefore;
    for (int i = 0; i < 180; ++i) {
        FrameMaker::Input input;
        input.time = i / 60.0;
        input.budgetMilliseconds = i < 50 ? 60.0 : i < 100 ? 300.0 : i < 140 ? 30.0 : 500.0;
        input.head = Pose{{0.0, 0.0, -0.001 * i}, {1.0, 0.0, 0.0, 0.0}};
        const FrameReport& report = maker.make(input);
        const Image now = maker.composed();
        const Image reference = maker.pictureBy({TechniqueChoice::reference, {}, kReferenceSamples, {}}, kMostSamples);
        Frame frame{planText(methodOf(report.plan)), {}, 0.0, false};
        if (report.decision->fade) frame.from = planText(methodOf(report.decision->fade->from));
        if (i > 0) {
            frame.dip = ssim(reference, referenceBefore) - ssim(now, before);
            frame.changed = frame.method != frames.back().method || !frame.from.empty();
        }
        frames.push_back(frame);
        before = now;
        referenceBefore = reference;
    }
    const auto usual = [&](const std::string& method) {
        std::vector<double> dips;
        for (const Frame& frame : frames)
            if (frame.method == method) dips.push_back(frame.dip);
        return median(dips);
    };
    // 100 ms of melting, and the frame itself
    constexpr std::size_t kAfter = 7;
    double worst = 0.0, worstUsual = 0.0;
    for (std::size_t i = 1; i < frames.size(); ++i) {
        if (!frames[i].changed) continue;
        const std::string& from = frames[i].from.empty() ? frames[i - 1].method : frames[i].from;
        const double own = std::max({0.0, usual(from), usual(frames[i].method)});
        double dip = -1.0;
        for (std::size_t k = i; k < std::min(frames.size(), i + kAfter); ++k) dip = std::max(dip, frames[k].dip);
        if (frames[i].method != frames[i - 1].method)
            fmt::print("  frame {:3}: {} to {}: dip {:+.4f}, usual {:+.4f}\n", i, frames[i - 1].method,
                       frames[i].method, dip, own);
        worst = std::max(worst, dip - own);
        worstUsual = std::max(worstUsual, own);
    }
    fmt::print("frame-to-frame SSIM below the reference's: by a change at most {:.4f}, without one up to {:.4f}\n",
               worst, worstUsual);
}

}  // namespace
}  // namespace dioptre

int main(int argc, char** argv) try {
    using namespace dioptre;
    const auto context = createHeadlessContext("auto");
    std::vector<std::string> cases(argv + 1, argv + argc);
    if (cases.empty()) cases = {"studio:30", "studio:60", "studio:120", "studio:400", "toys:200", "toys:400"};
    for (const std::string& which : cases) {
        if (which == "sizes") {
            sizes();
            continue;
        }
        if (which == "switches") {
            switches();
            continue;
        }
        const std::size_t colon = which.find(':');
        const auto budget = colon == std::string::npos ? std::nullopt : parseNumber(which.substr(colon + 1));
        if (!budget) throw InputError(which + " is no case, SCENE:MS");
        judge(which.substr(0, colon), *budget);
    }
    return 0;
} catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
}
