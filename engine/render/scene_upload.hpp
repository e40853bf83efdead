// From a scene's plain data to what the GPU reads: textures, samplers, one vertex and one index buffer.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "gl/objects.hpp"
#include "scene/scene.hpp"
#include "shaders/shared/scene_types.h"

namespace dioptre {

/// Colour is sRGB in the file, data and normals are linear; the stand-in for "no texture" differs too.
enum class TextureUse { color, data, normal };

struct TextureKey {
    int image;  // index into Scene::images, -1: the stand-in
    TextureUse use;
    bool operator==(const TextureKey&) const = default;
};
using SceneTextures = std::vector<std::pair<TextureKey, Texture>>;
using SceneSamplers = std::vector<std::pair<Sampler, GlSampler>>;

/// Every image in each way that a material uses it, mipmapped, and the stand-ins.
SceneTextures uploadTextures(const Scene& scene);
const Texture& findTexture(const SceneTextures& textures, int image, TextureUse use);
/// The sampler object for a description, made on first use.
GLuint samplerFor(SceneSamplers& samplers, const Sampler& sampler);

std::array<const TextureSlot*, gpu::kMaterialTextures> textureSlots(const Material& material);
gpu::MaterialData materialData(const Material& material);

struct IndexRange {
    std::uint32_t first = 0, count = 0;
};
struct PrimitiveRange {
    IndexRange indices;
    std::uint32_t baseVertex = 0;
};
/// All primitives one after another, those with extras first, so that `extras` is as long as they need; mesh i's are
/// primitives[firstPrimitive[i]] and on.
struct UploadedGeometry {
    Buffer vertices, extras, indices;
    std::vector<PrimitiveRange> primitives;
    std::vector<std::size_t> firstPrimitive;
    // Of each primitive that an instance bends, in their order: where its posed vertices begin. They start as copies of
    // those at rest.
    std::vector<std::uint32_t> posedVertices;
};
/// Primitive by primitive into buffers of the total size: there is no second copy of the scene in memory.
UploadedGeometry uploadMeshes(const Scene& scene);
void describeVertices(const VertexArray& array, const Buffer& vertices, const Buffer& indices);
/// A matrix (viewFromMesh) for each item, in order: what a draw reads at its base instance.
void bindInstances(const VertexArray& array, const Buffer& matrices);
/// Adds them to an array described before.
void describeExtras(const VertexArray& array, const Buffer& extras);

gpu::LightData lightInView(const Light& light, const glm::dmat4& viewFromWorld);
/// The light of a scene that brings none: from above, the right and behind the default viewer.
Light keyLight();

}  // namespace dioptre
