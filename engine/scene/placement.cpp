#include "scene/placement.hpp"

#include <algorithm>
#include <cmath>

#include "scene/deformation.hpp"

namespace dioptre {
namespace {

// Enough that little is missed between two moments, yet no file can keep the loader busy for long.
constexpr std::size_t kMostMoments = 128, kMostMomentWork = 2'000'000;

// Unit, or nothing where the column vanishes.
std::optional<glm::dvec3> direction(const glm::dvec3& v) {
    const double length = glm::length(v);
    if (!(length > 0.0)) return std::nullopt;
    return v / length;
}

void addBox(Bounds& sum, const glm::dmat4& worldFromBox, const Bounds& box) {
    for (int i = 0; i < 8; ++i) sum.add(glm::vec3(worldFromBox * glm::dvec4(glm::dvec3(box.corner(i)), 1.0)));
}

/// One primitive of one instance.
struct Part {
    const Instance& instance;
    bool rigid;
    DeformedExtent extent;
};

Bounds boundsAt(const Motion& motion, const std::vector<Part>& parts, double seconds) {
    const MotionPose pose = poseAt(motion, seconds);
    std::vector<SkinPose> skins;
    for (const Skin& skin : motion.skins) skins.push_back(poseOf(skin, pose));
    Bounds sum;
    for (const Part& part : parts) {
        const auto node = static_cast<std::size_t>(part.instance.node);
        if (part.rigid) {
            addBox(sum, pose.worldFromNode[node], part.extent.rest);
        } else if (part.extent.joints.empty()) {
            addBox(sum, pose.worldFromNode[node], posedBounds(part.extent, pose.weights[node], {}));
        } else {
            const SkinPose& skin = skins[static_cast<std::size_t>(part.instance.skin)];
            const Bounds box = posedBounds(part.extent, pose.weights[node], skin.originFromMesh);
            for (int i = 0; i < 8; ++i) sum.add(glm::vec3(glm::dvec3(box.corner(i)) + skin.origin));
        }
    }
    return sum;
}

}  // namespace

bool place(Camera& camera, const glm::mat4& worldFromNode) {
    camera.worldFromCamera[3] = worldFromNode[3];
    const glm::dmat4 m(worldFromNode);
    const auto back = direction(glm::dvec3(m[2]));
    if (!back) return false;
    const auto up = direction(glm::dvec3(m[1]) - *back * glm::dot(*back, glm::dvec3(m[1])));
    if (!up) return false;
    const glm::dvec3 right = glm::cross(*up, *back);
    camera.worldFromCamera =
        glm::mat4(glm::vec4(right, 0.0f), glm::vec4(*up, 0.0f), glm::vec4(*back, 0.0f), worldFromNode[3]);
    return true;
}

bool place(Light& light, const glm::mat4& worldFromNode) {
    light.position = glm::vec3(worldFromNode[3]);
    if (light.kind == LightKind::point) return true;
    const auto back = direction(glm::dvec3(worldFromNode[2]));
    if (back) light.direction = glm::vec3(-*back);
    return back.has_value();
}

void place(Scene& scene, const MotionPose& pose) {
    const auto worldFrom = [&](int node) { return glm::mat4(pose.worldFromNode[static_cast<std::size_t>(node)]); };
    for (Instance& instance : scene.instances)
        if (instance.node >= 0) instance.worldFromMesh = worldFrom(instance.node);
    for (Camera& camera : scene.cameras)
        if (camera.node >= 0) place(camera, worldFrom(camera.node));
    for (Light& light : scene.lights)
        if (light.node >= 0) place(light, worldFrom(light.node));
}

Bounds motionBounds(const Scene& scene) {
    std::vector<Part> parts;
    std::size_t work = scene.motion->nodes.size() + 1;
    for (const Skin& skin : scene.motion->skins) work += skin.joints.size();
    for (const Animation& animation : scene.motion->animations)
        for (const Channel& channel : animation.channels) work += animation.curves[channel.curve].components;
    for (const Instance& instance : scene.instances) {
        for (const Primitive& primitive : scene.meshes[static_cast<std::size_t>(instance.mesh)].primitives) {
            parts.push_back({instance, !bends(instance, primitive), extentOf(instance, primitive)});
            work += 1 + parts.back().extent.joints.size() + parts.back().extent.targets.size();
        }
    }
    const double length = scene.motion->length();
    const std::size_t moments = length > 0.0 ? std::clamp<std::size_t>(kMostMomentWork / work, 2, kMostMoments) : 1;
    Bounds sum;
    for (std::size_t i = 0; i < moments; ++i) {
        // The last moment is just before the end, where all would begin anew.
        const double share = static_cast<double>(i) / static_cast<double>(std::max<std::size_t>(moments - 1, 1));
        sum.add(boundsAt(*scene.motion, parts, std::min(share * length, std::nextafter(length, 0.0))));
    }
    return sum;
}

}  // namespace dioptre
