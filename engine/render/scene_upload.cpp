#include "render/scene_upload.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstddef>

#include "gl/context.hpp"

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

UploadedGeometry uploadMeshes(const Scene& scene) {
    UploadedGeometry all;
    std::uint32_t vertexCount = 0, indexCount = 0;
    for (const Mesh& mesh : scene.meshes) {
        all.firstPrimitive.push_back(all.primitives.size());
        for (const Primitive& primitive : mesh.primitives) {
            const auto indices = static_cast<std::uint32_t>(primitive.indices.size());
            all.primitives.push_back({indexCount, indices, vertexCount});
            vertexCount += static_cast<std::uint32_t>(primitive.vertices.size());
            indexCount += indices;
        }
    }
    all.vertices = Buffer(vertexCount * sizeof(Vertex), nullptr, true, "vertices");
    all.indices = Buffer(indexCount * sizeof(std::uint32_t), nullptr, true, "indices");
    std::size_t next = 0;
    for (const Mesh& mesh : scene.meshes) {
        for (const Primitive& primitive : mesh.primitives) {
            const PrimitiveRange& range = all.primitives[next++];
            all.vertices.update(primitive.vertices.data(), primitive.vertices.size() * sizeof(Vertex),
                                range.baseVertex * sizeof(Vertex));
            all.indices.update(primitive.indices.data(), primitive.indices.size() * sizeof(std::uint32_t),
                               range.firstIndex * sizeof(std::uint32_t));
        }
    }
    return all;
}

void describeVertices(const VertexArray& array, const Buffer& vertices, const Buffer& indices,
                      const Buffer& drawIndices) {
    const GLuint vao = array.name();
    glVertexArrayVertexBuffer(vao, 0, vertices.name(), 0, sizeof(Vertex));
    glVertexArrayVertexBuffer(vao, 1, drawIndices.name(), 0, sizeof(std::uint32_t));
    // Read at a draw's base instance, whatever the instance: matrices are drawn as instances.
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
    glEnableVertexArrayAttrib(vao, 4);
    glVertexArrayAttribIFormat(vao, 4, 1, GL_UNSIGNED_INT, 0);
    glVertexArrayAttribBinding(vao, 4, 1);
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
