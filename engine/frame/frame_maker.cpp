#include "frame/frame_maker.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.hpp"
#include "core/log.hpp"
#include "core/resources.hpp"
#include "core/text.hpp"
#include "focus/stereo_rig.hpp"
#include "scene/placement.hpp"

namespace dioptre {

namespace {

constexpr double kMostRadiance = 65504.0;  // of RGBA16F, in which techniques draw

/// A preset's name in config/lenses, else a file.
std::filesystem::path lensFile(const std::string& nameOrFile) {
    const auto presets = resource("config/lenses");
    std::error_code tooLong;
    if (auto file = presets / (nameOrFile + ".json"); std::filesystem::exists(file, tooLong)) return file;
    if (std::filesystem::exists(nameOrFile, tooLong)) return nameOrFile;
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(presets)) names.push_back(entry.path().stem());
    std::sort(names.begin(), names.end());
    throw InputError(
        fmt::format("--lens: {} is neither a file nor one of {}", quote(nameOrFile), fmt::join(names, ", ")));
}

std::string_view dynamicsName(DynamicsChoice choice) {
    switch (choice) {
        case DynamicsChoice::natural:
            return "natural";
        case DynamicsChoice::snappy:
            return "snappy";
        case DynamicsChoice::instant:
            return "instant";
    }
    return "natural";
}

LensConditions conditionsOf(const LensSettings& settings) {
    LensConditions conditions;
    if (settings.apertureMm) conditions.apertureDiameter = Metres(*settings.apertureMm * 1e-3);
    conditions.ageYears = settings.ageYears;
    conditions.luminance = settings.luminance;
    return conditions;
}

std::optional<ScreenGeometry> screenOf(const ViewSettings& settings) {
    if (!settings.screenWidthMm && !settings.screenDistanceMm) return std::nullopt;
    if (!settings.screenWidthMm || !settings.screenDistanceMm)
        throw InputError(settings.screenWidthMm ? "--screen-width-mm needs --screen-distance-mm, too"
                                                : "--screen-distance-mm needs --screen-width-mm, too");
    return ScreenGeometry{Metres(*settings.screenWidthMm * 1e-3), Metres(*settings.screenDistanceMm * 1e-3)};
}

/// A distance that a user typed must be one that the lens can be set to.
void checkFocus(const LensPreset& preset, double metres) {
    try {
        validateFocus(preset.focalLength, vergence(Metres(metres)));
    } catch (const InputError& error) {
        throw InputError(std::string("--focus: ") + error.what());
    }
}

bool drawsBothEyes(const ViewSettings& settings) {
    return settings.eye == EyeChoice::both && settings.display != DisplayChoice::mono;
}

/// Whether a texture of that kind can be had: more than its sides, its memory has a limit.
bool possible(GLenum format, int samples, PictureSize size) {
    const GLenum target = samples > 0 ? GL_PROXY_TEXTURE_2D_MULTISAMPLE : GL_PROXY_TEXTURE_2D;
    if (samples > 0)
        glTexImage2DMultisample(target, samples, format, size.width, size.height, GL_TRUE);
    else
        glTexImage2D(target, 0, static_cast<GLint>(format), size.width, size.height, 0, GL_RGBA, GL_FLOAT, nullptr);
    GLint width = 0;
    glGetTexLevelParameteriv(target, 0, GL_TEXTURE_WIDTH, &width);
    return width == size.width;
}

/// Asked once, before anything is drawn.
const Settings& requireDrawable(const Settings& settings) {
    const ViewSettings& view = settings.view;
    const PictureSize whole = drawsBothEyes(view) ? composedSize(view.display, view.size) : view.size;
    GLint side = 0, viewport[2] = {};
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &side);
    glGetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport);
    const int width = std::min(side, viewport[0]), height = std::min(side, viewport[1]);
    if (whole.width > width || whole.height > height)
        throw InputError(fmt::format("--size: {}x{} makes a picture of {}x{}, this OpenGL draws at most {}x{}",
                                     view.size.width, view.size.height, whole.width, whole.height, width, height));
    const auto plan = planOf(settings.render);
    constexpr int kMostMsaa = 4;  // that the governor may choose
    const int msaa = plan ? plan->msaa.value_or(0) : kMostMsaa;
    if (!possible(GL_RGBA16F, msaa, view.size) || !possible(GL_RGBA32F, 0, whole))
        throw InputError(
            fmt::format("--size: {}x{} with --msaa {} takes more memory in one texture than this OpenGL gives",
                        view.size.width, view.size.height, msaa));
    return settings;
}

