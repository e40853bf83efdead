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
constexpr int kSpeculativeFrames = 4;
// Standard deviations that an unsure price may be too high, at first; one more after that time without anything to try.
constexpr double kHope = 2.0, kMoreHopeSeconds = 60.0;
constexpr double kBetweenUps = 1.0, kFadeSeconds = Decision::Fade::kSeconds;
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

Governor::Governor(TradeTable table) : table_(std::move(table)), prices_(table_) {
    for (const Plan& method : prices_.methods()) trials_.push_back({method, {}});
}

void Governor::advanceClock(const Situation& s) {
    constexpr double kLongest = 60.0;
    const double passed = lastNow_ ? s.now - *lastNow_ : 0.0;
    if (passed > 0.0 && passed <= kLongest) {
        step_ = passed;
    } else {
        // A display waits for the next refresh.
        const double frame = std::max(s.lastMs.value_or(0.0), s.budgetMs);
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
        Trial& t =
            std::find_if(trials_.begin(), trials_.end(), [&](const auto& u) { return u.first == method; })->second;
        t.failures = std::min(t.failures + 1, kMostFailures);
        t.until = clock_ + std::exp2(t.failures) * kBetweenUps;
        t.at = entered_->second;
        t.otherFrames = 0;
    }
    entered_.reset();
}

Governor::Move Governor::adapt(const Candidates& candidates, const Situation& s) {
    const double target = kTarget * s.budgetMs;
    sharpFrames_ = s.requirements.blur ? 0 : sharpFrames_ + 1;
    if (sharpFrames_ >= kSharpFrames && !sharp_) {
        sharp_ = true;
        if (current_->technique == TechniqueChoice::pinhole) return {};
        suspended_ = current_;
        Plan method{TechniqueChoice::pinhole, current_->msaa.value_or(4), {}, {}, current_->eighths};
        if (!candidates.within(method, target)) method.msaa = 0;
        current_ = method;
        return {PlanChange::adapted, "nothing is blurred"};
    }
    if (s.requirements.blur && sharp_) {
        sharp_ = false;
        const Plan before = std::exchange(suspended_, std::nullopt).value_or(candidates.adequate());
        auto found = candidates.within(methodOf(before), target);
        if (!found) found = candidates.within(methodOf(candidates.adequate()), target);
        if (!found) return {};
        if (before.samples && found->plan.samples)
            found->plan.samples = std::min(*before.samples, *found->plan.samples);
        current_ = found->plan;
        return {PlanChange::adapted, "something is blurred"};
    }
    return {};
}

Governor::Move Governor::goDown(const Candidates& candidates, const Situation& s, bool missed) {
    // What is tried in the hope that it is cheaper than its price shows it in its first frames; so that it is not tried
    // for nothing, a second one tells where the first was unlikely.
    const bool speculative = speculativeFrames_ > 0;
    if (speculative && (s.unseen || rested_)) return {};
    if (speculative && --speculativeFrames_ > 0 && (!missed || prices_.suspects())) return {};
    const double kept = kKept * s.budgetMs;
    if (candidates.priced(*current_).milliseconds > kept) {
        const auto fewer = candidates.within(methodOf(*current_), kTarget * s.budgetMs);
        if (!fewer) {
            // After a miss what is sure to fit, else what is foreseen to. Where nothing does: what may turn out to be
            // the cheapest; drawn, it is no longer unsure.
            const double target = kTarget * s.budgetMs;
            const auto fits = missed ? candidates.safest(target) : candidates.best(target);
            const PricedPlan to = fits ? *fits : candidates.cheapest(1.0);
            if (methodOf(to.plan) == methodOf(*current_)) {
                current_ = to.plan;
                return {};
            }
            left(methodOf(*current_), s);
            current_ = to.plan;
            speculativeFrames_ = 0;
            suspended_.reset();
            return {PlanChange::down, "the price no longer fits"};
        }
        current_ = fewer->plan;
    } else if (speculative && speculativeFrames_ == 0) {
        speculativeWait_ = kSpeculativeWait;  // it was right
    }
    if (missed && current_->samples)
        current_->samples = std::max(kLeastSamples, static_cast<int>(kAfterMiss * *current_->samples));
    return {};
}

