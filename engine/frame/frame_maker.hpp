// The way of a frame: head pose and gaze, depth at the gaze, focus, lens, two eye views, technique, composition.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/image.hpp"
#include "core/settings.hpp"
#include "focus/focus_filter.hpp"
#include "focus/traces.hpp"
#include "frame/gaze_probe.hpp"
#include "gl/pass.hpp"
#include "optics/lens_preset.hpp"
#include "present/compositor.hpp"
#include "render/technique.hpp"
#include "scene/lod.hpp"
#include "scene/scene.hpp"

namespace dioptre {

/// What was shown.
struct FrameReport {
    double time = 0.0;  // seconds
    GazeSample gaze;
    std::optional<Dioptres> underGaze;  // measured only where focus follows the gaze, and there is something to measure
    ResolvedLens lens;
    std::string plan;           // "mipmap, msaa 4"
    double milliseconds = 0.0;  // of the finished frame
    PassLog passes;
};

/// A view of the whole scene from its front, for scenes without a camera.
View framedView(const Bounds& bounds, PictureSize size);
/// The view that settings ask for: --pose, else --camera, else the first camera, else the whole scene. At time 0.
/// InputError for a camera that is not there (naming those that are).
View startView(const Scene& scene, const ViewSettings& settings);
/// The camera that such a view has its place from; none where it has it from --pose or from the scene's box.
const Camera* startCamera(const Scene& scene, const ViewSettings& settings);
Pose poseOf(const Camera& camera);

class FrameMaker {
  public:
    /// Loads what the settings name (lens, traces). Needs a current context that outlives it. Throws InputError, also
    /// for a picture larger than this OpenGL draws.
    FrameMaker(const Scene& scene, const Settings& settings);

    /// What the viewer does between frames, where no trace says it.
    struct Input {
        double time = 0.0;
        std::optional<GazeSample> gaze;  // overrides trace and setting
        std::optional<Pose> head;        // in the start view's frame; overrides the trace
        // Depth under the gaze is read when the GL has it, usually a frame late, instead of waiting for it.
        bool mayLag = false;
        // More than 0: a technique that can refine a still view does so within this time, from frame to frame.
        double budgetMilliseconds = 0.0;
    };
    /// What moves in the scene is where it is at the input's time, the start view's camera included.
    /// Draws both eyes' pictures; finished when it returns. The first frame, and each after a jump back in time, starts
    /// with the focus settled.
    const FrameReport& make(const Input& input);

    /// What a technique that draws levels of detail is to draw from the next frame on.
    void addLevels(const std::vector<BuiltLevel>& levels);

    /// The last frame: read back, linear; or shown in the window's framebuffer of that size.
    Image composed() const;  // warns, once, of radiance that half floats could not hold
    void present(PictureSize window);

    const View& startingView() const { return start_; }  // of the last frame's time
    std::size_t techniqueBytes() const;
    const GpuScene& scene() const { return scene_; }

  private:
    struct EyePicture {
        View view;
        std::unique_ptr<Technique> technique;
        const Texture* picture = nullptr;
    };

    /// Warns, once.
    void reportCut(const std::string& what) const;
    void moveScene(double time);
    GazeSample gazeNow(const Input& input) const;
    View headView(const Input& input) const;
    void placeEyes(const View& head);
    Dioptres focusNow(const View& head, const Input& input);
    /// What was read, and the gaze that it belongs to.
    struct GazeDepth {
        GazeSample gaze;
        std::optional<Dioptres> vergence;
    };
    std::optional<GazeDepth> gazeDepth(const View& centre, bool mayLag);
    Composition composition() const;

    Settings settings_;
    GpuScene scene_;
    std::shared_ptr<const Motion> motion_;
    View start_;
    std::optional<Camera> camera_;  // that start_ moves with
    LensPreset preset_;
    LensConditions conditions_;
    std::vector<GazeSample> gazeTrace_;
    std::vector<HeadSample> headTrace_;
    GazeProbe probe_;
    FocusFilter filter_;
    GazeSample awaited_;  // the gaze whose depth is being read
    std::optional<double> lastTime_;
    std::vector<EyePicture> eyes_;  // one, or left and right
    Compositor compositor_;
    const Texture* composed_ = nullptr;
    FrameReport report_;
    mutable bool cutReported_ = false;
};

}  // namespace dioptre
