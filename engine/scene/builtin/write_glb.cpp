// glTF 2.0, 4.4: a 12-byte header, a JSON chunk, a binary chunk.
#include "scene/builtin/write_glb.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "scene/builtin/common.hpp"
#include "scene/vertex_frame.hpp"

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#include <stb_image_write.h>

namespace dioptre {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kFloat = 5126, kShort = 5123, kInt = 5125, kVertexData = 34962, kIndexData = 34963;
constexpr std::size_t kHeaderBytes = 12, kChunkHeaderBytes = 8;
constexpr int kJpegQuality = 91;  // above 90 stb keeps the colour at full resolution
constexpr std::string_view kChecksumKey = "\"checksum\":\"", kNoChecksum = "0000000000000000";

struct FileVertex {
    glm::vec3 position, normal;
    glm::vec2 uv;
};
static_assert(sizeof(FileVertex) == 32);

/// Four independent lanes of 8-byte words, multiplied and rotated: as fast as memory is read. Pieces but the last have
/// a multiple of 32 bytes.
class Hash {
  public:
    void add(std::string_view bytes) {
        std::size_t at = 0;
        for (; at + 32 <= bytes.size(); at += 32) {
            std::array<std::uint64_t, 4> words;
            std::memcpy(words.data(), bytes.data() + at, 32);
            for (std::size_t k = 0; k < 4; ++k) mix(lanes_[k], words[k]);
        }
        for (; at < bytes.size(); ++at) mix(lanes_[0], static_cast<unsigned char>(bytes[at]));
        size_ += bytes.size();
    }
    std::string text() const {
        std::uint64_t all = lanes_[0];
        for (std::size_t k = 1; k < 4; ++k) mix(all, lanes_[k]);
        mix(all, size_);
        return fmt::format("{:016x}", all);
    }

  private:
    static void mix(std::uint64_t& lane, std::uint64_t word) {
        lane = (lane ^ word) * 0x9e3779b97f4a7c15ull;
        lane ^= lane >> 29;
    }

    std::array<std::uint64_t, 4> lanes_{1, 2, 3, 4};
    std::uint64_t size_ = 0;
};

/// Where the checksum's 16 digits start, or npos.
std::size_t checksumPlace(std::string_view file) {
    constexpr std::size_t kFarthest = 400;  // asset is the JSON's first member
    const std::size_t key = file.substr(0, kFarthest).find(kChecksumKey);
    if (key == std::string_view::npos || key + kChecksumKey.size() + kNoChecksum.size() > file.size())
        return std::string_view::npos;
    return key + kChecksumKey.size();
}

Json toJson(const glm::vec3& v) {
    return {v.x, v.y, v.z};
}
Json toJson(const glm::mat4& m) {
    Json numbers = Json::array();
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r) numbers.push_back(m[c][r]);
    return numbers;
}

/// A colour of any size as one of at most 1 and its strength.
std::pair<glm::vec3, float> split(const glm::vec3& color) {
    const float strength = std::max({color.x, color.y, color.z});
    return {strength > 0.0f ? color / strength : glm::vec3(0.0f), strength};
}

void append(void* context, void* data, int size) {
    static_cast<std::string*>(context)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
}

std::string jpeg(const TextureImage& image) {
    std::string bytes;
    stbi_write_jpg_to_func(append, &bytes, image.width, image.height, 4, image.rgba.data(), kJpegQuality);
    return bytes;
}

class Writer {
  public:
    explicit Writer(const Scene& scene) : scene_(scene) {}
    std::string write(const std::string& generator, unsigned threads);

  private:
    std::size_t addView(const void* data, std::size_t size, int target, std::size_t stride);
    std::size_t addAccessor(std::size_t view, std::size_t offset, int component, std::size_t count, const char* type);
    Json primitive(const Primitive& primitive);
    Json material(const Material& material) const;
    void addImages(unsigned threads);
    void addMeshes();
    void addNode(Json node, const glm::mat4& worldFromNode);
    void addCamera(const Camera& camera);
    void addLight(const Light& light);

    const Scene& scene_;
    std::string buffer_;
    Json root_;
};

std::size_t Writer::addView(const void* data, std::size_t size, int target, std::size_t stride) {
    buffer_.resize((buffer_.size() + 3) / 4 * 4, '\0');
    Json view{{"buffer", 0}, {"byteOffset", buffer_.size()}, {"byteLength", size}};
    if (stride > 0) view["byteStride"] = stride;
    if (target > 0) view["target"] = target;
    buffer_.append(static_cast<const char*>(data), size);
    root_["bufferViews"].push_back(std::move(view));
    return root_["bufferViews"].size() - 1;
}

