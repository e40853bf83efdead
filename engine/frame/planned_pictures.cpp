#include "frame/planned_pictures.hpp"

#include <algorithm>
#include <cmath>

namespace dioptre {

void PlannedPictures::prepare(std::span<const Plan> methods, std::span<const EyeFrame> frames) {
    const Plan cheap{TechniqueChoice::pinhole, 0, {}, {}}, reference{TechniqueChoice::reference, {}, kLeastSamples, {}};
    for (std::size_t i = 0; i < eyes_.size(); ++i) {
        EyePicture& picture = eyes_[i].picture;
        for (Plan method : methods) {
            if (method.eighths != 8) continue;  // programs do not hang on the size
            if (usesSamples(method.technique)) method.samples = kLeastSamples;
            picture.draw(method, frames[i]);
        }
        picture.fade(cheap, cheap, 0.5, frames[i]);
        picture.refine(reference, kLeastSamples, frames[i]);
    }
    glFinish();
}

void PlannedPictures::draw(const Plan& plan, std::span<const EyeFrame> frames) {
    for (std::size_t i = 0; i < eyes_.size(); ++i)
        eyes_[i].shown = eyes_[i].byPlan = &eyes_[i].picture.draw(plan, frames[i]);
}

PlannedPictures::Drawn PlannedPictures::drawPlan(const Decision& decision, std::span<const EyeFrame> frames) {
    if (!decision.fade) {
        draw(decision.plan, frames);
        base_ = decision.plan;
        return {decision.plan, decision.foreseenMs};
    }
    base_.reset();
    for (std::size_t i = 0; i < eyes_.size(); ++i)
        eyes_[i].shown = eyes_[i].byPlan =
            &eyes_[i].picture.fade(decision.fade->from, decision.plan, decision.fade->weight, frames[i]);
    return {decision.plan, decision.foreseenMs};
}

PlannedPictures::Drawn PlannedPictures::refine(const Decision& decision, std::span<const EyeFrame> frames) {
    const Decision::Refinement& more = *decision.refinement;
    const int before = refinedSamples();
    std::vector<const Texture*> refined;
    for (std::size_t i = 0; i < eyes_.size(); ++i)
        refined.push_back(&eyes_[i].picture.refine(more.plan, more.samplesNow, frames[i]));
    const int samples = refinedSamples();
    const bool enough = samples >= more.shownFrom;
    for (std::size_t i = 0; i < eyes_.size(); ++i) eyes_[i].shown = enough ? refined[i] : eyes_[i].byPlan;
    Plan plan = *base_;
    if (enough) {
        plan = more.plan;
        plan.samples = samples;
    }
    // It may have begun anew, or be finished: then the time is not that of as many samples.
    const int drawn = samples > before ? samples - before : samples < before ? samples : 0;
    return {plan, more.foreseenMs,
            drawn == more.samplesNow ? FramePlanner::Drew::refinement : FramePlanner::Drew::refinementInPart};
}

/// Whether what was shown before lies where this frame has it, to about a pixel: then it may be seen through it.
bool PlannedPictures::calm(const EyeFrame& frame) const {
    constexpr double kMostPixels = 1.0, kNear = 2.0;  // a frame; dioptres, of most of what is near
    if (!before_ || before_->version != frame.scene.version()) return false;
    const Pose &was = before_->view.pose, &now = frame.view.pose;
    const double turn = 2.0 * std::acos(std::min(1.0, std::abs(glm::dot(was.orientation, now.orientation))));
    const double step = glm::length(was.position - now.position);
    return focalLengthPixels(frame.view).x * (turn + step * std::max(kNear, frame.lens.focus.value)) <= kMostPixels;
}

/// Melting costs a pass, not a second drawing.
PlannedPictures::Drawn PlannedPictures::draw(const Decision& decision, std::span<const EyeFrame> frames, double step,
                                             bool unseen) {
    // What is shown of the new picture grows to all of it: one that flickers begins to do so gradually.
    constexpr double kSeconds = 0.2;
    const bool melts = calm(frames.front()) && !unseen && step > 0.0 && step < 0.5 * kSeconds;
    if (!melts) melting_.reset();
    // Before anything is drawn over it
    const bool refines = decision.refinement && !decision.fade && base_ && methodOf(*base_) == methodOf(decision.plan);
    std::vector<const Texture*> old;
    for (const Eye& eye : eyes_) old.push_back(eye.shown);
    const auto begin = [&](const Plan& plan) {
        if (!melts || decision.fade || !before_) return;
        // A fade may be broken off where it takes too long. A whole one's last weight is a step below 1, but for rounding.
        const bool broken = before_->fade && *before_->fade + step / Decision::Fade::kSeconds < 0.99;
        if (methodOf(plan) == methodOf(before_->plan) && !broken) return;
        for (std::size_t i = 0; !melting_ && i < eyes_.size(); ++i) eyes_[i].picture.remember(*old[i], frames[i]);
        melting_ = 0.0;
    };
    // Refining leaves the pictures by plan as they are; a plan's picture may be drawn where the one before stands.
    if (!refines) begin(decision.plan);
    const Drawn drawn = refines ? refine(decision, frames) : drawPlan(decision, frames);
    if (refines) begin(drawn.plan);
    if (melting_ && (*melting_ += step) >= kSeconds) melting_.reset();
    for (std::size_t i = 0; melting_ && i < eyes_.size(); ++i)
        eyes_[i].shown = &eyes_[i].picture.soften(*eyes_[i].shown, *melting_ / kSeconds, frames[i]);
    before_ = Before{drawn.plan, frames.front().view, frames.front().scene.version(),
                     decision.fade ? std::optional(decision.fade->weight) : std::nullopt};
    return drawn;
}

void PlannedPictures::cut() {
    base_.reset();
    before_.reset();
    melting_.reset();
}

double PlannedPictures::progress() const {
    double least = 1.0;
    for (const Eye& eye : eyes_) least = std::min(least, eye.picture.progress());
    return least;
}

std::size_t PlannedPictures::bytes() const {
    std::size_t sum = 0;
    for (const Eye& eye : eyes_) sum += eye.picture.bytes();
    return sum;
}

}  // namespace dioptre
