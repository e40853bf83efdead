// The glTF loader under libFuzzer: a file is read, with every number in the scene in its range, or refused in one line.
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>

#include "hostile_scenes.hpp"
#include "scene/animation.hpp"
#include "scene/deformation.hpp"

using namespace dioptre;
using namespace dioptre::test;

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t mostBytes);

namespace {

constexpr std::size_t kGlbJsonAt = 20;  // behind the header and that of the first chunk

LoadLimits smallLimits() {
    LoadLimits limits;
    limits.maxFileBytes = 1 << 20;
    limits.maxImageBytes = 4 << 20;
    limits.maxTotalBytes = 32 << 20;
    limits.maxJsonValues = 100'000;
    return limits;
}

[[noreturn]] void fail(const char* what, const std::string& detail = {}) {
    std::fprintf(stderr, "fuzz_gltf: %s %s\n", what, detail.c_str());
    std::abort();
}

bool finite(const float* values, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
        if (!std::isfinite(values[i])) return false;
    return true;
}

void checkDeformation(const Deformation& d, std::size_t vertices) {
    if (d.influences.size() != d.influencesPerVertex * vertices) fail("a vertex's influence is missing");
    for (const Influence& influence : d.influences)
        if (!finite(&influence.weight, 1) || influence.weight < 0.0f) fail("an influence has no weight");
    for (const MorphTarget& target : d.targets)
        for (const std::vector<glm::vec3>* deltas : {&target.positions, &target.normals, &target.tangents}) {
            if (!deltas->empty() && deltas->size() != vertices) fail("a vertex's morph is missing");
            for (const glm::vec3& delta : *deltas)
                if (!finite(&delta.x, 3)) fail("a morph is not finite");
        }
}

void checkMotion(const Scene& scene) {
    if (!scene.motion) return;
    for (const double seconds : {0.0, 0.3, 1e3}) {
        const MotionPose pose = poseAt(*scene.motion, seconds);
        for (const glm::dmat4& node : pose.worldFromNode) {
            const glm::mat4 single(node);
            if (!finite(&single[0][0], 16)) fail("a node goes to infinity");
        }
    }
    for (const Instance& instance : scene.instances) {
        if (instance.skin < 0) continue;
        if (instance.skin >= static_cast<int>(scene.motion->skins.size())) fail("a skin is missing");
        const Skin& skin = scene.motion->skins[static_cast<std::size_t>(instance.skin)];
        for (const Primitive& p : scene.meshes[static_cast<std::size_t>(instance.mesh)].primitives)
            if (p.deformation)
                for (const Influence& influence : p.deformation->influences)
                    if (influence.joint >= skin.joints.size()) fail("a joint is missing");
    }
}

// What the renderer takes for granted.
void checkScene(const Scene& scene) {
    const auto checkSlot = [&](const TextureSlot& slot) {
        if (slot.image >= static_cast<int>(scene.images.size())) fail("a material names a missing image");
    };
    for (const TextureImage& image : scene.images)
        if (image.width < 1 || image.height < 1 ||
            image.rgba.size() != static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * 4)
            fail("an image's size is not that of its texels");
    for (const Material& m : scene.materials) {
        for (const TextureSlot& slot :
             {m.baseColorTexture, m.metallicRoughnessTexture, m.normalTexture, m.emissiveTexture, m.occlusionTexture})
            checkSlot(slot);
        if (!finite(&m.baseColor.x, 4) || !finite(&m.emissive.x, 3) || !finite(&m.normalScale, 1))
            fail("a material is not finite");
    }
    for (const Mesh& mesh : scene.meshes) {
        for (const Primitive& p : mesh.primitives) {
            const std::size_t corners = p.topology == Topology::points ? 1 : p.topology == Topology::lines ? 2 : 3;
            if (p.indices.size() % corners != 0) fail("a point, line or triangle is incomplete");
            if (!p.extras.empty() && p.extras.size() != p.vertices.size()) fail("an extra is missing");
            if (p.deformation) checkDeformation(*p.deformation, p.vertices.size());
            if (p.material < 0 || p.material >= static_cast<int>(scene.materials.size())) fail("a material is missing");
            for (const std::uint32_t index : p.indices)
                if (index >= p.vertices.size()) fail("a vertex is missing");
            for (const Vertex& vertex : p.vertices)
                if (!finite(&vertex.position.x, sizeof(Vertex) / sizeof(float))) fail("a vertex is not finite");
        }
    }
    for (const Instance& instance : scene.instances) {
        if (instance.mesh < 0 || instance.mesh >= static_cast<int>(scene.meshes.size())) fail("a mesh is missing");
        if (!finite(&instance.worldFromMesh[0][0], 16)) fail("an instance is not finite");
    }
    for (const Camera& camera : scene.cameras)
        if (!finite(&camera.worldFromCamera[0][0], 16)) fail("a camera is not finite");
    for (const Light& light : scene.lights)
        if (!finite(&light.color.x, 3) || !finite(&light.position.x, 3) || !finite(&light.direction.x, 3))
            fail("a light is not finite");
    checkMotion(scene);
}

// Changes one value somewhere in the JSON; where that is data, its bytes.
void mutate(Json& json, std::minstd_rand& random) {
    const auto pick = [&](std::size_t count) {
        return std::uniform_int_distribution<std::size_t>(0, count - 1)(random);
    };
    const std::vector<Json::json_pointer> places = placesIn(json);
    if (places.empty()) return;
    const Json::json_pointer place = places[pick(places.size())];
    Json& value = json[place];
    if (value.is_string() && pick(8) != 0) {
        const std::string text = value.get<std::string>();
        const auto comma = text.find(";base64,");
        std::string bytes = comma == std::string::npos ? text : decodedBase64(text.substr(comma + 8));
        const std::size_t size = bytes.size();
        bytes.resize(size + 64);
        bytes.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(bytes.data()), size, bytes.size()));
        value = comma == std::string::npos ? bytes : text.substr(0, comma + 8) + base64(bytes);
    } else if (pick(16) == 0 && json[place.parent_pointer()].is_object()) {
        json[place.parent_pointer()].erase(place.back());
    } else if (pick(4) == 0) {
        value = json[places[pick(places.size())]];  // of another place
    } else if (value.is_number() && pick(2) == 0) {
        value = pick(32);
    } else {
        const auto values = damagedValues(value);
        value = values[pick(values.size())].second;
    }
}

}  // namespace

