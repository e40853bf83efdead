// What lies under the gaze: a small depth-only drawing of each eye's region around it, read back either at once or, so
// that nothing waits, when the GL has finished it.
//
// Surfaces that are seen through, texel by texel, each by itself: below the cut-off of an alpha mask nothing is there;
// alpha-blended ones are there from alpha 0.5 on, where they give more of the pixel's light than all that is behind them,
// and looked through below that. So a pane of dim glass is focused on, a clean one is not, nor are two clean ones. What
// fills the cone then: focus/gaze_depth.hpp. Levels of detail that are there are drawn where they are off by no more than
// a pixel.
#pragma once

#include <optional>
#include <vector>

#include "focus/gaze_depth.hpp"
#include "gl/objects.hpp"
#include "gl/pass.hpp"
#include "render/gpu_scene.hpp"

namespace dioptre {

class GazeProbe {
  public:
    /// Starts a reading: weighted median vergence over a cone around `gaze` (0..1 from the top left of the `centre`
    /// view), from what the eyes' views of the same rig see; `error` is the tracker's standard deviation. A reading
    /// not yet finished is dropped.
    void start(const GpuScene& scene, std::span<const View> eyes, const View& centre, glm::dvec2 gaze, Radians error,
               PassLog& log);

    struct Reading {
        std::optional<Dioptres> vergence;  // none: the cone lies outside the picture; 0 is the sky
    };
    /// The reading that was started, once; none while the GL still works on it (never with `wait`) or none was started.
    std::optional<Reading> finish(bool wait);
    bool running() const { return started_; }

    /// Both in one, and waits.
    std::optional<Dioptres> vergence(const GpuScene& scene, std::span<const View> eyes, const View& centre,
                                     glm::dvec2 gaze, Radians error, PassLog& log);

  private:
    struct EyeReading {
        PixelRegion region;
        MidpointShift shift;
        double near = 0.0;
        Buffer pixels;  // stored depth, bottom row first
    };
    void drawRegion(const GpuScene& scene, const View& eye, EyeReading& reading);

    Texture depth_;
    Framebuffer target_;
    bool started_ = false;
    glm::dvec2 pixel_{0.0}, sigma_{0.0};
    std::vector<EyeReading> eyes_;
    Fence fence_;
};

}  // namespace dioptre
