// What a view requires, and that what it does not require is named with its reason.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "quality/requirements.hpp"

namespace dioptre {
namespace {

ViewFacts seeing(double nearest, double farthest) {
    ViewFacts facts;
    facts.boxes = CocRange{nearest, farthest};
    return facts;
}

bool omits(const Requirements& r, std::string_view what) {
    for (const Omission& o : r.omitted)
        if (o.what == what) return !o.why.empty();
    return false;
}

TEST(RequirementsTest, NothingBeyondHalfAPixelOfDiameterIsAPinholes) {
    const Requirements sharp = require(seeing(-0.25, 0.25));
    EXPECT_FALSE(sharp.blur);
    EXPECT_TRUE(omits(sharp, "blur"));
    for (const auto& [nearest, farthest] : {std::pair(-0.26, 0.0), {0.0, 0.26}, {-30.0, 30.0}, {5.0, 6.0}}) {
        const Requirements r = require(seeing(nearest, farthest));
        EXPECT_TRUE(r.blur) << nearest << " " << farthest;
        EXPECT_FALSE(omits(r, "blur"));
    }
}

TEST(RequirementsTest, NoForegroundWithoutBlurInFront) {
    EXPECT_TRUE(require(seeing(-3.0, 8.0)).foreground);
    EXPECT_FALSE(omits(require(seeing(-3.0, 8.0)), "foreground"));
    const Requirements behind = require(seeing(-0.1, 8.0));
    EXPECT_FALSE(behind.foreground);
    EXPECT_TRUE(behind.blur);
    EXPECT_TRUE(omits(behind, "foreground"));
    EXPECT_DOUBLE_EQ(behind.largestBehind, 8.0);
    EXPECT_DOUBLE_EQ(behind.largestInFront, 0.1);
}

TEST(RequirementsTest, AnEmptyViewRequiresNothing) {
    const Requirements r = require({});
    EXPECT_FALSE(r.blur);
    EXPECT_FALSE(r.foreground);
    EXPECT_TRUE(omits(r, "everything"));
}

TEST(RequirementsTest, CornersOfTheApertureShowInHighlightsAlone) {
    ViewFacts facts = seeing(-3.0, 8.0);
    facts.highlights = true;
    facts.blades = 5;
    EXPECT_TRUE(require(facts).shapedDiscs);
    EXPECT_FALSE(omits(require(facts), "shaped highlights"));
    facts.blades = 0;
    EXPECT_TRUE(omits(require(facts), "shaped highlights"));
    facts.blades = 5;
    facts.highlights = false;
    EXPECT_TRUE(omits(require(facts), "shaped highlights"));
}

TEST(RequirementsTest, OnlyAStillViewMayRefine) {
    ViewFacts facts = seeing(-3.0, 8.0);
    EXPECT_FALSE(require(facts).mayRefine);
    facts.moving = false;
    EXPECT_TRUE(require(facts).mayRefine);
}

TEST(RequirementsTest, RadiiThatAreNoNumbersRequireBlur) {
    const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
    for (const auto& [nearest, farthest] : {std::pair(-infinity, 1.0), {0.0, infinity}, {nan, nan}}) {
        const Requirements r = require(seeing(nearest, farthest));
        EXPECT_TRUE(r.blur);
        EXPECT_TRUE(std::isfinite(r.largestBehind) && std::isfinite(r.largestInFront));
    }
}

TEST(RequirementsTest, RangeIsThatOfTheLens) {
    const Lens lens{Metres(0.002), Metres(0.017), Dioptres(1.0)};
    const CocRange range = cocRange(lens, 600.0, Dioptres(4.0), Dioptres(0.0));
    EXPECT_NEAR(range.nearest, 0.002 * 600.0 * (1.0 - 4.0), 1e-9);
    EXPECT_NEAR(range.farthest, 0.002 * 600.0, 1e-9);
    const CocRange turned = cocRange(lens, 600.0, Dioptres(0.0), Dioptres(4.0));
    EXPECT_EQ(turned.nearest, range.nearest);
    EXPECT_EQ(turned.farthest, range.farthest);
}

TEST(RequirementsTest, StatisticsOfAHistogram) {
    const CocBin bins[] = {{-10.0, -8.0, 10.0}, {-0.2, 0.2, 30.0}, {3.0, 5.0, 60.0}, {90.0, 100.0, 0.0}};
    const PixelStatistics s = pixelStatistics(bins);
    EXPECT_DOUBLE_EQ(s.inFront, 0.1);
    EXPECT_DOUBLE_EQ(s.behind, 0.6);
    EXPECT_DOUBLE_EQ(s.meanDiameter, 2.0 * (0.1 * 9.0 + 0.6 * 4.0));
    EXPECT_DOUBLE_EQ(s.largestDiameter, 20.0);
    EXPECT_EQ(pixelStatistics({}).range, std::nullopt);
    EXPECT_EQ(pixelStatistics({}).meanDiameter, 0.0);
}

TEST(RequirementsTest, TheClassIsOfPixelsWhereTheyAreKnown) {
    ViewFacts facts = seeing(-10.0, 30.0);
    const ViewClass byBoxes = classOf(facts, 1000.0, 640.0 * 480.0, 2);
    EXPECT_DOUBLE_EQ(byBoxes.largestCocPx, 60.0);
    EXPECT_DOUBLE_EQ(byBoxes.meanCocPx, 25.0);  // of |c| evenly over -10..30: 12.5 px of radius
    EXPECT_DOUBLE_EQ(byBoxes.behindShare, 0.75);
    EXPECT_EQ(byBoxes.eyes, 2);
    const ViewClass behind = classOf(seeing(5.0, 30.0), 1.0, 1.0, 1),
                    front = classOf(seeing(-30.0, -30.0), 1.0, 1.0, 1);
    EXPECT_DOUBLE_EQ(behind.meanCocPx, 35.0);
    EXPECT_DOUBLE_EQ(behind.behindShare, 1.0);
    EXPECT_DOUBLE_EQ(front.meanCocPx, 60.0);
    const CocBin bins[] = {{-2.0, -2.0, 1.0}, {4.0, 4.0, 3.0}};
    facts.pixels = pixelStatistics(bins);
    const ViewClass byPixels = classOf(facts, 1000.0, 640.0 * 480.0, 2);
    EXPECT_DOUBLE_EQ(byPixels.largestCocPx, 8.0);
    EXPECT_DOUBLE_EQ(byPixels.meanCocPx, 7.0);
    EXPECT_DOUBLE_EQ(byPixels.behindShare, 0.75);
}

TEST(RequirementsTest, ThePyramidIsAsDeepAsTheBlur) {
    EXPECT_EQ(pyramidLevels(0.0, false, 9), 2);
    EXPECT_EQ(pyramidLevels(3.0, true, 9), 9);
    EXPECT_EQ(pyramidLevels(std::numeric_limits<double>::infinity(), false, 9), 9);
    for (double radius = 1.0; radius < 500.0; radius *= 1.1)
        EXPECT_LE(pyramidLevels(radius, false, 9), pyramidLevels(1.1 * radius, false, 9)) << radius;
    EXPECT_GT(pyramidLevels(100.0, false, 9), 3);
}

}  // namespace
}  // namespace dioptre
