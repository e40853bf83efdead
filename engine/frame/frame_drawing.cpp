// How FrameMaker draws the eyes: by the plan that the settings name, or by the governor's.
#include <algorithm>
#include <cmath>
#include <utility>

#include "frame/frame_maker.hpp"

namespace dioptre {

EyeFrame FrameMaker::eyeFrame(const DrawnEye& eye) {
    const auto exposure = static_cast<float>(std::exp2(settings_.render.exposureEv));
    return {scene_, eye.view, report_.lens.lens, exposure, 0, settings_.render.show, report_.passes};
}

/// Whether the eye cannot see what is shown: in flight, or shut. A gaze that stays away is a lost tracker.
bool FrameMaker::unseen(const Input& input) {
    constexpr double kLongestBlink = 0.4;  // seconds
    const double time = input.time;
    // A pointer that leaves the picture does not blink.
    if (settings_.focus.focus.mode != FocusMode::gaze || input.alone || input.gaze) return false;
    if (report_.gaze.valid)
        lostAt_.reset();
    else if (!lostAt_ || time < *lostAt_)
        lostAt_ = time;
    const bool blinks = lostAt_ && time - *lostAt_ < kLongestBlink;
    return blinks || filter_.state() == FocusState::saccade;
}

Decision FrameMaker::decide(const Input& input) {
    unseen_ = unseen(input);
    const std::vector<View> views = eyeViews();
    const Decision decision = planner_->decide({scene_, views, report_.lens.lens, input.time, input.budgetMilliseconds,
                                                brightest_ > 1.0, unseen_, input.alone});
    for (const Omission& omission : planner_->requirements().omitted) report_.passes.skip(omission.what, omission.why);
    return decision;
}

/// Each way of drawing once, so that none keeps a later frame waiting for its programs.
void FrameMaker::prepare() {
    PassLog unheard;
    const Plan cheap{TechniqueChoice::pinhole, 0, {}, {}}, reference{TechniqueChoice::reference, {}, kLeastSamples, {}};
    // Programs do not hang on the size.
    constexpr int kWidth = 64, kHeight = 48;
    for (DrawnEye& eye : eyes_) {
        View view = eye.view;
        view.width = std::min(view.width, kWidth);
        view.height = std::min(view.height, kHeight);
        const EyeFrame frame{scene_, view, report_.lens.lens, 1.0f, 0, {}, unheard};
        for (Plan method : planner_->prices().methods()) {
            if (method.eighths != 8) continue;
            if (usesSamples(method.technique)) method.samples = kLeastSamples;
            eye.drawing.draw(method, frame);
        }
        eye.drawing.fade(cheap, cheap, 0.5, frame);
        eye.drawing.refine(reference, kLeastSamples, frame);
    }
    glFinish();
}

/// Where no frame has been that could tell of this one: the blur of a sharp picture, before anything is planned.
void FrameMaker::lookAhead() {
    DrawnEye& eye = eyes_.front();
    eye.drawing.draw({TechniqueChoice::pinhole, 0, {}, {}}, eyeFrame(eye));
    planner_->look(eye.drawing.technique(), eye.view, report_.passes);
    glFinish();
}

FramePlanner::Drew FrameMaker::refineEyes(const Decision& decision) {
    const int before = eyes_.front().drawing.refinedSamples();
    for (DrawnEye& eye : eyes_)
        eye.refined = &eye.drawing.refine(decision.refinement->plan, decision.refinement->samplesNow, eyeFrame(eye));
    const int samples = eyes_.front().drawing.refinedSamples();
    if (samples >= decision.refinement->shownFrom) {
        report_.plan = decision.refinement->plan;
        report_.plan.samples = samples;
    } else {
        report_.plan = *base_;
        for (DrawnEye& eye : eyes_) eye.refined = nullptr;
    }
    // It may have begun anew, or be finished: then the time is not that of as many samples.
    const int drawn = samples > before ? samples - before : samples < before ? samples : 0;
    return drawn == decision.refinement->samplesNow ? FramePlanner::Drew::refinement
                                                    : FramePlanner::Drew::refinementInPart;
}

FramePlanner::Drew FrameMaker::drawEyes(const Decision& decision) {
    report_.plan = decision.plan;
    base_ = decision.fade ? std::nullopt : std::optional(decision.plan);
    for (DrawnEye& eye : eyes_) {
        eye.refined = nullptr;
        eye.picture = decision.fade
                          ? &eye.drawing.fade(decision.fade->from, decision.plan, decision.fade->weight, eyeFrame(eye))
                          : &eye.drawing.draw(decision.plan, eyeFrame(eye));
    }
    return FramePlanner::Drew::plan;
}

/// Whether what was shown before lies where this frame has it, to about a pixel: then it may be seen through it.
bool FrameMaker::calm() const {
    constexpr double kMostPixels = 1.0, kNear = 2.0;  // a frame; dioptres, of most of what is near
    const View& now = eyes_.front().view;
    if (!lastEye_ || lastVersion_ != scene_.version()) return false;
    const double turn =
        2.0 * std::acos(std::min(1.0, std::abs(glm::dot(lastEye_->pose.orientation, now.pose.orientation))));
    const double step = glm::length(lastEye_->pose.position - now.pose.position);
    return focalLengthPixels(now).x * (turn + step * std::max(kNear, report_.lens.lens.focus.value)) <= kMostPixels;
}

/// A change of method that is not cross-faded melts out of what was shown before, as long as it lies still enough: that
/// costs a pass, not a second drawing.
FramePlanner::Drew FrameMaker::drawPlanned(Decision decision, double step) {
    constexpr double kSeconds = 0.1;
    // One technique has one set of buffers: two of its sizes in turn would make them anew for each frame of a fade.
    const bool within = decision.fade && decision.fade->from.technique == decision.plan.technique;
    if (within) decision.fade.reset();
    const bool softens = calm() && !unseen_ && step > 0.0 && step < kSeconds;
    if (!softens) melting_ = 0.0;
    const std::optional<Plan> before = lastShown_;
    const auto begin = [&](const Plan& plan) {
        if (!softens || decision.fade || !before || methodOf(plan) == methodOf(*before)) return;
        if (melting_ <= 0.0)
            for (DrawnEye& eye : eyes_) eye.drawing.remember(*eye.shown, eyeFrame(eye));
        melting_ = kSeconds;
    };
    auto drew = FramePlanner::Drew::plan;
    if (decision.refinement && !decision.fade && base_ && methodOf(*base_) == methodOf(decision.plan)) {
        drew = refineEyes(decision);
        begin(report_.plan);
    } else {
        begin(decision.plan);
        drew = drawEyes(decision);
    }
    for (DrawnEye& eye : eyes_) {
        eye.shown = eye.refined ? eye.refined : eye.picture;
        if (melting_ > 0.0) eye.shown = &eye.drawing.soften(*eye.shown, std::min(1.0, step / melting_), eyeFrame(eye));
    }
    melting_ = std::max(0.0, melting_ - step);
    lastShown_ = report_.plan;
    if (within) drew = FramePlanner::Drew::somethingElse;
    lastEye_ = eyes_.front().view;
    lastVersion_ = scene_.version();
    return drew;
}

void FrameMaker::drawNamed(const Input& input) {
    report_.plan = named_;
    // As many samples as last time, but for what that took more or less than the budget
    constexpr double kMostChange = 2.0;
    const bool refines = input.refines && named_.samples && input.budgetMilliseconds > 0.0;
    if (refines && refining_) {
        const double change =
            std::clamp(input.budgetMilliseconds / report_.milliseconds, 1.0 / kMostChange, kMostChange);
        samplesNow_ = std::clamp(static_cast<int>(samplesNow_ * change), 1, *named_.samples);
    }
    for (DrawnEye& eye : eyes_) {
        EyeFrame frame = eyeFrame(eye);
        frame.samplesNow = refines ? samplesNow_ : 0;
        eye.shown = eye.picture = &eye.drawing.draw(named_, frame);
    }
    refining_ = refines && eyes_.front().drawing.technique().progress() < 1.0;
}

Image FrameMaker::pictureBy(const Plan& plan) {
    PassLog unheard;
    other_.eyes.resize(eyes_.size());
    std::vector<const Texture*> pictures;
    for (std::size_t i = 0; i < eyes_.size(); ++i) {
        const EyeFrame as = eyeFrame(eyes_[i]);
        pictures.push_back(&other_.eyes[i].draw(plan, {as.scene, as.view, as.lens, as.exposure, 0, {}, unheard}));
    }
    const Composition both = composition(*pictures.front(), *pictures.back());
    return readPicture(other_.compositor.compose(both, unheard));
}

}  // namespace dioptre
