// Alpha blending: what is seen through what, in which order, sharp and blurred, in each technique.
#include <string>

#include "gl_fixture.hpp"
#include "pictures.hpp"

namespace dioptre {
namespace {

using namespace test;

class BlendGLTest : public GlTest {
  protected:
    static Image pinhole(const SceneBuilder& b, const Shot& shot = {}) {
        return draw(TechniqueChoice::pinhole, GpuScene(b.scene()), shot);
    }
    static Image reference(const GpuScene& scene, const Shot& shot, int samples) {
        PassLog log;
        EyeFrame frame{scene, shot.view, shot.lens, shot.exposure, 0, {}, log};
        frame.samples = samples;
        return readPicture(makeTechnique(TechniqueChoice::reference)->draw(frame));
    }
};

const PixelRect kPane{40.0, 30.0, 150.0, 110.0};
const glm::vec3 kRed(1, 0, 0), kGreen(0, 1, 0), kBlue(0, 0, 1);

Material glass(glm::vec3 color, float alpha) {
    Material m;
    m.unlit = true;
    m.doubleSided = true;
    m.baseColor = glm::vec4(color, alpha);
    m.alphaMode = AlphaMode::blend;
    return m;
}

void expectColor(const glm::dvec3& seen, const glm::dvec3& wanted, std::string_view what, double tolerance = 0.002) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], wanted[c], tolerance) << what << ", channel " << c;
}

// Red at 1 m over green at 2 m over a blue wall at 4 m, whatever their order in the scene.
TEST_F(BlendGLTest, TheFarthestIsDrawnFirst) {
    for (const bool redFirst : {true, false})
        for (const int msaa : {0, 4}) {
            SceneBuilder b;
            const int red = b.material(glass(kRed, 0.25f)), green = b.material(glass(kGreen, 0.5f));
            if (redFirst) b.quad(testView(), kPane, 1.0, red);
            b.quad(testView(), kPane, 2.0, green);
            if (!redFirst) b.quad(testView(), kPane, 1.0, red);
            b.wall(4.0, b.unlit(kBlue));
            Shot shot;
            shot.msaa = msaa;
            const std::string what = (redFirst ? "red first" : "green first") + std::string(msaa ? ", msaa" : "");
            expectColor(pixelAt(pinhole(b, shot), 90, 70), {0.25, 0.375, 0.375}, what);
            // From the other side of the panes the order is the other.
            shot.view.pose = {{0.0, 0.0, -3.0}, glm::angleAxis(std::numbers::pi, glm::dvec3(0, 1, 0))};
            expectColor(pixelAt(pinhole(b, shot), 96, 72), {0.125, 0.5, 0.0}, what + ", from behind");
        }
}

TEST_F(BlendGLTest, WhatIsOpaqueInFrontHidesIt) {
    SceneBuilder b;
    b.quad(testView(), kPane, 2.0, b.material(glass(kRed, 0.5f)));
    b.quad(testView(), {90.0, 30.0, 150.0, 110.0}, 1.0, b.unlit(kGreen));
    b.wall(4.0, b.unlit(kBlue));
    const Image picture = pinhole(b);
    expectColor(pixelAt(picture, 60, 70), {0.5, 0.0, 0.5}, "through the pane");
    expectColor(pixelAt(picture, 120, 70), {0.0, 1.0, 0.0}, "before the pane");
    expectColor(pixelAt(picture, 20, 70), {0.0, 0.0, 1.0}, "beside it");
}

TEST_F(BlendGLTest, ExposureAndLightGoThrough) {
    SceneBuilder b;
    b.quad(testView(), kPane, 1.0, b.material(glass(glm::vec3(20.0f), 0.75f)));
    b.wall(4.0, b.unlit(glm::vec3(1e6f)));
    Shot shot;
    shot.exposure = 0.01f;
    // Radiance × exposure ends at 65504 for each surface.
    expectColor(pixelAt(pinhole(b, shot), 90, 70), glm::dvec3(0.75 * 0.2 + 0.25 * 1e4), "", 4.0);
}

