// dioptre budget: a headless run along head and gaze traces against a frame budget.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "commands.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "core/log.hpp"
#include "core/resources.hpp"
#include "frame/budget_run.hpp"
#include "frame/measure.hpp"
#include "gl/context.hpp"
#include "interrupt.hpp"
#include "scene/lod.hpp"

namespace dioptre {

namespace {

constexpr int kFrames = 300, kMostFrames = 1000000;
constexpr int kCompared = 10;  // frames, where nobody says

void lookAround(FocusSettings& focus) {
    focus.headTrace = resource("assets/traces/seated.head.csv");
    focus.gazeTrace = resource("assets/traces/seated.gaze.csv");
}

/// As long as the longer trace plays from `start` on.
int framesOf(const FocusSettings& focus, double start, double hz) {
    double end = start;
    if (!focus.headTrace.empty()) end = std::max(end, readHeadTrace(focus.headTrace).back().time);
    if (!focus.gazeTrace.empty()) end = std::max(end, readGazeTrace(focus.gazeTrace).back().time);
    // Traces of one sample hold something still, they do not end.
    if (end <= start) return kFrames;
    return static_cast<int>(std::min(std::floor((end - start) * hz) + 1.0, 1.0 * kMostFrames));
}

std::string textOf(const Settings& settings, std::string_view name) {
    for (const Setting& setting : settingsTable())
        if (setting.name == name) return setting.get(settings, setting);
    return {};
}

BudgetRun runOf(const Command& command, const Settings& settings) {
    const BudgetOptions& options = command.budget;
    BudgetRun run;
    run.size = settings.view.size;
    run.eye = textOf(settings, "eye");
    run.display = textOf(settings, "display");
    const std::optional<Plan> held = planOf(settings.render);
    run.technique = held ? planText(*held) : "auto";
    run.headTrace = settings.focus.headTrace;
    run.gazeTrace = settings.focus.gazeTrace;
    run.budgetMs = *settings.render.budgetMs;
    run.hz = *options.hz;
    run.framesWanted = options.frames ? *options.frames : framesOf(settings.focus, settings.view.time, run.hz);
    run.referenceEvery = options.referenceEvery.value_or(std::max(1, run.framesWanted / kCompared));
    run.referenceSamples = options.referenceSamples;
    if (run.referenceEvery > run.framesWanted)
        throw InputError(fmt::format("--reference-every: {} is more than the run's {} frames, none would be compared",
                                     run.referenceEvery, run.framesWanted));
    return run;
}

std::string resultText(const BudgetRun& run, const BudgetSummary& s) {
    std::string text = fmt::format("{} frames, {:.3g} % longer than {:g} ms; median {:.3g} ms, 99 % {:.3g} ms",
                                   s.frames, 100.0 * s.missedShare, run.budgetMs, s.p50, s.p99);
    if (s.meanSsim) text += fmt::format("; SSIM {:.4f}, at worst {:.4f}", *s.meanSsim, *s.worstSsim);
    return text;
}

}  // namespace

void runBudget(const Command& command) {
    Settings settings = command.settings;
    if (command.budget.looksAround) lookAround(settings.focus);
    BudgetRun run = runOf(command, settings);
    Scene scene = loadScene(command);
    const auto context = openHeadlessContext(command);
    FrameMaker maker(scene, settings);
    makeFolder(command.out, "--out");
    if (maker.mayUseLevels()) maker.addLevels(buildLevels(scene, {lodFolder()}));
    scene.releaseBulk();
    run.scene = scene.name;
    run.with = measuredHere();
    run.with.program = programVersion();
    run.with.commit = sourceCommit();
    run.with.context = contextName(command);

    watchInterrupts();
    const auto write = [&] {
        if (run.frames.empty()) return;
        writeBudget(run, command.out);
        logInfo(
            fmt::format("{}; to look at: {}", resultText(run, summaryOf(run)), (command.out / "index.html").string()));
    };
    try {
        playBudget(maker, settings.view.time, interrupted, run);
    } catch (...) {
        // What was finished is kept.
        write();
        throw;
    }
    write();
    if (run.frames.size() < static_cast<std::size_t>(run.framesWanted))
        throw RunError(fmt::format("stopped with {} of {} frames drawn", run.frames.size(), run.framesWanted));
    const BudgetLimits limits{command.budget.failMissed, command.budget.failSsim};
    if (const std::string broken = brokenLimits(summaryOf(run), limits); !broken.empty()) throw RunError(broken);
}

}  // namespace dioptre
