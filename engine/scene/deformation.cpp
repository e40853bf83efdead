#include "scene/deformation.hpp"

#include <algorithm>
#include <map>

namespace dioptre {
namespace {

// The GPU adds up in single precision: its sums may lie outside by some of their last digits.
constexpr float kRounding = 1e-5f;

Bounds grown(const Bounds& box, const Bounds& by) {
    return {box.min + by.min, box.max + by.max};
}

Bounds transformed(const glm::mat4& m, const Bounds& box) {
    Bounds result;
    float largest = 0.0f;  // of all terms of the sums
    for (int i = 0; i < 8; ++i) {
        const glm::vec3 p = box.corner(i);
        const glm::vec3 x(m[0] * p.x), y(m[1] * p.y), z(m[2] * p.z);
        result.add(x + y + z + glm::vec3(m[3]));
        for (const glm::vec3& term : {x, y, z, glm::vec3(m[3])})
            largest = std::max({largest, std::abs(term.x), std::abs(term.y), std::abs(term.z)});
    }
    const glm::vec3 rounding(kRounding * largest);
    return {result.min - rounding, result.max + rounding};
}

}  // namespace

std::size_t Deformation::bytes() const {
    std::size_t sum = influences.size() * sizeof(Influence);
    for (const MorphTarget& target : targets)
        sum += (target.positions.size() + target.normals.size() + target.tangents.size()) * sizeof(glm::vec3);
    return sum;
}

bool bends(const Instance& instance, const Primitive& primitive) {
    if (!primitive.deformation) return false;
    return (instance.skin >= 0 && primitive.deformation->influencesPerVertex > 0) ||
           !primitive.deformation->targets.empty();
}

Deformation unshared(const Deformation& shared, std::span<const std::uint32_t> indices) {
    Deformation result;
    result.flat = true;
    result.influencesPerVertex = shared.influencesPerVertex;
    result.influences.reserve(indices.size() * shared.influencesPerVertex);
    for (const std::uint32_t index : indices)
        for (std::size_t i = 0; i < shared.influencesPerVertex; ++i)
            result.influences.push_back(shared.influences[index * shared.influencesPerVertex + i]);
    // Normals are found anew, tangents turned into their planes.
    for (const MorphTarget& target : shared.targets) {
        MorphTarget& added = result.targets.emplace_back();
        if (target.positions.empty()) continue;
        added.positions.reserve(indices.size());
        for (const std::uint32_t index : indices) added.positions.push_back(target.positions[index]);
    }
    return result;
}

DeformedExtent findExtent(const Deformation& deformation, const Primitive& primitive) {
    DeformedExtent extent;
    extent.rest = primitive.bounds;
    std::map<std::uint32_t, Bounds> joints;
    const std::size_t perVertex = deformation.influencesPerVertex;
    for (std::size_t i = 0; i < deformation.influences.size(); ++i) {
        const Influence& influence = deformation.influences[i];
        if (influence.weight > 0.0f) joints[influence.joint].add(primitive.vertices[i / perVertex].position);
    }
    for (const auto& [joint, rest] : joints) extent.joints.push_back({joint, rest});
    for (const MorphTarget& target : deformation.targets) {
        Bounds added{glm::vec3(0.0f), glm::vec3(0.0f)};
        for (const glm::vec3& delta : target.positions) added.add(delta);
        extent.targets.push_back(added);
    }
    return extent;
}

DeformedExtent extentOf(const Instance& instance, const Primitive& primitive) {
    if (!primitive.deformation) return {primitive.bounds, {}, {}};
    const DeformedExtent& whole = primitive.deformation->extent;
    return {whole.rest, instance.skin >= 0 ? whole.joints : std::vector<DeformedExtent::Joint>(), whole.targets};
}

Bounds posedBounds(const DeformedExtent& extent, std::span<const float> targetWeights,
                   std::span<const glm::mat4> originFromMesh) {
    Bounds added{glm::vec3(0.0f), glm::vec3(0.0f)};
    for (std::size_t k = 0; k < extent.targets.size(); ++k) {
        const glm::vec3 low = extent.targets[k].min * targetWeights[k], high = extent.targets[k].max * targetWeights[k];
        added = grown(added, {glm::min(low, high), glm::max(low, high)});
    }
    if (extent.joints.empty()) return transformed(glm::mat4(1.0f), grown(extent.rest, added));
    Bounds result;
    for (const DeformedExtent::Joint& joint : extent.joints)
        result.add(transformed(originFromMesh[joint.joint], grown(joint.rest, added)));
    return result;
}

}  // namespace dioptre
