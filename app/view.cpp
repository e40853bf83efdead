// dioptre view: the scene in a window; the pointer is the gaze, Escape closes.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>

#include "commands.hpp"
#include "core/file.hpp"
#include "frame/sequence.hpp"
#include "window.hpp"

namespace dioptre {

namespace {

// What a refining technique may take of a frame: input still feels immediate.
constexpr double kRefineMilliseconds = 50.0;

/// Where the pointer is in its eye's picture, 0..1 from the top left; none outside the window.
std::optional<glm::dvec2> pointerGaze(GLFWwindow* window, DisplayChoice display) {
    int width = 0, height = 0;
    double x = 0.0, y = 0.0;
    glfwGetWindowSize(window, &width, &height);
    glfwGetCursorPos(window, &x, &y);
    if (x < 0.0 || y < 0.0 || x >= width || y >= height) return std::nullopt;
    glm::dvec2 gaze(x / width, y / height);
    const bool sideBySide = display == DisplayChoice::sideBySide || display == DisplayChoice::sideBySideHalf;
    if (sideBySide) gaze.x = gaze.x * 2.0 - (gaze.x >= 0.5 ? 1.0 : 0.0);
    if (display == DisplayChoice::topBottom) gaze.y = gaze.y * 2.0 - (gaze.y >= 0.5 ? 1.0 : 0.0);
    return gaze;
}

}  // namespace

void runView(const Command& command) {
    if (!command.log.empty()) requireWritableName(command.log);
    Scene scene = loadScene(command);
    const Settings& settings = command.settings;
    const DisplayChoice display = settings.view.eye == EyeChoice::both ? settings.view.display : DisplayChoice::mono;
    const PictureSize size = composedSize(display, settings.view.size);
    Window window(size.width, size.height, "Dioptre: " + scene.name);
    // A key that is pressed and released within one frame counts.
    glfwSetInputMode(window.handle(), GLFW_STICKY_KEYS, GLFW_TRUE);
    FrameMaker maker(scene, settings);
    scene.releaseBulk();
    std::vector<FrameReport> shown;
    const double start = glfwGetTime();
    while (!glfwWindowShouldClose(window.handle()) && glfwGetKey(window.handle(), GLFW_KEY_ESCAPE) != GLFW_PRESS) {
        FrameMaker::Input input;
        input.time = glfwGetTime() - start;
        input.mayLag = true;
        input.budgetMilliseconds = kRefineMilliseconds;
        // A trace plays; without one, the pointer is the gaze.
        if (settings.focus.gazeTrace.empty()) {
            const auto pointer = pointerGaze(window.handle(), display);
            // Outside the window is as a lost tracker: focus holds.
            input.gaze = GazeSample{input.time, pointer.value_or(glm::dvec2(0.5)), pointer.has_value()};
        }
        const FrameReport& frame = maker.make(input);
        int width = 0, height = 0;
        glfwGetFramebufferSize(window.handle(), &width, &height);
        if (width > 0 && height > 0) maker.present(width, height);
        glfwSwapBuffers(window.handle());
        glfwSetWindowTitle(window.handle(), fmt::format("Dioptre: {}  focus {:.2f} D  {}  {:.1f} ms", scene.name,
                                                        frame.lens.lens.focus.value, frame.plan, frame.milliseconds)
                                                .c_str());
        if (!command.log.empty()) shown.push_back(frame);
        glfwPollEvents();
    }
    if (!command.log.empty()) writeFileAtomically(command.log, frameLogCsv(shown));
}

}  // namespace dioptre
