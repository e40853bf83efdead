// Keys and mouse: what each does to the viewer.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "backends/imgui_impl_glfw.h"
#include "core/text.hpp"
#include "viewer/viewer.hpp"

namespace dioptre {

namespace {

constexpr double kOrbitPerPixel = 0.006;  // radians: half a turn for 500 px
constexpr double kFast = 5.0;             // times, with Shift
constexpr double kLongestStep = 0.1;      // s: after a nap nobody has flown on

/// At any time; the others wait for a scene, or until a picture to be written is finished.
bool goesWithoutSettings(Action action) {
    constexpr Action kAnyTime[] = {Action::help, Action::panel, Action::fullScreen, Action::close};
    return std::find(std::begin(kAnyTime), std::end(kAnyTime), action) != std::end(kAnyTime);
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
        if (count > 0) viewerOf(w).dropped_.emplace_back(paths[0]);
    });
    glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int) {
        viewerOf(w).woken_ = true;
        viewerOf(w).gui_.button(button, action == GLFW_PRESS, viewerOf(w).pointer_);
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
    glfwSetFramebufferSizeCallback(window, [](GLFWwindow* w, int, int) {
        viewerOf(w).woken_ = true;
        viewerOf(w).windowMoved();
    });
    glfwSetWindowPosCallback(window, [](GLFWwindow* w, int, int) { viewerOf(w).windowMoved(); });
    glfwSetWindowIconifyCallback(window, [](GLFWwindow* w, int) { viewerOf(w).woken_ = true; });
}

/// Events come in order, many of them in a slow frame: of a drag counts all that lies between press and release.
void Viewer::pointerMoved(glm::dvec2 to) {
    for (int button = 0; button < 3; ++button)
        if (glfwGetMouseButton(window_->handle(), button) == GLFW_PRESS) dragged_[button] += to - pointer_;
    pointer_ = to;
}

/// Maybe under a pointer that stayed, of which there is no event.
void Viewer::windowMoved() {
    GLFWwindow* window = window_->handle();
    for (int button = 0; button < 3; ++button)
        if (glfwGetMouseButton(window, button) == GLFW_PRESS) return;
    glfwGetCursorPos(window, &pointer_.x, &pointer_.y);
}

void Viewer::takeWishes(Wish& wish) {
    // What is taken back, and what comes after it, is of settings that others are already there in: one step a frame.
    bool stepped = false;
    for (const Action action : std::exchange(actions_, {})) {
        const bool steps = action == Action::undo || action == Action::redo;
        const bool cancels = wanted_ && action == Action::picture;
        const bool early = settingsWait() && !goesWithoutSettings(action) && !cancels;
        const bool waits = early || stepped || (steps && wish.edit);
        stepped = stepped || (steps && !early);
        if (waits)
            actions_.push_back(action);
        else
            act(action, wish);
    }
    if (stepped) framesToDraw_ = std::max(framesToDraw_, 1);
    for (std::string& file : std::exchange(dropped_, {})) {
        if ((settingsWait() || stepped) && isSettingsFile(file))
            dropped_.push_back(std::move(file));
        else
            open(file, wish);
    }
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
            return toggleFullScreen();
        case Action::picture:
            wish.picture = true;
            return;
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
        case Action::compare:
            split_.compareWithNext();
            stillFrames_ = 0;
            return;
        case Action::difference:
            split_.toggleDifference();
            return;
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

void Viewer::toggleFullScreen() {
    if (window_->isFullScreen()) return window_->leaveFullScreen();
    fillMonitor(settings_.system.monitor);
}

void Viewer::fillMonitor(const std::string& monitor) {
    if (!window_->fillMonitor(monitor))
        say(fmt::format("no monitor {} is connected; there are {}", quote(monitor), monitorList(window_->monitors())));
}

/// Drags, the wheel and the keys that fly: where they put the head becomes the setting `pose`.
void Viewer::moveByHand(Wish& wish) {
    const ImGuiIO& io = ImGui::GetIO();
    Stance stance{show_->maker().startingView().pose, stance_.pivot};
    const Metres pivot = pivotAt(report_->lens.lens.focus, show_->scene().bounds);
    const View& view = show_->maker().head();
    const Frustum& f = view.frustum;
    const Placement place = picture();
    // Of one eye's picture, which may be squeezed
    const DisplayChoice display = settings_.view.eye == EyeChoice::both ? settings_.view.display : DisplayChoice::mono;
    const bool beside = display == DisplayChoice::sideBySide || display == DisplayChoice::sideBySideHalf;
    const glm::dvec2 pixels(place.width * (beside ? 0.5 : 1.0),
                            place.height * (display == DisplayChoice::topBottom ? 0.5 : 1.0));
    const glm::dvec2 tangentPerPixel =
        glm::dvec2(f.right - f.left, f.top - f.bottom) / glm::max(pixels, glm::dvec2(1.0));
    bool any = false;

    if (moveLine()) {
        std::fill(std::begin(dragged_), std::end(dragged_), glm::dvec2(0.0));
        return;
    }
    for (int button = 0; button < 3; ++button) {
        if (ImGui::IsMouseClicked(button) && !io.WantCaptureMouse) {
            dragging_[button] = true;
            stance_.pivot = stance.pivot = pivot;  // it stays while the button is held
        }
        const bool drags = dragging_[button];
        if (!ImGui::IsMouseDown(button)) dragging_[button] = false;
        // What was dragged before the interface came to the press waits with it.
        if (!drags && gui_.inputWaits()) continue;
        const glm::dvec2 moved = std::exchange(dragged_[button], glm::dvec2(0.0));
        if (!drags || moved == glm::dvec2(0.0)) continue;
        any = true;
        if (button == ImGuiMouseButton_Middle || (button == ImGuiMouseButton_Left && io.KeyShift))
            stance = pan(stance, glm::dvec2(moved.x, -moved.y) * tangentPerPixel);
        else if (button == ImGuiMouseButton_Left)
            stance = orbit(stance, {-moved.x * kOrbitPerPixel, moved.y * kOrbitPerPixel});
        else  // what is seen follows the hand
            stance = look(stance, {-moved.x * tangentPerPixel.x, moved.y * tangentPerPixel.y});
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
    wish.settings.view.pose = numbersOf(stance.pose);
    wish.byHand = true;
}

/// The line between two techniques' pictures, if the mouse has hold of it.
bool Viewer::moveLine() {
    const auto line = split_.line();
    if (!line) return movesLine_ = false;
    const Placement place = picture();
    const double x = (static_cast<double>(ImGui::GetIO().MousePos.x) - place.x) / place.width;
    constexpr double kReach = 8.0;  // pixels
    const bool at = !ImGui::GetIO().WantCaptureMouse && std::abs(x - *line) * place.width < kReach;
    if (at || movesLine_) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    if (!ImGui::IsMouseDown(ImGuiMouseButton_Left)) return movesLine_ = false;
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Left)) movesLine_ = at;
    if (movesLine_) split_.setLine(std::clamp(x, 0.0, 1.0));
    return movesLine_;
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
    // A camera may have no name; no name is the first camera.
    const auto named = std::find_if(cameras.begin(), cameras.end(), [&](const Camera& camera) {
        return !camera.name.empty() && camera.name == settings.view.camera;
    });
    // By index where names are not given, or given twice
    const auto number = parseInteger(settings.view.camera);
    std::size_t current = 0;
    if (named != cameras.end())
        current = static_cast<std::size_t>(named - cameras.begin());
    else if (number && *number > 0)
        current = static_cast<std::size_t>(*number);
    settings.view.camera = std::to_string((current + 1) % cameras.size());
}

}  // namespace dioptre
