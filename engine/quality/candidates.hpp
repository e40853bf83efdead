// What the methods of drawing give in one view for a given price.
#pragma once

#include <optional>
#include <vector>

#include "quality/price_model.hpp"
#include "quality/requirements.hpp"
#include "quality/trade_table.hpp"

namespace dioptre {

/// Fewer samples than that are ghosts, not blur.
inline constexpr int kLeastSamples = 4;
inline constexpr int kMostSamples = 4096;

struct PricedPlan {
    Plan plan;
    double milliseconds = 0.0;
    double error = 1.0;  // expected 1 - SSIM
};

/// One view, its prices and errors.
class Candidates {
  public:
    /// All outlive it.
    Candidates(const PriceModel& prices, const ExpectedErrors& errors, const ViewClass& view,
               const Requirements& requirements);

    /// Whether a method may draw this view: where nothing is blurred, pinholes.
    bool allows(const Plan& method) const { return requirements_.blur || method.technique == TechniqueChoice::pinhole; }
    std::vector<Plan> methods() const;

    PricedPlan priced(const Plan& plan) const;
    /// The method with the most samples of which `margin` times the price is at most `limit` ms; none where the least
    /// are too dear.
    std::optional<PricedPlan> within(const Plan& method, double limit, double margin = 1.0,
                                     int leastSamples = kLeastSamples) const;
    /// Of what fits, the one with the least error; none where nothing does.
    std::optional<PricedPlan> best(double limit) const;
    /// The same of what fits even if it is as dear as its price is unsure.
    std::optional<PricedPlan> safest(double limit) const;
    /// What costs the least, whatever that is; each `hope` standard deviations cheaper than its price.
    PricedPlan cheapest(double hope = 0.0) const;
    /// The cheapest at full size that gives the view what it requires: a blur where there is one.
    Plan adequate() const;

    /// That the method, with its least samples, takes at most `limit` ms; 0..1.
    double chanceToFit(const Plan& method, double limit) const;
    /// exp(standard deviation) of the price.
    double unsure(const Plan& method) const;
    /// From so many samples on the reference is as close as the plan.
    int samplesToReach(const Plan& plan) const;

  private:
    const PriceModel& prices_;
    const ExpectedErrors& errors_;
    const ViewClass& view_;
    const Requirements& requirements_;
};

}  // namespace dioptre
