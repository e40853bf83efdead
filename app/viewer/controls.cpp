// Keys, mouse, panel and files: what each does to the viewer.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

#include "backends/imgui_impl_glfw.h"
#include "core/error.hpp"
#include "core/file.hpp"
#include "core/log.hpp"
#include "core/resources.hpp"
#include "core/text.hpp"
#include "viewer/sharp_range.hpp"
#include "viewer/viewer.hpp"

namespace dioptre {

namespace {

constexpr double kOrbitPerPixel = 0.006;  // radians: half a turn for 500 px
constexpr double kFast = 5.0;             // times, with Shift
constexpr double kLongestStep = 0.1;      // s: after a nap nobody has flown on
// Where a screen stands that was never measured: a desktop's, one eye's picture half of it.
constexpr double kScreenWidthMm = 300.0, kScreenDistanceMm = 650.0;

std::array<double, 7> poseNumbers(const Pose& pose) {
    const auto& [p, q] = pose;
    return {p.x, p.y, p.z, q.x, q.y, q.z, q.w};
}

/// A screen has a width and a distance: with the first of them comes the other, and they go together.
void completeScreen(const ViewSettings& before, ViewSettings& after) {
    if (after.screenWidthMm.has_value() == after.screenDistanceMm.has_value()) return;
    const bool went = before.screenWidthMm && before.screenDistanceMm;
    if (went) {
        after.screenWidthMm.reset();
        after.screenDistanceMm.reset();
    } else {
        if (!after.screenWidthMm) after.screenWidthMm = kScreenWidthMm;
        if (!after.screenDistanceMm) after.screenDistanceMm = kScreenDistanceMm;
    }
}

Viewer& viewerOf(GLFWwindow* window) {
    return *static_cast<Viewer*>(glfwGetWindowUserPointer(window));
}

}  // namespace

void Viewer::listen() {
    GLFWwindow* window = window_->handle();
    // A key that is pressed and released within one frame counts.
    glfwSetInputMode(window, GLFW_STICKY_KEYS, GLFW_TRUE);
    glfwSetWindowUserPointer(window, this);
    glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int scancode, int action, int mods) {
        Viewer& self = viewerOf(w);
        self.woken_ = true;
        self.gui_.key(key, scancode, action, mods);
        if (action != GLFW_PRESS) return;
        const bool control = (mods & GLFW_MOD_CONTROL) != 0;
        const bool typed = self.gui_.takesKeys() && (key < GLFW_KEY_F1 || key > GLFW_KEY_F25);
        const Action wanted = actionOf(key, control);
        if (wanted != Action::none && (!typed || wanted == Action::search)) self.actions_.push_back(wanted);
    });
    glfwSetDropCallback(window, [](GLFWwindow* w, int count, const char** paths) {
        viewerOf(w).woken_ = true;
        if (count > 0) viewerOf(w).dropped_ = paths[0];
    });
    glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int mods) {
        viewerOf(w).woken_ = true;
        ImGui_ImplGlfw_MouseButtonCallback(w, button, action, mods);
    });
    glfwSetScrollCallback(window, [](GLFWwindow* w, double x, double y) {
        viewerOf(w).woken_ = true;
        ImGui_ImplGlfw_ScrollCallback(w, x, y);
    });
    glfwSetCharCallback(window, [](GLFWwindow* w, unsigned letter) {
        viewerOf(w).woken_ = true;
        ImGui_ImplGlfw_CharCallback(w, letter);
    });
    glfwSetCursorEnterCallback(window, [](GLFWwindow* w, int entered) {
        viewerOf(w).woken_ = true;
        ImGui_ImplGlfw_CursorEnterCallback(w, entered);
    });
    glfwSetWindowFocusCallback(window, [](GLFWwindow* w, int focused) {
        viewerOf(w).woken_ = true;
        ImGui_ImplGlfw_WindowFocusCallback(w, focused);
    });
    glfwGetCursorPos(window, &pointer_.x, &pointer_.y);
    glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) {
        viewerOf(w).woken_ = true;
        viewerOf(w).pointerMoved({x, y});
    });
    glfwSetWindowRefreshCallback(window, [](GLFWwindow* w) { viewerOf(w).woken_ = true; });
    glfwSetFramebufferSizeCallback(window, [](GLFWwindow* w, int, int) { viewerOf(w).woken_ = true; });
    glfwSetWindowIconifyCallback(window, [](GLFWwindow* w, int) { viewerOf(w).woken_ = true; });
}

