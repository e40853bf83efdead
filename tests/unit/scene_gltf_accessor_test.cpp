// Values as they come out of accessors: every component type, normalised or not, strided, sparse, absent.
#include "scene_gltf_maker.hpp"

namespace dioptre {
namespace {

using namespace test;

const Primitive& onlyPrimitive(const Scene& scene) {
    return scene.meshes.at(0).primitives.at(0);
}

// The triangle with other data as POSITION or such, under KHR_mesh_quantization.
template <typename T>
Scene withAttribute(const char* semantic, const char* type, int componentType, bool normalized,
                    const std::vector<T>& values) {
    Json gltf = triangleGltf();
    gltf["extensionsUsed"] = {"KHR_mesh_quantization"};
    gltf["extensionsRequired"] = {"KHR_mesh_quantization"};
    attributesOf(gltf)[semantic] = addAccessor(gltf, bytesOf(values), componentType, type, 3);
    gltf["accessors"].back()["normalized"] = normalized;
    return load(gltf);
}

TEST(GltfAccessorTest, PositionsOfEveryComponentType) {
    const auto second = [](const Scene& scene) { return onlyPrimitive(scene).vertices[1].position; };
    EXPECT_EQ(second(withAttribute<float>("POSITION", "VEC3", 5126, false, {0, 0, 0, 1.5f, -2, 3, 0, 1, 0})),
              glm::vec3(1.5f, -2, 3));
    EXPECT_EQ(second(withAttribute<std::int8_t>("POSITION", "VEC3", 5120, false, {0, 0, 0, -128, 127, 5, 0, 1, 0})),
              glm::vec3(-128, 127, 5));
    EXPECT_EQ(second(withAttribute<std::int8_t>("POSITION", "VEC3", 5120, true, {0, 0, 0, -128, 127, -127, 0, 1, 0})),
              glm::vec3(-1, 1, -1));
    EXPECT_EQ(second(withAttribute<std::uint8_t>("POSITION", "VEC3", 5121, false, {0, 0, 0, 255, 7, 0, 0, 1, 0})),
              glm::vec3(255, 7, 0));
    EXPECT_EQ(second(withAttribute<std::uint8_t>("POSITION", "VEC3", 5121, true, {0, 0, 0, 255, 51, 0, 0, 1, 0})),
              glm::vec3(1, 0.2f, 0));
    EXPECT_EQ(second(withAttribute<std::int16_t>("POSITION", "VEC3", 5122, false, {0, 0, 0, -32768, 300, 0, 0, 1, 0})),
              glm::vec3(-32768, 300, 0));
    EXPECT_EQ(second(withAttribute<std::int16_t>("POSITION", "VEC3", 5122, true, {0, 0, 0, -32768, 32767, 0, 0, 1, 0})),
              glm::vec3(-1, 1, 0));
    EXPECT_EQ(second(withAttribute<std::uint16_t>("POSITION", "VEC3", 5123, false, {0, 0, 0, 65535, 1, 0, 0, 1, 0})),
              glm::vec3(65535, 1, 0));
    EXPECT_EQ(second(withAttribute<std::uint16_t>("POSITION", "VEC3", 5123, true, {0, 0, 0, 65535, 13107, 0, 0, 1, 0})),
              glm::vec3(1, 0.2f, 0));
}

TEST(GltfAccessorTest, NormalisedTextureCoordinatesNeedNoExtension) {
    Json gltf = triangleGltf();
    attributesOf(gltf)["TEXCOORD_0"] =
        addAccessor(gltf, bytesOf<std::uint16_t>({0, 0, 65535, 13107, 0, 0}), 5123, "VEC2", 3);
    EXPECT_TRUE(contains(refusal(gltf), "TEXCOORD_0: is UNSIGNED_SHORT, which needs KHR_mesh_quantization"));
    gltf["accessors"].back()["normalized"] = true;
    EXPECT_EQ(onlyPrimitive(load(gltf)).vertices[1].uv, glm::vec2(1, 0.2f));
}

TEST(GltfAccessorTest, QuantisedNormalsAreUnit) {
    const Scene scene = withAttribute<std::int8_t>("NORMAL", "VEC3", 5120, true, {127, 0, 0, 0, 100, 0, 70, 70, 0});
    const auto& vertices = onlyPrimitive(scene).vertices;
    EXPECT_EQ(vertices[0].normal, glm::vec3(1, 0, 0));
    EXPECT_EQ(vertices[1].normal, glm::vec3(0, 1, 0));
    EXPECT_NEAR(glm::length(vertices[2].normal), 1.0f, 1e-6f);
}

TEST(GltfAccessorTest, IndicesOfEveryType) {
    const auto indicesOf = [](const std::string& bytes, int componentType) {
        Json gltf = triangleGltf();
        gltf["meshes"][0]["primitives"][0]["indices"] = addAccessor(gltf, bytes, componentType, "SCALAR", 3);
        return onlyPrimitive(load(gltf)).indices;
    };
    const std::vector<std::uint32_t> expected{2, 0, 1};
    EXPECT_EQ(indicesOf(bytesOf<std::uint8_t>({2, 0, 1}), 5121), expected);
    EXPECT_EQ(indicesOf(bytesOf<std::uint16_t>({2, 0, 1}), 5123), expected);
    EXPECT_EQ(indicesOf(bytesOf<std::uint32_t>({2, 0, 1}), 5125), expected);
}

TEST(GltfAccessorTest, InterleavedDataAndOffsets) {
    Json gltf = triangleGltf();
    // 4 bytes before it all, then position, uv, 4 bytes of nothing: a stride of 24. The last element may end early.
    const std::string bytes = bytesOf<float>({9, 0, 0, 0, .1f, .2f, 9, 1, 0, 0, .3f, .4f, 9, 0, 1, 0, .5f, .6f});
    const std::size_t view = addView(gltf, bytes);
    gltf["bufferViews"][view]["byteOffset"] = 4;
    gltf["bufferViews"][view]["byteLength"] = bytes.size() - 4;
    gltf["bufferViews"][view]["byteStride"] = 24;
    gltf["accessors"][0]["bufferView"] = view;
    gltf["accessors"][2]["bufferView"] = view;
    gltf["accessors"][2]["byteOffset"] = 12;
    const Scene scene = load(gltf);
    const auto& vertices = onlyPrimitive(scene).vertices;
    EXPECT_EQ(vertices[1].position, glm::vec3(1, 0, 0));
    EXPECT_EQ(vertices[2].position, glm::vec3(0, 1, 0));
    EXPECT_EQ(vertices[0].uv, glm::vec2(.1f, .2f));
    EXPECT_EQ(vertices[2].uv, glm::vec2(.5f, .6f));
}

TEST(GltfAccessorTest, SparseOverDataAndOverZeros) {
    Json gltf = triangleGltf();
    const std::size_t indices = addView(gltf, bytesOf<std::uint8_t>({1, 2}));
    const std::size_t values = addView(gltf, bytesOf<float>({5, 0, 0, 0, 6, 0}));
    const Json sparse = {{"count", 2},
                         {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                         {"values", {{"bufferView", values}}}};
    gltf["accessors"][1]["sparse"] = sparse;  // normals become +z, +x, +y
    gltf["accessors"][0] = {{"componentType", 5126}, {"type", "VEC3"}, {"count", 3}, {"sparse", sparse}};
    const Scene scene = load(gltf);
    const auto& vertices = onlyPrimitive(scene).vertices;
    EXPECT_EQ(vertices[0].position, glm::vec3(0));
    EXPECT_EQ(vertices[1].position, glm::vec3(5, 0, 0));
    EXPECT_EQ(vertices[2].position, glm::vec3(0, 6, 0));
    EXPECT_EQ(vertices[0].normal, glm::vec3(0, 0, 1));
    EXPECT_EQ(vertices[1].normal, glm::vec3(1, 0, 0));
}

TEST(GltfAccessorTest, DeclaredBoundsAreCompared) {
    EXPECT_TRUE(load(triangleGltf()).warnings.empty());
    Json gltf = triangleGltf();
    gltf["accessors"][0]["max"] = {1, 2, 0};
    EXPECT_TRUE(warns(load(gltf), "attributes.POSITION: min or max is not that of the data"));
    gltf["accessors"][0]["max"] = {0.9999999, 1, 0};
    EXPECT_TRUE(load(gltf).warnings.empty());
    // Declared in stored units, read as -1..1.
    gltf = triangleGltf();
    gltf["extensionsUsed"] = {"KHR_mesh_quantization"};
    attributesOf(gltf)["POSITION"] =
        addAccessor(gltf, bytesOf<std::int8_t>({-128, 0, 0, 127, 0, 0, 0, 127, 0}), 5120, "VEC3", 3);
    gltf["accessors"].back().update({{"normalized", true}, {"min", {-128, 0, 0}}, {"max", {127, 127, 0}}});
    EXPECT_TRUE(load(gltf).warnings.empty());
}

}  // namespace
}  // namespace dioptre
