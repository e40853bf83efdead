// What is smoothed of an accumulated picture, by how far apart the points of the lens see it; and what is not.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "focus/stereo_rig.hpp"
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
// and neither shines into the other. Also where points lie so close that a lookup needs no search.
TEST_F(FootprintGLTest, WhatIsInFocusKeepsItsEdges) {
    for (const auto& [samples, subsamples, radius] :
         {std::tuple(kSamples, kSubsamples, 30.0), {64, 1, 20.0}, {512, 1, 40.0}}) {
        Shot shot;
        SceneBuilder b;
        const PixelRect figure{60.3, 30.6, 130.8, 110.2};
        b.wall(8.0, b.unlit(glm::vec3(0.02f)));
        b.quad(shot.view, figure, 1.0, b.unlit(glm::vec3(1.0f)));
        shot.lens = lensFor(shot.view, radius, 1.0, 0.125);
        const Image mine = draw(b, shot, samples, subsamples), its = plain(b, shot, std::max(samples, 64));
        EXPECT_TRUE(technique_.plan().footprints.wide) << samples;
        EXPECT_FALSE(technique_.plan().footprints.inFront) << samples;
        const auto away = [&](int x, int y, bool inside) {
            const double d = figure.distance(x, y);
            return inside ? x > 61 && x < 129 && y > 31 && y < 109 : d > 1.5;
        };
        // Lookups beside it are read between texels of it and of the wall.
        const Worst outside = worstDifference(mine, its, [&](int x, int y) { return away(x, y, false); });
        EXPECT_LT(outside.linear, 0.02) << samples << ": " << outside;
        const Worst inside = worstDifference(mine, its, [&](int x, int y) { return away(x, y, true); });
        EXPECT_LT(inside.linear, 0.01) << samples << ": " << inside;
    }
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
        EXPECT_EQ(std::ranges::count(log_.skipped, "footprints", &PassLog::Skipped::name), wide ? 0 : 1);
        if (wide) {
            EXPECT_GT(compareImages(before, now).psnr, 50.0);
        }
        before = std::move(now);
    }
}

// Where all is in front of focus, the background too, it is smoothed as one.
TEST_F(FootprintGLTest, FocusBeyondInfinityHasOnlyAFront) {
    Shot shot;
    SceneBuilder b;
    b.wall(8.0, b.textured(checkerImage(32)), 3.0);
    b.quad(shot.view, {60.0, 30.0, 110.0, 90.0}, 1.0, b.unlit({0.9f, 0.1f, 0.2f}));
    shot.lens = lensFor(shot.view, 40.0, -1.0, 1.0);
    const Image reference = plain(b, shot, 1024);
    const double mine = compareImages(draw(b, shot), reference).psnr;
    EXPECT_TRUE(technique_.plan().footprints.inFront);
    EXPECT_GT(mine, compareImages(plain(b, shot, kPoints), reference).psnr);
}

// White stays white, to the borders of pictures that the coarse level does not divide, behind focus and in front of it.
TEST_F(FootprintGLTest, ConstantLightStaysConstant) {
    for (const glm::ivec2 size : {glm::ivec2(192, 144), {193, 137}, {9, 65}, {1, 1}})
        for (const double focus : {2.0, 0.1}) {
            Shot shot;
            shot.view = testView(size.x, size.y);
            SceneBuilder b;
            b.wall(1.0, b.unlit({0.5f, 0.25f, 4.0f}));
            shot.lens = lensFor(testView(), 30.0, focus, 1.0);
            const Worst worst =
                worstDifference(draw(b, shot), constantImage(size.x, size.y, glm::vec3(0.5f, 0.25f, 4.0f)));
            EXPECT_LT(worst.linear, 4e-6) << size.x << "x" << size.y << ", focus " << focus << ": " << worst;
        }
}

