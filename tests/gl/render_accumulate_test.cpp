// Accumulation with levels of detail, shared renderings and sub-samples, against what each of them stands for.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "gl_fixture.hpp"
#include "metrics/metrics.hpp"
#include "pictures.hpp"
#include "render/accumulate/accumulate.hpp"
#include "shaders/shared/accumulate_types.h"

namespace dioptre {
namespace {

using namespace test;

/// Things at many depths over a wall.
SceneBuilder manyDepths(const View& view, bool textured = true) {
    SceneBuilder b;
    b.wall(6.0, textured ? b.textured(checkerImage(16)) : b.unlit(glm::vec3(0.3f)), 12.0);
    for (int i = 0; i < 10; ++i) {
        const double x = 8.0 + 18.0 * i, d = 0.6 + 0.45 * ((i * 7) % 10);
        b.quad(view, {x, 15.0 + 6.0 * i, x + 12.0, 90.0 + 5.0 * i}, d,
               b.unlit({0.1f * static_cast<float>(i), 0.5f, 0.9f - 0.08f * static_cast<float>(i)}));
    }
    return b;
}

class AccumulateGLTest : public GlTest {
  protected:
    Image draw(const GpuScene& scene, const Shot& shot, int samples, int subsamples) {
        log_.clear();
        EyeFrame frame{scene, shot.view, shot.lens, shot.exposure, 0, {}, log_, samples, subsamples};
        return readPicture(technique_.draw(frame));
    }
    static Image plain(const GpuScene& scene, const Shot& shot, int samples) {
        Shot one = shot;
        one.samples = samples;
        return test::draw(TechniqueChoice::reference, scene, one);
    }
    static double ssim(const Image& a, const Image& b) { return compareImages(a, b).ssim; }

