// Pictures of the viewer at work, in its panel: frame times, stages, the focus filter.
#pragma once

#include <deque>
#include <string_view>
#include <vector>

#include "frame/frame_maker.hpp"

namespace dioptre {

class Instruments {
  public:
    /// After each picture. `now` in seconds.
    void note(double now, const FrameReport& report, const FocusFilter& filter);

    /// Whether stages are to be timed, which makes frames slower.
    bool timesStages() const { return timeStages_; }

    void drawFrameTimes() const;
    void drawStages();
    void drawFocus() const;

  private:
    struct Frame {
        double milliseconds = 0.0;
        TechniqueChoice technique = TechniqueChoice::pinhole;
    };
    struct Focus {
        double time = 0.0;
        Dioptres target, focus;
        FocusState state = FocusState::tracking;
    };
    struct Stage {
        std::string_view name;
        double milliseconds = 0.0;
    };

    double budgetMs_ = 0.0;
    std::string_view why_;      // the governor's last reason, a literal
    std::deque<Frame> frames_;  // the last few hundred
    std::deque<Focus> focus_;   // of the last seconds
    std::vector<Stage> stages_;
    Dioptres deadZone_;
    bool timeStages_ = false;
};

}  // namespace dioptre
