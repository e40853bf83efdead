#include "scene/gltf_deformation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/text.hpp"

namespace dioptre::gltf {
namespace {

// A vertex has so many influences from each set of attributes.
constexpr std::size_t kPerSet = 4;

std::string jointsName(std::size_t set) {
    return fmt::format("JOINTS_{}", set);
}
std::string weightsName(std::size_t set) {
    return fmt::format("WEIGHTS_{}", set);
}

std::size_t setCount(const Element& attributes) {
    std::size_t sets = 0;
    while (attributes.has(jointsName(sets)) && attributes.has(weightsName(sets))) ++sets;
    return sets;
}

[[noreturn]] void failOnType(const Element& owner, std::string_view key, const Accessor& a, std::string_view wanted) {
    owner.fail(key, fmt::format("is {}{} {}, must be {}", a.normalized ? "normalized " : "", nameOf(a.component),
                                a.type, wanted));
}

void checkSets(const Element& attributes, const Accessors& accessors) {
    const std::size_t sets = setCount(attributes);
    for (const auto& [semantic, value] : attributes.json().items()) {
        const bool joints = semantic.starts_with("JOINTS_"), weights = semantic.starts_with("WEIGHTS_");
        if (!joints && !weights) continue;
        const std::string_view known = joints ? "JOINTS_" : "WEIGHTS_";
        const auto set = parseInteger(std::string_view(semantic).substr(known.size()));
        if (!set || *set < 0 || static_cast<std::size_t>(*set) >= sets || semantic != fmt::format("{}{}", known, *set))
            attributes.fail(semantic, fmt::format("has no {}, or a number before it is missing",
                                                  (joints ? "WEIGHTS_" : "JOINTS_") + semantic.substr(known.size())));
        const Accessor& a = accessors.use(attributes.requiredIndex(semantic, accessors.size(), "accessors"),
                                          attributes.pathOf(semantic));
        const bool small = a.component == ComponentType::unsignedByte || a.component == ComponentType::unsignedShort;
        if (joints && !(a.type == "VEC4" && small && !a.normalized))
            failOnType(attributes, semantic, a, "UNSIGNED_BYTE or UNSIGNED_SHORT VEC4");
        const bool plain = a.component == ComponentType::floating || (small && a.normalized);
        if (weights && !(a.type == "VEC4" && plain))
            failOnType(attributes, semantic, a, "FLOAT or normalized UNSIGNED_BYTE or UNSIGNED_SHORT VEC4");
    }
}

void checkTarget(const Element& target, const Accessors& accessors, std::uint64_t vertexCount, bool quantized) {
    for (const auto& [semantic, value] : target.json().items()) {
        const Accessor& a =
            accessors.use(target.requiredIndex(semantic, accessors.size(), "accessors"), target.pathOf(semantic));
        if (a.count != vertexCount)
            target.fail(semantic, fmt::format("has {} elements, the primitive {} vertices", a.count, vertexCount));
        const bool position = semantic == "POSITION";
        if (!position && semantic != "NORMAL" && semantic != "TANGENT") {
            target.warn(semantic, "is ignored: only POSITION, NORMAL and TANGENT are morphed");
            continue;
        }
        const bool small = (a.component == ComponentType::byte || a.component == ComponentType::shortInt) &&
                           (position || a.normalized);
        if (a.type == "VEC3" && small && !quantized)
            target.fail(semantic,
                        fmt::format("is {}, which needs KHR_mesh_quantization in extensionsUsed", nameOf(a.component)));
        if (a.type != "VEC3" || (a.component != ComponentType::floating && !small))
            failOnType(target, semantic, a, "FLOAT VEC3");
    }
}

std::vector<glm::vec3> readDeltas(const Element& target, const Accessors& accessors, std::string_view key) {
    if (!target.has(key)) return {};
    const std::size_t number = target.requiredIndex(key, accessors.size(), "accessors");
    const std::uint64_t count = accessors.use(number, "").count;
    target.context().charge(count * sizeof(glm::vec3), target.pathOf(key));
    std::vector<glm::vec3> deltas(static_cast<std::size_t>(count));
    accessors.readFloats(number, target.pathOf(key), &deltas[0].x, 3);
    for (std::size_t i = 0; i < deltas.size(); ++i)
        for (int c = 0; c < 3; ++c)
            if (!std::isfinite(deltas[i][c]))
                target.fail(key, fmt::format("element {} is {}, must be finite", i, deltas[i][c]));
    return deltas;
}

/// One set of a vertex's four influences, and of all sets their sum.
class InfluenceReader {
  public:
    InfluenceReader(const Element& attributes, const Accessors& accessors, const DeformationNeeds& needs,
                    std::uint64_t vertexCount)
        : attributes_(attributes), accessors_(accessors), needs_(needs), vertexCount_(vertexCount) {}

