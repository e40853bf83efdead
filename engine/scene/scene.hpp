// A scene as plain data, ready for upload: what the glTF loader fills and the renderer reads.
// Right-handed, y up, metres; colours linear unless a field says sRGB. No GL, no glTF types.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dioptre {

struct Deformation;  // scene/deformation.hpp
struct Motion;       // scene/animation.hpp

/// Axis-aligned box; empty while min > max.
struct Bounds {
    glm::vec3 min{std::numeric_limits<float>::max()};
    glm::vec3 max{std::numeric_limits<float>::lowest()};

    bool empty() const { return min.x > max.x; }
    void add(const glm::vec3& p) {
        min = glm::min(min, p);
        max = glm::max(max, p);
    }
    void add(const Bounds& b) {
        min = glm::min(min, b.min);
        max = glm::max(max, b.max);
    }
    glm::vec3 corner(int i) const {  // 0..7
        return {(i & 1 ? max : min).x, (i & 2 ? max : min).y, (i & 4 ? max : min).z};
    }
    glm::vec3 centre() const { return (min + max) * 0.5f; }
    glm::vec3 size() const { return max - min; }
};

/// Decoded texels, 4 channels of 8 bits, row 0 on top.
struct TextureImage {
    std::string name;
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgba;
};

enum class Wrap { repeat, mirroredRepeat, clampToEdge };
enum class Filter { nearest, linear, nearestMipNearest, linearMipNearest, nearestMipLinear, linearMipLinear };

struct Sampler {
    Wrap wrapS = Wrap::repeat, wrapT = Wrap::repeat;
    Filter magnification = Filter::linear, minification = Filter::linearMipLinear;

    bool operator==(const Sampler&) const = default;
};

/// An image read through a sampler; `image` indexes Scene::images, -1 means "no texture".
struct TextureSlot {
    int image = -1;
    Sampler sampler;
    int uvSet = 0;                      // 0: Vertex::uv, 1: VertexExtra::uv
    glm::mat3x2 imageFromVertex{1.0f};  // on (u, v, 1): scale, rotation, offset (KHR_texture_transform)

    /// Where the vertices' coordinates are the image's.
    bool plain() const { return uvSet == 0 && imageFromVertex == glm::mat3x2(1.0f); }
    bool used() const { return image >= 0; }
    bool operator==(const TextureSlot&) const = default;
};

enum class AlphaMode { opaque, mask, blend };

struct Material {
    std::string name;
    glm::vec4 baseColor{1.0f};  // linear, times the sRGB base colour texture, times the vertex colour
    float metallic = 1.0f;      // times the texture's blue
    float roughness = 1.0f;     // times the texture's green
    glm::vec3 emissive{0.0f};   // linear radiance, emissive strength folded in, times the sRGB emissive texture
    float normalScale = 1.0f;
    float occlusionStrength = 1.0f;  // 0: none of the texture's red
    AlphaMode alphaMode = AlphaMode::opaque;
    float alphaCutoff = 0.5f;  // mask: texels below it are not there
    bool doubleSided = false;
    bool unlit = false;  // base colour is the radiance
    TextureSlot baseColorTexture, metallicRoughnessTexture, normalTexture, emissiveTexture;
    TextureSlot occlusionTexture;  // red darkens the sky's light, not that of lamps
};

struct Vertex {
    glm::vec3 position{0.0f};
    glm::vec3 normal{0.0f, 0.0f, 1.0f};
    glm::vec4 tangent{1.0f, 0.0f, 0.0f, 1.0f};  // w: handedness of the bitangent
    glm::vec2 uv{0.0f};
};

/// What few vertices have; beside them, so that the many stay small.
struct VertexExtra {
    glm::vec2 uv{0.0f};          // the second set
    glm::u16vec4 color{0xFFFF};  // linear, 0..65535 for 0..1, opacity last
};

enum class Topology { points, lines, triangles };

/// Indexed points, lines or triangles with one material (index into Scene::materials).
struct Primitive {
    std::vector<Vertex> vertices;
    std::vector<VertexExtra> extras;     // one per vertex, or none
    std::vector<std::uint32_t> indices;  // 1 per point, 2 per line, 3 per triangle; all < vertices.size()
    Topology topology = Topology::triangles;
    bool lit = true;  // false: points or lines without normals, their radiance is base colour + emission
    int material = 0;
    Bounds bounds;                                   // in mesh space, undeformed
    std::shared_ptr<const Deformation> deformation;  // none: rigid

    std::size_t triangleCount() const { return topology == Topology::triangles ? indices.size() / 3 : 0; }
};

struct Mesh {
    std::string name;
    std::vector<Primitive> primitives;
};

/// A mesh placed in the world: one per glTF node that has a mesh.
struct Instance {
    std::string name;
    int mesh = 0;
    glm::mat4 worldFromMesh{1.0f};
    int node = -1;  // in Motion::nodes; -1: stands still
    int skin = -1;  // in Motion::skins; those of its primitives that have influences follow it instead of the node
};

struct Camera {
    std::string name;
    glm::mat4 worldFromCamera{1.0f};  // rigid: looks along -z, y up
    float yfovRadians = 0.8f;
    float nearMetres = 0.01f;
    int node = -1;  // as an instance's
};

enum class LightKind { directional, point, spot };

/// KHR_lights_punctual, placed in the world.
struct Light {
    std::string name;
    LightKind kind = LightKind::point;
    glm::vec3 color{1.0f};  // linear, intensity (lux or candela) folded in
    glm::vec3 position{0.0f};
    glm::vec3 direction{0.0f, 0.0f, -1.0f};             // unit, the way the light travels
    float range = 0.0f;                                 // metres, 0: unlimited
    float innerConeCos = 1.0f, outerConeCos = 0.7071f;  // spot only
    int node = -1;                                      // as an instance's
};

struct Scene {
    std::string name;
    std::vector<TextureImage> images;
    std::vector<Material> materials;  // at least one: the default material is appended when a primitive has none
    std::vector<Mesh> meshes;
    std::vector<Instance> instances;
    std::vector<Camera> cameras;
    std::vector<Light> lights;
    Bounds bounds;  // of all instances, in the world, at all times as far as looked at (motionBounds); empty: nothing
    std::shared_ptr<const Motion> motion;  // none: nothing ever moves. Else what is placed here is so at time 0
    std::vector<std::string> warnings;     // what was ignored, one line each

    std::size_t triangleCount() const;  // over instances
    std::size_t bytes() const;          // of vertices, extras, indices and texels
    float brightestEmission() const;    // the most that a channel of an emissive or unlit material may have

    /// Frees vertices, extras, deformations, indices and texels once they are where they are drawn from; what is left
    /// tells of the rest.
    void releaseBulk();
};

}  // namespace dioptre
