#include "quality/offers.hpp"

#include <algorithm>
#include <cmath>

namespace dioptre {

namespace {

Plan withSamples(Plan method, double samples) {
    if (usesSamples(method.technique)) method.samples = static_cast<int>(samples);
    return method;
}

}  // namespace

Market::Market(const PriceModel& prices, const ExpectedErrors& errors, const ViewClass& view,
               const Requirements& requirements)
    : prices_(prices), errors_(errors), view_(view), requirements_(requirements) {}

bool Market::allows(const Plan& plan) const {
    return requirements_.blur || plan.technique == TechniqueChoice::pinhole;
}

std::vector<Plan> Market::methods() const {
    std::vector<Plan> allowed;
    for (const Plan& method : prices_.methods())
        if (allows(method)) allowed.push_back(method);
    // A table may have no pinhole.
    if (allowed.empty()) allowed.push_back(prices_.methods().front());
    return allowed;
}

Offer Market::offer(const Plan& plan) const {
    return {plan, prices_.price(plan, view_), errors_.of(plan)};
}

std::optional<Offer> Market::within(const Plan& method, double limit, double margin) const {
    const Plan least = withSamples(method, kLeastSamples);
    const double leastPrice = margin * prices_.price(least, view_);
    if (!(leastPrice <= limit)) return std::nullopt;
    if (!usesSamples(method.technique)) return offer(least);
    // Prices are affine in the number of samples.
    const double each = margin * prices_.price(withSamples(method, kLeastSamples + 1), view_) - leastPrice;
    const double most = std::min(kMostSamples, requirements_.mostSamples.value_or(kMostSamples));
    const double more = each > 0.0 ? std::floor((limit - leastPrice) / each) : most;
    return offer(withSamples(method, std::clamp(kLeastSamples + more, double{kLeastSamples}, most)));
}

std::optional<Offer> Market::safest(double limit) const {
    std::optional<Offer> best;
    for (const Plan& method : methods())
        if (const auto offer = within(method, limit, unsure(method)); offer && (!best || offer->error < best->error))
            best = offer;
    return best;
}

Offer Market::cheapest() const {
    std::optional<Offer> cheapest;
    for (const Plan& method : methods()) {
        const Offer least = offer(withSamples(method, kLeastSamples));
        if (!cheapest || least.milliseconds < cheapest->milliseconds) cheapest = least;
    }
    return *cheapest;
}

Plan Market::adequate() const {
    std::optional<Offer> cheapest;
    for (const Plan& method : methods()) {
        if (method.eighths != 8 || (requirements_.blur && method.technique == TechniqueChoice::pinhole)) continue;
        const Offer least = offer(withSamples(method, kLeastSamples));
        if (!cheapest || least.milliseconds < cheapest->milliseconds) cheapest = least;
    }
    return cheapest ? cheapest->plan : this->cheapest().plan;
}

double Market::unsure(const Plan& method) const {
    return std::exp(prices_.uncertainty(withSamples(method, kLeastSamples), view_));
}

int Market::samplesToReach(const Plan& plan) const {
    const double error = errors_.of(plan);
    Plan reference{TechniqueChoice::reference, {}, kLeastSamples, {}};
    while (*reference.samples < kMostSamples && errors_.of(reference) > error)
        reference.samples = std::max(*reference.samples + 1, *reference.samples * 9 / 8);
    return std::min(*reference.samples, kMostSamples);
}

}  // namespace dioptre