/// The gaze as visual angles from the axis, degrees, for its speed.
glm::dvec2 gazeDegrees(const View& view, glm::dvec2 gaze) {
    const Frustum& f = view.frustum;
    const glm::dvec2 tangent(f.left + gaze.x * (f.right - f.left), f.top + gaze.y * (f.bottom - f.top));
    return glm::degrees(glm::atan(tangent));
}

}  // namespace

FrameMaker::FrameMaker(const Scene& scene, const Settings& settings)
    : settings_(requireDrawable(settings)),
      scene_(scene),
      motion_(scene.motion),
      start_(startView(scene, settings.view)),
      preset_(loadLensPreset(lensFile(settings.lens.lens))),
      conditions_(conditionsOf(settings.lens)),
      filter_(focusPreset(dynamicsName(settings.focus.dynamics))),
      eyes_(drawsBothEyes(settings.view) ? 2 : 1),
      pictures_(eyes_.size()),
      otherPictures_(eyes_.size()) {
    if (!settings.focus.gazeTrace.empty()) gazeTrace_ = readGazeTrace(settings.focus.gazeTrace);
    if (!settings.focus.headTrace.empty()) headTrace_ = readHeadTrace(settings.focus.headTrace);
    if (settings.focus.focus.mode == FocusMode::metres) checkFocus(preset_, settings.focus.focus.metres);
    if (const auto plan = planOf(settings.render))
        named_ = *plan;
    else
        planner_.emplace();
    planned_ = planner_.has_value();
    brightest_ = static_cast<double>(scene.brightestEmission()) * std::exp2(settings.render.exposureEv);
    if (brightest_ > kMostRadiance) reportCut(fmt::format("a material emits {:.3g} at this exposure", brightest_));
    if (const Camera* camera = startCamera(scene, settings.view); camera && camera->node >= 0) camera_ = *camera;
}

void FrameMaker::change(const Scene& scene, const Settings& settings) {
    // What may be refused comes first
    requireDrawable(settings);
    screenOf(settings.view);
    const View start = startView(scene, settings.view);
    const Camera* camera = startCamera(scene, settings.view);
    LensPreset preset =
        settings.lens.lens == settings_.lens.lens ? preset_ : loadLensPreset(lensFile(settings.lens.lens));
    if (settings.focus.focus.mode == FocusMode::metres) checkFocus(preset, settings.focus.focus.metres);
    const FocusSettings &before = settings_.focus, &after = settings.focus;
    std::vector<GazeSample> gazeTrace;
    std::vector<HeadSample> headTrace;
    if (after.gazeTrace != before.gazeTrace && !after.gazeTrace.empty()) gazeTrace = readGazeTrace(after.gazeTrace);
    if (after.headTrace != before.headTrace && !after.headTrace.empty()) headTrace = readHeadTrace(after.headTrace);
    const auto plan = planOf(settings.render), planBefore = planOf(settings_.render);
    std::optional<FramePlanner> planner;
    if (!plan && !planner_) planner.emplace();

    start_ = start;
    camera_.reset();
    if (camera && camera->node >= 0) camera_ = *camera;
    preset_ = std::move(preset);
    conditions_ = conditionsOf(settings.lens);
    if (after.gazeTrace != before.gazeTrace) gazeTrace_ = std::move(gazeTrace);
    if (after.headTrace != before.headTrace) headTrace_ = std::move(headTrace);
    if (after.dynamics != before.dynamics)
        filter_ = FocusFilter(focusPreset(dynamicsName(after.dynamics)), filter_.focus());
    const bool otherWay =
        plan.has_value() != planBefore.has_value() || (plan && plan->technique != planBefore->technique);
    if (otherWay || drawsBothEyes(settings.view) != drawsBothEyes(settings_.view)) {
        eyes_.assign(drawsBothEyes(settings.view) ? 2 : 1, {});
        pictures_ = PlannedPictures(eyes_.size());
        otherPictures_ = PlannedPictures(eyes_.size());
        fresh_ = true;
    }
    pictures_.cut();  // nothing goes on from what other settings drew
    refining_ = false;
    named_ = plan.value_or(Plan());
    planned_ = !plan;
    if (planner) planner_ = std::move(planner);
    brightest_ = static_cast<double>(scene.brightestEmission()) * std::exp2(settings.render.exposureEv);
    settings_ = settings;
}

