// Frames as no careful user makes them: heads and gazes that jump, trackers that fail, traces, single pictures, other
// plans' pictures, levels of detail that come late; budgets, settings and scenes that change. What must hold whatever
// happens: no GL error, finite pictures, both eyes by one plan, nothing left behind.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/resources.hpp"
#include "frame/frame_maker.hpp"
#include "gl_objects.hpp"
#include "scene/lod.hpp"

namespace dioptre::test {

class RandomFrames {
  public:
    /// The scenes outlive it.
    RandomFrames(const std::vector<Scene>& scenes, unsigned seed) : scenes_(scenes), random_(seed) {
        for (const Scene& scene : scenes) levels_.push_back(buildLevels(scene, {}));
    }

    /// So many frames, each maker's about forty. Throws std::runtime_error at the first thing that does not hold.
    void run(int frames) {
        for (int done = 0; done < frames;) {
            const int part = std::min(frames - done, whole(20, 60));
            const auto which = static_cast<std::size_t>(whole(0, static_cast<int>(scenes_.size()) - 1));
            Settings settings = someSettings();
            {
                FrameMaker maker(scenes_[which], settings);
                const int levelsFrom = whole(0, part);
                for (int i = 0; i < part; ++i) {
                    if (i == levelsFrom && maker.mayUseLevels()) maker.addLevels(levels_[which]);
                    if (chance(0.05)) maker.change(scenes_[which], settings = someSettings());
                    frame(maker, settings, done + i);
                }
            }
            done += part;
            const GlObjects left = glObjectsAlive();
            for (std::size_t i = 0; before_ && i < left.size(); ++i)
                if (left[i] != (*before_)[i])
                    throw std::runtime_error(fmt::format("frame {}: {} {} were alive, {} are", done, (*before_)[i],
                                                         kGlObjectNames[i], left[i]));
            before_ = left;
        }
    }

  private:
    double even(double least, double most) { return std::uniform_real_distribution(least, most)(random_); }
    int whole(int least, int most) { return std::uniform_int_distribution(least, most)(random_); }
    bool chance(double share) { return even(0.0, 1.0) < share; }
    /// Evenly in its logarithm.
    double scale(double least, double most) { return std::exp(even(std::log(least), std::log(most))); }

    Settings someSettings() {
        Settings s;
        s.view.size = {whole(1, 120), whole(1, 90)};
        s.view.eye = static_cast<EyeChoice>(chance(0.7) ? 3 : whole(0, 2));
        s.view.display = static_cast<DisplayChoice>(whole(0, 4));
        s.view.swapEyes = chance(0.2);
        s.view.ipdMm = chance(0.3) ? 0.0 : even(0.0, 200.0);
        if (chance(0.3)) s.render.technique = static_cast<TechniqueChoice>(whole(0, 3));
        s.render.samples = whole(1, 24);
        s.render.subsamples = whole(0, 8);
        s.render.msaa = chance(0.5) ? 4 : 0;
        s.render.exposureEv = even(-4.0, 4.0);
        const char* const lenses[] = {"eye", "eye-60", "camera-50mm-f1.4"};
        s.lens.lens = lenses[whole(0, 2)];
        if (chance(0.7)) s.lens.apertureMm = chance(0.1) ? 0.0 : scale(0.01, 50.0);
        s.lens.blades = whole(0, 8);
        s.focus.dynamics = static_cast<DynamicsChoice>(whole(0, 2));
        if (chance(0.2)) s.focus.focus = {FocusMode::metres, scale(0.1, 100.0)};
        if (chance(0.1)) s.focus.focus = {FocusMode::infinity, 0.0};
        if (chance(0.3)) {
            const char* const traces[] = {"seated", "walk", "reading", "sweep", "dropouts"};
            const std::string trace = fmt::format("assets/traces/{}", traces[whole(0, 4)]);
            s.focus.headTrace = resource(trace + ".head.csv");
            s.focus.gazeTrace = resource(trace + ".gaze.csv");
        }
        return s;
    }

    void frame(FrameMaker& maker, const Settings& settings, int number) {
        if (chance(0.02)) time_ -= even(0.0, 5.0);
        time_ += chance(0.05) ? even(0.0, 3.0) : even(0.005, 0.04);
        if (chance(0.05)) budget_ = chance(0.1) ? 0.0 : scale(0.01, 60.0);
        if (chance(0.1)) still_ = !still_;
        if (!still_) {
            head_.position += glm::dvec3(even(-0.05, 0.05), even(-0.05, 0.05), even(-0.05, 0.05));
            head_.orientation =
                glm::normalize(head_.orientation + glm::dquat(0.0, even(-0.1, 0.1), even(-0.1, 0.1), 0.0));
            if (chance(0.2)) gaze_ = {even(-0.2, 1.2), even(-0.2, 1.2)};
        }
        if (chance(0.02)) head_ = {};
        FrameMaker::Input input;
        input.time = time_;
        if (settings.focus.gazeTrace.empty()) {
            input.gaze = GazeSample{time_, gaze_, !chance(0.1)};
            input.head = head_;
        }
        input.alone = chance(0.03);
        input.mayLag = chance(0.5);
        input.budgetMilliseconds = budget_;
        input.refines = chance(0.5);
        const FrameReport& report = maker.make(input);
        const auto fail = [&](const std::string& what) {
            throw std::runtime_error(
                fmt::format("frame {}, {}, {}: {}", number, planText(report.plan), printSettings(settings), what));
        };
        if (const GLenum error = glGetError(); error != GL_NO_ERROR) fail(fmt::format("GL error {:#x}", error));
        if (!(report.milliseconds > 0.0)) fail("no time");
        if (chance(0.02) &&
            countNotFinite(maker.pictureBy({static_cast<TechniqueChoice>(whole(0, 3)), 0, 2, 2}, whole(0, 9))) != 0)
            fail("another plan's picture that is not finite");
        if (number % 7 != 0) return;
        const Image picture = maker.composed();
        if (countNotFinite(picture) != 0) fail("a picture that is not finite");
        // Without a distance between them both eyes see the same, by the same plan.
        const bool halves = settings.view.eye == EyeChoice::both && settings.view.display == DisplayChoice::sideBySide;
        if (!halves || settings.view.ipdMm != 0.0) return;
        const int width = picture.width / 2;
        for (int y = 0; y < picture.height; ++y)
            for (int x = 0; x < width; ++x)
                for (int c = 0; c < 3; ++c)
                    if (picture.at(x, y, c) != picture.at(x + width, y, c)) fail("the eyes' pictures differ");
    }

    const std::vector<Scene>& scenes_;
    std::vector<std::vector<BuiltLevel>> levels_;
    std::mt19937 random_;
    std::optional<GlObjects> before_;
    double time_ = 0.0, budget_ = 10.0;
    bool still_ = false;
    Pose head_;
    glm::dvec2 gaze_{0.5};
};

}  // namespace dioptre::test
