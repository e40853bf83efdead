#include "scene/shared_vertices.hpp"

#include <bit>
#include <functional>
#include <unordered_map>

#include "core/hash_seed.hpp"

namespace dioptre {

namespace {

constexpr std::size_t kFew = 256;  // primitives, of which all can be compared with all

struct PlaceHash {
    std::size_t operator()(const glm::vec3& p) const {
        std::uint64_t hash = hashSeed();
        for (int k = 0; k < 3; ++k) hash = (hash ^ std::bit_cast<std::uint32_t>(p[k])) * 0x9e3779b97f4a7c15ULL;
        return static_cast<std::size_t>(hash ^ hash >> 29);
    }
};

}  // namespace

std::vector<std::vector<std::uint8_t>> sharedVertices(const Mesh& mesh, const std::function<bool()>& stopped) {
    std::vector<std::vector<std::uint8_t>> shared(mesh.primitives.size());
    if (mesh.primitives.size() < 2) return shared;
    // A place can be shared only where the boxes of two primitives meet
    const auto meet = [](const Bounds& a, const Bounds& b) {
        return glm::all(glm::lessThanEqual(a.min, b.max)) && glm::all(glm::lessThanEqual(b.min, a.max));
    };
    const auto inside = [](const Bounds& b, const glm::vec3& p) {
        return glm::all(glm::lessThanEqual(b.min, p)) && glm::all(glm::lessThanEqual(p, b.max));
    };
    std::vector<Bounds> boxes(mesh.primitives.size());
    for (std::size_t i = 0; i < boxes.size(); ++i)
        for (const Vertex& v : mesh.primitives[i].vertices) boxes[i].add(v.position);
    std::vector<Bounds> common(boxes.size());  // of each, where it may meet others
    const bool few = boxes.size() <= kFew;
    for (std::size_t a = 0; a < boxes.size(); ++a)
        for (std::size_t b = 0; b < boxes.size() && few; ++b)
            if (a != b && !boxes[a].empty() && !boxes[b].empty() && meet(boxes[a], boxes[b])) common[a].add(boxes[b]);
    if (!few) common = boxes;
    constexpr std::uint32_t kMany = 0xFFFFFFFF;
    std::unordered_map<glm::vec3, std::uint32_t, PlaceHash> owner;
    const auto each = [&](const auto& visit) {
        for (std::uint32_t i = 0; i < boxes.size() && !stopped(); ++i)
            for (std::size_t v = 0; v < mesh.primitives[i].vertices.size(); ++v)
                if (inside(common[i], mesh.primitives[i].vertices[v].position))
                    visit(i, v, mesh.primitives[i].vertices[v].position + 0.0f);
    };
    each([&](std::uint32_t i, std::size_t, const glm::vec3& place) {
        const auto [at, isNew] = owner.try_emplace(place, i);
        if (!isNew && at->second != i) at->second = kMany;
    });
    each([&](std::uint32_t i, std::size_t v, const glm::vec3& place) {
        if (owner.at(place) != kMany) return;
        if (shared[i].empty()) shared[i].assign(mesh.primitives[i].vertices.size(), 0);
        shared[i][v] = 1;
    });
    return shared;
}

}  // namespace dioptre
