// What lies under the gaze: a small depth-only drawing of each eye's region around it, so that the rest of the frame
// need not wait for its own picture to be drawn before focus is known.
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
    /// Exact (waits for the GL): weighted median vergence over a cone around `gaze` (0..1 from the top left of the
    /// `centre` view), from what the eyes' views of the same rig see. `error` is the tracker's standard deviation.
    /// nullopt when the cone lies outside the picture; the sky is 0 D.
    std::optional<Dioptres> vergence(const GpuScene& scene, std::span<const View> eyes, const View& centre,
                                     glm::dvec2 gaze, Radians error, PassLog& log);

  private:
    std::vector<float> readRegion(const GpuScene& scene, const View& eye, const PixelRegion& region);

    Texture depth_;
    Framebuffer target_;
};

}  // namespace dioptre
