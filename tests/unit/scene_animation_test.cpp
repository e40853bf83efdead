// Keyframes and poses against values worked out by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "scene/animation.hpp"

namespace dioptre {
namespace {

constexpr auto kMove = AnimatedProperty::translation;
constexpr auto kTurn = AnimatedProperty::rotation;

void expectValues(const std::vector<double>& got, const std::vector<double>& wanted, const std::string& what) {
    ASSERT_EQ(got.size(), wanted.size()) << what;
    for (std::size_t i = 0; i < got.size(); ++i) EXPECT_NEAR(got[i], wanted[i], 1e-7) << what << ", component " << i;
}

TEST(CurveTest, HoldsBeforeTheFirstAndAfterTheLastKey) {
    for (const auto way : {Interpolation::step, Interpolation::linear}) {
        const Curve curve{way, 1, {1, 2}, {10, 20}};
        expectValues(valueAt(curve, AnimatedProperty::weights, 0.0), {10}, "before");
        expectValues(valueAt(curve, AnimatedProperty::weights, 1.0), {10}, "first");
        expectValues(valueAt(curve, AnimatedProperty::weights, 2.0), {20}, "last");
        expectValues(valueAt(curve, AnimatedProperty::weights, 9.0), {20}, "after");
    }
    const Curve one{Interpolation::cubicSpline, 3, {0.5f}, {9, 9, 9, 1, 2, 3, 9, 9, 9}};
    for (const double t : {0.0, 0.5, 1.0}) expectValues(valueAt(one, kMove, t), {1, 2, 3}, "one key");
}

TEST(CurveTest, StepAndLinear) {
    const std::vector<float> times = {0, 1, 3}, values = {0, 0, 0, 2, 4, -6, 4, 0, 0};
    const Curve step{Interpolation::step, 3, times, values}, linear{Interpolation::linear, 3, times, values};
    expectValues(valueAt(step, kMove, 0.999), {0, 0, 0}, "step");
    expectValues(valueAt(step, kMove, 1.0), {2, 4, -6}, "step");
    expectValues(valueAt(step, kMove, 2.999), {2, 4, -6}, "step");
    expectValues(valueAt(linear, kMove, 0.25), {0.5, 1, -1.5}, "linear");
    expectValues(valueAt(linear, kMove, 2.5), {3.5, 1, -1.5}, "linear");
}

TEST(CurveTest, CubicSplineIsHermites) {
    // Keys at 1 s and 3 s: values 0 and 1, out-tangent 2 and in-tangent -1 per second. At a quarter, with td = 2:
    // h00 = 0.84375, h10 = 0.140625, h01 = 0.15625, h11 = -0.046875.
    const Curve curve{Interpolation::cubicSpline, 1, {1, 3}, {77, 0, 2, -1, 1, 77}};
    const auto w = AnimatedProperty::weights;
    expectValues(valueAt(curve, w, 1.0), {0}, "first");
    expectValues(valueAt(curve, w, 1.5), {2 * 0.140625 * 2 + 0.15625 + 2 * -0.046875 * -1}, "a quarter");
    expectValues(valueAt(curve, w, 2.0), {2 * 0.125 * 2 + 0.5 + 2 * -0.125 * -1}, "half");
    expectValues(valueAt(curve, w, 3.0), {1}, "last");
    // Without tangents it eases: half way at half time.
    const Curve ease{Interpolation::cubicSpline, 1, {0, 1}, {0, 0, 0, 0, 8, 0}};
    expectValues(valueAt(ease, w, 0.5), {4}, "ease");
    expectValues(valueAt(ease, w, 0.25), {8 * 0.15625}, "ease");
}

TEST(CurveTest, RotationsTakeTheShorterArcAtEvenSpeed) {
    const auto about = [](double degrees) {
        return std::array{0.0f, 0.0f, static_cast<float>(std::sin(glm::radians(degrees) / 2)),
                          static_cast<float>(std::cos(glm::radians(degrees) / 2))};
    };
    const auto a = about(0), b = about(120);
    for (const float sign : {1.0f, -1.0f}) {  // q and -q are one rotation
        const Curve curve{Interpolation::linear,
                          4,
                          {0, 3},
                          {a[0], a[1], a[2], a[3], sign * b[0], sign * b[1], sign * b[2], sign * b[3]}};
        for (const double t : {0.0, 0.75, 1.0, 2.0}) {
            const std::vector<double> q = valueAt(curve, kTurn, t);
            EXPECT_NEAR(glm::degrees(2.0 * std::atan2(q[2] * (q[3] < 0 ? -1 : 1), std::abs(q[3]))), 40.0 * t, 1e-5);
            EXPECT_NEAR(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3], 1.0, 1e-12);
        }
    }
}

TEST(CurveTest, RotationsOfASplineAreNormalised) {
    const float h = std::sqrt(0.5f);
    const Curve curve{Interpolation::cubicSpline, 4, {0, 1}, {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0,
                                                              0, 0, 0, 0, 0, 0, h, h, 0, 0, 0, 0}};
    // The mean of 0 and 90 degrees is the direction of 45.
    expectValues(valueAt(curve, kTurn, 0.5), {0, 0, std::sin(glm::radians(22.5)), std::cos(glm::radians(22.5))}, "");
    // Through zero there is still a rotation.
    const Curve zero{Interpolation::cubicSpline, 4, {0, 1}, {0, 0, 0, 0, 0, 0, 0, 1,  0, 0, 0, 0,
                                                             0, 0, 0, 0, 0, 0, 0, -1, 0, 0, 0, 0}};
    expectValues(valueAt(zero, kTurn, 0.5), {0, 0, 0, 1}, "zero");
}

/// A turning arm with a hand that slides along it.
Motion arm() {
    Motion motion;
    motion.nodes = {{-1, {}}, {0, {{1, 0, 0}}}, {-1, {}, {0.5f}}};
    Animation& turn = motion.animations.emplace_back();
    turn.length = 4.0;
    const float h = std::sqrt(0.5f);
    turn.curves = {
        {Interpolation::linear, 4, {0, 1, 2, 3, 4}, {0, 0, 0, 1, 0, 0, h, h, 0, 0, 1, 0, 0, 0, h, -h, 0, 0, 0, -1}}};
    turn.channels = {{0, 0, AnimatedProperty::rotation}};
    Animation& slide = motion.animations.emplace_back();
    slide.length = 1.0;
    slide.curves = {{Interpolation::linear, 3, {0, 1}, {1, 0, 0, 3, 0, 0}},
                    {Interpolation::step, 1, {0, 0.5f}, {0, 1}}};
    slide.channels = {{1, 0, AnimatedProperty::translation}, {2, 1, AnimatedProperty::weights}};
    return motion;
}

TEST(PoseTest, AnimationsPlayTogetherAndOverAndOver) {
    const Motion motion = arm();
    EXPECT_EQ(motion.length(), 4.0);
    const auto hand = [&](double t) { return glm::dvec3(poseAt(motion, t).worldFromNode[1][3]); };
    const auto near = [](const glm::dvec3& a, const glm::dvec3& b) { return glm::length(a - b) < 1e-6; };
    EXPECT_TRUE(near(hand(0.0), {1, 0, 0}));
    EXPECT_TRUE(near(hand(0.5), glm::dvec3(1, 1, 0) * std::sqrt(2.0))) << "45 degrees, 2 m out";
    EXPECT_TRUE(near(hand(1.0), {0, 1, 0})) << "the slide begins anew";
    EXPECT_TRUE(near(hand(2.5), glm::dvec3(-1, -1, 0) * std::sqrt(2.0)));
    for (const double t : {0.0, 0.3, 1.7, 3.99}) EXPECT_TRUE(near(hand(t), hand(t + 4.0))) << t;
    EXPECT_EQ(poseAt(motion, 0.0), poseAt(motion, 4.0));
    EXPECT_EQ(poseAt(motion, 0.49).weights[2], std::vector<float>{0});
    EXPECT_EQ(poseAt(motion, 0.5).weights[2], std::vector<float>{1});
    EXPECT_EQ(poseAt(motion, 7.2), poseAt(motion, 7.2));
}

TEST(PoseTest, WhatNothingDrivesStays) {
    Motion motion = arm();
    motion.animations.clear();
    EXPECT_EQ(motion.length(), 0.0);
    EXPECT_EQ(poseAt(motion, 0.0), poseAt(motion, 3.3));
    EXPECT_EQ(poseAt(motion, 3.3).weights[2], std::vector<float>{0.5f});
}

TEST(PoseTest, SkinsAreFromMeshToWorldAndKeepTheirDigitsFarAway) {
    Motion motion = arm();
    motion.nodes[0].transform.translation = {1e7, 0, 0};
    const Skin skin{{0, 1}, {glm::mat4(1.0f), glm::translate(glm::mat4(1.0f), {-1, 0, 0})}};
    const SkinPose pose = poseOf(skin, poseAt(motion, 0.0));
    EXPECT_EQ(pose.origin, glm::dvec3(1e7, 0, 0));
    EXPECT_EQ(pose.originFromMesh[0], glm::mat4(1.0f));
    EXPECT_EQ(pose.originFromMesh[1], glm::mat4(1.0f)) << "where it was bound";
    const SkinPose turned = poseOf(skin, poseAt(motion, 1.0));
    // The tip at (1, 0, 0) follows the hand.
    EXPECT_LT(glm::length(glm::vec3(turned.originFromMesh[1] * glm::vec4(1, 0, 0, 1)) - glm::vec3(0, 1, 0)), 1e-6f);
}

}  // namespace
}  // namespace dioptre
