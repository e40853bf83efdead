#include "render/gpu_scene.hpp"

#include <algorithm>
#include <numeric>

#include "render/scene_upload.hpp"
#include "scene/placement.hpp"
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

// Variants of the shaders; all but the first are names that they know.
enum Feature : unsigned {
    kDepthOnly = 1u << 0,
    kLit = 1u << 1,
    kEmissive = 1u << 2,
    kMask = 1u << 3,
    kSolid = 1u << 4,
    kBlend = 1u << 5,
    kExtras = 1u << 6,
    kMapped = 1u << 7,
    kOcclusion = 1u << 8
};
constexpr std::pair<Feature, const char*> kFeatureNames[] = {
    {kLit, "LIT"},     {kEmissive, "EMISSIVE"}, {kMask, "MASK"},     {kSolid, "SOLID"},
    {kBlend, "BLEND"}, {kExtras, "EXTRAS"},     {kMapped, "MAPPED"}, {kOcclusion, "OCCLUSION"}};

Program program(unsigned features) {
    std::vector<std::string> defines;
    for (const auto& [feature, name] : kFeatureNames)
        if (features & feature) defines.emplace_back(name);
    if (GpuScene::mostMatrices() > 1) defines.emplace_back("LAYERED");
    return {"scene/scene.vert.glsl", features & kDepthOnly ? "scene/depth.frag.glsl" : "scene/surface.frag.glsl",
            defines};
}

GLenum glMode(Topology topology) {
    switch (topology) {
        case Topology::points:
            return GL_POINTS;
        case Topology::lines:
            return GL_LINES;
        case Topology::triangles:
            return GL_TRIANGLES;
    }
    return GL_TRIANGLES;
}

}  // namespace

// What prepare() gathers on the way.
struct GpuScene::Preparation {
    int matrices = 1;
    std::vector<gpu::InstanceData> instances;
    std::vector<DrawCommand> commands;
};

GpuScene::GpuScene(const Scene& scene)
    : vertexArray_(makeVertexArray("scene")), extrasVertexArray_(makeVertexArray("scene, with extras")) {
    textures_ = uploadTextures(scene);
    for (const auto& [key, texture] : textures_) bytes_ += texture.bytes();
    uploadMaterials(scene);
    uploadGeometry(scene);
    makePrograms();
    skyRadiance_ = scene.lights.empty() ? kSkyAlone : kSkyBesideLights;
    lights_ = scene.lights.empty() ? std::vector<Light>{keyLight()} : scene.lights;
    lightBuffer_ = Buffer(lights_.size() * sizeof(gpu::LightData), nullptr, true, "lights");
    if (scene.motion) {
        pose_ = poseAt(*scene.motion, 0.0);
        applyPose();
    }
}

void GpuScene::pose(const MotionPose& pose, PassLog& log) {
    if (pose == pose_) return;
    PassScope scope(log, "pose");
    pose_ = pose;
    ++poseNumber_;
    applyPose();
}

void GpuScene::applyPose() {
    std::vector<Deformer::Placed> bent;
    if (deformer_) bent = deformer_->pose(pose_, vertices_);
    for (Item& item : items_) {
        if (item.bent >= 0) {
            const Deformer::Placed& placed = bent[static_cast<std::size_t>(item.bent)];
            item.worldFromMesh = placed.worldFromMesh;
            item.state.mirrored = placed.mirrored;
            item.bounds = placed.bounds;
        } else if (item.node >= 0) {
            item.worldFromMesh = pose_.worldFromNode[static_cast<std::size_t>(item.node)];
            item.state.mirrored = glm::determinant(glm::dmat3(item.worldFromMesh)) < 0.0;
        }
    }
    for (Light& light : lights_)
        if (light.node >= 0) place(light, glm::mat4(pose_.worldFromNode[static_cast<std::size_t>(light.node)]));
}

