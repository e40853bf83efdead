// glTF 2.0 writer of glb.hpp. Vertices are interleaved: position, normal, 16-bit normalised texture coordinates, and a
// tangent where there is a normal map. Extensions used: KHR_materials_unlit, KHR_materials_emissive_strength,
// KHR_lights_punctual; none is required.
#include "glb.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "atlas.hpp"
#include "bvh.hpp"

#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb_image_write.h>

namespace studio {

namespace {

using json = nlohmann::ordered_json;

constexpr int kFloat = 5126, kShort = 5123, kInt = 5125, kArrayBuffer = 34962, kElementBuffer = 34963;

json toJson(const vec3& v) {
    return {v.x, v.y, v.z};
}
json toJson(const glm::quat& q) {
    return {q.x, q.y, q.z, q.w};
}

/// The rotation that makes a camera's or a light's -z look along `direction`, its y up.
glm::quat lookAlong(const vec3& direction) {
    const vec3 z = -glm::normalize(direction), x = glm::normalize(glm::cross(kY, z));
    return glm::quat_cast(glm::mat3(x, glm::cross(z, x), z));
}

void append(void* context, void* data, int size) {
    auto& bytes = *static_cast<std::vector<std::uint8_t>*>(context);
    const auto* first = static_cast<const std::uint8_t*>(data);
    bytes.insert(bytes.end(), first, first + size);
}

bool translucent(const Picture& p) {
    for (std::size_t k = 3; k < p.rgba.size(); k += 4)
        if (p.rgba[k] != 255) return true;
    return false;
}

struct EncodedImage {
    std::vector<std::uint8_t> bytes;
    const char* mime = "image/jpeg";
};

EncodedImage encode(const Picture& p, int quality, bool exact) {
    EncodedImage image;
    if (exact) {
        image.mime = "image/png";
        stbi_write_png_to_func(append, &image.bytes, p.width, p.height, 4, p.rgba.data(), 4 * p.width);
    } else {
        stbi_write_jpg_to_func(append, &image.bytes, p.width, p.height, 4, p.rgba.data(), quality);
    }
    return image;
}

class Writer {
  public:
    Writer(const Model& model, const std::vector<ObjectPictures>& pictures) : model_(model), pictures_(pictures) {}
    std::vector<std::uint8_t> write();

  private:
    int addView(const void* data, std::size_t size, int target, int stride);
    int addAccessor(int view, std::size_t offset, int type, bool normalized, std::size_t count, const char* shape);
    json addMesh(std::size_t object, const vec3& pivot);
    json material(std::size_t object);
    json texture(const Picture& picture, const std::string& name, int quality, bool exact);
    void addLights();
    void addCameras();

