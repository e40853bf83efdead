// What a plan costs, in milliseconds of a finished frame: from the measured table first, then from what frames took.
//
// The price of one frame is a sum over its stages' work w_k, and every factor on it is learnt as its logarithm:
//   price = exp(x_load + x_technique + x_method) sum_k exp(x_k) c_k w_k
// c_k   fitted to the table (price_fit.hpp)
// x_k   per stage: triangles, fragments, fetches, passes
// x_load       what makes everything slower at once: another machine, another process
// x_technique, x_method   a relative price that the stages do not explain; remembered while others are drawn, so that
//                         a plan that was found too dear once is not found cheap again as soon as it is not drawn
// In logarithms a finished frame says, to first order,
//   log(measured / price) = sum_i h_i dx_i + noise,  h = 1 for load, technique and method, each stage's share for x_k
// which is one step of a Kalman filter (Kalman 1960, "A new approach to linear filtering and prediction problems"):
// what was unsure takes the blame, in proportion to its share. The load drifts; all else hardly does.
//
// A single frame far off its price says nothing (a spike); a second one in the same direction makes both believed.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "quality/plan.hpp"
#include "quality/price_fit.hpp"
#include "quality/trade_table.hpp"
#include "quality/view_class.hpp"

namespace dioptre {

class PriceModel {
  public:
    explicit PriceModel(const TradeTable& table);

    /// Milliseconds, > 0 and finite.
    double price(const Plan& plan, const ViewClass& view) const;

    /// How unsure the price is: standard deviation of its logarithm.
    double uncertainty(const Plan& plan, const ViewClass& view) const;

    /// Whether a clock could have measured that: not 0, negative or not finite, for one.
    static bool plausible(double milliseconds);

    /// A finished frame that drew these, for both eyes. Implausible times are ignored.
    void learn(std::span<const Plan> drawn, const ViewClass& view, double milliseconds);

    /// Whether the last frame was far off its price, and none before it in that direction.
    bool suspects() const { return suspicion_ != 0.0; }

    /// All that have a price: those of the table, and their smaller sizes.
    const std::vector<Plan>& methods() const { return methods_; }

    /// The factor on all prices, 1 as in the table.
    double load() const;

  private:
    /// h: what a relative change of each factor does to the price of these.
    std::vector<double> sensitivities(std::span<const Plan> plans, const ViewClass& view) const;
    std::vector<double> sensitivities(const Plan& plan, const ViewClass& view) const;
    double standardDeviation(std::span<const double> h) const;
    std::size_t indexOf(const Plan& plan) const;
    void drift(const Plan& drawn);
    void blame(std::size_t method, double jump);
    void correct(std::span<const double> h, double difference);

    struct Factor {
        double log = 0.0, prior = 0.0;  // x now; and where it returns to while nothing is heard of it
        double drift = 0.0;             // variance that a frame adds
        double most = 0.0;              // variance
        long frames = 0;                // of a method: in which it was drawn
    };
    Coefficients coefficients_;
    std::vector<Plan> methods_;
    std::vector<Factor> factors_;                  // load, stages, techniques, methods
    std::vector<std::vector<double>> covariance_;  // of their logarithms
    double suspicion_ = 0.0;                       // the last frame's difference, while it stands alone
    std::optional<Plan> drawn_;                    // method of the last frame
    int drawnFrames_ = 0;                          // in succession
    long sinceJump_ = 1000;                        // frames since the load was last seen to jump
};

}  // namespace dioptre
