// Tangents: Lengyel, Foundations of Game Engine Development 2 (2019), 7.5: per triangle the gradients of u and v,
// summed at its vertices, made orthogonal to the normal. (Baked maps mostly assume MikkTSpace, which also splits
// vertices where the handedness changes; here those share a tangent.)
#include "scene/vertex_frame.hpp"

#include <array>
#include <cmath>
#include <cstddef>

namespace dioptre {
namespace {

// Twice the area as length. In double precision: hostile positions overflow when squared as floats.
glm::dvec3 faceNormal(const Primitive& p, std::size_t firstIndex) {
    const glm::dvec3 a(p.vertices[p.indices[firstIndex]].position);
    const glm::dvec3 b(p.vertices[p.indices[firstIndex + 1]].position);
    const glm::dvec3 c(p.vertices[p.indices[firstIndex + 2]].position);
    return glm::cross(b - a, c - a);
}

glm::vec3 unitOr(const glm::dvec3& v, const glm::vec3& otherwise) {
    const double length = glm::length(v);
    return length > 0.0 && std::isfinite(length) ? glm::vec3(v / length) : otherwise;
}

}  // namespace

glm::vec3 anyOrthogonal(const glm::vec3& n) {
    // The axis least along the normal keeps the cross product long.
    const glm::vec3 axis = std::abs(n.x) < 0.6f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    return glm::normalize(glm::cross(n, axis));
}

void makeFlat(Primitive& primitive) {
    std::vector<Vertex> unshared;
    unshared.reserve(primitive.indices.size());
    std::vector<VertexExtra> extras;
    if (!primitive.extras.empty()) {
        extras.reserve(primitive.indices.size());
        for (const std::uint32_t index : primitive.indices) extras.push_back(primitive.extras[index]);
    }
    for (std::size_t i = 0; i < primitive.indices.size(); i += 3) {
        const glm::vec3 normal = unitOr(faceNormal(primitive, i), glm::vec3(0, 0, 1));
        for (std::size_t corner = 0; corner < 3; ++corner) {
            unshared.push_back(primitive.vertices[primitive.indices[i + corner]]);
            unshared.back().normal = normal;
        }
    }
    primitive.vertices = std::move(unshared);
    primitive.extras = std::move(extras);
    for (std::size_t i = 0; i < primitive.indices.size(); ++i) primitive.indices[i] = static_cast<std::uint32_t>(i);
}

void fillNormals(Primitive& primitive, const std::vector<bool>& missing) {
    std::vector<glm::dvec3> sums(primitive.vertices.size(), glm::dvec3(0.0));
    for (std::size_t i = 0; i + 2 < primitive.indices.size() && primitive.topology == Topology::triangles; i += 3) {
        const glm::dvec3 normal = faceNormal(primitive, i);
        for (std::size_t corner = 0; corner < 3; ++corner) sums[primitive.indices[i + corner]] += normal;
    }
    for (std::size_t v = 0; v < sums.size(); ++v)
        if (missing[v]) primitive.vertices[v].normal = unitOr(sums[v], glm::vec3(0, 0, 1));
}

void computeTangents(Primitive& primitive, const TextureSlot& slot) {
    const bool second = slot.uvSet == 1 && !primitive.extras.empty();
    const glm::dmat3x2 imageFromVertex(slot.imageFromVertex);
    const auto uvOf = [&](std::uint32_t i) {
        const glm::vec2& uv = second ? primitive.extras[i].uv : primitive.vertices[i].uv;
        return imageFromVertex * glm::dvec3(uv, 1.0);
    };
    struct Gradients {
        glm::dvec3 u{0.0}, v{0.0};
    };
    std::vector<Gradients> sums(primitive.vertices.size());
    for (std::size_t i = 0; i < primitive.indices.size(); i += 3) {
        const std::array<std::uint32_t, 3> corner{primitive.indices[i], primitive.indices[i + 1],
                                                  primitive.indices[i + 2]};
        const Vertex &a = primitive.vertices[corner[0]], &b = primitive.vertices[corner[1]],
                     &c = primitive.vertices[corner[2]];
        const glm::dvec3 e1 = glm::dvec3(b.position) - glm::dvec3(a.position);
        const glm::dvec3 e2 = glm::dvec3(c.position) - glm::dvec3(a.position);
        const glm::dvec2 uv = uvOf(corner[0]), d1 = uvOf(corner[1]) - uv, d2 = uvOf(corner[2]) - uv;
        // e = du * T + dv * B for both edges; solved for T and B up to the determinant, of which only the sign counts.
        const double determinant = d1.x * d2.y - d2.x * d1.y;
        if (determinant == 0.0) continue;
        const double sign = determinant > 0.0 ? 1.0 : -1.0;
        const glm::dvec3 u = (e1 * d2.y - e2 * d1.y) * sign, v = (e2 * d1.x - e1 * d2.x) * sign;
        for (const std::uint32_t vertex : corner) {
            sums[vertex].u += u;
            sums[vertex].v += v;
        }
    }
    for (std::size_t i = 0; i < sums.size(); ++i) {
        Vertex& vertex = primitive.vertices[i];
        const glm::dvec3 normal(vertex.normal);
        const glm::dvec3 inPlane = sums[i].u - normal * glm::dot(normal, sums[i].u);
        const glm::vec3 tangent = unitOr(inPlane, anyOrthogonal(vertex.normal));
        // The bitangent, cross(n, t) w, points up in the normal map; v runs down (glTF 2.0, 3.9.3).
        const bool left = glm::dot(glm::cross(normal, glm::dvec3(tangent)), sums[i].v) > 0.0;
        vertex.tangent = glm::vec4(tangent, left ? -1.0f : 1.0f);
    }
}

}  // namespace dioptre
