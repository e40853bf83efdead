#include "scene/vertex_frame.hpp"

#include <gtest/gtest.h>

namespace dioptre {
namespace {

// A unit square in the plane z = 0, facing +z, with uv = `scale` times x, y.
Primitive square(const glm::vec2& scale) {
    Primitive p;
    for (const glm::vec2 corner : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)})
        p.vertices.push_back({glm::vec3(corner, 0), {0, 0, 1}, {}, corner * scale});
    p.indices = {0, 1, 2, 0, 2, 3};
    return p;
}

TEST(VertexFrameTest, TangentRunsAlongU) {
    Primitive p = square({2, 3});
    computeTangents(p);
    for (const Vertex& v : p.vertices) EXPECT_EQ(v.tangent, glm::vec4(1, 0, 0, -1));
}

TEST(VertexFrameTest, MirroredUvTurnsTheHandedness) {
    Primitive p = square({-1, 1});
    computeTangents(p);
    for (const Vertex& v : p.vertices) EXPECT_EQ(v.tangent, glm::vec4(-1, 0, 0, 1));
    p = square({1, -1});
    computeTangents(p);
    for (const Vertex& v : p.vertices) EXPECT_EQ(v.tangent, glm::vec4(1, 0, 0, 1));
}

TEST(VertexFrameTest, FlatUvStillGivesAnOrthogonalUnitTangent) {
    for (const glm::vec3 normal : {glm::vec3(0, 0, 1), glm::vec3(1, 0, 0), glm::vec3(0, -1, 0)}) {
        Primitive p = square({0, 0});
        for (Vertex& v : p.vertices) v.normal = normal;
        computeTangents(p);
        for (const Vertex& v : p.vertices) {
            EXPECT_NEAR(glm::length(glm::vec3(v.tangent)), 1.0f, 1e-6f);
            EXPECT_NEAR(glm::dot(glm::vec3(v.tangent), normal), 0.0f, 1e-6f);
            EXPECT_EQ(std::abs(v.tangent.w), 1.0f);
        }
    }
}

TEST(VertexFrameTest, FlatVerticesAreUnshared) {
    Primitive p = square({1, 1});
    p.vertices[3].position.z = 1.0f;
    makeFlat(p);
    ASSERT_EQ(p.vertices.size(), 6u);
    EXPECT_EQ(p.vertices[0].normal, glm::vec3(0, 0, 1));
    EXPECT_NEAR(glm::length(p.vertices[4].normal), 1.0f, 1e-6f);
    EXPECT_EQ(p.vertices[3].normal, p.vertices[5].normal);
    EXPECT_EQ(p.vertices[5].uv, glm::vec2(0, 1));
}

TEST(VertexFrameTest, DegenerateAndHugeTrianglesGetUnitNormals) {
    Primitive p = square({1, 1});
    p.indices = {0, 0, 1, 0, 1, 2};
    for (Vertex& v : p.vertices) v.position *= 1e38f;
    fillNormals(p, std::vector<bool>(4, true));
    for (const Vertex& v : p.vertices) EXPECT_EQ(v.normal, glm::vec3(0, 0, 1));
    makeFlat(p);
    for (const Vertex& v : p.vertices) EXPECT_EQ(v.normal, glm::vec3(0, 0, 1));
}

}  // namespace
}  // namespace dioptre
