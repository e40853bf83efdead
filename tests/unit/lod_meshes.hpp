// Small surfaces to simplify.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <initializer_list>

#include "scene/scene.hpp"

namespace dioptre::test {

inline std::uint32_t addVertex(Primitive& primitive, const glm::dvec3& position, const glm::dvec3& normal,
                               const glm::dvec2& uv = {}) {
    Vertex v;
    v.position = position;
    v.normal = glm::normalize(normal);
    v.uv = uv;
    primitive.vertices.push_back(v);
    primitive.bounds.add(v.position);
    return static_cast<std::uint32_t>(primitive.vertices.size() - 1);
}

inline void addTriangles(Primitive& primitive, std::initializer_list<std::uint32_t> indices) {
    primitive.indices.insert(primitive.indices.end(), indices);
}

/// `at(s, t)` adds the vertex at s, t in 0..1 and returns its index; n x m squares of two triangles.
template <class Place>
void addGrid(Primitive& primitive, int n, int m, const Place& at) {
    const auto first = static_cast<std::uint32_t>(primitive.vertices.size());
    for (int i = 0; i <= n; ++i)
        for (int k = 0; k <= m; ++k) at(static_cast<double>(i) / n, static_cast<double>(k) / m);
    for (int i = 0; i < n; ++i) {
        for (int k = 0; k < m; ++k) {
            const auto a = first + static_cast<std::uint32_t>(i * (m + 1) + k),
                       b = a + static_cast<std::uint32_t>(m) + 1;
            addTriangles(primitive, {a, b, b + 1, a, b + 1, a + 1});
        }
    }
}

/// A torus with bumps, closed by seams: texture coordinates run from 0 to 1 both ways.
inline Primitive torus(int along, int across, double bumps) {
    Primitive primitive;
    addGrid(primitive, along, across, [&](double s, double t) {
        // Equal to the bit where the seams meet
        const double a = s == 1.0 ? 0.0 : 2.0 * M_PI * s, b = t == 1.0 ? 0.0 : 2.0 * M_PI * t;
        const double tube = 0.3 + bumps * std::sin(5.0 * a) * std::cos(3.0 * b), r = 1.0 + tube * std::cos(b);
        addVertex(primitive, {r * std::cos(a), tube * std::sin(b), -r * std::sin(a)},
                  {std::cos(b) * std::cos(a), std::sin(b), -std::cos(b) * std::sin(a)}, {s, t});
    });
    return primitive;
}

/// An open, wavy square in x, z from 0 to 1, `x0` moved.
inline Primitive sheet(int n, double waves, double x0 = 0.0) {
    Primitive primitive;
    addGrid(primitive, n, n, [&](double s, double t) {
        addVertex(primitive, {x0 + s, waves * std::sin(9.0 * (x0 + s)) * std::sin(7.0 * t), -t}, {0, 1, 0}, {s, t});
    });
    return primitive;
}

/// A box of n x n squares a side, with a normal for each side: hard edges.
inline Primitive box(int n) {
    Primitive primitive;
    for (int axis = 0; axis < 3; ++axis) {
        for (const double side : {-1.0, 1.0}) {
            addGrid(primitive, n, n, [&](double s, double t) {
                glm::dvec3 p(0.0), normal(0.0);
                normal[axis] = p[axis] = side;
                p[(axis + 1) % 3] = side * (2.0 * s - 1.0);
                p[(axis + 2) % 3] = 2.0 * t - 1.0;
                addVertex(primitive, p, normal, {s, t});
            });
        }
    }
    return primitive;
}

}  // namespace dioptre::test
