#include "optics/view.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"

namespace dioptre {
namespace {

View someView() {
    View view;
    view.pose.position = {1.0, 2.0, 3.0};
    view.pose.orientation = glm::angleAxis(0.7, glm::normalize(glm::dvec3(0.3, 1.0, -0.2)));
    view.frustum = {-0.9, 1.3, -0.4, 0.7};
    view.near = Metres(0.05);
    view.width = 640;
    view.height = 480;
    return view;
}

TEST(ViewTest, PosesInvert) {
    const Pose pose = someView().pose;
    const glm::dmat4 product = viewFromWorld(pose) * worldFromView(pose);
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row) EXPECT_NEAR(product[column][row], column == row ? 1.0 : 0.0, 1e-14);
    const glm::dvec4 ahead =
        viewFromWorld(pose) * glm::dvec4(pose.position + pose.orientation * glm::dvec3(0, 0, -2), 1);
    EXPECT_NEAR(glm::length(glm::dvec3(ahead) - glm::dvec3(0, 0, -2)), 0.0, 1e-14);
}

TEST(ViewTest, DepthIsNearOverDistance) {
    const View view = someView();
    const glm::dmat4 clip = clipFromView(view);
    for (const double d : {0.05, 0.1, 1.0, 3.7, 1e6}) {
        const glm::dvec4 p = clip * glm::dvec4(0.3 * d, -0.2 * d, -d, 1.0);
        EXPECT_DOUBLE_EQ(p.w, d);
        EXPECT_DOUBLE_EQ(p.z / p.w, view.near.value / d);
    }
    const glm::dvec4 direction = clip * glm::dvec4(0.0, 0.0, -1.0, 0.0);  // infinitely far
    EXPECT_EQ(direction.z / direction.w, 0.0);
}

TEST(ViewTest, FrustumEdgesMeetThePicturesEdges) {
    const View view = someView();
    const glm::dmat4 clip = clipFromView(view);
    const auto ndc = [&](double x, double y) {
        const glm::dvec4 p = clip * glm::dvec4(2.0 * x, 2.0 * y, -2.0, 1.0);
        return glm::dvec2(p) / p.w;
    };
    const Frustum& f = view.frustum;
    EXPECT_NEAR(ndc(f.left, f.bottom).x, -1.0, 1e-15);
    EXPECT_NEAR(ndc(f.left, f.bottom).y, -1.0, 1e-15);
    EXPECT_NEAR(ndc(f.right, f.top).x, 1.0, 1e-15);
    EXPECT_NEAR(ndc(f.right, f.top).y, 1.0, 1e-15);
}

TEST(ViewTest, FocalLengthInPixels) {
    View view = someView();
    const glm::dmat4 clip = clipFromView(view);
    EXPECT_DOUBLE_EQ(focalLengthPixels(view).x, clip[0][0] * view.width / 2.0);
    EXPECT_DOUBLE_EQ(focalLengthPixels(view).y, clip[1][1] * view.height / 2.0);
    // 1832 pixels across 100 degrees (vectors: eye_blur.csv)
    const double halfWidth = std::tan(50.0 * std::numbers::pi / 180.0);
    view.frustum = {-halfWidth, halfWidth, -halfWidth, halfWidth};
    view.width = 1832;
    EXPECT_NEAR(focalLengthPixels(view).x, 768.6152621583884, 1e-9);
}

TEST(ViewTest, SymmetricFrustum) {
    const Frustum f = symmetricFrustum(Radians(std::numbers::pi / 2.0), 1.5);
    EXPECT_NEAR(f.top, 1.0, 1e-15);
    EXPECT_NEAR(f.right, 1.5, 1e-15);
    EXPECT_EQ(f.left, -f.right);
    EXPECT_EQ(f.bottom, -f.top);
    EXPECT_THROW(symmetricFrustum(Radians(0.0), 1.0), InputError);
    EXPECT_THROW(symmetricFrustum(Radians(std::numbers::pi), 1.0), InputError);
    EXPECT_THROW(symmetricFrustum(Radians(std::nan("")), 1.0), InputError);
    EXPECT_THROW(symmetricFrustum(Radians(1.0), 0.0), InputError);
}

TEST(ViewTest, ValidateRefuses) {
    EXPECT_NO_THROW(validate(someView()));
    const auto refuses = [](auto change) {
        View view = someView();
        change(view);
        EXPECT_THROW(validate(view), InputError);
    };
    refuses([](View& v) { v.near = Metres(0.0); });
    refuses([](View& v) { v.near = Metres(std::nan("")); });
    refuses([](View& v) { v.width = 0; });
    refuses([](View& v) { v.height = -1; });
    refuses([](View& v) { v.frustum.left = v.frustum.right; });
    refuses([](View& v) { v.frustum.top = std::nan(""); });
    refuses([](View& v) { v.pose.position.y = std::nan(""); });
    refuses([](View& v) { v.pose.orientation = glm::dquat(0.0, 0.0, 0.0, 0.0); });
}

}  // namespace
}  // namespace dioptre