void FrameMaker::reportCut(const std::string& what) const {
    if (std::exchange(cutReported_, true)) return;
    logWarning(fmt::format("{}: light beyond {:.0f}, the most that half floats hold, is cut; lower --exposure", what,
                           kMostRadiance));
}

void FrameMaker::moveScene(double time) {
    if (!motion_) return;
    const MotionPose pose = poseAt(*motion_, time);
    scene_.pose(pose, report_.passes);
    if (!camera_) return;
    place(*camera_, glm::mat4(pose.worldFromNode[static_cast<std::size_t>(camera_->node)]));
    start_.pose = poseOf(*camera_);
}

GazeSample FrameMaker::gazeNow(const Input& input) const {
    if (input.gaze) return *input.gaze;
    if (!gazeTrace_.empty()) return gazeAt(gazeTrace_, input.time);
    return {input.time, {settings_.focus.gaze[0], settings_.focus.gaze[1]}, true};
}

View FrameMaker::headView(const Input& input) const {
    const Pose local = input.head ? *input.head : headPoseAt(headTrace_, input.time);
    View view = start_;
    view.pose.position = start_.pose.position + start_.pose.orientation * local.position;
    view.pose.orientation = glm::normalize(start_.pose.orientation * local.orientation);
    return view;
}

void FrameMaker::placeEyes(const View& head) {
    const Metres ipd(settings_.view.ipdMm * 1e-3);
    const auto screen = screenOf(settings_.view);
    if (eyes_.size() == 2) {
        eyes_[0] = eyeView(Eye::left, head, ipd, screen);
        eyes_[1] = eyeView(Eye::right, head, ipd, screen);
        return;
    }
    const Eye eye = settings_.view.eye == EyeChoice::left    ? Eye::left
                    : settings_.view.eye == EyeChoice::right ? Eye::right
                                                             : Eye::centre;
    eyes_[0] = eyeView(eye, head, ipd, screen);
}

std::optional<FrameMaker::GazeDepth> FrameMaker::gazeDepth(const View& centre, bool mayLag) {
    const Radians error(glm::radians(settings_.focus.gazeErrorDeg));
    // While the gaze is lost, the middle is watched: focus drifts there in the end.
    const GazeSample& gaze = report_.gaze;
    const glm::dvec2 place = gaze.valid ? gaze.position : glm::dvec2(0.5);
    if (!mayLag) return GazeDepth{gaze, probe_.vergence(scene_, eyes_, centre, place, error, report_.passes)};
    // The last reading, once it is finished; the next one starts only then, so that none is dropped unread.
    std::optional<GazeDepth> finished;
    if (const auto reading = probe_.finish(false)) finished = GazeDepth{awaited_, reading->vergence};
    if (!probe_.running()) {
        probe_.start(scene_, eyes_, centre, place, error, report_.passes);
        awaited_ = gaze;
    }
    return finished;
}

Dioptres FrameMaker::focusNow(const View& head, const Input& input) {
    const FocusChoice& choice = settings_.focus.focus;
    if (choice.mode == FocusMode::infinity) return Dioptres(0.0);
    if (choice.mode == FocusMode::metres) return vergence(Metres(choice.metres));
    const View centre = eyeView(Eye::centre, head, Metres(settings_.view.ipdMm * 1e-3), screenOf(settings_.view));
    // A first frame, or a jump back, has no past to move from.
    const bool settle = !lastTime_ || input.time < *lastTime_;
    const auto read = gazeDepth(centre, input.mayLag && !settle);
    if (settle) filter_.jump(input.time, read->vergence.value_or(Dioptres(0.0)));
    if (read) {
        const bool valid = read->gaze.valid;
        report_.underGaze = valid ? read->vergence : std::nullopt;
        const Dioptres middle = valid ? Dioptres(std::nan("")) : read->vergence.value_or(Dioptres(0.0));
        filter_.sample({input.time, report_.underGaze, gazeDegrees(centre, read->gaze.position), valid, middle});
    } else {
        filter_.advance(input.time);
    }
    return filter_.focus();
}

