#include "render/gpu_scene.hpp"

#include <algorithm>
#include <numeric>

#include "render/scene_upload.hpp"
#include "shaders/shared/scene_types.h"

namespace dioptre {

namespace {

// A soft sky alone lights a scene that brings no lights; beside lights it only fills the shadows.
constexpr float kSkyAlone = 0.75f;
constexpr float kSkyBesideLights = 0.15f;

struct DrawCommand {
    GLuint count, instanceCount, firstIndex;
    GLint baseVertex;
    GLuint baseInstance;
};

/// Axis-aligned box around a transformed box, by Arvo 1990.
struct Box {
    glm::dvec3 centre, half;
};
Box transformed(const glm::dmat4& m, const Bounds& b) {
    const glm::dvec3 half = glm::dvec3(b.size()) * 0.5;
    const glm::dmat3 r(m);
    return {glm::dvec3(m * glm::dvec4(glm::dvec3(b.centre()), 1.0)),
            glm::abs(r[0]) * half.x + glm::abs(r[1]) * half.y + glm::abs(r[2]) * half.z};
}

/// False only if no point of the box can be inside the frustum (tangents at unit distance, looking along -z), seen from
/// any point of the lens: that moves it sideways by up to E |Df d - 1|.
bool mayBeSeen(const View& view, const Lens* lens, const Box& box) {
    const Frustum& f = view.frustum;
    double blur = 0.0;
    if (lens)
        for (const double d : {-box.centre.z - box.half.z, -box.centre.z + box.half.z})
            blur = std::max(blur, lens->apertureRadius.value * std::abs(lens->focus.value * d - 1.0));
    const glm::dvec3 half = box.half + glm::dvec3(blur, blur, 0.0);
    const glm::dvec3 inward[] = {{1.0, 0.0, f.left}, {-1.0, 0.0, -f.right}, {0.0, 1.0, f.bottom}, {0.0, -1.0, -f.top}};
    for (const glm::dvec3& n : inward)
        if (glm::dot(n, box.centre) + glm::dot(glm::abs(n), half) < 0.0) return false;
    return -box.centre.z + box.half.z >= view.near.value;
}

Program program(std::string_view fragment, std::vector<std::string> defines) {
    if (GpuScene::mostMatrices() > 1) defines.push_back("LAYERED");
    return {"scene/scene.vert.glsl", fragment, defines};
}

}  // namespace

GpuScene::GpuScene(const Scene& scene)
    : vertexArray_(makeVertexArray("scene")),
      unlit_(program("scene/surface.frag.glsl", {})),
      unlitMask_(program("scene/surface.frag.glsl", {"MASK"})),
      lit_(program("scene/surface.frag.glsl", {"LIT"})),
      litMask_(program("scene/surface.frag.glsl", {"LIT", "MASK"})),
      depth_(program("scene/depth.frag.glsl", {})),
      depthMask_(program("scene/depth.frag.glsl", {"MASK"})) {
    textures_ = uploadTextures(scene);
    for (const auto& [key, texture] : textures_) bytes_ += texture.bytes();
    uploadMaterials(scene);
    uploadGeometry(scene);
    skyRadiance_ = scene.lights.empty() ? kSkyAlone : kSkyBesideLights;
    lights_ = scene.lights.empty() ? std::vector<Light>{keyLight()} : scene.lights;
    lightBuffer_ = Buffer(lights_.size() * sizeof(gpu::LightData), nullptr, true, "lights");
}

void GpuScene::uploadMaterials(const Scene& scene) {
    const auto bind = [&](const TextureSlot& slot, TextureUse use) {
        return TextureBinding{&findTexture(textures_, slot.image, use), samplerFor(samplers_, slot.sampler)};
    };
    std::vector<gpu::MaterialData> data;
    for (const Material& m : scene.materials) {
        materials_.push_back(
            {{bind(m.baseColorTexture, TextureUse::color), bind(m.metallicRoughnessTexture, TextureUse::data),
              bind(m.normalTexture, TextureUse::normal), bind(m.emissiveTexture, TextureUse::color)},
             !m.unlit,
             m.alphaMode == AlphaMode::mask,
             m.doubleSided});
        data.push_back({m.baseColor, glm::vec4(m.emissive, m.normalScale),
                        glm::vec4(m.metallic, m.roughness, m.alphaCutoff, m.normalTexture.used() ? 1.0f : 0.0f)});
    }
    materialBuffer_ = Buffer(std::span<const gpu::MaterialData>(data), "materials");
}

void GpuScene::uploadGeometry(const Scene& scene) {
    UploadedGeometry geometry = uploadMeshes(scene);
    vertices_ = std::move(geometry.vertices);
    indices_ = std::move(geometry.indices);
    bytes_ += vertices_.bytes() + indices_.bytes();
    for (const Instance& instance : scene.instances) {
        const auto& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
        const auto first = geometry.firstPrimitive[static_cast<std::size_t>(instance.mesh)];
        for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
            const Primitive& primitive = mesh.primitives[i];
            if (primitive.indices.empty()) continue;
            const PrimitiveRange& range = geometry.primitives[first + i];
            items_.push_back({range.firstIndex, range.indexCount, range.baseVertex,
                              static_cast<std::uint32_t>(primitive.material),
                              glm::determinant(glm::mat3(instance.worldFromMesh)) < 0.0f,
                              glm::dmat4(instance.worldFromMesh), primitive.bounds});
        }
    }
    // Items that share all state are drawn by one call: sort by material, then by winding.
    std::stable_sort(items_.begin(), items_.end(), [](const Item& a, const Item& b) {
        return std::pair(a.material, a.mirrored) < std::pair(b.material, b.mirrored);
    });
    std::vector<std::uint32_t> drawIndex(items_.size());
    std::iota(drawIndex.begin(), drawIndex.end(), 0u);
    drawIndices_ = Buffer(std::span<const std::uint32_t>(drawIndex), "draw indices");
    instances_ = Buffer(items_.size() * sizeof(gpu::InstanceData), nullptr, true, "instances");
    commands_ = Buffer(items_.size() * sizeof(DrawCommand), nullptr, true, "draw commands");
    describeVertices(vertexArray_, vertices_, indices_, drawIndices_);
}

