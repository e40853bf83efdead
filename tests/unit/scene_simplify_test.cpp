// Levels of detail of one primitive: what must stay does, and errors are what they say.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "lod_meshes.hpp"
#include "scene/simplify.hpp"

namespace dioptre {
namespace {

using test::addTriangles;
using test::addVertex;
using Indices = std::vector<std::uint32_t>;
using Place = std::array<float, 3>;

std::vector<LodLevel> levelsOf(const Primitive& primitive, const std::vector<std::uint8_t>& fixed = {}) {
    std::vector<LodLevel> levels;
    simplify({primitive, fixed, [&](LodLevel level) { levels.push_back(std::move(level)); }, [] { return false; }});
    return levels;
}

Place placeOf(const Primitive& p, std::uint32_t i) {
    const glm::vec3 at = p.vertices[i].position + 0.0f;
    return {at.x, at.y, at.z};
}

/// Directed edges, by place, and how often each is there.
std::map<std::pair<Place, Place>, int> edgesOf(const Primitive& p, const Indices& indices) {
    std::map<std::pair<Place, Place>, int> edges;
    for (std::size_t i = 0; i < indices.size(); ++i) {
        const std::size_t next = i % 3 == 2 ? i - 2 : i + 1;
        ++edges[{placeOf(p, indices[i]), placeOf(p, indices[next])}];
    }
    return edges;
}

/// Edges that have no face on the other side.
std::set<std::pair<Place, Place>> borderOf(const Primitive& p, const Indices& indices) {
    const auto edges = edgesOf(p, indices);
    std::set<std::pair<Place, Place>> border;
    for (const auto& [edge, count] : edges)
        if (!edges.contains({edge.second, edge.first})) border.insert(edge);
    return border;
}

glm::dvec3 positionOf(const Primitive& p, std::uint32_t i) {
    return glm::dvec3(p.vertices[i].position);
}

void expectNoFlips(const Primitive& p, const Indices& indices) {
    for (std::size_t i = 0; i < indices.size(); i += 3) {
        const glm::dvec3 a = positionOf(p, indices[i]), b = positionOf(p, indices[i + 1]),
                         c = positionOf(p, indices[i + 2]);
        glm::vec3 normals(0.0f);
        for (std::size_t k = 0; k < 3; ++k) normals += p.vertices[indices[i + k]].normal;
        ASSERT_GT(glm::dot(glm::cross(b - a, c - a), glm::dvec3(normals)), 0.0) << "triangle " << i / 3;
    }
}

// Ericson 2005, "Real-time collision detection", 5.1.5
double distanceFromTriangle(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
    const double d1 = dot(ab, ap), d2 = dot(ac, ap), d3 = dot(ab, bp), d4 = dot(ac, bp), d5 = dot(ab, cp),
                 d6 = dot(ac, cp);
    if (d1 <= 0 && d2 <= 0) return length(ap);
    if (d3 >= 0 && d4 <= d3) return length(bp);
    if (d6 >= 0 && d5 <= d6) return length(cp);
    const double va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return length(ap - ab * (d1 / (d1 - d3)));
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return length(ap - ac * (d2 / (d2 - d6)));
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return length(bp - (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6))));
    return length(ap - (ab * vb + ac * vc) / (va + vb + vc));
}

/// The farthest of points on one surface, `steps` to an edge, from the other.
double farthest(const Primitive& p, const Indices& from, const Indices& onto, int steps) {
    struct Target {
        glm::dvec3 a, b, c, middle;
        double radius;
    };
    std::vector<Target> targets;
    for (std::size_t i = 0; i < onto.size(); i += 3) {
        Target t{positionOf(p, onto[i]), positionOf(p, onto[i + 1]), positionOf(p, onto[i + 2]), {}, 0.0};
        t.middle = (t.a + t.b + t.c) / 3.0;
        for (const glm::dvec3& corner : {t.a, t.b, t.c}) t.radius = std::max(t.radius, glm::distance(corner, t.middle));
        targets.push_back(t);
    }
    double most = 0.0;
    for (std::size_t i = 0; i < from.size(); i += 3) {
        const glm::dvec3 a = positionOf(p, from[i]), b = positionOf(p, from[i + 1]), c = positionOf(p, from[i + 2]);
        for (int x = 0; x <= steps; ++x) {
            for (int y = 0; x + y <= steps; ++y) {
                const glm::dvec3 point =
                    a + (b - a) * (static_cast<double>(x) / steps) + (c - a) * (static_cast<double>(y) / steps);
                double best = 1e300;
                for (const Target& t : targets) {
                    if (glm::distance(point, t.middle) - t.radius >= best) continue;
                    best = std::min(best, distanceFromTriangle(point, t.a, t.b, t.c));
                    if (best <= most) break;
                }
                most = std::max(most, best);
            }
        }
    }
    return most;
}

