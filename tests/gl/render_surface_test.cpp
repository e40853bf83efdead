// What a glTF surface can be beside opaque triangles with one set of texture coordinates: points and lines, vertex
// colours, textures read through a transform or a second set, occlusion.
#include <string>

#include "gl_fixture.hpp"
#include "pictures.hpp"

namespace dioptre {
namespace {

using namespace test;

class SurfaceGLTest : public GlTest {
  protected:
    static Image pinhole(const Scene& scene, const Shot& shot = {}) {
        return draw(TechniqueChoice::pinhole, GpuScene(scene), shot);
    }
};

double sumOf(const Image& image, int channel) {
    double sum = 0.0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) sum += static_cast<double>(image.at(x, y, channel));
    return sum;
}

Material unlitMaterial(glm::vec3 color) {
    Material m;
    m.unlit = true;
    m.baseColor = glm::vec4(color, 1.0f);
    return m;
}

/// Points or lines through those pixels of the default view, 1 m away.
Scene strokes(Topology topology, const std::vector<glm::dvec2>& pixels, const Material& material) {
    Scene scene;
    scene.materials.push_back(material);
    Primitive p;
    p.topology = topology;
    p.lit = false;
    for (const glm::dvec2& pixel : pixels) {
        Vertex vertex;
        vertex.position = glm::vec3(worldAt(testView(), pixel, 1.0));
        p.indices.push_back(static_cast<std::uint32_t>(p.vertices.size()));
        p.vertices.push_back(vertex);
        p.bounds.add(vertex.position);
    }
    scene.meshes.push_back({"", {p}});
    scene.instances.push_back({"", 0, glm::mat4(1.0f)});
    return scene;
}

TEST_F(SurfaceGLTest, PointsAreOnePixelEach) {
    const Scene scene =
        strokes(Topology::points, {{10.5, 20.5}, {100.3, 70.6}, {180.5, 3.5}}, unlitMaterial({1, 2, 3}));
    const Image picture = pinhole(scene);
    for (const glm::ivec2 at : {glm::ivec2(10, 20), glm::ivec2(100, 70), glm::ivec2(180, 3)})
        EXPECT_EQ(pixelAt(picture, at.x, at.y), glm::dvec3(1, 2, 3)) << at.x << ", " << at.y;
    EXPECT_DOUBLE_EQ(sumOf(picture, 0), 3.0);
    Shot shot;
    shot.msaa = 4;
    EXPECT_NEAR(sumOf(pinhole(scene, shot), 0), 3.0, 0.8);
}

TEST_F(SurfaceGLTest, LinesAreOnePixelWide) {
    const Scene scene = strokes(Topology::lines, {{20.5, 30.5}, {120.5, 30.5}, {50.5, 40.5}, {80.5, 100.5}},
                                unlitMaterial(glm::vec3(1)));
    const Image picture = pinhole(scene);
    for (int x = 22; x < 119; ++x)
        for (const int y : {29, 30, 31}) EXPECT_EQ(picture.at(x, y), y == 30 ? 1.0f : 0.0f) << x << ", " << y;
    for (int y = 42; y < 99; ++y) EXPECT_EQ(meanColor(picture, 40, y, 90, y + 1).x, 1.0 / 50.0) << "row " << y;
}

// Blurred, a line keeps its energy and gets the width of the circle of confusion.
TEST_F(SurfaceGLTest, LinesBlurAsTheyShould) {
    const Scene lines = strokes(Topology::lines, {{20.5, 70.5}, {170.5, 70.5}}, unlitMaterial(glm::vec3(1)));
    Shot shot;
    shot.lens = lensFor(shot.view, 6.0, 0.2, 1.0);
    const GpuScene scene(lines);
    PassLog log;
    EyeFrame frame{scene, shot.view, shot.lens, 1.0f, 0, {}, log};
    frame.samples = 256;
    const Image reference = readPicture(makeTechnique(TechniqueChoice::reference)->draw(frame));
    const glm::dvec3 column = meanColor(reference, 90, 0, 100, reference.height) * double(reference.height);
    EXPECT_NEAR(column.x, 1.0, 0.02);
    for (const int y : {62, 78}) EXPECT_LT(meanColor(reference, 90, y, 100, y + 1).x, 0.002) << "row " << y;
    for (const int y : {66, 70, 74}) EXPECT_GT(meanColor(reference, 90, y, 100, y + 1).x, 0.04) << "row " << y;
    const Image mipmap = draw(TechniqueChoice::mipmap, scene, shot);
    EXPECT_NEAR((meanColor(mipmap, 90, 0, 100, mipmap.height) * double(mipmap.height)).x, 1.0, 0.25);
}

TEST_F(SurfaceGLTest, PointsAndLinesWithoutNormalsGiveBaseColourAndEmission) {
    Material m;
    m.baseColor = glm::vec4(0.25f, 0.5f, 0.0f, 1.0f);
    m.metallic = 0.0f;
    m.emissive = glm::vec3(0.5f, 0.0f, 1.0f);
    for (const Topology topology : {Topology::points, Topology::lines}) {
        Scene scene = strokes(topology, {{60.5, 50.5}, {90.5, 50.5}}, m);
        EXPECT_EQ(pixelAt(pinhole(scene), 60, 50), glm::dvec3(0.75, 0.5, 1.0));
        scene.materials[0].unlit = true;
        EXPECT_EQ(pixelAt(pinhole(scene), 60, 50), glm::dvec3(0.25, 0.5, 0.0));
        // With normals they are lit: one that faces the light is brighter than one that does not.
        scene.materials[0].unlit = false;
        scene.meshes[0].primitives[0].lit = true;
        Light light;
        light.kind = LightKind::directional;
        scene.lights.push_back(light);
        const double facing = pixelAt(pinhole(scene), 60, 50).y;
        for (Vertex& v : scene.meshes[0].primitives[0].vertices) v.normal = glm::vec3(1, 0, 0);
        const double aside = pixelAt(pinhole(scene), 60, 50).y;
        EXPECT_NEAR(facing - aside, 0.5 / std::numbers::pi, 0.02) << "albedo over pi";
    }
}

/// A square of 80 pixels with a material, and what its primitive is to become.
template <class Change>
Scene square(const Material& material, Change change) {
    SceneBuilder b;
    b.quad(testView(), {40.0, 40.0, 120.0, 120.0}, 1.0, b.material(material));
    Scene scene = b.scene();
    change(scene.meshes[0].primitives[0]);
    return scene;
}

TEST_F(SurfaceGLTest, VertexColoursMultiplyTheBaseColour) {
    const Image picture = pinhole(square(unlitMaterial({0.5f, 1.0f, 2.0f}), [](Primitive& p) {
        p.extras.resize(4);  // black at the left, white at the right
        p.extras[0].color = p.extras[3].color = glm::u16vec4(0, 0, 0, 0xFFFF);
    }));
    for (const int x : {42, 80, 118}) {
        const double share = (x + 0.5 - 40.0) / 80.0;
        const glm::dvec3 seen = pixelAt(picture, x, 80);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], share * std::exp2(c - 1), 0.002) << x << ", channel " << c;
    }
    // Opacity counts where the material cuts by it.
    Material masked = unlitMaterial(glm::vec3(1));
    masked.alphaMode = AlphaMode::mask;
    const Image cut = pinhole(square(masked, [](Primitive& p) {
        p.extras.resize(4);
        p.extras[0].color.a = p.extras[3].color.a = 0;
    }));
    EXPECT_EQ(cut.at(78, 80), 0.0f);
    EXPECT_EQ(cut.at(82, 80), 1.0f);
}

