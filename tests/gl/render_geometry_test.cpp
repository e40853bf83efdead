// The pinhole picture is where projection says, facing the right way, the nearest in front.
#include <string>

#include "gl_fixture.hpp"
#include "pictures.hpp"

namespace dioptre {
namespace {

using namespace test;

class GeometryGLTest : public GlTest {
  protected:
    static Image pinhole(const SceneBuilder& b, const Shot& shot = {}) {
        return draw(TechniqueChoice::pinhole, GpuScene(b.scene()), shot);
    }
};

const glm::dvec3 kRed(1.0, 0.0, 0.0), kGreen(0.0, 1.0, 0.0), kBlue(0.0, 0.0, 1.0), kNothing(0.0);

TEST_F(GeometryGLTest, QuadsFillThePixelsThatProjectionSays) {
    struct Case {
        PixelRect r;
        double distance;
    };
    // Pixel centres inside are drawn, all others are not: in each quadrant, over the border, near and far.
    for (const Case& c : {Case{{10.3, 20.7, 31.2, 45.6}, 1.0}, Case{{100.9, 5.1, 180.4, 60.2}, 0.06},
                          Case{{-40.0, 100.4, 20.6, 200.0}, 30.0}, Case{{150.2, 90.8, 151.4, 92.3}, 1000.0}}) {
        View views[2] = {testView(), testView()};
        views[1].pose = {{3.0, -2.0, 5.0}, glm::angleAxis(2.1, glm::normalize(glm::dvec3(0.3, 1.0, -0.4)))};
        views[1].frustum = {-0.2, 0.6, -0.35, 0.25};  // off-axis
        for (const View& view : views) {
            SceneBuilder b;
            b.quad(view, c.r, c.distance, b.unlit(glm::vec3(kRed)));
            Shot shot;
            shot.view = view;
            const Image picture = pinhole(b, shot);
            int wrong = 0;
            for (int y = 0; y < picture.height; ++y)
                for (int x = 0; x < picture.width; ++x)
                    wrong += pixelAt(picture, x, y) != (c.r.distance(x, y) == 0.0 ? kRed : kNothing);
            EXPECT_EQ(wrong, 0) << "quad from pixel (" << c.r.x0 << ", " << c.r.y0 << ") to (" << c.r.x1 << ", "
                                << c.r.y1 << ") at " << c.distance << " m";
        }
    }
}

TEST_F(GeometryGLTest, MultisamplingKeepsMeansAndTheNearestDepth) {
    SceneBuilder b;
    b.wall(4.0, b.unlit(glm::vec3(0.0f)));
    b.quad(testView(), {40.5, 30.5, 80.5, 60.5}, 1.0, b.unlit(glm::vec3(1.0f)));
    Shot shot;
    shot.msaa = 4;
    const GpuScene scene(b.scene());
    const Image picture = draw(TechniqueChoice::pinhole, scene, shot);
    EXPECT_EQ(picture.at(60, 45), 1.0f);
    EXPECT_EQ(picture.at(39, 45), 0.0f);
    EXPECT_NEAR(static_cast<double>(picture.at(40, 45)), 0.5, 0.26);  // 4 samples: 1 to 3 of them
    EXPECT_GT(picture.at(40, 45), 0.0f);
    EXPECT_LT(picture.at(40, 45), 1.0f);
    // Vergence of the edge pixel is the square's, 1 D, shown as 1/(1 + 1); the wall's is a quarter of a dioptre.
    shot.show.stage = ShowChoice::vergence;
    const Image depth = draw(TechniqueChoice::pinhole, scene, shot);
    EXPECT_NEAR(static_cast<double>(depth.at(40, 45)), 0.5, 0.001);
    EXPECT_NEAR(static_cast<double>(depth.at(39, 45)), 0.2, 0.001);
}

TEST_F(GeometryGLTest, TexturesStandUpright) {
    // Row 0 of the image on top, u to the right: red, green / blue, white.
    TextureImage image{"corners", 2, 2, {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 255}};
    Sampler nearest;
    nearest.magnification = nearest.minification = Filter::nearest;
    SceneBuilder b;
    b.quad(testView(), {40.0, 40.0, 80.0, 80.0}, 1.0, b.textured(image, nearest));
    const Image picture = pinhole(b);
    EXPECT_EQ(pixelAt(picture, 50, 50), kRed);
    EXPECT_EQ(pixelAt(picture, 70, 50), kGreen);
    EXPECT_EQ(pixelAt(picture, 50, 70), kBlue);
    EXPECT_EQ(pixelAt(picture, 70, 70), glm::dvec3(1.0));
}

TEST_F(GeometryGLTest, ColourTexturesAreDecodedFromSrgb) {
    SceneBuilder b;
    b.wall(1.0, b.textured({"grey", 1, 1, {188, 128, 10, 255}}));
    const glm::dvec3 seen = pixelAt(pinhole(b), 90, 70);
    const int bytes[] = {188, 128, 10};
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], linearFromSrgb(bytes[c] / 255.0), 0.002) << "channel " << c;
}

