// Frames that the governor plans: one plan for both eyes, fades, smaller pictures, still views, what it is told of a view.
#include <string>
#include <vector>

#include "frame/eye_picture.hpp"
#include "frame/frame_maker.hpp"
#include "frame/planned_pictures.hpp"
#include "frame/vergence_sampler.hpp"
#include "gl_fixture.hpp"
#include "metrics/metrics.hpp"
#include "moving_scenes.hpp"
#include "pictures.hpp"
#include "random_frames.hpp"
#include "test_scenes.hpp"

namespace dioptre {
namespace {

using namespace test;

class AutoGLTest : public GlTest {
  protected:
    static Settings someSettings() {
        Settings s;
        s.view.size = {192, 144};
        s.lens.apertureMm = 12.0;
        s.focus.focus = {FocusMode::metres, 0.5};
        return s;
    }
    /// 0.5 m on the left, 2 m on the right, a wall at 6 m.
    static Scene someScene() {
        SceneBuilder b;
        const View view = testView();
        b.wall(6.0, b.textured(checkerImage(8, {90, 90, 90, 255}, {160, 170, 180, 255})), 20.0);
        b.quad(view, {20.0, 48.0, 96.0, 120.0}, 0.5, b.textured(checkerImage(8)));
        b.quad(view, {110.0, 40.0, 170.0, 130.0}, 2.0, b.unlit({0.7f, 0.3f, 0.1f}));
        return b.camera().scene();
    }
};

TEST_F(AutoGLTest, OnePictureIsTheSameEachTime) {
    FrameMaker::Input input;
    input.budgetMilliseconds = 200.0;
    input.alone = true;
    FrameMaker first(someScene(), someSettings()), second(someScene(), someSettings());
    const Plan plan = first.make(input).plan;
    EXPECT_EQ(second.make(input).plan, plan);
    EXPECT_TRUE(first.composed().pixels == second.composed().pixels);
    EXPECT_NE(plan.technique, TechniqueChoice::pinhole) << "there is blur, and time for it";
    // What there is less time for is drawn more cheaply.
    input.budgetMilliseconds = 1e-3;
    FrameMaker hurried(someScene(), someSettings());
    EXPECT_NE(hurried.make(input).plan, plan);
}

TEST_F(AutoGLTest, AViewInFocusIsAPinholes) {
    Settings s = someSettings();
    s.lens.apertureMm = 0.0;
    FrameMaker maker(someScene(), s);
    FrameMaker::Input input;
    input.budgetMilliseconds = 200.0;
    input.alone = true;
    const FrameReport& report = maker.make(input);
    EXPECT_EQ(report.plan.technique, TechniqueChoice::pinhole);
    EXPECT_EQ(report.passes.count("blur"), 0);
    EXPECT_TRUE(std::any_of(report.passes.skipped.begin(), report.passes.skipped.end(),
                            [](const PassLog::Skipped& s) { return s.name == "blur"; }));
}

TEST_F(AutoGLTest, EyesAtOnePlaceSeeTheSameWhateverIsPlanned) {
    Settings s = someSettings();
    s.view.ipdMm = 0.0;
    s.view.size = {96, 72};
    FrameMaker maker(someScene(), s);
    // In what a pinhole takes here: no time is short or long by itself.
    Settings sharp = s;
    sharp.render.technique = TechniqueChoice::pinhole;
    FrameMaker pinhole(someScene(), sharp);
    double unit = 1e9;
    for (int i = 0; i < 5; ++i) unit = std::min(unit, pinhole.make({0.1 * i, {}, {}}).milliseconds);
    FrameMaker::Input input;
    std::vector<std::string> plans;
    bool faded = false, refined = false;
    for (int i = 0; i < 800 && !(plans.size() >= 3 && faded && refined); ++i) {
        // Budgets that move it up and down; the head rests now and then.
        const int phase = i % 160;
        input.time = i / 60.0;
        input.budgetMilliseconds = unit * (phase < 40 ? 25.0 : phase < 60 ? 0.5 : 50.0);
        if (phase < 140) input.head = Pose{{0.0005 * phase, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}};
        const FrameReport& report = maker.make(input);
        ASSERT_TRUE(report.decision.has_value());
        faded = faded || report.decision->fade.has_value();
        refined = refined || report.plan != report.decision->plan;
        if (plans.empty() || plans.back() != planText(methodOf(report.plan)))
            plans.push_back(planText(methodOf(report.plan)));
        const Image both = maker.composed();
        for (int y = 0; y < both.height; ++y)
            for (int x = 0; x < 96; ++x)
                for (int c = 0; c < 3; ++c)
                    ASSERT_EQ(both.at(x, y, c), both.at(x + 96, y, c))
                        << "frame " << i << ", " << planText(report.plan) << " at " << x << ", " << y;
    }
    EXPECT_GE(plans.size(), 3u) << "the plan hardly changed";
    EXPECT_TRUE(faded);
    EXPECT_TRUE(refined);
}

TEST_F(AutoGLTest, AStillViewBecomesTheReference) {
    FrameMaker maker(someScene(), someSettings());
    FrameMaker::Input input;
    input.budgetMilliseconds = 60.0;
    int samples = 0;
    for (int i = 0; i < 40; ++i) {
        input.time = i / 60.0;
        const FrameReport& report = maker.make(input);
        if (i < 20) continue;
        ASSERT_EQ(report.plan.technique, TechniqueChoice::reference);
        EXPECT_GE(*report.plan.samples, samples);
        samples = *report.plan.samples;
    }
    const Image reference = maker.pictureBy({TechniqueChoice::reference, {}, 1024, {}});
    EXPECT_GT(ssim(maker.composed(), reference), 0.99);
    // What was drawn beside it left the frame alone.
    const Image before = maker.composed();
    maker.pictureBy({TechniqueChoice::pinhole, 0, {}, {}});
    EXPECT_TRUE(maker.composed().pixels == before.pixels);
    // A step, and it begins anew.
    input.head = Pose{{0.001, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}};
    EXPECT_LT(maker.make(input).plan.samples.value_or(0), samples);
}

TEST_F(AutoGLTest, AFinishedRefinementTeachesNothing) {
    Settings s = someSettings();
    s.view.size = {12, 9};
    FrameMaker maker(someScene(), s);
    FrameMaker::Input input;
    input.budgetMilliseconds = 30.0;
    int finished = 0;
    double price = 0.0;
    for (int i = 0; i < 2000 && finished < 20; ++i) {
        input.time = i / 60.0;
        const FrameReport& report = maker.make(input);
        if (report.plan.samples != kMostSamples || report.plan.technique != TechniqueChoice::reference) continue;
        // The first one drew the last samples; what the others took is of no plan.
        if (++finished == 2) price = report.decision->foreseenMs;
        if (finished < 2) continue;
        EXPECT_EQ(report.decision->change, PlanChange::none);
        EXPECT_DOUBLE_EQ(report.decision->foreseenMs, price) << finished;
    }
    EXPECT_EQ(finished, 20);
}

TEST_F(AutoGLTest, SmallerPicturesAreEnlargedAndFadesAreMeans) {
    const GpuScene scene(someScene());
    Shot shot;
    shot.lens = lensFor(shot.view, 4.0, 2.0, 0.5);
    PassLog log;
    const EyeFrame frame{scene, shot.view, shot.lens, 1.0f, 0, {}, log};
    EyePicture eye;
    const Plan whole{TechniqueChoice::mipmap, 0, {}, {}}, half{TechniqueChoice::mipmap, 0, {}, {}, 4};
    const Image large = readPicture(eye.draw(whole, frame));
    EXPECT_EQ(eye.draw(half, frame).width(), large.width / 2);
    const Image small = readPicture(eye.fade(half, half, 1.0, frame));
    ASSERT_EQ(small.width, large.width);
    ASSERT_EQ(small.height, large.height);
    EXPECT_GT(ssim(small, large), 0.8);
    EXPECT_NE(small.pixels, large.pixels);
    const glm::dvec3 mean = meanColor(large, 0, 0, 192, 144);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(meanColor(small, 0, 0, 192, 144)[c] / mean[c], 1.0, 0.01);
    const Image faded = readPicture(eye.fade(half, whole, 0.25, frame));
    double worst = 0.0;
    for (std::size_t i = 0; i < faded.pixels.size(); ++i)
        worst = std::max(
            worst, static_cast<double>(std::abs(faded.pixels[i] - 0.75f * small.pixels[i] - 0.25f * large.pixels[i])));
    EXPECT_LT(worst, 2e-3);
}

TEST_F(AutoGLTest, WhatFramesTakeIsStillKnownAfterATechniqueWasNamed) {
    const Scene scene = someScene();
    Settings s = someSettings();
    FrameMaker maker(scene, s);
    FrameMaker::Input input;
    input.budgetMilliseconds = 100.0;
    EXPECT_EQ(maker.make(input).decision->why, "the first frame");
    input.time += 0.1;
    maker.make(input);
    Settings named = s;
    named.render.technique = TechniqueChoice::mipmap;
    maker.change(scene, named);
    input.time += 0.1;
    EXPECT_FALSE(maker.make(input).decision);
    maker.change(scene, s);
    input.time += 0.1;
    const FrameReport& report = maker.make(input);
    ASSERT_TRUE(report.decision);
    EXPECT_NE(report.decision->why, "the first frame");
}

TEST_F(AutoGLTest, AFadeThatIsBrokenOffMelts) {
    const GpuScene scene(someScene());
    Shot shot;
    shot.lens = lensFor(shot.view, 6.0, 2.0, 0.5);
    PassLog log;
    const EyeFrame frame{scene, shot.view, shot.lens, 1.0f, 0, {}, log};
    const Plan from{TechniqueChoice::pinhole, 0, {}, {}}, to{TechniqueChoice::reference, {}, 8, {}};
    EyePicture alone;
    const Image whole = readPicture(alone.draw(to, frame));
    const auto difference = [](const Image& a, const Image& b) {
        double sum = 0.0;
        for (std::size_t i = 0; i < a.pixels.size(); ++i)
            sum += static_cast<double>(std::abs(a.pixels[i] - b.pixels[i]));
        return sum;
    };
    constexpr double kStep = 1.0 / 60.0;
    for (const double weight : {0.3, 0.9}) {
        PlannedPictures pictures(1);
        const auto shown = [&](const Decision& decision) {
            pictures.draw(decision, {&frame, 1}, kStep, false);
            return readPicture(pictures.shown(0));
        };
        Decision decision;
        decision.plan = to;
        decision.fade = {from, weight};
        const Image faded = shown(decision);
        decision.fade.reset();
        Image before = faded;
        const Image after = shown(decision);
        if (weight > 0.5) {
            EXPECT_EQ(after.pixels, whole.pixels) << "that one was over";
            continue;
        }
        EXPECT_LT(difference(faded, after), 0.2 * difference(faded, whole));
        for (int i = 1; i < 13; ++i) {
            const Image now = shown(decision);
            EXPECT_LT(difference(before, now), 0.3 * difference(faded, whole)) << i;
            before = now;
        }
        EXPECT_EQ(before.pixels, whole.pixels);
    }
}

TEST_F(AutoGLTest, PicturesBelowHalfTheSizeAreDrawnWithLevelsOfDetail) {
    SceneBuilder b;
    b.quad(testView(), {40.0, 30.0, 150.0, 110.0}, 1.0, b.unlit({1.0f, 1.0f, 1.0f}));
    const Scene made = b.scene();
    const std::vector<std::uint32_t>& indices = made.meshes.front().primitives.front().indices;
    ASSERT_EQ(indices.size(), 6u);
    Shot shot;
    // Half of the square, off by 1.5 pixels of a picture of a quarter of the size
    const double off = 1.5 / (focalLengthPixels(shot.view).x / 4.0);
    GpuScene scene(made);
    scene.addLevel(0, 0, {{indices.begin(), indices.begin() + 3}, static_cast<float>(off), 0.0f});
    PassLog log;
    const EyeFrame frame{scene, shot.view, shot.lens, 1.0f, 0, {}, log};
    EyePicture eye;
    const auto drawn = [&](auto draw) {
        const std::uint64_t before = scene.trianglesDrawn();
        draw();
        return scene.trianglesDrawn() - before;
    };
    for (const TechniqueChoice choice : {TechniqueChoice::pinhole, TechniqueChoice::mipmap})
        for (const auto& [eighths, triangles] : {std::pair(2, 1u), {3, 2u}, {4, 2u}, {8, 2u}}) {
            const Plan plan{choice, 0, {}, {}, eighths};
            EXPECT_EQ(drawn([&] { eye.draw(plan, frame); }), triangles) << eighths;
        }
    const double allowed[] = {0.0, 5.9, 6.1};
    EXPECT_EQ(scene.triangles(shot.view, allowed), (std::vector<std::uint64_t>{2, 2, 1}));
    EXPECT_EQ(drawn([&] { scene.drawDepth(shot.view, 5.9); }), 2u);
    EXPECT_EQ(drawn([&] { scene.drawDepth(shot.view, 6.1); }), 1u);
}

TEST_F(AutoGLTest, TheStatisticsAreOfThePicture) {
    // 0.5 m in the left quarter, nothing else: sky.
    SceneBuilder b;
    b.quad(testView(), {-10.0, -10.0, 48.0, 154.0}, 0.5, b.unlit({1.0f, 1.0f, 1.0f}));
    const GpuScene scene(b.scene());
    for (const TechniqueChoice choice : kTechniques) {
        const auto technique = makeTechnique(choice);
        Shot shot;
        shot.lens = lensFor(shot.view, 0.1, 1.0, 2.0);
        draw(*technique, scene, shot);
        VergenceSampler sampler;
        PassLog log;
        EXPECT_TRUE(sampler.vergences().empty());
        sampler.start(technique->depth(), shot.view.near, log);
        glFinish();
        const auto vergences = sampler.vergences();
        EXPECT_NEAR(static_cast<double>(vergences.size()), 0.25 * 64 * 48, 64.0) << techniqueName(choice);
        for (const double vergence : vergences) EXPECT_NEAR(vergence, 2.0, 1e-4) << techniqueName(choice);
    }
}

TEST_F(AutoGLTest, AnEyeBlinksAPointerDoesNot) {
    const Scene scene = someScene();
    Settings s = someSettings();
    s.view.size = {48, 36};
    s.focus.focus = {FocusMode::gaze, 0.0};
    for (const bool tracked : {true, false}) {
        FrameMaker maker(scene, s);
        FrameMaker::Input input;
        input.budgetMilliseconds = 1e6;
        input.tracked = tracked;
        PlanChange change = PlanChange::none;
        for (int i = 0; i < 3; ++i) {
            input.time = 0.02 * i;
            input.gaze = GazeSample{input.time, {0.5, 0.5}, i < 2};
            input.head = Pose{{0.001 * i, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}};
            change = maker.make(input).decision->change;
        }
        EXPECT_EQ(change == PlanChange::rested, tracked);
    }
}

TEST_F(AutoGLTest, RandomFramesLeaveNothingBehind) {
    std::vector<Scene> scenes;
    scenes.push_back(someScene());
    scenes.push_back({});
    scenes.push_back(load(bendingBarGltf()));
    EXPECT_NO_THROW(RandomFrames(scenes, 7).run(500));
}

}  // namespace
}  // namespace dioptre
