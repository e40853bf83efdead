// Ends of every range: nothing but finite numbers, and the right limit.
#include <functional>
#include <string>

#include "gl_fixture.hpp"
#include "pictures.hpp"

namespace dioptre {
namespace {

using namespace test;

class ExtremesGLTest : public GlTest {
  protected:
    static Image finite(TechniqueChoice technique, const GpuScene& scene, const Shot& shot, const std::string& what) {
        Image picture = draw(technique, scene, shot);
        EXPECT_EQ(countNotFinite(picture), 0u) << nameOf(technique) << ", " << what;
        EXPECT_TRUE(std::all_of(picture.pixels.begin(), picture.pixels.end(), [](float v) { return v >= 0.0f; }))
            << nameOf(technique) << ", " << what << ": negative light";
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
            EXPECT_LE(worst.mean, 0.1 / 255.0) << nameOf(technique) << ", " << what << ", " << worst;
        }
    }
}

TEST_F(ExtremesGLTest, GreatRadianceEndsAtHalfFloats) {
    Shot shot;
    for (const double focus : {0.25, 1.0, 4.0})
        for (const double radius : {0.0, 1.0, 8.0, 80.0}) {
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
                EXPECT_LE(worst.linear, 65504.0 / 255.0) << nameOf(technique) << ", " << what << ", " << worst;
                const Image mixed = finite(technique, GpuScene(spot.scene()), shot, "spots of 1e5, " + what);
                EXPECT_GT(mixed.at(100, 70), 100.0f) << nameOf(technique) << ", " << what;
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
                    EXPECT_LE(worst.linear, 2.0 / 255.0) << nameOf(choice) << ", " << what << ", " << worst;
                    EXPECT_EQ(countNotFinite(draw(*technique, things, shot)), 0u) << nameOf(choice) << ", " << what;
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
    EXPECT_FALSE(scene.vergenceRange(testView()).anything);
}

TEST_F(ExtremesGLTest, ThingsMayPassThroughTheNearPlane) {
    SceneBuilder b;
    b.wall(3.0, b.textured(checkerImage(8)), 20.0);
    b.box({-0.3, -0.4, -2.0}, {0.3, -0.02, 1.0}, b.unlit({0.7f, 0.4f, 0.2f}));
    b.box({0.011, -0.3, -0.2}, {0.06, 0.3, 0.2}, b.unlit({0.2f, 0.4f, 0.8f}));
    const GpuScene scene(b.scene());
    // Bounded by the near plane, 1/0.05 D.
    EXPECT_DOUBLE_EQ(scene.vergenceRange(testView()).nearest, 20.0);
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
