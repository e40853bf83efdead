// Two ways to write the same thing in glTF give the same picture: from the file to the pixels.
#include "gl_fixture.hpp"
#include "pictures.hpp"
#include "unit/scene_gltf_maker.hpp"

namespace dioptre {
namespace {

using namespace test;

/// From 2 m before the plane z = 0.
Image drawn(const Json& gltf) {
    Shot shot;
    shot.view.pose.position = {0.25, 0.25, 2.0};
    return draw(TechniqueChoice::pinhole, GpuScene(load(gltf)), shot);
}

/// A square of two triangles, with normals that lean, texture coordinates and colours, read through indices 0 1 2 0 2 3.
Json square() {
    Json gltf = texturedGltf();
    Json& primitive = gltf["meshes"][0]["primitives"][0];
    const std::size_t positions =
        addAccessor(gltf, bytesOf<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}), 5126, "VEC3", 4);
    const std::size_t normals =
        addAccessor(gltf, bytesOf<float>({0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 1, 0}), 5126, "VEC3", 4);
    const std::size_t uv = addAccessor(gltf, bytesOf<float>({0, 1, 1, 1, 1, 0, 0, 0}), 5126, "VEC2", 4);
    const std::size_t colors = addAccessor(gltf, bytesOf<float>({1, 1, 1, 1, 0, 0, 0, 1, 0, 1, 1, 0}), 5126, "VEC3", 4);
    const std::size_t indices = addAccessor(gltf, bytesOf<std::uint8_t>({0, 1, 2, 0, 2, 3}), 5121, "SCALAR", 6);
    primitive["attributes"] = {{"POSITION", positions}, {"NORMAL", normals}, {"TEXCOORD_0", uv}, {"COLOR_0", colors}};
    primitive["indices"] = indices;
    return gltf;
}

std::size_t normalized(Json& gltf, std::size_t accessor) {
    gltf["accessors"][accessor]["normalized"] = true;
    return accessor;
}

class GltfEncodingsGLTest : public GlTest {
  protected:
    static void expectSame(const Json& gltf, const std::string& what) {
        static const Image plain = drawn(square());
        const Worst worst = worstDifference(drawn(gltf), plain);
        // A triangle that begins at another corner rounds otherwise: one step of a half float.
        EXPECT_LT(worst.linear, 0.0006) << what << ": " << worst;
        EXPECT_GT(meanColor(plain, 0, 0, plain.width, plain.height).x, 0.01) << "nothing to see";
    }
};