struct Surface {
    const char* name;
    Primitive primitive;
};
std::vector<Surface> surfaces() {
    return {{"torus", test::torus(20, 10, 0.03)}, {"sheet", test::sheet(12, 0.05)}, {"box", test::box(4)}};
}

TEST(SimplifyTest, EachLevelHasHalfTheTriangles) {
    const Primitive torus = test::torus(48, 24, 0.02);
    const auto levels = levelsOf(torus);
    ASSERT_GE(levels.size(), 5u);
    std::size_t before = torus.triangleCount();
    for (const LodLevel& level : levels) {
        const std::size_t triangles = level.indices.size() / 3;
        EXPECT_LE(triangles, before / 2 + 1);
        EXPECT_GE(triangles, before / 2 - 3);
        before = triangles;
    }
    EXPECT_LE(before, kFewestTriangles);
}

TEST(SimplifyTest, ErrorsBoundTheDistanceBothWays) {
    for (const Surface& s : surfaces()) {
        float last = 0.0f;
        for (const LodLevel& level : levelsOf(s.primitive)) {
            const double there = farthest(s.primitive, level.indices, s.primitive.indices, 6);
            const double back = farthest(s.primitive, s.primitive.indices, level.indices, 3);
            const double distance = std::max(there, back);
            EXPECT_LE(distance, static_cast<double>(level.error) + 1e-12) << s.name << ' ' << level.indices.size() / 3;
            // Of use: not many times what it bounds
            EXPECT_LE(static_cast<double>(level.error), 8.0 * distance + 1e-6)
                << s.name << ' ' << level.indices.size() / 3;
            EXPECT_GE(level.error, last);
            last = level.error;
        }
    }
}

TEST(SimplifyTest, ClosedStaysClosedAndBordersStay) {
    for (const Surface& s : surfaces()) {
        const auto border = borderOf(s.primitive, s.primitive.indices);
        const bool open = std::string_view(s.name) == "sheet";
        EXPECT_EQ(border.empty(), !open);
        const auto levels = levelsOf(s.primitive);
        EXPECT_FALSE(levels.empty()) << s.name;
        for (const LodLevel& level : levels) {
            for (const auto& [edge, count] : edgesOf(s.primitive, level.indices)) ASSERT_EQ(count, 1) << s.name;
            // The sheet's sides are waves where they are not straight: those stay as they are
            for (const auto& edge : borderOf(s.primitive, level.indices)) ASSERT_TRUE(open) << s.name << edge.first[0];
            expectNoFlips(s.primitive, level.indices);
        }
    }
}

TEST(SimplifyTest, BordersLoseVerticesOnStraightLinesOnly) {
    const Primitive flat = test::sheet(16, 0.0);
    const auto levels = levelsOf(flat);
    ASSERT_FALSE(levels.empty());
    EXPECT_LE(levels.back().indices.size() / 3, kFewestTriangles);
    EXPECT_GE(levels.front().indices.size(), flat.indices.size() / 2 - 6);
    for (const LodLevel& level : levels) {
        EXPECT_LT(level.error, 1e-5f);
        double area = 0.0;
        for (std::size_t i = 0; i < level.indices.size(); i += 3) {
            const glm::dvec3 a = positionOf(flat, level.indices[i]);
            area += 0.5 * glm::length(glm::cross(positionOf(flat, level.indices[i + 1]) - a,
                                                 positionOf(flat, level.indices[i + 2]) - a));
        }
        EXPECT_NEAR(area, 1.0, 1e-6);
    }
    // A border that another primitive has as well keeps all of its vertices.
    std::vector<std::uint8_t> fixed(flat.vertices.size(), 0);
    for (std::size_t i = 0; i < fixed.size(); ++i) fixed[i] = flat.vertices[i].position.x == 1.0f;
    std::set<Place> wanted;
    for (std::uint32_t i = 0; i < fixed.size(); ++i)
        if (fixed[i]) wanted.insert(placeOf(flat, i));
    for (const LodLevel& level : levelsOf(flat, fixed)) {
        std::set<Place> found;
        for (const std::uint32_t i : level.indices)
            if (fixed[i]) found.insert(placeOf(flat, i));
        EXPECT_EQ(found, wanted);
        for (const auto& [a, b] : borderOf(flat, level.indices))
            if (a[0] == 1.0f && b[0] == 1.0f) {
                EXPECT_NEAR(std::abs(a[2] - b[2]), 1.0f / 16.0f, 1e-6f);
            }
    }
}

