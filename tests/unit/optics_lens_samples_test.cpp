#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "optics/lens_samples.hpp"

namespace dioptre {
namespace {

TEST(LensSamplesTest, HaltonIsTheRadicalInverse) {
    EXPECT_EQ(halton(1, 2), 0.5);
    EXPECT_EQ(halton(6, 2), 0.375);  // 110 -> 0.011
    EXPECT_NEAR(halton(1, 7), 1.0 / 7.0, 1e-15);
    EXPECT_NEAR(halton(50, 7), 1.0 / 7.0 + 1.0 / 343.0, 1e-15);  // 101 in base 7
}

TEST(LensSamplesTest, MapsKeepAreasAndStayInside) {
    constexpr int kCount = 4096;
    for (const int blades : {0, 3, 5, 6, 8}) {
        const Radians rotation(0.3);
        int inner = 0;
        glm::dvec2 mean(0.0);
        double second = 0.0;
        for (int i = 1; i <= kCount; ++i) {
            const glm::dvec2 square(halton(i, 2), halton(i, 7));
            const glm::dvec2 p = blades ? polygon(square, blades, rotation) : concentricDisc(square);
            ASSERT_LE(glm::length(p), 1.0 + 1e-12) << blades << " blades, " << i;
            inner += glm::length(p) < 0.4 ? 1 : 0;
            mean += p / double{kCount};
            second += glm::dot(p, p) / kCount;
        }
        const double n = blades, pi = std::numbers::pi;
        const double area = blades ? 0.5 * n * std::sin(2.0 * pi / n) : pi;
        EXPECT_NEAR(inner / double{kCount}, 0.16 * pi / area, 0.01) << blades;
        EXPECT_NEAR(glm::length(mean), 0.0, 0.01) << blades;
        // Mean of r²: 1/2 of a disc, (2 + cos(2 pi/n)) / 6 of a polygon with circumradius 1
        EXPECT_NEAR(second, blades ? (2.0 + std::cos(2.0 * pi / n)) / 6.0 : 0.5, 0.005) << blades;
    }
}

// A point in focus does not move, any other by its circle of confusion times the lens point, p - c(D) v.
TEST(LensSamplesTest, ProjectionThroughALensPointShiftsByTheCircleOfConfusion) {
    View view;
    view.width = 640;
    view.height = 360;
    view.near = Metres(0.05);
    view.frustum = {-0.5, 0.7, -0.3, 0.35};  // off-axis
    const Lens lens{Metres(0.01), Metres(0.05), Dioptres(0.5)};
    const LensSample sample{{0.3, -0.8}, {0.25, -0.4}};
    const glm::dvec2 size(view.width, view.height);
    for (const double d : {0.2, 1.0, 2.0, 7.0, 1e6}) {
        const glm::dvec4 point(0.1 * d, -0.05 * d, -d, 1.0);
        const auto pixel = [&](const glm::dmat4& clip) {
            const glm::dvec4 c = clip * point;
            return glm::dvec2(c) / c.w * 0.5 * size;
        };
        const glm::dvec2 shift = pixel(clipFromView(view, lens, sample)) - pixel(clipFromView(view));
        const glm::dvec2 f = focalLengthPixels(view);
        for (int axis = 0; axis < 2; ++axis) {
            const double c = cocRadiusPixels(lens, f[axis], Dioptres(1.0 / d));
            EXPECT_NEAR(shift[axis], c * sample.lens[axis] + sample.pixel[axis], 1e-9) << "d " << d << " axis " << axis;
        }
        // Depth is untouched.
        const glm::dvec4 through = clipFromView(view, lens, sample) * point;
        EXPECT_EQ(through.z / through.w, view.near.value / d) << d;
    }
}

TEST(LensSamplesTest, PrefixesNest) {
    const Lens lens;
    for (int i = 0; i < 20; ++i) EXPECT_EQ(lensSample(i, lens).lens, lensSample(i, lens).lens);
    EXPECT_NE(lensSample(0, lens).lens, lensSample(1, lens).lens);
    // The jitter stays in its pixel and is balanced.
    glm::dvec2 mean(0.0);
    for (int i = 0; i < 900; ++i) {
        const glm::dvec2 pixel = lensSample(i, lens).pixel;
        ASSERT_LE(std::max(std::abs(pixel.x), std::abs(pixel.y)), 0.5);
        mean += pixel / 900.0;
    }
    EXPECT_NEAR(glm::length(mean), 0.0, 0.01);
}

}  // namespace
}  // namespace dioptre
