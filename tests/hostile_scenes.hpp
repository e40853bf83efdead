// Scenes to damage: one small model that uses most of what glTF has, and every way of damaging it that the tests try.
#pragma once

#include <utility>

#include "unit/scene_gltf_maker.hpp"

namespace dioptre::test {

struct NamedFile {
    std::string name;   // what was done to it: "accessors/0/count: huge"
    std::string bytes;  // a .gltf, or where `name` starts with "GLB" a .glb
};

namespace hostile {

/// A square with every attribute, skinned and morphed; its positions are sparse.
inline void addSquare(Json& gltf) {
    const auto positions =
        addAccessor(gltf, bytesOf<float>({-1, -1, -2, 1, -1, -2, 1, 1, -2, 9, 9, 9}), 5126, "VEC3", 4);
    gltf["accessors"][positions]["min"] = {-1, -1, -2};
    gltf["accessors"][positions]["max"] = {1, 1, -2};
    gltf["accessors"][positions]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", addView(gltf, bytesOf<std::uint16_t>({3}))}, {"componentType", 5123}}},
        {"values", {{"bufferView", addView(gltf, bytesOf<float>({-1, 1, -2}))}}}};
    Json attributes = {{"POSITION", positions}};
    attributes["NORMAL"] = addAccessor(gltf, bytesOf<float>({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}), 5126, "VEC3", 4);
    attributes["TANGENT"] =
        addAccessor(gltf, bytesOf<float>({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}), 5126, "VEC4", 4);
    attributes["TEXCOORD_0"] = addAccessor(gltf, bytesOf<float>({0, 1, 1, 1, 1, 0, 0, 0}), 5126, "VEC2", 4);
    attributes["TEXCOORD_1"] =
        addAccessor(gltf, bytesOf<std::uint16_t>({0, 65535, 65535, 65535, 65535, 0, 0, 0}), 5123, "VEC2", 4);
    gltf["accessors"][attributes["TEXCOORD_1"].get<std::size_t>()]["normalized"] = true;
    attributes["COLOR_0"] = addAccessor(gltf, std::string(16, '\xC0'), 5121, "VEC4", 4);
    gltf["accessors"][attributes["COLOR_0"].get<std::size_t>()]["normalized"] = true;
    attributes["JOINTS_0"] = addAccessor(gltf, std::string("\0\1\0\0\0\1\0\0\0\1\0\0\0\1\0\0", 16), 5121, "VEC4", 4);
    std::vector<float> weights;
    for (int i = 0; i < 4; ++i) weights.insert(weights.end(), {0.5f, 0.5f, 0.0f, 0.0f});
    attributes["WEIGHTS_0"] = addAccessor(gltf, bytesOf<float>(weights), 5126, "VEC4", 4);
    const auto indices = addAccessor(gltf, bytesOf<std::uint16_t>({0, 1, 2, 0, 2, 3}), 5123, "SCALAR", 6);
    const auto lift = addAccessor(gltf, bytesOf<float>({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}), 5126, "VEC3", 4);
    gltf["accessors"][lift]["min"] = gltf["accessors"][lift]["max"] = {0, 0, 1};
    gltf["meshes"].push_back(
        {{"name", "square"},
         {"weights", {0.25}},
         {"primitives",
          {{{"attributes", attributes}, {"indices", indices}, {"material", 0}, {"targets", {{{"POSITION", lift}}}}}}}});
}

/// Points, lines, a strip and a fan of interleaved, quantised positions, with indices of 8 and 32 bits.
inline void addModes(Json& gltf) {
    std::string bytes;
    for (const std::vector<std::int16_t>& p :
         {std::vector<std::int16_t>{-1, -1, -3, 0}, {1, -1, -3, 0}, {-1, 1, -3, 0}, {1, 1, -3, 0}})
        bytes += bytesOf(p) + bytesOf<float>({0, 0, 1});
    const auto view = addView(gltf, bytes);
    gltf["bufferViews"][view]["byteStride"] = 20;
    gltf["bufferViews"][view]["target"] = 34962;
    const std::size_t positions = gltf["accessors"].size();
    gltf["accessors"].push_back({{"bufferView", view},
                                 {"componentType", 5122},
                                 {"type", "VEC3"},
                                 {"count", 4},
                                 {"min", {-1, -1, -3}},
                                 {"max", {1, 1, -3}}});
    gltf["accessors"].push_back(
        {{"bufferView", view}, {"byteOffset", 8}, {"componentType", 5126}, {"type", "VEC3"}, {"count", 4}});
    const auto bytesIndices = addAccessor(gltf, std::string("\0\1\2\3", 4), 5121, "SCALAR", 4);
    const auto wordIndices = addAccessor(gltf, bytesOf<std::uint32_t>({0, 1, 3, 2}), 5125, "SCALAR", 4);
    Json primitives = Json::array();
    for (int mode = 0; mode <= 6; ++mode) {
        Json primitive = {
            {"attributes", {{"POSITION", positions}, {"NORMAL", positions + 1}}}, {"mode", mode}, {"material", 1}};
        if (mode == 5) primitive["indices"] = bytesIndices;
        if (mode == 6) primitive["indices"] = wordIndices;
        primitives.push_back(primitive);
    }
    gltf["meshes"].push_back({{"primitives", primitives}});
}

inline void addMaterials(Json& gltf) {
    gltf["images"] = Json::array({{{"uri", kPng}, {"name", "two"}}});
    const std::string uri(kPng);
    gltf["images"].push_back(
        {{"bufferView", addView(gltf, decodedBase64(uri.substr(uri.find(',') + 1)))}, {"mimeType", "image/png"}});
    gltf["samplers"] = Json::parse(R"([{"wrapS": 33071, "wrapT": 33648, "magFilter": 9728, "minFilter": 9984}, {}])");
    gltf["textures"] = Json::parse(R"([{"source": 0, "sampler": 0}, {"source": 1, "sampler": 1}])");
    gltf["materials"] = Json::parse(R"([
        {"name": "lit", "doubleSided": true, "alphaMode": "MASK", "alphaCutoff": 0.25,
         "pbrMetallicRoughness": {"baseColorFactor": [1, 0.5, 0.5, 1], "metallicFactor": 0.5, "roughnessFactor": 0.5,
             "baseColorTexture": {"index": 0, "texCoord": 0, "extensions": {"KHR_texture_transform":
                 {"offset": [0.5, 0], "rotation": 0.1, "scale": [2, 2], "texCoord": 0}}},
             "metallicRoughnessTexture": {"index": 1}},
         "normalTexture": {"index": 1, "scale": 0.5}, "occlusionTexture": {"index": 1, "strength": 0.5},
         "emissiveTexture": {"index": 0}, "emissiveFactor": [0.1, 0, 0],
         "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 2}}},
        {"name": "unlit", "alphaMode": "BLEND", "pbrMetallicRoughness": {"baseColorFactor": [0, 1, 0, 0.5]},
         "extensions": {"KHR_materials_unlit": {}}}])");
}

inline void addAnimation(Json& gltf) {
    const auto times = addAccessor(gltf, bytesOf<float>({0, 1}), 5126, "SCALAR", 2);
    gltf["accessors"][times]["min"] = {0};
    gltf["accessors"][times]["max"] = {1};
    const auto moves = addAccessor(gltf, bytesOf<float>({0, 0, 0, 0, 1, 0}), 5126, "VEC3", 2);
    const auto turns = addAccessor(gltf, bytesOf<float>({0, 0, 0, 1, 0, 0.6f, 0, 0.8f}), 5126, "VEC4", 2);
    const auto weights = addAccessor(gltf, bytesOf<float>({0, 0, 0, 0, 1, 0}), 5126, "SCALAR", 6);
    const auto sampler = [&](std::size_t output, const char* interpolation) {
        return Json{{"input", times}, {"output", output}, {"interpolation", interpolation}};
    };
    gltf["animations"] =
        Json::array({{{"name", "all"},
                      {"samplers", {sampler(moves, "LINEAR"), sampler(turns, "STEP"), sampler(weights, "CUBICSPLINE")}},
                      {"channels", Json::parse(R"([
        {"sampler": 0, "target": {"node": 3, "path": "translation"}},
        {"sampler": 1, "target": {"node": 3, "path": "rotation"}},
        {"sampler": 2, "target": {"node": 1, "path": "weights"}}])")}}});
    std::vector<float> matrices;
    for (int joint = 0; joint < 2; ++joint)
        for (int i = 0; i < 16; ++i) matrices.push_back(i % 5 == 0 ? 1.0f : 0.0f);
    gltf["skins"] = Json::array({{{"joints", {2, 3}},
                                  {"skeleton", 2},
                                  {"inverseBindMatrices", addAccessor(gltf, bytesOf(matrices), 5126, "MAT4", 2)}}});
}

}  // namespace hostile

/// Draws a textured square before a camera. Valid; each buffer has one view, so that damage to it has one effect.
inline Json everythingGltf() {
    Json gltf = {{"asset", {{"version", "2.0"}, {"minVersion", "2.0"}, {"generator", "tests"}}}};
    gltf["extensionsUsed"] = {"KHR_materials_unlit",   "KHR_materials_emissive_strength", "KHR_lights_punctual",
                              "KHR_mesh_quantization", "KHR_texture_transform",           "EXT_nobody_knows"};
    gltf["extensionsRequired"] = {"KHR_mesh_quantization"};
    hostile::addSquare(gltf);
    hostile::addModes(gltf);
    hostile::addMaterials(gltf);
    hostile::addAnimation(gltf);
    gltf["cameras"] = Json::parse(R"([
        {"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1, "zfar": 100, "aspectRatio": 1.5}},
        {"type": "orthographic", "orthographic": {"xmag": 1, "ymag": 1, "znear": 0.1, "zfar": 10}}])");
    gltf["extensions"]["KHR_lights_punctual"]["lights"] = Json::parse(R"([
        {"type": "spot", "color": [1, 0.9, 0.8], "intensity": 3, "range": 10,
         "spot": {"innerConeAngle": 0.2, "outerConeAngle": 0.6}}, {"type": "directional"}])");
    gltf["nodes"] = Json::parse(R"([
        {"name": "root", "children": [1, 2, 4, 5, 6], "scale": [1, 1, 1]},
        {"name": "square", "mesh": 0, "skin": 0, "weights": [0.5]},
        {"name": "joint", "children": [3], "translation": [0, 0, 0]},
        {"translation": [0, 0, 0], "rotation": [0, 0, 0, 1]},
        {"name": "modes", "mesh": 1, "matrix": [-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]},
        {"camera": 0, "extensions": {"KHR_lights_punctual": {"light": 0}}},
        {"camera": 1, "extensions": {"KHR_lights_punctual": {"light": 1}}}])");
    gltf["scenes"] = Json::parse(R"([{"name": "scene", "nodes": [0]}])");
    gltf["scene"] = 0;
    return gltf;
}

/// The same with all its buffers in one, as a binary file.
inline std::string asGlb(Json gltf) {
    std::string binary;
    for (Json& view : gltf["bufferViews"]) {
        const auto uri = gltf["buffers"][view["buffer"].get<std::size_t>()]["uri"].get<std::string>();
        view["buffer"] = 0;
        view["byteOffset"] = binary.size();
        binary += decodedBase64(uri.substr(uri.find(',') + 1));
        binary.resize((binary.size() + 3) / 4 * 4);
    }
    gltf["buffers"] = Json::array({{{"byteLength", binary.size()}}});
    const std::string chunks = glbChunk(kJsonChunk, gltf.dump(), ' ') + glbChunk(kBinaryChunk, binary, '\0');
    return glbHeader(2, static_cast<std::uint32_t>(12 + chunks.size())) + chunks;
}

/// What may stand in place of a value: of another type, negated, huge, cut.
inline std::vector<std::pair<std::string, Json>> damagedValues(const Json& value) {
    std::vector<std::pair<std::string, Json>> out = {{"null", nullptr}};
    if (value.is_number()) {
        const double number = value.get<double>();
        out.insert(out.end(), {{"a text", "1"},
                               {"negated", number == 0.0 ? -1.0 : -number},
                               {"huge", 1e30},
                               {"2^32", 1ull << 32},
                               {"2^31 - 1", (1u << 31) - 1},
                               {"one more", number + 1},
                               {"zero", 0},
                               {"half more", number + 0.5}});
    } else if (value.is_string()) {
        const auto& text = value.get_ref<const std::string&>();
        out.insert(out.end(), {{"a number", 7},
                               {"cut", text.substr(0, text.size() / 2)},
                               {"empty", ""},
                               {"long", text + std::string(5000, 'A')}});
    } else if (value.is_boolean()) {
        out.insert(out.end(), {{"a text", "true"}, {"negated", !value.get<bool>()}});
    } else if (value.is_array()) {
        Json cut = value, twice = value;
        if (!cut.empty()) cut.erase(cut.size() - 1);
        for (const Json& item : value) twice.push_back(item);
        out.insert(out.end(),
                   {{"an object", Json::object()}, {"empty", Json::array()}, {"cut", cut}, {"twice", twice}});
    } else if (value.is_object()) {
        out.insert(out.end(), {{"an array", Json::array()}, {"empty", Json::object()}, {"a number", -1}});
    }
    return out;
}

/// Pointers to every value in it, itself left out.
inline std::vector<Json::json_pointer> placesIn(const Json& json, const Json::json_pointer& at = Json::json_pointer()) {
    std::vector<Json::json_pointer> places;
    const auto add = [&](const Json::json_pointer& place, const Json& value) {
        places.push_back(place);
        const auto inside = placesIn(value, place);
        places.insert(places.end(), inside.begin(), inside.end());
    };
    if (json.is_object())
        for (const auto& [key, value] : json.items()) add(at / key, value);
    if (json.is_array())
        for (std::size_t i = 0; i < json.size(); ++i) add(at / i, json[i]);
    return places;
}

/// Every value of the model damaged in every way, its buffers' bytes all ones, its PNG's and GLB's bytes changed, both
/// files cut: some thousands.
inline std::vector<NamedFile> damagedFiles() {
    std::vector<NamedFile> files;
    const Json whole = everythingGltf();
    for (const Json::json_pointer& place : placesIn(whole)) {
        const auto add = [&](const std::string& how, const Json& damaged) {
            files.push_back({place.to_string().substr(1) + ": " + how, damaged.dump()});
        };
        for (const auto& [how, value] : damagedValues(whole[place])) {
            Json damaged = whole;
            damaged[place] = value;
            add(how, damaged);
        }
        Json damaged = whole;
        if (damaged[place.parent_pointer()].is_object()) {
            damaged[place.parent_pointer()].erase(place.back());
            add("removed", damaged);
        }
    }
    const std::string text = whole.dump(), glb = asGlb(whole);
    for (std::size_t i = 0; i < whole["buffers"].size(); ++i) {
        Json damaged = whole;
        damaged["buffers"][i]["uri"] =
            dataUri(std::string(whole["buffers"][i]["byteLength"].get<std::size_t>(), '\xFF'));
        files.push_back({"buffers/" + std::to_string(i) + ": all ones", damaged.dump()});
    }
    const std::string uri(kPng), png = decodedBase64(uri.substr(uri.find(',') + 1));
    for (std::size_t i = 0; i < png.size(); ++i) {
        std::string changed = png;
        changed[i] = static_cast<char>(~changed[i]);
        Json damaged = whole;
        damaged["images"][0]["uri"] = dataUri(changed);
        files.push_back({"PNG byte " + std::to_string(i) + ": inverted", damaged.dump()});
    }
    for (std::size_t i = 0; i < 28; ++i)
        for (const char byte : {'\x00', '\x7F', '\xFF'}) {
            std::string changed = glb;
            changed[i] = byte;
            files.push_back({"GLB byte " + std::to_string(i) + ": changed", changed});
        }
    constexpr std::size_t kCuts = 40;
    for (std::size_t i = 0; i < kCuts; ++i) {
        files.push_back({"cut after " + std::to_string(i) + "/40", text.substr(0, text.size() * i / kCuts)});
        files.push_back({"GLB cut after " + std::to_string(i) + "/40", glb.substr(0, glb.size() * i / kCuts)});
    }
    return files;
}

}  // namespace dioptre::test
