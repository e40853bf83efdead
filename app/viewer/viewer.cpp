#include "viewer/viewer.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.hpp"
#include "core/log.hpp"
#include "interrupt.hpp"
#include "viewer/overlay.hpp"

namespace dioptre {

namespace {

constexpr double kNoticeSeconds = 6.0;
constexpr double kSurveySeconds = 0.5;
// A frame of a view that rests: hardly anybody sees a pause so long where they move it again.
constexpr double kStillMilliseconds = 200.0;

/// What is wrong with it is said before a window opens.
std::unique_ptr<GazeInput> openGazeInput(const Command& command) {
    std::unique_ptr<GazeInput> input;
    if (!command.gazeInput.empty()) input = std::make_unique<GazeInput>(command.gazeInput);
    return input;
}

std::unique_ptr<Window> openWindow(const Settings& settings, SceneLoader& loader) {
    const ViewSettings& view = settings.view;
    const PictureSize size = composedSize(view.eye == EyeChoice::both ? view.display : DisplayChoice::mono, view.size);
    try {
        return std::make_unique<Window>(size.width, size.height, "Dioptre: " + loader.name());
    } catch (const RunError&) {
        loader.wait();  // what is wrong with the scene is said first
        throw;
    }
}

}  // namespace

Viewer::Viewer(const Command& command)
    : command_(command),
      settings_(command.settings),
      gazeInput_(openGazeInput(command)),
      window_((loader_.load(command), openWindow(settings_, loader_))),
      gui_(window_->handle()) {
    listen();
    refreshMs_ = window_->refreshMilliseconds();
}

Viewer::~Viewer() = default;

std::vector<FrameReport> Viewer::run() {
    while (step()) {
    }
    finishRecording();
    glfwHideWindow(window_->handle());  // a scene that is still being loaded may take a while
    return std::move(log_);
}

bool Viewer::step() {
    if (closing()) return false;
    if (waitForWork()) frame();
    return !closing();
}

bool Viewer::closing() const {
    return glfwWindowShouldClose(window_->handle()) || interrupted();
}

void Viewer::frame() {
    framesToDraw_ = std::max(0, framesToDraw_ - 1);
    takeScene();
    pictureMade_ = false;
    // Not after the panel, whose small pictures must live until it is drawn
    if (show_ && !wanted_) drawForInstruments();

    // Interface: what is wished for
    gui_.begin(settings_.system.uiScale);
    Wish wish{settings_};
    takeWishes(wish);

    // Picture
    if (show_) {
        if (!wanted_) apply(wish);
        if (wish.picture)
            beginPicture();
        else if (wanted_)
            drawPictureToBeWritten();
        if (!wanted_ && !pictureMade_ && !pictureIsStill()) makePicture(inputNow());
    }

    // Both to the window
    PictureSize window, pixels;
    glfwGetWindowSize(window_->handle(), &window.width, &window.height);
    glfwGetFramebufferSize(window_->handle(), &pixels.width, &pixels.height);
    drawOver();
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    if (show_ && pixels.width > 0 && pixels.height > 0 && window.width > 0) {
        const double scale = static_cast<double>(pixels.width) / window.width;
        const int left = static_cast<int>(std::lround(area().x * scale));
        const Placement beside{left, 0, std::max(1, pixels.width - left), pixels.height};
        show_->maker().present(beside);
        if (split_.on() && !wanted_) split_.present(show_->maker(), beside);
    } else {
        glClearColor(0.0f, 0.0f, 0.0f, 1.0f);
        glClear(GL_COLOR_BUFFER_BIT);
    }
    gui_.end();
    glfwSwapBuffers(window_->handle());
    ++drawn_.frames;
    showTitle();
}

/// Shows a scene that was loaded; where it is refused, says why and goes on with the one that is there.
void Viewer::takeScene() {
    loader_.goOn();
    // A picture of the scene before is finished first. Its way to the GPU keeps the window waiting: what it waits for is
    // shown first.
    if (!wanted_ && loader_.ready() && !std::exchange(announced_, true)) return;
    try {
        std::optional<Scene> scene;
        if (!wanted_) {
            scene = loader_.take();
            announced_ = false;
        }
        if (!scene) {
            if (show_ && show_->takeLevels()) stillFrames_ = 0;
            return;
        }
        // A camera or a place of the scene before means nothing in this one.
        Settings settings = settings_;
        if (show_) {
            settings.view.camera = command_.settings.view.camera;
            settings.view.pose = command_.settings.view.pose;
        }
        auto show = std::make_unique<Show>(std::move(*scene), settings);
        FrameMaker::Input input = inputNow();
        input.time = settings.view.time;
        if (input.gaze) input.gaze->time = input.time;
        report_ = &show->maker().make(input);  // what is wrong with the settings shows here
        finishRecording();                     // what was recorded so far is of the scene before
        show_ = std::move(show);
        stages_ = {};  // what they keep is of the other scene
        split_ = {};
        history_ = {};
        settings_ = settings;
        command_.scene = loader_.name();
        start_ = glfwGetTime() - settings.view.time;
        heldTime_.reset();
        stillFrames_ = 0;
        error_.clear();
        woken_ = true;
    } catch (const std::exception& problem) {
        if (!show_) throw;
        logError(problem.what());
        error_ = problem.what();
        announced_ = false;
        woken_ = true;
        stillFrames_ = 0;
    }
}

/// Makes other settings those that are shown. What is wrong with them the panel says, and they stay as they were.
void Viewer::apply(const Wish& wish) {
    const Settings before = settings_;
    if (!sameSettings(wish.settings, before)) {
        try {
            show_->change(wish.settings);
            settings_ = wish.settings;
            stillFrames_ = 0;
            heldTime_.reset();
            makePicture(inputNow());
        } catch (const std::runtime_error& problem) {
            settings_ = before;
            show_->change(settings_);
            stillFrames_ = 0;
            panel_.complain(problem.what());
            if (!panelOpen_) say(problem.what());
            return;
        }
    }
    if (wish.history < 0) history_.undo();
    if (wish.history > 0) history_.redo();
    if (wish.edit) {
        Settings taken = before;
        taken.view.pose = wish.byHand ? wish.settings.view.pose : before.view.pose;
        history_.edited(taken, wish.settings, wish.goesOn);
    }
    const std::string& monitor = wish.settings.system.monitor;
    if (monitor != before.system.monitor && window_->isFullScreen()) fillMonitor(monitor);
    settings_ = wish.settings;
}

FrameMaker::Input Viewer::inputNow() {
    FrameMaker::Input input;
    input.time = sceneTime();
    input.mayLag = true;
    input.budgetMilliseconds = settings_.render.budgetMs.value_or(refreshMs_);
    input.refines = true;
    if (heldTime_) input.refineMilliseconds = kStillMilliseconds;
    // A trace plays; without one a tracker says it, or else the pointer.
    if (!settings_.focus.gazeTrace.empty()) return input;
    if (gazeInput_) {
        input.gaze = gazeInput_->gaze().at(glfwGetTime());
        input.tracked = true;
        input.gaze->time = input.time;
    } else if (settings_.focus.gazeSource == GazeSource::pointer) {
        const auto pointer = pointerGaze();
        // Outside the picture is as a lost tracker: focus holds.
        input.gaze = GazeSample{input.time, pointer.value_or(glm::dvec2(0.5)), pointer.has_value()};
    }
    return input;
}

void Viewer::makePicture(const FrameMaker::Input& input) {
    FrameMaker& maker = show_->maker();
    if (stillFrames_ == 0) split_.forget();
    maker.timeStages(panelOpen_ && instruments_.timesStages());
    report_ = &maker.make(input);
    pictureMade_ = true;
    ++drawn_.pictures;
    if (panelOpen_) framesToDraw_ = std::max(framesToDraw_, 1);  // its numbers are of this one
    ++stillFrames_;
    lastInput_ = input;
    lastPicture_ = glfwGetTime();
    if (split_.on()) {
        split_.draw(maker, settings_, kRefineMilliseconds);
        if (heldTime_ && maker.progress() >= 1.0 && split_.progress() >= 1.0) split_.measure(maker);
    }
    instruments_.note(lastPicture_, *report_, maker.focusFilter());
    if (!command_.log.empty()) log_.push_back(*report_);
    if (recording_) recording_->add(moment());
}

bool Viewer::instrumentsDue() const {
    return panelOpen_ && (lastSurvey_ < lastPicture_ || stages_.due());
}

/// For the panel's pictures: a bit of it now and then while the picture changes, the rest once it does not.
void Viewer::drawForInstruments() {
    const double now = glfwGetTime();
    if (!instrumentsDue() || (!heldTime_ && now - lastSurvey_ < kSurveySeconds)) return;
    const FrameMaker& maker = show_->maker();
    if (lastSurvey_ < lastPicture_) {
        depths_.survey(maker.scene(), maker.head());
        stages_.age();
        lastSurvey_ = glfwGetTime();
    }
    if (stages_.due())
        stages_.drawNext(maker.scene(), maker.head(), report_->lens.lens, report_->plan, settings_.render.exposureEv);
    framesToDraw_ = std::max(framesToDraw_, 1);
}

Placement Viewer::area() const {
    Placement all;
    glfwGetWindowSize(window_->handle(), &all.width, &all.height);
    if (panelOpen_) {
        const auto textHeight = static_cast<double>(ImGui::GetFontSize());
        all.x = static_cast<int>(std::lround(Panel::width(all.width, textHeight)));
        all.width -= all.x;
    }
    return all;
}

Placement Viewer::picture() const {
    const Placement beside = area();
    const ViewSettings& view = settings_.view;
    const DisplayChoice display = view.eye == EyeChoice::both ? view.display : DisplayChoice::mono;
    Placement place = fitted(composedSize(display, view.size), {beside.width, beside.height});
    place.x += beside.x;
    place.y += beside.y;
    return place;
}

/// Where the pointer is in its eye's picture, 0..1 from the top left; none outside the picture.
std::optional<glm::dvec2> Viewer::pointerGaze() const {
    if (ImGui::GetIO().WantCaptureMouse) return std::nullopt;
    double x = 0.0, y = 0.0;
    glfwGetCursorPos(window_->handle(), &x, &y);
    const Placement place = picture();
    glm::dvec2 gaze((x - place.x) / place.width, (y - place.y) / place.height);
    if (!(gaze.x >= 0.0 && gaze.x < 1.0 && gaze.y >= 0.0 && gaze.y < 1.0)) return std::nullopt;
    const ViewSettings& view = settings_.view;
    if (view.eye != EyeChoice::both) return gaze;
    const bool sideBySide = view.display == DisplayChoice::sideBySide || view.display == DisplayChoice::sideBySideHalf;
    if (sideBySide) gaze.x = gaze.x * 2.0 - (gaze.x >= 0.5 ? 1.0 : 0.0);
    if (view.display == DisplayChoice::topBottom) gaze.y = gaze.y * 2.0 - (gaze.y >= 0.5 ? 1.0 : 0.0);
    return gaze;
}

/// The line between two pictures, and what they are.
void Viewer::drawComparison() {
    const Placement all = picture();
    const auto top = static_cast<float>(all.y);
    const auto line = split_.line();
    const auto x = static_cast<float>(all.x + line.value_or(0.5) * all.width);
    if (!line) return drawLabel({x, top, 0.5f}, "difference \u00d7 4, " + split_.describe());
    ImGui::GetBackgroundDrawList()->AddLine({x, top}, {x, top + static_cast<float>(all.height)}, IM_COL32_WHITE, 2.0f);
    drawLabel({x, top, 1.0f}, planText(report_->plan));
    drawLabel({x, top, 0.0f}, split_.describe());
}

void Viewer::drawOver() {
    int place = 0;
    if (split_.on() && report_ && !wanted_) drawComparison();
    if (loader_.running())
        drawProgress(
            announced_ && !wanted_
                ? Progress{"preparing " + loader_.name(), 1.0}
                : Progress{fmt::format("loading {}, {:.0f} s", loader_.name(), loader_.seconds()), loader_.progress()},
            place++);
    if (wanted_)
        drawProgress({"finishing the picture to be written", show_->maker().progress()}, place++);
    else if (show_ && show_->makesLevels())
        drawProgress({"making levels of detail", show_->levelsProgress()}, place++);
    if (recording_) drawNotice(fmt::format("recording, {:.1f} s; R stops it", recording_->seconds()));
    if (!recording_ && !notice_.empty()) drawNotice(notice_);
    if (!error_.empty() && !drawError(error_)) error_.clear();
    if (keyListOpen_) keyListOpen_ = drawKeyList();
}

void Viewer::say(const std::string& text) {
    notice_ = text;
    noticeUntil_ = glfwGetTime() + kNoticeSeconds;
    woken_ = true;
}

void Viewer::showTitle() {
    std::string title = "Dioptre: ";
    if (!error_.empty()) {
        title += error_;
    } else if (!show_ || !report_) {
        title += loader_.running() ? loader_.name() : show_ ? show_->scene().name : "";
    } else {
        title += fmt::format("{}  focus {:.2f} D  {}  {:.1f} ms  F1 keys", show_->scene().name,
                             report_->lens.lens.focus.value, planText(report_->plan), report_->milliseconds);
        if (split_.on()) title += "  against " + split_.describe();
    }
    if (title == title_) return;
    glfwSetWindowTitle(window_->handle(), title.c_str());
    title_ = title;
}

}  // namespace dioptre