void GpuScene::uploadMaterials(const Scene& scene) {
    const auto bind = [&](const TextureSlot& slot, TextureUse use) {
        return TextureBinding{&findTexture(textures_, slot.image, use), samplerFor(samplers_, slot.sampler)};
    };
    std::vector<gpu::MaterialData> data;
    for (const Material& m : scene.materials) {
        BoundMaterial& bound = materials_.emplace_back();
        bound.textures[gpu::kBaseColor] = bind(m.baseColorTexture, TextureUse::color);
        bound.textures[gpu::kMetallicRoughness] = bind(m.metallicRoughnessTexture, TextureUse::data);
        bound.textures[gpu::kNormal] = bind(m.normalTexture, TextureUse::normal);
        bound.textures[gpu::kEmissive] = bind(m.emissiveTexture, TextureUse::color);
        bound.textures[gpu::kOcclusion] = bind(m.occlusionTexture, TextureUse::data);
        bound.alphaMode = m.alphaMode;
        bound.lit = !m.unlit;
        bound.doubleSided = m.doubleSided;
        bound.occluded = m.occlusionTexture.used();
        data.push_back(materialData(m));
        for (const TextureSlot* slot : textureSlots(m)) bound.mapped = bound.mapped || (slot->used() && !slot->plain());
    }
    materialBuffer_ = Buffer(std::span<const gpu::MaterialData>(data), "materials");
}

void GpuScene::uploadGeometry(const Scene& scene) {
    UploadedGeometry geometry = uploadMeshes(scene);
    vertices_ = std::move(geometry.vertices);
    extras_ = std::move(geometry.extras);
    indices_ = std::move(geometry.indices);
    bytes_ += vertices_.bytes() + extras_.bytes() + indices_.bytes();
    if (!geometry.posedVertices.empty()) deformer_.emplace(scene.motion);
    std::size_t posed = 0;
    for (const Instance& instance : scene.instances) {
        const auto& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
        const auto first = geometry.firstPrimitive[static_cast<std::size_t>(instance.mesh)];
        for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
            const Primitive& primitive = mesh.primitives[i];
            PrimitiveRange range = geometry.primitives[first + i];
            int bent = -1;
            if (bends(instance, primitive)) {
                const std::uint32_t firstPosed = geometry.posedVertices[posed++];
                bent = static_cast<int>(deformer_->add(instance, primitive, range.baseVertex, firstPosed));
                range.baseVertex = firstPosed;
            }
            if (primitive.indices.empty()) continue;
            const auto material = static_cast<std::uint32_t>(primitive.material);
            const State state{materials_[material].alphaMode == AlphaMode::blend,
                              material,
                              glm::determinant(glm::mat3(instance.worldFromMesh)) < 0.0f,
                              !primitive.extras.empty(),
                              primitive.lit,
                              primitive.topology};
            items_.push_back({state, range, glm::dmat4(instance.worldFromMesh), primitive.bounds, instance.node, bent});
            blendedItems_ += state.blended ? 1 : 0;
        }
    }
    if (deformer_) {
        deformer_->upload();
        bytes_ += deformer_->bytes();
    }
    // Items that share all state are drawn by one call.
    std::stable_sort(items_.begin(), items_.end(), [](const Item& a, const Item& b) { return a.state < b.state; });
    std::vector<std::uint32_t> drawIndex(items_.size());
    std::iota(drawIndex.begin(), drawIndex.end(), 0u);
    drawIndices_ = Buffer(std::span<const std::uint32_t>(drawIndex), "draw indices");
    instances_ = Buffer(items_.size() * sizeof(gpu::InstanceData), nullptr, true, "instances");
    // A blended item is drawn as what is opaque of it, then its back and its front.
    commands_ = Buffer((items_.size() + 2 * blendedItems_) * sizeof(DrawCommand), nullptr, true, "draw commands");
    describeVertices(vertexArray_, vertices_, indices_, drawIndices_);
    describeVertices(extrasVertexArray_, vertices_, indices_, drawIndices_);
    if (extras_) describeExtras(extrasVertexArray_, extras_);
}

