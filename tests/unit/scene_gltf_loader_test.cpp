// What good files become: primitives, materials, images, the node tree, cameras, lights, warnings.
#include <cmath>

#include "scene_gltf_maker.hpp"

namespace dioptre {
namespace {

using namespace test;

void expectNear(const glm::vec3& a, const glm::vec3& b, float tolerance = 1e-5f) {
    EXPECT_LE(glm::length(a - b), tolerance)
        << a.x << " " << a.y << " " << a.z << " is not " << b.x << " " << b.y << " " << b.z;
}

TEST(GltfLoaderTest, Triangle) {
    const Scene scene = load(triangleGltf());
    EXPECT_EQ(scene.name, "scene");
    EXPECT_EQ(scene.triangleCount(), 1u);
    ASSERT_EQ(scene.instances.size(), 1u);
    EXPECT_EQ(scene.instances[0].name, "node");
    EXPECT_EQ(scene.meshes[0].name, "triangle");
    const Primitive& primitive = scene.meshes[0].primitives[0];
    EXPECT_EQ(primitive.indices, (std::vector<std::uint32_t>{0, 1, 2}));
    EXPECT_EQ(primitive.vertices[1].position, glm::vec3(1, 0, 0));
    EXPECT_EQ(primitive.vertices[1].normal, glm::vec3(0, 0, 1));
    EXPECT_EQ(primitive.vertices[2].uv, glm::vec2(0, 1));
    EXPECT_EQ(primitive.bounds.max, glm::vec3(1, 1, 0));
    EXPECT_EQ(scene.bounds.max, glm::vec3(1, 1, 0));
    ASSERT_EQ(scene.materials.size(), 1u);
    EXPECT_EQ(scene.materials[0].name, "red");
    EXPECT_EQ(scene.materials[0].baseColor, glm::vec4(1, 0, 0, 1));
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfLoaderTest, DefaultMaterialComesLastAndOnlyIfUsed) {
    Json gltf = triangleGltf();
    gltf["meshes"][0]["primitives"][0].erase("material");
    const Scene scene = load(gltf);
    ASSERT_EQ(scene.materials.size(), 2u);
    EXPECT_EQ(scene.meshes[0].primitives[0].material, 1);
    EXPECT_EQ(scene.materials[1].baseColor, glm::vec4(1));
    EXPECT_EQ(load(Json::parse(R"({"asset": {"version": "2.0"}})")).materials.size(), 1u);
}

// Five points as a strip, a fan, and so on, by mode.
Json fiveVertices(int mode) {
    Json gltf = triangleGltf();
    const std::size_t positions =
        addAccessor(gltf, bytesOf<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0}), 5126, "VEC3", 5);
    const std::size_t normals =
        addAccessor(gltf, bytesOf<float>({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}), 5126, "VEC3", 5);
    gltf["meshes"][0]["primitives"][0] = {{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}},
                                          {"mode", mode}};
    return gltf;
}

TEST(GltfLoaderTest, StripsAndFansBecomeTriangles) {
    const auto indices = [](const Scene& s) { return s.meshes[0].primitives[0].indices; };
    EXPECT_EQ(indices(load(fiveVertices(5))), (std::vector<std::uint32_t>{0, 1, 2, 1, 3, 2, 2, 3, 4}));
    EXPECT_EQ(indices(load(fiveVertices(6))), (std::vector<std::uint32_t>{1, 2, 0, 2, 3, 0, 3, 4, 0}));
    const Scene rest = load(fiveVertices(4));
    EXPECT_EQ(indices(rest), (std::vector<std::uint32_t>{0, 1, 2}));
    EXPECT_TRUE(warns(rest, "meshes[0].primitives[0]: the last triangle is incomplete"));
}