TEST_F(GltfEncodingsGLTest, Interleaved) {
    Json gltf = square();
    Json& attributes = attributesOf(gltf);
    // Position and texture coordinates in turn, four bytes of nothing before each
    const std::vector<float> position{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, uv{0, 1, 1, 1, 1, 0, 0, 0};
    std::vector<float> both;
    for (std::size_t i = 0; i < 4; ++i) {
        both.push_back(9.0f);
        both.insert(both.end(), position.begin() + static_cast<std::ptrdiff_t>(3 * i),
                    position.begin() + static_cast<std::ptrdiff_t>(3 * i + 3));
        both.insert(both.end(), uv.begin() + static_cast<std::ptrdiff_t>(2 * i),
                    uv.begin() + static_cast<std::ptrdiff_t>(2 * i + 2));
    }
    const std::size_t view = addView(gltf, bytesOf(both));
    gltf["bufferViews"][view]["byteStride"] = 24;
    for (const auto& [semantic, offset] : {std::pair("POSITION", 4), std::pair("TEXCOORD_0", 16)}) {
        Json& accessor = gltf["accessors"][attributes[semantic].get<std::size_t>()];
        accessor["bufferView"] = view;
        accessor["byteOffset"] = offset;
    }
    expectSame(gltf, "interleaved");
}

TEST_F(GltfEncodingsGLTest, Sparse) {
    Json gltf = square();
    // Zeros, but for the corners that are elsewhere
    const std::size_t indices = addView(gltf, bytesOf<std::uint16_t>({1, 2, 3}));
    const std::size_t values = addView(gltf, bytesOf<float>({1, 0, 0, 1, 1, 0, 0, 1, 0}));
    Json& accessor = gltf["accessors"][attributesOf(gltf)["POSITION"].get<std::size_t>()];
    accessor.erase("bufferView");
    accessor["sparse"] = {{"count", 3},
                          {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
                          {"values", {{"bufferView", values}}}};
    expectSame(gltf, "sparse");
}

TEST_F(GltfEncodingsGLTest, NormalisedAndQuantised) {
    Json gltf = square();
    attributesOf(gltf)["COLOR_0"] = normalized(
        gltf,
        addAccessor(gltf, bytesOf<std::uint16_t>({65535, 65535, 65535, 65535, 0, 0, 0, 65535, 0, 65535, 65535, 0}),
                    5123, "VEC3", 4));
    attributesOf(gltf)["TEXCOORD_0"] =
        normalized(gltf, addAccessor(gltf, bytesOf<std::uint8_t>({0, 255, 255, 255, 255, 0, 0, 0}), 5121, "VEC2", 4));
    expectSame(gltf, "normalised");
    gltf["extensionsUsed"] = gltf["extensionsRequired"] = {"KHR_mesh_quantization"};
    // In 64ths, undone by the node
    attributesOf(gltf)["POSITION"] =
        addAccessor(gltf, bytesOf<std::int16_t>({0, 0, 0, 64, 0, 0, 64, 64, 0, 0, 64, 0}), 5122, "VEC3", 4);
    gltf["nodes"][0]["scale"] = {1.0 / 64.0, 1.0 / 64.0, 1.0 / 64.0};
    attributesOf(gltf)["NORMAL"] = normalized(
        gltf, addAccessor(gltf, bytesOf<std::int8_t>({0, 0, 127, 127, 0, 0, 0, 0, 127, 0, 127, 0}), 5120, "VEC3", 4));
    expectSame(gltf, "quantised");
}

TEST_F(GltfEncodingsGLTest, StripsFansAndBareVertices) {
    for (const auto& [mode, order] :
         {std::pair(4, std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}),
          std::pair(5, std::vector<std::uint32_t>{3, 0, 2, 1}), std::pair(6, std::vector<std::uint32_t>{0, 1, 2, 3})}) {
        Json gltf = square();
        Json& primitive = gltf["meshes"][0]["primitives"][0];
        const std::size_t indices = addAccessor(gltf, bytesOf(order), 5125, "SCALAR", order.size());
        primitive["indices"] = indices;
        primitive["mode"] = mode;
        expectSame(gltf, "mode " + std::to_string(mode));
    }
    Json gltf = square();
    gltf["meshes"][0]["primitives"][0]["mode"] = 6;
    gltf["meshes"][0]["primitives"][0].erase("indices");
    expectSame(gltf, "a fan without indices");
}

TEST_F(GltfEncodingsGLTest, MatricesAndMirroring) {
    Json gltf = square();
    gltf["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    expectSame(gltf, "a matrix");
    // Twice mirrored, by a scale and by a matrix of its parent
    gltf = square();
    gltf["nodes"][0]["scale"] = {-1, 1, 1};
    gltf["nodes"].push_back({{"children", {0}}, {"matrix", {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}});
    gltf["scenes"][0]["nodes"] = {1};
    expectSame(gltf, "mirrored twice");
    // Once mirrored, with the vertices mirrored too: fronts are still counter-clockwise in the mesh.
    gltf = square();
    gltf["nodes"][0]["scale"] = {-1, 1, 1};
    attributesOf(gltf)["POSITION"] =
        addAccessor(gltf, bytesOf<float>({0, 0, 0, -1, 0, 0, -1, 1, 0, 0, 1, 0}), 5126, "VEC3", 4);
    attributesOf(gltf)["NORMAL"] =
        addAccessor(gltf, bytesOf<float>({0, 0, 1, -1, 0, 0, 0, 0, 1, 0, 1, 0}), 5126, "VEC3", 4);
    gltf["meshes"][0]["primitives"][0]["indices"] =
        addAccessor(gltf, bytesOf<std::uint8_t>({0, 2, 1, 0, 3, 2}), 5121, "SCALAR", 6);
    expectSame(gltf, "mirrored vertices and node");
}

TEST_F(GltfEncodingsGLTest, SecondSetAndTransform) {
    Json gltf = square();
    Json& texture = gltf["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
    texture["texCoord"] = 1;
    attributesOf(gltf)["TEXCOORD_1"] = attributesOf(gltf)["TEXCOORD_0"];
    expectSame(gltf, "from the second set");
    // The vertices' v upside down, set right by the transform
    attributesOf(gltf)["TEXCOORD_0"] = addAccessor(gltf, bytesOf<float>({0, 0, 1, 0, 1, 1, 0, 1}), 5126, "VEC2", 4);
    texture["extensions"]["KHR_texture_transform"] = {{"texCoord", 0}, {"offset", {0, 1}}, {"scale", {1, -1}}};
    expectSame(gltf, "through a transform");
}

// 2 texels, red and blue, across three times their width.
TEST_F(GltfEncodingsGLTest, WrapModes) {
    for (const auto& [code, texels] :
         {std::pair(10497, "rbrbrb"), std::pair(33071, "rrrbbb"), std::pair(33648, "brrbbr")}) {
        Json gltf = square();
        gltf["materials"][0]["extensions"]["KHR_materials_unlit"] = Json::object();
        gltf["samplers"] = {{{"wrapS", code}, {"magFilter", 9728}, {"minFilter", 9728}}};
        gltf["textures"][0]["sampler"] = 0;
        attributesOf(gltf).erase("COLOR_0");
        attributesOf(gltf)["TEXCOORD_0"] =
            addAccessor(gltf, bytesOf<float>({-1, 1, 2, 1, 2, 0, -1, 0}), 5126, "VEC2", 4);
        const Image picture = drawn(gltf);
        // The middle of the picture is a quarter of the square from its left edge.
        const double width = focalLengthPixels(testView()).x / 2.0, left = 96.0 - width / 4.0;
        for (int i = 0; i < 6; ++i) {
            const glm::dvec3 seen = pixelAt(picture, static_cast<int>(left + width * (i + 0.5) / 6.0), 60);
            EXPECT_EQ(seen.x > seen.z, texels[i] == 'r') << code << ", texel " << i;
        }
    }
}

}  // namespace
}  // namespace dioptre
