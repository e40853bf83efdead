#include "scene/gltf_skin.hpp"

#include <fmt/format.h>

#include <cmath>
#include <set>

namespace dioptre::gltf {
namespace {

void checkMatrix(const Element& skin, std::size_t joint, glm::mat4& m) {
    for (int i = 0; i < 16; ++i)
        if (!std::isfinite(m[i / 4][i % 4]))
            skin.fail("inverseBindMatrices", fmt::format("element {} has {}, must be finite", joint, m[i / 4][i % 4]));
    constexpr float kTolerance = 1e-5f;  // of a last row that went through arithmetic
    const glm::vec4 last(m[0][3], m[1][3], m[2][3], m[3][3]);
    for (int i = 0; i < 4; ++i)
        if (std::abs(last[i] - (i == 3 ? 1.0f : 0.0f)) > kTolerance)
            skin.fail("inverseBindMatrices", fmt::format("element {} has the last row {} {} {} {}, must be 0 0 0 1",
                                                         joint, last[0], last[1], last[2], last[3]));
    m[0][3] = m[1][3] = m[2][3] = 0.0f;
    m[3][3] = 1.0f;
}

std::vector<glm::mat4> readMatrices(const Element& skin, const Accessors& accessors, std::size_t joints) {
    const auto number = skin.index("inverseBindMatrices", accessors.size(), "accessors");
    if (!number) return std::vector<glm::mat4>(joints, glm::mat4(1.0f));
    const std::string where = skin.pathOf("inverseBindMatrices");
    const Accessor& accessor = accessors.use(*number, where);
    if (accessor.type != "MAT4" || accessor.component != ComponentType::floating)
        skin.fail("inverseBindMatrices",
                  fmt::format("is {} {}, must be FLOAT MAT4", nameOf(accessor.component), accessor.type));
    if (accessor.count < joints)
        skin.fail("inverseBindMatrices", fmt::format("has {} elements for {} joints", accessor.count, joints));
    skin.context().charge(accessor.count * sizeof(glm::mat4), where);
    std::vector<glm::mat4> matrices(static_cast<std::size_t>(accessor.count));
    accessors.readFloats(*number, where, &matrices[0][0][0], sizeof(glm::mat4) / sizeof(float));
    matrices.resize(joints);
    for (std::size_t j = 0; j < joints; ++j) checkMatrix(skin, j, matrices[j]);
    return matrices;
}

}  // namespace

std::vector<Skin> readSkins(const Element& root, const Accessors& accessors) {
    std::vector<Skin> skins;
    const List list = root.list("skins");
    const std::size_t nodes = root.list("nodes").size();
    for (std::size_t i = 0; i < list.size(); ++i) {
        const Element element = list[i];
        Skin skin;
        const List joints = element.list("joints");
        if (joints.empty()) element.fail("joints", "is missing or empty, a skin has at least one joint");
        std::set<std::size_t> seen;
        for (std::size_t j = 0; j < joints.size(); ++j) {
            skin.joints.push_back(joints.index(j, nodes, "nodes"));
            if (!seen.insert(skin.joints.back()).second)
                joints.fail(j, fmt::format("node {} is listed twice", skin.joints.back()));
        }
        element.index("skeleton", nodes, "nodes");
        skin.jointFromMesh = readMatrices(element, accessors, skin.joints.size());
        skins.push_back(std::move(skin));
    }
    return skins;
}

}  // namespace dioptre::gltf