TEST(GltfLoaderTest, PointsAndLines) {
    const std::vector<std::uint32_t> expected[] = {
        {0, 1, 2, 3, 4}, {0, 1, 2, 3}, {0, 1, 1, 2, 2, 3, 3, 4, 4, 0}, {0, 1, 1, 2, 2, 3, 3, 4}};
    for (const int mode : {0, 1, 2, 3}) {
        SCOPED_TRACE(mode);
        Json gltf = fiveVertices(mode);
        const Scene scene = load(gltf);
        const Primitive& primitive = scene.meshes[0].primitives[0];
        EXPECT_EQ(primitive.indices, expected[mode]);
        EXPECT_EQ(primitive.topology, mode == 0 ? Topology::points : Topology::lines);
        EXPECT_TRUE(primitive.lit);
        EXPECT_EQ(scene.triangleCount(), 0u);
        EXPECT_EQ(scene.bounds.max, glm::vec3(1, 2, 0));
        EXPECT_EQ(warns(scene, "the last line is incomplete"), mode == 1);
        attributesOf(gltf).erase("NORMAL");
        const Scene unlit = load(gltf);
        EXPECT_FALSE(unlit.meshes[0].primitives[0].lit);
        EXPECT_EQ(unlit.meshes[0].primitives[0].vertices.size(), 5u);  // none made flat
        gltf["meshes"][0]["primitives"][0]["indices"] =
            addAccessor(gltf, bytesOf<std::uint8_t>({3}), 5121, "SCALAR", 1);
        EXPECT_EQ(load(gltf).meshes[0].primitives.size(), mode == 0 ? 1u : 0u);
        EXPECT_EQ(warns(load(gltf), "has no whole line: not drawn"), mode != 0);
    }
}

TEST(GltfLoaderTest, LinesWithoutTangentsHaveNoNormalMap) {
    Json gltf = texturedGltf();
    gltf["materials"][0]["normalTexture"] = {{"index", 0}};
    gltf["meshes"][0]["primitives"][0]["mode"] = 3;
    gltf["buffers"][1]["uri"] = dataUri(bytesOf<float>({0, 3, 0, 0, 0, 0, 0, 0, 1}));
    const Primitive without = load(gltf).meshes[0].primitives[0];
    for (const Vertex& vertex : without.vertices) EXPECT_EQ(vertex.tangent, glm::vec4(0));
    EXPECT_EQ(without.vertices[1].normal, glm::vec3(0, 0, 1)) << "no faces to take it from";
    attributesOf(gltf)["TANGENT"] =
        addAccessor(gltf, bytesOf<float>({0, 1, 0, -1, 0, 1, 0, 1, 1, 0, 0, 1}), 5126, "VEC4", 3);
    EXPECT_EQ(load(gltf).meshes[0].primitives[0].vertices[0].tangent, glm::vec4(0, 1, 0, -1));
}

TEST(GltfLoaderTest, VertexColours) {
    const std::vector<glm::u16vec4> expected{{0xFFFF, 0, 0x3333, 0xFFFF}, {0, 0xFFFF, 0, 0xFFFF}, {0, 0, 0, 0xFFFF}};
    const auto colors = [](const Json& gltf) {
        std::vector<glm::u16vec4> all;
        const Scene scene = load(gltf);
        for (const VertexExtra& extra : scene.meshes[0].primitives[0].extras) all.push_back(extra.color);
        return all;
    };
    Json gltf = triangleGltf();
    EXPECT_TRUE(load(gltf).meshes[0].primitives[0].extras.empty());
    const auto add = [&](const std::string& bytes, int component, const std::string& type) {
        attributesOf(gltf)["COLOR_0"] = addAccessor(gltf, bytes, component, type, 3);
        if (component != 5126) gltf["accessors"].back()["normalized"] = true;
    };
    // Beyond 0..1 they are clamped.
    add(bytesOf<float>({1, 0, 0.2f, -1, 7, 0, 0, 0, 0}), 5126, "VEC3");
    EXPECT_EQ(colors(gltf), expected);
    add(bytesOf<float>({1, 0, 0.2f, 1, 0, 1, 0, 1, 0, 0, 0, 1}), 5126, "VEC4");
    EXPECT_EQ(colors(gltf), expected);
    add(bytesOf<std::uint8_t>({255, 0, 51, 255, 0, 255, 0, 255, 0, 0, 0, 255}), 5121, "VEC4");
    EXPECT_EQ(colors(gltf), expected);
    add(bytesOf<std::uint16_t>({65535, 0, 13107, 0, 65535, 0, 0, 0, 0}), 5123, "VEC3");
    EXPECT_EQ(colors(gltf), expected);
    gltf["accessors"].back()["normalized"] = false;
    EXPECT_TRUE(contains(refusal(gltf), "COLOR_0: is UNSIGNED_SHORT, must be FLOAT, normalized UNSIGNED_BYTE"));
    add(bytesOf<float>({1, 0, 0, 1, 0, 1}), 5126, "VEC2");
    EXPECT_TRUE(contains(refusal(gltf), "COLOR_0: is VEC2, must be VEC3 or VEC4"));
    // Unshared vertices keep theirs.
    add(bytesOf<float>({1, 0, 0.2f, 0, 1, 0, 0, 0, 0}), 5126, "VEC3");
    attributesOf(gltf).erase("NORMAL");
    gltf["meshes"][0]["primitives"][0]["indices"] =
        addAccessor(gltf, bytesOf<std::uint8_t>({0, 1, 2, 2, 1, 0}), 5121, "SCALAR", 6);
    const std::vector<glm::u16vec4> flat = colors(gltf);
    ASSERT_EQ(flat.size(), 6u);
    EXPECT_EQ(flat[3], expected[2]);
    EXPECT_EQ(flat[5], expected[0]);
}

