// For tests of the governor: a small table, and a renderer without pictures. What its frames take is hidden from who
// plans them.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>

#include "quality/plan.hpp"
#include "quality/trade_table.hpp"
#include "quality/view_class.hpp"

namespace dioptre {

inline const TradeTable& table() {
    static const TradeTable small = readTradeTable(DIOPTRE_TEST_DATA "/trade_small.json");
    return small;
}

class SimulatedRenderer {
  public:
    explicit SimulatedRenderer(unsigned seed) : random_(seed) {
        // About what the small table was measured on, each part off by up to 2.5 either way
        triangle_ = 3e-5 * off(2.5);
        fragment_ = 1e-4 * off(2.5);
        fetch_ = 3e-6 * off(2.5);
        pass_ = 0.05 * off(10.0);
        msaaShare_ = std::uniform_real_distribution(0.05, 1.0)(random_);
        for (double& factor : technique_) factor = off(1.6);
        for (double& factor : subsample_) factor = off(1.3);
        speed_ = off(20.0);
    }

    /// A factor of up to `most` either way, evenly in its logarithm.
    double off(double most) {
        return std::exp(std::uniform_real_distribution(-std::log(most), std::log(most))(random_));
    }

    double noise = 0.1;         // evenly, to either side
    double spikeShare = 0.003;  // of the frames
    double spike = 4.0;         // times as long
    double load = 1.0;          // on everything

    /// Milliseconds without noise and spikes.
    double cost(const Plan& plan, const ViewClass& view) const {
        const double n = plan.samples.value_or(1), scale = plan.eighths / 8.0;
        const double pixels = view.pixels * scale * scale;
        const double msaa = 1.0 + msaaShare_ * std::max(plan.msaa.value_or(0) - 1, 0);
        double sum = triangle_ * std::pow(view.triangles, 0.97) * n * std::sqrt(msaa) + fragment_ * pixels * n * msaa;
        if (plan.technique == TechniqueChoice::mipmap) sum += 20.0 * fetch_ * pixels + 12.0 * pass_;
        if (usesSamples(plan.technique)) sum += fetch_ * pixels * n + pass_ * std::ceil(n / 4.0);
        const int s = plan.subsamples.value_or(0);
        if (s > 0) sum += fetch_ * pixels * n * (6.0 + 3.0 * s) * subsample_[s / 4 % 3];
        sum += pass_;
        return sum * technique_[static_cast<std::size_t>(plan.technique)] * speed_ * load * view.eyes;
    }
    double frame(double cost) {
        std::uniform_real_distribution<> even(-1.0, 1.0);
        const double noisy = cost * (1.0 + noise * even(random_));
        return std::generate_canonical<double, 32>(random_) < spikeShare ? spike * noisy : noisy;
    }

  private:
    std::mt19937 random_;
    double triangle_, fragment_, fetch_, pass_, msaaShare_, speed_;
    double technique_[4], subsample_[3];
};

}  // namespace dioptre
