#include "quality/governor.hpp"

#include <algorithm>
#include <cmath>

namespace dioptre {

namespace {

// Of the budget. With a frame's time uneven by 10 % to either side, 0.909 just never misses.
constexpr double kTarget = 0.90, kKept = 0.907, kGrown = 0.885;
constexpr double kMostGrowth = 0.1;  // of the samples, in a frame
constexpr double kAfterMiss = 0.9;
constexpr double kWorthIt = 0.95;  // a better method has at most that share of the error
constexpr int kForeseenFrames = 10, kSharpFrames = 10;
constexpr int kHopefulFrames = 4;
// Standard deviations that an unsure price may be too high, at first; one more after that time without anything to try.
constexpr double kHope = 2.0, kMoreHopeSeconds = 60.0;
constexpr double kBetweenUps = 1.0, kFadeSeconds = 0.1;
// What a method that failed must leave free when it is tried again, for each failure.
constexpr double kMoreRoom = 0.02;
constexpr int kMostFailures = 14;
// A method left so soon has failed whatever else changed: it may be what slowed the machine. Others are conditions only
// after some frames, since a price in the midst of being corrected looks like a load.
constexpr int kProbation = 100, kOtherFrames = 30;

/// A view of which something could not be measured is planned as if there were none of it.
ViewClass sane(ViewClass view) {
    constexpr double kMost = 1e12;
    for (double* value : {&view.triangles, &view.pixels, &view.meanCocPx, &view.largestCocPx})
        *value = std::isfinite(*value) ? std::clamp(*value, 0.0, kMost) : 0.0;
    view.behindShare = view.behindShare >= 0.0 && view.behindShare <= 1.0 ? view.behindShare : 0.5;
    view.eyes = std::clamp(view.eyes, 1, 2);
    return view;
}

bool differ(double a, double b, double ratio) {
    return std::max(a, b) > ratio * std::max(std::min(a, b), 1e-9);
}

}  // namespace

bool Governor::Conditions::like(const Conditions& other) const {
    const ViewClass &a = view, &b = other.view;
    return !differ(load, other.load, 1.25) && !differ(budgetMs, other.budgetMs, 1.1) && a.eyes == b.eyes &&
           !differ(a.pixels, b.pixels, 1.1) && !differ(a.triangles, b.triangles, 1.25) &&
           !differ(a.meanCocPx + 0.5, b.meanCocPx + 0.5, 1.5);
}

Governor::Governor(TradeTable table) : table_(std::move(table)), prices_(table_) {}

void Governor::advanceClock(const Situation& s) {
    constexpr double kLongest = 60.0;
    const double passed = lastNow_ ? s.now - *lastNow_ : 0.0;
    if (passed > 0.0 && passed <= kLongest) {
        step_ = passed;
    } else {
        const double frame = s.lastMs && *s.lastMs > 0.0 ? *s.lastMs : s.budgetMs;
        step_ = std::isfinite(frame) ? std::clamp(frame * 1e-3, 0.0, kLongest) : 0.0;
    }
    clock_ += step_;
    lastNow_ = std::isfinite(s.now) ? std::optional(s.now) : std::nullopt;
}

Governor::Conditions Governor::conditions(const Situation& s) const {
    return {prices_.load(), s.budgetMs, s.view};
}

/// The current method did not last.
void Governor::left(const Plan& method, const Situation& s) {
    if (!entered_ || entered_->first != method) return;
    if (enteredFrames_ < kProbation || entered_->second.like(conditions(s))) {
        auto trial = std::find_if(trials_.begin(), trials_.end(), [&](const auto& t) { return t.first == method; });
        if (trial == trials_.end()) trial = trials_.insert(trials_.end(), {method, {}});
        Trial& t = trial->second;
        t.failures = std::min(t.failures + 1, kMostFailures);
        t.until = clock_ + std::exp2(t.failures) * kBetweenUps;
        t.at = entered_->second;
    }
    entered_.reset();
}

Governor::Move Governor::adapt(const Market& market, const Situation& s) {
    const double target = kTarget * s.budgetMs;
    sharpFrames_ = s.requirements.blur ? 0 : sharpFrames_ + 1;
    if (sharpFrames_ >= kSharpFrames && !sharp_) {
        sharp_ = true;
        if (current_->technique == TechniqueChoice::pinhole) return {};
        shelved_ = current_;
        Plan method{TechniqueChoice::pinhole, current_->msaa.value_or(4), {}, {}, current_->eighths};
        if (!market.within(method, target)) method.msaa = 0;
        current_ = method;
        return {PlanChange::adapted, "nothing is blurred"};
    }
    if (s.requirements.blur && sharp_) {
        sharp_ = false;
        const Plan before = std::exchange(shelved_, std::nullopt).value_or(market.adequate());
        auto offer = market.within(methodOf(before), target);
        if (!offer) offer = market.within(methodOf(market.adequate()), target);
        if (!offer) return {};
        if (before.samples && offer->plan.samples)
            offer->plan.samples = std::min(*before.samples, *offer->plan.samples);
        current_ = offer->plan;
        return {PlanChange::adapted, "something is blurred"};
    }
    return {};
}

Governor::Move Governor::goDown(const Market& market, const Situation& s, bool missed) {
    // What is tried in the hope that it is cheaper than its price shows it in its first frames; so that it is not tried
    // for nothing, a second one tells where the first was unlikely.
    if (hopefulFrames_ > 0 && --hopefulFrames_ > 0 && (!missed || prices_.suspects())) return {};
    const double kept = kKept * s.budgetMs;
    if (market.offer(*current_).milliseconds > kept) {
        const auto fewer = market.within(methodOf(*current_), kTarget * s.budgetMs);
        if (!fewer) {
            const Offer to = market.safest(kTarget * s.budgetMs).value_or(market.cheapest());
            if (methodOf(to.plan) == methodOf(*current_)) {
                current_ = to.plan;
                return {};
            }
            left(methodOf(*current_), s);
            current_ = to.plan;
            hopefulFrames_ = 0;
            shelved_.reset();
            return {PlanChange::down, "the price no longer fits"};
        }
        current_ = fewer->plan;
    }
    if (missed && current_->samples)
        current_->samples = std::max(kLeastSamples, static_cast<int>(kAfterMiss * *current_->samples));
    return {};
}

/// The method as it may be tried now: within the target, not waiting after a failure.
std::optional<Offer> Governor::tryable(const Plan& method, const Market& market, const Situation& s) {
    int failures = 0;
    for (auto& [tried, trial] : trials_) {
        if (tried != method) continue;
        trial.otherFrames = trial.at.like(conditions(s)) ? 0 : trial.otherFrames + 1;
        if (trial.otherFrames > kOtherFrames) trial = {};
        if (clock_ < trial.until) return std::nullopt;
        failures = trial.failures;
    }
    const double limit = std::max(1.0 - kMoreRoom * failures, 0.8) * kTarget * s.budgetMs;
    if (const auto offer = market.within(method, limit)) return offer;
    if (clock_ < hopefulAfter_) return std::nullopt;
    const double hope = std::min(kHope + (clock_ - hopefulAfter_) / kMoreHopeSeconds, 2.0 * kHope);
    return market.within(method, limit, std::pow(market.unsure(method), -hope));
}

/// What is better than the current plan by enough, and for how long; the same one as long as it is.
std::optional<Offer> Governor::candidate(const Market& market, const Situation& s) {
    const double worth = kWorthIt * market.offer(*current_).error;
    std::optional<Offer> best;
    for (const Plan& method : market.methods()) {
        if (method == methodOf(*current_)) continue;
        const auto offer = tryable(method, market, s);
        if (!offer || offer->error > worth) continue;
        if (candidate_.frames > 0 && method == candidate_.method) {
            ++candidate_.frames;
            return offer;
        }
        if (!best || offer->error < best->error) best = offer;
    }
    candidate_ = best ? decltype(candidate_){methodOf(best->plan), 1} : decltype(candidate_){};
    return best;
}

void Governor::enter(const Offer& to, const Market& market, const Situation& s) {
    const double target = kTarget * s.budgetMs;
    const Offer from = market.offer(*current_);
    left(methodOf(from.plan), s);
    entered_ = {methodOf(to.plan), conditions(s)};
    enteredFrames_ = 0;
    // Foreseen to fit only if it is cheaper than its price says
    hopefulFrames_ = 0;
    if (to.milliseconds > target) {
        hopefulAfter_ = clock_ + (hopefulWait_ *= 2.0);
        hopefulFrames_ = kHopefulFrames;
    }
    lastUp_ = clock_;
    candidate_ = {};
    current_ = to.plan;
    // Fewer samples at first where that lets both be drawn
    const auto both = market.within(methodOf(to.plan), target - from.milliseconds);
    fade_.running = both && both->error <= from.error && step_ < kFadeSeconds;
    if (!fade_.running) return;
    fade_.from = from.plan;
    fade_.began = clock_ - step_;
    if (current_->samples) current_->samples = std::min(*current_->samples, *both->plan.samples);
}

void Governor::grow(const Market& market, const Situation& s) {
    if (!current_->samples) return;
    const auto most = market.within(methodOf(*current_), kGrown * s.budgetMs);
    if (!most) return;
    const int step = std::max(1, static_cast<int>(kMostGrowth * *current_->samples));
    current_->samples = std::max(*current_->samples, std::min(*current_->samples + step, *most->plan.samples));
}

Governor::Move Governor::goUp(const Market& market, const Situation& s) {
    const auto better = candidate(market, s);
    if (better && candidate_.frames >= kForeseenFrames && clock_ - lastUp_ >= kBetweenUps) {
        enter(*better, market, s);
        return {PlanChange::up, "a better plan has been foreseen to fit"};
    }
    if (!fade_.running) grow(market, s);
    return {};
}

bool Governor::fadeFits(const Market& market, const Situation& s, const Plan& to) const {
    return clock_ - fade_.began < kFadeSeconds &&
           market.offer(fade_.from).milliseconds + market.offer(to).milliseconds <= kKept * s.budgetMs;
}

Decision Governor::decision(const Market& market, const Situation& s, Move move) {
    Decision d;
    d.plan = *current_;
    d.change = move.change;
    d.why = move.why;
    if (s.unseen) {
        const Offer cheap = market.offer(market.adequate());
        if (cheap.milliseconds < market.offer(*current_).milliseconds) d.plan = cheap.plan;
    }
    const bool rests = d.plan != *current_;
    if (rests != rested_) {
        d.change = rests ? PlanChange::rested : PlanChange::resumed;
        d.why = rests ? "nobody sees" : "it is seen again";
    }
    rested_ = rests;
    drawn_ = {d.plan};
    if (fade_.running) {
        d.fade = Decision::Fade{fade_.from, std::clamp((clock_ - fade_.began) / kFadeSeconds, 0.0, 1.0)};
        drawn_.insert(drawn_.begin(), fade_.from);
    }
    for (const Plan& plan : drawn_) d.foreseenMs += market.offer(plan).milliseconds;
    d.expectedError = market.offer(d.plan).error;
    if (s.requirements.mayRefine && !s.unseen && s.budgetMs > 0.0)
        d.refinement = {Plan{TechniqueChoice::reference, {}, kMostSamples, {}}, kTarget * s.budgetMs,
                        market.samplesToReach(*current_)};
    return d;
}

Decision Governor::decide(const Situation& situation) {
    Situation s = situation;
    if (!(s.budgetMs > 0.0)) s.budgetMs = 0.0;
    s.view = sane(s.view);
    advanceClock(s);
    ++enteredFrames_;
    if (s.lastMs) prices_.learn(drawn_, drawnView_, *s.lastMs);
    const bool missed = s.lastMs && *s.lastMs > s.budgetMs;

    if (!errors_ || s.view != drawnView_) errors_.emplace(table_, s.view);
    const Market market(prices_, *errors_, s.view, s.requirements);
    const bool first = !current_;
    // Carefully: what the table says may be of another machine
    if (first) {
        current_ = market.adequate();
        sharp_ = !s.requirements.blur;
    }

    Move move = adapt(market, s);
    if (const Move down = goDown(market, s, missed && !rested_); down.change != PlanChange::none) move = down;
    if (move.change != PlanChange::none || s.unseen) {
        candidate_ = {};
        fade_.running = false;
    } else if (!missed) {
        move = goUp(market, s);
    }
    if (fade_.running && (missed || !fadeFits(market, s, *current_))) fade_.running = false;
    if (first) move = {PlanChange::none, "the first frame"};
    drawnView_ = s.view;
    return decision(market, s, move);
}

}  // namespace dioptre