TEST(GltfLoaderTest, TextureTransforms) {
    Json gltf = texturedGltf();
    gltf["extensionsUsed"] = gltf["extensionsRequired"] = {"KHR_texture_transform"};
    Json& texture = gltf["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
    texture["texCoord"] = 3;
    texture["extensions"]["KHR_texture_transform"] = Json::parse(R"({"offset": [10, 20], "scale": [2, 3],
        "rotation": 1.5707963, "texCoord": 0})");
    gltf["materials"][0]["occlusionTexture"] = {{"index", 0}, {"strength", 0.25}, {"texCoord", 3}};
    const Scene scene = load(gltf);
    const Material& m = scene.materials[0];
    const TextureSlot& slot = m.baseColorTexture;
    EXPECT_EQ(slot.uvSet, 0);
    EXPECT_FALSE(slot.plain());
    // The extension's own example: a quarter turn takes u to -v and v to u.
    const glm::vec2 u = slot.imageFromVertex * glm::vec3(1, 0, 1), v = slot.imageFromVertex * glm::vec3(0, 1, 1);
    expectNear(glm::vec3(u, 0), {10, 18, 0});
    expectNear(glm::vec3(v, 0), {13, 20, 0});
    EXPECT_EQ(m.occlusionTexture.uvSet, 1);
    EXPECT_EQ(m.occlusionStrength, 0.25f);
    EXPECT_TRUE(warns(scene, "attributes.TEXCOORD_3: is missing"));
    EXPECT_EQ(scene.warnings.size(), 1u);
}

TEST(GltfLoaderTest, TangentsFollowTheNormalMapsCoordinates) {
    Json gltf = texturedGltf();
    gltf["materials"][0]["normalTexture"] = {{"index", 0}, {"texCoord", 1}};
    // u along y, v along -x
    attributesOf(gltf)["TEXCOORD_1"] = addAccessor(gltf, bytesOf<float>({0, 0, 0, -1, 1, 0}), 5126, "VEC2", 3);
    EXPECT_EQ(load(gltf).meshes[0].primitives[0].vertices[0].tangent, glm::vec4(0, 1, 0, -1));
    // Mirrored: u along -y
    gltf["materials"][0]["normalTexture"]["extensions"]["KHR_texture_transform"] = {{"scale", {-1, 1}}};
    EXPECT_EQ(load(gltf).meshes[0].primitives[0].vertices[0].tangent, glm::vec4(0, -1, 0, 1));
}

TEST(GltfLoaderTest, MissingNormalsAreFlat) {
    Json gltf = triangleGltf();
    attributesOf(gltf).erase("NORMAL");
    // Two triangles sharing an edge, at right angles.
    gltf["accessors"][0] =
        gltf["accessors"][addAccessor(gltf, bytesOf<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, -1}), 5126, "VEC3", 4)];
    attributesOf(gltf).erase("TEXCOORD_0");
    gltf["meshes"][0]["primitives"][0]["indices"] =
        addAccessor(gltf, bytesOf<std::uint8_t>({0, 1, 2, 0, 2, 3}), 5121, "SCALAR", 6);
    const Primitive primitive = load(gltf).meshes[0].primitives[0];
    ASSERT_EQ(primitive.vertices.size(), 6u);
    EXPECT_EQ(primitive.indices, (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5}));
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(primitive.vertices[i].normal, glm::vec3(0, 0, 1));
        EXPECT_EQ(primitive.vertices[3 + i].normal, glm::vec3(-1, 0, 0));
    }
}

