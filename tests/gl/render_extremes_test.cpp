// Ends of every range: nothing but finite numbers, and the right limit.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <string>

#include "core/resources.hpp"
#include "gl_fixture.hpp"
#include "metrics/metrics.hpp"
#include "optics/lens_preset.hpp"
#include "pictures.hpp"

namespace dioptre {
namespace {

using namespace test;

class ExtremesGLTest : public GlTest {
  protected:
    static Image finite(TechniqueChoice technique, const GpuScene& scene, const Shot& shot, const std::string& what) {
        Image picture = draw(technique, scene, shot);
        EXPECT_EQ(countNotFinite(picture), 0u) << techniqueName(technique) << ", " << what;
        EXPECT_TRUE(std::all_of(picture.pixels.begin(), picture.pixels.end(), [](float v) { return v >= 0.0f; }))
            << techniqueName(technique) << ", " << what << ": negative light";
        return picture;
    }
};

/// A bit of everything, from 0.3 m to infinity.
SceneBuilder someThings() {
    SceneBuilder b;
    const View view = testView();
    b.quad(view, {-50.3, 60.4, 250.7, 300.1}, 6.0, b.textured(checkerImage(8)), 4.0);
    b.quad(view, {30.3, 20.4, 90.7, 100.6}, 1.0, b.textured(checkerImage(4, {200, 80, 40, 255}, {60, 90, 160, 255})));
    b.sphere({0.25, 0.02, -1.6}, 0.2, b.unlit({0.2f, 0.7f, 0.3f}));
    b.quad(view, {120.6, -10.0, 128.2, 150.0}, 0.3, b.unlit({0.9f, 0.85f, 0.4f}));
    return b;
}

// Every technique, at the ends of what a lens can be set to.

TEST_F(ExtremesGLTest, FocusAnywhereWithAnyAperture) {
    struct Focus {
        const char* name;
        double metres, near;
    };
    const double infinity = std::numeric_limits<double>::infinity();
    for (const Focus& focus : {Focus{"1 mm beyond F", 0.01767, 0.005}, Focus{"the near plane", 0.05, 0.05},
                               Focus{"0.1 m", 0.1, 0.05}, Focus{"1 m", 1.0, 0.05}, Focus{"10 km", 1e4, 0.05},
                               Focus{"infinity", infinity, 0.05}, Focus{"1 m, near plane 0.1 mm", 1.0, 1e-4}})
        for (const TechniqueChoice technique : kTechniques) {
            Shot shot;
            shot.view.near = Metres(focus.near);
            SceneBuilder b = someThings();
            b.quad(shot.view, {100.2, 100.3, 140.6, 140.1}, 1.01 * focus.near, b.unlit({0.2f, 0.9f, 0.9f}));
            b.quad(shot.view, {10.2, 110.3, 60.6, 140.1}, 1e5, b.unlit({0.9f, 0.9f, 0.9f}));
            if (std::isfinite(focus.metres))
                for (const double off : {-1e-6, 0.0, 1e-6})
                    b.quad(shot.view, {70.0 + 3e6 * off, 50.0, 73.0 + 3e6 * off, 80.0}, focus.metres * (1.0 + off),
                           b.unlit({0.9f, 0.1f, 0.1f}));
            const GpuScene scene(b.scene());
            shot.lens.focus = std::isfinite(focus.metres) ? vergence(Metres(focus.metres)) : Dioptres(0.0);
            const auto at = [&](double diameter) {
                shot.lens.apertureRadius = Metres(0.5 * diameter);
                return finite(technique, scene, shot, fmt::format("focus at {}, {} m wide", focus.name, diameter));
            };
            const Image none = at(0.0);
            // Of what stays sharp: before a near plane of millimetres 10 um are a CoC of pixels.
            const double widest = 5e-6 * focalLengthPixels(shot.view).x *
                                  std::max(1.0 / (1.01 * focus.near) - shot.lens.focus.value, shot.lens.focus.value);
            const double close = ssim(none, at(10e-6));
            if (widest < 0.1) {
                EXPECT_GE(close, 0.999) << techniqueName(technique) << ", focus at " << focus.name;
            }
            EXPECT_LE(ssim(none, at(0.004)), technique == TechniqueChoice::pinhole ? 1.0 : 0.995)
                << techniqueName(technique) << ", focus at " << focus.name << ": nothing is blurred";
            at(0.2);
        }
}

TEST_F(ExtremesGLTest, EverythingAtFocusIsAsWithoutAnAperture) {
    for (const double metres : {0.01767, 0.1, 1.0, 1e4, 1e5})
        for (const TechniqueChoice technique : kTechniques) {
            Shot shot;
            shot.view.near = Metres(0.5 * std::min(metres, 0.1));
            SceneBuilder b;
            b.quad(shot.view, {-20.0, -20.0, 220.0, 170.0}, metres, b.textured(checkerImage(6)), 3.0);
            const GpuScene scene(b.scene());
            shot.lens = {Metres(0.0), Metres(0.01667), vergence(Metres(metres))};
            const std::string what = fmt::format("all at {} m", metres);
            const Image none = finite(technique, scene, shot, what);
            shot.lens.apertureRadius = Metres(0.004);
            EXPECT_GE(ssim(none, finite(technique, scene, shot, what)), 0.9999)
                << techniqueName(technique) << ", " << what;
        }
}

/// The width of a vertical bar's blur: the standard deviation of its light along x, px.
double spreadOfBar(const Image& picture) {
    double sum = 0.0, first = 0.0, second = 0.0;
    for (int x = 0; x < picture.width; ++x) {
        const auto v = static_cast<double>(picture.at(x, picture.height / 2));
        sum += v, first += v * x, second += v * x * x;
    }
    return std::sqrt(std::max(0.0, second / sum - first * first / (sum * sum)));
}

Image picturesBar(TechniqueChoice technique, const Shot& shot, double metres) {
    SceneBuilder b;
    b.wall(1.001 * metres, b.unlit(glm::vec3(0.0f)));
    b.quad(shot.view, {95.0, -200.0, 97.0, 400.0}, metres, b.unlit(glm::vec3(1.0f)));
    return draw(technique, GpuScene(b.scene()), shot);
}

TEST_F(ExtremesGLTest, TwiceTheApertureIsTwiceTheBlur) {
    // Of the circle of confusion itself
    for (const double diameter : {10e-6, 4e-3, 100e-3})
        for (const double focus : {0.0, 1.0, 59.0})
            for (const double object : {1e-5, 0.25, 3.0, 20.0}) {
                const View view = testView();
                const Lens once{Metres(0.5 * diameter), Metres(0.01667), Dioptres(focus)};
                const Lens twice{Metres(diameter), Metres(0.01667), Dioptres(focus)};
                const auto depth = static_cast<float>(object * view.near.value);
                const float small = cocFromDepth(once, focalLengthPixels(view).x, view.near).radius(depth);
                const float large = cocFromDepth(twice, focalLengthPixels(view).x, view.near).radius(depth);
                EXPECT_NEAR(large, 2.0f * small, 0.005f * std::abs(large))
                    << diameter << ", " << focus << ", " << object;
            }
    // And of what is drawn: a bar's blur has the variance of a disc, R^2/4, and the bar's own
    for (const TechniqueChoice technique : kTechniques) {
        if (technique == TechniqueChoice::pinhole) continue;
        for (const double focus : {0.25, 2.5}) {
            Shot shot;
            shot.samples = 512;
            shot.lens = {Metres(0.0), Metres(0.01667), Dioptres(focus)};
            const double own = spreadOfBar(picturesBar(technique, shot, 1.0));
            const auto spread = [&](double radius) {
                shot.lens = lensFor(shot.view, radius, focus, 1.0);
                const double all = spreadOfBar(picturesBar(technique, shot, 1.0));
                return std::sqrt(all * all - own * own);
            };
            const double small = spread(12.0), large = spread(24.0);
            // Exact where the lens is sampled; a pyramid's levels come in steps.
            const double tolerance = technique == TechniqueChoice::reference ? 0.005 : 0.05;
            EXPECT_NEAR(large / small, 2.0, 2.0 * tolerance) << techniqueName(technique) << ", focus " << focus << " D";
            EXPECT_NEAR(small, 6.0, technique == TechniqueChoice::reference ? 0.05 : 0.6)
                << techniqueName(technique) << ", focus " << focus << " D";
        }
    }
}

TEST_F(ExtremesGLTest, ShiftedByEqualVergencesTheBlurIsTheSame) {
    for (const TechniqueChoice technique : kTechniques) {
        Image first;
        for (const double shift : {0.0, 0.5, 3.0, 15.0}) {
            Shot shot;
            shot.lens = {Metres(0.008), Metres(0.01667), Dioptres(1.0 + shift)};
            SceneBuilder b;
            b.quad(shot.view, {-99.0, -99.0, 299.0, 260.0}, 1.0 / (0.2 + shift), b.unlit({0.3f, 0.5f, 0.7f}));
            b.quad(shot.view, {40.3, 30.2, 90.8, 110.1}, 1.0 / (1.0 + shift), b.unlit({0.8f, 0.7f, 0.2f}));
            b.quad(shot.view, {110.3, 20.2, 118.8, 130.1}, 1.0 / (4.0 + shift), b.unlit({0.9f, 0.1f, 0.2f}));
            const Image picture = finite(technique, GpuScene(b.scene()), shot, fmt::format("{} D nearer", shift));
            if (shift == 0.0)
                first = picture;
            else
                EXPECT_GE(ssim(first, picture), 0.999) << techniqueName(technique) << ", " << shift << " D nearer";
        }
    }
}

TEST_F(ExtremesGLTest, FewAndManySamples) {
    SceneBuilder wall;
    wall.wall(2.0, wall.unlit(glm::vec3(0.1f, 3.0f, 0.7f)));
    const GpuScene constant(wall.scene()), things(someThings().scene());
    for (const TechniqueChoice technique : kTechniques)
        for (const int samples : {1, 2, 3, 65536}) {
            Shot shot;
            shot.samples = samples;
            if (samples > 3) shot.view = testView(4, 3);
            shot.lens = lensFor(shot.view, 3.0, 3.0, 0.5);
            const Image even = finite(technique, constant, shot, fmt::format("{} samples", samples));
            const Worst worst = worstDifference(even, constantImage(even.width, even.height, {0.1f, 3.0f, 0.7f}));
            EXPECT_LE(worst.linear, 3.0 / 1024.0) << techniqueName(technique) << ", " << samples << ", " << worst;
            if (samples <= 3) finite(technique, things, shot, fmt::format("{} samples", samples));
        }
}

TEST_F(ExtremesGLTest, FaintLightAtAnExposureThatShowsIt) {
    SceneBuilder b;
    b.wall(2.0, b.unlit(glm::vec3(1e-7f)));
    const GpuScene scene(b.scene());
    for (const TechniqueChoice technique : kTechniques) {
        Shot shot;
        shot.lens = lensFor(shot.view, 5.0, 3.0, 0.5);
        const Image faint = finite(technique, scene, shot, "1e-7");
        EXPECT_LE(worstDifference(faint, constantImage(192, 144, glm::vec3(1e-7f))).linear, 1.2e-7);
        shot.exposure = 5e6f;
        const Image exposed = finite(technique, scene, shot, "1e-7 exposed");
        const Worst worst = worstDifference(exposed, constantImage(192, 144, glm::vec3(0.5f)));
        EXPECT_LE(worst.linear, 0.5 / 1024.0) << techniqueName(technique) << ", " << worst;
    }
}

TEST_F(ExtremesGLTest, LightThatIsCutDoesNotFlicker) {
    // A lamp of 1e5 that moves by hundredths of a pixel keeps its brightness, which its cut to 65504 says.
    for (const TechniqueChoice technique : kTechniques) {
        double least = 1e30, most = 0.0;
        for (int step = 0; step < 10; ++step) {
            Shot shot;
            shot.lens = lensFor(shot.view, 6.0, 3.0, 1.0);
            SceneBuilder b;
            const double x = 80.0 + 0.01 * step;
            b.wall(1.001, b.unlit(glm::vec3(0.0f)));
            b.quad(shot.view, {x + 0.25, 60.25, x + 8.25, 68.25}, 1.0, b.unlit(glm::vec3(1e5f)));
            const double light = meanColor(finite(technique, GpuScene(b.scene()), shot, "a lamp"), 0, 0, 192, 144).x;
            least = std::min(least, light), most = std::max(most, light);
        }
        EXPECT_LE(most / least, 1.01) << techniqueName(technique);
        EXPECT_NEAR(most, 65504.0 * 64.0 / (192.0 * 144.0), 0.06 * most) << techniqueName(technique);
    }
}

// Scenes that nobody should make, and that come nevertheless.

Scene degenerateThings() {
    SceneBuilder b = someThings();
    const int material = b.unlit({0.9f, 0.4f, 0.4f});
    const glm::dvec3 point(0.05, 0.02, -1.3);
    b.quad({point, point, point, point}, material);                                                  // a point
    b.quad({point, point + glm::dvec3(0.2, 0, 0), point + glm::dvec3(0.1, 0, 0), point}, material);  // a line
    b.quad(point, glm::dvec2(0.1), material).placed(glm::scale(glm::dmat4(1.0), glm::dvec3(0.0)));   // scaled to 0
    b.quad(point, glm::dvec2(0.1), material).placed(glm::scale(glm::dmat4(1.0), {1.0, 1.0, 0.0}));   // flattened
    b.quad(point, glm::dvec2(1e-12), material);
    return b.scene();
}

/// Two triangles each.
Scene manyTinyObjects(int count) {
    SceneBuilder b;
    const int material = b.unlit({0.9f, 0.8f, 0.3f});
    b.quad(glm::dvec3(0.0), glm::dvec2(2e-4), material);
    Scene scene = b.scene();
    const Instance first = scene.instances.front();
    scene.instances.clear();
    for (int i = 0; i < count; ++i) {
        const double d = 0.3 + 5.0 * halton(i + 1, 2);
        const glm::dvec3 at((halton(i + 1, 3) - 0.5) * 0.8 * d, (halton(i + 1, 5) - 0.5) * 0.6 * d, -d);
        Instance one = first;
        one.worldFromMesh = glm::mat4(glm::scale(glm::translate(glm::dmat4(1.0), at), glm::dvec3(10.0 * d)));
        scene.instances.push_back(one);
        scene.bounds.add(glm::vec3(at));
    }
    return scene;
}

TEST_F(ExtremesGLTest, ScenesThatNobodyShouldMake) {
    SceneBuilder ground;
    const View view = testView();
    ground.quad({glm::dvec3(-30, 0, 30), {30, 0, 30}, {30, 0, -30}, {-30, 0, -30}}, ground.textured(checkerImage(8)),
                30.0);
    ground.quad(view, {80.0, 40.0, 110.0, 120.0}, 2.0, ground.unlit({0.9f, 0.2f, 0.2f}));
    SceneBuilder inside;
    inside.box({-0.4, -0.3, -0.7}, {0.5, 0.3, 0.4}, inside.unlit({0.3f, 0.6f, 0.9f}));
    inside.sphere({0.0, 0.0, 0.0}, 3.0, inside.unlit({0.6f, 0.5f, 0.1f}));
    struct Case {
        const char* name;
        Scene scene;
        double least;  // of the mean light
    };
    const Case cases[] = {{"degenerate triangles, objects without area", degenerateThings(), 0.05},
                          {"100,000 tiny objects", manyTinyObjects(100000), 0.02},
                          {"a ground of 60 m through the eye", ground.scene(), 0.005},
                          {"the eye in a box", inside.scene(), 0.3}};
    for (const Case& c : cases) {
        const GpuScene scene(c.scene);
        for (const TechniqueChoice technique : kTechniques)
            for (const double focus : {0.0, 1.0, 18.0}) {
                Shot shot;
                shot.samples = 4;
                shot.lens = {Metres(0.004), Metres(0.01667), Dioptres(focus)};
                const Image picture = finite(technique, scene, shot, c.name);
                EXPECT_GE(meanColor(picture, 0, 0, 192, 144).y, c.least) << techniqueName(technique) << ", " << c.name;
            }
    }
    // What has no area is not seen.
    Shot shot;
    EXPECT_EQ(worstDifference(draw(TechniqueChoice::pinhole, GpuScene(degenerateThings()), shot),
                              draw(TechniqueChoice::pinhole, GpuScene(someThings().scene()), shot))
                  .linear,
              0.0);
}

TEST_F(ExtremesGLTest, ABlurLargerThanThePictureIsItsMean) {
    SceneBuilder b;
    b.wall(2.0, b.textured(checkerImage(2)), 200.0);
    const GpuScene scene(b.scene());
    for (const TechniqueChoice technique : kTechniques) {
        if (technique == TechniqueChoice::pinhole) continue;
        Shot shot;
        shot.view = testView(48, 36);
        shot.samples = 256;
        shot.lens = lensFor(shot.view, 200.0, 8.0, 0.5);  // of a picture 48 wide
        const Image picture = finite(technique, scene, shot, "a blur of 400 px");
        const Worst worst = worstDifference(picture, constantImage(48, 36, glm::vec3(0.5f)));
        EXPECT_LE(worst.mean, 0.03) << techniqueName(technique) << ", " << worst;
    }
}

TEST_F(ExtremesGLTest, EveryLensPreset) {
    const GpuScene scene(someThings().scene());
    int presets = 0;
    for (const auto& file : std::filesystem::directory_iterator(resource("config/lenses"))) {
        const LensPreset preset = loadLensPreset(file.path());
        ++presets;
        for (const TechniqueChoice technique : kTechniques)
            for (const double focus : {0.0, 1.0, 100.0}) {
                Shot shot;
                shot.samples = 4;
                const ResolvedLens resolved = resolveLens(preset, {}, Dioptres(focus));
                shot.lens = resolved.lens;
                validate(shot.lens);
                finite(technique, scene, shot, fmt::format("{}, focus {} D", file.path().stem().string(), focus));
            }
    }
    EXPECT_GE(presets, 3);
}

TEST_F(ExtremesGLTest, ApertureZeroIsAPinhole) {
    const GpuScene scene(someThings().scene());
    for (const double focus : {0.0, 1.0, 20.0}) {
        Shot shot;
        shot.lens = {Metres(0.0), Metres(0.01667), Dioptres(focus)};
        const Image sharp = finite(TechniqueChoice::pinhole, scene, shot, "aperture 0");
        const Image mipmap = finite(TechniqueChoice::mipmap, scene, shot, "aperture 0");
        const Worst worst = worstDifference(sharp, mipmap);
        EXPECT_EQ(worst.linear, 0.0) << "focus " << focus << " D, " << worst;
    }
}

TEST_F(ExtremesGLTest, AVastApertureLeavesTheMean) {
    SceneBuilder b;
    b.wall(2.0, b.textured(checkerImage(2)), 400.0);  // squares of 2 cm, 4.7 px; mean 1/2
    const GpuScene scene(b.scene());
    Shot shot;
    shot.lens = {Metres(0.1), Metres(0.01667), Dioptres(5.0)};  // DIAMETER 200 mm; CoC radius 105 px
    const Image mipmap = finite(TechniqueChoice::mipmap, scene, shot, "aperture 200 mm");
    const Worst worst = worstDifference(mipmap, constantImage(192, 144, glm::vec3(0.5f)));
    EXPECT_LE(worst.linear, 0.04) << worst;
    finite(TechniqueChoice::pinhole, scene, shot, "aperture 200 mm");
    const GpuScene things(someThings().scene());
    for (const double focus : {0.0, 0.5, 1.0, 3.3, 59.0})
        for (const TechniqueChoice technique : kTechniques) {
            shot.lens.focus = Dioptres(focus);
            finite(technique, things, shot, "aperture 200 mm, focus " + std::to_string(focus) + " D");
        }
}

/// Focus where something is: that keeps its pinhole pixels (2 px from its edges), whatever the rest does.
TEST_F(ExtremesGLTest, WhatIsInFocusStaysSharp) {
    const PixelRect target{60.0, 40.0, 130.0, 110.0};
    struct Case {
        const char* name;
        double distance, near, diameter, focalLength;
    };
    for (const Case& c :
         {Case{"1 mm beyond F", 0.01767, 0.005, 0.008, 0.01667},
          Case{"1 mm beyond the F of a camera lens", 0.051, 0.01, 0.0357, 0.05},
          Case{"just beyond the near plane", 0.0500001, 0.05, 0.008, 0.01667},
          Case{"infinity", 1e7, 0.05, 0.008, 0.01667}, Case{"at 10 m by 200 mm", 10.0, 0.05, 0.2, 0.05}}) {
        SceneBuilder b;
        Shot shot;
        shot.view = testView(192, 144, c.near);
        shot.lens = {Metres(0.5 * c.diameter), Metres(c.focalLength), vergence(Metres(c.distance))};
        const double other = c.distance > 1.0 ? 1.0 : 4.0;
        b.quad(shot.view, {-99.0, -99.0, 299.0, 40.0}, other, b.unlit({0.8f, 0.3f, 0.1f}));
        b.quad(shot.view, target, c.distance, b.textured(checkerImage(8)));
        const GpuScene scene(b.scene());
        const Image sharp = finite(TechniqueChoice::pinhole, scene, shot, c.name);
        const Image mipmap = finite(TechniqueChoice::mipmap, scene, shot, c.name);
        // Below the reach of what lies above it, which at `other` is blurred.
        const double reach = cocRadiusPixels(shot.lens, focalLengthPixels(shot.view).x, vergence(Metres(other)));
        const double top = target.y0 + (other < c.distance ? std::abs(reach) : 0.0) + 2.0;
        const PixelRect inner{target.x0 + 2.0, std::min(top, 90.0), target.x1 - 2.0, target.y1 - 2.0};
        const Worst worst = worstDifference(sharp, mipmap, [&](int x, int y) { return inner.distance(x, y) == 0.0; });
        EXPECT_LE(worst.linear, 2.0 / 255.0) << "focus " << c.name << ", " << worst;
        EXPECT_GT(meanColor(sharp, 62, 91, 128, 108).x, 0.3) << "focus " << c.name << ": the target is not there";
    }
}

TEST_F(ExtremesGLTest, ScaleDoesNotMatter) {
    Shot unit;
    unit.lens = lensFor(unit.view, 6.0, 1.0, 1.0 / 0.3);
    for (const TechniqueChoice technique : kTechniques) {
        const Image reference = finite(technique, GpuScene(someThings().scene()), unit, "6 m across");
        for (const double scale : {1e-4, 1e-3, 1e3, 1e5, 1e6}) {
            Shot shot = unit;
            shot.view.near = unit.view.near * scale;
            shot.lens = {unit.lens.apertureRadius * scale, unit.lens.focalLength * scale, unit.lens.focus / scale};
            const std::string what = "scale " + std::to_string(scale);
            const Image picture = finite(technique, GpuScene(someThings().scaled(scale).scene()), shot, what);
            // Rounding may move an edge across a sample: few pixels, not many.
            const Worst worst = worstDifference(picture, reference);
            EXPECT_LE(worst.mean, 0.1 / 255.0) << techniqueName(technique) << ", " << what << ", " << worst;
        }
    }
}

TEST_F(ExtremesGLTest, GreatRadianceEndsAtHalfFloats) {
    Shot shot;
    for (const double focus : {0.25, 1.0, 4.0})
        for (const double radius : {0.0, 1.0, 8.0, 80.0}) {
            shot.samples = radius < 80.0 ? 16 : 128;  // the spot fills a fiftieth of that lens
            shot.lens = lensFor(shot.view, radius, focus, focus == 1.0 ? 3.0 : 1.0);
            const std::string what = "focus " + std::to_string(focus) + " D, CoC radius " + std::to_string(radius);
            SceneBuilder whole;
            whole.wall(1.0, whole.unlit(glm::vec3(1e5f)));
            SceneBuilder spot;
            spot.wall(2.0, spot.unlit(glm::vec3(0.2f)));
            spot.quad(shot.view, {90.0, 60.0, 110.0, 80.0}, 1.0, spot.unlit(glm::vec3(1e5f)));
            spot.quad(shot.view, {20.0, 20.0, 22.0, 90.0}, 0.4, spot.unlit({1e5f, 0.0f, 1e5f}));
            for (const TechniqueChoice technique : kTechniques) {
                const Image even = finite(technique, GpuScene(whole.scene()), shot, "wall of 1e5, " + what);
                const Worst worst = worstDifference(even, constantImage(192, 144, glm::vec3(65504.0f)));
                EXPECT_LE(worst.linear, 65504.0 / 255.0) << techniqueName(technique) << ", " << what << ", " << worst;
                const Image mixed = finite(technique, GpuScene(spot.scene()), shot, "spots of 1e5, " + what);
                EXPECT_GT(mixed.at(100, 70), 100.0f) << techniqueName(technique) << ", " << what;
            }
        }
}

TEST_F(ExtremesGLTest, OddSizesOfPictures) {
    const glm::vec3 color(0.6f, 0.3f, 2.0f);
    SceneBuilder b;
    const int even = b.unlit(color);
    b.wall(4.0, even);
    b.quad({0.0, 0.0, -0.7}, {0.1, 0.1}, even);
    const GpuScene scene(b.scene()), things(someThings().scene());
    struct Size {
        int width, height;
    };
    for (const TechniqueChoice choice : kTechniques) {
        const auto technique = makeTechnique(choice);
        for (const Size size : {Size{1, 1}, {1, 4096}, {4096, 3}, {257, 3}, {2, 2}, {3, 1}, {191, 143}})
            for (const int msaa : {0, 4})
                for (const double radius : {0.0, 3.0, 40.0}) {
                    Shot shot;
                    shot.view = testView(size.width, size.height);
                    // Square pixels of the field that 144 rows have, so that all the sizes look at the same things.
                    const double perPixel = std::tan(0.3) / 72.0;
                    shot.view.frustum = {-0.5 * size.width * perPixel, 0.5 * size.width * perPixel,
                                         -0.5 * size.height * perPixel, 0.5 * size.height * perPixel};
                    shot.msaa = msaa;
                    shot.lens = lensFor(shot.view, radius, 1.0, 0.25);
                    const std::string what = std::to_string(size.width) + "x" + std::to_string(size.height) +
                                             ", msaa " + std::to_string(msaa) + ", CoC radius " +
                                             std::to_string(radius);
                    const Image picture = draw(*technique, scene, shot);
                    ASSERT_EQ(picture.width, size.width);
                    ASSERT_EQ(picture.height, size.height);
                    // Some 20 m of wall to either side: a row of 4096 pixels sees its ends.
                    const Worst worst =
                        worstDifference(picture, constantImage(size.width, size.height, color), [&](int x, int y) {
                            return std::abs(x - size.width / 2) < 700 && std::abs(y - size.height / 2) < 700;
                        });
                    EXPECT_LE(worst.linear, 2.0 / 255.0) << techniqueName(choice) << ", " << what << ", " << worst;
                    EXPECT_EQ(countNotFinite(draw(*technique, things, shot)), 0u)
                        << techniqueName(choice) << ", " << what;
                }
    }
}

TEST_F(ExtremesGLTest, AnEmptySceneIsBlack) {
    const GpuScene scene{Scene{}};
    for (const TechniqueChoice technique : kTechniques)
        for (const int msaa : {0, 4}) {
            Shot shot;
            shot.msaa = msaa;
            shot.lens = {Metres(0.02), Metres(0.01667), Dioptres(3.0)};
            const Image picture = finite(technique, scene, shot, "empty scene");
            EXPECT_EQ(worstDifference(picture, constantImage(192, 144, glm::vec3(0.0f))).linear, 0.0);
        }
    EXPECT_FALSE(scene.contents(testView()).anything);
}

TEST_F(ExtremesGLTest, ThingsMayPassThroughTheNearPlane) {
    SceneBuilder b;
    b.wall(3.0, b.textured(checkerImage(8)), 20.0);
    b.box({-0.3, -0.4, -2.0}, {0.3, -0.02, 1.0}, b.unlit({0.7f, 0.4f, 0.2f}));
    b.box({0.011, -0.3, -0.2}, {0.06, 0.3, 0.2}, b.unlit({0.2f, 0.4f, 0.8f}));
    const GpuScene scene(b.scene());
    // Bounded by the near plane, 1/0.05 D.
    EXPECT_DOUBLE_EQ(scene.contents(testView()).nearest, 20.0);
    for (const TechniqueChoice technique : kTechniques)
        for (const double focus : {0.0, 1.0, 20.0}) {
            Shot shot;
            shot.lens = {Metres(0.003), Metres(0.01667), Dioptres(focus)};
            const Image picture = finite(technique, scene, shot, "through the near plane");
            // The slab fills the lower edge, up to the viewer's feet.
            if (focus == 1.0 && technique == TechniqueChoice::pinhole) {
                EXPECT_NEAR(meanColor(picture, 40, 135, 80, 144).x, 0.7, 0.01);
            }
        }
}

}  // namespace
}  // namespace dioptre
