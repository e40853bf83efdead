#include "scene/gltf_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/gltf_animation.hpp"
#include "scene/gltf_skin.hpp"
#include "scene/placement.hpp"

namespace dioptre::gltf {
namespace {

// All primitives of a mesh have as many targets, its weights too.
std::size_t targetCountOf(const Element& mesh) {
    const List primitives = mesh.list("primitives");
    std::size_t count = 0;
    for (std::size_t p = 0; p < primitives.size(); ++p) {
        const std::size_t own = primitives[p].list("targets").size();
        if (p > 0 && own != count)
            primitives[p].fail("targets", fmt::format("has {}, the mesh's first primitive {}", own, count));
        count = own;
    }
    if (mesh.has("weights")) mesh.numbers("weights", count);
    return count;
}

bool hasJoints(const Element& mesh) {
    const List primitives = mesh.list("primitives");
    for (std::size_t p = 0; p < primitives.size(); ++p)
        if (primitives[p].object("attributes").has("JOINTS_0")) return true;
    return false;
}

/// The most that a transform does: no point comes out farther than scale × its distance + offset.
struct Reach {
    double scale = 1.0, offset = 0.0;

    Reach after(const Reach& first) const { return {scale * first.scale, scale * first.offset + offset}; }
    double of(double distance) const { return scale * distance + offset; }
};

Reach reachOf(const glm::dmat4& m) {
    const glm::dmat3 linear(m);
    return {std::sqrt(glm::dot(linear[0], linear[0]) + glm::dot(linear[1], linear[1]) + glm::dot(linear[2], linear[2])),
            glm::length(glm::dvec3(m[3]))};
}

// No value of the curve is longer. A spline's weights of the values add up to 1, those of the tangents are at most
// 4/27 of the time between keys.
double mostLength(const Curve& curve) {
    const bool spline = curve.interpolation == Interpolation::cubicSpline;
    double value = 0.0, tangent = 0.0, seconds = 0.0;
    const std::size_t parts = curve.values.size() / curve.components;
    for (std::size_t i = 0; i < parts; ++i) {
        double square = 0.0;
        for (std::size_t c = 0; c < curve.components; ++c) {
            const auto v = static_cast<double>(curve.values[i * curve.components + c]);
            square += v * v;
        }
        double& most = spline && i % 3 != 1 ? tangent : value;
        most = std::max(most, std::sqrt(square));
    }
    for (std::size_t i = 1; i < curve.times.size(); ++i)
        seconds = std::max(seconds, static_cast<double>(curve.times[i]) - static_cast<double>(curve.times[i - 1]));
    return value + 2.0 * 4.0 / 27.0 * seconds * tangent;
}

double farthest(const Bounds& box) {
    return glm::length(glm::max(glm::abs(glm::dvec3(box.min)), glm::abs(glm::dvec3(box.max))));
}

}  // namespace

MotionReader::MotionReader(const Element& root, const Accessors& accessors, std::span<const PlacedNode> placed)
    : root_(root),
      nodes_(root.list("nodes")),
      meshes_(root.list("meshes")),
      placed_(placed),
      placeOf_(nodes_.size(), -1),
      needs_(meshes_.size()),
      skinOf_(placed.size(), -1) {
    for (std::size_t i = 0; i < placed.size(); ++i) placeOf_[placed[i].node] = static_cast<int>(i);
    for (std::size_t m = 0; m < meshes_.size(); ++m) meshTargets_.push_back(targetCountOf(meshes_[m]));
    readNodeTargets();
    readMotionSkins(accessors);
    readMotionAnimations(accessors);
    readNodes();
}

void MotionReader::readNodeTargets() {
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        const Element node = nodes_[i];
        const auto mesh = node.index("mesh", meshes_.size(), "meshes");
        nodeTargets_.push_back(mesh ? meshTargets_[*mesh] : 0);
        if (node.has("weights")) node.numbers("weights", nodeTargets_.back());
    }
}

