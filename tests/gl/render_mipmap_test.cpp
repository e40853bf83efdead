// Mipmap depth of field against plain accumulation over the lens, drawn in the same run.
#include <random>
#include <string>

#include "gl_fixture.hpp"
#include "metrics/metrics.hpp"
#include "pictures.hpp"

namespace dioptre {
namespace {

using namespace test;

class MipmapGLTest : public GlTest {
  protected:
    /// The floor is what the technique has to give; the pinhole must be worse or the scene tests nothing.
    void expectCloser(const char* name, const Scene& plain, const Shot& shot, double floor) {
        const GpuScene scene(plain);
        const Image reference = accumulated(scene, shot);
        const double sharp = ssim(reference, draw(TechniqueChoice::pinhole, scene, shot));
        const double blurred = ssim(reference, draw(TechniqueChoice::mipmap, scene, shot));
        EXPECT_LT(sharp, floor) << name << ": too easy";
        EXPECT_GT(blurred, sharp) << name;
        EXPECT_GE(blurred, floor) << name << ": pinhole has " << sharp;
        RecordProperty(std::string(name) + "_pinhole", std::to_string(sharp));
        RecordProperty(std::string(name) + "_mipmap", std::to_string(blurred));
    }
};

const Texel kInk{40, 50, 90, 255}, kPaper{230, 220, 200, 255};

/// A large near thing, one in focus, a patterned ground.
Scene foreground() {
    SceneBuilder b;
    const View view = testView();
    b.wall(5.0, b.textured(checkerImage(8, kPaper, kInk)), 6.0);
    b.quad(view, {80.0, 30.0, 150.0, 110.0}, 1.25,
           b.textured(checkerImage(8, {210, 60, 40, 255}, {240, 200, 60, 255})));
    b.sphere({0.35, -0.25, -2.0}, 0.2, b.unlit({0.1f, 0.6f, 0.3f}));
    b.quad(view, {-20.0, 60.0, 60.0, 170.0}, 0.5, b.textured(checkerImage(4, {40, 160, 70, 255}, {120, 220, 90, 255})));
    return b.scene();
}

/// Things at all depths.
Scene crowd() {
    SceneBuilder b;
    const View view = testView();
    std::mt19937 random(7);
    const auto uniform = [&](double low, double high) {
        return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
    };
    b.wall(12.0, b.textured(checkerImage(8, kPaper, kInk)), 8.0);
    for (int i = 0; i < 24; ++i) {
        const double d = 1.0 / uniform(0.15, 2.5), x = uniform(0.0, 192.0), y = uniform(0.0, 144.0),
                     s = uniform(8.0, 22.0);
        const auto channel = [&] { return static_cast<std::uint8_t>(uniform(20.0, 250.0)); };
        const Texel color{channel(), channel(), channel(), 255}, other{channel(), channel(), channel(), 255};
        b.quad(view, {x - s, y - s, x + s, y + s}, d, b.textured(checkerImage(2, color, other)));
    }
    return b.scene();
}

/// Thin near branches before a patterned wall in focus.
Scene branches() {
    SceneBuilder b;
    const View view = testView();
    b.wall(1.25, b.textured(checkerImage(8, kPaper, kInk)), 16.0);
    const int bark = b.unlit({0.25f, 0.12f, 0.05f});
    for (int i = 0; i < 9; ++i) {
        const double x = 12.0 + 21.0 * i, lean = 5.0 * (i % 3 - 1), d = 0.45 + 0.05 * (i % 4);
        b.quad({worldAt(view, {x - lean, 160.0}, d), worldAt(view, {x + 3.0 - lean, 160.0}, d),
                worldAt(view, {x + 3.0 + lean, -16.0}, d), worldAt(view, {x + lean, -16.0}, d)},
               bark);
    }
    return b.scene();
}

Shot referenceShot(double foregroundRadius, int msaa) {
    Shot shot;
    shot.msaa = msaa;
    shot.lens = lensFor(shot.view, foregroundRadius, 0.8, 2.0);
    return shot;
}

// Floors: a float64 trial of the published method left 12 %, 21 % and 40 % of the pinhole's 1 - SSIM on
// scenes of these kinds; here, on pictures a third as wide and with a reference of 64 samples, 29 %, 26 % and 42 % are
// allowed.
TEST_F(MipmapGLTest, ForegroundIsCloserThanPinhole) {
    expectCloser("foreground", foreground(), referenceShot(8.0, 4), 0.96);
}
TEST_F(MipmapGLTest, CrowdIsCloserThanPinhole) {
    expectCloser("crowd", crowd(), referenceShot(8.0, 4), 0.90);
}
TEST_F(MipmapGLTest, BranchesAreCloserThanPinhole) {
    expectCloser("branches", branches(), referenceShot(6.0, 4), 0.90);
}

TEST_F(MipmapGLTest, ReferenceAgreesWithTheCircleOfConfusion) {
    // The judge is judged too: half of an edge's light is where the edge is, and none past the radius.
    Shot shot;
    shot.lens = lensFor(shot.view, 12.0, 1.0, 2.0);
    SceneBuilder b;
    b.wall(1.0, b.unlit(glm::vec3(0.0f)));
    b.quad({-2.0, 0.0, -0.5}, {4.0, 4.0}, b.unlit(glm::vec3(1.0f)));
    const Image picture = accumulated(GpuScene(b.scene()), shot, 256);
    EXPECT_NEAR(static_cast<double>(picture.at(95, 72) + picture.at(96, 72)), 1.0, 0.05);
    EXPECT_EQ(picture.at(96 + 13, 72), 0.0f);
    EXPECT_EQ(picture.at(95 - 13, 72), 1.0f);
}

TEST_F(MipmapGLTest, SmallAperturesConvergeToPinhole) {
    const GpuScene scene(crowd());
    const auto technique = makeTechnique(TechniqueChoice::mipmap);
    Shot shot = referenceShot(16.0, 0);
    const Image sharp = draw(TechniqueChoice::pinhole, scene, shot);
    const double full = shot.lens.apertureRadius.value;
    double previous = 1e9;
    for (const double radius : {16.0, 4.0, 1.0, 0.4, 0.1, 0.0}) {
        shot.lens.apertureRadius = Metres(full * radius / 16.0);
        const Worst worst = worstDifference(draw(*technique, scene, shot), sharp);
        EXPECT_LE(worst.mean, previous) << "largest CoC radius " << radius;
        const double allowed = radius == 0.0 ? 0.0 : radius <= 0.1 ? 2.0 / 255.0 : 1.0;
        EXPECT_LE(worst.linear, allowed) << "largest CoC radius " << radius << ", " << worst;
        previous = worst.mean;
    }
}

/// Radius of a disc with the spot's second moment about its own centre, the spot's own size taken off; and its light.
struct SpotMeasure {
    double radius = 0.0, light = 0.0;
    glm::dvec2 centre{0.0};
};

SpotMeasure measureSpot(const Image& image, double side) {
    SpotMeasure m;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const double w = static_cast<double>(image.at(x, y));
            m.light += w;
            m.centre += w * glm::dvec2(x + 0.5, y + 0.5);
        }
    m.centre /= m.light;
    double moment = 0.0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const glm::dvec2 r = glm::dvec2(x + 0.5, y + 0.5) - m.centre;
            moment += static_cast<double>(image.at(x, y)) * glm::dot(r, r);
        }
    // A disc has radius²/2, a square side²/6.
    m.radius = std::sqrt(std::max(0.0, 2.0 * (moment / m.light - side * side / 6.0)));
    return m;
}

