#include "render/deformer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

#include "core/error.hpp"
#include "shaders/shared/deform_types.h"

namespace dioptre {

namespace {

constexpr std::size_t kAlignment = 256;       // of ranges of a buffer, bytes: no driver asks for more
constexpr std::uint32_t kMostGroups = 65535;  // that any driver must take

static_assert(offsetof(Vertex, position) == 0 && offsetof(Vertex, normal) == 3 * sizeof(float) &&
              offsetof(Vertex, tangent) == 6 * sizeof(float) && sizeof(Vertex) % sizeof(float) == 0);
static_assert(Deformer::kVertexAlignment * sizeof(Vertex) % kAlignment == 0);
static_assert(sizeof(Influence) == sizeof(gpu::InfluenceData) &&
              offsetof(Influence, weight) == offsetof(gpu::InfluenceData, weight));

std::size_t aligned(std::size_t bytes) {
    return (bytes + kAlignment - 1) / kAlignment * kAlignment;
}

void requireBlock(std::uint64_t bytes, std::string_view what) {
    GLint64 most = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most);
    if (bytes > static_cast<std::uint64_t>(most))
        throw RunError(fmt::format("{} of one primitive take {} bytes, the driver's limit is {}", what, bytes, most));
}

/// Position, normal and tangent side by side, as wide as any target of the primitive needs.
std::uint32_t widthOf(const Deformation& deformation) {
    std::uint32_t width = 3;
    for (const MorphTarget& target : deformation.targets)
        width = std::max({width, target.normals.empty() ? 3u : 6u, target.tangents.empty() ? 3u : 9u});
    return width;
}

std::vector<float> interleaved(const MorphTarget& target, std::size_t vertexCount, std::size_t width) {
    std::vector<float> out(vertexCount * width, 0.0f);
    std::size_t at = 0;
    for (const auto* part : {&target.positions, &target.normals, &target.tangents}) {
        for (std::size_t v = 0; v < part->size(); ++v)
            for (std::size_t c = 0; c < 3; ++c) out[v * width + at + c] = (*part)[v][static_cast<glm::length_t>(c)];
        at += 3;
    }
    return out;
}

bool mirrors(const glm::dmat4& m) {
    return glm::determinant(glm::dmat3(m)) < 0.0;
}

void bindRange(GLuint binding, const Buffer& buffer, std::size_t offset, std::size_t bytes) {
    glBindBufferRange(GL_SHADER_STORAGE_BUFFER, binding, buffer.name(), static_cast<GLintptr>(offset),
                      static_cast<GLsizeiptr>(bytes));
}

}  // namespace

Deformer::Deformer(std::shared_ptr<const Motion> motion)
    : motion_(std::move(motion)), program_(Program::compute("scene/deform.comp.glsl")) {}

std::size_t Deformer::add(const Instance& instance, const Primitive& primitive, std::uint32_t firstRest,
                          std::uint32_t firstPosed) {
    Bent bent;
    bent.firstRest = firstRest;
    bent.firstPosed = firstPosed;
    bent.vertexCount = static_cast<std::uint32_t>(primitive.vertices.size());
    bent.deformation = primitive.deformation;
    const Deformation& deformation = *bent.deformation;
    bent.node = static_cast<std::size_t>(instance.node);
    bent.flat = deformation.flat;
    bent.extent = extentOf(instance, primitive);
    if (!bent.extent.joints.empty()) {
        bent.skin = instance.skin;
        bent.perVertex = static_cast<std::uint32_t>(deformation.influencesPerVertex);
    }
    bent.targetCount = static_cast<std::uint32_t>(deformation.targets.size());
    bent.deltaWidth = widthOf(deformation);
    bent.influencesAt = influenceBytes_;
    bent.deltasAt = deltaBytes_;
    const std::size_t influences = deformation.influences.size() * sizeof(Influence);
    const std::size_t deltas = deformation.targets.size() * bent.vertexCount * bent.deltaWidth * sizeof(float);
    requireBlock(std::size_t{bent.vertexCount} * sizeof(Vertex), "the vertices");
    requireBlock(influences, "the joints and weights");
    requireBlock(deltas, "the morph targets");
    // Instances of one mesh share them.
    const auto same =
        std::find_if(bent_.begin(), bent_.end(), [&](const Bent& b) { return b.deformation == bent.deformation; });
    if (same != bent_.end()) {
        bent.influencesAt = same->influencesAt;
        bent.deltasAt = same->deltasAt;
    } else {
        influenceBytes_ += aligned(influences);
        deltaBytes_ += aligned(deltas);
    }
    targets_ += bent.targetCount;
    bent_.push_back(std::move(bent));
    return bent_.size() - 1;
}