void GpuScene::makePrograms() {
    for (const Item& item : items_) {
        for (const Phase phase : {Phase::surface, Phase::blended, Phase::depth}) {
            if (phase == Phase::blended && !item.state.blended) continue;
            const unsigned features = featuresOf(item.state, phase);
            if (!programs_.contains(features)) programs_.emplace(features, program(features));
        }
    }
}

unsigned GpuScene::featuresOf(const State& state, Phase phase) const {
    const BoundMaterial& m = materials_[state.material];
    const unsigned alpha = m.alphaMode == AlphaMode::opaque ? 0u : static_cast<unsigned>(kMask);
    const unsigned vertex = (state.extras ? kExtras : 0u) | (m.mapped ? kMapped : 0u);
    // Depth alone asks for the surface only where that has holes.
    if (phase == Phase::depth) return kDepthOnly | (alpha ? alpha | vertex : 0u);
    const unsigned shading = !m.lit ? 0u : !state.lit ? kEmissive : m.occluded ? kLit | kOcclusion : kLit;
    const unsigned seen = !state.blended ? alpha : phase == Phase::blended ? kBlend : kSolid;
    return vertex | shading | seen;
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
    setLodBias(0.0f);
    const glm::mat4 clip(clipFromView(view));
    const Through through{{&clip, 1}, exposure};
    drawRuns(runs_, Phase::surface, through);
    if (blendedRuns_.empty()) return;
    drawBlended(through);
    const auto first = std::find_if(runs_.begin(), runs_.end(), [](const Run& run) { return run.state.blended; });
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    drawRuns({first, runs_.end()}, Phase::depth, through);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

void GpuScene::drawDepth(const View& view) const {
    prepare(view, nullptr, 1);
    setLodBias(0.0f);
    const glm::mat4 clip(clipFromView(view));
    drawRuns(runs_, Phase::depth, {{&clip, 1}, 1.0f});
}

void GpuScene::prepareThroughLens(const View& view, const Lens& lens, int matrices) const {
    prepare(view, &lens, matrices);
}

void GpuScene::drawThroughLens(std::span<const glm::mat4> clipFromView, float exposure, float lodBias) const {
    setLodBias(lodBias);
    drawRuns(runs_, Phase::surface, {clipFromView, exposure});
    drawBlended({clipFromView, exposure});
}

void GpuScene::append(Preparation& preparation, std::vector<Run>& runs, std::size_t item, Faces faces) const {
    const State& state = items_[item].state;
    const PrimitiveRange& range = items_[item].range;
    if (runs.empty() || runs.back().state != state || runs.back().faces != faces)
        runs.push_back({state, faces, preparation.commands.size()});
    Run& run = runs.back();
    ++run.commandCount;
    if (state.topology == Topology::triangles)
        run.triangles += range.indexCount / 3 * static_cast<std::uint64_t>(preparation.matrices);
    preparation.commands.push_back({range.indexCount, static_cast<GLuint>(preparation.matrices), range.firstIndex,
                                    static_cast<GLint>(range.baseVertex), static_cast<GLuint>(item)});
}

void GpuScene::prepare(const View& view, const Lens* lens, int matrices) const {
    const glm::dmat4 viewFrom = viewFromWorld(view.pose);
    // What this view sees, in order of state; the matrices are made eye-relative in double precision.
    Preparation seen{matrices, std::vector<gpu::InstanceData>(items_.size()), {}};
    std::vector<std::pair<double, std::size_t>> blended;  // depth of the centre, item
    runs_.clear();
    blendedRuns_.clear();
    for (std::size_t i = 0; i < items_.size(); ++i) {
        const Item& item = items_[i];
        const glm::dmat4 viewFromMesh = viewFrom * item.worldFromMesh;
        const Box box = transformed(viewFromMesh, item.bounds);
        if (!mayBeSeen(view, lens, box)) continue;
        seen.instances[i] = {glm::mat4(viewFromMesh), glm::uvec4(item.state.material, 0, 0, 0)};
        append(seen, runs_, i, Faces::asMaterial);
        if (item.state.blended) blended.emplace_back(-box.centre.z, i);
    }
    std::stable_sort(blended.begin(), blended.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    for (const auto& [depth, i] : blended) {
        const State& state = items_[i].state;
        const bool twice = materials_[state.material].doubleSided && state.topology == Topology::triangles;
        if (twice) append(seen, blendedRuns_, i, Faces::back);
        append(seen, blendedRuns_, i, twice ? Faces::front : Faces::asMaterial);
    }
    if (seen.commands.empty()) return;
    instances_.update(seen.instances.data(), seen.instances.size() * sizeof(gpu::InstanceData));
    commands_.update(seen.commands.data(), seen.commands.size() * sizeof(DrawCommand));
    std::vector<gpu::LightData> lights;
    for (const Light& light : lights_) lights.push_back(lightInView(light, viewFrom));
    lightBuffer_.update(lights.data(), lights.size() * sizeof(gpu::LightData));
    up_ = glm::vec3(viewFrom[1]);
}

// In the samplers: a bias in the shaders costs a CPU rasteriser 40 % of a pinhole frame, whatever its value.
void GpuScene::setLodBias(float bias) const {
    if (bias != lodBias_)
        for (const auto& [description, sampler] : samplers_)
            glSamplerParameterf(sampler.name(), GL_TEXTURE_LOD_BIAS, bias);
    lodBias_ = bias;
}

void GpuScene::drawBlended(const Through& through) const {
    if (blendedRuns_.empty()) return;
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glDepthMask(GL_FALSE);
    drawRuns(blendedRuns_, Phase::blended, through);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
}

void GpuScene::drawRuns(std::span<const Run> runs, Phase phase, const Through& through) const {
    if (runs.empty()) return;
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, instances_.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, materialBuffer_.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, lightBuffer_.name());
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, commands_.name());
    glEnable(GL_DEPTH_TEST);

    const Program* current = nullptr;
    for (const Run& run : runs) {
        const Program& program = programs_.at(featuresOf(run.state, phase));
        if (&program != current) {
            program.use();
            program.set("clipFromView", through.clipFromView);
            program.set("exposure", through.exposure);
            program.set("up", glm::vec4(up_, skyRadiance_));
            program.set("lightCount", static_cast<int>(lights_.size()));
            current = &program;
        }
        bind(run);
        trianglesDrawn_ += run.triangles;
        glMultiDrawElementsIndirect(glMode(run.state.topology), GL_UNSIGNED_INT,
                                    reinterpret_cast<const void*>(run.firstCommand * sizeof(DrawCommand)),
                                    static_cast<GLsizei>(run.commandCount), 0);
    }
    // Full-screen passes rely on these.
    for (GLuint unit = 0; unit < gpu::kMaterialTextures; ++unit) glBindSampler(unit, 0);
    glCullFace(GL_BACK);
    glDisable(GL_CULL_FACE);
    glDisable(GL_DEPTH_TEST);
}

void GpuScene::bind(const Run& run) const {
    const BoundMaterial& material = materials_[run.state.material];
    glBindVertexArray(run.state.extras ? extrasVertexArray_.name() : vertexArray_.name());
    for (GLuint unit = 0; unit < gpu::kMaterialTextures; ++unit) {
        material.textures[unit].texture->bind(unit);
        glBindSampler(unit, material.textures[unit].sampler);
    }
    if (material.doubleSided && run.faces == Faces::asMaterial)
        glDisable(GL_CULL_FACE);
    else
        glEnable(GL_CULL_FACE);
    glCullFace(run.faces == Faces::back ? GL_FRONT : GL_BACK);
    glFrontFace(run.state.mirrored ? GL_CW : GL_CCW);
}

}  // namespace dioptre
