// Small glTF files in which something moves or bends. The viewer stands at the origin and looks along -z.
#pragma once

#include "unit/scene_gltf_maker.hpp"

namespace dioptre::test {

/// Of 32-bit floats; returns the accessor's number.
inline std::size_t addFloats(Json& gltf, const std::vector<float>& values, const std::string& type) {
    const std::size_t components = type == "SCALAR" ? 1 : type == "MAT4" ? 16 : static_cast<std::size_t>(type[3] - '0');
    return addAccessor(gltf, bytesOf(values), 5126, type, values.size() / components);
}

/// An animation of its own with one channel; returns the animation's number.
inline std::size_t addAnimation(Json& gltf, std::size_t node, const std::string& path, const std::vector<float>& times,
                                const std::vector<float>& values, const std::string& interpolation = "LINEAR") {
    const std::string type = path == "rotation" ? "VEC4" : path == "weights" ? "SCALAR" : "VEC3";
    const std::size_t input = addFloats(gltf, times, "SCALAR"), output = addFloats(gltf, values, type);
    Json animation;
    animation["samplers"] = Json::array({{{"input", input}, {"output", output}, {"interpolation", interpolation}}});
    animation["channels"] = Json::array({{{"sampler", 0}, {"target", {{"node", node}, {"path", path}}}}});
    gltf["animations"].push_back(animation);
    return gltf["animations"].size() - 1;
}

/// A bar of width 0.2 m, from 0 to 1 m up, 4 m away, unlit white, its front towards the viewer, without normals. Node 0
/// has mesh and skin, and a translation that must not matter; node 1 is the joint at the lower end, node 2, its child,
/// the one in the middle, which turns: by 90 degrees to the left within 1 s and back within another.
/// Accessors: 0 positions, 1 joints, 2 weights, 3 indices, 4 inverse bind matrices, 5 times, 6 rotations.
inline Json bendingBarGltf() {
    Json gltf = {{"asset", {{"version", "2.0"}}}, {"extensionsUsed", {"KHR_materials_unlit"}}};
    addFloats(gltf, {-0.1f, 0, 0, 0.1f, 0, 0, -0.1f, 0.5f, 0, 0.1f, 0.5f, 0, -0.1f, 1, 0, 0.1f, 1, 0}, "VEC3");
    addAccessor(gltf, bytesOf<std::uint8_t>({0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}),
                5121, "VEC4", 6);
    addFloats(gltf, {1, 0, 0, 0, 1, 0, 0, 0, 0.5f, 0.5f, 0, 0, 0.5f, 0.5f, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
    addAccessor(gltf, bytesOf<std::uint16_t>({0, 1, 2, 1, 3, 2, 2, 3, 4, 3, 5, 4}), 5123, "SCALAR", 12);
    addFloats(gltf, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0,     0, 1,  // joint 1: as the mesh
                     1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -0.5f, 0, 1},
              "MAT4");
    gltf["materials"] = Json::parse(R"([{"extensions": {"KHR_materials_unlit": {}}}])");
    gltf["meshes"] = Json::parse(R"([{"primitives": [
        {"attributes": {"POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2}, "indices": 3, "material": 0}]}])");
    gltf["skins"] = Json::parse(R"([{"joints": [1, 2], "inverseBindMatrices": 4, "skeleton": 1}])");
    gltf["nodes"] = Json::parse(R"([{"mesh": 0, "skin": 0, "translation": [50, 0, 0]},
        {"name": "root", "children": [2], "translation": [0, 0, -4]}, {"name": "middle", "translation": [0, 0.5, 0]}])");
    gltf["scenes"] = Json::parse(R"([{"nodes": [0, 1]}])");
    const float half = 0.70710678f;
    addAnimation(gltf, 2, "rotation", {0, 1, 2}, {0, 0, 0, 1, 0, 0, half, half, 0, 0, 0, 1});
    return gltf;
}

/// A lit square of 1 m, 4 m away, with two morph targets: 0 moves it up by 0.25 m and turns its normals to the right,
/// 1 makes it wider by half. With `weights` those are the mesh's; else the square is the mesh that they lead to.
inline Json morphedSquareGltf(float up, float wide, bool morphed) {
    Json gltf = {{"asset", {{"version", "2.0"}}}};
    const std::vector<float> corners = {-0.5f, -0.5f, -4, 0.5f, -0.5f, -4, 0.5f, 0.5f, -4, -0.5f, 0.5f, -4};
    const std::vector<float> lift = {0, 0.25f, 0, 0, 0.25f, 0, 0, 0.25f, 0, 0, 0.25f, 0};
    const std::vector<float> widen = {-0.25f, 0, 0, 0.25f, 0, 0, 0.25f, 0, 0, -0.25f, 0, 0};
    const std::vector<float> turn = {0.5f, 0, 0, 0.5f, 0, 0, 0.5f, 0, 0, 0.5f, 0, 0};
    std::vector<float> positions = corners, normals = {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
    if (!morphed) {
        for (std::size_t i = 0; i < corners.size(); ++i) {
            positions[i] += up * lift[i] + wide * widen[i];
            normals[i] += up * turn[i];
        }
    }
    addFloats(gltf, positions, "VEC3");
    addFloats(gltf, normals, "VEC3");
    addAccessor(gltf, bytesOf<std::uint16_t>({0, 1, 2, 0, 2, 3}), 5123, "SCALAR", 6);
    gltf["materials"] = Json::parse(R"([{"pbrMetallicRoughness": {"metallicFactor": 0}}])");
    gltf["meshes"] =
        Json::parse(R"([{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1}, "indices": 2, "material": 0}]}])");
    gltf["nodes"] = Json::parse(R"([{"mesh": 0}])");
    gltf["scenes"] = Json::parse(R"([{"nodes": [0]}])");
    if (morphed) {
        addFloats(gltf, lift, "VEC3");
        addFloats(gltf, turn, "VEC3");
        addFloats(gltf, widen, "VEC3");
        gltf["meshes"][0]["primitives"][0]["targets"] =
            Json::parse(R"([{"POSITION": 3, "NORMAL": 4}, {"POSITION": 5}])");
        gltf["meshes"][0]["weights"] = {up, wide};
    }
    return gltf;
}

}  // namespace dioptre::test
