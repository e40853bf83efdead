// dioptre view: the scene in a window; the pointer is the gaze, a scene dropped onto it takes its place, Escape closes.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "commands.hpp"
#include "core/file.hpp"
#include "core/log.hpp"
#include "frame/sequence.hpp"
#include "interrupt.hpp"
#include "scene/lod.hpp"
#include "window.hpp"

namespace dioptre {

namespace {

constexpr double kNoticeSeconds = 10.0;  // how long the title says why a scene was refused

/// Where the pointer is in its eye's picture, 0..1 from the top left; none outside the picture.
std::optional<glm::dvec2> pointerGaze(GLFWwindow* window, DisplayChoice display, PictureSize picture) {
    PictureSize size;
    double x = 0.0, y = 0.0;
    glfwGetWindowSize(window, &size.width, &size.height);
    glfwGetCursorPos(window, &x, &y);
    const Placement place = fitted(picture, size);
    glm::dvec2 gaze((x - place.x) / place.width, (y - place.y) / place.height);
    if (!(gaze.x >= 0.0 && gaze.x < 1.0 && gaze.y >= 0.0 && gaze.y < 1.0)) return std::nullopt;
    const bool sideBySide = display == DisplayChoice::sideBySide || display == DisplayChoice::sideBySideHalf;
    if (sideBySide) gaze.x = gaze.x * 2.0 - (gaze.x >= 0.5 ? 1.0 : 0.0);
    if (display == DisplayChoice::topBottom) gaze.y = gaze.y * 2.0 - (gaze.y >= 0.5 ? 1.0 : 0.0);
    return gaze;
}

/// Of the first screen, ms; 60 Hz where it does not say.
double screenRefreshMs() {
    GLFWmonitor* monitor = glfwGetPrimaryMonitor();
    const GLFWvidmode* mode = monitor ? glfwGetVideoMode(monitor) : nullptr;
    return 1000.0 / (mode && mode->refreshRate > 0 ? mode->refreshRate : 60);
}

/// A scene and what draws it.
struct Show {
    Show(Scene&& shown, const Settings& settings) : scene(std::move(shown)), maker(scene, settings) {
        if (maker.mayUseLevels())
            levels = std::make_unique<LodBuilder>(scene, LodOptions{lodFolder()});
        else
            scene.releaseBulk();
    }
    /// Levels of detail that became ready, made while the window shows finer ones.
    void takeLevels() {
        if (!levels) return;
        const bool last = levels->finished();
        maker.addLevels(levels->take());
        if (!last) return;
        levels.reset();
        scene.releaseBulk();
    }
    /// "  levels 37 %" while they are made.
    std::string progressText() const {
        return levels ? fmt::format("  levels {:.0f} %", levels->progress() * 100.0) : "";
    }
    Scene scene;
    FrameMaker maker;
    std::unique_ptr<LodBuilder> levels;
};

class Viewer {
  public:
    explicit Viewer(const Command& command)
        : Viewer(command, loadScene(command)) {}  // before a window opens: it may be refused

    /// Until the window is closed; what was shown, where a log is asked for.
    std::vector<FrameReport> run() {
        std::vector<FrameReport> shown;
        while (!glfwWindowShouldClose(window_.handle()) &&
               glfwGetKey(window_.handle(), GLFW_KEY_ESCAPE) != GLFW_PRESS && !interrupted()) {
            const FrameReport& frame = drawFrame();
            if (!command_.log.empty()) shown.push_back(frame);
            glfwPollEvents();
            if (!dropped_.empty()) open(std::exchange(dropped_, {}));
        }
        return shown;
    }

  private:
    Viewer(const Command& command, Scene&& scene)
        : command_(command),
          display_(settings().view.eye == EyeChoice::both ? settings().view.display : DisplayChoice::mono),
          picture_(composedSize(display_, settings().view.size)),
          window_(picture_.width, picture_.height, "Dioptre: " + scene.name),
          show_(std::make_unique<Show>(std::move(scene), settings())) {
        // A key that is pressed and released within one frame counts.
        glfwSetInputMode(window_.handle(), GLFW_STICKY_KEYS, GLFW_TRUE);
        glfwSetWindowUserPointer(window_.handle(), this);
        glfwSetDropCallback(window_.handle(), [](GLFWwindow* window, int count, const char** paths) {
            if (count > 0) static_cast<Viewer*>(glfwGetWindowUserPointer(window))->dropped_ = paths[0];
        });
        start_ = glfwGetTime() - settings().view.time;
        refreshMs_ = screenRefreshMs();
    }

    const Settings& settings() const { return command_.settings; }

    const FrameReport& drawFrame() {
        FrameMaker::Input input;
        input.time = glfwGetTime() - start_;
        input.mayLag = true;
        input.budgetMilliseconds = settings().render.budgetMs.value_or(refreshMs_);
        input.refines = true;
        // A trace plays; without one, the pointer is the gaze.
        if (settings().focus.gazeTrace.empty()) {
            const auto pointer = pointerGaze(window_.handle(), display_, picture_);
            // Outside the picture is as a lost tracker: focus holds.
            input.gaze = GazeSample{input.time, pointer.value_or(glm::dvec2(0.5)), pointer.has_value()};
        }
        show_->takeLevels();
        const FrameReport& frame = show_->maker.make(input);
        PictureSize size;
        glfwGetFramebufferSize(window_.handle(), &size.width, &size.height);
        if (size.width > 0 && size.height > 0) show_->maker.present(size);
        glfwSwapBuffers(window_.handle());
        const std::string title = input.time < noticeUntil_
                                      ? notice_
                                      : fmt::format("Dioptre: {}  focus {:.2f} D  {}  {:.1f} ms{}", show_->scene.name,
                                                    frame.lens.lens.focus.value, planText(frame.plan),
                                                    frame.milliseconds, show_->progressText());
        glfwSetWindowTitle(window_.handle(), title.c_str());
        return frame;
    }

    /// Shows another scene; where it is refused, says why and goes on with the one that is there.
    void open(const std::string& path) {
        Command command = command_;
        command.scene = path;
        noticeUntil_ = 0.0;
        try {
            show_ = std::make_unique<Show>(loadScene(command), settings());
            start_ = glfwGetTime() - settings().view.time;
        } catch (const std::exception& error) {
            logError(error.what());
            notice_ = fmt::format("Dioptre: {}", error.what());
            noticeUntil_ = glfwGetTime() - start_ + kNoticeSeconds;
        }
    }

    const Command& command_;
    DisplayChoice display_;
    PictureSize picture_;
    Window window_;
    std::unique_ptr<Show> show_;
    std::string dropped_;  // a file, until it is opened
    std::string notice_;
    double start_ = 0.0, noticeUntil_ = 0.0, refreshMs_ = 0.0;
};

}  // namespace

void runView(const Command& command) {
    if (!command.log.empty()) requireWritableName(command.log);
    Viewer viewer(command);
    watchInterrupts();
    const std::vector<FrameReport> shown = viewer.run();
    if (!command.log.empty()) writeFileAtomically(command.log, frameLogCsv(shown));
}

}  // namespace dioptre
