#include "render/scene_upload.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstddef>
#include <limits>

#include "core/error.hpp"
#include "gl/context.hpp"
#include "render/deformer.hpp"

namespace dioptre {

namespace {

Texture upload(const TextureImage& image, bool srgb) {
    const auto longest = static_cast<unsigned>(std::max({image.width, image.height, 1}));
    const TextureSpec spec{srgb ? GLenum{GL_SRGB8_ALPHA8} : GLenum{GL_RGBA8}, image.width, image.height,
                           static_cast<int>(std::bit_width(longest)), 0};
    Texture texture(spec, image.name.empty() ? "image" : image.name.substr(0, 200));
    glTextureSubImage2D(texture.name(), 0, 0, 0, image.width, image.height, GL_RGBA, GL_UNSIGNED_BYTE,
                        image.rgba.data());
    glGenerateTextureMipmap(texture.name());
    return texture;
}

GLenum glFilter(Filter filter) {
    switch (filter) {
        case Filter::nearest:
            return GL_NEAREST;
        case Filter::linear:
            return GL_LINEAR;
        case Filter::nearestMipNearest:
            return GL_NEAREST_MIPMAP_NEAREST;
        case Filter::linearMipNearest:
            return GL_LINEAR_MIPMAP_NEAREST;
        case Filter::nearestMipLinear:
            return GL_NEAREST_MIPMAP_LINEAR;
        case Filter::linearMipLinear:
            return GL_LINEAR_MIPMAP_LINEAR;
    }
    return GL_LINEAR;
}

GLenum glWrap(Wrap wrap) {
    switch (wrap) {
        case Wrap::repeat:
            return GL_REPEAT;
        case Wrap::mirroredRepeat:
            return GL_MIRRORED_REPEAT;
        case Wrap::clampToEdge:
            return GL_CLAMP_TO_EDGE;
    }
    return GL_REPEAT;
}

}  // namespace

SceneTextures uploadTextures(const Scene& scene) {
    SceneTextures textures;
    for (const TextureUse use : {TextureUse::color, TextureUse::data, TextureUse::normal}) {
        TextureImage standIn{"no texture", 1, 1, {255, 255, 255, 255}};
        if (use == TextureUse::normal) standIn.rgba = {128, 128, 255, 255};
        textures.emplace_back(TextureKey{-1, use}, upload(standIn, false));
    }
    const auto add = [&](const TextureSlot& slot, TextureUse use) {
        const TextureKey key{slot.image, use};
        const auto known = [&](const auto& entry) { return entry.first == key; };
        if (std::none_of(textures.begin(), textures.end(), known))
            textures.emplace_back(key,
                                  upload(scene.images[static_cast<std::size_t>(slot.image)], use == TextureUse::color));
    };
    for (const Material& m : scene.materials) {
        if (m.baseColorTexture.used()) add(m.baseColorTexture, TextureUse::color);
        if (m.metallicRoughnessTexture.used()) add(m.metallicRoughnessTexture, TextureUse::data);
        if (m.normalTexture.used()) add(m.normalTexture, TextureUse::normal);
        if (m.emissiveTexture.used()) add(m.emissiveTexture, TextureUse::color);
        if (m.occlusionTexture.used()) add(m.occlusionTexture, TextureUse::data);
    }
    return textures;
}

const Texture& findTexture(const SceneTextures& textures, int image, TextureUse use) {
    const auto found = std::find_if(textures.begin(), textures.end(), [&](const auto& entry) {
        return entry.first == TextureKey{image, use};
    });
    assert(found != textures.end());
    return found->second;
}

GLuint samplerFor(SceneSamplers& samplers, const Sampler& sampler) {
    for (const auto& [key, object] : samplers)
        if (key == sampler) return object.name();
    GLuint name = 0;
    glCreateSamplers(1, &name);
    glSamplerParameteri(name, GL_TEXTURE_MIN_FILTER, static_cast<GLint>(glFilter(sampler.minification)));
    glSamplerParameteri(name, GL_TEXTURE_MAG_FILTER, sampler.magnification == Filter::nearest ? GL_NEAREST : GL_LINEAR);
    glSamplerParameteri(name, GL_TEXTURE_WRAP_S, static_cast<GLint>(glWrap(sampler.wrapS)));
    glSamplerParameteri(name, GL_TEXTURE_WRAP_T, static_cast<GLint>(glWrap(sampler.wrapT)));
    // On a CPU rasteriser anisotropic filtering turns 2 ms into 500.
    if (GLAD_GL_EXT_texture_filter_anisotropic && !rendererInfo().software &&
        sampler.minification == Filter::linearMipLinear)
        glSamplerParameterf(name, GL_TEXTURE_MAX_ANISOTROPY_EXT, 8.0f);
    samplers.emplace_back(sampler, GlSampler(name));
    return name;
}

namespace {

std::uint32_t forDeformer(std::uint32_t vertex) {
    constexpr std::uint32_t kStep = Deformer::kVertexAlignment;
    return (vertex + kStep - 1) / kStep * kStep;
}

/// Calls with an instance's mesh's primitives that it bends, and their numbers among all primitives.
template <class Use>
void forEachBent(const Scene& scene, const UploadedGeometry& all, Use use) {
    for (const Instance& instance : scene.instances) {
        const auto mesh = static_cast<std::size_t>(instance.mesh);
        const std::vector<Primitive>& primitives = scene.meshes[mesh].primitives;
        for (std::size_t i = 0; i < primitives.size(); ++i)
            if (bends(instance, primitives[i])) use(primitives[i], all.primitives[all.firstPrimitive[mesh] + i]);
    }
}

/// RunError where 32 bits cannot number the vertices or indices.
void requireCountable(const Scene& scene) {
    std::uint64_t vertices = 0, indices = 0;
    const auto add = [&](const Primitive& primitive) {
        vertices += primitive.vertices.size() + Deformer::kVertexAlignment;
        indices += primitive.indices.size();
    };
    for (const Mesh& mesh : scene.meshes)
        for (const Primitive& primitive : mesh.primitives) add(primitive);
    for (const Instance& instance : scene.instances)
        for (const Primitive& primitive : scene.meshes[static_cast<std::size_t>(instance.mesh)].primitives)
            if (bends(instance, primitive)) add(primitive);
    constexpr std::uint64_t kMost = std::numeric_limits<std::uint32_t>::max();
    if (std::max(vertices, indices) > kMost)
        throw RunError(fmt::format("{} vertices and {} indices are too many for OpenGL, which counts up to {}",
                                   vertices, indices, kMost));
}

}  // namespace

std::array<const TextureSlot*, gpu::kMaterialTextures> textureSlots(const Material& m) {
    std::array<const TextureSlot*, gpu::kMaterialTextures> slots{};
    slots[gpu::kBaseColor] = &m.baseColorTexture;
    slots[gpu::kMetallicRoughness] = &m.metallicRoughnessTexture;
    slots[gpu::kNormal] = &m.normalTexture;
    slots[gpu::kEmissive] = &m.emissiveTexture;
    slots[gpu::kOcclusion] = &m.occlusionTexture;
    return slots;
}

gpu::MaterialData materialData(const Material& m) {
    // Of a blended surface, from this opacity on it is the one that the pixel's depth is taken from.
    constexpr float kMostOfTheLight = 0.5f;
    gpu::MaterialData data{};
    data.baseColor = m.baseColor;
    data.emissive = glm::vec4(m.emissive, m.normalScale);
    data.surface =
        glm::vec4(m.metallic, m.roughness, m.alphaMode == AlphaMode::blend ? kMostOfTheLight : m.alphaCutoff, 0.0f);
    data.light = glm::vec4(m.occlusionStrength, 0.0f, 0.0f, 0.0f);
    const auto slots = textureSlots(m);
    for (std::size_t i = 0; i < slots.size(); ++i) {
        const glm::mat3x2& map = slots[i]->imageFromVertex;
        data.uvLinear[i] = glm::vec4(map[0], map[1]);
        data.uvOffset[i] = glm::vec4(map[2], static_cast<float>(slots[i]->uvSet), 0.0f);
    }
    return data;
}

UploadedGeometry uploadMeshes(const Scene& scene) {
    UploadedGeometry all;
    for (const Mesh& mesh : scene.meshes) {
        all.firstPrimitive.push_back(all.primitives.size());
        all.primitives.resize(all.primitives.size() + mesh.primitives.size());
    }
    const auto forEach = [&](auto visit) {
        for (std::size_t m = 0; m < scene.meshes.size(); ++m)
            for (std::size_t p = 0; p < scene.meshes[m].primitives.size(); ++p)
                visit(scene.meshes[m].primitives[p], all.primitives[all.firstPrimitive[m] + p]);
    };
    std::uint32_t vertexCount = 0, indexCount = 0, extraCount = 0;
    requireCountable(scene);
    for (const bool extras : {true, false}) {
        forEach([&](const Primitive& primitive, PrimitiveRange& range) {
            if (primitive.extras.empty() == extras) return;
            if (primitive.deformation) vertexCount = forDeformer(vertexCount);
            range = {{indexCount, static_cast<std::uint32_t>(primitive.indices.size())}, vertexCount};
            vertexCount += static_cast<std::uint32_t>(primitive.vertices.size());
            indexCount += range.indices.count;
        });
        std::size_t posed = 0;
        forEachBent(scene, all, [&](const Primitive& primitive, const PrimitiveRange&) {
            all.posedVertices.resize(std::max(all.posedVertices.size(), ++posed));
            if (primitive.extras.empty() == extras) return;
            vertexCount = forDeformer(vertexCount);
            all.posedVertices[posed - 1] = vertexCount;
            vertexCount += static_cast<std::uint32_t>(primitive.vertices.size());
        });
        if (extras) extraCount = vertexCount;
    }
    all.vertices = Buffer(vertexCount * sizeof(Vertex), nullptr, true, "vertices");
    if (extraCount > 0) all.extras = Buffer(extraCount * sizeof(VertexExtra), nullptr, true, "vertices' extras");
    all.indices = Buffer(indexCount * sizeof(std::uint32_t), nullptr, true, "indices");
    forEach([&](const Primitive& primitive, const PrimitiveRange& range) {
        all.vertices.update(primitive.vertices.data(), primitive.vertices.size() * sizeof(Vertex),
                            range.baseVertex * sizeof(Vertex));
        if (!primitive.extras.empty())
            all.extras.update(primitive.extras.data(), primitive.extras.size() * sizeof(VertexExtra),
                              range.baseVertex * sizeof(VertexExtra));
        all.indices.update(primitive.indices.data(), primitive.indices.size() * sizeof(std::uint32_t),
                           range.indices.first * sizeof(std::uint32_t));
    });
    std::size_t posed = 0;
    forEachBent(scene, all, [&](const Primitive& primitive, const PrimitiveRange& range) {
        const std::uint32_t to = all.posedVertices[posed++];
        const auto copy = [&](const Buffer& buffer, std::size_t vertexBytes) {
            glCopyNamedBufferSubData(buffer.name(), buffer.name(),
                                     static_cast<GLintptr>(range.baseVertex * vertexBytes),
                                     static_cast<GLintptr>(to * vertexBytes),
                                     static_cast<GLsizeiptr>(primitive.vertices.size() * vertexBytes));
        };
        copy(all.vertices, sizeof(Vertex));
        if (!primitive.extras.empty()) copy(all.extras, sizeof(VertexExtra));
    });
    return all;
}

void describeVertices(const VertexArray& array, const Buffer& vertices, const Buffer& indices) {
    const GLuint vao = array.name();
    glVertexArrayVertexBuffer(vao, 0, vertices.name(), 0, sizeof(Vertex));
    // Read at a draw's base instance, whatever the instance: what lens samples see is drawn as instances.
    glVertexArrayBindingDivisor(vao, 1, gpu::kMostMatrices);
    glVertexArrayElementBuffer(vao, indices.name());
    struct Attribute {
        GLint components;
        std::size_t offset;
    };
    const Attribute attributes[] = {{3, offsetof(Vertex, position)},
                                    {3, offsetof(Vertex, normal)},
                                    {4, offsetof(Vertex, tangent)},
                                    {2, offsetof(Vertex, uv)}};
    for (GLuint i = 0; i < 4; ++i) {
        glEnableVertexArrayAttrib(vao, i);
        glVertexArrayAttribFormat(vao, i, attributes[i].components, GL_FLOAT, GL_FALSE,
                                  static_cast<GLuint>(attributes[i].offset));
        glVertexArrayAttribBinding(vao, i, 0);
    }
    for (GLuint column = 0; column < 4; ++column) {
        glEnableVertexArrayAttrib(vao, 4 + column);
        glVertexArrayAttribFormat(vao, 4 + column, 4, GL_FLOAT, GL_FALSE, column * sizeof(glm::vec4));
        glVertexArrayAttribBinding(vao, 4 + column, 1);
    }
}

void bindInstances(const VertexArray& array, const Buffer& matrices) {
    glVertexArrayVertexBuffer(array.name(), 1, matrices.name(), 0, sizeof(glm::mat4));
}

void describeExtras(const VertexArray& array, const Buffer& extras) {
    const GLuint vao = array.name();
    glVertexArrayVertexBuffer(vao, 2, extras.name(), 0, sizeof(VertexExtra));
    glVertexArrayAttribFormat(vao, 8, 2, GL_FLOAT, GL_FALSE, offsetof(VertexExtra, uv));
    glVertexArrayAttribFormat(vao, 9, 4, GL_UNSIGNED_SHORT, GL_TRUE, offsetof(VertexExtra, color));
    for (const GLuint attribute : {8u, 9u}) {
        glEnableVertexArrayAttrib(vao, attribute);
        glVertexArrayAttribBinding(vao, attribute, 2);
    }
}

gpu::LightData lightInView(const Light& light, const glm::dmat4& viewFromWorld) {
    const glm::dvec3 position(viewFromWorld * glm::dvec4(glm::dvec3(light.position), 1.0));
    const glm::dvec3 direction = glm::dmat3(viewFromWorld) * glm::dvec3(light.direction);
    return {glm::vec4(glm::vec3(position), static_cast<float>(light.kind)),
            glm::vec4(glm::vec3(direction), light.range), glm::vec4(light.color, 0.0f),
            glm::vec4(light.innerConeCos, light.outerConeCos, 0.0f, 0.0f)};
}

Light keyLight() {
    Light light;
    light.name = "key light";
    light.kind = LightKind::directional;
    light.color = glm::vec3(2.2f, 2.1f, 1.95f);
    light.direction = glm::normalize(glm::vec3(-0.45f, -0.8f, -0.55f));
    return light;
}

}  // namespace dioptre