// Half of the changes are made in the parsed JSON, where bytes changed at random would only break its syntax.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t mostBytes,
                                               unsigned seed) {
    std::minstd_rand random(seed);
    if (random() % 2 == 0) return LLVMFuzzerMutate(data, size, mostBytes);
    const std::string file(reinterpret_cast<const char*>(data), size);
    const bool glb = file.starts_with("glTF") && size > kGlbJsonAt;
    std::uint32_t jsonBytes = 0;
    if (glb) std::memcpy(&jsonBytes, &file[12], 4);
    const std::string text = glb ? file.substr(kGlbJsonAt, jsonBytes) : file;
    Json json = Json::parse(text, nullptr, false);
    if (json.is_discarded()) return LLVMFuzzerMutate(data, size, mostBytes);
    for (unsigned i = 0; i < 1 + random() % 3; ++i) mutate(json, random);
    std::string out = json.dump(-1, ' ', false, Json::error_handler_t::replace);
    if (glb) {
        const std::string chunks = glbChunk(kJsonChunk, out, ' ') +
                                   file.substr(kGlbJsonAt + std::min<std::size_t>(jsonBytes, size - kGlbJsonAt));
        out = glbHeader(2, static_cast<std::uint32_t>(12 + chunks.size())) + chunks;
    }
    if (out.size() > mostBytes) return LLVMFuzzerMutate(data, size, mostBytes);
    std::memcpy(data, out.data(), out.size());
    return out.size();
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const TemporaryFolder folder;
    static const std::filesystem::path path = folder.write("scene.gltf", "");
    static const std::filesystem::path beside = folder.write("scene.bin", std::string(100, '\0'));
    folder.write("scene.gltf", std::string(reinterpret_cast<const char*>(data), size));
    try {
        checkScene(loadGltf(path, smallLimits()));
    } catch (const InputError& error) {
        const std::string what = error.what();
        if (!what.starts_with("scene.gltf: ")) fail("the file is not named:", what);
        for (const char c : what)
            if (static_cast<unsigned char>(c) < 0x20) fail("more than one line:", what);
    }
    return 0;
}
