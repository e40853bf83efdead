// The reference technique: shape and energy of its blur, its sequence, and a camera that moves as another way to it.
#include <gtest/gtest.h>

#include <cmath>

#include "gl_fixture.hpp"
#include "metrics/metrics.hpp"
#include "pictures.hpp"

namespace dioptre {
namespace {

using namespace test;

/// A near thing over a wall, both of plain colours with many edges.
Scene strongForeground() {
    SceneBuilder b;
    const View view = testView();
    b.wall(4.0, b.unlit({0.7f, 0.6f, 0.4f}));
    for (int i = 0; i < 6; ++i)
        b.quad(view, {10.0 + 30.0 * i, 20.0, 22.0 + 30.0 * i, 130.0}, 2.0,
               b.unlit({0.1f, 0.15f * static_cast<float>(i), 0.4f}));
    b.quad(view, {40.0, 40.0, 100.0, 90.0}, 0.5, b.unlit({0.9f, 0.3f, 0.1f}));
    return b.scene();
}

class ReferenceGLTest : public GlTest {
  protected:
    Image reference(const GpuScene& scene, const Shot& shot, int samples, int first = 0) {
        PassLog log;
        EyeFrame frame{scene, shot.view, shot.lens, shot.exposure, 0, {}, log};
        frame.samples = samples;
        frame.firstSample = first;
        return readPicture(technique_->draw(frame));
    }
    const std::unique_ptr<Technique> technique_ = makeTechnique(TechniqueChoice::reference);
};

/// Mean, centre and second moment of a picture's red.
struct Spot {
    double energy = 0.0, radius = 0.0;  // radius of the uniform disc that has this second moment
    int lit = 0;                        // pixels above half of what an even disc of `radius` px would have
};
Spot measure(const Image& picture, double radius) {
    Spot spot;
    glm::dvec2 centre(0.0);
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            const auto v = static_cast<double>(picture.at(x, y));
            spot.energy += v;
            centre += v * glm::dvec2(x, y);
        }
    centre /= spot.energy;
    double second = 0.0;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            const auto v = static_cast<double>(picture.at(x, y));
            second += v * glm::dot(glm::dvec2(x, y) - centre, glm::dvec2(x, y) - centre) / spot.energy;
            spot.lit += v > 0.5 * spot.energy / (std::numbers::pi * radius * radius) ? 1 : 0;
        }
    spot.radius = std::sqrt(2.0 * second);  // mean of r² in a disc is R²/2
    return spot;
}

/// A source of 2×2 px at 1 m, before black: every sample sees it in four pixels.
Scene pointSource(const View& view) {
    SceneBuilder b;
    const double size = 2.0 / focalLengthPixels(view).x;
    b.quad(glm::dvec3(0.001, 0.002, -1.0), glm::dvec2(size), b.unlit(glm::vec3(500.0f)));
    return b.scene();
}

TEST_F(ReferenceGLTest, APointsBlurIsADiscOfThePredictedRadiusAndEnergy) {
    Shot shot;
    const GpuScene scene(pointSource(shot.view));
    shot.lens = Lens{Metres(0.0), Metres(0.017), Dioptres(0.0)};
    const Spot sharp = measure(reference(scene, shot, 1024), 2.0);
    for (const double radius : {4.0, 12.0, 30.0})
        for (const double focus : {0.25, 2.5}) {
            shot.lens = lensFor(shot.view, radius, focus, 1.0);
            const Spot spot = measure(reference(scene, shot, 1024), 2.0);
            const double blur = std::sqrt(spot.radius * spot.radius - sharp.radius * sharp.radius);
            EXPECT_NEAR(blur, radius, 0.5) << "focus " << focus;
            EXPECT_NEAR(spot.energy / sharp.energy, 1.0, 0.005) << "radius " << radius << ", focus " << focus;
        }
}