TEST_F(MipmapGLTest, SpotsSpreadAsTheCircleOfConfusion) {
    const auto technique = makeTechnique(TechniqueChoice::mipmap);
    constexpr double kSide = 4.0;
    for (const bool behind : {false, true})
        for (const double radius : {4.0, 8.0, 16.0, 32.0}) {
            Shot shot;
            const double focus = behind ? 3.0 : 0.3;
            shot.lens = lensFor(shot.view, radius, focus, 1.0);
            SceneBuilder b;
            b.quad(shot.view, {94.0, 70.0, 94.0 + kSide, 70.0 + kSide}, 1.0, b.unlit(glm::vec3(100.0f)));
            // Black and as far, so that only the spot's own light spreads.
            b.wall(1.001, b.unlit(glm::vec3(0.0f)));
            const GpuScene scene(b.scene());
            const SpotMeasure spot = measureSpot(draw(*technique, scene, shot), kSide);
            const SpotMeasure truth = measureSpot(accumulated(scene, shot), kSide);
            const std::string what = std::string(behind ? "behind" : "before") + " focus, CoC radius " +
                                     std::to_string(radius) + ": reference has " + std::to_string(truth.radius) +
                                     " and light " + std::to_string(truth.light) + ", spot has light " +
                                     std::to_string(spot.light);
            EXPECT_NEAR(truth.radius / radius, 1.0, 0.05) << what;
            EXPECT_NEAR(spot.radius / radius, 1.0, 0.15) << what;
            EXPECT_NEAR(spot.centre.x, 96.0, 0.5) << what;
            EXPECT_NEAR(spot.centre.y, 72.0, 0.5) << what;
            const std::string key = std::string(behind ? "behind_" : "before_") + std::to_string(int(radius));
            RecordProperty(key + "_radius_ratio", std::to_string(spot.radius / radius));
            RecordProperty(key + "_light_ratio", std::to_string(spot.light / truth.light));
        }
}

// Wherever it stands among the tiles of the foreground's reach, a dot's light is the same and about its centre.
TEST_F(MipmapGLTest, ForegroundDotsDoNotDependOnTheirPlace) {
    const auto technique = makeTechnique(TechniqueChoice::mipmap);
    for (const double radius : {3.0, 6.0, 11.5})
        for (int offset = 0; offset < 8; ++offset) {
            Shot shot;
            shot.lens = lensFor(shot.view, radius, 1.0, 2.0);
            SceneBuilder b;
            b.wall(1.0, b.unlit(glm::vec3(0.0f)));
            const double x = 88.0 + offset, y = 64.0 + (offset * 3) % 8;
            b.quad(shot.view, {x, y, x + 2.0, y + 2.0}, 0.5, b.unlit(glm::vec3(10.0f)));
            const Image picture = draw(*technique, GpuScene(b.scene()), shot);
            double light = 0.0;
            glm::dvec2 centre(0.0);
            for (int py = 0; py < picture.height; ++py)
                for (int px = 0; px < picture.width; ++px) {
                    light += static_cast<double>(picture.at(px, py));
                    centre += static_cast<double>(picture.at(px, py)) * glm::dvec2(px + 0.5, py + 0.5);
                }
            centre /= light;
            EXPECT_NEAR(light, 40.0, 4.0) << "radius " << radius << ", offset " << offset;
            EXPECT_NEAR(centre.x, x + 1.0, 0.3) << "radius " << radius << ", offset " << offset;
            EXPECT_NEAR(centre.y, y + 1.0, 0.3) << "radius " << radius << ", offset " << offset;
        }
}

}  // namespace
}  // namespace dioptre