TextureImage fourColours() {
    return {"corners", 2, 2, {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 255}};
}

// The same texture, once with transformed coordinates in the vertices, once transformed as it is read.
TEST_F(SurfaceGLTest, TexturesAreReadThroughTheirTransformAndSet) {
    Material m = unlitMaterial(glm::vec3(1));
    m.baseColorTexture.image = 0;
    m.baseColorTexture.sampler.magnification = m.baseColorTexture.sampler.minification = Filter::nearest;
    glm::mat3x2 map(1.0f);
    map[0] = glm::vec2(1.5f, 0.5f);
    map[1] = glm::vec2(-0.5f, 2.0f);
    map[2] = glm::vec2(0.125f, -0.25f);
    const auto draw = [&](const Material& material, auto change) {
        Scene scene = square(material, change);
        scene.images.push_back(fourColours());
        return pinhole(scene);
    };
    const Image baked = draw(m, [&](Primitive& p) {
        for (Vertex& v : p.vertices) v.uv = map * glm::vec3(v.uv, 1.0f);
    });
    m.baseColorTexture.imageFromVertex = map;
    const auto same = [](const Image& a, const Image& b) {
        int differing = 0;  // an edge between texels may round to the other side
        for (int y = 0; y < a.height; ++y)
            for (int x = 0; x < a.width; ++x) differing += pixelAt(a, x, y) != pixelAt(b, x, y);
        return differing <= 20;
    };
    EXPECT_TRUE(same(draw(m, [](Primitive&) {}), baked));
    EXPECT_FALSE(same(draw(unlitMaterial(glm::vec3(1)), [](Primitive&) {}), baked));
    m.baseColorTexture.uvSet = 1;
    EXPECT_TRUE(same(draw(m,
                          [](Primitive& p) {
                              p.extras.resize(4);
                              for (std::size_t i = 0; i < 4; ++i) std::swap(p.extras[i].uv, p.vertices[i].uv);
                          }),
                     baked));
    // A missing set is read at 0, 0.
    m.baseColorTexture.imageFromVertex = glm::mat3x2(1.0f);
    EXPECT_EQ(pixelAt(draw(m, [](Primitive&) {}), 110, 110), glm::dvec3(1, 0, 0));
}