/// Failures are forgotten once load, budget or view have been others for a while; frames are counted in which a method
/// is foreseen to fit, whatever is drawn.
void Governor::foresee(const Candidates& candidates, const Situation& s) {
    for (auto& [method, trial] : trials_) {
        trial.otherFrames = trial.at.like(conditions(s)) ? 0 : trial.otherFrames + 1;
        if (trial.otherFrames > kOtherFrames) trial.failures = 0;
        trial.fits = affordable(method, trial, candidates, s);
        // What is but hoped for has not been foreseen.
        const bool hoped = trial.fits && trial.fits->milliseconds > kTarget * s.budgetMs;
        if (hoped != trial.hoped) trial.foreseenFrames = 0;
        trial.hoped = hoped;
        trial.foreseenFrames = trial.fits ? trial.foreseenFrames + 1 : 0;
    }
}

/// The method as it may be tried once its wait after a failure is over; none where it does not fit.
std::optional<PricedPlan> Governor::affordable(const Plan& method, const Trial& trial, const Candidates& candidates,
                                               const Situation& s) const {
    const double limit = std::max(1.0 - kMoreRoom * trial.failures, 0.8) * kTarget * s.budgetMs;
    if (const auto found = candidates.within(method, limit)) return found;
    if (trial.failures > 0 || clock_ < speculativeAfter_) return std::nullopt;
    const double hope = std::min(kHope + (clock_ - speculativeAfter_) / kMoreHopeSeconds, 2.0 * kHope);
    return candidates.within(method, limit, std::pow(candidates.unsure(method), -hope));
}

/// What has been foreseen to fit for long enough and is better than the current plan by enough. Of several the one after
/// whose trial the least error is to be expected: where it does not fit, the current plan goes on.
std::optional<PricedPlan> Governor::better(const Candidates& candidates, const Situation& s) const {
    // After a missed frame the current method has fewer samples than it will soon have again.
    const auto grown = candidates.within(methodOf(*current_), kGrown * s.budgetMs);
    const double now = std::min(candidates.priced(*current_).error, grown ? grown->error : 1.0);
    const double worth = kWorthIt * now;
    std::optional<PricedPlan> best;
    double least = now;
    for (const auto& [method, trial] : trials_) {
        if (!trial.fits || trial.foreseenFrames < kForeseenFrames || (trial.failures > 0 && clock_ < trial.until))
            continue;
        if (!candidates.allows(method) || method == methodOf(*current_) || trial.fits->error > worth) continue;
        const double fits = candidates.chanceToFit(method, kKept * s.budgetMs);
        const double expected = fits * trial.fits->error + (1.0 - fits) * now;
        if (expected >= least) continue;
        best = trial.fits;
        least = expected;
    }
    return best;
}

void Governor::enter(const PricedPlan& to, const Candidates& candidates, const Situation& s) {
    const double target = kTarget * s.budgetMs;
    const PricedPlan from = candidates.priced(*current_);
    entered_ = {methodOf(to.plan), conditions(s)};
    enteredFrames_ = 0;
    // Foreseen to fit only if it is cheaper than its price says
    speculativeFrames_ = 0;
    if (to.milliseconds > target) {
        speculativeAfter_ = clock_ + (speculativeWait_ *= 2.0);
        speculativeFrames_ = kSpeculativeFrames;
    }
    lastUp_ = clock_;
    current_ = to.plan;
    // The least tell as much, and miss by the least.
    if (speculativeFrames_ > 0 && current_->samples) current_->samples = kLeastSamples;
    // Fewer samples at first where that lets both be drawn
    const auto both = candidates.within(methodOf(to.plan), target - from.milliseconds);
    // One technique has one set of buffers: two of its sizes in turn would make them anew for each frame of a fade.
    fade_.running =
        both && both->error <= from.error && step_ < kFadeSeconds && from.plan.technique != to.plan.technique;
    if (!fade_.running) return;
    fade_.from = from.plan;
    fade_.began = clock_ - step_;
    if (current_->samples) current_->samples = std::min(*current_->samples, *both->plan.samples);
}

void Governor::grow(const Candidates& candidates, const Situation& s) {
    if (!current_->samples) return;
    const auto most = candidates.within(methodOf(*current_), kGrown * s.budgetMs);
    if (!most) return;
    const int step = std::max(1, static_cast<int>(kMostGrowth * *current_->samples));
    current_->samples = std::max(*current_->samples, std::min(*current_->samples + step, *most->plan.samples));
}

Governor::Move Governor::goUp(const Candidates& candidates, const Situation& s) {
    if (clock_ - lastUp_ >= kBetweenUps)
        if (const auto found = better(candidates, s)) {
            enter(*found, candidates, s);
            return {PlanChange::up, "a better plan has been foreseen to fit"};
        }
    if (!fade_.running) grow(candidates, s);
    return {};
}

