#include "focus/stereo_rig.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "core/error.hpp"

namespace dioptre {
namespace {

View headView() {
    View view;
    view.frustum = symmetricFrustum(Radians(0.9), 1.6);
    view.width = 1280;
    view.height = 800;
    return view;
}

glm::dvec2 pixelOf(const View& view, const glm::dvec3& world) {
    const glm::dvec4 clip = clipFromView(view) * viewFromWorld(view.pose) * glm::dvec4(world, 1.0);
    return {(clip.x / clip.w + 1.0) * 0.5 * view.width, (1.0 - clip.y / clip.w) * 0.5 * view.height};
}

bool sameBits(const View& a, const View& b) {
    // NOLINTBEGIN(bugprone-suspicious-memory-comparison): bits are what is asked for
    return std::memcmp(&a.pose.position, &b.pose.position, sizeof a.pose.position) == 0 &&
           std::memcmp(&a.pose.orientation, &b.pose.orientation, sizeof a.pose.orientation) == 0 &&
           std::memcmp(&a.frustum, &b.frustum, sizeof a.frustum) == 0 && a.near == b.near && a.width == b.width &&
           a.height == b.height;
    // NOLINTEND(bugprone-suspicious-memory-comparison)
}

TEST(StereoRigTest, IpdZeroIsIdenticalToTheBit) {
    View head = headView();
    head.pose.position = {-0.0, 0.0, 1e-310};  // signed zero and a denormal survive
    head.pose.orientation = glm::angleAxis(1.1, glm::normalize(glm::dvec3(1.0, -2.0, 0.5)));
    for (const auto& screen :
         {std::optional<ScreenGeometry>(), std::optional(ScreenGeometry{Metres(0.5), Metres(0.8)})}) {
        const View left = eyeView(Eye::left, head, Metres(0.0), screen);
        EXPECT_TRUE(sameBits(left, eyeView(Eye::right, head, Metres(0.0), screen)));
        EXPECT_TRUE(sameBits(left, eyeView(Eye::centre, head, Metres(0.0), screen)));
    }
    EXPECT_TRUE(sameBits(eyeView(Eye::left, head, Metres(0.0)), head));
    EXPECT_TRUE(sameBits(eyeView(Eye::centre, head, Metres(0.064)), head));
}

TEST(StereoRigTest, DisparityIsIpdTimesFocalLengthTimesVergence) {
    const View head = headView();
    for (const double ipd : {0.0, 0.063, 0.2}) {
        const View left = eyeView(Eye::left, head, Metres(ipd)), right = eyeView(Eye::right, head, Metres(ipd));
        for (const double d : {0.3, 1.0, 20.0, 1e9}) {
            const glm::dvec3 point(0.1 * d, -0.2 * d, -d);
            const glm::dvec2 disparity = pixelOf(left, point) - pixelOf(right, point);
            EXPECT_NEAR(disparity.x, ipd * focalLengthPixels(head).x / d, 1e-9) << "ipd " << ipd << " distance " << d;
            EXPECT_NEAR(disparity.y, 0.0, 1e-9);
        }
    }
}

TEST(StereoRigTest, EyesMoveAlongTheHeadsOwnX) {
    View head = headView();
    head.pose.position = {1.0, 2.0, 3.0};
    head.pose.orientation = glm::angleAxis(std::acos(0.0), glm::dvec3(0.0, 1.0, 0.0));  // x becomes -z
    const View left = eyeView(Eye::left, head, Metres(0.06));
    EXPECT_NEAR(glm::length(left.pose.position - glm::dvec3(1.0, 2.0, 3.03)), 0.0, 1e-15);
    EXPECT_EQ(left.pose.orientation, head.pose.orientation);
}

TEST(StereoRigTest, ScreenIsAWindow) {
    View head = headView();
    head.pose.position = {0.3, 1.5, -2.0};
    head.pose.orientation = glm::angleAxis(0.4, glm::normalize(glm::dvec3(0.2, 1.0, 0.1)));
    const ScreenGeometry screen{Metres(0.6), Metres(0.75)};
    const Metres ipd(0.065);
    const auto world = [&](double x, double y, double d) {
        return head.pose.position + head.pose.orientation * glm::dvec3(x, y, -d);
    };
    for (const Eye eye : {Eye::left, Eye::right, Eye::centre}) {
        const View view = eyeView(eye, head, ipd, screen);
        validate(view);
        // The window's corners are the picture's corners for every eye: no disparity in its plane.
        const double halfHeight = 0.3 / 1.6;
        EXPECT_NEAR(glm::length(pixelOf(view, world(-0.3, halfHeight, 0.75))), 0.0, 1e-9);
        EXPECT_NEAR(glm::length(pixelOf(view, world(0.3, -halfHeight, 0.75)) - glm::dvec2(1280, 800)), 0.0, 1e-9);
    }
    // Infinity is one IPD apart on the screen, the right eye's to the right.
    const View left = eyeView(Eye::left, head, ipd, screen), right = eyeView(Eye::right, head, ipd, screen);
    const glm::dvec3 far = world(0.0, 0.0, 1e9);
    EXPECT_NEAR((pixelOf(right, far).x - pixelOf(left, far).x) * 0.6 / 1280.0, 0.065, 1e-9);
    EXPECT_GT(left.frustum.right, -left.frustum.left);
    EXPECT_DOUBLE_EQ(left.frustum.right, -right.frustum.left);
}

TEST(StereoRigTest, RefusesImpossibleLengths) {
    const View head = headView();
    EXPECT_THROW(eyeView(Eye::left, head, Metres(-0.001)), InputError);
    EXPECT_THROW(eyeView(Eye::left, head, Metres(std::nan(""))), InputError);
    EXPECT_THROW(eyeView(Eye::left, head, Metres(0.06), ScreenGeometry{Metres(0.0), Metres(1.0)}), InputError);
    EXPECT_THROW(eyeView(Eye::left, head, Metres(0.06), ScreenGeometry{Metres(1.0), Metres(-1.0)}), InputError);
}

}  // namespace
}  // namespace dioptre