const Program& GpuScene::programFor(const BoundMaterial& m, bool depthOnly) const {
    if (depthOnly) return m.mask ? depthMask_ : depth_;
    if (m.lit) return m.mask ? litMask_ : lit_;
    return m.mask ? unlitMask_ : unlit_;
}

VergenceRange GpuScene::vergenceRange(const View& view) const {
    const glm::dmat4 viewFrom = viewFromWorld(view.pose);
    VergenceRange range;
    for (const Item& item : items_) {
        const Box box = transformed(viewFrom * item.worldFromMesh, item.bounds);
        if (!mayBeSeen(view, nullptr, box)) continue;
        const double near = std::max(view.near.value, -box.centre.z - box.half.z);
        const double far = std::max(near, -box.centre.z + box.half.z);
        range.nearest = range.anything ? std::max(range.nearest, 1.0 / near) : 1.0 / near;
        range.farthest = range.anything ? std::min(range.farthest, 1.0 / far) : 1.0 / far;
        range.anything = true;
    }
    return range;
}

int GpuScene::mostMatrices() {
    return GLAD_GL_ARB_shader_viewport_layer_array ? gpu::kMostMatrices : 1;
}

void GpuScene::drawRadiance(const View& view, float exposure) const {
    prepare(view, nullptr, 1);
    const glm::mat4 clip(clipFromView(view));
    draw({&clip, 1}, exposure, 0.0f, false);
}

void GpuScene::drawDepth(const View& view) const {
    prepare(view, nullptr, 1);
    const glm::mat4 clip(clipFromView(view));
    draw({&clip, 1}, 1.0f, 0.0f, true);
}

void GpuScene::prepareThroughLens(const View& view, const Lens& lens, int matrices) const {
    prepare(view, &lens, matrices);
}