void Deformer::upload() {
    influences_ = Buffer(influenceBytes_, nullptr, true, "joints and weights");
    deltas_ = Buffer(deltaBytes_, nullptr, true, "morph targets");
    active_ = Buffer(targets_ * sizeof(gpu::ActiveTarget), nullptr, true, "active morph targets");
    std::size_t joints = 0;
    for (const Skin& skin : motion_->skins) {
        firstJoint_.push_back(joints);
        joints += skin.joints.size();
    }
    joints_ = Buffer(joints * sizeof(glm::mat4), nullptr, true, "joints");
    for (Bent& bent : bent_) {
        const Deformation& deformation = *bent.deformation;
        influences_.update(deformation.influences.data(), deformation.influences.size() * sizeof(Influence),
                           bent.influencesAt);
        std::size_t at = bent.deltasAt;
        for (const MorphTarget& target : deformation.targets) {
            const std::vector<float> deltas = interleaved(target, bent.vertexCount, bent.deltaWidth);
            deltas_.update(deltas.data(), deltas.size() * sizeof(float), at);
            at += deltas.size() * sizeof(float);
        }
    }
    for (Bent& bent : bent_) bent.deformation = nullptr;
}

std::vector<Deformer::Placed> Deformer::pose(const MotionPose& pose, const Buffer& vertices) {
    std::vector<SkinPose> skins;
    for (std::size_t i = 0; i < motion_->skins.size(); ++i) {
        skins.push_back(poseOf(motion_->skins[i], pose));
        joints_.update(skins[i].originFromMesh.data(), skins[i].originFromMesh.size() * sizeof(glm::mat4),
                       firstJoint_[i] * sizeof(glm::mat4));
    }
    // Targets of no weight cost nothing.
    std::vector<gpu::ActiveTarget> active;
    std::vector<std::size_t> firstActive;
    for (const Bent& bent : bent_) {
        firstActive.push_back(active.size());
        for (std::uint32_t k = 0; k < bent.targetCount; ++k)
            if (const float weight = pose.weights[bent.node][k]; weight != 0.0f) active.push_back({k, weight});
    }
    firstActive.push_back(active.size());
    active_.update(active.data(), active.size() * sizeof(gpu::ActiveTarget));

    program_.use();
    std::vector<Placed> places;
    for (std::size_t i = 0; i < bent_.size(); ++i) {
        const Bent& bent = bent_[i];
        bend(bent, vertices, firstActive[i], firstActive[i + 1] - firstActive[i]);
        Placed& placed = places.emplace_back();
        if (bent.skin >= 0) {
            const SkinPose& skin = skins[static_cast<std::size_t>(bent.skin)];
            placed.worldFromMesh[3] = glm::dvec4(skin.origin, 1.0);
            placed.mirrored = mirrors(glm::dmat4(skin.originFromMesh[bent.extent.joints.front().joint]));
            placed.bounds = posedBounds(bent.extent, pose.weights[bent.node], skin.originFromMesh);
        } else {
            placed.worldFromMesh = pose.worldFromNode[bent.node];
            placed.mirrored = mirrors(placed.worldFromMesh);
            placed.bounds = posedBounds(bent.extent, pose.weights[bent.node], {});
        }
    }
    glMemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT);
    return places;
}

void Deformer::bend(const Bent& bent, const Buffer& vertices, std::size_t firstActive, std::size_t activeCount) const {
    const std::size_t bytes = std::size_t{bent.vertexCount} * sizeof(Vertex);
    bindRange(0, vertices, bent.firstRest * sizeof(Vertex), bytes);
    bindRange(1, vertices, bent.firstPosed * sizeof(Vertex), bytes);
    // A range must not be empty, nor need what lies in it be read.
    const auto bindSome = [](GLuint binding, const Buffer& buffer, std::size_t offset, std::size_t size) {
        if (size > 0)
            bindRange(binding, buffer, offset, size);
        else
            glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, buffer.name());
    };
    bindSome(2, influences_, bent.influencesAt, bytes / sizeof(Vertex) * bent.perVertex * sizeof(Influence));
    bindSome(3, deltas_, bent.deltasAt,
             std::size_t{bent.targetCount} * bent.vertexCount * bent.deltaWidth * sizeof(float));
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 4, joints_.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 5, active_.name());
    program_.set("vertexCount", static_cast<int>(bent.vertexCount));
    program_.set("stride", static_cast<int>(sizeof(Vertex) / sizeof(float)));
    program_.set("perVertex", static_cast<int>(bent.perVertex));
    program_.set("firstJoint", bent.skin >= 0 ? static_cast<int>(firstJoint_[static_cast<std::size_t>(bent.skin)]) : 0);
    program_.set("firstActive", static_cast<int>(firstActive));
    program_.set("activeCount", static_cast<int>(activeCount));
    program_.set("deltaWidth", static_cast<int>(bent.deltaWidth));
    program_.set("flatNormals", bent.flat ? 1 : 0);
    const std::uint32_t groups = (bent.vertexCount + gpu::kDeformGroup - 1) / gpu::kDeformGroup;
    glDispatchCompute(std::min(groups, kMostGroups), 1, 1);
}

}  // namespace dioptre
