// index.html of `dioptre budget`: budget.json with the frames, for assets/pages/budget.html.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "frame/budget_rows.hpp"
#include "frame/report_page.hpp"

namespace dioptre {

namespace {

using Json = nlohmann::ordered_json;

// A page of some MB opens at once everywhere.
constexpr std::size_t kMostPictures = 240;

/// As many digits as a page shows.
Json shortened(double value, int digits) {
    const double scale = std::pow(10.0, digits);
    return std::isfinite(value) ? Json(std::round(value * scale) / scale) : Json(nullptr);
}

/// Distinct things by the order of their first use.
template <class Key>
class Numbering {
  public:
    std::size_t operator()(const Key& key) {
        const auto index = static_cast<std::size_t>(std::find(keys.begin(), keys.end(), key) - keys.begin());
        if (index == keys.size()) keys.push_back(key);
        return index;
    }
    std::vector<Key> keys;
};

}  // namespace

std::string budgetPage(const BudgetRun& run) {
    Json data = Json::parse(budgetJson(run));
    Numbering<Plan> plans;
    Numbering<std::string_view> reasons;
    Json rows = Json::array(), pictures = Json::object();
    const auto shown = static_cast<std::size_t>(
        std::count_if(run.frames.begin(), run.frames.end(), [](const BudgetFrame& f) { return !f.picture.empty(); }));
    const std::size_t everyPicture = std::max<std::size_t>(1, (shown + kMostPictures - 1) / kMostPictures);
    std::size_t seen = 0;
    for (const BudgetFrame& f : run.frames) {
        const auto& g = f.governed;
        rows.push_back({shortened(f.time, 4), plans(f.plan), shortened(f.milliseconds, 2),
                        f.ssim ? shortened(*f.ssim, 5) : Json(nullptr), shortened(f.focusD, 3), f.gaze.valid ? 1 : 0,
                        shortened(f.gaze.position.x, 3), shortened(f.gaze.position.y, 3),
                        g ? Json(changeName(g->change)) : Json(nullptr), g ? Json(reasons(g->why)) : Json(nullptr),
                        g ? shortened(g->foreseenMs, 2) : Json(nullptr)});
        if (!f.picture.empty() && seen++ % everyPicture == 0) pictures[std::to_string(rows.size() - 1)] = f.picture;
    }
    Json list = Json::array();
    for (const Plan& plan : plans.keys)
        list.push_back({{"text", planText(plan)},
                        {"technique", techniqueName(plan.technique)},
                        {"method", planText(methodOf(plan))},
                        {"samples", plan.samples ? Json(*plan.samples) : Json(nullptr)}});
    data["columns"] = {"t", "plan", "ms", "ssim", "focus", "valid", "x", "y", "change", "why", "foreseen"};
    data["rows"] = std::move(rows);
    data["list"] = std::move(list);
    data["reasons"] = reasons.keys;
    data["pictures"] = std::move(pictures);
    return ReportPage("budget").with(data.dump(-1, ' ', true));
}

}  // namespace dioptre