// A lamp as bright as half floats can be, at a border: its light is that of plain accumulation, and there is no NaN.
TEST_F(FootprintGLTest, LampsAtBordersKeepTheirLight) {
    for (const PixelRect& lamp : {PixelRect{0.0, 60.0, 3.0, 63.0},
                                  {190.0, 60.0, 193.0, 63.0},
                                  {90.0, 0.0, 93.0, 3.0},
                                  {90.0, 134.0, 93.0, 137.0}}) {
        Shot shot;
        shot.view = testView(193, 137);
        SceneBuilder b;
        b.wall(6.0, b.unlit(glm::vec3(0.01f)));
        b.quad(shot.view, lamp, 5.9, b.unlit(glm::vec3(65504.0f)));
        shot.lens = lensFor(shot.view, 12.0, 1.0, 1.0 / 6.0);
        const Image mine = draw(b, shot);
        EXPECT_EQ(countNotFinite(mine), 0u);
        const double light = spreadOf(mine).light, its = spreadOf(plain(b, shot, 256)).light;
        EXPECT_NEAR(light, its, 0.12 * its) << lamp.x0 << ", " << lamp.y0;
    }
}

// Glass in focus before what is blurred keeps its pattern, as far as it is seen through it.
TEST_F(FootprintGLTest, BlendedSurfacesInFocusAreNotSmoothed) {
    Shot shot;
    SceneBuilder b;
    b.wall(8.0, b.unlit({0.1f, 0.3f, 0.1f}));
    Material glass;
    glass.unlit = true;
    glass.doubleSided = true;
    glass.alphaMode = AlphaMode::blend;
    glass.baseColor = {1.0f, 1.0f, 1.0f, 0.8f};
    const int stripes = b.textured(checkerImage(12, {255, 255, 255, 255}, {0, 0, 0, 255}));
    glass.baseColorTexture = b.scene().materials[static_cast<std::size_t>(stripes)].baseColorTexture;
    b.quad(shot.view, {40.0, 30.0, 150.0, 120.0}, 1.0, b.material(glass));
    shot.lens = lensFor(shot.view, 25.0, 1.0, 0.125);
    const Image reference = plain(b, shot, 1024);
    const auto inside = [](int x, int y) { return x > 45 && x < 145 && y > 35 && y < 115; };
    // It is drawn for each sample, and nothing of it is looked up elsewhere.
    const double without = worstDifference(draw(b, shot, 32, 0), reference, inside).mean;
    const double with1 = worstDifference(draw(b, shot, 32, 1), reference, inside).mean;
    EXPECT_TRUE(technique_.plan().footprints.wide);
    EXPECT_LT(with1, without + 0.004) << without;
}

// A view that stands still goes on, in parts as well, and what was drawn before leaves nothing behind.
TEST_F(FootprintGLTest, PicturesComeFrameByFrameAndInAnyOrder) {
    Shot shot;
    SceneBuilder b = lights(shot.view, 0.5, 6.0);
    const GpuScene scene(b.scene());
    // Wide on both sides, behind alone, nowhere
    const std::array lenses{lensFor(shot.view, 20.0, 1.0, 2.0), lensFor(shot.view, 20.0, 2.0, 0.2),
                            lensFor(shot.view, 0.5, 1.0, 2.0)};
    Accumulate used;
    for (const View& view : {shot.view, testView(101, 75), shot.view})
        for (const Lens& lens : lenses) {
            EyeFrame frame{scene, view, lens, 1.0f, 0, {}, log_, 12, 3};
            Accumulate fresh;
            const Image atOnce = readPicture(fresh.draw(frame));
            EXPECT_EQ(readPicture(used.draw(frame)).pixels, atOnce.pixels);
            frame.show.stage = ShowChoice::lod;
            used.draw(frame);
            EXPECT_EQ(used.progress(), 1.0) << "a stage is finished at once";
            frame.show.stage = ShowChoice::none;
            frame.samplesNow = 4;
            for (int i = 0; i < 3; ++i) {
                const Image now = readPicture(used.draw(frame));
                EXPECT_EQ(countNotFinite(now), 0u);
                EXPECT_NEAR(used.progress(), (i + 1) / 3.0, 1e-9);
                if (i == 2) {
                    EXPECT_EQ(now.pixels, atOnce.pixels);
                }
            }
        }
    // Memory does not grow with the samples.
    EyeFrame frame{scene, shot.view, lenses[0], 1.0f, 0, {}, log_, 8, 3};
    Accumulate few, many;
    few.draw(frame);
    frame.samples = 64;
    many.draw(frame);
    EXPECT_EQ(few.bytes(), many.bytes());
}