TEST(GltfLoaderTest, ZeroNormalsComeFromTheFaces) {
    Json gltf = triangleGltf();
    gltf["buffers"][1]["uri"] = dataUri(bytesOf<float>({0, 3, 0, 0, 0, 0, 0, 0, 1}));
    const Scene scene = load(gltf);
    EXPECT_EQ(scene.meshes[0].primitives[0].vertices[0].normal, glm::vec3(0, 1, 0));
    EXPECT_EQ(scene.meshes[0].primitives[0].vertices[1].normal, glm::vec3(0, 0, 1));
    EXPECT_TRUE(warns(scene, "attributes.NORMAL: zero normals"));
}

TEST(GltfLoaderTest, Tangents) {
    Json gltf = texturedGltf();
    gltf["materials"][0]["normalTexture"] = {{"index", 0}, {"scale", 0.5}};
    const Scene computed = load(gltf);
    EXPECT_EQ(computed.materials[0].normalScale, 0.5f);
    EXPECT_EQ(computed.meshes[0].primitives[0].vertices[0].tangent, glm::vec4(1, 0, 0, -1));
    attributesOf(gltf)["TANGENT"] =
        addAccessor(gltf, bytesOf<float>({0, 2, 0, -1, 0, 1, 0, 1, 0, 0, 0, 1}), 5126, "VEC4", 3);
    const Scene given = load(gltf);
    EXPECT_EQ(given.meshes[0].primitives[0].vertices[0].tangent, glm::vec4(0, 1, 0, -1));
    EXPECT_TRUE(warns(given, "attributes.TANGENT: zero tangents"));
}

TEST(GltfLoaderTest, MaterialFields) {
    Json gltf = texturedGltf();
    gltf["samplers"] = Json::parse(R"([{"wrapS": 33071, "wrapT": 33648, "magFilter": 9728, "minFilter": 9985}])");
    gltf["textures"].push_back({{"source", 0}, {"sampler", 0}});
    gltf["materials"][0] = Json::parse(R"({
        "pbrMetallicRoughness": {"baseColorFactor": [0.1, 0.2, 0.3, 0.4], "metallicFactor": 0.5,
                                 "roughnessFactor": 0.25,
                                 "baseColorTexture": {"index": 0}, "metallicRoughnessTexture": {"index": 1}},
        "emissiveFactor": [1, 0.5, 0], "emissiveTexture": {"index": 1},
        "alphaMode": "MASK", "alphaCutoff": 0.75, "doubleSided": true,
        "extensions": {"KHR_materials_unlit": {}, "KHR_materials_emissive_strength": {"emissiveStrength": 10}}})");
    const Scene scene = load(gltf);
    const Material& m = scene.materials[0];
    EXPECT_EQ(m.baseColor, glm::vec4(0.1f, 0.2f, 0.3f, 0.4f));
    EXPECT_EQ(m.metallic, 0.5f);
    EXPECT_EQ(m.roughness, 0.25f);
    EXPECT_EQ(m.emissive, glm::vec3(10, 5, 0));
    EXPECT_EQ(m.alphaMode, AlphaMode::mask);
    EXPECT_EQ(m.alphaCutoff, 0.75f);
    EXPECT_TRUE(m.doubleSided);
    EXPECT_TRUE(m.unlit);
    EXPECT_EQ(scene.images.size(), 1u);
    EXPECT_EQ(m.baseColorTexture, (TextureSlot{0, Sampler{}}));
    const Sampler sampler{Wrap::clampToEdge, Wrap::mirroredRepeat, Filter::nearest, Filter::linearMipNearest};
    EXPECT_EQ(m.metallicRoughnessTexture, (TextureSlot{0, sampler}));
    EXPECT_EQ(m.emissiveTexture, (TextureSlot{0, sampler}));
    EXPECT_FALSE(m.normalTexture.used());
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfLoaderTest, WhatIsIgnoredIsSaid) {
    Json gltf = texturedGltf();
    gltf["extensionsUsed"] = {"KHR_materials_clearcoat", "KHR_texture_transform", "KHR_lights_punctual"};
    gltf["materials"][0]["emissiveFactor"] = {2, 0, 0};
    attributesOf(gltf)["COLOR_1"] = 0;
    gltf["scenes"].push_back(Json::object());
    gltf["skins"] = Json::parse(R"([{"joints": [0]}])");
    gltf["nodes"][0]["skin"] = 0;
    gltf["animations"] = Json::parse(R"([{"channels": [{"sampler": 0, "target": {"path": "pointer"}}],
                                          "samplers": [{"input": 4, "output": 0}]}])");
    addAccessor(gltf, bytesOf<float>({0, 1, 2}), 5126, "SCALAR", 3);
    gltf["cameras"] = Json::parse(R"([{"type": "orthographic"}])");
    const Scene scene = load(gltf);
    for (const char* line :
         {"extensionsUsed[0]: KHR_materials_clearcoat is ignored",
          "materials[0].emissiveFactor: a factor outside 0..1 is clamped",
          "meshes[0].primitives[0].attributes.COLOR_1: a second vertex colour is ignored",
          "scenes: scene 0 of 2 is drawn, no other", "nodes[0].skin: is ignored: the node has no mesh with JOINTS_0",
          "animations[0].channels[0].target: aims at no node: ignored", "cameras[0]: orthographic cameras are ignored"})
        EXPECT_TRUE(warns(scene, line)) << line;
    EXPECT_EQ(scene.warnings.size(), 7u);
    EXPECT_FALSE(scene.motion);
}

