// Damaged glTF: each case changes one thing in a valid triangle and names what the refusal must say.
#include <cmath>
#include <functional>

#include "scene_gltf_maker.hpp"

namespace dioptre {
namespace {

using namespace test;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

struct Case {
    const char* name;
    std::function<void(Json&)> damage;
    const char* says;
};

// The edits that most cases consist of.
std::function<void(Json&)> set(const std::string& pointer, Json value) {
    return [=](Json& gltf) { gltf[Json::json_pointer(pointer)] = value; };
}
std::function<void(Json&)> remove(const std::string& pointer) {
    return [=](Json& gltf) {
        const Json::json_pointer at(pointer);
        gltf[at.parent_pointer()].erase(at.back());
    };
}
std::function<void(Json&)> replaceData(int buffer, const std::string& bytes) {
    return set("/buffers/" + std::to_string(buffer) + "/uri", dataUri(bytes));
}

void expectRefused(const std::vector<Case>& cases, const std::function<Json()>& valid = triangleGltf) {
    EXPECT_EQ(refusal(valid()), "");
    for (const Case& c : cases) {
        SCOPED_TRACE(c.name);
        Json gltf = valid();
        c.damage(gltf);
        const std::string message = refusal(gltf);
        EXPECT_TRUE(contains(message, c.says)) << "says: " << message << "\nmust: " << c.says;
    }
}

TEST(GltfRefusalTest, Asset) {
    expectRefused({
        {"no asset", remove("/asset"), "asset: is missing"},
        {"asset a number", set("/asset", 3), "asset: is 3, must be an object"},
        {"version 1.0", set("/asset/version", "1.0"), "asset.version: is 1.0, only 2.x"},
        {"version a number", set("/asset/version", 2.0), "asset.version: is 2.0, must be a text"},
        {"version a word", set("/asset/version", "two"), "asset.version: is \"two\""},
        {"version too long", set("/asset/version", "2.99999999999"), "asset.version"},
        {"no version", remove("/asset/version"), "asset.version"},
        {"needs 2.1", set("/asset/minVersion", "2.1"), "asset.minVersion: is 2.1"},
        {"Draco", set("/extensionsRequired", {"KHR_draco_mesh_compression"}), "re-export without compression"},
        {"meshopt", set("/extensionsRequired", {"EXT_meshopt_compression"}), "re-export without compression"},
        {"BasisU", set("/extensionsRequired", {"KHR_texture_basisu"}), "re-export with PNG or JPEG textures"},
        {"WebP", set("/extensionsRequired", {"EXT_texture_webp"}), "re-export with PNG or JPEG textures"},
        {"unknown", set("/extensionsRequired", {"X\ny"}), "extensionsRequired[0]: X\\x0ay is not supported"},
        {"not a list", set("/extensionsRequired", "X"), "extensionsRequired: is \"X\", must be an array"},
        {"not names", set("/extensionsUsed", {1}), "extensionsUsed[0]: is 1, must be a text"},
    });
}

TEST(GltfRefusalTest, Buffers) {
    expectRefused({
        {"buffers an object", set("/buffers", Json::object()), "buffers: is an object, must be an array"},
        {"buffer a text", set("/buffers/0", "x"), "buffers[0]: is \"x\", must be an object"},
        {"no length", remove("/buffers/0/byteLength"), "buffers[0].byteLength: is missing"},
        {"negative length", set("/buffers/0/byteLength", -36), "buffers[0].byteLength: is -36"},
        {"too long", set("/buffers/0/byteLength", 40), "buffers[0].byteLength: is 40, but its data has 36 bytes"},
        {"no uri", remove("/buffers/0/uri"), "buffers[0].uri: is missing"},
        {"uri a number", set("/buffers/0/uri", 1), "buffers[0].uri: is 1, must be a text"},
        {"not base64", set("/buffers/0/uri", "data:;base64,####"), "buffers[0].uri: \"#\" is no base64 digit"},
        {"base64 cut", set("/buffers/0/uri", "data:;base64,AAAAA"), "base64 data cut short"},
        {"no comma", set("/buffers/0/uri", "data:;base64"), "a data URI without a comma"},
        {"view's buffer", set("/bufferViews/1/buffer", 4), "bufferViews[1].buffer: is 4, but the file has 4 buffers"},
        {"view without buffer", remove("/bufferViews/1/buffer"), "bufferViews[1].buffer: is missing"},
        {"view past buffer", set("/bufferViews/1/byteLength", 40), "bufferViews[1]: reaches 4 bytes past buffer 1"},
        {"view offset", set("/bufferViews/1/byteOffset", 1),
         "bufferViews[1]: reaches 1 bytes past buffer 1 (36 bytes)"},
        {"view offset huge", set("/bufferViews/1/byteOffset", 1ull << 63), "bufferViews[1].byteOffset: is 922337"},
        {"view offset 2^53", set("/bufferViews/1/byteOffset", 1ull << 53), "past buffer 1"},
        {"stride small", set("/bufferViews/0/byteStride", 3), "bufferViews[0].byteStride: is 3, must be 4 to 252"},
        {"stride large", set("/bufferViews/0/byteStride", 256), "bufferViews[0].byteStride: is 256, must be 4 to 252"},
        {"stride not whole", set("/bufferViews/0/byteStride", 12.5), "byteStride: is 12.5, must be a whole number"},
    });
}

TEST(GltfRefusalTest, Accessors) {
    expectRefused({
        {"view index", set("/accessors/0/bufferView", 9), "accessors[0].bufferView: is 9"},
        {"view negative", set("/accessors/0/bufferView", -1), "accessors[0].bufferView: is -1"},
        {"no count", remove("/accessors/0/count"), "accessors[0].count: is missing"},
        {"count 0", set("/accessors/0/count", 0), "accessors[0].count: is 0"},
        {"count 2^31", set("/accessors/0/count", 1u << 31), "accessor 0 reads 25769803740 bytes past bufferView 0"},
        {"count 2^53", set("/accessors/0/count", 1ull << 53), "bytes past bufferView 0 (36 bytes)"},
        {"offset past", set("/accessors/3/byteOffset", 2),
         "meshes[0].primitives[0].indices: accessor 3 reads 2 bytes past bufferView 3 (6 bytes)"},
        {"unaligned",
         [](Json& g) {
             g["accessors"][3]["byteOffset"] = 1;
             g["accessors"][3]["count"] = 2;
         },
         "accessor 3 starts at byte 1, not a multiple"},
        {"stride below element", set("/bufferViews/0/byteStride", 8), "accessor 0 has elements of 12 bytes"},
        {"stride not of components", set("/bufferViews/0/byteStride", 14), "a stride of 14"},
        {"INT", set("/accessors/3/componentType", 5124), "accessors[3].componentType: is 5124"},
        {"type unknown", set("/accessors/0/type", "VEC5"), "accessors[0].type: is \"VEC5\""},
        {"type missing", remove("/accessors/0/type"), "accessors[0].type"},
        {"type a number", set("/accessors/0/type", 3), "accessors[0].type: is 3, must be a text"},
        {"min of 2", set("/accessors/0/min", {0, 0}), "accessors[0].min: is an array of 2"},
        {"max not numbers", set("/accessors/0/max", {0, 0, "x"}), "accessors[0].max[2]: is \"x\""},
        {"max beyond a float", set("/accessors/0/max", {0, 0, 1e300}), "accessors[0].max[2]: is 1e+300"},
        {"nobody's",
         [](Json& g) {
             g["accessors"].push_back(g["accessors"][0]);
             g["accessors"][4]["count"] = 99;
         },
         "accessors[4]: reads 1152 bytes past bufferView 0"},
        {"sparse without values", set("/accessors/0/sparse", {{"count", 1}}),
         "accessors[0].sparse.indices: is missing"},
    });
}

Json sparseGltf() {
    Json gltf = triangleGltf();
    const std::size_t indices = addView(gltf, bytesOf<std::uint16_t>({0, 2}));
    const std::size_t values = addView(gltf, bytesOf<float>({0, 0, 0, 0, 1, 0}));
    gltf["accessors"][0]["sparse"] = {{"count", 2},
                                      {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
                                      {"values", {{"bufferView", values}}}};
    return gltf;
}

TEST(GltfRefusalTest, SparseAccessors) {
    expectRefused(
        {
            {"count", set("/accessors/0/sparse/count", 4), "accessors[0].sparse.count: is 4, must be 1 to 3"},
            {"more than the data", set("/accessors/0/sparse/count", 3), "sparse.indices reads 2 bytes past"},
            {"values past", set("/accessors/0/sparse/values/byteOffset", 4), "sparse.values reads 4 bytes past"},
            {"view", set("/accessors/0/sparse/values/bufferView", 77), "sparse.values.bufferView: is 77"},
            {"signed", set("/accessors/0/sparse/indices/componentType", 5122), "is SHORT, must be unsigned"},
            {"beyond", replaceData(4, bytesOf<std::uint16_t>({0, 3})), "sparse index 1 is 3, but it has 3 elements"},
            {"twice", replaceData(4, bytesOf<std::uint16_t>({2, 2})), "sparse index 1 is 2 after 2"},
        },
        sparseGltf);
}

TEST(GltfRefusalTest, Meshes) {
    expectRefused({
        {"no attributes", remove("/meshes/0/primitives/0/attributes"),
         "meshes[0].primitives[0].attributes: is missing"},
        {"primitives an object", set("/meshes/0/primitives", Json::object()), "meshes[0].primitives: is an object"},
        {"mode", set("/meshes/0/primitives/0/mode", 7), "meshes[0].primitives[0].mode: is 7, must be 0 to 6"},
        {"material", set("/meshes/0/primitives/0/material", 1), "material: is 1, but the file has 1 materials"},
        {"position index", set("/meshes/0/primitives/0/attributes/POSITION", 4),
         "meshes[0].primitives[0].attributes.POSITION: is 4, but the file has 4 accessors"},
        {"position VEC2", set("/meshes/0/primitives/0/attributes/POSITION", 2), "POSITION: is VEC2, must be VEC3"},
        {"control characters", [](Json& g) { attributesOf(g)["_A\n"] = 99; }, "attributes._A\\x0a: is 99"},
        {"uv VEC3", set("/meshes/0/primitives/0/attributes/TEXCOORD_0", 1), "TEXCOORD_0: is VEC3, must be VEC2"},
        {"counts differ", set("/accessors/2/count", 2), "elements, another attribute"},
        {"quantised", [](Json& g) { g["accessors"][0]["componentType"] = 5122; },
         "POSITION: is SHORT, which needs KHR_mesh_quantization"},
        {"positions of 32 bits", set("/accessors/0/componentType", 5125), "POSITION: is UNSIGNED_INT, must be FLOAT"},
        {"normals unsigned",
         [](Json& g) {
             g["extensionsUsed"] = {"KHR_mesh_quantization"};
             g["accessors"][1]["componentType"] = 5121;
         },
         "NORMAL: is UNSIGNED_BYTE, must be FLOAT"},
        {"indices index", set("/meshes/0/primitives/0/indices", 4), "primitives[0].indices: is 4"},
        {"indices signed", set("/accessors/3/componentType", 5122),
         "indices: is SHORT SCALAR, must be unsigned SCALAR"},
        {"indices float", set("/meshes/0/primitives/0/indices", 0), "indices: is FLOAT VEC3, must be unsigned SCALAR"},
        {"index too large", replaceData(3, bytesOf<std::uint16_t>({0, 1, 3})),
         "meshes[0].primitives[0].indices: index 2 is 3, but there are 3 vertices"},
        {"restart", replaceData(3, bytesOf<std::uint16_t>({0, 0xFFFF, 2})), "index 1 is 65535, the primitive restart"},
        {"position infinite", replaceData(0, bytesOf<float>({0, 0, 0, kInfinity, 0, 0, 0, 1, 0})),
         "POSITION: element 1 is inf, must be finite"},
        {"normal NaN", replaceData(1, bytesOf<float>({0, 0, 1, 0, 0, 1, 0, 0, std::nanf("")})), "NORMAL: element 2 is"},
        {"uv infinite", replaceData(2, bytesOf<float>({-kInfinity, 0, 0, 0, 0, 0})), "TEXCOORD_0: element 0 is -inf"},
        {"targets a number", set("/meshes/0/primitives/0/targets", 1), "primitives[0].targets: is 1, must be an array"},
        {"unused mesh",
         [](Json& g) {
             g["meshes"].push_back({{"primitives", {{{"attributes", {{"POSITION", 9}}}}}}});
         },
         "meshes[1].primitives[0].attributes.POSITION: is 9"},
    });
}

TEST(GltfRefusalTest, Nodes) {
    expectRefused({
        {"mesh", set("/nodes/0/mesh", 1), "nodes[0].mesh: is 1, but the file has 1 meshes"},
        {"mesh a text", set("/nodes/0/mesh", "a"), "nodes[0].mesh: is \"a\", must be an index of meshes"},
        {"camera", set("/nodes/0/camera", 0), "nodes[0].camera: is 0, but the file has 0 cameras"},
        {"skin", set("/nodes/0/skin", 0), "nodes[0].skin: is 0"},
        {"light", set("/nodes/0/extensions/KHR_lights_punctual/light", 0), "KHR_lights_punctual.light: is 0"},
        {"scene", set("/scene", 1), "scene: is 1, but the file has 1 scenes"},
        {"scene's node", set("/scenes/0/nodes", {1}), "scenes[0].nodes[0]: is 1, but the file has 1 nodes"},
        {"listed twice", set("/scenes/0/nodes", {0, 0}), "scenes[0].nodes[1]: node 0 is listed twice"},
        {"child", set("/nodes/0/children", {5}), "nodes[0].children[0]: is 5, but the file has 1 nodes"},
        {"own child", set("/nodes/0/children", {0}), "nodes[0].children: lead back to the node itself"},
        {"cycle", [](Json& g) { g["nodes"] = Json::parse(R"([{}, {"children": [2]}, {"children": [1]}])"); },
         ".children: lead back to the node itself"},
        {"two parents", [](Json& g) { g["nodes"] = Json::parse(R"([{"children": [2]}, {"children": [2]}, {}])"); },
         "nodes[1].children[0]: node 2 is a child of node 0 already"},
        {"not a root", [](Json& g) { g["nodes"] = Json::parse(R"([{}, {"children": [0]}])"); },
         "scenes[0].nodes[0]: node 0 is a child of node 1, not a root"},
        {"matrix of 15", set("/nodes/0/matrix", std::vector<int>(15, 1)), "nodes[0].matrix: is an array of 15"},
        {"matrix with null", set("/nodes/0/matrix", std::vector<Json>(16, nullptr)), "nodes[0].matrix[0]: is null"},
        {"projective", set("/nodes/0/matrix", {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}), "last row is 1 0 0 1"},
        {"scale beyond a float", set("/nodes/0/scale", {1, 1e39, 1}), "nodes[0].scale[1]: is 1e+39"},
        {"rotation zero", set("/nodes/0/rotation", {0, 0, 0, 0}), "nodes[0].rotation: is 0 0 0 0"},
        {"overflow",
         [](Json& g) {
             g["nodes"] =
                 Json::parse(R"([{"scale": [1e30, 1, 1], "children": [1]}, {"mesh": 0, "scale": [1e30, 1, 1]}])");
         },
         "nodes[1]: its transform in the world is not finite"},
        {"positions overflow",
         [](Json& g) {
             g["nodes"][0]["scale"] = {1e30, 1, 1};
             replaceData(0, bytesOf<float>({0, 0, 0, 1e30f, 0, 0, 0, 1, 0}))(g);
         },
         "nodes[0].mesh: lies at infinity"},
    });
}

TEST(GltfRefusalTest, DeepNodes) {
    Json gltf = triangleGltf();
    for (int i = 0; i < 600; ++i) gltf["nodes"][static_cast<std::size_t>(i)]["children"] = {i + 1};
    gltf["nodes"][600] = Json::object();
    EXPECT_TRUE(contains(refusal(gltf), "nodes[512]: lies 513 deep, the limit is 512"));
    LoadLimits limits;
    limits.maxNodeDepth = 601;
    EXPECT_EQ(refusal(gltf, limits), "");
}

TEST(GltfRefusalTest, MaterialsAndImages) {
    expectRefused(
        {
            {"texture index", set("/materials/0/pbrMetallicRoughness/baseColorTexture/index", 1),
             "materials[0].pbrMetallicRoughness.baseColorTexture.index: is 1, but the file has 1 textures"},
            {"no texture index", set("/materials/0/normalTexture", Json::object()), "normalTexture.index: is missing"},
            {"offset of 3",
             set("/materials/0/pbrMetallicRoughness/baseColorTexture/extensions",
                 Json::parse(R"({"KHR_texture_transform": {"offset": [0, 0, 0]}})")),
             "baseColorTexture.extensions.KHR_texture_transform.offset: is an array of 3, must be an array of 2"},
            {"occlusion index", set("/materials/0/occlusionTexture/index", 5), "occlusionTexture.index: is 5"},
            {"source", set("/textures/0/source", 1), "textures[0].source: is 1, but the file has 1 images"},
            {"sampler", set("/textures/0/sampler", 0), "textures[0].sampler: is 0, but the file has 0 samplers"},
            {"wrap", set("/samplers", Json::parse(R"([{"wrapS": 1}])")), "samplers[0].wrapS: is 1"},
            {"filter", set("/samplers", Json::parse(R"([{"magFilter": 9987}])")), "samplers[0].magFilter: is 9987"},
            {"colour of 3", set("/materials/0/pbrMetallicRoughness/baseColorFactor", {1, 1, 1}),
             "must be an array of 4"},
            {"alpha mode", set("/materials/0/alphaMode", "GLASS"), "materials[0].alphaMode: is \"GLASS\""},
            {"cutoff", set("/materials/0", {{"alphaMode", "MASK"}, {"alphaCutoff", -1}}), "alphaCutoff: is -1"},
            {"double-sided", set("/materials/0/doubleSided", 1), "doubleSided: is 1, must be true or false"},
            {"strength", set("/materials/0/extensions/KHR_materials_emissive_strength/emissiveStrength", -1),
             "emissiveStrength: is -1"},
            {"radiance", set("/materials/0", Json::parse(R"({"emissiveFactor": [1, 1, 1], "extensions": {
                "KHR_materials_emissive_strength": {"emissiveStrength": 1e39}}})")),
             "emissiveStrength: is 1e+39"},
            {"no source", remove("/images/0/uri"), "images[0]: has neither uri nor bufferView"},
            {"image view", set("/images/0", {{"bufferView", 4}, {"mimeType", "image/png"}}),
             "images[0].bufferView: is 4"},
            {"not an image", set("/images/0/uri", "data:image/png;base64,AAAA"), "images[0]: is neither PNG nor JPEG"},
            {"WebP", set("/images/0/uri", dataUri("RIFF....WEBP")), "re-export with PNG or JPEG"},
            {"PNG cut in header", set("/images/0/uri", std::string(kPng).substr(0, 50)), "damaged header"},
            {"PNG cut in data", set("/images/0/uri", std::string(kPng).substr(0, 82)), "images[0]: cannot be decoded"},
            {"JPEG without frame", set("/images/0/uri", dataUri("\xFF\xD8\xFF\xD9 0123456789")), "damaged header"},
            {"missing file", set("/images/0/uri", "none.png"), "images[0].uri: no such file"},
        },
        texturedGltf);
}

TEST(GltfRefusalTest, CamerasAndLights) {
    const auto valid = [] {
        Json gltf = triangleGltf();
        gltf["cameras"] = Json::parse(R"([{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}])");
        gltf["extensions"]["KHR_lights_punctual"]["lights"] = Json::parse(R"([{"type": "spot", "spot": {}}])");
        return gltf;
    };
    expectRefused(
        {
            {"type", set("/cameras/0/type", "fisheye"), "cameras[0].type: is \"fisheye\""},
            {"no perspective", remove("/cameras/0/perspective"), "cameras[0].perspective: is missing"},
            {"no yfov", remove("/cameras/0/perspective/yfov"), "cameras[0].perspective.yfov: is missing"},
            {"yfov 0", set("/cameras/0/perspective/yfov", 0), "yfov: is 0, must be above 0"},
            {"yfov pi", set("/cameras/0/perspective/yfov", 3.2), "yfov: is 3.2 rad, must be below pi"},
            {"znear", set("/cameras/0/perspective/znear", -1), "znear: is -1, must be above 0"},
            {"zfar", set("/cameras/0/perspective/zfar", 0.1), "zfar: is 0.1, must be above znear (0.1)"},
            {"light type", set("/extensions/KHR_lights_punctual/lights/0/type", "area"), "lights[0].type: is \"area\""},
            {"light range", set("/extensions/KHR_lights_punctual/lights/0/range", 0), "lights[0].range: is 0"},
            {"light colour", set("/extensions/KHR_lights_punctual/lights/0/color", {1, 1, -1}),
             "lights[0].color: has -1"},
            {"intensity", set("/extensions/KHR_lights_punctual/lights/0/intensity", -2), "lights[0].intensity: is -2"},
            {"no spot", remove("/extensions/KHR_lights_punctual/lights/0/spot"), "lights[0].spot: is missing"},
            {"outer", set("/extensions/KHR_lights_punctual/lights/0/spot/outerConeAngle", 2),
             "outerConeAngle: is 2 rad"},
            {"inner", set("/extensions/KHR_lights_punctual/lights/0/spot/innerConeAngle", 1),
             "innerConeAngle: is 1 rad"},
        },
        valid);
}

}  // namespace
}  // namespace dioptre