const FrameReport& FrameMaker::make(const Input& input) {
    const double start = nowMilliseconds();
    report_.passes.clear();
    report_.time = input.time;
    report_.gaze = gazeNow(input);
    report_.underGaze.reset();

    moveScene(input.time);

    // Head pose and gaze, depth at the gaze, focus
    head_ = headView(input);
    placeEyes(head_);
    const Dioptres wanted = focusNow(head_, input);
    const bool first = std::exchange(fresh_, false);
    const double step = input.time - lastTime_.value_or(input.time);
    lastTime_ = input.time;

    // Lens or eye: what it can reach
    report_.lens = resolveLens(preset_, conditions_, wanted);
    report_.lens.lens.blades = settings_.lens.blades >= 3 ? settings_.lens.blades : 0;
    report_.lens.lens.bladeRotation = Radians(glm::radians(settings_.lens.bladeRotationDeg));

    // What the view requires, and the plan; drawn once per eye, the same for both
    report_.budgetMs = input.budgetMilliseconds;
    const bool again = input.alone && report_.decision;
    if (!again) report_.decision.reset();
    auto drew = FramePlanner::Drew::somethingElse;
    if (planned_) {
        if (first) input.alone ? lookAhead() : prepare();
        // A picture drawn again, with levels of detail: by the plan that asked for them
        const bool unseen = unseenNow(input);
        if (!again) report_.decision = decide(input, unseen);
        const auto drawn = pictures_.draw(*report_.decision, eyeFrames(input), step, unseen);
        report_.plan = drawn.plan;
        report_.foreseenMs = drawn.foreseenMs;
        drew = drawn.as;
        planner_->look(pictures_.technique(), eyes_.front(), report_.passes);
    } else {
        drawNamed(input);
    }
    composed_ = &compositor_.compose(composition(pictures_), report_.passes);
    glFinish();
    report_.milliseconds = nowMilliseconds() - start;
    if (planned_) planner_->finished(report_.milliseconds, first ? FramePlanner::Drew::somethingElse : drew);
    return report_;
}

Composition FrameMaker::composition(const PlannedPictures& pictures) const {
    const bool mono = eyes_.size() == 1;
    return {pictures.shown(0),
            pictures.shown(eyes_.size() - 1),
            {eyes_.front().width, eyes_.front().height},
            mono ? DisplayChoice::mono : settings_.view.display,
            settings_.view.swapEyes,
            settings_.render.tonemap};
}

Image FrameMaker::readPicture(const Texture& picture) {
    Image image(picture.width(), picture.height());
    image.pixels = readTexture(picture, GL_RGB, 3);
    return image;
}

Image FrameMaker::composed() const {
    Image image = readPicture(*composed_);
    for (std::size_t i = 0; i < eyes_.size(); ++i) {
        const std::vector<float> radiance = readTexture(pictures_.shown(i), GL_RGB, 3);
        const auto cut = std::count_if(radiance.begin(), radiance.end(),
                                       [](float v) { return static_cast<double>(v) >= kMostRadiance; });
        if (cut > 0) reportCut(fmt::format("{} values of the picture", cut));
    }
    return image;
}

void FrameMaker::addLevels(const std::vector<BuiltLevel>& levels) {
    for (const BuiltLevel& built : levels) scene_.addLevel(built.mesh, built.primitive, built.data);
}

void FrameMaker::present(const Placement& area) {
    PassLog unread;  // a frame may be shown more than once
    compositor_.present(area, unread);
}

double FrameMaker::progress() const {
    if (!planned_) return pictures_.progress();
    if (!report_.decision || !report_.decision->refinement) return 1.0;
    // More than the reference's own number of samples is not waited for.
    const double enough = defaultSamples(TechniqueChoice::reference);
    return std::min(1.0, pictures_.refinedSamples() / enough);
}

}  // namespace dioptre
