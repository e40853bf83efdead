#include "quality/plan.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace dioptre {

std::vector<std::pair<std::string_view, int>> Plan::dials() const {
    std::vector<std::pair<std::string_view, int>> list;
    if (msaa) list.emplace_back("msaa", *msaa);
    if (samples) list.emplace_back("samples", *samples);
    if (subsamples) list.emplace_back("subsamples", *subsamples);
    return list;
}

std::string_view techniqueName(TechniqueChoice choice) {
    switch (choice) {
        case TechniqueChoice::pinhole:
            return "pinhole";
        case TechniqueChoice::mipmap:
            return "mipmap";
        case TechniqueChoice::accumulate:
            return "accumulate";
        case TechniqueChoice::reference:
            return "reference";
    }
    return "";
}

std::optional<TechniqueChoice> techniqueNamed(std::string_view name) {
    for (const TechniqueChoice choice : kTechniques)
        if (techniqueName(choice) == name) return choice;
    return std::nullopt;
}

int defaultSamples(TechniqueChoice choice) {
    // As published: [HA90] as Lee, Eisemann, Seidel 2009 use it, [JKLL13]
    constexpr int kReference = 512, kAccumulate = 32;
    return choice == TechniqueChoice::accumulate ? kAccumulate : kReference;
}

int samplesInTime(int before, double tookMs, double budgetMs, int most) {
    constexpr double kMostChange = 2.0, kLeastMs = 1e-3;
    const double change = std::clamp(budgetMs / std::max(tookMs, kLeastMs), 1.0 / kMostChange, kMostChange);
    return std::clamp(static_cast<int>(before * change), 1, most);
}

bool usesMsaa(TechniqueChoice choice) {
    return choice == TechniqueChoice::pinhole || choice == TechniqueChoice::mipmap;
}

bool usesSamples(TechniqueChoice choice) {
    return choice == TechniqueChoice::accumulate || choice == TechniqueChoice::reference;
}

double detailPx(const Plan& plan) {
    return std::max(0, 4 - plan.eighths);
}

bool usesLevels(const Plan& plan) {
    return plan.technique == TechniqueChoice::accumulate || detailPx(plan) > 0.0;
}

bool maySize(const Plan& plan) {
    return usesMsaa(plan.technique) && plan.msaa == 0;
}

std::optional<Plan> planOf(const RenderSettings& settings) {
    std::optional<TechniqueChoice> technique = settings.technique;
    if (!technique && settings.show.stage != ShowChoice::none)
        technique = settings.show.stage == ShowChoice::lod ? TechniqueChoice::accumulate : TechniqueChoice::mipmap;
    if (!technique) return std::nullopt;
    Plan plan{*technique, {}, {}, {}};
    if (usesMsaa(plan.technique)) plan.msaa = settings.msaa;
    if (usesSamples(plan.technique)) plan.samples = settings.samples.value_or(defaultSamples(plan.technique));
    if (plan.technique == TechniqueChoice::accumulate) plan.subsamples = settings.subsamples;
    return plan;
}

std::string planText(const Plan& plan) {
    std::string text(techniqueName(plan.technique));
    if (plan.msaa) text += fmt::format(", msaa {}", *plan.msaa);
    if (plan.samples) text += fmt::format(", {} samples", *plan.samples);
    if (plan.subsamples) text += fmt::format(", {} sub-samples each", *plan.subsamples);
    if (plan.eighths != 8) text += fmt::format(", {}/8 size", plan.eighths);
    return text;
}

Plan methodOf(Plan plan) {
    plan.samples.reset();
    return plan;
}

}  // namespace dioptre