TEST_F(ReferenceGLTest, BladesGiveAPolygon) {
    Shot shot;
    const GpuScene scene(pointSource(shot.view));
    shot.lens = lensFor(shot.view, 15.0, 2.5, 1.0);
    constexpr int kSamples = 2048;
    const Spot round = measure(reference(scene, shot, kSamples), 15.0);
    for (const int blades : {3, 6}) {
        const double n = blades, pi = std::numbers::pi;
        const double area = 0.5 * n * std::sin(2.0 * pi / n) / pi;  // of the inscribed polygon, the disc's being 1
        shot.lens.blades = blades;
        const Spot spot = measure(reference(scene, shot, kSamples), 15.0 * std::sqrt(area));
        EXPECT_NEAR(spot.energy / round.energy, 1.0, 0.005) << blades;
        EXPECT_NEAR(static_cast<double>(spot.lit) / round.lit, area, 0.03) << blades;
    }
}

TEST_F(ReferenceGLTest, AConstantSceneStaysConstant) {
    SceneBuilder b;
    b.wall(2.0, b.unlit(glm::vec3(0.25f, 3.0f, 0.5f)));
    const GpuScene scene(b.scene());
    Shot shot;
    for (const int samples : {1, 2, 3, 5, 64, 1000}) {
        shot.lens = lensFor(shot.view, 20.0, 2.0, 0.5);
        const Image picture = reference(scene, shot, samples);
        const Image constant = constantImage(picture.width, picture.height, glm::vec3(0.25f, 3.0f, 0.5f));
        EXPECT_LE(worstDifference(picture, constant).linear, 1e-6) << samples;
    }
}

TEST_F(ReferenceGLTest, PrefixesNestAndHalvesAddUp) {
    const GpuScene scene(strongForeground());
    Shot shot;
    shot.lens = lensFor(shot.view, 8.0, 0.5, 2.0);
    // The level of textures follows the number of samples: equal numbers are compared.
    const Image first = reference(scene, shot, 32), second = reference(scene, shot, 32, 32);
    Image mean = first;
    for (std::size_t i = 0; i < mean.pixels.size(); ++i) mean.pixels[i] = 0.5f * (first.pixels[i] + second.pixels[i]);
    const Image moved = accumulated(scene, shot, 64);
    EXPECT_GT(ssim(mean, moved), 0.999);
    EXPECT_GT(psnr(mean, moved), 45.0);
    EXPECT_LT(ssim(first, second), 0.9999) << "the halves must be independent";
}

TEST_F(ReferenceGLTest, AStillViewRefinesToTheSamePicture) {
    const GpuScene scene(strongForeground());
    Shot shot;
    shot.lens = lensFor(shot.view, 8.0, 0.5, 2.0);
    const Image whole = reference(scene, shot, 37);
    const auto technique = makeTechnique(TechniqueChoice::reference);
    PassLog log;
    EyeFrame frame{scene, shot.view, shot.lens, 1.0f, 0, {}, log};
    frame.samples = 37;
    frame.samplesNow = 4;
    double progress = 0.0;
    int frames = 0;
    for (; progress < 1.0; ++frames) {
        ASSERT_LT(frames, 40);
        technique->draw(frame);
        EXPECT_GT(technique->progress(), progress);
        progress = technique->progress();
    }
    EXPECT_GT(frames, 8);
    EXPECT_EQ(worstDifference(readPicture(technique->draw(frame)), whole).linear, 0.0);
    // Any change begins anew.
    frame.exposure = 2.0f;
    technique->draw(frame);
    EXPECT_LT(technique->progress(), 0.2);
}

TEST_F(ReferenceGLTest, WithoutAnApertureItIsTheAntialiasedPinhole) {
    const GpuScene scene(strongForeground());
    Shot shot;
    shot.lens = Lens{Metres(0.0), Metres(0.017), Dioptres(0.5)};
    shot.msaa = 4;
    EXPECT_GT(ssim(reference(scene, shot, 64), draw(TechniqueChoice::pinhole, scene, shot)), 0.98);
    // And a tiny one converges to none.
    const Image none = reference(scene, shot, 64);
    shot.lens.apertureRadius = Metres(5e-6);
    EXPECT_GT(ssim(reference(scene, shot, 64), none), 0.999);
}

}  // namespace
}  // namespace dioptre
