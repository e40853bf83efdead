// What the governor needs of a frame: what the view requires, its class, whether it stands still, what the last frame
// took.
#pragma once

#include <optional>
#include <span>

#include "frame/vergence_sampler.hpp"
#include "gl/pass.hpp"
#include "optics/lens.hpp"
#include "optics/view.hpp"
#include "quality/governor.hpp"
#include "render/gpu_scene.hpp"
#include "render/technique.hpp"

namespace dioptre {

class FramePlanner {
  public:
    /// With the table of this renderer in config/trade, or where there is none that of unknown ones.
    FramePlanner();

    struct Moment {
        const GpuScene& scene;
        std::span<const View> eyes;
        const Lens& lens;
        double now = 0.0;       // seconds
        double budgetMs = 0.0;  // of all eyes
        double refineMs = 0.0;  // the same, of a frame that refines a still view, where that is more
        bool highlights = false;
        bool unseen = false;  // a saccade or a blink
        bool alone = false;   // no frame follows
    };
    Decision decide(const Moment& moment);

    enum class Drew { plan, refinement, refinementInPart, somethingElse };
    /// Once the frame is finished: what it took, and what it was.
    void finished(double milliseconds, Drew drew);
    /// For statistics of what comes next: what drew the first eye's picture.
    void look(const Technique& technique, const View& view, PassLog& log) {
        sampler_.start(technique.depth(), view.near, log);
    }

    /// Of the view that was decided on last.
    const Requirements& requirements() const { return requirements_; }
    const PriceModel& prices() const { return governor_.prices(); }

  private:
    ViewFacts factsOf(const Moment& moment, const ViewContents& contents);
    bool moved(const Moment& moment);

    Governor governor_;
    VergenceSampler sampler_;
    Requirements requirements_;
    std::optional<double> lastMs_;
    bool lastRefined_ = false;
    struct {
        std::vector<View> eyes;
        Lens lens;
        std::uint64_t version = 0;
    } last_;
};

}  // namespace dioptre
