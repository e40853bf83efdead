// What a view does not require is not done, and nobody can see that it was not.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "frame/frame_maker.hpp"
#include "gl_fixture.hpp"
#include "metrics/metrics.hpp"
#include "pictures.hpp"
#include "quality/requirements.hpp"
#include "render/accumulate/sharing.hpp"

namespace dioptre {
namespace {

using namespace test;

class RequirementsGLTest : public GlTest {
  protected:
    Image draw(Technique& technique, const GpuScene& scene, const Shot& shot) {
        log_.clear();
        return readPicture(
            technique.draw({scene, shot.view, shot.lens, shot.exposure, shot.msaa, shot.show, log_, shot.samples}));
    }
    bool skipped(std::string_view name) const {
        return std::ranges::count(log_.skipped, name, &PassLog::Skipped::name) > 0;
    }
    /// As many as that technique sends for one picture.
    std::uint64_t triangles(TechniqueChoice choice, const GpuScene& scene, const Shot& shot) {
        const std::uint64_t before = scene.trianglesDrawn();
        draw(*makeTechnique(choice), scene, shot);
        return scene.trianglesDrawn() - before;
    }

    PassLog log_;
    const std::unique_ptr<Technique> mipmap_ = makeTechnique(TechniqueChoice::mipmap);
};

// One step of an 8-bit display: more would be seen.
constexpr double kUnseen = 1.0 / 255.0;

const Texel kInk{40, 50, 90, 255}, kPaper{230, 220, 200, 255};

/// Patterned and plain things with all these vergences, one beside the other, before a wall of 0.25 D.
SceneBuilder thingsAt(const std::vector<double>& dioptres) {
    SceneBuilder b;
    b.wall(4.0, b.textured(checkerImage(16, kPaper, kInk)), 3.0);
    for (std::size_t i = 0; i < dioptres.size(); ++i) {
        const double width = 192.0 / static_cast<double>(dioptres.size()), x = width * static_cast<double>(i);
        const int material = i % 2 == 0 ? b.textured(checkerImage(4, {200, 60, 40, 255}, {60, 160, 200, 255}))
                                        : b.unlit({0.2f, 0.7f, 0.3f});
        b.quad(testView(), {x + 5.3, 20.4, x + width - 4.6, 120.7}, 1.0 / dioptres[i], material);
    }
    return b;
}

/// Its box is in view; but it lies between the centres of four pixels, and none shows it.
void addSpeck(SceneBuilder& b, double distance) {
    b.quad(testView(), {95.999, 71.999, 96.001, 72.001}, distance, b.unlit(glm::vec3(100.0f)));
}

/// Infinity has a CoC of that RADIUS, px, and what is 1 m away is in focus.
Lens focusedAtAMetre(double radius) {
    return lensFor(testView(), radius, 1.0, 0.0);
}

TEST_F(RequirementsGLTest, NothingInFrontOfFocusNoForegroundPasses) {
    Shot shot;
    shot.lens = focusedAtAMetre(10.0);
    SceneBuilder b = thingsAt({1.0, 0.8, 0.4});
    draw(*mipmap_, GpuScene(b.scene()), shot);
    EXPECT_EQ(log_.count("reach"), 0);
    EXPECT_EQ(log_.count("blur"), 1);
    EXPECT_TRUE(skipped("reach"));
    EXPECT_TRUE(skipped("foreground layers"));
    const double without = mipmap_->fetchesPerPixel().value();

    b.quad(shot.view, {20.0, 20.0, 60.0, 60.0}, 0.5, b.unlit(glm::vec3(1.0f)));
    draw(*mipmap_, GpuScene(b.scene()), shot);
    EXPECT_EQ(log_.count("reach"), 1);
    EXPECT_FALSE(skipped("reach"));
    EXPECT_FALSE(skipped("foreground layers"));
    EXPECT_LT(without, 0.6 * mipmap_->fetchesPerPixel().value());
}

TEST_F(RequirementsGLTest, SmallBlursBuildAFewPyramidLevels) {
    const GpuScene scene(thingsAt({1.0, 0.8}).scene());
    Shot shot;
    constexpr int kAll = 7;  // of half of 192 px
    double before = 0.0;
    int levelsBefore = 0;
    for (const double radius : {0.6, 20.0, 60.0, 150.0, 400.0}) {
        shot.lens = focusedAtAMetre(radius);
        draw(*mipmap_, scene, shot);
        const int levels = pyramidLevels(radius, false, kAll);
        const double fetches = mipmap_->fetchesPerPixel().value();
        EXPECT_EQ(skipped("pyramid's coarsest levels"), levels < kAll) << radius;
        EXPECT_EQ(fetches > before, levels > levelsBefore) << radius << ": " << levels << " levels";
        before = fetches;
        levelsBefore = levels;
    }
    EXPECT_EQ(levelsBefore, kAll);
}

TEST_F(RequirementsGLTest, NothingOutOfFocusNoBlurPasses) {
    const GpuScene scene(thingsAt({1.0, 1.5, 0.5}).scene());
    Shot shot;
    for (const int msaa : {0, 4}) {
        shot.msaa = msaa;
        shot.lens = focusedAtAMetre(0.49);
        draw(*mipmap_, scene, shot);
        for (const auto& pass : log_.entries)
            EXPECT_TRUE(pass.name == "geometry" || (msaa > 0 && pass.name == "resolve")) << pass.name;
        EXPECT_TRUE(skipped("blur"));
        shot.lens = focusedAtAMetre(0.6);
        draw(*mipmap_, scene, shot);
        EXPECT_EQ(log_.count("blur"), 1);
        EXPECT_FALSE(skipped("blur"));
    }
}

/// Three things at 2 m, nothing behind them.
SceneBuilder wholeInFocus() {
    SceneBuilder b;
    for (int i = 0; i < 3; ++i) {
        const double x = 10.3 + 60.0 * i;
        b.quad(testView(), {x, 30.4, x + 40.2, 110.7}, 2.0,
               i == 1 ? b.unlit({0.9f, 0.3f, 0.1f}) : b.textured(checkerImage(8, kPaper, kInk)));
    }
    return b;
}

TEST_F(RequirementsGLTest, WhatIsInFocusIsDrawnForItsEdgesOnly) {
    SceneBuilder b = wholeInFocus();
    b.wall(6.0, b.unlit(glm::vec3(0.3f)));
    const GpuScene scene(b.scene());
    Shot shot;
    shot.lens = lensFor(shot.view, 12.0, 0.5, 1.0 / 6.0);
    for (const int samples : {64, 256}) {
        shot.samples = samples;
        const std::uint64_t mine = triangles(TechniqueChoice::accumulate, scene, shot);
        const std::uint64_t ofWall = static_cast<std::uint64_t>(samples) * 2;
        const std::uint64_t renderings = (mine - ofWall) / (3 * 2);
        EXPECT_GE(renderings, std::uint64_t{kLeastJitters}) << samples;
        EXPECT_LE(renderings, std::uint64_t{kLeastJitters} * 4 / 3) << samples;
        EXPECT_EQ(triangles(TechniqueChoice::reference, scene, shot), static_cast<std::uint64_t>(samples) * 4 * 2);
    }
}

TEST_F(RequirementsGLTest, WhatNeitherEyeSeesIsNotDrawn) {
    constexpr std::uint64_t kQuad = 2;  // triangles
    const auto drawn = [](const Scene& scene, TechniqueChoice technique) {
        Settings s;
        s.view.size = {192, 144};
        s.render.technique = technique;
        s.render.samples = 16;
        s.focus.focus = {FocusMode::metres, 2.0};  // no gaze to look for the depth of
        FrameMaker maker(scene, s);
        const std::uint64_t before = maker.scene().trianglesDrawn();
        maker.make({});
        return maker.scene().trianglesDrawn() - before;
    };
    for (const TechniqueChoice technique : kTechniques) {
        const std::uint64_t each = usesSamples(technique) ? 16 : 1;
        SceneBuilder b;
        const int material = b.unlit(glm::vec3(0.5f));
        b.camera().quad(testView(), {60.0, 40.0, 120.0, 100.0}, 1.0, material);
        b.quad({-3.0, 0.0, -2.0}, {0.5, 0.5}, material);  // to the left
        b.quad({0.0, 3.0, -2.0}, {0.5, 0.5}, material);   // above
        b.quad({0.0, 0.0, 2.0}, {0.5, 0.5}, material);    // behind
        b.quad({0.0, 0.0, -0.02}, {0.2, 0.2}, material);  // before the near plane
        EXPECT_EQ(drawn(b.scene(), technique), 2 * kQuad * each) << techniqueName(technique);
        b.quad({-0.13, 0.0, -0.3}, {0.03, 0.03}, material);
        EXPECT_EQ(drawn(b.scene(), technique), 3 * kQuad * each) << techniqueName(technique) << ": the left eye's";
    }
}

// The widest circle of confusion that counts as sharp: a pinhole's picture instead of the mean of many.
TEST_F(RequirementsGLTest, SharpViewsAreAPinholesPicture) {
    const GpuScene scene(thingsAt({2.0, 1.5, 1.0, 0.6, 0.3}).scene());
    Shot shot;
    const auto widest = [&](double diameter) {
        shot.lens = lensFor(shot.view, 0.5 * diameter, 1.0, 2.0);  // as blurred as infinity
        const ViewContents range = scene.contents(shot.view);
        ViewFacts facts;
        facts.boxes = cocRange(shot.lens, focalLengthPixels(shot.view).x, Dioptres(range.nearest), Dioptres(0.0));
        return require(facts);
    };
    EXPECT_TRUE(widest(1.01 * kSharpDiameter).blur);
    EXPECT_FALSE(widest(0.99 * kSharpDiameter).blur);

    shot.samples = 1024;
    const Image reference = test::draw(TechniqueChoice::reference, scene, shot);
    Shot closed = shot;
    closed.lens.apertureRadius = Metres(0.0);
    const Image sharp = test::draw(TechniqueChoice::reference, scene, closed);
    EXPECT_GE(compareImages(reference, sharp).ssim, 0.999);
    // Four samples a pixel have worse edges than 1024, blurred or not: that is all that is lost.
    shot.msaa = 4;
    const Image pinhole = draw(*makeTechnique(TechniqueChoice::pinhole), scene, shot);
    const double kept = compareImages(reference, pinhole).ssim, edges = compareImages(sharp, pinhole).ssim;
    EXPECT_GE(kept, edges - 0.001);
    EXPECT_GE(kept, 0.99);
    RecordProperty("kept", std::to_string(kept));
    RecordProperty("edges", std::to_string(edges));
}

// Something in the bounds, but not in the picture, makes all passes run.

TEST_F(RequirementsGLTest, ForegroundPassesAndCoarseLevelsWouldChangeNothing) {
    for (const double radius : {0.6, 2.0, 8.0, 25.0, 60.0, 150.0})
        for (const double inFront : {0.95, 1.05, 2.0}) {  // CoC RADIUS of the nearest, px; a foreground begins at 1
            Shot shot;
            shot.lens = focusedAtAMetre(radius);
            shot.msaa = inFront < 1.0 ? 4 : 0;
            SceneBuilder b = thingsAt({1.0 + inFront / radius, 1.0, 0.9, 0.5, 0.3});
            const std::string what = fmt::format("CoC radius {}, in front {}", radius, inFront);
            const Image left = draw(*mipmap_, GpuScene(b.scene()), shot);
            EXPECT_EQ(log_.count("reach"), inFront > 1.0 ? 1 : 0) << what;
            EXPECT_EQ(skipped("pyramid's coarsest levels"), inFront < 1.0) << what;
            addSpeck(b, 0.1);
            const Image all = draw(*mipmap_, GpuScene(b.scene()), shot);
            EXPECT_EQ(log_.count("reach"), 1) << what;
            EXPECT_FALSE(skipped("pyramid's coarsest levels")) << what;
            const Worst worst = worstDifference(left, all);
            EXPECT_LE(worst.encoded, kUnseen) << what << ": " << worst;
        }
}

TEST_F(RequirementsGLTest, BlurPassesWouldChangeNothingInFocus) {
    for (const double radius : {0.2, 0.49, 0.6, 1.5})
        for (const int msaa : {0, 4}) {
            Shot shot;
            shot.lens = focusedAtAMetre(radius);
            shot.msaa = msaa;
            SceneBuilder b = thingsAt({1.9, 1.5, 1.0, 0.5});
            const std::string what = fmt::format("CoC radius {}, msaa {}", radius, msaa);
            const Image left = draw(*mipmap_, GpuScene(b.scene()), shot);
            EXPECT_EQ(log_.count("blur"), radius > 0.5 ? 1 : 0) << what;
            addSpeck(b, 0.1);
            const Image all = draw(*mipmap_, GpuScene(b.scene()), shot);
            EXPECT_EQ(log_.count("blur"), 1) << what;
            const Worst worst = worstDifference(left, all);
            EXPECT_LE(worst.encoded, kUnseen) << what << ": " << worst;
        }
}

/// The same triangles with one box around them all: none is left out while one is in view. Of one material.
Scene inOnePiece(Scene scene) {
    Primitive all;
    for (const Mesh& mesh : scene.meshes)
        for (const Primitive& p : mesh.primitives) {
            const auto first = static_cast<std::uint32_t>(all.vertices.size());
            for (const std::uint32_t i : p.indices) all.indices.push_back(first + i);
            all.vertices.insert(all.vertices.end(), p.vertices.begin(), p.vertices.end());
        }
    for (const Vertex& v : all.vertices) all.bounds.add(v.position);
    all.material = scene.meshes.front().primitives.front().material;
    scene.meshes = {{"", {std::move(all)}}};
    scene.instances = {{"", 0, glm::mat4(1.0f)}};
    return scene;
}

TEST_F(RequirementsGLTest, WhatIsOutsideTheViewIsDrawnAsLongAsItsBlurReachesIn) {
    Shot shot;
    shot.lens = lensFor(shot.view, 15.0, 0.5, 2.0);
    struct Step {
        double x;  // where the thing begins, px; the view ends at 192
        std::uint64_t pinhole, lens;
    };
    for (const auto& [x, pinhole, lens] : {Step{150.0, 2, 2}, {196.0, 1, 2}, {204.0, 1, 2}, {209.0, 1, 1}}) {
        SceneBuilder b;
        const int material = b.textured(checkerImage(8, kPaper, kInk));
        b.quad(shot.view, {30.3, 20.4, 120.6, 110.7}, 2.0, material);
        b.quad(shot.view, {x, 20.4, x + 30.0, 130.7}, 0.5, material);
        const GpuScene scene(b.scene()), whole(inOnePiece(b.scene()));
        for (const TechniqueChoice technique : kTechniques) {
            const std::uint64_t each = usesSamples(technique) ? 16 : 1;
            const std::uint64_t quads = usesSamples(technique) ? lens : pinhole;
            const std::string what = fmt::format("{}, from {} px on", techniqueName(technique), x);
            EXPECT_EQ(triangles(technique, scene, shot), quads * 2 * each) << what;
            EXPECT_EQ(triangles(technique, whole, shot), 2 * 2 * each) << what;
            const Worst worst = worstDifference(test::draw(technique, scene, shot), test::draw(technique, whole, shot));
            EXPECT_LE(worst.encoded, kUnseen) << what << ": " << worst;
        }
    }
}

}  // namespace
}  // namespace dioptre