// Of a double-sided thing the back comes first, of a single-sided one not at all.
TEST_F(BlendGLTest, BacksOfDoubleSidedThingsAreSeenThroughTheirFronts) {
    for (const bool doubleSided : {true, false}) {
        Material m = glass(glm::vec3(1), 0.5f);
        m.doubleSided = doubleSided;
        SceneBuilder b;
        // Each face in a colour of its own: a box of six quads in one primitive, red at the back, green in front.
        b.box({-0.5, -0.5, -2.0}, {0.5, 0.5, -1.0}, b.material(m));
        Scene scene = b.scene();
        Primitive all;
        all.material = scene.meshes[0].primitives[0].material;
        for (const bool front : {true, false})  // the order that needs help
            for (const Mesh& mesh : scene.meshes) {
                const Primitive& p = mesh.primitives[0];
                const bool inFront = p.bounds.min.z == -1.0f, behind = p.bounds.max.z == -2.0f;
                if (front ? !inFront : !behind) continue;
                for (const std::uint32_t i : p.indices)
                    all.indices.push_back(i + static_cast<std::uint32_t>(all.vertices.size()));
                for (const Vertex& v : p.vertices) {
                    all.vertices.push_back(v);
                    all.bounds.add(v.position);
                    all.extras.push_back(
                        {{}, inFront ? glm::u16vec4(0, 0xFFFF, 0, 0xFFFF) : glm::u16vec4(0xFFFF, 0, 0, 0xFFFF)});
                }
            }
        scene.meshes = {{"", {all}}};
        scene.instances = {{"", 0, glm::mat4(1.0f)}};
        const Image picture = draw(TechniqueChoice::pinhole, GpuScene(scene), {});
        expectColor(pixelAt(picture, 96, 72), {doubleSided ? 0.25 : 0.0, 0.5, 0.0},
                    doubleSided ? "double-sided" : "single-sided");
    }
}

// Blended material without a transparent texel is an opaque one, in each technique, however its triangles are ordered.
TEST_F(BlendGLTest, OpaqueTexelsHideEachOther) {
    Scene scenes[2];
    for (const bool blend : {false, true}) {
        SceneBuilder b;
        Material m;
        m.alphaMode = blend ? AlphaMode::blend : AlphaMode::opaque;
        m.baseColor = glm::vec4(0.8f, 0.4f, 0.2f, 1.0f);
        b.sphere({-0.2, 0.0, -1.5}, 0.3, b.material(m));
        b.sphere({0.2, 0.1, -2.5}, 0.5, b.material(m));
        b.wall(5.0, b.unlit(glm::vec3(0.3f)));
        scenes[blend ? 1 : 0] = b.scene();
    }
    const GpuScene opaque(scenes[0]), blended(scenes[1]);
    Shot shot;
    shot.lens = lensFor(shot.view, 5.0, 0.5, 0.2);
    for (const TechniqueChoice choice : kTechniques) {
        const Worst worst = worstDifference(draw(choice, blended, shot), draw(choice, opaque, shot));
        EXPECT_EQ(worst.linear, 0.0) << techniqueName(choice) << " " << worst;
    }
}

// The depth of a pixel is that of what gives it most of its light.
TEST_F(BlendGLTest, DepthIsThatOfTheGreaterShare) {
    for (const float alpha : {0.3f, 0.7f}) {
        SceneBuilder b;
        b.quad(testView(), kPane, 1.0, b.material(glass(kRed, alpha)));
        b.wall(4.0, b.unlit(kBlue));
        Shot shot;
        shot.show.stage = ShowChoice::vergence;
        // D/(1 + D)
        EXPECT_NEAR(pinhole(b, shot).at(90, 70), alpha < 0.5f ? 0.2 : 0.5, 0.001) << alpha;
        shot.show = {};
        expectColor(pixelAt(pinhole(b, shot), 90, 70), {alpha, 0.0, 1.0 - alpha}, "its colour");
    }
}

/// Panes before, in and behind focus with stripes behind them.
Scene panes(float alpha) {
    SceneBuilder b;
    b.wall(4.0, b.textured(checkerImage(64)));
    b.quad(testView(), {20.0, 20.0, 80.0, 124.0}, 0.5, b.material(glass(kRed, alpha)));
    b.quad(testView(), {60.0, 40.0, 130.0, 90.0}, 1.0, b.material(glass(kGreen, alpha)));
    b.quad(testView(), {110.0, 10.0, 170.0, 134.0}, 2.0, b.material(glass(kBlue, alpha)));
    return b.scene();
}

