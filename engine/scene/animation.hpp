// A tree of nodes and how it moves over time: keyframes, and the skins that hang from its joints. Plain data, and where
// everything is at a moment as a pure function of it. Source: Khronos glTF 2.0 specification, 3.11 and appendix C.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <string>
#include <vector>

namespace dioptre {

enum class Interpolation { step, linear, cubicSpline };
enum class AnimatedProperty { translation, rotation, scale, weights };

/// Keyframes of one property.
struct Curve {
    Interpolation interpolation = Interpolation::linear;
    std::size_t components = 3;  // of a value: 3, of a rotation 4 (x y z w), of weights as many as there are targets
    std::vector<float> times;    // seconds, from 0 up, strictly increasing; at least one
    std::vector<float> values;   // one per time; a cubic spline's are three: in-tangent, value, out-tangent
};

/// The curve's value at a time; before the first key that key's, after the last that one's. Rotations are unit
/// quaternions, between keys on the shorter arc (slerp); a cubic spline's are normalised after interpolation.
std::vector<double> valueAt(const Curve& curve, AnimatedProperty property, double seconds);

/// What a curve drives.
struct Channel {
    std::size_t node = 0;   // in Motion::nodes
    std::size_t curve = 0;  // in Animation::curves
    AnimatedProperty property = AnimatedProperty::translation;
};

struct Animation {
    std::string name;
    double length = 0.0;  // seconds, the last key of its channels; from there it begins anew
    std::vector<Curve> curves;
    std::vector<Channel> channels;
};

/// Scaled, then turned, then moved.
struct NodeTransform {
    glm::dvec3 translation{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};  // unit
    glm::dvec3 scale{1.0};
    std::optional<glm::dmat4> matrix = {};  // in place of the three

    glm::dmat4 parentFromNode() const;
};

struct MotionNode {
    int parent = -1;  // in Motion::nodes, before this one; -1: none
    NodeTransform transform;
    std::vector<float> weights = {};  // of the morph targets of its mesh
};

/// Joints that bend a mesh.
struct Skin {
    std::vector<std::size_t> joints;       // in Motion::nodes
    std::vector<glm::mat4> jointFromMesh;  // of each joint: the inverse of where it was when the mesh was bound to it
};

/// All that moves in a scene, and what hangs from it. Animations play together; where two drive the same property of a
/// node, the later one in the list wins.
struct Motion {
    std::vector<MotionNode> nodes;  // parents before children
    std::vector<Skin> skins;
    std::vector<Animation> animations;

    double length() const;  // of the longest animation, seconds
};

/// Where the nodes are at a moment.
struct MotionPose {
    std::vector<glm::dmat4> worldFromNode;
    std::vector<std::vector<float>> weights;  // of each node

    bool operator==(const MotionPose&) const = default;
};

/// At a time from the start, seconds; each animation plays over and over. What no animation drives stays as it is.
MotionPose poseAt(const Motion& motion, double seconds);

/// What a skin's joints do to a mesh at a moment, from the mesh straight to the world: the node that has the mesh is
/// not asked (glTF 2.0, 3.7.3.1). In a frame with the world's axes and an origin at the first joint, so that single
/// precision suffices far from the world's origin.
struct SkinPose {
    glm::dvec3 origin{0.0};                 // in the world
    std::vector<glm::mat4> originFromMesh;  // by each joint
};
SkinPose poseOf(const Skin& skin, const MotionPose& pose);

}  // namespace dioptre
