// How FrameMaker draws the eyes: by the plan that the settings name, or by the governor's.
#include <algorithm>
#include <cmath>

#include "frame/frame_maker.hpp"

namespace dioptre {

/// Valid until the next call.
std::vector<EyeFrame> FrameMaker::eyeFrames(std::span<const View> views, PassLog& log) {
    const auto exposure = static_cast<float>(std::exp2(settings_.render.exposureEv));
    sight_ = scene_.inSight(views, report_.lens.lens);
    std::vector<EyeFrame> frames;
    for (const View& view : views) {
        frames.push_back({scene_, view, report_.lens.lens, exposure, 0, settings_.render.show, log});
        frames.back().sight = &sight_;
    }
    return frames;
}

/// Of the frame itself; valid as long as the input is.
std::vector<EyeFrame> FrameMaker::eyeFrames(const Input& input) {
    std::vector<EyeFrame> frames = eyeFrames(eyes_, report_.passes);
    if (!input.onDrawn) return frames;
    const auto eyes = static_cast<double>(frames.size());
    double before = 0.0;
    for (EyeFrame& frame : frames) {
        frame.onDrawn = [&input, eyes, before](double share) { input.onDrawn((before + share) / eyes); };
        before += 1.0;
    }
    return frames;
}

/// Whether the eye cannot see what is shown: in flight, or shut. A gaze that stays away is a lost tracker.
bool FrameMaker::unseenNow(const Input& input) {
    constexpr double kLongestBlink = 0.4;  // seconds
    const double time = input.time;
    const bool pointed = input.gaze && !input.tracked;
    if (settings_.focus.focus.mode != FocusMode::gaze || input.alone || pointed) return false;
    if (report_.gaze.valid)
        lostAt_.reset();
    else if (!lostAt_ || time < *lostAt_)
        lostAt_ = time;
    const bool blinks = lostAt_ && time - *lostAt_ < kLongestBlink;
    return blinks || filter_.state() == FocusState::saccade;
}

Decision FrameMaker::decide(const Input& input, bool unseen) {
    const Decision decision = planner_->decide({scene_, eyes_, report_.lens.lens, input.time, input.budgetMilliseconds,
                                                input.refineMilliseconds, brightest_ > 1.0, unseen, input.alone});
    for (const Omission& omission : planner_->requirements().omitted) report_.passes.skip(omission.what, omission.why);
    return decision;
}

/// Each way of drawing once, so that none keeps a later frame waiting for its programs.
void FrameMaker::prepare() {
    PassLog unheard;
    constexpr int kWidth = 64, kHeight = 48;
    std::vector<View> small = eyes_;
    for (View& view : small) {
        view.width = std::min(view.width, kWidth);
        view.height = std::min(view.height, kHeight);
    }
    pictures_.prepare(planner_->prices().methods(), eyeFrames(small, unheard));
}

/// Where no frame has been that could tell of this one: the blur of a sharp picture, before anything is planned.
void FrameMaker::lookAhead() {
    pictures_.draw({TechniqueChoice::pinhole, 0, {}, {}}, eyeFrames(eyes_, report_.passes));
    planner_->look(pictures_.technique(), eyes_.front(), report_.passes);
    glFinish();
}

void FrameMaker::drawNamed(const Input& input) {
    report_.plan = named_;
    const bool refines = input.refines && named_.samples && input.budgetMilliseconds > 0.0;
    if (refines && refining_)
        samplesNow_ = samplesInTime(samplesNow_, report_.milliseconds, input.budgetMilliseconds, *named_.samples);
    std::vector<EyeFrame> frames = eyeFrames(input);
    for (EyeFrame& frame : frames) frame.samplesNow = refines ? samplesNow_ : 0;
    pictures_.draw(named_, frames);
    refining_ = refines && pictures_.progress() < 1.0;
}

Image FrameMaker::pictureBy(const Plan& plan, int firstSample) {
    PassLog unheard;
    std::vector<EyeFrame> frames = eyeFrames(eyes_, unheard);
    for (EyeFrame& frame : frames) {
        frame.show = {};
        frame.firstSample = firstSample;
    }
    otherPictures_.draw(plan, frames);
    return readPicture(otherCompositor_.compose(composition(otherPictures_), unheard));
}

}  // namespace dioptre