/// Events come in order, many of them in a slow frame: of a drag counts all that lies between press and release.
void Viewer::pointerMoved(glm::dvec2 to) {
    for (int button = 0; button < 3; ++button)
        if (glfwGetMouseButton(window_->handle(), button) == GLFW_PRESS) dragged_[button] += to - pointer_;
    pointer_ = to;
}

void Viewer::takeWishes(Wish& wish) {
    for (const Action action : std::exchange(actions_, {})) act(action, wish);
    if (!dropped_.empty()) open(std::exchange(dropped_, {}), wish);
    const double now = glfwGetTime();
    if (show_) moveByHand(wish);
    lastFrame_ = now;
    if (panelOpen_) drawPanel(wish);
    completeScreen(settings_.view, wish.settings.view);
}

void Viewer::act(Action action, Wish& wish) {
    ViewSettings& view = wish.settings.view;
    switch (action) {
        case Action::none:
            return;
        case Action::help:
            keyListOpen_ = !keyListOpen_;
            return;
        case Action::panel:
            panelOpen_ = !panelOpen_;
            return;
        case Action::search:
            panelOpen_ = true;
            panel_.search();
            return;
        case Action::fullScreen:
            window_->toggleFullScreen();
            return;
        case Action::picture:
            return beginPicture();
        case Action::record:
            return toggleRecording();
        case Action::nextCamera:
            nextCamera(wish.settings);
            break;
        case Action::reset:
            view.pose.reset();
            wish.byHand = true;
            return;
        case Action::nextDisplay:
            view.display = static_cast<DisplayChoice>((static_cast<int>(view.display) + 1) % kDisplays);
            break;
        case Action::swapEyes:
            view.swapEyes = !view.swapEyes;
            break;
        case Action::fitSize:
            fitSize(wish.settings);
            break;
        case Action::undo:
        case Action::redo:
            if (action == Action::undo ? !history_.canUndo() : !history_.canRedo()) return;
            wish.settings = action == Action::undo ? history_.undone(settings_) : history_.redone(settings_);
            wish.history = action == Action::undo ? -1 : 1;
            return;
        case Action::close:
            // What lies over the picture first
            if (!error_.empty())
                error_.clear();
            else if (keyListOpen_)
                keyListOpen_ = false;
            else
                glfwSetWindowShouldClose(window_->handle(), GLFW_TRUE);
            return;
    }
    wish.edit = true;
}

/// Drags, the wheel and the keys that fly: where they put the head becomes the setting `pose`.
void Viewer::moveByHand(Wish& wish) {
    const ImGuiIO& io = ImGui::GetIO();
    Stance stance{show_->maker().startingView().pose, stance_.pivot};
    const Metres pivot = pivotAt(report_->lens.lens.focus, show_->scene().bounds);
    const View& view = show_->maker().head();
    const Frustum& f = view.frustum;
    const Placement place = picture();
    const bool halves = settings_.view.display == DisplayChoice::sideBySide && settings_.view.eye == EyeChoice::both;
    const double tangentPerPixel = (f.right - f.left) / std::max(1.0, place.width * (halves ? 0.5 : 1.0));
    bool any = false;

    if (moveLine()) {
        std::fill(std::begin(dragged_), std::end(dragged_), glm::dvec2(0.0));
        return;
    }
    for (int button = 0; button < 3; ++button) {
        const glm::dvec2 moved = std::exchange(dragged_[button], glm::dvec2(0.0));
        if (ImGui::IsMouseClicked(button) && !io.WantCaptureMouse) {
            dragging_[button] = true;
            stance_.pivot = stance.pivot = pivot;  // it stays while the button is held
        }
        const bool drags = dragging_[button];
        if (!ImGui::IsMouseDown(button)) dragging_[button] = false;
        if (!drags || moved == glm::dvec2(0.0)) continue;
        any = true;
        if (button == ImGuiMouseButton_Middle || (button == ImGuiMouseButton_Left && io.KeyShift))
            stance = pan(stance, glm::dvec2(moved.x, -moved.y) * tangentPerPixel);
        else if (button == ImGuiMouseButton_Left)
            stance = orbit(stance, {-moved.x * kOrbitPerPixel, moved.y * kOrbitPerPixel});
        else  // what is seen follows the hand
            stance = look(stance, {-moved.x * tangentPerPixel, moved.y * tangentPerPixel});
    }
    if (io.MouseWheel != 0.0f && !io.WantCaptureMouse) {
        stance = zoom({stance.pose, pivot}, static_cast<double>(io.MouseWheel));
        any = true;
    }
    const bool control = io.KeyCtrl;
    const double step = std::min(glfwGetTime() - lastFrame_, kLongestStep) * flyingSpeed(show_->scene().bounds) *
                        (io.KeyShift ? kFast : 1.0);
    for (const FlyKey& key : flyKeys()) {
        const bool held = glfwGetKey(window_->handle(), key.key) == GLFW_PRESS;
        if (!held || control || gui_.takesKeys()) continue;
        glm::dvec3 way(0.0);
        way[key.axis] = key.way * step;
        stance = fly(stance, way);
        any = true;
    }
    if (!any) return;
    framesToDraw_ = std::max(framesToDraw_, 1);
    wish.settings.view.pose = poseNumbers(stance.pose);
    wish.byHand = true;
}