// At the seams of the torus texture coordinates jump from 1 to 0: a triangle that took a vertex of the wrong side would
// stretch over the whole picture.
TEST(SimplifyTest, SeamsKeepTheirSides) {
    const Primitive torus = test::torus(48, 24, 0.02);
    for (const LodLevel& level : levelsOf(torus)) {
        for (std::size_t i = 0; i < level.indices.size(); i += 3) {
            for (int k = 0; k < 2; ++k) {
                // As from the places: their angles, on the side that the triangle is on
                double least = 2.0, most = -1.0;
                for (std::size_t c = 0; c < 3; ++c) {
                    const double uv = static_cast<double>(torus.vertices[level.indices[i + c]].uv[k]);
                    least = std::min(least, uv);
                    most = std::max(most, uv);
                }
                ASSERT_LT(most - least, 0.75) << "triangle " << i / 3 << " of " << level.indices.size() / 3;
            }
        }
        // Each seam edge has a face on either side, between the same places, and shows 0 on one and 1 on the other; along
        // it both show the same.
        for (const int across : {0, 1}) {
            using End = std::pair<Place, float>;  // with the coordinate along the seam
            std::map<std::pair<End, End>, int> seam;
            for (std::size_t i = 0; i < level.indices.size(); ++i) {
                const std::uint32_t a = level.indices[i], b = level.indices[i % 3 == 2 ? i - 2 : i + 1];
                const glm::vec2 &p = torus.vertices[a].uv, &q = torus.vertices[b].uv;
                for (const float side : {0.0f, 1.0f})
                    if (p[across] == side && q[across] == side)
                        seam[std::minmax(End(placeOf(torus, a), p[1 - across]),
                                         End(placeOf(torus, b), q[1 - across]))] += side == 0.0f ? 1 : 16;
            }
            EXPECT_GE(seam.size(), 3u);
            for (const auto& [edge, sides] : seam) EXPECT_EQ(sides, 17);
        }
    }
}

// Texture coordinates that jump to and fro along a seam: whatever vertex of it goes, all that is seen there moves.
TEST(SimplifyTest, ErrorsStaySmallBesideTheMesh) {
    Primitive torus = test::torus(48, 24, 0.02);
    for (Vertex& v : torus.vertices)
        if (v.uv.x == 0.0f || v.uv.x == 1.0f) v.uv.y = static_cast<float>(std::lround(v.uv.y * 24.0f) % 2);
    const auto levels = levelsOf(torus);
    ASSERT_GE(levels.size(), 3u);
    for (const LodLevel& level : levels)
        EXPECT_LT(level.error, 0.501f * glm::length(torus.bounds.size())) << level.indices.size() / 3;
}

TEST(SimplifyTest, HardEdgesKeepTheirNormals) {
    const Primitive box = test::box(8);
    const auto levels = levelsOf(box);
    EXPECT_LE(levels.back().indices.size() / 3, kFewestTriangles);
    for (const LodLevel& level : levels) {
        EXPECT_LT(level.error, 1e-5f);
        for (std::size_t i = 0; i < level.indices.size(); i += 3)
            for (std::size_t k = 1; k < 3; ++k)
                ASSERT_EQ(box.vertices[level.indices[i]].normal, box.vertices[level.indices[i + k]].normal);
    }
}

