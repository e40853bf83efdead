// Lit materials: the numbers that glTF 2.0's appendix B and the sky of brdf.glsl give for plain cases.
#include <string>

#include "gl_fixture.hpp"
#include "pictures.hpp"
#include "scene/vertex_frame.hpp"

namespace dioptre {
namespace {

using namespace test;

class LightingGLTest : public GlTest {
  protected:
    /// The colour at the middle of a wall with that material under the lights.
    static glm::dvec3 seen(const Material& material, const std::vector<Light>& lights) {
        SceneBuilder b;
        b.wall(1.0, b.material(material));
        for (const Light& light : lights) b.light(light);
        return pixelAt(draw(TechniqueChoice::pinhole, GpuScene(b.scene()), {}), 96, 72);
    }
};

Light facing(float lux) {
    Light light;
    light.kind = LightKind::directional;
    light.color = glm::vec3(lux);
    return light;  // travels along -z, straight onto a wall before the viewer
}

/// A white matte dielectric: 4 % specular at normal incidence.
Material matte(float albedo = 1.0f) {
    Material m;
    m.baseColor = glm::vec4(glm::vec3(albedo), 1.0f);
    m.metallic = 0.0f;
    m.roughness = 1.0f;
    return m;
}

// The sky that stands in beside lights: its radiance at the horizon, by brdf.glsl and gpu_scene.cpp.
const glm::dvec3 kSky = 0.15 * 0.5 * (glm::dvec3(0.34, 0.31, 0.28) + glm::dvec3(0.92, 0.98, 1.06));

TEST_F(LightingGLTest, WhiteMatteUnderOneLux) {
    const glm::dvec3 dark = seen(matte(), {facing(0.0f)}), lit = seen(matte(), {facing(1.0f)});
    for (int c = 0; c < 3; ++c) {
        // albedo/pi, of which 4 % is specular; that gives back D V F = 0.04/(4 pi) straight on.
        EXPECT_NEAR(lit[c] - dark[c], 0.96 / std::numbers::pi + 0.04 / (4.0 * std::numbers::pi), 0.001)
            << "channel " << c;
        EXPECT_NEAR(lit[c] - dark[c], 1.0 / std::numbers::pi, 0.05 / std::numbers::pi) << "channel " << c;
        EXPECT_NEAR(dark[c] / kSky[c], 1.0, 0.03) << "channel " << c;
    }
}

TEST_F(LightingGLTest, LightAddsUpAndScales) {
    const glm::dvec3 dark = seen(matte(), {facing(0.0f)}), one = seen(matte(), {facing(1.0f)}) - dark;
    const glm::dvec3 three = seen(matte(), {facing(1.0f), facing(2.0f)}) - dark;
    EXPECT_NEAR(three.x / one.x, 3.0, 0.01);
    const glm::dvec3 grey = seen(matte(0.5f), {facing(1.0f)}) - seen(matte(0.5f), {facing(0.0f)});
    EXPECT_NEAR(grey.x / one.x, 0.5, 0.01);  // the specular part stays: a little above
}

TEST_F(LightingGLTest, ObliqueLightFallsByTheCosine) {
    const glm::dvec3 dark = seen(matte(), {facing(0.0f)});
    Light oblique = facing(1.0f);
    oblique.direction = glm::vec3(std::sin(1.0472f), 0.0f, -std::cos(1.0472f));  // 60 degrees
    const double ratio = (seen(matte(), {oblique}) - dark).x / (seen(matte(), {facing(1.0f)}) - dark).x;
    EXPECT_NEAR(ratio, 0.5, 0.02);
    Light fromBehind = facing(1.0f);
    fromBehind.direction = glm::vec3(0.0f, 0.0f, 1.0f);
    EXPECT_NEAR((seen(matte(), {fromBehind}) - dark).x, 0.0, 1e-4);
}

TEST_F(LightingGLTest, PointAndSpotLights) {
    const glm::dvec3 dark = seen(matte(), {facing(0.0f)});
    const double lux = (seen(matte(), {facing(1.0f)}) - dark).x;
    Light point;
    point.kind = LightKind::point;
    point.position = glm::vec3(0.0f, 0.0f, 1.0f);  // 2 m before the wall
    point.color = glm::vec3(8.0f);                 // candela
    EXPECT_NEAR((seen(matte(), {point}) - dark).x / lux, 2.0, 0.02);
    point.range = 1.9f;
    EXPECT_NEAR((seen(matte(), {point}) - dark).x / lux, 0.0, 0.001);
    Light spot = point;
    spot.kind = LightKind::spot;
    spot.range = 0.0f;
    spot.innerConeCos = std::cos(0.1f);
    spot.outerConeCos = std::cos(0.2f);
    EXPECT_NEAR((seen(matte(), {spot}) - dark).x / lux, 2.0, 0.02);
    spot.direction = glm::vec3(std::sin(0.25f), 0.0f, -std::cos(0.25f));  // its cone passes by
    EXPECT_NEAR((seen(matte(), {spot}) - dark).x / lux, 0.0, 0.001);
}

/// How much of a light of 1 lux from (x, y, 1) a wall gives back whose normal map has one texel, relative to what a
/// plain wall gives back of one straight on. `computed` tangents are the loader's for files that bring none.
double mapped(float x, float y, const Texel& texel, bool computed) {
    double got[2] = {};
    for (const bool on : {false, true}) {
        SceneBuilder b;
        b.textured({"normals", 1, 1, {texel.begin(), texel.end()}});
        Material m = matte();
        m.normalTexture.image = 0;
        b.wall(1.0, b.material(m));
        Light light = facing(on ? 1.0f : 0.0f);
        light.direction = -glm::normalize(glm::vec3(x, y, 1.0f));
        Scene scene = b.light(light).scene();
        if (computed) computeTangents(scene.meshes[0].primitives[0]);
        got[on ? 1 : 0] = pixelAt(draw(TechniqueChoice::pinhole, GpuScene(scene), {}), 96, 72).x;
    }
    return (got[1] - got[0]) / (0.96 / std::numbers::pi + 0.04 / (4.0 * std::numbers::pi));
}

// Texels hold 0.5 + 0.5 n. glTF 2.0, 3.9.3: +x is right and +y is UP, though v runs down the image; so do Khronos's
// sample viewer (bitangent = cross(n, t) where a file brings no tangents) and three.js (MikkTSpace's sign negated).
TEST_F(LightingGLTest, NormalMapsTurnTheShading) {
    const Texel right{218, 128, 218, 255}, up{128, 218, 218, 255}, flat{128, 128, 255, 255};
    for (const bool computed : {false, true}) {
        SCOPED_TRACE(computed ? "tangents by computeTangents()" : "tangents as a glTF file brings them, w = 1");
        EXPECT_NEAR(mapped(1.0f, 0.0f, right, computed), 1.0, 0.03);
        EXPECT_NEAR(mapped(-1.0f, 0.0f, right, computed), 0.0, 0.03);
        EXPECT_NEAR(mapped(0.0f, 1.0f, up, computed), 1.0, 0.03);
        EXPECT_NEAR(mapped(0.0f, -1.0f, up, computed), 0.0, 0.03);
        EXPECT_NEAR(mapped(1.0f, 0.0f, flat, computed), std::cos(std::numbers::pi / 4.0), 0.03);
    }
}

TEST_F(LightingGLTest, BacksOfDoubleSidedThingsAreLitFromTheirOwnSide) {
    SceneBuilder b;
    Material m = matte();
    m.doubleSided = true;
    const double z = -1.0;
    b.quad({glm::dvec3(4.0, -4.0, z), glm::dvec3(-4.0, -4.0, z), glm::dvec3(-4.0, 4.0, z), glm::dvec3(4.0, 4.0, z)},
           b.material(m));
    b.light(facing(1.0f));
    const glm::dvec3 back = pixelAt(draw(TechniqueChoice::pinhole, GpuScene(b.scene()), {}), 96, 72);
    EXPECT_NEAR(back.x, seen(matte(), {facing(1.0f)}).x, 0.002);
}

TEST_F(LightingGLTest, MirroredThingsAreLitAsTheyLook) {
    SceneBuilder b;
    b.wall(1.0, b.material(matte()));
    b.placed(glm::scale(glm::dmat4(1.0), glm::dvec3(-1.0, 1.0, 1.0)));
    b.light(facing(1.0f));
    const glm::dvec3 mirrored = pixelAt(draw(TechniqueChoice::pinhole, GpuScene(b.scene()), {}), 96, 72);
    EXPECT_NEAR(mirrored.x, seen(matte(), {facing(1.0f)}).x, 0.002);
}

TEST_F(LightingGLTest, EmissionAdds) {
    Material glowing = matte();
    const glm::dvec3 without = seen(glowing, {facing(1.0f)});
    glowing.emissive = glm::vec3(5.0f, 0.25f, 20.0f);  // strength folded in, beyond white
    const glm::dvec3 added = seen(glowing, {facing(1.0f)}) - without;
    EXPECT_NEAR(added.x, 5.0, 0.01);
    EXPECT_NEAR(added.y, 0.25, 0.001);
    EXPECT_NEAR(added.z, 20.0, 0.02);
}

TEST_F(LightingGLTest, NoMaterialReflectsMuchMoreThanItGets) {
    // Under the sky alone (a scene without lights gets a key light too: so a light of 0 lux).
    for (const float metallic : {0.0f, 0.5f, 1.0f})
        for (const float roughness : {0.0f, 0.3f, 0.6f, 1.0f}) {
            Material m = matte();
            m.metallic = metallic;
            m.roughness = roughness;
            const glm::dvec3 sky = seen(m, {facing(0.0f)});
            for (int c = 0; c < 3; ++c)
                EXPECT_LE(sky[c], 1.08 * kSky[c])
                    << "metallic " << metallic << ", roughness " << roughness << ", channel " << c;
            EXPECT_GT(sky.x, 0.4 * kSky.x) << "metallic " << metallic << ", roughness " << roughness;
        }
}

TEST_F(LightingGLTest, AMetalMirrorsTheLightInItsColour) {
    Material gold = matte();
    gold.metallic = 1.0f;
    gold.roughness = 0.5f;
    gold.baseColor = glm::vec4(1.0f, 0.7f, 0.3f, 1.0f);
    const glm::dvec3 lit = seen(gold, {facing(1.0f)}) - seen(gold, {facing(0.0f)});
    EXPECT_NEAR(lit.y / lit.x, 0.7, 0.01);
    EXPECT_NEAR(lit.z / lit.x, 0.3, 0.01);
    // D V at nh = nl = nv = 1: 1/(pi a²)/4, a = 0.25.
    EXPECT_NEAR(lit.x, 1.0 / (4.0 * std::numbers::pi * 0.0625), 0.01);
}

}  // namespace
}  // namespace dioptre
