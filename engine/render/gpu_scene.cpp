#include "render/gpu_scene.hpp"

#include <algorithm>
#include <cmath>

#include "render/scene_upload.hpp"
#include "scene/placement.hpp"
#include "shaders/shared/scene_types.h"

namespace dioptre {

namespace {

// A soft sky alone lights a scene that brings no lights; beside lights it only fills the shadows.
constexpr float kSkyAlone = 0.75f;
constexpr float kSkyBesideLights = 0.15f;

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
    kOcclusion = 1u << 8,
    kSurfaceMap = 1u << 9,
    kNormalMap = 1u << 10,
    kSpaced = 1u << 11
};
constexpr std::pair<Feature, const char*> kFeatureNames[] = {{kLit, "LIT"},
                                                             {kEmissive, "EMISSIVE"},
                                                             {kMask, "MASK"},
                                                             {kSolid, "SOLID"},
                                                             {kBlend, "BLEND"},
                                                             {kExtras, "EXTRAS"},
                                                             {kMapped, "MAPPED"},
                                                             {kOcclusion, "OCCLUSION"},
                                                             {kSurfaceMap, "SURFACE_MAP"},
                                                             {kNormalMap, "NORMAL_MAP"},
                                                             {kSpaced, "SPACED"}};

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

GpuScene::GpuScene(const Scene& scene)
    : vertexArray_(makeVertexArray("scene")), extrasVertexArray_(makeVertexArray("scene, with extras")) {
    textures_ = uploadTextures(scene);
    uploadMaterials(scene);
    uploadGeometry(scene);
    skyRadiance_ = scene.lights.empty() ? kSkyAlone : kSkyBesideLights;
    lights_ = scene.lights.empty() ? std::vector<Light>{keyLight()} : scene.lights;
    if (scene.motion) {
        pose_ = poseAt(*scene.motion, 0.0);
        applyPose();
    }
}

void GpuScene::pose(const MotionPose& pose, PassLog& log) {
    if (pose == pose_) return;
    PassScope scope(log, "pose");
    pose_ = pose;
    ++version_;
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
        bound.emits = m.emissive != glm::vec3(0.0f);
        bound.surfaceMapped = m.metallicRoughnessTexture.used();
        bound.bumped = m.normalTexture.used();
        data.push_back(materialData(m));
        for (const TextureSlot* slot : textureSlots(m)) {
            bound.textured = bound.textured || slot->used();
            bound.mapped = bound.mapped || (slot->used() && !slot->plain());
        }
    }
    materialBuffer_ = Buffer(std::span<const gpu::MaterialData>(data), "materials");
}

void GpuScene::uploadGeometry(const Scene& scene) {
    UploadedGeometry geometry = uploadMeshes(scene);
    vertices_ = std::move(geometry.vertices);
    extras_ = std::move(geometry.extras);
    indices_ = std::move(geometry.indices);
    if (!geometry.posedVertices.empty()) deformer_.emplace(scene.motion);
    for (const PrimitiveRange& range : geometry.primitives) {
        levels_.push_back({{range.indices}, {0.0f}});
        indexCount_ += range.indices.count;
    }
    firstPrimitive_ = geometry.firstPrimitive;
    std::size_t posed = 0;
    for (const Instance& instance : scene.instances) {
        const auto& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
        const auto first = geometry.firstPrimitive[static_cast<std::size_t>(instance.mesh)];
        for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
            const Primitive& primitive = mesh.primitives[i];
            std::uint32_t baseVertex = geometry.primitives[first + i].baseVertex;
            int bent = -1;
            if (bends(instance, primitive)) {
                const std::uint32_t firstPosed = geometry.posedVertices[posed++];
                bent = static_cast<int>(deformer_->add(instance, primitive, baseVertex, firstPosed));
                baseVertex = firstPosed;
            }
            if (primitive.indices.empty()) continue;
            const auto material = static_cast<std::uint32_t>(primitive.material);
            const State state{materials_[material].alphaMode == AlphaMode::blend,
                              material,
                              glm::determinant(glm::mat3(instance.worldFromMesh)) < 0.0f,
                              !primitive.extras.empty(),
                              primitive.lit,
                              primitive.topology};
            items_.push_back({state, static_cast<std::uint32_t>(first + i), baseVertex,
                              glm::dmat4(instance.worldFromMesh), primitive.bounds, instance.node, bent});
        }
    }
    if (deformer_) deformer_->upload();
    // Items that share all state are drawn by one call.
    std::stable_sort(items_.begin(), items_.end(), [](const Item& a, const Item& b) { return a.state < b.state; });
    describeVertices(vertexArray_, vertices_, indices_);
    describeVertices(extrasVertexArray_, vertices_, indices_);
    if (extras_) describeExtras(extrasVertexArray_, extras_);
}

