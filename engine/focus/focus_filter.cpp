#include "focus/focus_filter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.hpp"

namespace dioptre {

namespace {

struct NamedDynamics {
    std::string_view name;
    FocusDynamics dynamics;
};

// Saccade threshold, deg/s: a tracker that jitters by 0.5 deg jumps at most 1.41 deg in the 30 ms over which speed is
// taken, 47 deg/s; a saccade of 5 deg peaks at about 200 deg/s. Smaller saccades pass as an ordinary change of depth.
constexpr double kSaccade = 80.0;
// Dead zone: less than a quarter of a dioptre is hardly noticed (Campbell 1957: 0.3 D with a 3 mm pupil).
constexpr Dioptres kDeadZone{0.25};

constexpr std::array<NamedDynamics, 3> kPresets = {{
    // The middle of what eyes do (latency 0.3-0.4 s, time constants 0.1-0.3 s); relaxing to far takes a little less.
    {"natural", {Seconds(0.35), Seconds(0.25), Seconds(0.2), Seconds(0.35), kDeadZone, kSaccade, Seconds(30.0)}},
    // A quarter of that. Without a saccade it still waits 0.25 s, half a period of a jitter of 2 Hz.
    {"snappy", {Seconds(0.0875), Seconds(0.0625), Seconds(0.05), Seconds(0.25), kDeadZone, kSaccade, Seconds(30.0)}},
    {"instant", {}},
}};

// Speed is taken over at least this many seconds, so that it does not grow with the sampling rate on jitter; a bit less
// than a frame at 30 Hz.
constexpr double kVelocityWindow = 0.03;
// A clock that goes back by more than this many seconds was restarted (a looped trace); by less it is disorder.
constexpr double kClockRestart = 1.0;
// Nearer than this to the target focus has arrived, for the state that is shown.
constexpr double kArrived = 0.01;  // dioptres
// Nearer than this it is there: no eye and no picture can tell, and a view would never stand still.
constexpr double kThere = 1e-4;  // dioptres

bool isUsable(const FocusSample& sample) {
    return sample.valid && sample.underGaze && std::isfinite(sample.underGaze->value) &&
           std::isfinite(sample.gazeDegrees.x) && std::isfinite(sample.gazeDegrees.y);
}

}  // namespace

FocusDynamics focusPreset(std::string_view name) {
    for (const NamedDynamics& preset : kPresets)
        if (preset.name == name) return preset.dynamics;
    throw InputError(fmt::format("focus dynamics '{}', must be natural, snappy or instant", name));
}

void validate(const FocusDynamics& dynamics) {
    const auto require = [](bool fine, const char* what, double value, const char* limit) {
        if (!fine) throw InputError(fmt::format("focus dynamics: {} {}, must be {}", what, value, limit));
    };
    const auto requireTime = [&](const char* what, Seconds time) {
        require(std::isfinite(time.value) && time.value >= 0.0, what, time.value, "finite seconds and not negative");
    };
    requireTime("latency", dynamics.latency);
    requireTime("time constant far to near", dynamics.tauFarToNear);
    requireTime("time constant near to far", dynamics.tauNearToFar);
    requireTime("confirmation time", dynamics.confirm);
    require(std::isfinite(dynamics.deadZone.value) && dynamics.deadZone.value >= 0.0, "dead zone",
            dynamics.deadZone.value, "finite dioptres and not negative");
    require(dynamics.saccadeDegreesPerSecond > 0.0, "saccade threshold", dynamics.saccadeDegreesPerSecond, "> 0 deg/s");
    require(dynamics.driftAfter.value > 0.0, "drift after", dynamics.driftAfter.value, "> 0 s");
}

Seconds settleTime(const FocusDynamics& dynamics, bool farToNear) {
    return dynamics.latency + (farToNear ? dynamics.tauFarToNear : dynamics.tauNearToFar) * std::log(20.0);
}

Dioptres focusStep(Dioptres from, Dioptres target, Seconds elapsed, Seconds tau) {
    if (tau.value <= 0.0) return target;
    return from + (target - from) * -std::expm1(-elapsed.value / tau.value);
}

FocusFilter::FocusFilter(const FocusDynamics& dynamics, Dioptres focus)
    : dynamics_(dynamics), focus_(focus), target_(focus) {
    validate(dynamics);
}

FocusState FocusFilter::state() const {
    return state_ == FocusState::tracking && arrived() ? FocusState::deadZone : state_;
}

bool FocusFilter::rests() const {
    return arrived() && state_ != FocusState::waiting && state_ != FocusState::saccade;
}

bool FocusFilter::arrived() const {
    return std::abs((target_ - focus_).value) < kArrived;
}

void FocusFilter::advance(double time) {
    if (setClock(time)) evolve(std::max(time, now_));
}

void FocusFilter::jump(double time, Dioptres focus) {
    if (!std::isfinite(focus.value)) return;
    if (setClock(time)) now_ = std::max(time, now_);
    focus_ = target_ = focus;
    state_ = FocusState::tracking;
    candidate_.reset();
    recent_.clear();
    lastUsable_ = now_;
}

void FocusFilter::sample(const FocusSample& sample) {
    if (!setClock(sample.time)) return;
    evolve(std::max(sample.time, now_));
    if (std::isfinite(sample.centre.value)) centre_ = sample.centre;

    if (!isUsable(sample)) {
        recent_.clear();
        if (state_ != FocusState::drifting) {
            state_ = FocusState::invalid;
        } else if (centre_ && std::abs((*centre_ - target_).value) > dynamics_.deadZone.value) {
            setTarget(*centre_);
        }
        return;
    }

    lastUsable_ = now_;
    const FocusState before = state_;
    double speed = 0.0, onset = now_;
    if (const GazePoint* baseline = velocityBaseline()) {
        speed = glm::distance(sample.gazeDegrees, baseline->degrees) / std::max(now_ - baseline->time, kVelocityWindow);
        // The gaze has rested since the sample that it is no longer fast against: there the saccade landed.
        if (before == FocusState::saccade) onset = baseline->time;
    }
    remember(sample.gazeDegrees);
    if (speed > dynamics_.saccadeDegreesPerSecond) {
        candidate_.reset();
        state_ = FocusState::saccade;
        return;
    }
    // A fixation that has just begun is believed at once; within one, jitter may have crossed a depth edge.
    const bool begins =
        before == FocusState::saccade || before == FocusState::invalid || before == FocusState::drifting;
    consider(*sample.underGaze, onset, begins ? dynamics_.latency : std::max(dynamics_.latency, dynamics_.confirm));
    evolve(now_);
}

void FocusFilter::consider(Dioptres underGaze, double onset, Seconds wait) {
    const double change = (underGaze - target_).value;
    if (std::abs(change) <= dynamics_.deadZone.value) {
        candidate_.reset();
        state_ = FocusState::tracking;
        return;
    }
    const bool sameWay = candidate_ && change * (candidate_->value - target_).value > 0.0;
    if (sameWay)
        candidate_->value = underGaze;
    else
        candidate_ = Candidate{underGaze, std::max(onset + wait.value, now_)};
    state_ = FocusState::waiting;
}

/// False for a time that is none. Starts the clock, or starts it anew where time went back for good.
bool FocusFilter::setClock(double time) {
    if (!std::isfinite(time)) return false;
    const double back = now_ - time;
    if (!clockRuns_) {
        clockRuns_ = true;
        now_ = lastUsable_ = time;
    } else if (back > kClockRestart) {
        now_ = time;
        lastUsable_ -= back;
        if (candidate_) candidate_->due -= back;
        recent_.clear();
    }
    return true;
}

/// From now_ to `time` through the events between: a candidate comes due, the drift begins.
void FocusFilter::evolve(double time) {
    const auto moveTo = [&](double moment) {
        const bool farToNear = target_ > focus_;
        focus_ = focusStep(focus_, target_, Seconds(moment - now_),
                           farToNear ? dynamics_.tauFarToNear : dynamics_.tauNearToFar);
        if (std::abs((target_ - focus_).value) < kThere) focus_ = target_;
        now_ = moment;
    };
    const double driftDue = lastUsable_ + dynamics_.driftAfter.value;
    const bool drifts = centre_ && state_ != FocusState::drifting && driftDue <= time;
    if (candidate_ && candidate_->due <= time && !(drifts && driftDue < candidate_->due)) {
        moveTo(std::max(candidate_->due, now_));
        setTarget(candidate_->value);
        if (state_ == FocusState::waiting) state_ = FocusState::tracking;
    }
    if (drifts) {
        moveTo(std::max(driftDue, now_));
        setTarget(*centre_);
        state_ = FocusState::drifting;
    }
    moveTo(time);
}

void FocusFilter::setTarget(Dioptres target) {
    target_ = target;
    candidate_.reset();
}

const FocusFilter::GazePoint* FocusFilter::velocityBaseline() const {
    if (recent_.empty()) return nullptr;
    const auto oldEnough = [&](const GazePoint& point) { return now_ - point.time >= kVelocityWindow; };
    const auto newest = std::find_if(recent_.rbegin(), recent_.rend(), oldEnough);
    return newest != recent_.rend() ? &*newest : &recent_.front();
}

void FocusFilter::remember(glm::dvec2 degrees) {
    if (!recent_.empty() && recent_.back().time >= now_) recent_.pop_back();
    recent_.push_back({now_, degrees});
    // One old enough to be the baseline is enough.
    while (recent_.size() > 1 && now_ - recent_[1].time >= kVelocityWindow) recent_.pop_front();
}

}  // namespace dioptre