TEST(GltfLoaderTest, TextureCoordinatesOfTheMaterialsSet) {
    Json gltf = texturedGltf();
    gltf["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["texCoord"] = 1;
    EXPECT_TRUE(warns(load(gltf), "attributes.TEXCOORD_1: is missing"));
    attributesOf(gltf)["TEXCOORD_1"] = addAccessor(gltf, bytesOf<float>({7, 8, 1, 0, 0, 1}), 5126, "VEC2", 3);
    gltf["materials"][0]["emissiveTexture"] = {{"index", 0}};
    const Scene scene = load(gltf);
    EXPECT_EQ(scene.meshes[0].primitives[0].vertices[0].uv, glm::vec2(7, 8));
    EXPECT_EQ(scene.materials[0].baseColorTexture.uvSet, 0);
    EXPECT_EQ(scene.materials[0].emissiveTexture.uvSet, 1);
    EXPECT_EQ(scene.meshes[0].primitives[0].extras[1].uv, glm::vec2(1, 0));
    EXPECT_TRUE(scene.warnings.empty());
    gltf["materials"][0]["normalTexture"] = {{"index", 0}, {"texCoord", 2}};
    const Scene third = load(gltf);
    EXPECT_FALSE(third.materials[0].emissiveTexture.used());
    EXPECT_TRUE(warns(third, "materials[0].emissiveTexture.texCoord: is a third set"));
}

TEST(GltfLoaderTest, Images) {
    const Scene scene = load(texturedGltf());
    ASSERT_EQ(scene.images.size(), 1u);
    EXPECT_EQ(scene.images[0].name, "two");
    EXPECT_EQ(scene.images[0].width, 2);
    EXPECT_EQ(scene.images[0].height, 1);
    EXPECT_EQ(scene.images[0].rgba, (std::vector<std::uint8_t>{255, 0, 0, 255, 0, 128, 255, 64}));

    Json gltf = texturedGltf();  // 16-bit RGB (65535, 32896, 257)
    gltf["images"][0]["uri"] =
        "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABEAIAAADA54+dAAAAD0lEQVR42mP4/7+hgZERAA5/AwEbKTRVAAAAAElF"
        "TkSuQmCC";
    EXPECT_EQ(load(gltf).images[0].rgba, (std::vector<std::uint8_t>{255, 128, 1, 255}));

    gltf["images"][0]["uri"] =  // 2 x 2 of (200, 100, 50)
        "data:image/jpeg;base64,/9j/4AAQSkZJRgABAQAAAQABAAD/"
        "2wBDABALDA4MChAODQ4SERATGCgaGBYWGDEjJR0oOjM9PDkzODdASFxOQERX"
        "RTc4UG1RV19iZ2hnPk1xeXBkeFxlZ2P/"
        "2wBDARESEhgVGC8aGi9jQjhCY2NjY2NjY2NjY2NjY2NjY2NjY2NjY2NjY2NjY2NjY2NjY2NjY2NjY2Nj"
        "Y2NjY2NjY2P/wAARCAACAAIDASIAAhEBAxEB/8QAFQABAQAAAAAAAAAAAAAAAAAAAAL/xAAUEAEAAAAAAAAAAAAAAAAAAAAA/"
        "8QAFAEBAAAAAAAAA"
        "AAAAAAAAAAABf/EABQRAQAAAAAAAAAAAAAAAAAAAAD/2gAMAwEAAhEDEQA/AJAFmX//2Q==";
    const Scene jpeg = load(gltf);
    EXPECT_EQ(jpeg.images[0].width, 2);
    EXPECT_NEAR(jpeg.images[0].rgba[0], 200, 8);
    EXPECT_EQ(jpeg.images[0].rgba[3], 255);

    gltf["materials"][0]["pbrMetallicRoughness"].erase("baseColorTexture");
    EXPECT_TRUE(load(gltf).images.empty());  // not drawn, not kept
}

TEST(GltfLoaderTest, NodesByMatrixAndByParts) {
    Json gltf = triangleGltf();
    const float half = std::sqrt(0.5f);
    gltf["nodes"] = Json::array({{{"translation", {1, 2, 3}}, {"children", {1, 2}}},
                                 {{"mesh", 0}, {"rotation", {0, 0, half, half}}, {"scale", {2, 3, 4}}},
                                 {{"mesh", 0}, {"matrix", {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1}}}});
    const Scene scene = load(gltf);
    ASSERT_EQ(scene.instances.size(), 2u);
    EXPECT_EQ(scene.meshes.size(), 1u);
    EXPECT_EQ(scene.triangleCount(), 2u);
    // A quarter turn about z after the scale: x goes to 2 y, y to -3 x.
    const glm::mat4& byParts = scene.instances[0].worldFromMesh;
    expectNear(glm::vec3(byParts * glm::vec4(1, 0, 0, 1)), {1, 4, 3});
    expectNear(glm::vec3(byParts * glm::vec4(0, 1, 0, 1)), {-2, 2, 3});
    const glm::mat4& byMatrix = scene.instances[1].worldFromMesh;
    expectNear(glm::vec3(byMatrix * glm::vec4(1, 0, 0, 1)), {5, 8, 10});
    EXPECT_LT(glm::determinant(byMatrix), 0.0f);
    expectNear(scene.bounds.min, {-2, 2, 3});
    expectNear(scene.bounds.max, {6, 9, 10});
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfLoaderTest, OddTransformsAreSaid) {
    Json gltf = triangleGltf();
    gltf["nodes"][0]["scale"] = {1, 0, 1};
    EXPECT_TRUE(warns(load(gltf), "nodes[0]: its transform is singular"));
    gltf["nodes"][0] = {{"mesh", 0}, {"rotation", {0, 0, 0, 2}}};
    const Scene scene = load(gltf);
    EXPECT_TRUE(warns(scene, "nodes[0].rotation: is not of unit length"));
    EXPECT_EQ(scene.instances[0].worldFromMesh, glm::mat4(1.0f));
}

TEST(GltfLoaderTest, WhichSceneIsDrawn) {
    Json gltf = triangleGltf();
    gltf["nodes"] = Json::parse(R"([{"name": "a", "mesh": 0}, {"name": "b", "mesh": 0}, {"name": "c", "mesh": 0}])");
    gltf["scenes"] = Json::parse(R"([{"nodes": [0]}, {"name": "second", "nodes": [1, 0]}])");
    const auto names = [](const Scene& scene) {
        std::string all = scene.name + ":";
        for (const Instance& instance : scene.instances) all += instance.name;
        return all;
    };
    EXPECT_EQ(names(load(gltf)), "scene:a");
    gltf["scene"] = 1;
    EXPECT_EQ(names(load(gltf)), "second:ba");
    gltf.erase("scene");
    EXPECT_EQ(names(load(gltf)), "scene:a");
    gltf.erase("scenes");
    EXPECT_EQ(names(load(gltf)), "scene:abc");
}

TEST(GltfLoaderTest, Cameras) {
    Json gltf = triangleGltf();
    gltf["cameras"] =
        Json::parse(R"([{"name": "lens", "type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.2}},
        {"type": "orthographic", "orthographic": {"xmag": 1, "ymag": 1, "znear": 0, "zfar": 1}}])");
    const float half = std::sqrt(0.5f);  // a quarter turn about y: it looks along -x
    gltf["nodes"] = Json::array({{{"camera", 0},
                                  {"name", "eye"},
                                  {"translation", {1, 2, 3}},
                                  {"scale", {2, 2, -5}},
                                  {"rotation", {0, half, 0, half}}},
                                 {{"camera", 1}},
                                 {{"camera", 0}, {"scale", {0, 0, 0}}},
                                 {{"camera", 0}}});
    gltf["scenes"][0]["nodes"] = {0, 1, 2, 3};
    const Scene scene = load(gltf);
    ASSERT_EQ(scene.cameras.size(), 2u);
    const Camera& camera = scene.cameras[0];
    EXPECT_EQ(camera.name, "eye");
    EXPECT_EQ(scene.cameras[1].name, "lens");
    EXPECT_EQ(camera.yfovRadians, 0.5f);
    EXPECT_EQ(camera.nearMetres, 0.2f);
    // Rigid, and the mirrored z turns it round.
    EXPECT_NEAR(glm::determinant(camera.worldFromCamera), 1.0f, 1e-5f);
    expectNear(glm::vec3(camera.worldFromCamera * glm::vec4(0, 0, -1, 0)), {1, 0, 0});
    expectNear(glm::vec3(camera.worldFromCamera[1]), {0, 1, 0});
    expectNear(glm::vec3(camera.worldFromCamera[3]), {1, 2, 3});
    EXPECT_TRUE(warns(scene, "nodes[2].camera: is ignored"));
}