bool Governor::fadeFits(const Candidates& candidates, const Situation& s, const Plan& to) const {
    return clock_ - fade_.began < kFadeSeconds &&
           candidates.priced(fade_.from).milliseconds + candidates.priced(to).milliseconds <= kKept * s.budgetMs;
}

Decision Governor::decision(const Candidates& candidates, const Situation& s, Move move) {
    Decision d;
    d.plan = *current_;
    d.change = move.change;
    d.why = move.why;
    if (s.unseen) {
        const PricedPlan cheap = candidates.priced(candidates.adequate());
        if (cheap.milliseconds < candidates.priced(*current_).milliseconds) d.plan = cheap.plan;
    }
    const bool rests = d.plan != *current_;
    if (rests != rested_ && move.change == PlanChange::none) {
        d.change = rests ? PlanChange::rested : PlanChange::resumed;
        d.why = rests ? "nobody sees" : "it is seen again";
    }
    rested_ = rests;
    drawn_ = {d.plan};
    if (fade_.running) {
        d.fade = Decision::Fade{fade_.from, std::clamp((clock_ - fade_.began) / kFadeSeconds, 0.0, 1.0)};
        drawn_.insert(drawn_.begin(), fade_.from);
    }
    for (const Plan& plan : drawn_) d.foreseenMs += candidates.priced(plan).milliseconds;
    d.expectedError = candidates.priced(d.plan).error;
    refined_.reset();
    if (s.requirements.mayRefine && !s.unseen) {
        const Plan reference{TechniqueChoice::reference, {}, {}, {}};
        auto now = candidates.within(reference, kTarget * std::max(s.budgetMs, s.refineMs), 1.0, 1);
        // Who rests would rather wait for a sample than look at the plan's picture for ever.
        if (!now && s.refineMs > 0.0) now = candidates.priced({TechniqueChoice::reference, {}, 1, {}});
        if (now) {
            refined_ = now->plan;
            d.refinement = {Plan{TechniqueChoice::reference, {}, kMostSamples, {}}, *now->plan.samples,
                            now->milliseconds, candidates.samplesToReach(*current_)};
        }
    }
    return d;
}

Decision Governor::decide(const Situation& situation) {
    Situation s = situation;
    if (!(s.budgetMs > 0.0)) s.budgetMs = 0.0;
    if (s.lastMs && !PriceModel::plausible(*s.lastMs)) s.lastMs.reset();
    s.view = sane(s.view);
    advanceClock(s);
    if (!rested_) ++enteredFrames_;
    if (s.lastMs) {
        if (!s.lastRefined) prices_.learn(drawn_, drawnView_, *s.lastMs);
        if (s.lastRefined && refined_) prices_.learn({&*refined_, 1}, drawnView_, *s.lastMs);
    }
    const bool missed = !s.lastRefined && s.lastMs && *s.lastMs > s.budgetMs;

    if (!errors_ || s.view != drawnView_) errors_.emplace(table_, s.view);
    const Candidates candidates(prices_, *errors_, s.view, s.requirements);
    const bool first = !current_;
    // Carefully: what the table says may be of another machine
    if (first) {
        const auto best = s.alone ? candidates.best(kTarget * s.budgetMs) : std::nullopt;
        current_ = best ? best->plan : candidates.adequate();
        sharp_ = !s.requirements.blur;
    }

    // Then by what the first frame took: the best that fits even if it is as dear as it is unsure
    const bool begins = !first && !began_ && s.lastMs && !s.lastRefined;
    if (begins) {
        began_ = true;
        const auto safe = candidates.safest(kTarget * s.budgetMs);
        if (safe && safe->error < candidates.priced(*current_).error) current_ = safe->plan;
    }

    foresee(candidates, s);
    Move move = adapt(candidates, s);
    if (const Move down = goDown(candidates, s, missed && !rested_); down.change != PlanChange::none) move = down;
    if (move.change != PlanChange::none || s.unseen) {
        fade_.running = false;
        // What was foreseen then is not what is foreseen now.
        if (move.change == PlanChange::down)
            for (auto& [method, trial] : trials_) trial.foreseenFrames = 0;
    } else if (!missed && !s.lastRefined) {
        // What is drawn of a still view gets better by refining.
        move = goUp(candidates, s);
    }
    if (fade_.running && (missed || !fadeFits(candidates, s, *current_))) fade_.running = false;
    if (first) move = {PlanChange::none, "the first frame"};
    if (begins && move.change == PlanChange::none) move.why = "what a frame takes is known";
    drawnView_ = s.view;
    return decision(candidates, s, move);
}

}  // namespace dioptre