std::size_t Writer::addAccessor(std::size_t view, std::size_t offset, int component, std::size_t count,
                                const char* type) {
    root_["accessors"].push_back(
        {{"bufferView", view}, {"byteOffset", offset}, {"componentType", component}, {"count", count}, {"type", type}});
    return root_["accessors"].size() - 1;
}

Json Writer::primitive(const Primitive& primitive) {
    std::vector<FileVertex> vertices;
    vertices.reserve(primitive.vertices.size());
    for (const Vertex& v : primitive.vertices) vertices.push_back({v.position, v.normal, v.uv});
    const std::size_t count = vertices.size();
    const std::size_t view = addView(vertices.data(), count * sizeof(FileVertex), kVertexData, sizeof(FileVertex));
    Json attributes;
    attributes["POSITION"] = addAccessor(view, offsetof(FileVertex, position), kFloat, count, "VEC3");
    root_["accessors"].back()["min"] = toJson(primitive.bounds.min);
    root_["accessors"].back()["max"] = toJson(primitive.bounds.max);
    attributes["NORMAL"] = addAccessor(view, offsetof(FileVertex, normal), kFloat, count, "VEC3");
    attributes["TEXCOORD_0"] = addAccessor(view, offsetof(FileVertex, uv), kFloat, count, "VEC2");

    std::size_t indices = 0;
    if (count < std::numeric_limits<std::uint16_t>::max()) {
        const std::vector<std::uint16_t> narrow(primitive.indices.begin(), primitive.indices.end());
        indices = addAccessor(addView(narrow.data(), narrow.size() * sizeof narrow[0], kIndexData, 0), 0, kShort,
                              narrow.size(), "SCALAR");
    } else {
        const std::size_t bytes = primitive.indices.size() * sizeof primitive.indices[0];
        indices = addAccessor(addView(primitive.indices.data(), bytes, kIndexData, 0), 0, kInt,
                              primitive.indices.size(), "SCALAR");
    }
    return {{"attributes", std::move(attributes)}, {"indices", indices}, {"material", primitive.material}};
}

Json Writer::material(const Material& m) const {
    const auto slot = [](const TextureSlot& texture) { return Json{{"index", texture.image}}; };
    Json pbr{{"baseColorFactor", {m.baseColor.r, m.baseColor.g, m.baseColor.b, m.baseColor.a}},
             {"metallicFactor", m.metallic},
             {"roughnessFactor", m.roughness}};
    if (m.baseColorTexture.used()) pbr["baseColorTexture"] = slot(m.baseColorTexture);
    Json json{{"name", m.name}, {"pbrMetallicRoughness", std::move(pbr)}};
    const auto [emissive, strength] = split(m.emissive);
    if (strength > 0.0f) {
        json["emissiveFactor"] = toJson(strength > 1.0f ? emissive : m.emissive);
        if (strength > 1.0f) json["extensions"]["KHR_materials_emissive_strength"] = {{"emissiveStrength", strength}};
        if (m.emissiveTexture.used()) json["emissiveTexture"] = slot(m.emissiveTexture);
    }
    if (m.doubleSided) json["doubleSided"] = true;
    if (m.unlit) json["extensions"]["KHR_materials_unlit"] = Json::object();
    return json;
}

void Writer::addImages(unsigned threads) {
    if (scene_.images.empty()) return;
    std::vector<std::string> encoded(scene_.images.size());
    std::vector<std::function<void()>> jobs;
    for (std::size_t i = 0; i < encoded.size(); ++i)
        jobs.emplace_back([this, i, &encoded] { encoded[i] = jpeg(scene_.images[i]); });
    builtin::runJobs(jobs, threads, {});
    root_["samplers"] = Json::array({{{"magFilter", 9729}, {"minFilter", 9987}}});
    for (std::size_t i = 0; i < encoded.size(); ++i) {
        const std::size_t view = addView(encoded[i].data(), encoded[i].size(), 0, 0);
        root_["images"].push_back({{"name", scene_.images[i].name}, {"mimeType", "image/jpeg"}, {"bufferView", view}});
        root_["textures"].push_back({{"sampler", 0}, {"source", i}});
    }
}

void Writer::addMeshes() {
    for (const Material& m : scene_.materials) root_["materials"].push_back(material(m));
    for (const Mesh& mesh : scene_.meshes) {
        Json primitives = Json::array();
        for (const Primitive& p : mesh.primitives)
            if (!p.indices.empty()) primitives.push_back(primitive(p));
        root_["meshes"].push_back({{"name", mesh.name}, {"primitives", std::move(primitives)}});
    }
    for (const Instance& instance : scene_.instances)
        addNode({{"name", instance.name}, {"mesh", instance.mesh}}, instance.worldFromMesh);
}