/// The line between two techniques' pictures, if the mouse has hold of it.
bool Viewer::moveLine() {
    const auto line = split_.line();
    if (!ImGui::IsMouseDown(ImGuiMouseButton_Left) || !line) return movesLine_ = false;
    const Placement place = picture();
    const double x = (static_cast<double>(ImGui::GetIO().MousePos.x) - place.x) / place.width;
    constexpr double kReach = 8.0;  // pixels
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Left) && !ImGui::GetIO().WantCaptureMouse)
        movesLine_ = std::abs(x - *line) * place.width < kReach;
    if (movesLine_) split_.setLine(std::clamp(x, 0.0, 1.0));
    return movesLine_;
}

void Viewer::drawPanel(Wish& wish) {
    const ValueHints known = hints();
    const std::function<void(std::string_view)> pictures = [&](std::string_view group) {
        drawInstruments(group, wish);
    };
    stages_.hide();  // unless they are drawn
    const PanelEdit edit = panel_.draw({wish.settings, known, history_.canUndo(), history_.canRedo(), pictures});
    if (edit.undo) act(Action::undo, wish);
    if (edit.redo) act(Action::redo, wish);
    if (!edit.load.empty()) open(edit.load, wish);
    if (edit.settings) {
        wish.settings = *edit.settings;
        wish.edit = true;
        wish.goesOn = edit.goesOn;
    }
    if (edit.save.empty()) return;
    try {
        writeFileAtomically(edit.save, printSettings(settings_));
        say("written: " + edit.save);
    } catch (const std::runtime_error& problem) {
        panel_.complain(problem.what());
    }
}

void Viewer::drawInstruments(std::string_view group, Wish& wish) {
    if (!show_ || !report_) return;
    if (group == "Eye and lens") depths_.draw(*report_, show_->maker().head());
    if (group == "Focus" && settings_.focus.focus.mode == FocusMode::gaze) instruments_.drawFocus();
    if (group == "Display") warnOfDisparity();
    if (group == "Budget") instruments_.drawFrameTimes();
    if (group != "Measure") return;
    if (split_.drawPanel()) stillFrames_ = 0;
    instruments_.drawStages();
    if (const auto stage = stages_.draw(settings_.render.show)) {
        wish.settings.render.show = *stage;
        wish.edit = true;
    }
}

void Viewer::warnOfDisparity() const {
    const ViewSettings& view = settings_.view;
    if (!view.screenDistanceMm || !depths_.range() || view.eye != EyeChoice::both) return;
    const auto degrees = [&](double vergence) {
        const Radians angle =
            screenDisparity(Metres(view.ipdMm * 1e-3), Metres(*view.screenDistanceMm * 1e-3), Dioptres(vergence));
        return glm::degrees(angle.value);
    };
    const double front = degrees(depths_.range()->nearest), behind = -degrees(depths_.range()->farthest);
    const bool strains = std::max(front, behind) > kComfortableDegrees;
    const ImVec4 color = strains ? ImVec4(1.0f, 0.7f, 0.3f, 1.0f) : ImGui::GetStyle().Colors[ImGuiCol_TextDisabled];
    ImGui::PushStyleColor(ImGuiCol_Text, color);
    ImGui::TextWrapped("disparity up to %.2f degrees in front of the screen, %.2f behind%s", std::max(front, 0.0),
                       std::max(behind, 0.0), strains ? ": more than 1 is hard to look at" : "");
    ImGui::PopStyleColor();
}

ValueHints Viewer::hints() const {
    ValueHints hints;
    hints.first = [this](const Setting& setting) -> std::string {
        if (setting.name == "aperture-mm" && report_)
            return fmt::format("{:.2f}", report_->lens.apertureDiameter.value * 1e3);
        if (setting.name == "age") return "40";
        if (setting.name == "samples") return "32";
        if (setting.name == "screen-width-mm") return printNumber(kScreenWidthMm);
        if (setting.name == "screen-distance-mm") return printNumber(kScreenDistanceMm);
        return {};
    };
    hints.choices = [this](const Setting& setting) {
        std::vector<std::string> choices;
        if (setting.name == "lens")
            for (const auto& entry : std::filesystem::directory_iterator(resource("config/lenses")))
                choices.push_back(entry.path().stem().string());
        std::sort(choices.begin(), choices.end());
        if (setting.name == "camera" && show_)
            for (const Camera& camera : show_->scene().cameras) choices.push_back(camera.name);
        return choices;
    };
    return hints;
}

