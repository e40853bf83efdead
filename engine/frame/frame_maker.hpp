// The way of a frame: head pose and gaze, depth at the gaze, focus, lens, two eye views, technique, composition.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/image.hpp"
#include "core/settings.hpp"
#include "focus/focus_filter.hpp"
#include "focus/traces.hpp"
#include "frame/frame_planner.hpp"
#include "frame/gaze_probe.hpp"
#include "frame/planned_pictures.hpp"
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
    // Measured only where focus follows the gaze, and there is something to measure; of the frame before with mayLag
    std::optional<Dioptres> underGaze;
    ResolvedLens lens;
    Plan plan;                         // a refined view's: the reference with the samples that it has
    std::optional<Decision> decision;  // of the governor; none where the settings name a technique
    double budgetMs = 0.0;             // that it kept to
    double foreseenMs = 0.0;           // by the governor, of what was drawn
    double milliseconds = 0.0;         // of the finished frame
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
        // Depth under the gaze is read when the GL has it, instead of waiting for it: in the next frame, since each is
        // finished when make() returns. So focus answers a gaze, its filter aside, one frame late.
        bool mayLag = false;
        // Of the frame, all eyes; 0: the cheapest there is.
        double budgetMilliseconds = 0.0;
        // More than that for a frame that refines a view which nobody is about to move.
        double refineMilliseconds = 0.0;
        // A named technique that averages samples draws as many as fit into the budget and goes on with them in the
        // next frames while the view stands still. What the governor chooses does so always.
        bool refines = false;
        // No frame follows: there is nothing to learn for.
        bool alone = false;
        // `gaze` is an eye's, which blinks and darts; a pointer only leaves the picture.
        bool tracked = false;
        // Told the share of the frame that is drawn, 0..1, now and then, where samples are averaged; of two plans that
        // fade, of each.
        std::function<void(double)> onDrawn = {};
    };
    /// What moves in the scene is where it is at the input's time, the start view's camera included.
    /// Draws both eyes' pictures; finished when it returns. The first frame, and each after a jump back in time, starts
    /// with the focus settled.
    const FrameReport& make(const Input& input);
    /// What the first frame pays alone, for a sequence that begins with that input: at the moment of the frame after
    /// it, or a view that stands still would be refined. `step`: seconds between frames.
    void warmUp(Input first, double step) {
        first.time += step;
        make(first);
    }

    /// Whether levels of detail may be drawn.
    bool mayUseLevels() const { return planned_ || usesLevels(named_); }
    /// What a technique that draws levels of detail is to draw from the next frame on.
    void addLevels(const std::vector<BuiltLevel>& levels);

    /// Other settings from the next frame on, for the scene that it was made with; focus goes on from where it is.
    /// What throws (InputError, also of a broken trade table) changes nothing.
    void change(const Scene& scene, const Settings& settings);

    /// The last frame: read back, linear; or shown in a part of the window's framebuffer (Compositor::present).
    Image composed() const;  // warns, once, of radiance that half floats could not hold
    void present(const Placement& area);
    /// From the next frame on: its stages are timed (PassLog::timed), which makes it slower.
    void timeStages(bool timed) { report_.passes.timed = timed; }
    /// How much of what was asked for the last frame has, 0..1; below 1 while a still view refines.
    double progress() const;
    /// What the last frame shows as another plan draws it, composed, read back, linear. The frame stays as it is.
    /// `firstSample`: where its points of the lens begin. What frames are compared with must not share theirs: from
    /// kMostSamples on.
    Image pictureBy(const Plan& plan, int firstSample = 0);

    const View& startingView() const { return start_; }          // of the last frame's time
    const View& head() const { return head_; }                   // of the last frame, midway between the eyes
    const std::vector<View>& eyeViews() const { return eyes_; }  // of the last frame: one, or left and right
    const FrameReport& report() const { return report_; }
    const Texture& composedTexture() const { return *composed_; }  // the last frame
    const FocusFilter& focusFilter() const { return filter_; }
    std::size_t techniqueBytes() const { return pictures_.bytes(); }
    const GpuScene& scene() const { return scene_; }

  private:
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
    Decision decide(const Input& input, bool unseen);
    bool unseenNow(const Input& input);
    std::vector<EyeFrame> eyeFrames(std::span<const View> views, PassLog& log);
    std::vector<EyeFrame> eyeFrames(const Input& input);
    void prepare();
    void lookAhead();
    void drawNamed(const Input& input);
    static Image readPicture(const Texture& picture);
    Composition composition(const PlannedPictures& pictures) const;

    Settings settings_;
    GpuScene scene_;
    std::shared_ptr<const Motion> motion_;
    View start_, head_;
    std::optional<Camera> camera_;  // that start_ moves with
    LensPreset preset_;
    LensConditions conditions_;
    std::vector<GazeSample> gazeTrace_;
    std::vector<HeadSample> headTrace_;
    GazeProbe probe_;
    FocusFilter filter_;
    GazeSample awaited_;  // the gaze whose depth is being read
    std::optional<double> lastTime_;
    bool fresh_ = true;       // nothing was drawn yet by these eyes and this way to draw
    std::vector<View> eyes_;  // one, or left and right
    Sight sight_;             // of both; of the frames made last
    PlannedPictures pictures_;
    Plan named_;                           // by the settings, where planned_ is false
    std::optional<FramePlanner> planner_;  // what it learnt outlives frames that settings plan
    bool planned_ = false;                 // by the governor
    double brightest_ = 0.0;               // radiance that a material emits, times exposure
    std::optional<double> lostAt_;         // since when the gaze is not valid
    int samplesNow_ = 1;                   // of a named technique that refines, in a frame
    bool refining_ = false;                // the last frame drew so many
    Compositor compositor_;
    const Texture* composed_ = nullptr;
    // pictureBy()
    PlannedPictures otherPictures_;
    Compositor otherCompositor_;
    FrameReport report_;
    mutable bool cutReported_ = false;
};

}  // namespace dioptre