    void read(Deformation& out) {
        const std::size_t sets = setCount(attributes_);
        out.influencesPerVertex = sets * kPerSet;
        const std::uint64_t count = vertexCount_ * out.influencesPerVertex;
        // The joints and weights of one set are there beside them for a while.
        const std::uint64_t passing = vertexCount_ * kPerSet * (sizeof(std::uint32_t) + sizeof(float));
        attributes_.context().charge(count * sizeof(Influence) + passing, attributes_.path());
        out.influences.resize(static_cast<std::size_t>(count));
        for (std::size_t set = 0; set < sets; ++set) readSet(set, out);
        for (std::size_t vertex = 0; vertex < vertexCount_; ++vertex)
            normalise(std::span(out.influences).subspan(vertex * out.influencesPerVertex, out.influencesPerVertex));
        attributes_.context().release(passing);
    }

  private:
    void readSet(std::size_t set, Deformation& out) {
        const std::string jointsKey = jointsName(set), weightsKey = weightsName(set);
        const std::size_t weightAccessor = attributes_.requiredIndex(weightsKey, accessors_.size(), "accessors");
        if (accessors_.use(weightAccessor, "").component != ComponentType::floating) tolerance_ = 0.01f;
        const std::size_t jointAccessor = attributes_.requiredIndex(jointsKey, accessors_.size(), "accessors");
        std::vector<float> joints(static_cast<std::size_t>(vertexCount_) * kPerSet), weights(joints.size());
        accessors_.readFloats(jointAccessor, attributes_.pathOf(jointsKey), joints.data(), kPerSet);
        accessors_.readFloats(weightAccessor, attributes_.pathOf(weightsKey), weights.data(), kPerSet);
        for (std::size_t i = 0; i < joints.size(); ++i) {
            if (!(weights[i] >= 0.0f && std::isfinite(weights[i])))
                attributes_.fail(weightsKey, fmt::format("element {} is {}, must be finite and not negative",
                                                         i / kPerSet, weights[i]));
            // 16 bits fit a float. The joint of no weight may be anything.
            const auto joint = static_cast<std::uint32_t>(joints[i]);
            if (weights[i] == 0.0f) continue;
            if (joint >= needs_.fewestJoints)
                attributes_.fail(jointsKey, fmt::format("element {} is {}, but skins[{}] has {} joints", i / kPerSet,
                                                        joint, needs_.skin, needs_.fewestJoints));
            out.influences[i / kPerSet * out.influencesPerVertex + set * kPerSet + i % kPerSet] = {joint, weights[i]};
        }
    }

    void normalise(std::span<Influence> vertex) {
        double sum = 0.0;
        for (const Influence& influence : vertex) sum += static_cast<double>(influence.weight);
        if (!(sum > 0.0)) {
            attributes_.warn("WEIGHTS_0", "vertices that no joint pulls follow the skin's first joint");
            vertex.front() = {0, 1.0f};
            return;
        }
        if (std::abs(sum - 1.0) > static_cast<double>(tolerance_))
            attributes_.warn("WEIGHTS_0", "weights that do not add up to 1 are normalised");
        for (Influence& influence : vertex)
            influence.weight = static_cast<float>(static_cast<double>(influence.weight) / sum);
    }

    const Element& attributes_;
    const Accessors& accessors_;
    const DeformationNeeds& needs_;
    std::uint64_t vertexCount_;
    float tolerance_ = 1e-3f;  // of a sum of weights; 0.01 for bytes, four times half a step
};

}  // namespace

void checkDeformation(const Element& primitive, const Accessors& accessors, std::uint64_t vertexCount, bool quantized) {
    checkSets(primitive.object("attributes"), accessors);
    const List targets = primitive.list("targets");
    for (std::size_t k = 0; k < targets.size(); ++k) checkTarget(targets[k], accessors, vertexCount, quantized);
}

std::shared_ptr<Deformation> readDeformation(const Element& primitive, const Accessors& accessors,
                                             const DeformationNeeds& needs, const DeformedVertices& vertices) {
    const Element attributes = primitive.object("attributes");
    const List targets = primitive.list("targets");
    const bool skinned = needs.fewestJoints > 0 && setCount(attributes) > 0;
    if (!skinned && !(needs.morphed && !targets.empty())) return nullptr;
    auto deformation = std::make_shared<Deformation>();
    if (skinned) InfluenceReader(attributes, accessors, needs, vertices.count).read(*deformation);
    for (std::size_t k = 0; needs.morphed && k < targets.size(); ++k) {
        MorphTarget& target = deformation->targets.emplace_back();
        target.positions = readDeltas(targets[k], accessors, "POSITION");
        if (vertices.normals) target.normals = readDeltas(targets[k], accessors, "NORMAL");
        if (vertices.tangents) target.tangents = readDeltas(targets[k], accessors, "TANGENT");
    }
    return deformation;
}

}  // namespace dioptre::gltf
