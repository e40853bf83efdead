#include "frame/budget_rows.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "frame/machine_json.hpp"

namespace dioptre {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kSchema = 1;

std::vector<std::pair<std::string, std::size_t>> histogram(const BudgetRun& run) {
    std::map<std::string, std::size_t> counts;
    for (const BudgetFrame& f : run.frames) ++counts[planText(f.plan)];
    std::vector<std::pair<std::string, std::size_t>> sorted(counts.begin(), counts.end());
    std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
    return sorted;
}

template <class T>
Json orNull(const std::optional<T>& value) {
    return value ? Json(*value) : Json(nullptr);
}

}  // namespace

std::string_view changeName(PlanChange change) {
    switch (change) {
        case PlanChange::none:
            return "none";
        case PlanChange::up:
            return "up";
        case PlanChange::down:
            return "down";
        case PlanChange::rested:
            return "rested";
        case PlanChange::resumed:
            return "resumed";
        case PlanChange::adapted:
            return "adapted";
    }
    return "";
}

BudgetSummary summaryOf(const BudgetRun& run) {
    BudgetSummary s;
    s.frames = run.frames.size();
    std::vector<double> milliseconds;
    double sum = 0.0;
    const BudgetFrame* before = nullptr;
    for (const BudgetFrame& f : run.frames) {
        milliseconds.push_back(f.milliseconds);
        if (run.missed(f)) ++s.missed;
        if (before && before->plan.technique != f.plan.technique) ++s.techniqueChanges;
        if (f.governed && f.governed->change != PlanChange::none)
            ++s.changes[std::string(changeName(f.governed->change))];
        if (f.ssim) {
            ++s.compared;
            sum += *f.ssim;
            s.worstSsim = std::min(s.worstSsim.value_or(*f.ssim), *f.ssim);
        }
        before = &f;
    }
    if (s.compared > 0) s.meanSsim = sum / static_cast<double>(s.compared);
    if (s.frames > 0) s.missedShare = static_cast<double>(s.missed) / static_cast<double>(s.frames);
    s.p50 = percentile(milliseconds, 0.5);
    s.p90 = percentile(milliseconds, 0.9);
    s.p99 = percentile(milliseconds, 0.99);
    s.most = percentile(milliseconds, 1.0);
    s.plans = histogram(run);
    return s;
}

std::string brokenLimits(const BudgetSummary& s, const BudgetLimits& limits) {
    std::string broken;
    if (limits.missedPercent && 100.0 * s.missedShare > *limits.missedPercent)
        broken = fmt::format("{:.3g} % of the frames missed the budget, --fail-missed allows {:g} %",
                             100.0 * s.missedShare, *limits.missedPercent);
    if (limits.meanSsim && !(s.meanSsim.value_or(-1.0) >= *limits.meanSsim)) {
        if (!broken.empty()) broken += "; ";
        broken += s.meanSsim ? fmt::format("the mean SSIM is {:.5f}", *s.meanSsim) : "no frame was compared";
        broken += fmt::format(", --fail-ssim asks for {:g}", *limits.meanSsim);
    }
    return broken;
}

std::string budgetJson(const BudgetRun& run) {
    const BudgetSummary s = summaryOf(run);
    const bool governed = !run.frames.empty() && run.frames.front().governed;
    Json plans = Json::object();
    for (const auto& [plan, count] : s.plans) plans[plan] = count;
    Json j = {{"schema", kSchema}};
    j.update(machineJson(run.with));
    j.update({{"scene", run.scene},
              {"width", run.size.width},
              {"height", run.size.height},
              {"eye", run.eye},
              {"display", run.display},
              {"technique", run.technique},
              {"head_trace", run.headTrace},
              {"gaze_trace", run.gazeTrace},
              {"hz", run.hz},
              {"frames", s.frames},
              {"frames_wanted", run.framesWanted},
              {"budget_ms", run.budgetMs},
              {"p50_ms", s.p50},
              {"p90_ms", s.p90},
              {"p99_ms", s.p99},
              {"max_ms", s.most},
              {"missed", s.missed},
              {"missed_share", s.missedShare},
              {"technique_changes", s.techniqueChanges},
              {"changes", governed ? Json(s.changes) : Json(nullptr)},
              {"reference_every", run.referenceEvery},
              {"reference_samples", run.referenceSamples},
              {"compared", s.compared},
              {"mean_ssim", orNull(s.meanSsim)},
              {"worst_ssim", orNull(s.worstSsim)},
              {"plans", plans}});
    // Names of files need not be UTF-8.
    return j.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string budgetCsv(const BudgetRun& run) {
    const auto or_ = [](const std::optional<double>& value, int digits) {
        return value ? fmt::format("{:.{}f}", *value, digits) : std::string();
    };
    std::string csv =
        "frame,t_s,plan,technique,samples,ms,budget_ms,missed,change,why,foreseen_ms,foreseen_ssim,ssim,focus_D,"
        "pupil_mm,gaze_x,gaze_y,gaze_valid,under_gaze_D\n";
    for (std::size_t i = 0; i < run.frames.size(); ++i) {
        const BudgetFrame& f = run.frames[i];
        csv += fmt::format("{},{:.6f},\"{}\",{},{},{:.3f},{:g},{},", i, f.time, planText(f.plan),
                           techniqueName(f.plan.technique), f.plan.samples ? fmt::format("{}", *f.plan.samples) : "",
                           f.milliseconds, run.budgetMs, run.missed(f) ? 1 : 0);
        csv += f.governed ? fmt::format("{},\"{}\",{:.3f},{:.5f},", changeName(f.governed->change), f.governed->why,
                                        f.governed->foreseenMs, f.governed->foreseenSsim)
                          : ",,,,";
        csv += fmt::format("{},{:.6f},{:.4f},{:.5f},{:.5f},{},{}\n", or_(f.ssim, 6), f.focusD, f.pupilMm,
                           f.gaze.position.x, f.gaze.position.y, f.gaze.valid ? 1 : 0, or_(f.underGazeD, 6));
    }
    return csv;
}

}  // namespace dioptre