void MotionReader::readMotionSkins(const Accessors& accessors) {
    const std::vector<Skin> fileSkins = readSkins(root_, accessors);
    motionSkinOf_.assign(fileSkins.size(), -1);
    for (std::size_t i = 0; i < placed_.size() && !fileSkins.empty(); ++i) {
        const Element node = nodes_[placed_[i].node];
        if (node.has("skin")) useSkin(node, i, fileSkins);
    }
}

void MotionReader::useSkin(const Element& node, std::size_t place, const std::vector<Skin>& fileSkins) {
    const std::size_t number = node.requiredIndex("skin", fileSkins.size(), "skins");
    const auto mesh = node.index("mesh", meshes_.size(), "meshes");
    if (!mesh || !hasJoints(meshes_[*mesh])) return node.warn("skin", "is ignored: the node has no mesh with JOINTS_0");
    const std::size_t joints = fileSkins[number].joints.size();
    DeformationNeeds& needs = needs_[*mesh];
    if (needs.fewestJoints == 0 || joints < needs.fewestJoints) {
        needs.fewestJoints = joints;
        needs.skin = number;
    }
    if (motionSkinOf_[number] < 0) {
        Skin skin = fileSkins[number];
        for (std::size_t j = 0; j < joints; ++j) {
            if (placeOf_[skin.joints[j]] < 0)
                root_.list("skins")[number].fail(
                    "joints", fmt::format("node {} is not in the scene that is drawn with it", skin.joints[j]));
            skin.joints[j] = static_cast<std::size_t>(placeOf_[skin.joints[j]]);
        }
        motionSkinOf_[number] = static_cast<int>(motion_.skins.size());
        motion_.skins.push_back(std::move(skin));
    }
    skinOf_[place] = motionSkinOf_[number];
}

void MotionReader::readMotionAnimations(const Accessors& accessors) {
    motion_.animations = readAnimations(root_, accessors, nodeTargets_);
    for (Animation& animation : motion_.animations) {
        std::erase_if(animation.channels, [&](const Channel& c) { return placeOf_[c.node] < 0; });
        for (Channel& channel : animation.channels) {
            if (channel.property == AnimatedProperty::weights)
                needs_[nodes_[channel.node].requiredIndex("mesh", meshes_.size(), "meshes")].morphed = true;
            channel.node = static_cast<std::size_t>(placeOf_[channel.node]);
        }
    }
    std::erase_if(motion_.animations, [](const Animation& a) { return a.channels.empty(); });
    for (Animation& animation : motion_.animations)
        for (const Channel& channel : animation.channels)
            animation.length =
                std::max(animation.length, static_cast<double>(animation.curves[channel.curve].times.back()));
}

void MotionReader::readNodes() {
    std::vector<std::vector<float>> weightsOfMesh(meshTargets_.size());
    const auto weightsOf = [&](const Element& node, std::size_t mesh) {
        std::vector<float> weights = node.numbers("weights", meshTargets_[mesh]);
        if (!weights.empty()) return weights;
        std::vector<float>& common = weightsOfMesh[mesh];
        if (common.empty()) common = meshes_[mesh].numbers("weights", meshTargets_[mesh]);
        if (common.empty()) common.assign(meshTargets_[mesh], 0.0f);
        return common;
    };
    for (const PlacedNode& placed : placed_) {
        if (nodeTargets_[placed.node] == 0) continue;
        const Element node = nodes_[placed.node];
        const std::size_t mesh = node.requiredIndex("mesh", meshes_.size(), "meshes");
        // In the node, and in each pose
        node.context().charge(2 * sizeof(float) * meshTargets_[mesh], node.path());
        const std::vector<float> weights = weightsOf(node, mesh);
        const bool used = std::any_of(weights.begin(), weights.end(), [](float w) { return w != 0.0f; });
        needs_[mesh].morphed = needs_[mesh].morphed || used;
    }
    if (!any()) return;
    for (const PlacedNode& placed : placed_) {
        const Element node = nodes_[placed.node];
        MotionNode& added = motion_.nodes.emplace_back(MotionNode{placed.parent, readTransform(node)});
        if (nodeTargets_[placed.node] == 0) continue;
        const std::size_t mesh = node.requiredIndex("mesh", meshes_.size(), "meshes");
        if (needs_[mesh].morphed) added.weights = weightsOf(node, mesh);
    }
}

