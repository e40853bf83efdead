#include "quality/price_model.hpp"

#include <algorithm>
#include <cmath>

namespace dioptre {

namespace {

constexpr std::size_t kLoad = 0, kFirstStage = 1, kFirstTechnique = kFirstStage + kStages;
constexpr std::size_t kFirstMethod = kFirstTechnique + std::size(kTechniques);

// Standard deviations of logarithms. Of a frame's time: 10 % to either side, evenly, has 0.058.
constexpr double kNoise = 0.06;
// A frame that far off its price is no noise: 1.5 times what an even 10 % can do.
constexpr double kJump = 0.15;
// Before anything was drawn: another machine, then how far tables measured on one scene miss another.
constexpr double kLoadPrior = 2.0, kStagePrior = 0.3, kTechniquePrior = 0.2, kMethodPrior = 0.25, kSmallerPrior = 0.12;
// What a frame adds. The load's lets the price follow with a time constant of about 20 frames.
constexpr double kLoadDrift = 0.003, kOtherDrift = 0.0002;
// Until then a jump after a change of method is that method's; but if the load has just jumped, it may jump back.
constexpr int kNewFrames = 4, kKnownFrames = 20;
// A relative price found under conditions that may have passed is doubted in the end: frames to 1/e.
constexpr double kForgetFrames = 30000.0;
constexpr double kMostLog = 12.0;  // of any factor

double square(double x) {
    return x * x;
}

}  // namespace

PriceModel::PriceModel(const TradeTable& table) : coefficients_(fitPrices(table)), methods_(table.methods()) {
    const auto add = [&](double prior, double drift) {
        factors_.push_back({.drift = square(drift), .most = square(prior)});
    };
    add(kLoadPrior, kLoadDrift);
    for (std::size_t i = 0; i < kStages; ++i) add(kStagePrior, kOtherDrift);
    for (std::size_t i = 0; i < std::size(kTechniques); ++i) add(kTechniquePrior, kOtherDrift);
    // Methods of a smaller size stand behind those of the table, whose corrections they begin with.
    const std::size_t full = methods_.size();
    for (const int eighths : kSmallerEighths)
        for (std::size_t i = 0; i < full; ++i)
            if (maySize(methods_[i])) {
                methods_.push_back(methods_[i]);
                methods_.back().eighths = eighths;
            }
    for (const Plan& method : methods_) {
        add(method.eighths == 8 ? kMethodPrior : kSmallerPrior, kOtherDrift);
        double sum = 0.0, count = 0.0;
        for (const TradeTable::Row& row : table.rows) {
            Plan measured = methodOf(row.plan);
            measured.eighths = method.eighths;
            if (measured != method) continue;
            for (const TradeTable::Entry& entry : row.entries) {
                const double fitted = priceOf(coefficients_, workOf(row.plan, table.views[entry.view]));
                sum += std::clamp(std::log(entry.milliseconds / std::max(fitted, 1e-9)), -kMostLog, kMostLog);
                count += 1.0;
            }
        }
        factors_.back().log = factors_.back().prior = sum / count;
    }
    covariance_.assign(factors_.size(), std::vector<double>(factors_.size(), 0.0));
    for (std::size_t i = 0; i < factors_.size(); ++i) covariance_[i][i] = factors_[i].most;
}

std::size_t PriceModel::indexOf(const Plan& plan) const {
    const auto found = std::find(methods_.begin(), methods_.end(), methodOf(plan));
    return found == methods_.end() ? factors_.size()
                                   : kFirstMethod + static_cast<std::size_t>(found - methods_.begin());
}

double PriceModel::price(const Plan& plan, const ViewClass& view) const {
    const Work work = workOf(plan, view);
    double sum = 0.0;
    for (std::size_t k = 0; k < kStages; ++k)
        sum += coefficients_[k] * work[k] * std::exp(factors_[kFirstStage + k].log);
    double log = factors_[kLoad].log + factors_[kFirstTechnique + static_cast<std::size_t>(plan.technique)].log;
    if (const std::size_t own = indexOf(plan); own < factors_.size()) log += factors_[own].log;
    return std::clamp(sum * std::exp(log), 1e-9, 1e12);
}

std::vector<double> PriceModel::sensitivities(const Plan& plan, const ViewClass& view) const {
    std::vector<double> h(factors_.size(), 0.0);
    const Work work = workOf(plan, view);
    double sum = 0.0;
    for (std::size_t k = 0; k < kStages; ++k) {
        h[kFirstStage + k] = coefficients_[k] * work[k] * std::exp(factors_[kFirstStage + k].log);
        sum += h[kFirstStage + k];
    }
    for (std::size_t k = 0; k < kStages; ++k) h[kFirstStage + k] /= std::max(sum, 1e-300);
    h[kLoad] = h[kFirstTechnique + static_cast<std::size_t>(plan.technique)] = 1.0;
    if (const std::size_t own = indexOf(plan); own < h.size()) h[own] = 1.0;
    return h;
}

std::vector<double> PriceModel::sensitivities(std::span<const Plan> plans, const ViewClass& view) const {
    std::vector<double> h(factors_.size(), 0.0);
    double all = 0.0;
    for (const Plan& plan : plans) {
        const double weight = price(plan, view);
        const std::vector<double> one = sensitivities(plan, view);
        for (std::size_t i = 0; i < h.size(); ++i) h[i] += weight * one[i];
        all += weight;
    }
    for (double& x : h) x /= all;
    return h;
}

double PriceModel::uncertainty(const Plan& plan, const ViewClass& view) const {
    return standardDeviation(sensitivities(plan, view));
}

double PriceModel::standardDeviation(std::span<const double> h) const {
    double variance = 0.0;
    for (std::size_t i = 0; i < h.size(); ++i)
        for (std::size_t j = 0; j < h.size(); ++j) variance += h[i] * covariance_[i][j] * h[j];
    return std::sqrt(std::max(variance, 0.0));
}

double PriceModel::load() const {
    return std::exp(factors_[kLoad].log);
}

void PriceModel::drift(const Plan& drawn) {
    for (std::size_t i = 0; i < factors_.size(); ++i) {
        Factor& f = factors_[i];
        if (covariance_[i][i] < f.most) covariance_[i][i] += f.drift;
        if (i >= kFirstMethod && methods_[i - kFirstMethod] != drawn) f.log += (f.prior - f.log) / kForgetFrames;
    }
}

void PriceModel::correct(std::span<const double> h, double difference) {
    std::vector<double> blame(factors_.size(), 0.0);  // covariance · h
    double variance = square(kNoise);
    for (std::size_t i = 0; i < h.size(); ++i) {
        for (std::size_t j = 0; j < h.size(); ++j) blame[i] += covariance_[i][j] * h[j];
        variance += h[i] * blame[i];
    }
    for (std::size_t i = 0; i < h.size(); ++i) {
        factors_[i].log = std::clamp(factors_[i].log + blame[i] * difference / variance, -kMostLog, kMostLog);
        for (std::size_t j = 0; j < h.size(); ++j) covariance_[i][j] -= blame[i] * blame[j] / variance;
    }
}

/// Makes unsure what a jump that nobody expected is due to.
void PriceModel::blame(std::size_t method, double jump) {
    const bool fresh = drawnFrames_ <= kNewFrames && sinceJump_ > 2 * kNewFrames && method < factors_.size();
    const bool known = fresh && factors_[method].frames > kKnownFrames;
    // A method dearer than foreseen is found out by drawing it. One far cheaper than that is not so likely as a load
    // that went.
    if (fresh && !known && jump > -3.0 * std::sqrt(factors_[method].most)) {
        covariance_[method][method] += square(jump);
        return;
    }
    // Of what is known a little may have changed.
    if (known) covariance_[method][method] += 0.1 * square(jump);
    covariance_[kLoad][kLoad] += square(jump);
    sinceJump_ = 0;
}

bool PriceModel::plausible(double milliseconds) {
    constexpr double kLeastMs = 1e-4, kMostMs = 1e7;
    return milliseconds >= kLeastMs && milliseconds <= kMostMs;
}

void PriceModel::learn(std::span<const Plan> drawn, const ViewClass& view, double milliseconds) {
    if (drawn.empty() || !plausible(milliseconds)) return;
    const Plan method = methodOf(drawn.back());
    drawnFrames_ = drawn_ == method ? drawnFrames_ + 1 : 1;
    drawn_ = method;
    ++sinceJump_;
    if (const std::size_t own = indexOf(method); own < factors_.size()) ++factors_[own].frames;
    drift(method);

    double expected = 0.0;
    for (const Plan& plan : drawn) expected += price(plan, view);
    double difference = std::log(milliseconds / expected);
    const std::vector<double> h = sensitivities(drawn, view);
    if (std::abs(difference) > kJump) {
        const double before = suspicion_;
        suspicion_ = difference;
        if (before * difference <= 0.0) return;
        // The second in succession: at least so much is true, and if it was sure to be otherwise that no longer is
        suspicion_ = 0.0;
        if (std::abs(before) < std::abs(difference)) difference = before;
        if (std::abs(difference) > 2.0 * standardDeviation(h)) {
            blame(indexOf(method), difference);
        }
    } else {
        suspicion_ = 0.0;
    }
    correct(h, difference);
}

}  // namespace dioptre
