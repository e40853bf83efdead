// How focus follows the gaze: in dioptres, with the latency and the speed of an eye, and without its being led astray
// by blinks, saccades and jitter. Pure arithmetic on the times it is given: events happen at their own time, not at a
// frame's, and steps are exact (D += (T - D)(1 - exp(-dt/tau))), so the frame rate does not matter.
//
// What happens to a sample:
//   not valid, no depth, not finite  -> held: the target stays, a movement under way goes on
//   gaze faster than a saccade       -> held; what was waiting is dropped
//   within the dead zone             -> held; what was waiting is dropped (this is what stops jitter at a depth edge)
//   else                             -> it waits `latency` (or `confirm`, see there) and, if no later sample
//                                       contradicts, becomes the target; after a saccade the wait counts from the landing
#pragma once

#include <deque>
#include <glm/glm.hpp>
#include <limits>
#include <optional>
#include <string_view>

#include "optics/units.hpp"

namespace dioptre {

struct FocusDynamics {
    Seconds latency{0.0};       // >= 0, from a change under the gaze to the start of the movement
    Seconds tauFarToNear{0.0};  // >= 0, time constant towards larger vergence; 0 jumps
    Seconds tauNearToFar{0.0};  // >= 0, towards smaller vergence
    Seconds confirm{0.0};       // >= 0, least wait for a change of depth that came without a saccade
    Dioptres deadZone{0.0};     // >= 0, changes of the target up to this are not followed
    double saccadeDegreesPerSecond = std::numeric_limits<double>::infinity();  // > 0 (infinite: never held), gaze speed
                                                                               // above which depth is not believed
    Seconds driftAfter{30.0};  // > 0, without a usable sample for so long focus goes to the picture's centre
};

/// "natural" (a young eye), "snappy" (a quarter of its times), "instant" (no filter at all). Throws InputError for
/// another name, listing these.
FocusDynamics focusPreset(std::string_view name);

/// Throws InputError naming the first value out of the ranges above.
void validate(const FocusDynamics& dynamics);

/// Time from a saccade's landing until 5 % of a step is left: latency + tau ln 20.
Seconds settleTime(const FocusDynamics& dynamics, bool farToNear);

/// The exact first-order step: where focus is `elapsed` after it left `from` for `target`.
Dioptres focusStep(Dioptres from, Dioptres target, Seconds elapsed, Seconds tau);

/// One reading of the gaze.
struct FocusSample {
    double time = 0.0;                  // seconds
    std::optional<Dioptres> underGaze;  // from gazeVergence(); none: nothing under the gaze
    glm::dvec2 gazeDegrees{0.0};        // direction of the gaze as visual angles, for its speed
    bool valid = false;                 // the tracker's word
    Dioptres centre{0.0};               // vergence at the picture's centre, for the drift; kept if not finite
};

enum class FocusState {
    tracking,  // on the way to the depth under the gaze
    deadZone,  // there; what the depth under the gaze still differs is too little to follow
    waiting,   // a new depth was seen, its latency runs
    saccade,   // held: the gaze is in flight
    invalid,   // held: no usable sample (blink, tracker lost, nothing under the gaze)
    drifting,  // no usable sample for driftAfter: at or on the way to the centre's depth
};

class FocusFilter {
  public:
    /// Rests at `focus` until told otherwise. The clock starts with the first call that has a time.
    explicit FocusFilter(const FocusDynamics& dynamics, Dioptres focus = Dioptres(0.0));

    /// Times that are not finite are ignored; times up to 1 s back count as now; further back, the clock restarts
    /// there.
    void sample(const FocusSample& sample);  // also advances to its time
    void advance(double time);               // to a frame's time; any number of calls, the result is the same
    void jump(double time, Dioptres focus);  // scene change: there at once, everything waiting is forgotten

    Dioptres focus() const { return focus_; }
    Dioptres target() const { return target_; }
    FocusState state() const;
    /// Neither a movement nor a wait is under way.
    bool rests() const;
    const FocusDynamics& dynamics() const { return dynamics_; }

  private:
    struct Candidate {
        Dioptres value{0.0};
        double due = 0.0;
    };
    struct GazePoint {
        double time = 0.0;
        glm::dvec2 degrees{0.0};
    };

    bool arrived() const;
    bool setClock(double time);
    void evolve(double time);
    void setTarget(Dioptres target);
    void consider(Dioptres underGaze, double onset, Seconds wait);
    const GazePoint* velocityBaseline() const;
    void remember(glm::dvec2 degrees);

    FocusDynamics dynamics_;
    Dioptres focus_, target_;
    FocusState state_ = FocusState::invalid;
    bool clockRuns_ = false;
    double now_ = 0.0;
    double lastUsable_ = 0.0;  // time of the last usable sample, or of the clock's start
    std::optional<Dioptres> centre_;
    std::optional<Candidate> candidate_;
    std::deque<GazePoint> recent_;  // newest last; just enough for the velocity
};

}  // namespace dioptre
