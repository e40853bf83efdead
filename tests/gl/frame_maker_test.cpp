// The whole frame: eyes, focus, what is reported.
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "frame/frame_maker.hpp"
#include "gl_fixture.hpp"
#include "gl_objects.hpp"
#include "pictures.hpp"

namespace dioptre {
namespace {

using namespace test;

/// 192x144 per eye, from where testView() stands.
Settings someSettings() {
    Settings s;
    s.view.size = {192, 144};
    s.lens.lens = "eye";
    s.render.technique = TechniqueChoice::mipmap;
    s.render.msaa = 0;
    s.focus.dynamics = DynamicsChoice::instant;
    return s;
}

/// 0.5 m on the left, 2 m on the right, sky above both.
Scene leftNearRightFar() {
    SceneBuilder b;
    const View view = testView();
    b.quad(view, {-150.0, 48.0, 96.0, 300.0}, 0.5, b.textured(checkerImage(8)));
    b.quad(view, {60.0, 48.0, 342.0, 300.0}, 2.0, b.textured(checkerImage(8, {200, 60, 40, 255}, {40, 80, 200, 255})));
    return b.camera().scene();
}

class FrameMakerGLTest : public GlTest {
  protected:
    void SetUp() override {
        GlTest::SetUp();
        folder_ = std::filesystem::temp_directory_path() / ("dioptre_gl_test_" + std::to_string(::getpid()));
        std::filesystem::create_directories(folder_);
    }
    void TearDown() override {
        std::filesystem::remove_all(folder_);
        GlTest::TearDown();
    }
    std::string file(const char* name, const std::string& text) const {
        std::ofstream(folder_ / name) << text;
        return (folder_ / name).string();
    }
    static Image half(const Image& both, bool right) {
        Image eye(both.width / 2, both.height);
        for (int y = 0; y < eye.height; ++y)
            for (int x = 0; x < eye.width; ++x)
                for (int c = 0; c < 3; ++c) eye.at(x, y, c) = both.at(x + (right ? eye.width : 0), y, c);
        return eye;
    }

