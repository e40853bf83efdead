#include "scene/animation.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

namespace dioptre {
namespace {

/// Two keys and where the time is between them, 0..1.
struct Between {
    std::size_t key = 0, next = 0;
    double share = 0.0, seconds = 0.0;  // seconds: from key to key
};

Between find(const std::vector<float>& times, double seconds) {
    const auto after = std::upper_bound(times.begin(), times.end(), seconds,
                                        [](double time, float key) { return time < static_cast<double>(key); });
    if (after == times.begin()) return {};
    const auto next = static_cast<std::size_t>(after - times.begin());
    if (after == times.end()) return {next - 1, next - 1, 0.0, 0.0};
    const auto from = static_cast<double>(times[next - 1]), to = static_cast<double>(times[next]);
    return {next - 1, next, (seconds - from) / (to - from), to - from};
}

std::vector<double> normalised(std::vector<double> q) {
    const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    // A spline may pass through zero, where it means no rotation in particular.
    if (!(length > 0.0)) return {0.0, 0.0, 0.0, 1.0};
    for (double& component : q) component /= length;
    return q;
}

std::vector<double> slerp(const std::vector<double>& a, const std::vector<double>& b, double share) {
    // glTF: x y z w, glm: w first. It takes the shorter arc.
    const glm::dquat q = glm::slerp(glm::dquat(a[3], a[0], a[1], a[2]), glm::dquat(b[3], b[0], b[1], b[2]), share);
    return {q.x, q.y, q.z, q.w};
}

}  // namespace

std::vector<double> valueAt(const Curve& curve, AnimatedProperty property, double seconds) {
    const bool spline = curve.interpolation == Interpolation::cubicSpline,
               turns = property == AnimatedProperty::rotation;
    // A spline's key has in-tangent, value and out-tangent; else there are only values.
    const auto at = [&](std::size_t key, std::size_t part) {
        const std::size_t first = (spline ? key * 3 + part : key) * curve.components;
        std::vector<double> value(curve.components);
        for (std::size_t c = 0; c < curve.components; ++c) value[c] = static_cast<double>(curve.values[first + c]);
        return value;
    };
    const Between between = find(curve.times, seconds);
    std::vector<double> value = at(between.key, 1);
    if (between.share > 0.0 && curve.interpolation != Interpolation::step) {
        const std::vector<double> next = at(between.next, 1);
        const double t = between.share;
        if (spline) {
            // glTF 2.0, appendix C.5
            const std::vector<double> out = at(between.key, 2), in = at(between.next, 0);
            const double t2 = t * t, t3 = t2 * t, d = between.seconds;
            for (std::size_t c = 0; c < value.size(); ++c)
                value[c] = (2.0 * t3 - 3.0 * t2 + 1.0) * value[c] + d * (t3 - 2.0 * t2 + t) * out[c] +
                           (-2.0 * t3 + 3.0 * t2) * next[c] + d * (t3 - t2) * in[c];
        } else if (turns) {
            value = slerp(normalised(value), normalised(next), t);
        } else {
            for (std::size_t c = 0; c < value.size(); ++c) value[c] += (next[c] - value[c]) * t;
        }
    }
    return turns ? normalised(value) : value;
}

glm::dmat4 NodeTransform::parentFromNode() const {
    if (matrix) return *matrix;
    glm::dmat4 m = glm::mat4_cast(rotation);
    for (int i = 0; i < 3; ++i) m[i] *= scale[i];
    m[3] = glm::dvec4(translation, 1.0);
    return m;
}

double Motion::length() const {
    double longest = 0.0;
    for (const Animation& animation : animations) longest = std::max(longest, animation.length);
    return longest;
}

MotionPose poseAt(const Motion& motion, double seconds) {
    MotionPose pose;
    std::vector<NodeTransform> transforms;
    for (const MotionNode& node : motion.nodes) {
        transforms.push_back(node.transform);
        pose.weights.push_back(node.weights);
    }
    for (const Animation& animation : motion.animations) {
        const double time = animation.length > 0.0 ? std::fmod(seconds, animation.length) : 0.0;
        for (const Channel& channel : animation.channels) {
            const std::vector<double> value = valueAt(animation.curves[channel.curve], channel.property, time);
            NodeTransform& transform = transforms[channel.node];
            switch (channel.property) {
                case AnimatedProperty::translation:
                    transform.translation = glm::make_vec3(value.data());
                    break;
                case AnimatedProperty::rotation:
                    transform.rotation = glm::dquat(value[3], value[0], value[1], value[2]);
                    break;
                case AnimatedProperty::scale:
                    transform.scale = glm::make_vec3(value.data());
                    break;
                case AnimatedProperty::weights:
                    pose.weights[channel.node].assign(value.begin(), value.end());
                    break;
            }
        }
    }
    for (std::size_t i = 0; i < motion.nodes.size(); ++i) {
        const int parent = motion.nodes[i].parent;
        const glm::dmat4 local = transforms[i].parentFromNode();
        pose.worldFromNode.push_back(parent < 0 ? local : pose.worldFromNode[static_cast<std::size_t>(parent)] * local);
    }
    return pose;
}

SkinPose poseOf(const Skin& skin, const MotionPose& pose) {
    SkinPose result;
    result.origin = glm::dvec3(pose.worldFromNode[skin.joints.front()][3]);
    const glm::dmat4 originFromWorld = glm::translate(glm::dmat4(1.0), -result.origin);
    for (std::size_t j = 0; j < skin.joints.size(); ++j)
        result.originFromMesh.emplace_back(originFromWorld * pose.worldFromNode[skin.joints[j]] *
                                           glm::dmat4(skin.jointFromMesh[j]));
    return result;
}

}  // namespace dioptre
