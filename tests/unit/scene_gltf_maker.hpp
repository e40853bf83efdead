// Small glTF files for tests: a valid triangle to damage, and buffers made of plain values.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "scene/gltf_loader.hpp"

namespace dioptre::test {

using Json = nlohmann::json;

inline constexpr std::string_view kBase64Digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

inline std::string base64(const std::string& bytes) {
    std::string out;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t bits = 0;
        for (std::size_t j = 0; j < 3; ++j)
            bits = bits << 8 | (i + j < bytes.size() ? static_cast<unsigned char>(bytes[i + j]) : 0u);
        for (std::size_t j = 0; j < 4; ++j)
            out += i + j < bytes.size() + 1 ? kBase64Digits[bits >> (18 - 6 * j) & 63] : '=';
    }
    return out;
}

/// Of what base64() gives.
inline std::string decodedBase64(const std::string& text) {
    std::string out;
    std::uint32_t bits = 0;
    int count = 0;
    for (const char c : text) {
        const std::size_t digit = kBase64Digits.find(c);
        if (digit == std::string_view::npos) break;  // the padding
        bits = bits << 6 | static_cast<std::uint32_t>(digit);
        if ((count += 6) < 8) continue;
        count -= 8;
        out += static_cast<char>(bits >> count & 0xFF);
    }
    return out;
}

inline std::string dataUri(const std::string& bytes, const std::string& type = "application/octet-stream") {
    return "data:" + type + ";base64," + base64(bytes);
}

template <typename T>
std::string bytesOf(const std::vector<T>& values) {
    std::string bytes(values.size() * sizeof(T), '\0');
    if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}

/// A buffer of its own with one view over all of it; returns the view's number.
inline std::size_t addView(Json& gltf, const std::string& bytes) {
    gltf["buffers"].push_back({{"byteLength", bytes.size()}, {"uri", dataUri(bytes)}});
    gltf["bufferViews"].push_back({{"buffer", gltf["buffers"].size() - 1}, {"byteLength", bytes.size()}});
    return gltf["bufferViews"].size() - 1;
}

/// The same with an accessor; returns the accessor's number.
inline std::size_t addAccessor(Json& gltf, const std::string& bytes, int componentType, const std::string& type,
                               std::size_t count) {
    const std::size_t view = addView(gltf, bytes);
    gltf["accessors"].push_back(
        {{"bufferView", view}, {"componentType", componentType}, {"type", type}, {"count", count}});
    return gltf["accessors"].size() - 1;
}

/// Accessors: 0 positions (0,0,0) (1,0,0) (0,1,0), 1 normals +z, 2 texture coordinates, 3 indices 0 1 2 of 16 bits;
/// each has a buffer and a view of its own, with its own number. One material, mesh, node, scene.
inline Json triangleGltf() {
    Json gltf = {{"asset", {{"version", "2.0"}}}};
    addAccessor(gltf, bytesOf<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}), 5126, "VEC3", 3);
    addAccessor(gltf, bytesOf<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}), 5126, "VEC3", 3);
    addAccessor(gltf, bytesOf<float>({0, 0, 1, 0, 0, 1}), 5126, "VEC2", 3);
    addAccessor(gltf, bytesOf<std::uint16_t>({0, 1, 2}), 5123, "SCALAR", 3);
    gltf["accessors"][0]["min"] = {0, 0, 0};
    gltf["accessors"][0]["max"] = {1, 1, 0};
    gltf["materials"] = Json::parse(R"([{"name": "red", "pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 1]}}])");
    gltf["meshes"] = Json::parse(R"([{"name": "triangle", "primitives": [
        {"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}, "indices": 3, "material": 0}]}])");
    gltf["nodes"] = Json::parse(R"([{"name": "node", "mesh": 0}])");
    gltf["scenes"] = Json::parse(R"([{"nodes": [0]}])");
    gltf["scene"] = 0;
    return gltf;
}

inline Json& attributesOf(Json& gltf) {
    return gltf["meshes"][0]["primitives"][0]["attributes"];
}

/// 2 x 1 texels of 8-bit RGBA: (255, 0, 0, 255) (0, 128, 255, 64).
inline constexpr const char* kPng =
    "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAYAAAD0In+KAAAAEUlEQVR42mP4z8Dwn6HhvwMAELoDvjp5v74AAAAA"
    "SUVORK5CYII=";

/// The material gets that image as base colour texture 0.
inline Json texturedGltf() {
    Json gltf = triangleGltf();
    gltf["images"] = Json::array({{{"uri", kPng}, {"name", "two"}}});
    gltf["textures"] = Json::parse(R"([{"source": 0}])");
    gltf["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
    return gltf;
}

inline std::string glbHeader(std::uint32_t version, std::uint32_t length) {
    return "glTF" + bytesOf<std::uint32_t>({version, length});
}

inline std::string glbChunk(std::uint32_t type, std::string data, char padding) {
    while (data.size() % 4 != 0) data += padding;
    return bytesOf<std::uint32_t>({static_cast<std::uint32_t>(data.size()), type}) + data;
}

inline constexpr std::uint32_t kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;

/// A folder for one test, removed at its end.
class TemporaryFolder {
  public:
    TemporaryFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "dioptre-scene-XXXXXX").string();
        if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
        path_ = name;
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }
    std::filesystem::path write(const std::string& name, const std::string& bytes) const {
        std::filesystem::create_directories((path_ / name).parent_path());
        std::ofstream(path_ / name, std::ios::binary) << bytes;
        return path_ / name;
    }

  private:
    std::filesystem::path path_;
};

inline Scene load(const Json& gltf, const LoadLimits& limits = {}) {
    const TemporaryFolder folder;
    return loadGltf(folder.write("scene.gltf", gltf.dump()), limits);
}

/// What the loader says when it refuses the file; empty if it does not. A message of several lines is a failure.
inline std::string refusal(const std::filesystem::path& path, const LoadLimits& limits = {}) {
    try {
        loadGltf(path, limits);
    } catch (const InputError& error) {
        const std::string what = error.what();
        for (const char c : what) EXPECT_GE(static_cast<unsigned char>(c), 0x20) << what;
        EXPECT_EQ(what.find(path.filename().string() + ": "), 0u) << what;
        return what;
    }
    return {};
}

inline std::string refusal(const Json& gltf, const LoadLimits& limits = {}) {
    const TemporaryFolder folder;
    return refusal(folder.write("scene.gltf", gltf.dump()), limits);
}

inline bool contains(const std::string& text, const std::string& fragment) {
    return text.find(fragment) != std::string::npos;
}

inline bool warns(const Scene& scene, const std::string& fragment) {
    for (const std::string& warning : scene.warnings)
        if (contains(warning, fragment)) return true;
    return false;
}

}  // namespace dioptre::test