// Each slot has its own: a plain base colour under an emission read from the second set.
TEST_F(SurfaceGLTest, SlotsAreReadOnTheirOwn) {
    Material m;
    m.baseColor = glm::vec4(0, 0, 0, 1);
    m.metallic = 0.0f;
    m.emissive = glm::vec3(1);
    m.emissiveTexture.image = 0;
    m.emissiveTexture.sampler.magnification = Filter::nearest;
    m.emissiveTexture.uvSet = 1;
    Scene scene = square(m, [](Primitive& p) {
        p.extras.resize(4);
        for (VertexExtra& extra : p.extras) extra.uv = glm::vec2(0.25f, 0.75f);  // blue, all over
    });
    scene.images.push_back(fourColours());
    Light dark;
    dark.kind = LightKind::directional;
    dark.color = glm::vec3(0);
    scene.lights.push_back(dark);
    for (const int x : {50, 110}) {
        const glm::dvec3 seen = pixelAt(pinhole(scene), x, 50);
        EXPECT_GT(seen.z, seen.x + 0.99) << x;
        EXPECT_LT(seen.x, 0.1) << x;
    }
}

TEST_F(SurfaceGLTest, OcclusionDarkensTheSkysLightOnly) {
    Material m;
    m.metallic = 0.0f;
    const auto seen = [&](float lux, float strength, bool occluded) {
        Material material = m;
        material.occlusionStrength = strength;
        if (occluded) material.occlusionTexture.image = 0;
        Scene scene = square(material, [](Primitive&) {});
        scene.images.push_back({"a fifth", 1, 1, {51, 255, 255, 255}});  // red counts, linear: 0.2
        Light light;
        light.kind = LightKind::directional;
        light.color = glm::vec3(lux);
        scene.lights.push_back(light);
        return pixelAt(pinhole(scene), 80, 80).y;
    };
    const double sky = seen(0.0f, 1.0f, false), lamp = seen(1.0f, 1.0f, false) - sky;
    EXPECT_NEAR(seen(0.0f, 1.0f, true) / sky, 0.2, 0.002);
    EXPECT_NEAR(seen(0.0f, 0.5f, true) / sky, 0.6, 0.002);
    EXPECT_NEAR(seen(0.0f, 0.0f, true) / sky, 1.0, 0.002);
    EXPECT_NEAR(seen(1.0f, 1.0f, true) - seen(0.0f, 1.0f, true), lamp, 0.001);
}

}  // namespace
}  // namespace dioptre
