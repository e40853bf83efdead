// All eyes' pictures as the governor decides or the settings name: by the same plan in every frame. A change of method
// that the governor does not cross-fade melts out of what was shown before; a still view is refined.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "frame/eye_picture.hpp"
#include "frame/frame_planner.hpp"
#include "quality/governor.hpp"

namespace dioptre {

class PlannedPictures {
  public:
    explicit PlannedPictures(std::size_t eyes) : eyes_(eyes) {}

    // `frames`: of each eye, as many as there are; what is shown is valid until the next call.

    /// Each method once, so that none keeps a later frame waiting for its programs.
    void prepare(std::span<const Plan> methods, std::span<const EyeFrame> frames);

    /// By the plan alone.
    void draw(const Plan& plan, std::span<const EyeFrame> frames);

    struct Drawn {
        Plan plan;  // that is seen: a refined view's is the reference with the samples that it has
        double foreseenMs = 0.0;
        FramePlanner::Drew as = FramePlanner::Drew::plan;
    };
    /// `step`: seconds since the frame before. `unseen`: a saccade or a blink, nothing need melt.
    Drawn draw(const Decision& decision, std::span<const EyeFrame> frames, double step, bool unseen);

    /// The next frame begins anew: it neither melts nor goes on with a refinement.
    void cut();

    const Texture& shown(std::size_t eye) const { return *eyes_[eye].shown; }
    /// That drew the first eye's picture.
    const Technique& technique() const { return eyes_.front().picture.technique(); }
    /// Of what the plans' techniques drew last, the least of all eyes; 0..1.
    double progress() const;
    /// Samples of the refinement, while it goes on with what was drawn; 0: none.
    int refinedSamples() const { return base_ ? eyes_.front().picture.refinedSamples() : 0; }
    std::size_t bytes() const;

  private:
    struct Eye {
        EyePicture picture;
        const Texture* byPlan = nullptr;
        const Texture* shown = nullptr;
    };
    Drawn drawPlan(const Decision& decision, std::span<const EyeFrame> frames);
    Drawn refine(const Decision& decision, std::span<const EyeFrame> frames);
    bool calm(const EyeFrame& frame) const;

    std::vector<Eye> eyes_;
    std::optional<Plan> base_;  // of the eyes' pictures by plan; none: they are faded
    struct Before {
        Plan plan;
        View view;                   // of the first eye
        std::uint64_t version = 0;   // of the scene
        std::optional<double> fade;  // the weight of `plan`'s picture in one
    };
    std::optional<Before> before_;   // what was shown last
    std::optional<double> melting_;  // for so many seconds
};

}  // namespace dioptre