Material unlitMaterial(glm::vec4 color, bool doubleSided) {
    Material m;
    m.unlit = true;
    m.baseColor = color;
    m.doubleSided = doubleSided;
    return m;
}

/// From the back: mirrored left for right.
const std::array<glm::dvec3, 4> kFront{glm::dvec3(-0.1, -0.1, -1.0), glm::dvec3(0.1, -0.1, -1.0),
                                       glm::dvec3(0.1, 0.1, -1.0), glm::dvec3(-0.1, 0.1, -1.0)};
const std::array<glm::dvec3, 4> kBack{kFront[1], kFront[0], kFront[3], kFront[2]};

TEST_F(GeometryGLTest, BacksAreCulledUnlessDoubleSided) {
    for (const bool front : {true, false})
        for (const bool doubleSided : {true, false})
            for (const bool mirrored : {true, false}) {
                SceneBuilder b;
                b.quad(front ? kFront : kBack, b.material(unlitMaterial(glm::vec4(1.0f), doubleSided)));
                // A mirrored instance shows the same side of a thing: its winding turns twice.
                if (mirrored) b.placed(glm::scale(glm::dmat4(1.0), glm::dvec3(-1.0, 1.0, 1.0)));
                const bool seen = pixelAt(pinhole(b), 96, 72) == glm::dvec3(1.0);
                EXPECT_EQ(seen, front || doubleSided)
                    << (front ? "front" : "back") << (doubleSided ? ", double sided" : "")
                    << (mirrored ? ", mirrored" : "");
            }
}

TEST_F(GeometryGLTest, InstancesArePlacedByTheirMatrix) {
    SceneBuilder b;
    b.quad({0.0, 0.0, 0.0}, {0.2, 0.2}, b.unlit(glm::vec3(kGreen)));
    glm::dmat4 m = glm::translate(glm::dmat4(1.0), {0.2, 0.1, -1.5});
    m = glm::scale(glm::rotate(m, 0.5 * std::numbers::pi, {0.0, 0.0, 1.0}), {2.0, -0.5, 1.0});
    b.placed(m);
    const Image picture = pinhole(b);
    // Half extents 0.05 (x) and 0.2 (y) metres at 1.5 m, about (0.2, 0.1).
    const double f = focalLengthPixels(testView()).x / 1.5;
    const PixelRect r{96.0 + f * 0.15, 72.0 - f * 0.3, 96.0 + f * 0.25, 72.0 + f * 0.1};
    int wrong = 0;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x)
            wrong += pixelAt(picture, x, y) != (r.distance(x, y) == 0.0 ? kGreen : kNothing);
    EXPECT_EQ(wrong, 0);
}

