// Bounds of bent meshes: every posed vertex, worked out here in double precision, lies inside.
#include "scene/deformation.hpp"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "moving_scenes.hpp"
#include "scene/animation.hpp"
#include "scene/placement.hpp"

namespace dioptre {
namespace {

using namespace test;

class Chance {
  public:
    explicit Chance(unsigned seed) : engine_(seed) {}
    float in(float low, float high) { return std::uniform_real_distribution<float>(low, high)(engine_); }
    glm::vec3 point(float size) { return {in(-size, size), in(-size, size), in(-size, size)}; }
    glm::mat4 matrix() {
        glm::mat4 m(glm::mat3_cast(glm::normalize(glm::quat(in(-1, 1), in(-1, 1), in(-1, 1), in(-1, 1)))));
        for (int i = 0; i < 3; ++i) m[i] *= in(-2, 2);
        m[3] = glm::vec4(point(5.0f), 1.0f);
        return m;
    }

  private:
    std::mt19937 engine_;
};

glm::dvec3 posed(const Primitive& p, std::size_t vertex, const std::vector<float>& weights,
                 const std::vector<glm::mat4>& joints) {
    const Deformation& d = *p.deformation;
    glm::dvec3 at(p.vertices[vertex].position);
    for (std::size_t k = 0; k < d.targets.size(); ++k)
        if (!d.targets[k].positions.empty())
            at += static_cast<double>(weights[k]) * glm::dvec3(d.targets[k].positions[vertex]);
    if (joints.empty()) return at;
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < d.influencesPerVertex; ++i) {
        const Influence& influence = d.influences[vertex * d.influencesPerVertex + i];
        sum += static_cast<double>(influence.weight) *
               glm::dvec3(glm::dmat4(joints[influence.joint]) * glm::dvec4(at, 1.0));
    }
    return sum;
}

TEST(DeformationTest, BoundsHoldAllPosedVertices) {
    for (unsigned seed = 0; seed < 200; ++seed) {
        SCOPED_TRACE(seed);
        Chance chance(seed);
        Primitive p;
        auto deformation = std::make_shared<Deformation>();
        deformation->influencesPerVertex = seed % 3 == 0 ? 0 : 4;
        deformation->targets.resize(seed % 4);
        for (int v = 0; v < 30; ++v) {
            Vertex vertex;
            vertex.position = chance.point(3.0f);
            p.bounds.add(vertex.position);
            p.vertices.push_back(vertex);
            float left = 1.0f;
            for (std::size_t i = 0; i < deformation->influencesPerVertex; ++i) {
                const float weight = i == 3 ? left : chance.in(0.0f, left);
                left -= weight;
                deformation->influences.push_back({static_cast<std::uint32_t>(chance.in(0.0f, 4.99f)), weight});
            }
            for (MorphTarget& target : deformation->targets) target.positions.push_back(chance.point(1.0f));
        }
        if (!deformation->targets.empty()) deformation->targets.back().positions.clear();
        deformation->extent = findExtent(*deformation, p);
        p.deformation = deformation;
        Instance instance;
        instance.skin = deformation->influencesPerVertex > 0 ? 0 : -1;
        const DeformedExtent extent = extentOf(instance, p);
        for (int moment = 0; moment < 5; ++moment) {
            std::vector<float> weights;
            for (std::size_t k = 0; k < deformation->targets.size(); ++k) weights.push_back(chance.in(-2.0f, 3.0f));
            std::vector<glm::mat4> joints;
            for (int j = 0; j < 5 && instance.skin >= 0; ++j) joints.push_back(chance.matrix());
            const Bounds box = posedBounds(extent, weights, joints);
            for (std::size_t v = 0; v < p.vertices.size(); ++v) {
                const glm::dvec3 at = posed(p, v, weights, joints);
                for (int c = 0; c < 3; ++c) {
                    EXPECT_GE(at[c], static_cast<double>(box.min[c])) << "vertex " << v;
                    EXPECT_LE(at[c], static_cast<double>(box.max[c])) << "vertex " << v;
                }
            }
            EXPECT_LT(glm::length(box.size()), 200.0f) << "conservative, but not without end";
        }
    }
}

TEST(DeformationTest, BoundsOfOneJointAreTight) {
    Primitive p;
    p.vertices.resize(2);
    p.vertices[1].position = {1, 2, 3};
    p.bounds.add(p.vertices[0].position);
    p.bounds.add(p.vertices[1].position);
    auto deformation = std::make_shared<Deformation>();
    deformation->influencesPerVertex = 1;
    deformation->influences = {{3, 1.0f}, {3, 1.0f}};
    deformation->extent = findExtent(*deformation, p);
    p.deformation = deformation;
    Instance instance;
    instance.skin = 0;
    std::vector<glm::mat4> joints(4, glm::mat4(0.0f));
    joints[3] = glm::translate(glm::mat4(1.0f), {10, 0, 0});
    const Bounds box = posedBounds(extentOf(instance, p), {}, joints);
    EXPECT_LT(glm::length(box.min - glm::vec3(10, 0, 0)), 1e-3f);
    EXPECT_LT(glm::length(box.max - glm::vec3(11, 2, 3)), 1e-3f);
}

TEST(DeformationTest, ASceneIsFramedByAllItsMoments) {
    const Scene bar = load(bendingBarGltf());
    // Up at 0 s; the tip at x = -0.5, y = 0.5 +- 0.1 at 1 s, and on a quarter of a circle between.
    EXPECT_NEAR(bar.bounds.min.x, -0.5f, 0.15f);
    EXPECT_LE(bar.bounds.min.x, -0.5f);
    EXPECT_GE(bar.bounds.max.y, 1.0f);
    EXPECT_NEAR(bar.bounds.max.y, 1.0f, 0.15f);
    EXPECT_NEAR(bar.bounds.min.z, -4.0f, 1e-3f);
    EXPECT_LT(bar.bounds.max.x, 1.0f) << "the node of a skinned mesh does not place it";
    Json gltf = triangleGltf();
    addAnimation(gltf, 0, "translation", {0, 1}, {0, 0, 0, 7, 0, 0});
    EXPECT_NEAR(load(gltf).bounds.max.x, 8.0f, 1e-4f);
}

TEST(DeformationTest, UnsharedVerticesKeepTheirPulls) {
    Deformation shared;
    shared.influencesPerVertex = 2;
    shared.influences = {{0, 0.25f}, {1, 0.75f}, {2, 1.0f}, {0, 0.0f}};
    shared.targets = {{{{1, 0, 0}, {2, 0, 0}}, {}, {}}, {}};
    const std::vector<std::uint32_t> indices = {1, 0, 1};
    const Deformation out = unshared(shared, indices);
    EXPECT_TRUE(out.flat);
    ASSERT_EQ(out.influences.size(), 6u);
    EXPECT_EQ(out.influences[0].joint, 2u);
    EXPECT_EQ(out.influences[3].weight, 0.75f);
    ASSERT_EQ(out.targets.size(), 2u);
    EXPECT_EQ(out.targets[0].positions, (std::vector<glm::vec3>{{2, 0, 0}, {1, 0, 0}, {2, 0, 0}}));
    EXPECT_TRUE(out.targets[1].positions.empty());
}

}  // namespace
}  // namespace dioptre