    const Model& model_;
    const std::vector<ObjectPictures>& pictures_;
    std::vector<std::uint8_t> buffer_;
    json root_;
};

int Writer::addView(const void* data, std::size_t size, int target, int stride) {
    buffer_.resize((buffer_.size() + 3) / 4 * 4, 0);
    json view{{"buffer", 0}, {"byteOffset", buffer_.size()}, {"byteLength", size}};
    if (stride > 0) view["byteStride"] = stride;
    if (target > 0) view["target"] = target;
    const auto* bytes = static_cast<const std::uint8_t*>(data);
    buffer_.insert(buffer_.end(), bytes, bytes + size);
    root_["bufferViews"].push_back(view);
    return static_cast<int>(root_["bufferViews"].size()) - 1;
}

int Writer::addAccessor(int view, std::size_t offset, int type, bool normalized, std::size_t count, const char* shape) {
    json accessor{
        {"bufferView", view}, {"byteOffset", offset}, {"componentType", type}, {"count", count}, {"type", shape}};
    if (normalized) accessor["normalized"] = true;
    root_["accessors"].push_back(accessor);
    return static_cast<int>(root_["accessors"].size()) - 1;
}

json Writer::addMesh(std::size_t index, const vec3& pivot) {
    const Object& object = model_.objects[index];
    const bool textured = object.finish != Finish::glowing, tangents = object.normalMap;
    const std::size_t stride = 24 + (textured ? 4 : 0) + (tangents ? 16 : 0);
    std::vector<std::uint8_t> vertices;
    std::vector<std::uint32_t> indices;
    vec3 low(1e30f), high(-1e30f);
    std::string vertex;
    std::map<std::string, std::uint32_t> numbers;  // equal vertices are written once
    const auto put = [&](const void* data, std::size_t size) { vertex.append(static_cast<const char*>(data), size); };
    for (const Patch& patch : object.patches) {
        std::vector<std::uint32_t> numberOf;
        const auto at = [&](int i, int j) { return patch.position[static_cast<std::size_t>(j * patch.columns + i)]; };
        for (int j = 0; j < patch.rows; ++j) {
            for (int i = 0; i < patch.columns; ++i) {
                const vec3 p = at(i, j) - pivot, n = patch.normal[static_cast<std::size_t>(j * patch.columns + i)];
                low = glm::min(low, p);
                high = glm::max(high, p);
                put(&p, 12);
                put(&n, 12);
                if (textured) {
                    const vec2 unit(patch.across[static_cast<std::size_t>(i)], patch.down[static_cast<std::size_t>(j)]);
                    const vec2 t = glm::clamp(textureCoordinate(object, patch, unit), 0.0f, 1.0f) * 65535.0f + 0.5f;
                    const std::uint16_t uv[2] = {static_cast<std::uint16_t>(t.x), static_cast<std::uint16_t>(t.y)};
                    put(uv, 4);
                }
                if (tangents) {
                    const vec3 along = at(std::min(i + 1, patch.columns - 1), j) - at(std::max(i - 1, 0), j);
                    const vec3 flat = along - n * glm::dot(n, along);
                    const vec4 tangent(glm::length(flat) > 1e-9f ? glm::normalize(flat) : frameAround(n)[0], 1.0f);
                    put(&tangent, 16);
                }
                const auto [entry, isNew] = numbers.try_emplace(vertex, static_cast<std::uint32_t>(numbers.size()));
                if (isNew) vertices.insert(vertices.end(), vertex.begin(), vertex.end());
                numberOf.push_back(entry->second);
                vertex.clear();
            }
        }
        for (int j = 0; j + 1 < patch.rows; ++j) {
            for (int i = 0; i + 1 < patch.columns; ++i) {
                int v[6];
                cellTriangles(patch, i, j, v);
                for (int k = 0; k < 6; k += 3) {
                    // Poles of balls and lathes give triangles without area: leave them out.
                    const auto corner = [&](int n) { return patch.position[static_cast<std::size_t>(v[k + n])]; };
                    if (glm::length(glm::cross(corner(1) - corner(0), corner(2) - corner(0))) < 1e-12f) continue;
                    for (int n = 0; n < 3; ++n) indices.push_back(numberOf[static_cast<std::size_t>(v[k + n])]);
                }
            }
        }
    }
    const std::size_t count = vertices.size() / stride;
    const int view = addView(vertices.data(), vertices.size(), kArrayBuffer, static_cast<int>(stride));
    json attributes;
    attributes["POSITION"] = addAccessor(view, 0, kFloat, false, count, "VEC3");
    root_["accessors"].back()["min"] = toJson(low);
    root_["accessors"].back()["max"] = toJson(high);
    attributes["NORMAL"] = addAccessor(view, 12, kFloat, false, count, "VEC3");
    if (textured) attributes["TEXCOORD_0"] = addAccessor(view, 24, kShort, true, count, "VEC2");
    if (tangents) attributes["TANGENT"] = addAccessor(view, 28, kFloat, false, count, "VEC4");

    int indexView, indexType = kShort;
    if (count < 65535) {
        const std::vector<std::uint16_t> narrow(indices.begin(), indices.end());
        indexView = addView(narrow.data(), narrow.size() * 2, kElementBuffer, 0);
    } else {
        indexView = addView(indices.data(), indices.size() * 4, kElementBuffer, 0);
        indexType = kInt;
    }
    const int indexAccessor = addAccessor(indexView, 0, indexType, false, indices.size(), "SCALAR");
    json primitive{{"attributes", attributes}, {"indices", indexAccessor}, {"material", index}, {"mode", 4}};
    return {{"name", object.name}, {"primitives", json::array({primitive})}};
}

json Writer::texture(const Picture& picture, const std::string& name, int quality, bool exact) {
    const EncodedImage image = encode(picture, quality, exact);
    const int view = addView(image.bytes.data(), image.bytes.size(), 0, 0);
    root_["images"].push_back({{"name", name}, {"mimeType", image.mime}, {"bufferView", view}});
    const int source = static_cast<int>(root_["images"].size()) - 1;
    root_["textures"].push_back({{"name", name}, {"sampler", 0}, {"source", source}});
    return {{"index", source}};
}

json Writer::material(std::size_t index) {
    const Object& object = model_.objects[index];
    const ObjectPictures& pictures = pictures_[index];
    json m{{"name", object.name}};
    json pbr;
    if (!pictures.color.empty()) {
        const bool alpha = translucent(pictures.color);
        pbr["baseColorTexture"] = texture(pictures.color, object.name, object.jpegQuality, alpha);
        if (alpha) {
            m["alphaMode"] = "MASK";
            m["alphaCutoff"] = 0.5;
        }
    } else {
        pbr["baseColorFactor"] = {0.0, 0.0, 0.0, 1.0};
    }
    const bool lit = object.finish == Finish::lit;
    pbr["metallicFactor"] = lit ? pictures.metallic : 0.0f;
    pbr["roughnessFactor"] = lit ? pictures.roughness : 1.0f;
    if (!pictures.metallicRoughness.empty()) {
        pbr["metallicRoughnessTexture"] =
            texture(pictures.metallicRoughness, object.name + " metal and roughness", 90, false);
    }
    m["pbrMetallicRoughness"] = pbr;
    if (!pictures.normal.empty()) m["normalTexture"] = texture(pictures.normal, object.name + " relief", 92, false);
    if (!pictures.emissive.empty()) {
        m["emissiveTexture"] = texture(pictures.emissive, object.name + " emission", object.jpegQuality, false);
        m["emissiveFactor"] = {1.0, 1.0, 1.0};
    } else if (object.finish == Finish::glowing) {
        m["emissiveFactor"] = toJson(object.emissive);
    }
    if (object.thin || object.finish == Finish::masked) m["doubleSided"] = true;
    const bool unlit =
        object.finish == Finish::baked || object.finish == Finish::painted || object.finish == Finish::masked;
    if (unlit) m["extensions"]["KHR_materials_unlit"] = json::object();
    if (object.emissiveStrength != 1.0f) {
        m["extensions"]["KHR_materials_emissive_strength"] = {{"emissiveStrength", object.emissiveStrength}};
    }
    return m;
}

void Writer::addLights() {
    json lights = json::array();
    const auto addNode = [&](json node, const json& light) {
        node["extensions"]["KHR_lights_punctual"] = {{"light", lights.size()}};
        lights.push_back(light);
        root_["scenes"][0]["nodes"].push_back(root_["nodes"].size());
        root_["nodes"].push_back(node);
    };
    const auto split = [](const vec3& c, float& intensity) {
        intensity = std::max({c.x, c.y, c.z});
        return intensity > 0.0f ? c / intensity : vec3(1.0f);
    };
    float intensity = 0.0f;
    const vec3 color = split(model_.daylight.sunIrradiance, intensity);
    addNode({{"name", "sun"}, {"rotation", toJson(lookAlong(-model_.daylight.toSun))}},
            {{"name", "sun"}, {"type", "directional"}, {"color", toJson(color)}, {"intensity", intensity}});
    for (const Lamp& lamp : model_.lamps) {
        if (!lamp.exported) continue;
        const vec3 tint = split(lamp.intensity, intensity);
        addNode({{"name", lamp.name}, {"translation", toJson(lamp.position)}},
                {{"name", lamp.name}, {"type", "point"}, {"color", toJson(tint)}, {"intensity", intensity}});
    }
    root_["extensions"]["KHR_lights_punctual"]["lights"] = lights;
}

void Writer::addCameras() {
    for (const CameraView& camera : model_.cameras) {
        root_["cameras"].push_back(
            {{"name", camera.name},
             {"type", "perspective"},
             {"perspective",
              {{"yfov", glm::radians(camera.yfovDegrees)}, {"aspectRatio", 4.0 / 3.0}, {"znear", 0.02}}}});
        root_["scenes"][0]["nodes"].push_back(root_["nodes"].size());
        root_["nodes"].push_back({{"name", camera.name},
                                  {"camera", root_["cameras"].size() - 1},
                                  {"translation", toJson(camera.position)},
                                  {"rotation", toJson(lookAlong(camera.target - camera.position))}});
    }
}

std::vector<std::uint8_t> Writer::write() {
    root_["asset"] = {{"version", "2.0"}, {"generator", "Dioptre make_studio"}};
    root_["extensionsUsed"] = {"KHR_lights_punctual", "KHR_materials_emissive_strength", "KHR_materials_unlit"};
    root_["scene"] = 0;
    root_["scenes"] = json::array({{{"name", "studio"}, {"nodes", json::array()}}});
    root_["samplers"] = json::array({{{"magFilter", 9729}, {"minFilter", 9987}, {"wrapS", 33071}, {"wrapT", 33071}}});
    for (std::size_t o = 0; o < model_.objects.size(); ++o) {
        vec3 low(1e30f), high(-1e30f);
        for (const Patch& patch : model_.objects[o].patches) {
            for (const vec3& p : patch.position) {
                low = glm::min(low, p);
                high = glm::max(high, p);
            }
        }
        // Each object is modelled about its own middle, at whole millimetres.
        const vec3 pivot = glm::round((low + high) * 500.0f) / 1000.0f;
        root_["meshes"].push_back(addMesh(o, pivot));
        root_["materials"].push_back(material(o));
        root_["scenes"][0]["nodes"].push_back(o);
        root_["nodes"].push_back({{"name", model_.objects[o].name}, {"mesh", o}, {"translation", toJson(pivot)}});
    }
    addLights();
    addCameras();
    buffer_.resize((buffer_.size() + 3) / 4 * 4, 0);
    root_["buffers"] = json::array({{{"byteLength", buffer_.size()}}});

    std::string text = root_.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::vector<std::uint8_t> file;
    const auto word = [&](std::size_t value) {
        for (int shift = 0; shift < 32; shift += 8) file.push_back(static_cast<std::uint8_t>(value >> shift));
    };
    word(0x46546C67u);  // "glTF"
    word(2);
    word(12 + 8 + text.size() + 8 + buffer_.size());
    word(text.size());
    word(0x4E4F534Au);  // "JSON"
    file.insert(file.end(), text.begin(), text.end());
    word(buffer_.size());
    word(0x004E4942u);  // "BIN"
    file.insert(file.end(), buffer_.begin(), buffer_.end());
    return file;
}

}  // namespace

std::size_t writeGlb(const std::string& path, const Model& model, const std::vector<ObjectPictures>& pictures) {
    const std::vector<std::uint8_t> file = Writer(model, pictures).write();
    const std::string temporary = path + ".part";
    std::ofstream stream(temporary, std::ios::binary);
    stream.write(reinterpret_cast<const char*>(file.data()), static_cast<std::streamsize>(file.size()));
    stream.close();
    if (!stream || std::rename(temporary.c_str(), path.c_str()) != 0)
        throw std::runtime_error("make_studio: cannot write " + path);
    return file.size();
}

void writePng(const std::string& path, const Picture& p) {
    if (!stbi_write_png(path.c_str(), p.width, p.height, 4, p.rgba.data(), 4 * p.width)) {
        throw std::runtime_error("make_studio: cannot write " + path);
    }
}

}  // namespace studio