void Writer::addNode(Json node, const glm::mat4& worldFromNode) {
    if (worldFromNode != glm::mat4(1.0f)) node["matrix"] = toJson(worldFromNode);
    // A new member moves the others: no reference to one is held
    const std::size_t number = root_["nodes"].size();
    root_["scenes"][0]["nodes"].push_back(number);
    root_["nodes"].push_back(std::move(node));
}

void Writer::addCamera(const Camera& camera) {
    const std::size_t number = root_["cameras"].size();
    root_["cameras"].push_back({{"name", camera.name},
                                {"type", "perspective"},
                                {"perspective", {{"yfov", camera.yfovRadians}, {"znear", camera.nearMetres}}}});
    addNode({{"name", camera.name}, {"camera", number}}, camera.worldFromCamera);
}

void Writer::addLight(const Light& light) {
    Json& lights = root_["extensions"]["KHR_lights_punctual"]["lights"];
    const auto [color, intensity] = split(light.color);
    Json json{{"name", light.name},
              {"type", light.kind == LightKind::directional ? "directional" : "point"},
              {"color", toJson(color)},
              {"intensity", intensity}};
    if (light.range > 0.0f) json["range"] = light.range;
    glm::mat4 place = glm::translate(glm::mat4(1.0f), light.position);
    if (light.kind == LightKind::directional) {
        const glm::vec3 z = -light.direction, x = anyOrthogonal(z);
        place = glm::mat4(glm::mat3(x, glm::cross(z, x), z));
    }
    Json node{{"name", light.name}};
    node["extensions"]["KHR_lights_punctual"] = {{"light", lights.size()}};
    lights.push_back(std::move(json));
    addNode(std::move(node), place);
}

std::string Writer::write(const std::string& generator, unsigned threads) {
    root_["asset"] = {{"version", "2.0"}, {"extras", {{"checksum", kNoChecksum}}}, {"generator", generator}};
    root_["extensionsUsed"] = {"KHR_lights_punctual", "KHR_materials_emissive_strength", "KHR_materials_unlit"};
    root_["scene"] = 0;
    root_["scenes"] = Json::array({{{"name", scene_.name}, {"nodes", Json::array()}}});
    addMeshes();
    addImages(threads);
    for (const Camera& camera : scene_.cameras) addCamera(camera);
    for (const Light& light : scene_.lights) addLight(light);
    buffer_.resize((buffer_.size() + 3) / 4 * 4, '\0');
    root_["buffers"] = Json::array({{{"byteLength", buffer_.size()}}});

    std::string text = root_.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::size_t size = kHeaderBytes + 2 * kChunkHeaderBytes + text.size() + buffer_.size();
    if (size > std::numeric_limits<std::uint32_t>::max())
        throw RunError(fmt::format("{}: {} bytes are too many for a GLB", scene_.name, size));
    std::string file;
    file.reserve(size);
    const auto word = [&](std::size_t value) {
        for (int shift = 0; shift < 32; shift += 8) file.push_back(static_cast<char>(value >> shift & 255u));
    };
    file += "glTF";
    word(2);
    word(size);
    word(text.size());
    file += "JSON" + text;
    word(buffer_.size());
    file += std::string_view("BIN\0", 4);
    file += buffer_;
    // Of the file with zeros for digits
    Hash hash;
    hash.add(file);
    file.replace(checksumPlace(file), kNoChecksum.size(), hash.text());
    return file;
}

}  // namespace

std::string writeGlb(const Scene& scene, const std::string& generator, unsigned threads) {
    return Writer(scene).write(generator, threads);
}

bool checksumHolds(const std::filesystem::path& path) {
    constexpr std::size_t kPiece = 1 << 20;
    std::ifstream stream(path, std::ios::binary);
    std::string piece(kPiece, '\0'), wanted;
    Hash hash;
    while (stream) {
        stream.read(piece.data(), static_cast<std::streamsize>(kPiece));
        piece.resize(static_cast<std::size_t>(stream.gcount()));
        if (wanted.empty()) {
            const std::size_t place = checksumPlace(piece);
            if (place == std::string::npos) return false;
            wanted = piece.substr(place, kNoChecksum.size());
            piece.replace(place, kNoChecksum.size(), kNoChecksum);
        }
        hash.add(piece);
    }
    return !stream.bad() && hash.text() == wanted;
}

}  // namespace dioptre