  private:
    std::filesystem::path folder_;
};

TEST_F(FrameMakerGLTest, NoEyeDistanceGivesTwoEqualPictures) {
    for (const TechniqueChoice technique : kTechniques)
        for (const int msaa : {0, 4}) {
            Settings s = someSettings();
            s.render.technique = technique;
            s.render.msaa = msaa;
            s.view.ipdMm = 0.0;
            s.lens.apertureMm = 8.0;
            FrameMaker maker(leftNearRightFar(), s);
            maker.make({});
            const Image both = maker.composed();
            ASSERT_EQ(both.width, 384);
            EXPECT_EQ(half(both, false).pixels, half(both, true).pixels)
                << techniqueName(technique) << ", msaa " << msaa;
        }
}

TEST_F(FrameMakerGLTest, DisparityIsEyeDistanceTimesVergence) {
    for (const double ipd : {0.063, 0.2}) {
        Settings s = someSettings();
        s.render.technique = TechniqueChoice::pinhole;
        s.view.ipdMm = ipd * 1e3;
        SceneBuilder b;
        // Its sides lean, so that its mean place is known to a fraction of a pixel.
        const auto at = [](double x, double y) { return worldAt(testView(), {x, y}, 1.0); };
        b.quad({at(84.0, 92.0), at(96.0, 92.0), at(108.0, 52.0), at(96.0, 52.0)}, b.unlit(glm::vec3(1.0f)));
        FrameMaker maker(b.camera().scene(), s);
        maker.make({});
        const Image both = maker.composed();
        EXPECT_EQ(countNotFinite(both), 0u);
        double centre[2] = {}, light[2] = {};
        for (int eye = 0; eye < 2; ++eye) {
            const Image picture = half(both, eye == 1);
            for (int y = 0; y < picture.height; ++y)
                for (int x = 0; x < picture.width; ++x) {
                    light[eye] += static_cast<double>(picture.at(x, y));
                    centre[eye] += static_cast<double>(picture.at(x, y)) * (x + 0.5);
                }
            ASSERT_GT(light[eye], 0.0) << "eye " << eye;
        }
        // What is near lies further right for the left eye.
        EXPECT_NEAR(centre[0] / light[0] - centre[1] / light[1], ipd * focalLengthPixels(testView()).x, 0.2)
            << "IPD " << ipd;
    }
}

TEST_F(FrameMakerGLTest, TheFirstFrameIsSettledOnWhatTheGazeSees) {
    for (const DynamicsChoice dynamics : {DynamicsChoice::natural, DynamicsChoice::instant}) {
        Settings s = someSettings();
        s.focus.dynamics = dynamics;
        FrameMaker maker(leftNearRightFar(), s);
        struct Look {
            glm::dvec2 gaze;
            double vergence;
        };
        double time = 100.0;
        for (const Look& look : {Look{{0.2, 0.7}, 2.0}, Look{{0.85, 0.7}, 0.5}, Look{{0.5, 0.1}, 0.0}}) {
            time -= 10.0;  // each a jump back: a first frame again
            const FrameReport& report = maker.make({time, GazeSample{time, look.gaze, true}, std::nullopt});
            EXPECT_EQ(report.time, time);
            EXPECT_EQ(report.gaze.position, look.gaze);
            ASSERT_TRUE(report.underGaze.has_value());
            EXPECT_NEAR(report.underGaze->value, look.vergence, 1e-3);
            EXPECT_NEAR(report.lens.lens.focus.value, look.vergence, 1e-3);
            EXPECT_EQ(report.lens.residual.value, 0.0);
            EXPECT_FALSE(report.passes.entries.empty());
            EXPECT_GT(report.milliseconds, 0.0);
        }
    }
}

TEST_F(FrameMakerGLTest, WhatTheGazeSeesIsSharpAndTheRestIsNot) {
    Settings s = someSettings();
    s.view.display = DisplayChoice::mono;
    s.view.eye = EyeChoice::centre;
    s.lens.apertureMm = 20.0;
    Settings sharpSettings = s;
    sharpSettings.render.technique = TechniqueChoice::pinhole;
    FrameMaker maker(leftNearRightFar(), s), pinhole(leftNearRightFar(), sharpSettings);
    const FrameMaker::Input input{0.0, GazeSample{0.0, {0.85, 0.7}, true},
                                  std::nullopt};  // at 2 m; the near one has 3.5 px
    maker.make(input);
    pinhole.make(input);
    const Image blurred = maker.composed(), sharp = pinhole.composed();
    EXPECT_LE(worstDifference(blurred, sharp, [](int x, int y) { return x > 110 && y > 60; }).linear, 2.0 / 255.0);
    EXPECT_GE(worstDifference(blurred, sharp, [](int x, int y) { return x < 80 && y > 60; }).linear, 0.1);
    // The sky is black and the wall in focus: no light of it above its edge.
    EXPECT_LE(worstDifference(blurred, sharp, [](int x, int y) { return x > 110 && y < 45; }).linear, 2.0 / 255.0);
}

TEST_F(FrameMakerGLTest, AFocusGivenIsKept) {
    Settings s = someSettings();
    s.focus.focus = {FocusMode::metres, 0.8};
    EXPECT_DOUBLE_EQ(FrameMaker(leftNearRightFar(), s).make({}).lens.lens.focus.value, 1.25);
    s.focus.focus = {FocusMode::infinity, 0.0};
    FrameMaker far(leftNearRightFar(), s);
    EXPECT_EQ(far.make({}).lens.lens.focus.value, 0.0);
    EXPECT_FALSE(far.make({}).underGaze.has_value());
    // Closer than the eye's focal length: no picture but an error that says so.
    s.focus.focus = {FocusMode::metres, 0.016};
    EXPECT_THROW(FrameMaker(leftNearRightFar(), s), InputError);
    s.focus.focus = {FocusMode::metres, 0.01767};
    FrameMaker close(leftNearRightFar(), s);
    close.make({});
    EXPECT_EQ(countNotFinite(close.composed()), 0u);
}

TEST_F(FrameMakerGLTest, AnInstantFilterFollowsAGazeTrace) {
    Settings s = someSettings();
    s.focus.gazeTrace =
        file("gaze.csv", "t_s,x,y,valid\n0,0.2,0.7,1\n0.1,0.85,0.7,1\n0.2,0.5,0.1,1\n0.3,nan,nan,0\n0.4,0.2,0.7,1\n");
    FrameMaker maker(leftNearRightFar(), s);
    const double wanted[] = {2.0, 2.0, 0.5, 0.5, 0.0, 0.0, 0.0, 0.0, 2.0, 2.0};  // held while the tracker is lost
    for (int i = 0; i < 10; ++i) {
        const FrameReport& report = maker.make({0.05 * i + 0.001, std::nullopt, std::nullopt});
        EXPECT_NEAR(report.lens.lens.focus.value, wanted[i], 1e-3) << "frame " << i;
        EXPECT_EQ(report.gaze.valid, i != 6 && i != 7) << "frame " << i;
    }
}

// Read without waiting, the depth is that of the frame before, never of an earlier one; waiting, it is this frame's.
TEST_F(FrameMakerGLTest, DepthUnderTheGazeIsOneFrameLate) {
    constexpr double kNear = 2.0, kFar = 0.5;
    for (const bool mayLag : {false, true}) {
        FrameMaker maker(leftNearRightFar(), someSettings());
        double before = kNear;
        for (int i = 0; i < 12; ++i) {
            const bool left = i % 3 == 0 || i == 7;
            FrameMaker::Input input;
            input.time = 0.1 * i;
            input.mayLag = mayLag;
            input.gaze = GazeSample{input.time, {left ? 0.2 : 0.8, 0.8}, true};
            const FrameReport& report = maker.make(input);
            const double now = left ? kNear : kFar;
            // The first frame waits for its own depth; the second has none newer.
            EXPECT_EQ(report.underGaze.has_value(), !mayLag || i != 1) << "frame " << i;
            EXPECT_NEAR(report.lens.lens.focus.value, mayLag ? before : now, 1e-3) << "frame " << i;
            before = now;
        }
    }
}

TEST_F(FrameMakerGLTest, AnInstantFilterFollowsAHeadTrace) {
    // Towards a wall at 2 m, then with a turn to the left by 90 degrees to one at 5 m.
    SceneBuilder b;
    const int m = b.unlit(glm::vec3(0.5f));
    b.quad({0.0, 0.0, -2.0}, {4.0, 4.0}, m);
    b.quad({glm::dvec3(-5.0, -9.0, 9.0), glm::dvec3(-5.0, -9.0, -9.0), glm::dvec3(-5.0, 9.0, -9.0),
            glm::dvec3(-5.0, 9.0, 9.0)},
           m);
    Settings s = someSettings();
    s.focus.headTrace = file("head.csv",
                             "t_s,x,y,z,qx,qy,qz,qw\n0,0,0,0,0,0,0,1\n1,0,0,-1,0,0,0,1\n"
                             "2,0,0,-1,0,0,0,1\n3,0,0,-1,0,0.70710678,0,0.70710678\n");
    FrameMaker maker(b.camera().scene(), s);
    for (const double t : {0.0, 0.25, 0.5, 1.0, 1.5})
        EXPECT_NEAR(maker.make({t, std::nullopt, std::nullopt}).lens.lens.focus.value, 1.0 / (2.0 - std::min(t, 1.0)),
                    1e-3)
            << "at " << t << " s";
    EXPECT_NEAR(maker.make({3.0, std::nullopt, std::nullopt}).lens.lens.focus.value, 0.2, 1e-3);
    // A head given by the viewer overrides the trace.
    const Pose back{{0.0, 0.0, 2.0}, {1.0, 0.0, 0.0, 0.0}};
    EXPECT_NEAR(maker.make({3.1, std::nullopt, back}).lens.lens.focus.value, 0.25, 1e-3);
}

TEST_F(FrameMakerGLTest, ScenesOfAllSizesAndNone) {
    for (const TechniqueChoice technique : kTechniques)
        for (const double scale : {0.0, 2.5e-5, 1.0, 2.5e4}) {  // 1e-3 m to 1e6 m across
            Settings s = someSettings();
            s.render.technique = technique;
            s.lens.apertureMm = std::min(200.0, 2e3 * scale);  // no lens whose rim sees past a crumb
            s.view.ipdMm = scale < 1.0 ? 0.0 : 200.0;          // no eyes stand beside a crumb and see it
            SceneBuilder b;
            b.sphere({0.0, 0.0, -3.0}, 1.0, b.unlit({0.3f, 0.6f, 0.2f}));
            b.wall(5.0, b.textured(checkerImage(8)));
            FrameMaker maker(scale > 0.0 ? b.scaled(scale).scene() : Scene{}, s);  // no camera: framed
            maker.make({});
            const Image picture = maker.composed();
            EXPECT_EQ(countNotFinite(picture), 0u) << techniqueName(technique) << ", scale " << scale;
            if (scale == 0.0) {
                EXPECT_EQ(worstDifference(picture, constantImage(384, 144, glm::vec3(0.0f))).linear, 0.0);
                EXPECT_EQ(maker.make({}).lens.lens.focus.value, 0.0);
            } else {
                const glm::dvec3 mean = meanColor(picture, 0, 0, 384, 144);
                EXPECT_GT(mean.y, 0.02) << techniqueName(technique) << ", scale " << scale << ": nothing to see";
            }
        }
}

TEST_F(FrameMakerGLTest, AllDisplaysOfOneEyeOrTwo) {
    for (const DisplayChoice display : {DisplayChoice::mono, DisplayChoice::sideBySide, DisplayChoice::sideBySideHalf,
                                        DisplayChoice::topBottom, DisplayChoice::anaglyph})
        for (const EyeChoice eye : {EyeChoice::left, EyeChoice::right, EyeChoice::centre, EyeChoice::both}) {
            Settings s = someSettings();
            s.render.technique = TechniqueChoice::pinhole;
            s.view.display = display;
            s.view.eye = eye;
            FrameMaker maker(leftNearRightFar(), s);
            maker.make({});
            const Image picture = maker.composed();
            const PictureSize one{192, 144};
            const PictureSize wanted = eye == EyeChoice::both ? composedSize(display, one) : one;
            EXPECT_EQ((PictureSize{picture.width, picture.height}), wanted)
                << "display " << int(display) << ", eye " << int(eye);
        }
}

FrameMaker::Input at(double time) {
    FrameMaker::Input input;
    input.time = time;
    return input;
}

TEST_F(FrameMakerGLTest, TellsHowMuchOfThePointsOfTheLensIsDrawn) {
    const Scene scene = leftNearRightFar();
    Settings settings = someSettings();
    settings.render.samples = 70;  // more than one group
    for (const std::optional<TechniqueChoice> technique :
         {std::optional(TechniqueChoice::reference), std::optional(TechniqueChoice::accumulate), {}}) {
        settings.render.technique = technique;
        FrameMaker::Input input;
        input.alone = true;
        input.budgetMilliseconds = 800.0;  // for what the governor chooses
        FrameMaker maker(scene, settings);
        maker.make(input);
        const Image silent = maker.composed();
        std::vector<double> told;
        input.onDrawn = [&](double share) { told.push_back(share); };
        maker.make(input);
        ASSERT_GE(told.size(), 4u) << "groups of each eye";
        EXPECT_TRUE(std::ranges::is_sorted(told));
        EXPECT_GT(told.front(), 0.0);
        EXPECT_EQ(std::ranges::count(told, 0.5), 1) << "one eye of two";
        EXPECT_EQ(told.back(), 1.0);
        EXPECT_EQ(maker.composed().pixels, silent.pixels);
    }
}

TEST_F(FrameMakerGLTest, ChangedSettingsDrawWhatAFreshOneDraws) {
    const Scene scene = leftNearRightFar();
    Settings s = someSettings();
    FrameMaker maker(scene, s);
    maker.make({});
    double time = 100.0;
    // One after another, each on top of those before
    const std::pair<const char*, const char*> edits[] = {{"aperture-mm", "12"},
                                                         {"technique", "pinhole"},
                                                         {"technique", "reference"},
                                                         {"samples", "5"},
                                                         {"technique", "mipmap"},
                                                         {"show", "coc"},
                                                         {"show", "none"},
                                                         {"msaa", "4"},
                                                         {"focus", "0.7"},
                                                         {"lens", "camera-50mm-f1.4"},
                                                         {"pose", "0.1,0,0.2,0,0,0,1"},
                                                         {"pose", ""},
                                                         {"size", "100x80"},
                                                         {"display", "top-bottom"},
                                                         {"display", "mono"},
                                                         {"display", "anaglyph"},
                                                         {"eye", "left"},
                                                         {"eye", "both"},
                                                         {"ipd-mm", "90"},
                                                         {"swap-eyes", "true"},
                                                         {"exposure", "-1"},
                                                         {"tonemap", "neutral"},
                                                         {"focus", "gaze"},
                                                         {"gaze", "0.2,0.7"}};
    for (const auto& [name, value] : edits) {
        applySetting(s, name, value);
        maker.change(scene, s);
        EXPECT_GE(maker.progress(), 0.0) << name << ": also before the next frame";
        time -= 1.0;  // a jump back: focus is settled, as in a first frame
        FrameMaker fresh(scene, s);
        EXPECT_EQ(planText(maker.make(at(time)).plan), planText(fresh.make(at(time)).plan));
        EXPECT_EQ(maker.composed().pixels, fresh.composed().pixels) << name << " " << value;
    }
}

TEST_F(FrameMakerGLTest, ARefusedChangeChangesNothing) {
    const Scene scene = leftNearRightFar();
    const Settings s = someSettings();
    FrameMaker maker(scene, s);
    maker.make(at(100.0));
    const Image before = maker.composed();
    const std::pair<const char*, const char*> edits[] = {
        {"lens", "no-such-lens"},         {"camera", "none"},
        {"size", "16384x16384"},          {"focus", "0.001"},
        {"gaze-trace", "/no/such/trace"}, {"head-trace", "/no/such"},
        {"screen-width-mm", "300"},       {"screen-distance-mm", "300"}};
    for (const auto& [name, value] : edits) {
        Settings wrong = s;
        applySetting(wrong, name, value);
        EXPECT_THROW(maker.change(scene, wrong), InputError) << name;
        maker.make(at(50.0));
        maker.make(at(100.0));
        maker.make(at(99.0));
        EXPECT_EQ(maker.composed().pixels, before.pixels) << name;
    }
}

TEST_F(FrameMakerGLTest, TwoThousandFramesOfChangesLeaveNothingBehind) {
    const GlObjects before = glObjectsAlive();
    GlObjects first{};
    for (int round = 0; round < 3; ++round) {
        const Scene scene = leftNearRightFar();
        Settings s = someSettings();
        s.view.size = {24, 18};
        s.render.samples = 4;
        FrameMaker maker(scene, s);
        double time = 0.0;
        for (const TechniqueChoice technique : kTechniques) {
            s.render.technique = technique;
            s.view.display = round % 2 ? DisplayChoice::sideBySide : DisplayChoice::anaglyph;
            for (int i = 0; i < 170; ++i) {
                s.view.ipdMm = 60.0 + i % 50;
                maker.change(scene, s);
                maker.make(at(time += 0.01));
            }
        }
        if (round == 0) first = glObjectsAlive();
        EXPECT_EQ(glObjectsAlive(), first) << "round " << round;
    }
    EXPECT_EQ(glObjectsAlive(), before);
}

}  // namespace
}  // namespace dioptre
