#include "viewer/navigation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "viewer/monitor.hpp"

namespace dioptre {
namespace {

constexpr double kRight = std::numbers::pi / 2.0;  // a right angle

glm::dvec3 forward(const Pose& pose) {
    return pose.orientation * glm::dvec3(0.0, 0.0, -1.0);
}
glm::dvec3 pivot(const Stance& stance) {
    return stance.pose.position + forward(stance.pose) * stance.pivot.value;
}
/// Tangents of a point of the world in the picture.
glm::dvec2 seen(const Pose& pose, const glm::dvec3& point) {
    const glm::dvec3 p = glm::conjugate(pose.orientation) * (point - pose.position);
    return glm::dvec2(p) / -p.z;
}
void expectNear(const glm::dvec3& a, const glm::dvec3& b, double tolerance = 1e-12) {
    EXPECT_LT(glm::distance(a, b), tolerance)
        << a.x << "," << a.y << "," << a.z << " and " << b.x << "," << b.y << "," << b.z;
}

/// Some places, with and without roll.
std::vector<Stance> stances() {
    const auto turned = [](double yaw, double pitch, double roll) {
        return glm::angleAxis(yaw, glm::dvec3(0.0, 1.0, 0.0)) * glm::angleAxis(pitch, glm::dvec3(1.0, 0.0, 0.0)) *
               glm::angleAxis(roll, glm::dvec3(0.0, 0.0, 1.0));
    };
    return {{{}, Metres(1.0)},
            {{{1.0, -2.0, 3.0}, turned(0.7, 0.3, 0.0)}, Metres(0.4)},
            {{{0.0, 5.0, 0.0}, turned(-2.0, -1.2, 0.0)}, Metres(30.0)},
            {{{-1.0, 0.0, 0.1}, turned(3.0, 0.1, 0.2)}, Metres(2.0)}};
}

TEST(NavigationTest, LookingTurnsToWhereItSays) {
    expectNear(forward(look({}, {kRight, 0.0}).pose), {1.0, 0.0, 0.0});
    expectNear(forward(look({}, {0.0, kRight / 2.0}).pose), {0.0, std::sqrt(0.5), -std::sqrt(0.5)});
    for (const Stance& stance : stances()) {
        const Stance turned = look(stance, {0.3, -0.1});
        EXPECT_EQ(turned.pose.position, stance.pose.position);
        EXPECT_NEAR(glm::length(turned.pose.orientation), 1.0, 1e-12);
    }
}

TEST(NavigationTest, OrbitingKeepsThePivotInThePicture) {
    for (const Stance& stance : stances())
        for (const Turn& turn : {Turn{0.5, 0.0}, Turn{0.0, 0.4}, Turn{-3.0, -0.2}, Turn{0.0, 9.0}}) {
            const Stance turned = orbit(stance, turn);
            expectNear(pivot(turned), pivot(stance), 1e-10);
            EXPECT_EQ(turned.pivot, stance.pivot);
        }
    // To the right of what is looked at, the view turned to the left
    expectNear(orbit({{}, Metres(2.0)}, {-kRight, 0.0}).pose.position, {2.0, 0.0, -2.0});
}

TEST(NavigationTest, TheHeadNeverTipsOver) {
    for (Stance stance : stances())
        for (int i = 0; i < 500; ++i) {
            stance = i % 2 ? orbit(stance, {0.01, 0.1}) : look(stance, {0.02, 0.1});
            ASSERT_LE(forward(stance.pose).y, std::sin(glm::radians(89.0)) + 1e-9) << i;
            ASSERT_NEAR(glm::length(stance.pose.orientation), 1.0, 1e-9) << i;
        }
}

TEST(NavigationTest, AViewThatBeginsSteepComesBackAlone) {
    const Stance down{{{}, glm::angleAxis(-kRight, glm::dvec3(1.0, 0.0, 0.0))}, Metres(1.0)};
    expectNear(forward(look(down, {0.0, -0.5}).pose), {0.0, -1.0, 0.0}, 1e-7);
    EXPECT_GT(forward(look(down, {0.0, 0.5}).pose).y, -0.9);
}

TEST(NavigationTest, PanningMovesThePivotsDepthInThePicture) {
    const glm::dvec2 by(0.25, -0.125);
    for (const Stance& stance : stances()) {
        const glm::dvec3 point = pivot(stance) + stance.pose.orientation * glm::dvec3(0.1, 0.2, 0.0);
        const glm::dvec2 moved = seen(pan(stance, by).pose, point) - seen(stance.pose, point);
        EXPECT_LT(glm::distance(moved, by), 1e-9);
        EXPECT_EQ(pan(stance, by).pose.orientation, stance.pose.orientation);
    }
}

TEST(NavigationTest, ZoomingNearsThePivotAndNeverReachesIt) {
    for (const Stance& stance : stances()) {
        const Stance near = zoom(stance, 200.0);
        EXPECT_GT(near.pivot.value, 0.0);
        expectNear(pivot(near), pivot(stance), 1e-9);
        const Stance back = zoom(zoom(stance, 3.0), -3.0);
        expectNear(back.pose.position, stance.pose.position, 1e-9);
        EXPECT_NEAR(zoom(stance, 1.0).pivot / stance.pivot, 0.9, 1e-12);
    }
}

TEST(NavigationTest, FlyingGoesAlongTheHeadsOwnAxes) {
    const Stance right = look({}, {kRight, 0.0});
    expectNear(fly(right, {0.0, 0.0, -2.0}).pose.position, {2.0, 0.0, 0.0});
    expectNear(fly(right, {1.0, 0.5, 0.0}).pose.position, {0.0, 0.5, 1.0});
}

TEST(NavigationTest, ThePivotIsWhatIsInFocusWithinTheScene) {
    Bounds box;
    box.add(glm::vec3(-3.0f, 0.0f, 0.0f));
    box.add(glm::vec3(3.0f, 0.0f, 8.0f));  // a radius of 5 m
    EXPECT_DOUBLE_EQ(pivotAt(Dioptres(2.0), box).value, 0.5);
    EXPECT_DOUBLE_EQ(pivotAt(Dioptres(0.0), box).value, 10.0);
    EXPECT_DOUBLE_EQ(pivotAt(Dioptres(-1.0), box).value, 10.0);
    EXPECT_NEAR(pivotAt(Dioptres(1e9), box).value, 0.005, 1e-9);
    EXPECT_DOUBLE_EQ(pivotAt(Dioptres(0.0), Bounds()).value, 2.0);
    EXPECT_DOUBLE_EQ(flyingSpeed(box), 1.5);
    EXPECT_DOUBLE_EQ(flyingSpeed(Bounds()), 0.5);
}

const std::vector<Monitor> kTwo = {{"DP-1", {0, 0, 1000, 800}}, {"HDMI-1", {1000, 0, 2000, 1200}}};

TEST(MonitorTest, IsTheOneThatShowsMostOfTheWindow) {
    EXPECT_EQ(monitorOf({100, 100, 640, 480}, kTwo), 0u);
    EXPECT_EQ(monitorOf({900, 100, 640, 480}, kTwo), 1u);
    EXPECT_EQ(monitorOf({500, 100, 640, 480}, kTwo), 0u);
    EXPECT_EQ(monitorOf({-5000, 0, 640, 480}, kTwo), 0u) << "on none";
    EXPECT_EQ(monitorOf({0, 0, 1, 1}, {}), 0u);
}

TEST(MonitorTest, IsFoundByNameOrNumber) {
    EXPECT_EQ(findMonitor("HDMI-1", kTwo), 1u);
    EXPECT_EQ(findMonitor("1", kTwo), 0u);
    EXPECT_EQ(findMonitor("2", kTwo), 1u);
    for (const char* missing : {"", "0", "3", "-1", "HDMI", "99999999999999999999"})
        EXPECT_EQ(findMonitor(missing, kTwo), std::nullopt) << missing;
    EXPECT_EQ(monitorList(kTwo), "1 DP-1, 2 HDMI-1");
}

}  // namespace
}  // namespace dioptre
