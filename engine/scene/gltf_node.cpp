#include "scene/gltf_node.hpp"

#include <fmt/format.h>

#include <cmath>
#include <glm/gtc/quaternion.hpp>

namespace dioptre::gltf {
namespace {

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

bool isFinite(const glm::mat4& m) {
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!std::isfinite(m[column][row])) return false;
    return true;
}

glm::dmat4 matrixOf(const Element& node, const std::vector<float>& values) {
    glm::dmat4 m;
    for (int i = 0; i < 16; ++i) m[i / 4][i % 4] = static_cast<double>(values[static_cast<std::size_t>(i)]);
    constexpr double kTolerance = 1e-5;  // of a last row that went through arithmetic
    const bool affine = std::abs(m[0][3]) <= kTolerance && std::abs(m[1][3]) <= kTolerance &&
                        std::abs(m[2][3]) <= kTolerance && std::abs(m[3][3] - 1.0) <= kTolerance;
    if (!affine)
        node.fail("matrix",
                  fmt::format("its last row is {} {} {} {}, must be 0 0 0 1", m[0][3], m[1][3], m[2][3], m[3][3]));
    m[0][3] = m[1][3] = m[2][3] = 0.0;
    m[3][3] = 1.0;
    return m;
}

// What is wrong with a transform, but does not hinder drawing it.
glm::dmat4 parentFromNode(const Element& node) {
    if (node.has("matrix") && (node.has("translation") || node.has("rotation") || node.has("scale")))
        node.warn("matrix", "stands beside translation, rotation or scale, which are ignored");
    if (const auto r = node.numbers("rotation", 4); !r.empty() && !node.has("matrix")) {
        const double length = glm::length(glm::dvec4(r[0], r[1], r[2], r[3]));
        if (std::abs(length - 1.0) > 1e-3) node.warn("rotation", "is not of unit length: normalised");
    }
    const glm::dmat4 result = readTransform(node).parentFromNode();
    const glm::dmat3 linear(result);
    const double lengths = glm::length(linear[0]) * glm::length(linear[1]) * glm::length(linear[2]);
    if (!(std::abs(glm::determinant(linear)) > 1e-9 * lengths)) node.warn("its transform is singular: flattened");
    return result;
}

class Tree {
  public:
    explicit Tree(const Element& root) : nodes_(root.list("nodes")), parents_(nodes_.size(), kNone) {
        for (std::size_t i = 0; i < nodes_.size(); ++i) {
            const Element node = nodes_[i];
            const List children = node.list("children");
            for (std::size_t c = 0; c < children.size(); ++c) {
                const std::size_t child = children.index(c, nodes_.size(), "nodes");
                if (parents_[child] != kNone)
                    children.fail(c, fmt::format("node {} is a child of node {} already", child, parents_[child]));
                parents_[child] = i;
            }
            locals_.push_back(parentFromNode(node));
        }
        std::size_t reached = 0;
        for (std::size_t i = 0; i < nodes_.size(); ++i)
            if (isRoot(i)) reached += walk(i, nullptr);
        if (reached < nodes_.size()) failOnCycle();
    }

    std::size_t size() const { return nodes_.size(); }
    bool isRoot(std::size_t node) const { return parents_[node] == kNone; }
    std::size_t parent(std::size_t node) const { return parents_[node]; }

