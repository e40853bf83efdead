#include "viewer/sharp_range.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "quality/requirements.hpp"

namespace dioptre {
namespace {

TEST(SharpRangeTest, AtItsEndsTheCircleOfConfusionIsJustSeen) {
    for (const double focus : {0.0, 0.5, 3.0})
        for (const double radius : {0.5e-3, 2e-3}) {
            Lens lens;
            lens.apertureRadius = Metres(radius);
            lens.focus = Dioptres(focus);
            const SharpRange range = sharpRange(lens, 800.0);
            EXPECT_NEAR(cocRadiusPixels(lens, 800.0, range.farthest), 0.5 * kSharpDiameter, 1e-9);
            EXPECT_NEAR(cocRadiusPixels(lens, 800.0, range.nearest), -0.5 * kSharpDiameter, 1e-9);
        }
}

TEST(SharpRangeTest, ThroughAPinholeAllIsSharp) {
    Lens lens;
    lens.focus = Dioptres(1.0);
    EXPECT_TRUE(std::isinf(sharpRange(lens, 800.0).nearest.value));
}

TEST(ScreenDisparityTest, IsTheAngleFromTheScreen) {
    const Metres ipd(0.063), screen(0.5);
    EXPECT_EQ(screenDisparity(ipd, screen, Dioptres(2.0)).value, 0.0);
    // To infinity and to half the distance: 63 mm before 0.5 m is 7.2 degrees
    EXPECT_NEAR(screenDisparity(ipd, screen, Dioptres(0.0)).value * 180.0 / std::numbers::pi, -7.2, 0.05);
    EXPECT_GT(screenDisparity(ipd, screen, Dioptres(4.0)).value, 0.0);
}

}  // namespace
}  // namespace dioptre