// Pixels twice as wide as high: as the picture of square ones, squeezed.
TEST_F(FootprintGLTest, HalfWidthPicturesAreSqueezedOnes) {
    Shot shot;
    const SceneBuilder b = lights(shot.view, 6.0, 8.0);
    shot.lens = lensFor(shot.view, 20.0, 1.0, 1.0 / 6.0);
    View half = shot.view;
    half.width /= 2;
    shot.view = half;
    const Image reference = plain(b, shot, 1024);
    const double mine = compareImages(draw(b, shot), reference).psnr;
    EXPECT_GT(mine, compareImages(plain(b, shot, kPoints), reference).psnr);
}

// Where the vertex stage cannot choose a layer, samples come one by one.
TEST_F(FootprintGLTest, ADriverWithoutLayersDrawsTheSame) {
    Shot shot;
    const SceneBuilder b = lights(shot.view, 0.4, 1.2);
    shot.lens = lensFor(shot.view, 20.0, 1.0, 2.5);
    const Image layered = draw(b, shot), plainly = draw(b, shot, 8, 0);
    const int had = std::exchange(GLAD_GL_ARB_shader_viewport_layer_array, 0);
    Accumulate another;
    for (const auto& [subsamples, wanted] : {std::pair(kSubsamples, layered), {0, plainly}}) {
        const GpuScene scene(b.scene());
        EyeFrame frame{scene, shot.view, shot.lens, 1.0f, 0, {}, log_, kSamples, subsamples};
        EXPECT_GT(compareImages(readPicture(another.draw(frame)), wanted).psnr, 60.0) << subsamples;
    }
    GLAD_GL_ARB_shader_viewport_layer_array = had;
}

// Few points are not blurred by more than the blur itself.
TEST_F(FootprintGLTest, FewPointsAreNearerToTheReferenceThanWithoutSubsamples) {
    Shot shot;
    const SceneBuilder b = lights(shot.view, 6.0, 8.0);
    shot.lens = lensFor(shot.view, 14.0, 1.0, 1.0 / 6.0);
    const Image reference = plain(b, shot, 1024);
    for (const auto& [samples, subsamples] : {std::pair(1, 1), {1, 8}, {2, 4}, {4, 1}, {4, 8}}) {
        const double mine = compareImages(draw(b, shot, samples, subsamples), reference).psnr;
        EXPECT_GT(mine, compareImages(plain(b, shot, samples), reference).psnr) << samples << ", " << subsamples;
    }
}

// Both eyes of a head: each is the reference of its own view.
TEST_F(FootprintGLTest, EachEyeHasItsOwnPicture) {
    Shot shot;
    const SceneBuilder b = lights(shot.view, 0.5, 6.0);
    const Lens lens = lensFor(shot.view, 12.0, 1.0, 2.0);
    const View head = shot.view;
    Image pictures[2];
    for (const Eye eye : {Eye::left, Eye::right}) {
        shot.view = eyeView(eye, head, Metres(0.063));
        shot.lens = lens;
        Image& mine = pictures[eye == Eye::right];
        mine = draw(b, shot, 32, 4);
        EXPECT_GT(compareImages(mine, plain(b, shot, 512)).ssim, 0.97);
    }
    EXPECT_LT(compareImages(pictures[0], pictures[1]).ssim, 0.9);
}

}  // namespace
}  // namespace dioptre
