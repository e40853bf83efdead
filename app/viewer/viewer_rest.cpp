// When the viewer draws, and when it sleeps.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <utility>

#include "viewer/viewer.hpp"

namespace dioptre {

namespace {

// Sleeping, the window wakes up so often to see whether a signal came; loading, to move the bar.
constexpr double kNapSeconds = 0.25, kBarSeconds = 0.04;
// Dear ImGui needs a frame to see what happened and one to answer; a third for what appears because of that.
constexpr int kFramesAfterEvent = 3;
// Depth under the gaze comes a frame late, the focus answers it in the next one.
constexpr int kFramesUntilStill = 3;
// A blink ends, and the governor finds a plan, while time goes on.
constexpr double kSecondsUntilStill = 1.5;

}  // namespace

/// Sleeps while there is nothing to draw; false where there still is not.
bool Viewer::waitForWork() {
    const bool bar = loader_.running() || (show_ && show_->makesLevels());
    const bool busy = woken_ || framesToDraw_ > 0 || gui_.inputWaits() || wanted_ ||
                      (show_ && (!pictureIsStill() || instrumentsDue()));
    if (busy)
        glfwPollEvents();
    else
        glfwWaitEventsTimeout(bar || gazeInput_ ? kBarSeconds : kNapSeconds);
    if (gazeInput_) gazeInput_->read(glfwGetTime());
    if (std::exchange(woken_, false) || gui_.inputWaits()) framesToDraw_ = kFramesAfterEvent;
    if (!notice_.empty() && glfwGetTime() > noticeUntil_) {
        notice_.clear();
        framesToDraw_ = std::max(framesToDraw_, 1);
    }
    if (glfwGetWindowAttrib(window_->handle(), GLFW_ICONIFIED)) {
        takeScene();
        if (busy && !closing()) glfwWaitEventsTimeout(kNapSeconds);
        return false;
    }
    return busy || bar || framesToDraw_ > 0;
}

double Viewer::sceneTime() const {
    return heldTime_ ? *heldTime_ : glfwGetTime() - start_;
}

/// Whether another picture would be the same. Where it would, but is not yet as good as it can be, the scene's time
/// stands still while it refines.
bool Viewer::pictureIsStill() {
    const FocusSettings& focus = settings_.focus;
    // A tracker's samples change with every one, if only by their noise.
    const bool tracked = gazeInput_ && gazeInput_->gaze().alive(glfwGetTime());
    const bool moves =
        tracked || show_->scene().motion || !focus.gazeTrace.empty() || !focus.headTrace.empty() || recording_;
    const FrameMaker::Input now = inputNow();
    const bool gazeMoved =
        now.gaze.has_value() != lastInput_.gaze.has_value() ||
        (now.gaze && (now.gaze->position != lastInput_.gaze->position || now.gaze->valid != lastInput_.gaze->valid));
    if (gazeMoved && focus.focus.mode == FocusMode::gaze) stillFrames_ = 0;
    // An eye that has seen nothing for so long drifts away.
    const FocusFilter& filter = show_->maker().focusFilter();
    const bool lost = filter.state() == FocusState::invalid;
    if (lost && heldTime_ && glfwGetTime() - lastPicture_ > filter.dynamics().driftAfter.value) stillFrames_ = 0;

    if (stillFrames_ == 0) changed_ = glfwGetTime();
    const bool still =
        !moves && stillFrames_ >= kFramesUntilStill && glfwGetTime() - changed_ > kSecondsUntilStill && focusRests();
    if (!still)
        heldTime_.reset();
    else if (!heldTime_)
        heldTime_ = lastInput_.time;
    // Only a picture made while time stood still could refine.
    const bool mayRefine = lastInput_.refineMilliseconds > 0.0;
    return still && mayRefine && show_->maker().progress() >= 1.0 && (!split_.on() || split_.finished());
}

bool Viewer::focusRests() const {
    return settings_.focus.focus.mode != FocusMode::gaze || show_->maker().focusFilter().rests();
}

}  // namespace dioptre
