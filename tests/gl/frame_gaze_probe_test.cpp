// What lies under the gaze, from the two eyes' depth.
#include "focus/stereo_rig.hpp"
#include "frame/gaze_probe.hpp"
#include "gl_fixture.hpp"
#include "pictures.hpp"

namespace dioptre {
namespace {

using namespace test;

class GazeProbeGLTest : public GlTest {
  protected:
    std::optional<Dioptres> under(const GpuScene& scene, glm::dvec2 gaze, Metres ipd = Metres(0.063),
                                  const View& head = testView()) {
        const std::vector<View> eyes{eyeView(Eye::left, head, ipd), eyeView(Eye::right, head, ipd)};
        return probe_.vergence(scene, eyes, eyeView(Eye::centre, head, ipd), gaze, Radians(0.0087), log_);
    }

    GazeProbe probe_;
    PassLog log_;
};

TEST_F(GazeProbeGLTest, AWallAtAKnownDistance) {
    for (const double distance : {0.2, 0.5, 1.0, 3.0, 10.0, 1000.0}) {
        SceneBuilder b;
        b.wall(distance, b.unlit(glm::vec3(1.0f)));
        const GpuScene scene(b.scene());
        for (const glm::dvec2 gaze : {glm::dvec2(0.5), {0.1, 0.2}, {0.93, 0.88}, {0.0, 0.0}, {1.0, 1.0}}) {
            const auto seen = under(scene, gaze);
            ASSERT_TRUE(seen.has_value()) << distance << " m, gaze " << gaze.x << ", " << gaze.y;
            EXPECT_NEAR(seen->value, 1.0 / distance, 1e-4) << distance << " m, gaze " << gaze.x << ", " << gaze.y;
        }
    }
}

TEST_F(GazeProbeGLTest, ASlantedFloorAtTheGaze) {
    SceneBuilder b;
    b.quad({glm::dvec3(-50.0, -1.5, 0.0), glm::dvec3(50.0, -1.5, 0.0), glm::dvec3(50.0, -1.5, -100.0),
            glm::dvec3(-50.0, -1.5, -100.0)},
           b.unlit(glm::vec3(1.0f)));
    const GpuScene scene(b.scene());
    for (const double y : {0.6, 0.75, 0.95}) {
        // A ray at the tangent t below the horizon meets the floor at 1.5/t.
        const double t = std::tan(0.3) * (2.0 * y - 1.0);
        const auto seen = under(scene, {0.5, y});
        ASSERT_TRUE(seen.has_value());
        EXPECT_NEAR(seen->value, t / 1.5, 0.003) << "gaze at height " << y;
    }
}

// A small and certain gaze tells the two sides of a depth edge apart to the pixel.
TEST_F(GazeProbeGLTest, DepthEdgesAreWhereTheyAreSeen) {
    const View head = testView();
    SceneBuilder b;
    b.wall(4.0, b.unlit(glm::vec3(0.5f)));
    b.quad(head, {-400.0, -300.0, 70.0, 40.0}, 1.0, b.unlit(glm::vec3(1.0f)));  // up to column 70, row 40
    const GpuScene scene(b.scene());
    const auto at = [&](double x, double y) {
        return probe_.vergence(scene, std::vector<View>{head}, head, {x / 192.0, y / 144.0}, Radians(0.0), log_)
            .value_or(Dioptres(-1.0))
            .value;
    };
    EXPECT_NEAR(at(69.5, 20.5), 1.0, 1e-4);
    EXPECT_NEAR(at(70.5, 20.5), 0.25, 1e-4);
    EXPECT_NEAR(at(30.5, 39.5), 1.0, 1e-4);
    EXPECT_NEAR(at(30.5, 40.5), 0.25, 1e-4);
}

// A finger in the line of the gaze: in neither eye's picture is it where the gaze is.
TEST_F(GazeProbeGLTest, ANearThingOnlyTheMidpointHasThere) {
    const View head = testView();
    SceneBuilder b;
    b.wall(5.0, b.unlit(glm::vec3(0.5f)));
    b.quad(head, {76.0, 30.0, 116.0, 110.0}, 0.25, b.unlit(glm::vec3(1.0f)));  // 4 D: 29 px to either side
    const GpuScene scene(b.scene());
    const auto eye = eyeView(Eye::left, head, Metres(0.063));
    const double shift = midpointShift(eye, head).pixelsPerDioptre * 4.0;
    ASSERT_GT(std::abs(shift), 20.0);
    const auto seen = under(scene, {0.5, 0.5});
    ASSERT_TRUE(seen.has_value());
    EXPECT_NEAR(seen->value, 4.0, 1e-3);
    // Where one eye's picture has it, the midpoint looks past it.
    for (const double x : {96.0 - 29.4 - 6.0, 96.0 + 29.4 + 6.0}) {
        const auto beside = under(scene, {x / 192.0, 0.5});
        ASSERT_TRUE(beside.has_value());
        EXPECT_NEAR(beside->value, 0.2, 1e-4) << "gaze at pixel " << x;
    }
}

TEST_F(GazeProbeGLTest, TheSkyIsInfinitelyFar) {
    SceneBuilder b;
    b.quad(testView(), {0.0, 90.0, 192.0, 144.0}, 1.0, b.unlit(glm::vec3(1.0f)));
    const GpuScene scene(b.scene()), empty{Scene{}};
    for (const GpuScene* s : {&scene, &empty}) {
        const auto seen = under(*s, {0.5, 0.2});
        ASSERT_TRUE(seen.has_value());
        EXPECT_EQ(seen->value, 0.0);
    }
}

TEST_F(GazeProbeGLTest, MaskedHolesAreLookedThrough) {
    SceneBuilder b;
    b.wall(4.0, b.unlit(glm::vec3(0.5f)));
    Material m;
    m.alphaMode = AlphaMode::mask;
    m.unlit = true;
    b.textured({"hole", 1, 1, {255, 255, 255, 0}});
    m.baseColorTexture.image = 0;
    b.wall(1.0, b.material(m));
    const auto seen = under(GpuScene(b.scene()), {0.5, 0.5});
    ASSERT_TRUE(seen.has_value());
    EXPECT_NEAR(seen->value, 0.25, 1e-4);
}

// Half of what comes from behind decides, for each surface by itself.
TEST_F(GazeProbeGLTest, PanesAreLookedThroughWhereTheyGiveLessLight) {
    const auto pane = [](float alpha) {
        Material m;
        m.unlit = true;
        m.doubleSided = true;
        m.baseColor = glm::vec4(0.3f, 0.5f, 0.9f, alpha);
        m.alphaMode = AlphaMode::blend;
        return m;
    };
    struct Case {
        std::vector<float> panes;  // at 1 m, 2 m, ...
        double sees;               // dioptres
    };
    for (const Case& c : {Case{{0.2f}, 0.25},
                          {{0.45f}, 0.25},
                          {{0.55f}, 1.0},
                          {{1.0f}, 1.0},
                          {{0.3f, 0.4f}, 0.25},
                          {{0.3f, 0.8f}, 0.5},
                          {{0.8f, 0.8f}, 1.0}}) {
        SceneBuilder b;
        b.wall(4.0, b.unlit(glm::vec3(0.5f)));
        for (std::size_t i = 0; i < c.panes.size(); ++i)
            b.wall(static_cast<double>(i) + 1.0, b.material(pane(c.panes[i])));
        const auto seen = under(GpuScene(b.scene()), {0.5, 0.5});
        ASSERT_TRUE(seen.has_value());
        EXPECT_NEAR(seen->value, c.sees, 1e-4) << c.panes.size() << " panes, the first with alpha " << c.panes[0];
    }
}

// Leaves by an alpha mask, and leaves of glass: squares on a quarter or three quarters of the surface, smaller than the
// cone (sigma 2 px here).
TEST_F(GazeProbeGLTest, FoliageIsLookedThroughUntilItFillsHalfOfTheCone) {
    for (const AlphaMode mode : {AlphaMode::mask, AlphaMode::blend})
        for (const bool dense : {false, true}) {
            const std::uint8_t there = 230, gone = 20;
            TextureImage leaves{"leaves", 2, 2, {}};
            for (int i = 0; i < 4; ++i) {
                const bool leaf = (i == 0) != dense;
                for (const std::uint8_t value :
                     {std::uint8_t{90}, std::uint8_t{200}, std::uint8_t{60}, leaf ? there : gone})
                    leaves.rgba.push_back(value);
            }
            SceneBuilder b;
            b.wall(4.0, b.unlit(glm::vec3(0.5f)));
            b.textured(leaves);
            Material m;
            m.unlit = true;
            m.doubleSided = true;
            m.alphaMode = mode;
            m.baseColorTexture = {0, {.magnification = Filter::nearest, .minification = Filter::nearest}};
            b.quad(testView(), {0.0, 0.0, 192.0, 144.0}, 1.0, b.material(m), 48.0);  // texels of 2 x 1.5 px
            const GpuScene scene(b.scene());
            for (const double x : {0.45, 0.47, 0.5, 0.52}) {
                const auto seen = under(scene, {x, 0.5});
                ASSERT_TRUE(seen.has_value());
                EXPECT_NEAR(seen->value, dense ? 1.0 : 0.25, 1e-4) << (mode == AlphaMode::mask ? "mask" : "blend") << x;
            }
        }
}

// A wire, a pole and a trunk before a wall and before the sky; sigma is 2 px here, half of the cone's weight 2.5 px.
TEST_F(GazeProbeGLTest, AThinThingIsLookedPastUntilItFillsHalfOfTheCone) {
    const View head = testView();
    for (const bool sky : {true, false})
        for (const double width : {0.4, 1.0, 4.5, 9.0}) {
            SceneBuilder b;
            if (!sky) b.wall(5.0, b.unlit(glm::vec3(0.5f)));
            b.quad(head, {96.0 - 0.5 * width, 0.0, 96.0 + 0.5 * width, 144.0}, 0.5, b.unlit(glm::vec3(1.0f)));
            const auto seen = under(GpuScene(b.scene()), {0.5, 0.5});
            ASSERT_TRUE(seen.has_value());
            EXPECT_NEAR(seen->value, width > 4.0 ? 2.0 : sky ? 0.0 : 0.2, 1e-3) << width << " px";
        }
}

TEST_F(GazeProbeGLTest, OutsideThePictureIsNothing) {
    SceneBuilder b;
    b.wall(1.0, b.unlit(glm::vec3(1.0f)));
    const GpuScene scene(b.scene());
    for (const glm::dvec2 gaze : {glm::dvec2(-0.6, 0.5), {1.6, 0.5}, {0.5, -0.5}, {0.5, 1.5}, {std::nan(""), 0.5}})
        EXPECT_FALSE(under(scene, gaze).has_value()) << gaze.x << ", " << gaze.y;
}

TEST_F(GazeProbeGLTest, TheScaleOfTheSceneAndTheNearPlaneDoNotMatter) {
    for (const double scale : {1e-3, 1e6}) {
        SceneBuilder b;
        b.wall(3.0 * scale, b.unlit(glm::vec3(1.0f)));
        const auto seen =
            under(GpuScene(b.scene()), {0.5, 0.5}, Metres(0.063 * scale), testView(192, 144, 0.05 * scale));
        ASSERT_TRUE(seen.has_value());
        EXPECT_NEAR(seen->value * 3.0 * scale, 1.0, 1e-4) << "scale " << scale;
    }
}

}  // namespace
}  // namespace dioptre