TEST_F(GeometryGLTest, MaskedTexelsAreNotThere) {
    for (const float cutoff : {0.3f, 0.7f}) {
        SceneBuilder b;
        b.wall(2.0, b.unlit(glm::vec3(kBlue)));
        // Alpha 128/255, 255/255 by squares, times 1.
        const int image = b.textured(checkerImage(2, {255, 0, 0, 128}, {255, 0, 0, 255}, 1),
                                     {Wrap::clampToEdge, Wrap::clampToEdge, Filter::nearest, Filter::nearest});
        Material m = b.scene().materials[static_cast<std::size_t>(image)];
        m.alphaMode = AlphaMode::mask;
        m.alphaCutoff = cutoff;
        b.quad(testView(), {40.0, 40.0, 80.0, 80.0}, 1.0, b.material(m));
        const GpuScene scene(b.scene());
        const Image picture = draw(TechniqueChoice::pinhole, scene, {});
        EXPECT_EQ(pixelAt(picture, 50, 50), cutoff < 0.5f ? kRed : kBlue) << "cut-off " << cutoff;
        EXPECT_EQ(pixelAt(picture, 70, 50), kRed) << "cut-off " << cutoff;
        // Its depth is not there either.
        Shot shot;
        shot.show.stage = ShowChoice::vergence;
        const Image depth = draw(TechniqueChoice::pinhole, scene, shot);
        EXPECT_NEAR(static_cast<double>(depth.at(50, 50)), cutoff < 0.5f ? 0.5 : 1.0 / 3.0, 0.001)
            << "cut-off " << cutoff;
    }
}

TEST_F(GeometryGLTest, TheNearestIsInFrontInAnyOrder) {
    // A millimetre apart at 2 m, and 10 m apart at a kilometre: float depth, reversed, tells them from each other.
    for (const double distance : {2.0, 1000.0})
        for (const bool nearFirst : {true, false}) {
            SceneBuilder b;
            const int red = b.unlit(glm::vec3(kRed)), green = b.unlit(glm::vec3(kGreen));
            const double behind = distance * (distance > 100.0 ? 1.01 : 1.0005);
            const PixelRect whole{-9.0, -9.0, 201.0, 153.0};
            if (nearFirst) b.quad(testView(), whole, distance, red).quad(testView(), whole, behind, green);
            if (!nearFirst) b.quad(testView(), whole, behind, green).quad(testView(), whole, distance, red);
            const Worst worst = worstDifference(pinhole(b), constantImage(192, 144, glm::vec3(kRed)));
            EXPECT_EQ(worst.linear, 0.0) << distance << " m, " << worst;
        }
}

TEST_F(GeometryGLTest, WhatIsBeforeTheNearPlaneIsNotDrawn) {
    SceneBuilder b;
    b.quad({0.0, 0.0, -0.04}, {0.1, 0.1}, b.unlit(glm::vec3(kRed)));
    b.quad({0.0, 0.0, 1.0}, {9.0, 9.0}, b.unlit(glm::vec3(kGreen)));
    EXPECT_EQ(worstDifference(pinhole(b), constantImage(192, 144, glm::vec3(0.0f))).linear, 0.0);
}

TEST_F(GeometryGLTest, RadianceBeyondWhiteIsKeptAndExposureScalesIt) {
    SceneBuilder b;
    b.wall(1.0, b.unlit({12.0f, 0.25f, 4000.0f}));
    for (const float exposure : {1.0f, 0.125f, 4.0f}) {
        Shot shot;
        shot.exposure = exposure;
        const glm::dvec3 seen = pixelAt(pinhole(b, shot), 90, 70), wanted(12.0, 0.25, 4000.0);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(seen[c] / (wanted[c] * static_cast<double>(exposure)), 1.0, 1.0 / 1024.0) << "channel " << c;
    }
}

TEST_F(GeometryGLTest, ShapeOfASphere) {
    SceneBuilder b;
    b.sphere({0.1, -0.05, -1.0}, 0.15, b.unlit(glm::vec3(kGreen)));
    const Image picture = pinhole(b);
    const double expected = std::numbers::pi * std::pow(0.15 * focalLengthPixels(testView()).x, 2.0);
    double area = 0.0;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) area += pixelAt(picture, x, y).y;
    // 32 sides take 2 %, nearness and the slant add as much.
    EXPECT_NEAR(area / expected, 1.0, 0.05);
}

}  // namespace
}  // namespace dioptre