void GpuScene::addLevel(std::size_t mesh, std::size_t primitive, const LodLevel& level) {
    const std::span<const std::uint32_t> indices(level.indices);
    const std::size_t needed = (indexCount_ + indices.size()) * sizeof(std::uint32_t);
    if (needed > indices_.bytes()) {
        // Levels that halve their triangles have no more than the first, all together: twice is mostly enough.
        Buffer larger(std::max(needed, 2 * indices_.bytes()), nullptr, true, "indices");
        glCopyNamedBufferSubData(indices_.name(), larger.name(), 0, 0, static_cast<GLsizeiptr>(indices_.bytes()));
        indices_ = std::move(larger);
        for (const VertexArray* array : {&vertexArray_, &extrasVertexArray_})
            glVertexArrayElementBuffer(array->name(), indices_.name());
    }
    indices_.update(indices.data(), indices.size_bytes(), indexCount_ * sizeof(std::uint32_t));
    const auto count = static_cast<std::uint32_t>(indices.size());
    Levels& levels = levels_[firstPrimitive_[mesh] + primitive];
    levels.indices.push_back({indexCount_, count});
    levels.errors.push_back(level.error);
    indexCount_ += count;
    ++version_;
}

std::size_t GpuScene::bytes() const {
    std::size_t sum = vertices_.bytes() + extras_.bytes() + indices_.bytes();
    for (const auto& [key, texture] : textures_) sum += texture.bytes();
    return deformer_ ? sum + deformer_->bytes() : sum;
}

const Program& GpuScene::programFor(unsigned features) const {
    const auto found = programs_.find(features);
    return found != programs_.end() ? found->second : programs_.emplace(features, program(features)).first->second;
}

unsigned GpuScene::featuresOf(const State& state, Phase phase, bool spaced) const {
    const BoundMaterial& m = materials_[state.material];
    const unsigned alpha = m.alphaMode == AlphaMode::opaque ? 0u : static_cast<unsigned>(kMask);
    const unsigned vertex = (state.extras ? kExtras : 0u) | (m.mapped ? kMapped : 0u);
    // Depth alone asks for the surface only where that has holes.
    if (phase == Phase::depth) return kDepthOnly | (alpha ? alpha | vertex : 0u);
    // A texture that is not there is not asked for: four of a surface's five take more time than its light.
    unsigned shading = 0u;
    if (m.lit && m.emits) shading |= kEmissive;
    if (m.lit && state.lit)
        shading |=
            kLit | (m.occluded ? kOcclusion : 0u) | (m.surfaceMapped ? kSurfaceMap : 0u) | (m.bumped ? kNormalMap : 0u);
    const unsigned seen = !state.blended ? alpha : phase == Phase::blended ? kBlend : kSolid;
    const unsigned reading = spaced && m.textured && m.alphaMode != AlphaMode::mask ? kSpaced : 0u;
    return vertex | shading | seen | reading;
}

int GpuScene::mostMatrices() {
    return GLAD_GL_ARB_shader_viewport_layer_array ? gpu::kMostMatrices : 1;
}