void GpuScene::drawThroughLens(std::span<const glm::mat4> clipFromView, float exposure, float lodBias) const {
    draw(clipFromView, exposure, lodBias, false);
}

void GpuScene::prepare(const View& view, const Lens* lens, int matrices) const {
    const glm::dmat4 viewFrom = viewFromWorld(view.pose);
    // What this view sees, in order of state; the matrices are made eye-relative in double precision.
    std::vector<gpu::InstanceData> instances(items_.size());
    std::vector<DrawCommand> commands;
    runs_.clear();
    triangles_ = 0;
    for (std::size_t i = 0; i < items_.size(); ++i) {
        const Item& item = items_[i];
        const glm::dmat4 viewFromMesh = viewFrom * item.worldFromMesh;
        if (!mayBeSeen(view, lens, transformed(viewFromMesh, item.bounds))) continue;
        instances[i] = {glm::mat4(viewFromMesh), glm::uvec4(item.material, 0, 0, 0)};
        if (runs_.empty() || runs_.back().material != item.material || runs_.back().mirrored != item.mirrored)
            runs_.push_back({item.material, item.mirrored, commands.size(), 0});
        ++runs_.back().commandCount;
        triangles_ += item.indexCount / 3 * static_cast<std::uint64_t>(matrices);
        commands.push_back({item.indexCount, static_cast<GLuint>(matrices), item.firstIndex,
                            static_cast<GLint>(item.baseVertex), static_cast<GLuint>(i)});
    }
    if (commands.empty()) return;
    instances_.update(instances.data(), instances.size() * sizeof(gpu::InstanceData));
    commands_.update(commands.data(), commands.size() * sizeof(DrawCommand));
    std::vector<gpu::LightData> lights;
    for (const Light& light : lights_) lights.push_back(lightInView(light, viewFrom));
    lightBuffer_.update(lights.data(), lights.size() * sizeof(gpu::LightData));
    up_ = glm::vec3(viewFrom[1]);
}

void GpuScene::draw(std::span<const glm::mat4> clipFromView, float exposure, float lodBias, bool depthOnly) const {
    if (runs_.empty()) return;
    trianglesDrawn_ += triangles_;
    // In the samplers: a bias in the shaders costs a CPU rasteriser 40 % of a pinhole frame, whatever its value.
    if (lodBias != lodBias_)
        for (const auto& [description, sampler] : samplers_)
            glSamplerParameterf(sampler.name(), GL_TEXTURE_LOD_BIAS, lodBias);
    lodBias_ = lodBias;
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, instances_.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, materialBuffer_.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, lightBuffer_.name());
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, commands_.name());
    glBindVertexArray(vertexArray_.name());
    glEnable(GL_DEPTH_TEST);

    const Program* current = nullptr;
    for (const Run& run : runs_) {
        const BoundMaterial& material = materials_[run.material];
        const Program& program = programFor(material, depthOnly);
        if (&program != current) {
            program.use();
            program.set("clipFromView", clipFromView);
            program.set("exposure", exposure);
            program.set("up", glm::vec4(up_, skyRadiance_));
            program.set("lightCount", static_cast<int>(lights_.size()));
            current = &program;
        }
        for (GLuint unit = 0; unit < 4; ++unit) {
            material.textures[unit].texture->bind(unit);
            glBindSampler(unit, material.textures[unit].sampler);
        }
        if (material.doubleSided)
            glDisable(GL_CULL_FACE);
        else
            glEnable(GL_CULL_FACE);
        glFrontFace(run.mirrored ? GL_CW : GL_CCW);
        glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT,
                                    reinterpret_cast<const void*>(run.firstCommand * sizeof(DrawCommand)),
                                    static_cast<GLsizei>(run.commandCount), 0);
    }
    // Full-screen passes rely on these.
    for (GLuint unit = 0; unit < 4; ++unit) glBindSampler(unit, 0);
    glDisable(GL_CULL_FACE);
    glDisable(GL_DEPTH_TEST);
}

}  // namespace dioptre
