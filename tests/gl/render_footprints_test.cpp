// What is smoothed of an accumulated picture, by how far apart the points of the lens see it; and what is not.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "gl_fixture.hpp"
#include "metrics/metrics.hpp"
#include "pictures.hpp"
#include "render/accumulate/accumulate.hpp"
#include "shaders/shared/accumulate_types.h"

namespace dioptre {
namespace {

using namespace test;

constexpr int kSamples = 8, kSubsamples = 8, kPoints = kSamples * (kSubsamples + 1);

class FootprintGLTest : public GlTest {
  protected:
    Image draw(const SceneBuilder& scene, const Shot& shot, int samples = kSamples, int subsamples = kSubsamples) {
        log_.clear();
        const GpuScene gpu(scene.scene());
        EyeFrame frame{gpu, shot.view, shot.lens, shot.exposure, 0, {}, log_, samples, subsamples};
        return readPicture(technique_.draw(frame));
    }
    static Image plain(const SceneBuilder& scene, const Shot& shot, int samples) {
        Shot one = shot;
        one.samples = samples;
        return test::draw(TechniqueChoice::reference, GpuScene(scene.scene()), one);
    }

    PassLog log_;
    Accumulate technique_;
};

/// Where a picture's light is, and how far it spreads: red alone.
struct Spread {
    double light = 0.0, x = 0.0, y = 0.0, varianceX = 0.0, varianceY = 0.0;
};
Spread spreadOf(const Image& picture) {
    Spread s;
    double xx = 0.0, yy = 0.0;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            const auto light = static_cast<double>(picture.at(x, y));
            s.light += light;
            s.x += light * x;
            s.y += light * y;
            xx += light * x * x;
            yy += light * y * y;
        }
    s.x /= s.light;
    s.y /= s.light;
    s.varianceX = xx / s.light - s.x * s.x;
    s.varianceY = yy / s.light - s.y * s.y;
    return s;
}

// A spot of light and its surroundings, all with one CoC, behind focus or in front of it: the points of the lens are
// those of plain accumulation, so the spot's copies lie where they lie there, each as wide as its footprint. In the mean
// of all places that the spot can have in a texel of the coarsest level, which moves it by parts of that.
TEST_F(FootprintGLTest, EachLookupIsAsWideAsItsFootprint) {
    // Sub-samples have their primary's jitter: so many that they cover the pixel as evenly.
    constexpr int kMany = 64, kAll = 2 * kMany, kPlaces = 1 << gpu::kCoarseLevel;
    for (const double focus : {2.0, 0.2})
        for (const double radius : {18.0, 36.0}) {
            Spread added;
            for (int i = 0; i < kPlaces; ++i) {
                Shot shot;
                shot.view = testView(133, 121);
                SceneBuilder b;
                b.wall(1.001, b.unlit(glm::vec3(0.0f)));
                const double x = 60.0 + i, y = 54.0 + (3 * i) % kPlaces;
                b.quad(shot.view, {x, y, x + 6.0, y + 6.0}, 1.0, b.unlit(glm::vec3(4.0f)));
                shot.lens = lensFor(shot.view, radius, focus, 1.0);
                const Spread mine = spreadOf(draw(b, shot, kMany, 1)), its = spreadOf(plain(b, shot, kAll));
                EXPECT_NEAR(mine.light, its.light, 0.01 * its.light) << radius << " px, focus " << focus;
                added.x += (mine.x - its.x) / kPlaces;
                added.y += (mine.y - its.y) / kPlaces;
                added.varianceX += (mine.varianceX - its.varianceX) / kPlaces;
                added.varianceY += (mine.varianceY - its.varianceY) / kPlaces;
                EXPECT_EQ(technique_.plan().footprints.inFront, focus < 1.0);
                EXPECT_EQ(log_.count("footprints"), 1);
            }
            // Lookups are found to half a pixel, read between texels, and jittered otherwise.
            const double expected = kFootprint / kAll * radius * radius;
            EXPECT_NEAR(added.x, 0.0, 0.1) << radius << " px, focus " << focus;
            EXPECT_NEAR(added.y, 0.0, 0.1) << radius << " px, focus " << focus;
            EXPECT_NEAR(added.varianceX, expected, 0.1 * expected + 1.0) << radius << " px, focus " << focus;
            EXPECT_NEAR(added.varianceY, expected, 0.1 * expected + 1.0) << radius << " px, focus " << focus;
        }
}

/// Small lights at one depth over a wall at another.
SceneBuilder lights(const View& view, double distance, double wall) {
    SceneBuilder b;
    b.wall(wall, b.textured(checkerImage(32)), 3.0);
    for (int i = 0; i < 6; ++i) {
        const double x = 12.0 + 30.0 * i, y = 20.0 + 37.0 * (i % 4);
        b.quad(view, {x, y, x + 3.0, y + 3.0}, distance, b.unlit({2.0f, 6.0f - static_cast<float>(i), 1.0f}));
    }
    return b;
}

// Discs of lights, behind what is in focus and before it, are nearer to the reference than by as many plain samples.
TEST_F(FootprintGLTest, DiscsHaveNoDots) {
    Shot shot;
    struct Case {
        double lights, wall;  // m
    };
    for (const auto& [distance, wall] : {Case{6.0, 8.0}, Case{0.4, 1.2}}) {
        const SceneBuilder b = lights(shot.view, distance, wall);
        shot.lens = lensFor(shot.view, 20.0, 1.0, 1.0 / distance);
        const Image reference = plain(b, shot, 1024);
        const Comparison mine = compareImages(draw(b, shot), reference);
        const Comparison its = compareImages(plain(b, shot, kPoints), reference);
        EXPECT_GT(mine.ssim, its.ssim) << distance << " m";
        EXPECT_GT(mine.psnr, its.psnr) << distance << " m";
    }
}

// A figure in focus, white, before a black wall that has wide footprints: its edges are those of plain accumulation,
// and neither shines into the other.
TEST_F(FootprintGLTest, WhatIsInFocusKeepsItsEdges) {
    Shot shot;
    SceneBuilder b;
    b.wall(8.0, b.unlit(glm::vec3(0.02f)));
    b.quad(shot.view, {60.3, 30.6, 130.8, 110.2}, 1.0, b.textured(checkerImage(16, {255, 255, 255, 255})));
    shot.lens = lensFor(shot.view, 30.0, 1.0, 0.125);
    const Image mine = draw(b, shot), its = plain(b, shot, kSamples);
    EXPECT_TRUE(technique_.plan().footprints.wide);
    EXPECT_FALSE(technique_.plan().footprints.inFront);
    const PixelRect figure{60.3, 30.6, 130.8, 110.2};
    const Worst outside = worstDifference(mine, its, [&](int x, int y) { return figure.distance(x, y) > 1.5; });
    // Lookups beside it are read between texels of it and of the wall.
    EXPECT_LT(outside.linear, 0.01) << outside;
    EXPECT_LT(outside.mean, 0.001) << outside;
    // Samples share renderings and jitters of what is in focus.
    const Worst inside =
        worstDifference(mine, its, [](int x, int y) { return x > 63 && x < 127 && y > 33 && y < 107; });
    EXPECT_LT(inside.mean, 0.03) << inside;
    double meanMine = 0.0, meanIts = 0.0;
    for (int y = 34; y < 107; ++y)
        for (int x = 64; x < 127; ++x) meanMine += pixelAt(mine, x, y).r, meanIts += pixelAt(its, x, y).r;
    EXPECT_NEAR(meanMine / meanIts, 1.0, 0.002);
}

// A thing in front of focus, over a figure that is in focus: what is seen of the figure is sharp, in its colours.
TEST_F(FootprintGLTest, WhatIsSeenThroughABlurredForegroundIsSharp) {
    Shot shot;
    SceneBuilder b;
    b.wall(1.0, b.textured(checkerImage(12, {255, 255, 255, 255}, {10, 10, 10, 255})), 3.0);
    b.quad(shot.view, {90.0, -20.0, 102.0, 200.0}, 0.3, b.unlit({1.0f, 0.2f, 0.0f}));
    shot.lens = lensFor(shot.view, 25.0, 1.0, 1.0 / 0.3);
    const Image reference = plain(b, shot, 1024);
    // As many jitters antialias the figure. Smoothed by a footprint as wide as the foreground's it would be wrong by a
    // third of white along every edge.
    const Image mine = draw(b, shot, 64, 1);
    EXPECT_TRUE(technique_.plan().footprints.inFront);
    const Worst covered = worstDifference(mine, reference, [](int x, int) { return x > 72 && x < 120; });
    EXPECT_LT(covered.linear, 0.08) << covered;
    EXPECT_LT(covered.mean, 0.004) << covered;
}

// Only what has wide footprints takes the passes for it, and nothing shows where they begin.
TEST_F(FootprintGLTest, NarrowOnesAreLeftOutUnseen) {
    Shot shot;
    SceneBuilder b;
    b.wall(6.0, b.textured(checkerImage(16)), 12.0);
    b.quad(shot.view, {40.0, 30.0, 90.0, 90.0}, 1.0, b.unlit({0.9f, 0.1f, 0.2f}));
    const double begins = std::sqrt(kLeastVariance / kFootprint * kPoints);  // CoC radius, px
    Image before;
    for (const double radius : {begins * 0.999, begins * 1.001}) {
        shot.lens = lensFor(shot.view, radius, 1.0, 0.0);
        Image now = draw(b, shot);
        const bool wide = radius > begins;
        EXPECT_EQ(technique_.plan().footprints.wide, wide);
        EXPECT_FALSE(technique_.plan().footprints.inFront);
        EXPECT_EQ(log_.count("footprints"), wide ? 1 : 0);
        EXPECT_EQ(log_.count("average"), wide ? 0 : 1);
        EXPECT_EQ(log_.skipped.empty() ? 0 : std::ranges::count(log_.skipped, "footprints", &PassLog::Skipped::name),
                  wide ? 0 : 1);
        if (wide) {
            EXPECT_GT(compareImages(before, now).psnr, 50.0);
        }
        before = std::move(now);
    }
    // Focus beyond all there is: only the front has any, the background too.
    shot.lens = lensFor(shot.view, 40.0, -1.0, 1.0);
    draw(b, shot);
    EXPECT_TRUE(technique_.plan().footprints.inFront);
}

}  // namespace
}  // namespace dioptre