/// A ball of many triangles, and something beside it that is no surface.
Primitive withOddities() {
    Primitive p = test::torus(24, 12, 0.0);
    const auto at = [&](double x, double y, double z) { return addVertex(p, {x, y, z}, {0, 0, 1}); };
    const std::uint32_t a = at(3, 0, 0), b = at(4, 0, 0), c = at(3, 1, 0), d = at(3, -1, 0), e = at(3, 0, 1);
    addTriangles(p, {a, b, c, b, a, d, a, b, e});              // three faces on an edge
    addTriangles(p, {a, b, c, a, c, b});                       // again, and from behind
    addTriangles(p, {c, at(2, 2, 0), at(2.5, 2, 0)});          // touches in one vertex
    addTriangles(p, {a, a, b, e, e, e});                       // no area, repeated
    addTriangles(p, {at(5, 0, 0), at(6, 0, 0), at(7, 0, 0)});  // no area, on a line
    for (int i = 0; i < 40; ++i) addTriangles(p, {a, b, d});   // many times the same
    return p;
}

TEST(SimplifyTest, WhatIsNoSurfaceStays) {
    const Primitive odd = withOddities();
    const std::size_t ball = 24 * 12 * 2;
    std::map<std::array<Place, 3>, int> wanted;
    const auto key = [&](const Indices& indices, std::size_t i) {
        std::array<Place, 3> t{placeOf(odd, indices[i]), placeOf(odd, indices[i + 1]), placeOf(odd, indices[i + 2])};
        std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
        return t;
    };
    for (std::size_t i = 3 * ball; i < odd.indices.size(); i += 3) {
        const auto t = key(odd.indices, i);
        if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) ++wanted[t];
    }
    const auto levels = levelsOf(odd);
    ASSERT_GE(levels.size(), 2u);
    for (const LodLevel& level : levels) {
        std::map<std::array<Place, 3>, int> found;
        for (std::size_t i = 0; i < level.indices.size(); i += 3)
            if (odd.vertices[level.indices[i]].position.x > 1.9f) ++found[key(level.indices, i)];
        EXPECT_EQ(found, wanted);
    }
}

TEST(SimplifyTest, SheetsBackToBackAreSimplified) {
    Primitive p = test::sheet(16, 0.05);
    const std::size_t front = p.indices.size();
    const auto count = static_cast<std::uint32_t>(p.vertices.size());
    for (std::uint32_t i = 0; i < count; ++i) {
        p.vertices.push_back(p.vertices[i]);
        p.vertices.back().normal = -p.vertices[i].normal;
    }
    for (std::size_t i = 0; i < front; i += 3)
        addTriangles(p, {count + p.indices[i], count + p.indices[i + 2], count + p.indices[i + 1]});
    const auto levels = levelsOf(p);
    ASSERT_GE(levels.size(), 2u);
    for (const LodLevel& level : levels) expectNoFlips(p, level.indices);
}

TEST(SimplifyTest, LittleOrNothingHasNoLevels) {
    Primitive p;
    EXPECT_TRUE(levelsOf(p).empty());
    addVertex(p, {0, 0, 0}, {0, 0, 1});
    for (int i = 0; i < 100; ++i) addTriangles(p, {0, 0, 0});
    EXPECT_TRUE(levelsOf(p).empty());
    EXPECT_TRUE(levelsOf(test::sheet(4, 0.1)).empty());
    // A fan with more faces around a vertex than are looked at, and numbers at the edge of what there is
    Primitive fan;
    const std::uint32_t middle = addVertex(fan, {0, 0, 0}, {0, 0, 1});
    for (int i = 0; i < 500; ++i) addVertex(fan, {std::cos(i * 0.01), std::sin(i * 0.01), 0.0}, {0, 0, 1});
    for (std::uint32_t i = 1; i < 500; ++i) addTriangles(fan, {middle, i, i + 1});
    levelsOf(fan);
    for (Vertex& v : fan.vertices) v.position *= 1e37f;
    levelsOf(fan);
    for (Vertex& v : fan.vertices) v.position *= 1e-37f * 1e-37f;
    levelsOf(fan);
}

TEST(SimplifyTest, StopsWhenAsked) {
    const Primitive torus = test::torus(48, 24, 0.02);
    int asked = 0, made = 0;
    for (int limit = 0; limit < 16; limit += 5) {
        asked = made = 0;
        simplify({torus, {}, [&](LodLevel) { ++made; }, [&] { return ++asked > limit; }});
        EXPECT_LE(made, 3);
    }
}

}  // namespace
}  // namespace dioptre