    // Visits the tree below a root, depth first, without recursion; returns the number of nodes.
    std::size_t walk(std::size_t root, std::vector<PlacedNode>* placed) const {
        struct Visit {
            std::size_t node;
            int depth;
            int parent;  // its place in `placed`
            glm::dmat4 worldFromParent;
        };
        std::vector<Visit> stack{{root, 1, -1, glm::dmat4(1.0)}};
        std::size_t count = 0;
        while (!stack.empty()) {
            const Visit visit = stack.back();
            stack.pop_back();
            ++count;
            const Element node = nodes_[visit.node];
            const int limit = node.context().limits.maxNodeDepth;
            if (visit.depth > limit) node.fail(fmt::format("lies {} deep, the limit is {}", visit.depth, limit));
            const glm::dmat4 world = visit.worldFromParent * locals_[visit.node];
            if (placed) {
                placed->push_back({visit.node, visit.parent, glm::mat4(world)});
                if (!isFinite(placed->back().worldFromNode)) node.fail("its transform in the world is not finite");
            }
            const List children = node.list("children");
            const int place = placed ? static_cast<int>(placed->size()) - 1 : -1;
            for (std::size_t c = children.size(); c-- > 0;)  // so that the first is on top
                stack.push_back({children.index(c, nodes_.size(), "nodes"), visit.depth + 1, place, world});
        }
        return count;
    }

  private:
    // With one parent each, a node that no root reaches hangs below a cycle or is in it: climb until it must be in it.
    [[noreturn]] void failOnCycle() const {
        for (std::size_t node = 0;; ++node) {
            std::size_t ancestor = node;
            for (std::size_t step = 0; step < nodes_.size() && ancestor != kNone; ++step) ancestor = parents_[ancestor];
            if (ancestor != kNone) nodes_[ancestor].fail("children", "lead back to the node itself");
        }
    }

    List nodes_;
    std::vector<std::size_t> parents_;
    std::vector<glm::dmat4> locals_;
};

std::vector<std::size_t> rootsOf(const Element& scene, const Tree& tree) {
    const List nodes = scene.list("nodes");
    std::vector<std::size_t> roots;
    std::vector<bool> seen(tree.size(), false);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const std::size_t node = nodes.index(i, tree.size(), "nodes");
        if (!tree.isRoot(node))
            nodes.fail(i, fmt::format("node {} is a child of node {}, not a root", node, tree.parent(node)));
        if (seen[node]) nodes.fail(i, fmt::format("node {} is listed twice", node));
        seen[node] = true;
        roots.push_back(node);
    }
    return roots;
}

}  // namespace

NodeTransform readTransform(const Element& node) {
    NodeTransform transform;
    const std::vector<float> matrix = node.numbers("matrix", 16), t = node.numbers("translation", 3),
                             r = node.numbers("rotation", 4), s = node.numbers("scale", 3);
    if (!matrix.empty()) {
        transform.matrix = matrixOf(node, matrix);
        return transform;
    }
    if (!r.empty()) {
        const glm::dquat rotation(r[3], r[0], r[1], r[2]);  // glTF: x y z w, glm: w first
        const double length = glm::length(rotation);
        if (!(length > 0.0)) node.fail("rotation", "is 0 0 0 0, must be a unit quaternion");
        transform.rotation = rotation / length;
    }
    if (!s.empty()) transform.scale = glm::dvec3(s[0], s[1], s[2]);
    if (!t.empty()) transform.translation = glm::dvec3(t[0], t[1], t[2]);
    return transform;
}

std::vector<PlacedNode> placeNodes(const Element& root, std::string& sceneName) {
    const Tree tree(root);
    const List scenes = root.list("scenes");
    const std::size_t drawn = root.index("scene", scenes.size(), "scenes").value_or(0);
    std::vector<std::size_t> roots;
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        std::vector<std::size_t> sceneRoots = rootsOf(scenes[i], tree);
        if (i != drawn) continue;
        roots = std::move(sceneRoots);
        if (const auto name = scenes[i].text("name"); name && !name->empty()) sceneName = *name;
    }
    if (scenes.size() > 1) root.warn("scenes", fmt::format("scene {} of {} is drawn, no other", drawn, scenes.size()));
    if (scenes.empty())
        for (std::size_t i = 0; i < tree.size(); ++i)
            if (tree.isRoot(i)) roots.push_back(i);
    std::vector<PlacedNode> placed;
    for (const std::size_t node : roots) tree.walk(node, &placed);
    return placed;
}

}  // namespace dioptre::gltf
