// Animations, skins and morph targets as the loader reads them, and as it refuses them.
#include <cmath>
#include <functional>

#include "moving_scenes.hpp"
#include "scene/animation.hpp"
#include "scene/deformation.hpp"

namespace dioptre {
namespace {

using namespace test;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

Json& at(Json& gltf, const std::string& pointer) {
    return gltf[Json::json_pointer(pointer)];
}

void replaceData(Json& gltf, std::size_t buffer, const std::string& bytes) {
    gltf["buffers"][buffer] = {{"byteLength", bytes.size()}, {"uri", dataUri(bytes)}};
    gltf["bufferViews"][buffer]["byteLength"] = bytes.size();
}

struct Case {
    const char* name;
    std::function<void(Json&)> damage;
    const char* says;
};

void expectRefused(const std::function<Json()>& valid, const std::vector<Case>& cases) {
    EXPECT_EQ(refusal(valid()), "");
    for (const Case& c : cases) {
        SCOPED_TRACE(c.name);
        Json gltf = valid();
        c.damage(gltf);
        const std::string message = refusal(gltf);
        EXPECT_TRUE(contains(message, c.says)) << "says: " << message << "\nmust: " << c.says;
    }
}

const Primitive& onlyPrimitive(const Scene& scene) {
    return scene.meshes.at(0).primitives.at(0);
}

TEST(GltfMotionTest, ABendingBarIsReadWhole) {
    const Scene scene = load(bendingBarGltf());
    EXPECT_TRUE(scene.warnings.empty());
    ASSERT_TRUE(scene.motion);
    const Motion& motion = *scene.motion;
    ASSERT_EQ(motion.nodes.size(), 3u);
    EXPECT_EQ(motion.nodes[2].parent, 1);
    EXPECT_EQ(motion.nodes[0].parent, -1);
    ASSERT_EQ(motion.skins.size(), 1u);
    EXPECT_EQ(motion.skins[0].joints, (std::vector<std::size_t>{1, 2}));
    EXPECT_EQ(motion.skins[0].jointFromMesh[1][3], glm::vec4(0, -0.5f, 0, 1));
    ASSERT_EQ(motion.animations.size(), 1u);
    EXPECT_EQ(motion.animations[0].length, 2.0);
    EXPECT_EQ(scene.instances[0].skin, 0);
    EXPECT_EQ(scene.instances[0].node, 0);
    const Deformation& deformation = *onlyPrimitive(scene).deformation;
    EXPECT_TRUE(deformation.flat) << "the file has no normals";
    EXPECT_EQ(deformation.influencesPerVertex, 4u);
    EXPECT_EQ(deformation.influences.size(), 4 * onlyPrimitive(scene).vertices.size());
    // Quarter of a circle about z at the middle, at 1 s.
    const SkinPose skin = poseOf(motion.skins[0], poseAt(motion, 1.0));
    EXPECT_EQ(skin.origin, glm::dvec3(0, 0, -4));
    EXPECT_LT(glm::length(glm::vec3(skin.originFromMesh[1] * glm::vec4(0, 1, 0, 1)) - glm::vec3(-0.5f, 0.5f, 0)),
              1e-6f);
}

TEST(GltfMotionTest, StillScenesHaveNothingOfIt) {
    for (const Json& gltf : {triangleGltf(), morphedSquareGltf(0, 0, true)}) {
        const Scene scene = load(gltf);
        EXPECT_FALSE(scene.motion);
        EXPECT_FALSE(onlyPrimitive(scene).deformation) << "targets that nothing uses are not read";
        EXPECT_EQ(scene.instances[0].node, -1);
    }
    Json elsewhere = triangleGltf();
    elsewhere["nodes"].push_back(Json::object());
    addAnimation(elsewhere, 1, "translation", {0, 1}, {0, 0, 0, 1, 1, 1});
    EXPECT_FALSE(load(elsewhere).motion) << "what moves is not in the scene";
}

TEST(GltfMotionTest, AllTypesOfJointsAndWeightsMeanTheSame) {
    const Scene wanted = load(bendingBarGltf());
    const std::vector<std::uint16_t> joints = {0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
    for (const int type : {5121, 5123, 5126}) {
        SCOPED_TRACE(type);
        Json gltf = bendingBarGltf();
        gltf["accessors"][1]["componentType"] = 5123;
        replaceData(gltf, 1, bytesOf(joints));
        if (type != 5126) {
            const int most = type == 5121 ? 255 : 65535;
            std::vector<std::uint8_t> bytes;
            std::vector<std::uint16_t> shorts;
            for (const int x : {2, 0, 0, 0, 2, 0, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0}) {
                bytes.push_back(static_cast<std::uint8_t>(x * most / 2));
                shorts.push_back(static_cast<std::uint16_t>(x * most / 2));
            }
            gltf["accessors"][2]["componentType"] = type;
            gltf["accessors"][2]["normalized"] = true;
            replaceData(gltf, 2, type == 5121 ? bytesOf(bytes) : bytesOf(shorts));
        }
        const Scene scene = load(gltf);
        EXPECT_TRUE(scene.warnings.empty());
        const auto &got = onlyPrimitive(scene).deformation->influences,
                   &want = onlyPrimitive(wanted).deformation->influences;
        ASSERT_EQ(got.size(), want.size());
        for (std::size_t i = 0; i < got.size(); ++i) {
            EXPECT_EQ(got[i].joint, want[i].joint) << i;
            EXPECT_FLOAT_EQ(got[i].weight, want[i].weight) << i;
        }
    }
}

TEST(GltfMotionTest, EightInfluencesAVertex) {
    Json gltf = bendingBarGltf();
    attributesOf(gltf)["JOINTS_1"] = 1;
    attributesOf(gltf)["WEIGHTS_1"] = 2;
    const Scene scene = load(gltf);
    EXPECT_TRUE(warns(scene, "WEIGHTS_0: weights that do not add up to 1 are normalised"));
    const Deformation& deformation = *onlyPrimitive(scene).deformation;
    EXPECT_EQ(deformation.influencesPerVertex, 8u);
    EXPECT_EQ(deformation.influences[0].weight, 0.5f);
    EXPECT_EQ(deformation.influences[4].weight, 0.5f);
}

TEST(GltfMotionTest, WeightsAreMadeToAddUp) {
    Json gltf = bendingBarGltf();
    replaceData(gltf, 2, bytesOf<float>({2, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 1, 3, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}));
    const Scene scene = load(gltf);
    EXPECT_TRUE(warns(scene, "WEIGHTS_0: weights that do not add up to 1 are normalised"));
    EXPECT_TRUE(warns(scene, "WEIGHTS_0: vertices that no joint pulls follow the skin's first joint"));
    const Deformation& deformation = *onlyPrimitive(scene).deformation;
    for (std::size_t v = 0; v < deformation.influences.size(); v += 4) {
        float sum = 0.0f;
        for (std::size_t i = 0; i < 4; ++i) sum += deformation.influences[v + i].weight;
        EXPECT_FLOAT_EQ(sum, 1.0f);
    }
}

TEST(GltfMotionTest, WeightsOfTheNodeWinOverTheMeshs) {
    Json gltf = morphedSquareGltf(1, 0, true);
    EXPECT_EQ(load(gltf).motion->nodes[0].weights, (std::vector<float>{1, 0}));
    gltf["nodes"][0]["weights"] = {0.25f, 0.5f};
    const Scene scene = load(gltf);
    EXPECT_EQ(scene.motion->nodes[0].weights, (std::vector<float>{0.25f, 0.5f}));
    const Deformation& deformation = *onlyPrimitive(scene).deformation;
    EXPECT_FALSE(deformation.flat);
    ASSERT_EQ(deformation.targets.size(), 2u);
    EXPECT_EQ(deformation.targets[0].normals.size(), 4u);
    EXPECT_TRUE(deformation.targets[1].normals.empty());
}

TEST(GltfMotionTest, SparseTargets) {
    Json gltf = morphedSquareGltf(1, 0, true);
    const std::size_t places = addView(gltf, bytesOf<std::uint16_t>({2})),
                      values = addView(gltf, bytesOf<float>({7, 8, 9}));
    gltf["accessors"][3].erase("bufferView");
    gltf["accessors"][3]["sparse"] = {{"count", 1},
                                      {"indices", {{"bufferView", places}, {"componentType", 5123}}},
                                      {"values", {{"bufferView", values}}}};
    const Scene scene = load(gltf);
    EXPECT_EQ(onlyPrimitive(scene).deformation->targets[0].positions,
              (std::vector<glm::vec3>{{0, 0, 0}, {0, 0, 0}, {7, 8, 9}, {0, 0, 0}}));
}

TEST(GltfMotionTest, NormalisedKeysAndSharedSamplers) {
    Json gltf = triangleGltf();
    gltf["nodes"] = Json::parse(R"([{"mesh": 0}, {"mesh": 0}])");
    gltf["scenes"][0]["nodes"] = {0, 1};
    addAnimation(gltf, 0, "rotation", {0, 1}, {0, 0, 0, 1, 0, 0, 1, 0});
    gltf["accessors"].back()["componentType"] = 5120;
    gltf["accessors"].back()["normalized"] = true;
    replaceData(gltf, gltf["buffers"].size() - 1, bytesOf<std::int8_t>({0, 0, 0, 127, 0, 0, 90, 90}));
    gltf["animations"][0]["channels"].push_back({{"sampler", 0}, {"target", {{"node", 1}, {"path", "rotation"}}}});
    const Scene scene = load(gltf);
    EXPECT_TRUE(scene.warnings.empty());
    EXPECT_EQ(scene.motion->animations[0].curves.size(), 1u);
    const MotionPose pose = poseAt(*scene.motion, 0.5);
    EXPECT_EQ(pose.worldFromNode[0], pose.worldFromNode[1]);
    EXPECT_NEAR(pose.worldFromNode[0][0][0], std::cos(glm::radians(45.0)), 1e-6);
}

TEST(GltfMotionTest, PlacedAsAtTimeZero) {
    Json gltf = triangleGltf();
    gltf["cameras"] = Json::parse(R"([{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}])");
    gltf["extensions"] = Json::parse(R"({"KHR_lights_punctual": {"lights": [{"type": "point"}]}})");
    gltf["nodes"][0]["children"] = {1};
    gltf["nodes"].push_back(
        Json::parse(R"({"camera": 0, "translation": [0, 0, 1], "extensions": {"KHR_lights_punctual": {"light": 0}}})"));
    addAnimation(gltf, 0, "translation", {0, 1}, {5, 0, 0, 6, 0, 0});
    const Scene scene = load(gltf);
    EXPECT_EQ(scene.instances[0].worldFromMesh[3], glm::vec4(5, 0, 0, 1));
    EXPECT_EQ(scene.cameras[0].worldFromCamera[3], glm::vec4(5, 0, 1, 1));
    EXPECT_EQ(scene.lights[0].position, glm::vec3(5, 0, 1));
    EXPECT_EQ(scene.cameras[0].node, 1);
    EXPECT_EQ(scene.lights[0].node, 1);
}

TEST(GltfMotionTest, TheLaterOfTwoAnimationsWins) {
    Json gltf = triangleGltf();
    addAnimation(gltf, 0, "translation", {0, 1}, {5, 0, 0, 6, 0, 0});
    addAnimation(gltf, 0, "translation", {0, 1}, {0, 7, 0, 0, 8, 0});
    const Scene scene = load(gltf);
    EXPECT_TRUE(warns(scene, "animations[1]: drives what another animation drives, too: the later one is drawn"));
    EXPECT_EQ(scene.instances[0].worldFromMesh[3], glm::vec4(0, 7, 0, 1));
}

TEST(GltfRefusalTest, Animations) {
    const auto set = [](const char* pointer, const Json& value) {
        return [=](Json& gltf) { at(gltf, pointer) = value; };
    };
    const auto data = [](std::size_t buffer, const std::vector<float>& values) {
        return [=](Json& gltf) { replaceData(gltf, buffer, bytesOf(values)); };
    };
    expectRefused(
        bendingBarGltf,
        {
            {"a number", set("/animations", 3), "animations: is 3, must be an array"},
            {"no target", [](Json& g) { g["animations"][0]["channels"][0].erase("target"); },
             "animations[0].channels[0].target: is missing"},
            {"sampler", set("/animations/0/channels/0/sampler", 1),
             "animations[0].channels[0].sampler: is 1, but the file has 1 samplers"},
            {"node", set("/animations/0/channels/0/target/node", 3), "target.node: is 3, but the file has 3 nodes"},
            {"path", set("/animations/0/channels/0/target/path", "color"),
             "target.path: is \"color\", must be translation"},
            {"no path", [](Json& g) { g["animations"][0]["channels"][0]["target"].erase("path"); },
             "target.path: is \"\""},
            {"no targets", set("/animations/0/channels/0/target/path", "weights"),
             "target.path: is \"weights\", but the mesh of node 2 has no targets"},
            {"interpolation", set("/animations/0/samplers/0/interpolation", "QUINTIC"),
             "animations[0].samplers[0].interpolation: is \"QUINTIC\", must be STEP, LINEAR or CUBICSPLINE"},
            {"input", set("/animations/0/samplers/0/input", 99), "samplers[0].input: is 99"},
            {"no input", [](Json& g) { g["animations"][0]["samplers"][0].erase("input"); },
             "samplers[0].input: is missing"},
            {"input's type", set("/animations/0/samplers/0/input", 6),
             "samplers[0].input: is FLOAT VEC4, must be FLOAT SCALAR"},
            {"output's type", set("/animations/0/samplers/0/output", 0),
             "samplers[0].output: is FLOAT VEC3, for rotation it must be FLOAT VEC4 or normalized integers"},
            {"output for a move", set("/animations/0/channels/0/target/path", "scale"),
             "samplers[0].output: is FLOAT VEC4, for scale it must be FLOAT VEC3"},
            {"too few outputs", set("/accessors/6/count", 2),
             "samplers[0].output: has 2 elements, but 1 for each of 3 keys are needed"},
            {"a spline's", set("/animations/0/samplers/0/interpolation", "CUBICSPLINE"),
             "samplers[0].output: has 3 elements, but 3 for each of 3 keys are needed"},
            {"past its buffer", set("/accessors/5/count", 9), "reads 24 bytes past bufferView 5 (12 bytes)"},
            {"times equal", data(5, {0, 1, 1}), "samplers[0].input: key 2 is 1 s after 1 s, times must increase"},
            {"times back", data(5, {0, 2, 1}), "input: key 2 is 1 s after 2 s"},
            {"before 0", data(5, {-1, 1, 2}), "input: key 0 is -1 s, must be finite and not negative"},
            {"never", data(5, {0, 1, kInfinity}), "input: key 2 is inf s"},
            {"time NaN", data(5, {0, std::nanf(""), 2}), "input: key 1 is nan s"},
            {"value NaN", data(6, {0, 0, 0, 1, 0, 0, std::nanf(""), 1, 0, 0, 0, 1}),
             "output: element 1 is nan, must be finite"},
            {"no rotation", data(6, {0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 1}),
             "output: element 1 is 0 0 0 0, must be a unit quaternion"},
            {"twice", [](Json& g) { g["animations"][0]["channels"].push_back(g["animations"][0]["channels"][0]); },
             "animations[0].channels[1].target.path: node 2 has its rotation driven by another channel"},
            {"a matrix",
             [](Json& g) {
                 g["nodes"][2] = {{"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}};
             },
             "target.node: node 2 has a matrix, its rotation cannot be driven"},
            {"to infinity",
             [](Json& g) {
                 addAnimation(g, 1, "scale", {0, 1}, {1, 1, 1, 1e30f, 1, 1});
                 addAnimation(g, 2, "translation", {0, 1}, {1, 1, 1, 1, 1e20f, 1});
             },
             "nodes[2]: reaches 1e+50 m from the origin at some time, the limit is 3.4e+38"},
            {"overshoots",
             [](Json& g) {
                 addAnimation(g, 1, "translation", {0, 1e5f},
                              {0, 0, 0, 0, 0, 0, 3e38f, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, "CUBICSPLINE");
             },
             "nodes[1]: reaches 8.89e+42 m"},
        });
}

TEST(GltfRefusalTest, Skins) {
    const auto set = [](const char* pointer, const Json& value) {
        return [=](Json& gltf) { at(gltf, pointer) = value; };
    };
    expectRefused(
        bendingBarGltf,
        {
            {"skin", set("/nodes/0/skin", 1), "nodes[0].skin: is 1, but the file has 1 skins"},
            {"no joints", [](Json& g) { g["skins"][0].erase("joints"); }, "skins[0].joints: is missing or empty"},
            {"joint", set("/skins/0/joints/1", 3), "skins[0].joints[1]: is 3, but the file has 3 nodes"},
            {"joint twice", set("/skins/0/joints/1", 1), "skins[0].joints[1]: node 1 is listed twice"},
            {"skeleton", set("/skins/0/skeleton", 3), "skins[0].skeleton: is 3"},
            {"joint elsewhere",
             [](Json& g) {
                 g["nodes"].push_back(Json::object());
                 g["skins"][0]["joints"][1] = 3;
             },
             "skins[0].joints: node 3 is not in the scene"},
            {"matrices", set("/skins/0/inverseBindMatrices", 77), "skins[0].inverseBindMatrices: is 77"},
            {"matrices' type", set("/skins/0/inverseBindMatrices", 0), "is FLOAT VEC3, must be FLOAT MAT4"},
            {"too few matrices", set("/accessors/4/count", 1), "inverseBindMatrices: has 1 elements for 2 joints"},
            {"not affine",
             [](Json& g) {
                 std::vector<float> m(32, 0.0f);
                 replaceData(g, 4, bytesOf(m));
             },
             "inverseBindMatrices: element 0 has the last row 0 0 0 0, must be 0 0 0 1"},
            {"infinite",
             [](Json& g) {
                 std::vector<float> m(32, kInfinity);
                 replaceData(g, 4, bytesOf(m));
             },
             "inverseBindMatrices: element 0 has inf, must be finite"},
            {"matrices to infinity",
             [](Json& g) {
                 std::vector<float> m = {1e30f, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
                 m.insert(m.end(), m.begin(), m.begin() + 16);
                 replaceData(g, 4, bytesOf(m));
                 addAnimation(g, 1, "scale", {0, 1}, {1, 1, 1, 1e20f, 1, 1});
             },
             "reaches 1e+50 m"},
            {"joints' type", set("/accessors/1/componentType", 5120), "JOINTS_0: is BYTE VEC4, must be UNSIGNED_BYTE"},
            {"joints' numbers", set("/accessors/1/normalized", true), "JOINTS_0: is normalized UNSIGNED_BYTE VEC4"},
            {"weights' type", set("/meshes/0/primitives/0/attributes/WEIGHTS_0", 1),
             "WEIGHTS_0: is UNSIGNED_BYTE VEC4, must be FLOAT or normalized"},
            {"no weights", [](Json& g) { attributesOf(g).erase("WEIGHTS_0"); }, "JOINTS_0: has no WEIGHTS_0"},
            {"a gap",
             [](Json& g) {
                 attributesOf(g)["JOINTS_2"] = 1;
                 attributesOf(g)["WEIGHTS_2"] = 2;
             },
             "JOINTS_2: has no WEIGHTS_2, or a number before it is missing"},
            {"joint 2 of 2",
             [](Json& g) {
                 replaceData(g, 1, bytesOf<std::uint8_t>({0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0,
                                                          0, 1, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0}));
             },
             "attributes.JOINTS_0: element 5 is 2, but skins[0] has 2 joints"},
            {"negative weight",
             [](Json& g) {
                 replaceData(g, 2, bytesOf<float>({1, 0, 0, 0, 1.5f, -0.5f, 0, 0, 1, 0, 0, 0,
                                                   1, 0, 0, 0, 1,    0,     0, 0, 1, 0, 0, 0}));
             },
             "WEIGHTS_0: element 1 is -0.5, must be finite and not negative"},
            {"weight NaN", [](Json& g) { replaceData(g, 2, bytesOf(std::vector<float>(24, std::nanf("")))); },
             "WEIGHTS_0: element 0 is nan"},
            {"a cycle", set("/nodes/2/children", {1}), "nodes[2].children: lead back to the node itself"},
        });
}

TEST(GltfRefusalTest, MorphTargets) {
    const auto set = [](const char* pointer, const Json& value) {
        return [=](Json& gltf) { at(gltf, pointer) = value; };
    };
    const auto animated = [] {
        Json gltf = morphedSquareGltf(0, 0, true);
        addAnimation(gltf, 0, "weights", {0, 1}, {0, 0, 1, 1});
        return gltf;
    };
    EXPECT_TRUE(load(animated()).motion);
    expectRefused(
        animated,
        {
            {"a number", set("/meshes/0/primitives/0/targets/0", 1), "targets[0]: is 1, must be an object"},
            {"accessor", set("/meshes/0/primitives/0/targets/0/POSITION", 99), "targets[0].POSITION: is 99"},
            {"type", set("/accessors/5/type", "VEC2"), "targets[1].POSITION: is FLOAT VEC2, must be FLOAT VEC3"},
            {"count", set("/accessors/5/count", 3), "targets[1].POSITION: has 3 elements, the primitive 4 vertices"},
            {"NaN", [](Json& g) { replaceData(g, 4, bytesOf(std::vector<float>(12, std::nanf("")))); },
             "targets[0].NORMAL: element 0 is nan, must be finite"},
            {"mesh's weights", set("/meshes/0/weights", {1}),
             "meshes[0].weights: is an array of 1, must be an array of 2 numbers"},
            {"node's weights", set("/nodes/0/weights", {1, 2, 3}),
             "nodes[0].weights: is an array of 3, must be an array of 2"},
            {"weight a text", set("/nodes/0/weights", {1, "x"}),
             "nodes[0].weights[1]: is \"x\", must be a finite number"},
            {"too few keys", [](Json& g) { g["accessors"].back()["count"] = 3; },
             "output: has 3 elements, but 2 for each of 2 keys are needed"},
            {"primitives differ",
             [](Json& g) {
                 g["meshes"][0]["primitives"].push_back(g["meshes"][0]["primitives"][0]);
                 g["meshes"][0]["primitives"][1]["targets"].erase(1);
             },
             "meshes[0].primitives[1].targets: has 1, the mesh's first primitive 2"},
            {"quantized", [](Json& g) { g["accessors"][5]["componentType"] = 5120; },
             "targets[1].POSITION: is BYTE, which needs KHR_mesh_quantization"},
        });
    Json overshoots = morphedSquareGltf(0, 0, true);
    addAnimation(overshoots, 0, "weights", {0, 1e6f}, {0, 0, 0, 0, 3e38f, 0, 0, 0, 0, 0, 0, 0}, "CUBICSPLINE");
    EXPECT_TRUE(contains(refusal(overshoots), "nodes[0].weights: reach 8.89e+43 at some time")) << refusal(overshoots);
    Json far = animated();
    replaceData(far, 3, bytesOf(std::vector<float>(12, 3e38f)));
    EXPECT_TRUE(contains(refusal(far), "nodes[0]: reaches")) << refusal(far);
}

/// As many nodes in all that have mesh 0.
Json repeated(Json gltf, std::size_t count) {
    for (std::size_t i = 1; i < count; ++i) {
        gltf["nodes"].push_back({{"mesh", 0}});
        gltf["scenes"][0]["nodes"].push_back(i);
    }
    return gltf;
}

// Each has vertices and weights of its own: a small file could ask for much.
TEST(GltfMotionTest, WhatEachInstanceBendsCounts) {
    LoadLimits limits;
    limits.maxTotalBytes = 1'000'000;
    EXPECT_EQ(refusal(repeated(morphedSquareGltf(0.5f, 0.5f, false), 2000), limits), "");
    const std::string bent = refusal(repeated(morphedSquareGltf(0.5f, 0.5f, true), 2000), limits);
    EXPECT_TRUE(contains(bent, "nodes[")) << bent;
    EXPECT_TRUE(contains(bent, "bytes are in use")) << bent;

    Json targets = morphedSquareGltf(0.5f, 0.5f, true);
    std::vector<float> weights(3000, 0.0f);
    weights[0] = 1.0f;
    targets["meshes"][0]["weights"] = weights;
    for (std::size_t i = 2; i < weights.size(); ++i)
        targets["meshes"][0]["primitives"][0]["targets"].push_back(Json::object());
    limits.maxTotalBytes = 20'000'000;
    EXPECT_EQ(refusal(targets, limits), "");
    const std::string many = refusal(repeated(targets, 2000), limits);
    EXPECT_TRUE(contains(many, "bytes are in use")) << many;
}

}  // namespace
}  // namespace dioptre
