#include "quality/candidates.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dioptre {

namespace {

Plan withSamples(Plan method, double samples) {
    if (usesSamples(method.technique)) method.samples = static_cast<int>(samples);
    return method;
}

}  // namespace

Candidates::Candidates(const PriceModel& prices, const ExpectedErrors& errors, const ViewClass& view,
                       const Requirements& requirements)
    : prices_(prices), errors_(errors), view_(view), requirements_(requirements) {}

std::vector<Plan> Candidates::methods() const {
    std::vector<Plan> allowed;
    for (const Plan& method : prices_.methods())
        if (allows(method)) allowed.push_back(method);
    // A table may have no pinhole.
    if (allowed.empty()) allowed.push_back(prices_.methods().front());
    return allowed;
}

PricedPlan Candidates::priced(const Plan& plan) const {
    return {plan, prices_.price(plan, view_), errors_.of(plan)};
}

std::optional<PricedPlan> Candidates::within(const Plan& method, double limit, double margin, int leastSamples) const {
    const Plan least = withSamples(method, leastSamples);
    const double leastPrice = margin * prices_.price(least, view_);
    if (!(leastPrice <= limit)) return std::nullopt;
    if (!usesSamples(method.technique)) return priced(least);
    // Prices are affine in the number of samples.
    const double each = margin * prices_.price(withSamples(method, leastSamples + 1), view_) - leastPrice;
    constexpr double most = kMostSamples;
    const double more = each > 0.0 ? std::floor((limit - leastPrice) / each) : most;
    return priced(withSamples(method, std::clamp(leastSamples + more, double(leastSamples), most)));
}

std::optional<PricedPlan> Candidates::best(double limit) const {
    std::optional<PricedPlan> best;
    for (const Plan& method : methods())
        if (const auto found = within(method, limit); found && (!best || found->error < best->error)) best = found;
    return best;
}

std::optional<PricedPlan> Candidates::safest(double limit) const {
    std::optional<PricedPlan> best;
    for (const Plan& method : methods())
        if (const auto found = within(method, limit, unsure(method)); found && (!best || found->error < best->error))
            best = found;
    return best;
}

PricedPlan Candidates::cheapest(double hope) const {
    std::optional<PricedPlan> cheapest;
    double leastHoped = std::numeric_limits<double>::infinity();
    for (const Plan& method : methods()) {
        const PricedPlan least = priced(withSamples(method, kLeastSamples));
        const double hoped = least.milliseconds * std::pow(unsure(method), -hope);
        if (cheapest && hoped >= leastHoped) continue;
        cheapest = least;
        leastHoped = hoped;
    }
    return *cheapest;
}

Plan Candidates::adequate() const {
    std::optional<PricedPlan> cheapest;
    for (const Plan& method : methods()) {
        if (method.eighths != 8 || (requirements_.blur && method.technique == TechniqueChoice::pinhole)) continue;
        const PricedPlan least = priced(withSamples(method, kLeastSamples));
        if (!cheapest || least.milliseconds < cheapest->milliseconds) cheapest = least;
    }
    return cheapest ? cheapest->plan : this->cheapest().plan;
}

double Candidates::chanceToFit(const Plan& method, double limit) const {
    const Plan least = withSamples(method, kLeastSamples);
    const double deviation = std::max(prices_.uncertainty(least, view_), 1e-6);
    return 0.5 * std::erfc(std::log(prices_.price(least, view_) / limit) / (deviation * std::sqrt(2.0)));
}

double Candidates::unsure(const Plan& method) const {
    return std::exp(prices_.uncertainty(withSamples(method, kLeastSamples), view_));
}

int Candidates::samplesToReach(const Plan& plan) const {
    const double error = errors_.of(plan);
    Plan reference{TechniqueChoice::reference, {}, kLeastSamples, {}};
    while (*reference.samples < kMostSamples && errors_.of(reference) > error)
        reference.samples = std::max(*reference.samples + 1, *reference.samples * 9 / 8);
    // Fewer would not antialias as well, whatever their blur
    return std::clamp(*reference.samples, kAntialiasingSamples, kMostSamples);
}

}  // namespace dioptre
