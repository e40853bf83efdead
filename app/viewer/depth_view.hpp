// What lies at which depth in the picture, and what of it is sharp: eye, focal plane and sharp range seen from the side.
#pragma once

#include <array>
#include <optional>

#include "frame/frame_maker.hpp"
#include "gl/objects.hpp"

namespace dioptre {

class DepthView {
  public:
    struct Range {
        double nearest = 0.0, farthest = 0.0;  // vergences, dioptres
    };

    /// Draws the scene's depth once more, small, and counts it. `near` of the view tells vergence from depth.
    void survey(const GpuScene& scene, const View& head);

    /// Nearest and farthest of what is seen, but for a hundredth at either end; none before a survey, or of an empty
    /// scene. The sky is 0 D.
    std::optional<Range> range() const { return range_; }

    void draw(const FrameReport& report, const View& head) const;

  private:
    static constexpr int kBins = 96;
    Texture depth_;
    Framebuffer target_;
    std::array<double, kBins> shares_{};  // of the picture, by vergence from 0 to top_
    double top_ = 1.0;                    // dioptres
    std::optional<Range> range_;
};

}  // namespace dioptre