void GpuScene::seeWhole(const View& view, double detailPx, const Sight* sight) const {
    see(whole_, view, nullptr, sight);
    std::vector<std::int8_t> levels;
    levels.reserve(whole_.seen().size());
    for (const DrawList::Seen& seen : whole_.seen())
        levels.push_back(static_cast<std::int8_t>(levelWithin(view, seen, detailPx)));
    arrange(whole_, 1, levels);
}

void GpuScene::drawRadiance(const View& view, float exposure, double detailPx, const Sight* sight) const {
    seeWhole(view, detailPx, sight);
    const glm::mat4 clip(clipFromView(view));
    const Through through{{&clip, 1}, exposure};
    const std::vector<Run>& runs = whole_.runs_;
    drawRuns(whole_, runs, Phase::surface, through);
    if (whole_.blendedRuns_.empty()) return;
    drawBlended(whole_, through);
    const auto first = std::find_if(runs.begin(), runs.end(), [](const Run& run) { return run.state.blended; });
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    drawRuns(whole_, {first, runs.end()}, Phase::depth, through);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

void GpuScene::drawDepth(const View& view, double detailPx) const {
    seeWhole(view, detailPx, nullptr);
    const glm::mat4 clip(clipFromView(view));
    drawRuns(whole_, whole_.runs_, Phase::depth, {{&clip, 1}});
}

void GpuScene::drawThroughLens(const DrawList& list, std::span<const glm::mat4> clipFromView, float exposure,
                               const TextureFilter& filter, int firstLayer) const {
    const Through through{clipFromView, exposure, firstLayer, filter};
    drawRuns(list, list.runs_, Phase::surface, through);
    drawBlended(list, through);
}

// In the samplers: a bias in the shaders costs a CPU rasteriser 40 % of a pinhole frame, whatever its value.
void GpuScene::setLodBias(float bias) const {
    if (bias != lodBias_)
        for (const auto& [description, sampler] : samplers_)
            glSamplerParameterf(sampler.name(), GL_TEXTURE_LOD_BIAS, bias);
    lodBias_ = bias;
}

void GpuScene::drawBlended(const DrawList& list, const Through& through) const {
    if (list.blendedRuns_.empty()) return;
    glEnable(GL_BLEND);
    // Alpha is left with how much of what is behind is seen.
    glBlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE_MINUS_SRC_ALPHA);
    glDepthMask(GL_FALSE);
    drawRuns(list, list.blendedRuns_, Phase::blended, through);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
}

void GpuScene::drawRuns(const DrawList& list, std::span<const Run> runs, Phase phase, const Through& through) const {
    if (runs.empty()) return;
    setLodBias(through.filter.levelBias);
    const CocTransform& spacing = through.filter.spacing;
    const bool spaced = spacing.scale != 0.0f || spacing.bias != 0.0f;
    for (const VertexArray* array : {&vertexArray_, &extrasVertexArray_}) bindInstances(*array, list.instances_);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, list.lights_.name());
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, list.commands_.name());
    glEnable(GL_DEPTH_TEST);

    const Program* current = nullptr;
    for (const Run& run : runs) {
        const Program& program = programFor(featuresOf(run.state, phase, spaced));
        if (&program != current) {
            program.use();
            program.set("clipFromView", through.clipFromView);
            program.set("exposure", through.exposure);
            program.set("up", glm::vec4(list.up_, skyRadiance_));
            program.set("firstLayer", through.firstLayer);
            program.set("lightCount", static_cast<int>(lights_.size()));
            program.set("textureSpacing", glm::vec2(spacing.scale, spacing.bias));
            current = &program;
        }
        bind(run);
        trianglesDrawn_ += run.triangles;
        glMultiDrawElementsIndirect(glMode(run.state.topology), GL_UNSIGNED_INT,
                                    reinterpret_cast<const void*>(run.firstCommand * sizeof(DrawList::Command)),
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
    glBindBufferRange(GL_UNIFORM_BUFFER, 0, materialBuffer_.name(), run.state.material * sizeof(gpu::MaterialData),
                      sizeof(gpu::MaterialData));
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