bool MotionReader::any() const {
    return !motion_.animations.empty() || !motion_.skins.empty() ||
           std::any_of(needs_.begin(), needs_.end(), [](const DeformationNeeds& n) { return n.any(); });
}

void MotionReader::checkReach(const Scene& scene) const {
    std::vector<Reach> local, world;
    std::vector<double> weights(motion_.nodes.size(), 0.0);
    for (std::size_t i = 0; i < motion_.nodes.size(); ++i) {
        local.push_back(reachOf(motion_.nodes[i].transform.parentFromNode()));
        for (const float w : motion_.nodes[i].weights)
            weights[i] = std::max(weights[i], std::abs(static_cast<double>(w)));
    }
    for (const Animation& animation : motion_.animations) {
        std::vector<double> lengths;
        lengths.reserve(animation.curves.size());
        for (const Curve& curve : animation.curves) lengths.push_back(mostLength(curve));
        for (const Channel& channel : animation.channels) {
            const double most = lengths[channel.curve];
            double& reached = channel.property == AnimatedProperty::translation ? local[channel.node].offset
                              : channel.property == AnimatedProperty::weights   ? weights[channel.node]
                                                                                : local[channel.node].scale;
            if (channel.property != AnimatedProperty::rotation) reached = std::max(reached, most);
        }
    }
    for (std::size_t i = 0; i < local.size(); ++i) {
        const int parent = motion_.nodes[i].parent;
        world.push_back(parent < 0 ? local[i] : world[static_cast<std::size_t>(parent)].after(local[i]));
    }
    constexpr auto kLimit = static_cast<double>(std::numeric_limits<float>::max());
    const auto check = [&](std::size_t place, double distance) {
        if (!(distance <= kLimit))
            nodes_[placed_[place].node].fail(
                fmt::format("reaches {:.3g} m from the origin at some time, the limit is {:.3g}", distance, kLimit));
    };
    for (std::size_t i = 0; i < world.size(); ++i) {
        check(i, world[i].of(1.0));
        if (!(weights[i] <= kLimit))
            nodes_[placed_[i].node].fail(
                "weights", fmt::format("reach {:.3g} at some time, the limit is {:.3g}", weights[i], kLimit));
    }
    for (const Instance& instance : scene.instances) {
        const auto place = static_cast<std::size_t>(instance.node);
        double distance = 0.0;
        for (const Primitive& primitive : scene.meshes[static_cast<std::size_t>(instance.mesh)].primitives) {
            double own = farthest(primitive.bounds);
            if (primitive.deformation)
                for (const Bounds& added : primitive.deformation->extent.targets)
                    own += weights[place] * farthest(added);
            distance = std::max(distance, own);
        }
        check(place, world[place].of(distance));
        if (instance.skin < 0) continue;
        const Skin& skin = motion_.skins[static_cast<std::size_t>(instance.skin)];
        for (std::size_t j = 0; j < skin.joints.size(); ++j)
            check(place, world[skin.joints[j]].after(reachOf(glm::dmat4(skin.jointFromMesh[j]))).of(distance));
    }
}

void MotionReader::finish(Scene& scene) {
    checkReach(scene);
    scene.motion = std::make_shared<const Motion>(std::move(motion_));
    place(scene, poseAt(*scene.motion, 0.0));
    scene.bounds = motionBounds(scene);
}

}  // namespace dioptre::gltf