    PassLog log_;
    Accumulate technique_;
};

TEST_F(AccumulateGLTest, WithNothingToSaveItIsTheReferenceToTheBit) {
    Shot shot;
    const GpuScene scene(manyDepths(shot.view, false).scene());  // blurred textures are read coarser
    shot.lens = lensFor(shot.view, 15.0, 10.0, 1.0);             // nothing is near focus
    for (const int samples : {1, 6, 32, 96}) {
        const Image mine = draw(scene, shot, samples, 0);
        EXPECT_EQ(mine.pixels, plain(scene, shot, samples).pixels) << samples;
        EXPECT_TRUE(technique_.plan().sharing.parents.empty());
    }
}

// A fine pattern behind the focus, whose finest texels a few samples would make noise of; in focus it is read as always.
TEST_F(AccumulateGLTest, TexturesOfWhatIsBlurredAreReadNoFinerThanSamplesLie) {
    Shot shot;
    SceneBuilder b;
    b.wall(6.0, b.textured(checkerImage(256)), 12.0);
    const GpuScene scene(b.scene());
    shot.lens = lensFor(shot.view, 10.0, 0.5, 1.6);
    const Image reference = plain(scene, shot, 1024);
    const double mine = compareImages(draw(scene, shot, 16, 0), reference).psnr;
    const double plain16 = compareImages(plain(scene, shot, 16), reference).psnr;
    EXPECT_GT(mine, plain16 + 3.0);
    shot.lens.focus = vergence(Metres(6.0));
    EXPECT_EQ(draw(scene, shot, 16, 0).pixels, plain(scene, shot, 16).pixels);
}

TEST_F(AccumulateGLTest, SharedRenderingsMoveNothingByMoreThanTheirCells) {
    Shot shot;
    const GpuScene scene(manyDepths(shot.view).scene());
    for (const double radius : {0.0, 0.1, 0.5, 1.0, 2.0, 8.0}) {
        shot.lens = lensFor(shot.view, radius, 1.0, 0.166);
        const Image mine = draw(scene, shot, 64, 0);
        EXPECT_GE(ssim(mine, plain(scene, shot, 64)), 0.995) << radius << " px";
        EXPECT_FALSE(technique_.plan().sharing.parents.empty()) << radius << " px";
    }
    // In focus: about as many renderings as jitters, whatever the samples; never fewer.
    shot.lens.apertureRadius = Metres(0.0);
    for (const int samples : {1, 16, 32, 33, 40, 48, 50, 64, 65, 97, 128, 256, 1000}) {
        const std::uint64_t before = scene.trianglesDrawn();
        const Image mine = draw(scene, shot, samples, 0);
        const std::uint64_t drawn = scene.trianglesDrawn() - before;
        const std::size_t parents = technique_.plan().sharing.parents.size();
        EXPECT_EQ(drawn, (parents > 0 ? parents : static_cast<std::size_t>(samples)) * 11 * 2) << samples;
        EXPECT_GE(drawn, std::min<std::uint64_t>(static_cast<std::uint64_t>(samples), kLeastJitters) * 11 * 2);
        if (samples >= 64) {
            EXPECT_LE(parents, 1.3 * kLeastJitters) << samples;
            EXPECT_GT(parents, 0u) << samples;
            EXPECT_GE(ssim(mine, plain(scene, shot, samples)), 0.995) << samples;
        }
    }
}

// Edges in focus would flicker if what is blurred beside them changed how renderings are shared.
TEST_F(AccumulateGLTest, SharedRenderingsAreTheSameInEachFrame) {
    Shot shot;
    const GpuScene scene(manyDepths(shot.view).scene());
    for (const int samples : {64, 200}) {
        std::vector<SharedRenderings> all;
        std::vector<std::ptrdiff_t> shared;
        for (const double focus : {1.0, 1.01, 0.8, 0.3}) {
            shot.lens = lensFor(shot.view, 2.0, focus, 0.166);
            draw(scene, shot, samples, 0);
            all.push_back(technique_.plan().sharing);
            shared.push_back(std::ranges::count(technique_.plan().shared, true));
            ASSERT_GT(shared.back(), 0) << focus << " D";
            EXPECT_EQ(all.back().parentOf, all.front().parentOf) << focus << " D";
            for (std::size_t i = 0; i < all.back().parents.size(); ++i) {
                EXPECT_EQ(all.back().parents[i].lens, all.front().parents.at(i).lens);
                EXPECT_EQ(all.back().parents[i].pixel, all.front().parents.at(i).pixel);
            }
        }
        EXPECT_NE(std::ranges::min(shared), std::ranges::max(shared)) << "others become sharp";
    }
}

TEST_F(AccumulateGLTest, ConstantLightStaysConstant) {
    Shot shot;
    SceneBuilder b;
    b.wall(4.0, b.unlit({0.5f, 0.25f, 0.125f}));
    const GpuScene scene(b.scene());
    for (const double radius : {0.0, 3.0, 40.0}) {
        shot.lens = lensFor(shot.view, radius, 2.0, 0.25);
        const Worst worst = worstDifference(draw(scene, shot, 16, 4), constantImage(192, 144, {0.5f, 0.25f, 0.125f}));
        EXPECT_LT(worst.linear, 1e-6) << radius << ": " << worst;
    }
}

TEST_F(AccumulateGLTest, SubsamplesBringItNearerToTheReference) {
    Shot shot;
    const GpuScene scene(manyDepths(shot.view).scene());
    shot.lens = lensFor(shot.view, 10.0, 0.5, 1.6);
    const Image reference = plain(scene, shot, 1024);
    const double without = ssim(draw(scene, shot, 16, 0), reference);
    const double with4 = ssim(draw(scene, shot, 16, 4), reference);
    const double plain80 = ssim(plain(scene, shot, 16 * 5), reference);
    EXPECT_GT(with4, without);
    // Most of the way to as many samples.
    EXPECT_GT(with4 - without, 0.6 * (plain80 - without)) << without << " to " << with4 << ", plain " << plain80;
}

TEST_F(AccumulateGLTest, FinerPicturesComeFrameByFrame) {
    Shot shot;
    const GpuScene scene(manyDepths(shot.view).scene());
    shot.lens = lensFor(shot.view, 1.0, 0.5, 1.6);
    for (const int samples : {24, 64}) {
        const Image atOnce = draw(scene, shot, samples, 2);
        EyeFrame frame{scene, shot.view, shot.lens, 1.0f, 0, {}, log_, samples, 2, 0, 4};
        Accumulate another;
        int frames = 0;
        do {
            another.draw(frame);
            ++frames;
        } while (another.progress() < 1.0 && frames < 100);
        EXPECT_EQ(frames, samples / 4) << "groups of four";
        EXPECT_EQ(readPicture(another.draw(frame)).pixels, atOnce.pixels);
    }
}

// What hangs on the samples is kept from picture to picture, as long as they are the same.
TEST_F(AccumulateGLTest, OneThatDrewOtherPicturesBeforeDrawsTheSame) {
    Shot shot;
    const GpuScene scene(manyDepths(shot.view).scene());
    struct Case {
        int samples, subsamples, blades = 0;
        double rotation = 0.0;
        int first = 0;
    };
    for (const Case& c : {Case{64, 0}, {64, 3}, {150, 0}, {64, 0, 6}, {64, 0, 6, 0.3}, {64, 0, 0, 0.0, 77}, {16, 2}}) {
        SCOPED_TRACE(testing::Message() << c.samples << ", " << c.subsamples << ", " << c.blades << " blades at "
                                        << c.rotation << ", from " << c.first);
        shot.lens = lensFor(shot.view, 2.0, 1.0, 0.166);
        shot.lens.blades = c.blades;
        shot.lens.bladeRotation = Radians(c.rotation);
        EyeFrame frame{scene, shot.view, shot.lens, 1.0f, 0, {}, log_, c.samples, c.subsamples, c.first};
        Accumulate fresh;
        const Image picture = readPicture(fresh.draw(frame));
        EXPECT_EQ(fresh.plan().sharing.parents.empty(), c.samples < 64);
        EXPECT_EQ(readPicture(technique_.draw(frame)).pixels, picture.pixels);
        frame.show.stage = ShowChoice::lod;
        technique_.draw(frame);
        frame.show.stage = ShowChoice::none;
        frame.samplesNow = 12;
        for (int i = 0; i < c.samples && (i == 0 || technique_.progress() < 1.0); ++i) technique_.draw(frame);
        EXPECT_EQ(readPicture(technique_.draw(frame)).pixels, picture.pixels) << "piece by piece";
    }
}

/// A square of many triangles; its level 1 is the left half of them.
struct HalvedSquare {
    Scene scene;
    std::vector<std::uint32_t> left;
};
HalvedSquare halvedSquare() {
    constexpr int kSide = 32;
    HalvedSquare made;
    SceneBuilder b;
    b.quad(glm::dvec3(0.0, 0.0, -1.0), glm::dvec2(0.3), b.unlit(glm::vec3(1.0f)));
    made.scene = b.scene();
    Primitive& p = made.scene.meshes.front().primitives.front();
    p.vertices.clear();
    p.indices.clear();
    for (int y = 0; y <= kSide; ++y)
        for (int x = 0; x <= kSide; ++x) {
            Vertex v;
            v.position =
                glm::vec3(static_cast<float>(x) / kSide - 0.5f, static_cast<float>(y) / kSide - 0.5f, 0.0f) * 0.3f -
                glm::vec3(0.0f, 0.0f, 1.0f);
            p.vertices.push_back(v);
        }
    for (int x = 0; x < kSide; ++x)
        for (int y = 0; y < kSide; ++y) {
            const auto a = static_cast<std::uint32_t>(y * (kSide + 1) + x), c = a + kSide + 1;
            for (const std::uint32_t i : {a, a + 1, c + 1, a, c + 1, c}) p.indices.push_back(i);
        }
    made.left.assign(p.indices.begin(), p.indices.begin() + static_cast<std::ptrdiff_t>(p.indices.size() / 2));
    return made;
}

TEST_F(AccumulateGLTest, WhatIsBlurredIsDrawnAtItsLevel) {
    const HalvedSquare made = halvedSquare();
    GpuScene scene(made.scene);
    const std::uint64_t version = scene.version();
    Shot shot;
    const Lens blurred = lensFor(shot.view, 12.0, 0.2, 1.0);
    shot.lens = blurred;
    const Image before = draw(scene, shot, 16, 0);
    scene.addLevel(0, 0, {made.left, 0.0f, 0.0f});
    EXPECT_NE(scene.version(), version);
    EXPECT_EQ(plain(scene, shot, 16).pixels, before.pixels) << "the reference is drawn at level 0";

    const std::uint64_t triangles = scene.trianglesDrawn();
    const Image coarse = draw(scene, shot, 16, 0);
    EXPECT_EQ(scene.trianglesDrawn() - triangles, 16u * made.left.size() / 3);
    EXPECT_GT(meanColor(coarse, 60, 50, 90, 100).x, 0.8);
    EXPECT_LT(meanColor(coarse, 115, 50, 130, 100).x, 0.05);

    // White is level 0, then blue.
    shot.show.stage = ShowChoice::lod;
    const Image levels = test::draw(technique_, scene, shot);
    EXPECT_NEAR(pixelAt(levels, 75, 70).r, 0.1, 1e-3);
    EXPECT_NEAR(pixelAt(levels, 75, 70).b, 1.0, 1e-3);
    shot.show.stage = ShowChoice::none;
    EXPECT_EQ(draw(scene, shot, 16, 0).pixels, coarse.pixels) << "which leaves nothing behind";

    // Half a level: so much of the lens.
    double least = 0.0, most = 1.0;
    for (int i = 0; i < 40; ++i) {
        const double share = 0.5 * (least + most);
        shot.lens.apertureRadius = Metres(blurred.apertureRadius.value * share);
        draw(scene, shot, 16, 0);
        (technique_.plan().levels.front() < 0.5 ? least : most) = share;
    }
    EXPECT_NEAR(meanColor(draw(scene, shot, 16, 0), 115, 65, 120, 80).x, 0.5, 0.08);

    shot.lens = lensFor(shot.view, 12.0, 1.0, 0.2);
    EXPECT_GT(meanColor(draw(scene, shot, 16, 0), 115, 50, 125, 100).x, 0.99) << "in focus it is whole";
}

TEST_F(AccumulateGLTest, WhatIsBlackShowsItsLevelToo) {
    Shot shot;
    SceneBuilder b;
    b.wall(6.0, b.unlit({0.0f, 0.5f, 0.0f}));
    const GpuScene scene(b.scene());
    shot.show.stage = ShowChoice::lod;
    const glm::dvec3 white = pixelAt(test::draw(technique_, scene, shot), 75, 70);
    // The mean with the picture
    EXPECT_NEAR(white.r, 0.5, 1e-3);
    EXPECT_NEAR(white.g, 0.75, 1e-3);
    EXPECT_NEAR(white.b, 0.5, 1e-3);
}

/// Draws a scene through the middle of the lens, and looks up other points of it.
class SubsampleGLTest : public GlTest {
  protected:
    Image through(const Scene& scene, const Shot& shot, const std::vector<glm::vec2>& offsets) {
        const GpuScene gpu(scene);
        layers_.resize(shot.view.width, shot.view.height, 1);
        DrawList list;
        gpu.see(list, shot.view, nullptr);
        gpu.arrange(list, 1);
        layers_.bind(true);
        const glm::mat4 clip(clipFromView(shot.view));
        gpu.drawThroughLens(list, {&clip, 1}, 1.0f, {});
        PassLog log;
        EyeFrame frame{gpu, shot.view, shot.lens, 1.0f, 0, {}, log, 1};
        sum_.begin(frame);
        double farthest = 0.0;
        for (const glm::vec2& o : offsets) farthest = std::max(farthest, static_cast<double>(glm::length(o)));
        coc_ = cocTransform(frame);
        blur_.add({layers_, 0, 1, coc_, 1.0}, {offsets, {0, static_cast<int>(offsets.size())}, farthest}, sum_);
        return readPicture(sum_.mean());
    }
    SampleLayers layers_{"test"};
    SampleSum sum_;
    SubsampleBlur blur_;
    CocTransform coc_;
};

// A near half plane, red, before a far one, green. Through o both move, by c o; what appears between them was hidden
// ("blocked"), and continues what is behind.
TEST_F(SubsampleGLTest, TwoPlanesMoveByTheirCirclesOfConfusion) {
    Shot shot;
    SceneBuilder b;
    b.wall(8.0, b.unlit({0.0f, 1.0f, 0.0f}));
    b.quad(shot.view, {-50.0, -50.0, 96.0, 200.0}, 0.5, b.unlit({1.0f, 0.0f, 0.0f}));
    // The far plane's CoC radius is 5 px, the near one's -32.5 px (D = 0.125 and 2, focus at 0.375).
    shot.lens = lensFor(shot.view, 5.0, 0.375, 0.125);
    const double near = cocRadiusPixels(shot.lens, focalLengthPixels(shot.view).x, Dioptres(2.0));
    for (const double o : {-0.3, -0.1, 0.1, 0.3}) {
        // The mean of the primary and one sub-sample: twice the difference to the first is the second.
        const Image both = through(b.scene(), shot, {{static_cast<float>(o), 0.0f}});
        const double edge = 96.0 + near * o;
        for (int x = 20; x < 170; ++x) {
            // A step of the search, a texel of the filter: at the edge now, and where it was
            if (std::abs(x + 0.5 - edge) < 2.1 || std::abs(x + 0.5 - 96.0) < 2.6) continue;
            const double red = 2.0 * static_cast<double>(both.at(x, 70, 0)) - (x < 96 ? 1.0 : 0.0);
            const double green = 2.0 * static_cast<double>(both.at(x, 70, 1)) - (x < 96 ? 0.0 : 1.0);
            EXPECT_NEAR(red, x + 0.5 < edge ? 1.0 : 0.0, 1e-3) << "o " << o << ", x " << x;
            EXPECT_NEAR(green, x + 0.5 < edge ? 0.0 : 1.0, 1e-3) << "o " << o << ", x " << x;
        }
    }
}

// What a sub-sample sees beside the edge of a near thing, and its primary does not: nothing, if there is nothing.
TEST_F(SubsampleGLTest, WhatNothingCoversIsTheBackground) {
    Shot shot;
    SceneBuilder b;
    b.quad(shot.view, {80.0, 40.0, 110.0, 100.0}, 0.5, b.unlit({1.0f, 0.5f, 0.25f}));
    shot.lens = lensFor(shot.view, 6.0, 0.0, 2.0);
    const Image both = through(b.scene(), shot, {{0.5f, 0.0f}});
    // Infinity is in focus and stays; the square's copy stands 3 px aside.
    EXPECT_NEAR(both.at(40, 70), 0.0, 1e-6);
    EXPECT_NEAR(both.at(95, 70), 1.0, 1e-6);
    EXPECT_NEAR(both.at(78, 70), 0.5, 1e-6);
    EXPECT_NEAR(both.at(109, 70), 0.5, 1e-6);
}

TEST_F(SubsampleGLTest, TheNBufferHoldsWhatASearchFinds) {
    Shot shot;
    shot.view = testView(203, 131);  // no whole number of tiles
    shot.lens = lensFor(shot.view, 20.0, 0.5, 1.6);
    through(manyDepths(shot.view).scene(), shot, {{0.15f, 0.1f}});
    const int width = blur_.bounds().width(), height = blur_.bounds().height();
    ASSERT_EQ(width, 51);
    ASSERT_EQ(height, 33);
    std::vector<float> depth(203 * 131);
    glGetTextureImage(layers_.depths().name(), 0, GL_DEPTH_COMPONENT, GL_FLOAT,
                      static_cast<GLsizei>(depth.size() * sizeof(float)), depth.data());
    std::mt19937 random(7);
    for (std::size_t level = 0; level < 6; ++level) {
        std::vector<float> found(static_cast<std::size_t>(width * height) * 2);
        glGetTextureImage(blur_.squares(level).name(), 0, GL_RG, GL_FLOAT,
                          static_cast<GLsizei>(found.size() * sizeof(float)), found.data());
        for (int n = 0; n < 60; ++n) {
            const int tx = static_cast<int>(random() % static_cast<unsigned>(width));
            const int ty = static_cast<int>(random() % static_cast<unsigned>(height));
            float least = 1.0f, most = 0.0f;
            const int side = gpu::kTileSide << level;
            for (int y = ty * gpu::kTileSide; y < std::min(131, ty * gpu::kTileSide + side); ++y)
                for (int x = tx * gpu::kTileSide; x < std::min(203, tx * gpu::kTileSide + side); ++x) {
                    least = std::min(least, depth[static_cast<std::size_t>(y * 203 + x)]);
                    most = std::max(most, depth[static_cast<std::size_t>(y * 203 + x)]);
                }
            const auto at = static_cast<std::size_t>(ty * width + tx) * 2;
            EXPECT_EQ(found[at], least) << "level " << level << ", tile " << tx << ", " << ty;
            EXPECT_EQ(found[at + 1], most) << "level " << level << ", tile " << tx << ", " << ty;
        }
    }
}

// Whatever a pixel can hit lies within its tile's bounds; and they are no wider than those of all that can be met.
TEST_F(SubsampleGLTest, BoundsHoldWhateverCanBeHit) {
    for (const double radius : {1.0, 6.0, 40.0}) {
        Shot shot;
        shot.view = testView(120, 90);
        shot.lens = lensFor(shot.view, radius, 0.5, 1.6);
        const double farthest = 0.25;
        through(manyDepths(shot.view).scene(), shot, {{static_cast<float>(farthest), 0.0f}});
        std::vector<float> depth(120 * 90), bounds(static_cast<std::size_t>(30 * 23) * 2);
        glGetTextureImage(layers_.depths().name(), 0, GL_DEPTH_COMPONENT, GL_FLOAT,
                          static_cast<GLsizei>(depth.size() * sizeof(float)), depth.data());
        glGetTextureImage(blur_.bounds().name(), 0, GL_RG, GL_FLOAT,
                          static_cast<GLsizei>(bounds.size() * sizeof(float)), bounds.data());
        double widest = 0.0, tight = 0.0;
        for (int y = 0; y < 90; ++y)
            for (int x = 0; x < 120; ++x) {
                const auto tile = static_cast<std::size_t>(y / 4 * 30 + x / 4) * 2;
                const double low = static_cast<double>(bounds[tile]), high = static_cast<double>(bounds[tile + 1]);
                tight += high - low;
                for (int v = 0; v < 90; v += 1)
                    for (int u = 0; u < 120; u += 1) {
                        const double c = static_cast<double>(coc_.radius(depth[static_cast<std::size_t>(v * 120 + u)]));
                        widest = std::max(widest, std::abs(c));
                        if (std::hypot(u - x, v - y) > std::abs(c) * farthest) continue;
                        ASSERT_GE(c, low - 1e-4) << radius << ": " << x << ", " << y << " meets " << u << ", " << v;
                        ASSERT_LE(c, high + 1e-4) << radius << ": " << x << ", " << y << " meets " << u << ", " << v;
                    }
            }
        if (radius < 10.0) {
            EXPECT_LT(tight / (120 * 90), 0.6 * widest) << radius;
        }
    }
}

}  // namespace
}  // namespace dioptre