/// A file of settings, or else a scene.
void Viewer::open(const std::string& file, Wish& wish) {
    if (!file.ends_with(".json")) {
        Command command = command_;
        command.settings = settings_;
        command.scene = file;
        error_.clear();
        loader_.load(command);
        return;
    }
    try {
        loadSettings(file, wish.settings);
        wish.edit = true;
        say("settings: " + file);
    } catch (const InputError& problem) {
        error_ = problem.what();
        logError(problem.what());
    }
}

/// One eye's picture as large as it can be shown.
void Viewer::fitSize(Settings& settings) const {
    PictureSize window, pixels;
    glfwGetWindowSize(window_->handle(), &window.width, &window.height);
    glfwGetFramebufferSize(window_->handle(), &pixels.width, &pixels.height);
    const Placement beside = area();
    const double scale = static_cast<double>(pixels.width) / std::max(1, window.width);
    const PictureSize once = composedSize(settings.view.display, {1, 1});
    const bool both = settings.view.eye == EyeChoice::both;
    settings.view.size.width = std::max(1, static_cast<int>(beside.width * scale) / (both ? once.width : 1));
    settings.view.size.height = std::max(1, static_cast<int>(beside.height * scale) / (both ? once.height : 1));
}

void Viewer::nextCamera(Settings& settings) const {
    const auto& cameras = show_ ? show_->scene().cameras : std::vector<Camera>();
    settings.view.pose.reset();
    if (cameras.empty()) return;
    const auto named = std::find_if(cameras.begin(), cameras.end(),
                                    [&](const Camera& camera) { return camera.name == settings.view.camera; });
    // By index where names are not given, or given twice
    const auto number = parseInteger(settings.view.camera);
    std::size_t current = 0;
    if (named != cameras.end())
        current = static_cast<std::size_t>(named - cameras.begin());
    else if (number && *number > 0)
        current = static_cast<std::size_t>(*number);
    settings.view.camera = std::to_string((current + 1) % cameras.size());
}

Moment Viewer::moment() const {
    return {report_->time, show_->maker().head().pose, report_->gaze, report_->lens.lens.focus, report_->plan};
}

/// From the next frame on the moment is drawn as `render` would, until nothing is missing of it.
void Viewer::beginPicture() {
    if (!show_ || !report_) return;
    if (wanted_) {  // nobody waits for it any longer
        wanted_.reset();
        show_->change(settings_);
        stillFrames_ = 0;
        return;
    }
    WantedPicture picture{nextName("."), settingsOf(moment(), settings_)};
    show_->change(picture.settings);
    wanted_ = std::move(picture);
}

void Viewer::drawPictureToBeWritten() {
    FrameMaker::Input input;
    input.time = wanted_->settings.view.time;
    input.budgetMilliseconds = kRefineMilliseconds;
    input.refines = true;
    report_ = &show_->maker().make(input);
    pictureMade_ = true;
    const bool coarse = show_->makesLevels() && show_->maker().mayUseLevels();
    if (coarse || show_->maker().progress() < 1.0) return;
    const WantedPicture done = std::move(*wanted_);
    wanted_.reset();
    try {
        writePicture(done.name, show_->maker().composed(), done.settings);
        say(fmt::format(
            "written: {0}.png, .exr; dioptre render {1} --config {0}.json --out {0}-again.png draws it again",
            done.name.lexically_normal().string(), command_.scene));
    } catch (const std::runtime_error& problem) {
        error_ = problem.what();
        logError(problem.what());
    }
    show_->change(settings_);
    stillFrames_ = 0;
}

void Viewer::toggleRecording() {
    if (!show_ || !report_) return;
    if (recording_)
        finishRecording();
    else
        recording_.emplace(show_->maker().startingView().pose);
    stillFrames_ = 0;
}

void Viewer::finishRecording() {
    if (!recording_) return;
    const Recording recording = std::move(*recording_);
    recording_.reset();
    if (recording.empty()) return;
    try {
        const auto name = nextName(".").lexically_normal();
        recording.write(name, settings_);
        say(fmt::format("written: {0}.head.csv, .gaze.csv; --config {0}.json follows them for {1:.1f} s", name.string(),
                        recording.seconds()));
    } catch (const std::runtime_error& problem) {
        error_ = problem.what();
        logError(problem.what());
    }
}

}  // namespace dioptre