TEST(GltfLoaderTest, Lights) {
    Json gltf = triangleGltf();
    gltf["extensions"]["KHR_lights_punctual"]["lights"] = Json::parse(R"([
        {"type": "spot", "color": [1, 0.5, 0], "intensity": 20, "range": 4,
         "spot": {"innerConeAngle": 0.3, "outerConeAngle": 0.6}},
        {"type": "directional", "name": "sun", "intensity": 3}, {"type": "point"}, {"type": "spot", "spot": {}}])");
    gltf["nodes"] = Json::array();
    for (int i = 0; i < 4; ++i)
        gltf["nodes"].push_back({{"translation", {i, 0, 0}},
                                 {"rotation", {1, 0, 0, 0}},
                                 {"scale", {2, 2, 2}},
                                 {"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
    gltf.erase("scenes");
    gltf.erase("scene");
    const Scene scene = load(gltf);
    ASSERT_EQ(scene.lights.size(), 4u);
    const Light& spot = scene.lights[0];
    EXPECT_EQ(spot.kind, LightKind::spot);
    EXPECT_EQ(spot.color, glm::vec3(20, 10, 0));
    EXPECT_EQ(spot.range, 4.0f);
    EXPECT_FLOAT_EQ(spot.innerConeCos, std::cos(0.3f));
    EXPECT_FLOAT_EQ(spot.outerConeCos, std::cos(0.6f));
    expectNear(spot.direction, {0, 0, 1});  // half a turn about x
    EXPECT_EQ(scene.lights[1].name, "sun");
    EXPECT_EQ(scene.lights[1].kind, LightKind::directional);
    EXPECT_EQ(scene.lights[1].color, glm::vec3(3));
    EXPECT_EQ(scene.lights[2].kind, LightKind::point);
    expectNear(scene.lights[2].position, {2, 0, 0});
    EXPECT_EQ(scene.lights[2].range, 0.0f);
    EXPECT_EQ(scene.lights[3].innerConeCos, 1.0f);
    EXPECT_NEAR(scene.lights[3].outerConeCos, std::sqrt(0.5f), 1e-6f);
}

TEST(GltfLoaderTest, NamesKeepTheirUtf8) {
    Json gltf = triangleGltf();
    gltf["nodes"][0]["name"] = "caf\xC3\xA9 \xE7\x9C\xBC";
    EXPECT_EQ(load(gltf).instances[0].name, "caf\xC3\xA9 \xE7\x9C\xBC");
}

}  // namespace
}  // namespace dioptre