// Blended at each point of the lens: the same as a camera that moves over it.
TEST_F(BlendGLTest, TheReferenceBlendsAtEveryPointOfTheLens) {
    Shot shot;
    shot.lens = lensFor(shot.view, 6.0, 1.0, 2.0);
    const GpuScene scene(panes(0.4f));
    const Worst worst = worstDifference(reference(scene, shot, 64), accumulated(scene, shot, 64));
    // Textures are read finer by the reference; edges may fall to the other side of a pixel's centre.
    EXPECT_LT(worst.mean, 0.004) << worst;
    const Worst opaque = worstDifference(reference(GpuScene(panes(1.0f)), shot, 64), accumulated(scene, shot, 64));
    EXPECT_GT(opaque.mean, 0.05) << "panes of alpha 1 look the same";
}

// mipmap: a pane of half the light or more keeps its own blur, edges and all; a fainter one takes that of what is behind.
TEST_F(BlendGLTest, MipmapBlursAPixelAsItsGreaterShare) {
    Shot shot;
    shot.lens = lensFor(shot.view, 8.0, 1.0, 0.25);  // focused at 1 m: the wall behind is blurred
    for (const float alpha : {0.3f, 0.7f}) {
        SceneBuilder b;
        b.wall(4.0, b.unlit(glm::vec3(0.0f)));
        b.quad(testView(), kPane, 1.0, b.material(glass(glm::vec3(1), alpha)));
        const Image picture = draw(TechniqueChoice::mipmap, GpuScene(b.scene()), shot);
        const double inside = static_cast<double>(picture.at(42, 70)),
                     outside = static_cast<double>(picture.at(37, 70));
        EXPECT_NEAR(static_cast<double>(picture.at(95, 70)), static_cast<double>(alpha), 0.01) << alpha;
        if (alpha > 0.5f) {
            EXPECT_NEAR(inside, static_cast<double>(alpha), 0.01) << "in focus, as sharp as an opaque one";
            EXPECT_NEAR(outside, 0.0, 0.01);
        } else {
            EXPECT_LT(inside, 0.9 * static_cast<double>(alpha)) << "blurred with the wall";
            EXPECT_GT(outside, 0.05 * static_cast<double>(alpha));
        }
    }
}

// Where nothing has an edge, blur changes nothing: the same colour through panes near and far in every technique.
TEST_F(BlendGLTest, EvenColoursStayEven) {
    SceneBuilder b;
    b.wall(4.0, b.unlit(kBlue));
    b.wall(2.0, b.material(glass(kGreen, 0.6f)));
    b.wall(0.5, b.material(glass(kRed, 0.3f)));
    const GpuScene scene(b.scene());
    Shot shot;
    shot.lens = lensFor(shot.view, 7.0, 1.0, 2.0);
    const glm::dvec3 wanted(0.3, 0.7 * 0.6, 0.7 * 0.4);
    for (const TechniqueChoice choice : kTechniques)
        expectColor(pixelAt(draw(choice, scene, shot), 96, 72), wanted, techniqueName(choice), 0.004);
}

// A scene without blending pays nothing for it.
TEST_F(BlendGLTest, OnlyBlendedSurfacesAreDrawnAgain) {
    SceneBuilder plain;
    plain.wall(4.0, plain.unlit(kBlue));
    const GpuScene opaque(plain.scene());
    draw(TechniqueChoice::pinhole, opaque, {});
    EXPECT_EQ(opaque.trianglesDrawn(), 2u);
    plain.quad(testView(), kPane, 1.0, plain.material(glass(kRed, 0.5f)));
    const GpuScene blended(plain.scene());
    draw(TechniqueChoice::pinhole, blended, {});
    EXPECT_EQ(blended.trianglesDrawn(), 2u + 4u * 2u);  // its opaque texels, back, front, depth
}

}  // namespace
}  // namespace dioptre
