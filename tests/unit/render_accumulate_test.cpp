// What the accumulation decides without a GL: levels of detail, which samples share a rendering, whose sub-samples are
// whose.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "csv_table.hpp"
#include "optics/lens_samples.hpp"
#include "render/accumulate/detail.hpp"
#include "render/accumulate/footprints.hpp"
#include "render/accumulate/sharing.hpp"
#include "render/accumulate/subsamples.hpp"

namespace dioptre {
namespace {

std::vector<LensSample> firstSamples(int count, const Lens& lens = {}) {
    std::vector<LensSample> samples;
    for (int i = 0; i < count; ++i) samples.push_back(lensSample(i, lens));
    return samples;
}

View aView() {
    View view;
    view.width = 640;
    view.height = 480;
    view.near = Metres(0.05);
    view.frustum = {-0.5, 0.5, -0.375, 0.375};
    return view;
}

// Jeong et al. 2013, eq. 3
TEST(DetailTest, LevelsAreThoseOfTheTable) {
    const CsvTable table = testTable("lod_jeong.csv");
    int rows = 0;
    for (std::size_t i = 0; i < table.size(); ++i) {
        if (table.number(i, "s") != 2.0) continue;
        const double coc = table.number(i, "C_area_px2"), triangle = table.number(i, "A_area_px2");
        const bool guard = table.text(i, "L").starts_with("guard");
        EXPECT_NEAR(detailLevel(coc, triangle, 64), guard ? 64.0 : table.number(i, "L"), 1e-12)
            << "C " << coc << ", A " << triangle;
        EXPECT_LE(detailLevel(coc, triangle, 3), 3.0);
        ++rows;
    }
    EXPECT_EQ(rows, 8);
    EXPECT_EQ(detailLevel(0.0, 0.0, 7), 0.0);
    EXPECT_EQ(detailLevel(5.0, std::numeric_limits<double>::infinity(), 7), 0.0);
}

TEST(DetailTest, TheSmallestCircleOfConfusionIsThatOfTheBoxOrNone) {
    const View view = aView();
    const Lens lens{Metres(0.01), Metres(0.05), Dioptres(0.5)};
    const double f = focalLengthPixels(view).x;
    const auto box = [](double nearest, double farthest) {
        return ViewBox{{0.0, 0.0, -0.5 * (nearest + farthest)}, {0.1, 0.1, 0.5 * (farthest - nearest)}};
    };
    EXPECT_EQ(cocExtent(view, lens, box(1.5, 2.5)).smallest, 0.0) << "focus lies in it";
    EXPECT_NEAR(cocExtent(view, lens, box(4.0, 8.0)).smallest, 0.01 * f * 0.25, 1e-9);
    EXPECT_NEAR(cocExtent(view, lens, box(4.0, 8.0)).largest, 0.01 * f * 0.375, 1e-9);
    EXPECT_NEAR(cocExtent(view, lens, box(0.5, 1.0)).smallest, 0.01 * f * 0.5, 1e-9);
    EXPECT_NEAR(cocExtent(view, lens, box(-3.0, 1.0)).largest, 0.01 * f * 19.5, 1e-9) << "cut at the near plane";
    EXPECT_EQ(cocExtent(view, Lens{Metres(0.0), Metres(0.05), Dioptres(0.0)}, box(1.0, 2.0)).largest, 0.0);

    const std::vector<float> exact(9, 0.0f);
    DrawList::Seen seen{0, box(4.0, 8.0), false, 100000, exact};
    const double level = detailLevel(view, lens, seen);
    EXPECT_GT(level, 0.0);
    // Half as many triangles: a level less. A smaller lens: an area's logarithm less.
    seen.triangles = 50000;
    EXPECT_NEAR(detailLevel(view, lens, seen), level - 1.0, 1e-9);
    seen.errors = std::span(exact).first(1);
    EXPECT_EQ(detailLevel(view, lens, seen), 0.0);
    seen.errors = exact;
    seen.box.half = glm::dvec3(9.0);
    EXPECT_EQ(detailLevel(view, lens, seen), 0.0) << "the eye is in it";
}

TEST(DetailTest, ALevelsErrorIsBounded) {
    const std::vector<float> errors{0.0f, 0.1f, 0.3f, 0.3f, 1.1f};
    EXPECT_EQ(levelOfError(errors, 0.0), 0.0);
    EXPECT_NEAR(levelOfError(errors, 0.05), 0.5, 1e-6);
    EXPECT_NEAR(levelOfError(errors, 0.2), 1.5, 1e-6);
    EXPECT_NEAR(levelOfError(errors, 0.5), 3.25, 1e-6);
    EXPECT_EQ(levelOfError(errors, 2.0), 4.0);
    EXPECT_EQ(levelOfError(std::span(errors).first(1), 2.0), 0.0);

    // The same object, coarser levels with errors: not beyond what its blur allows.
    const View view = aView();
    const Lens lens{Metres(0.01), Metres(0.05), Dioptres(0.5)};
    const std::vector<float> growing{0.0f, 0.001f, 0.002f, 0.004f, 0.008f, 1.0f};
    DrawList::Seen seen{0, {{0.0, 0.0, -6.0}, {0.1, 0.1, 2.0}}, false, 100000, growing};
    const double level = detailLevel(view, lens, seen);
    // CoC 0.01 * 640 * 0.25 px = 1.6 px, of that kErrorOfBlur at 4 m: 640 px are 4 m.
    EXPECT_NEAR(level, levelOfError(growing, kErrorOfBlur * 1.6 * 4.0 / 640.0), 1e-9);
    seen.scale = 2.0;
    EXPECT_LT(detailLevel(view, lens, seen), level);
}

TEST(DetailTest, TheFractionOfALevelIsAShareOfTheSamples) {
    for (const int count : {1, 2, 7, 32, 100})
        for (const double level : {0.0, 0.01, 0.5, 1.25, 3.0, 4.99}) {
            double sum = 0.0;
            int before = 0;
            for (int i = 0; i < count; ++i) {
                const int l = levelOfSample(level, i, count);
                EXPECT_GE(l, before) << "the finer ones come first";
                before = l;
                sum += l;
            }
            EXPECT_NEAR(sum / count, level, 1.0 / count) << level << " of " << count;
        }
}

/// Star discrepancy over anchored boxes of the unit square, at the points' own coordinates (a lower bound of it).
double discrepancy(const std::vector<glm::dvec2>& points) {
    double worst = 0.0;
    for (const glm::dvec2& a : points)
        for (const glm::dvec2& b : points) {
            const glm::dvec2 corner(a.x, b.y);
            double inside = 0.0;
            for (const glm::dvec2& p : points) inside += p.x <= corner.x && p.y <= corner.y ? 1.0 : 0.0;
            worst = std::max(worst, std::abs(inside / static_cast<double>(points.size()) - corner.x * corner.y));
        }
    return worst;
}

TEST(DetailTest, BothPartsOfTheSequenceCoverTheLensEvenly) {
    // Random points have about 1/sqrt(n)
    for (const int count : {32, 64, 128})
        for (const double fraction : {0.25, 0.5, 0.75}) {
            std::vector<glm::dvec2> finer, coarser;
            for (int i = 0; i < count; ++i)
                (levelOfSample(fraction, i, count) == 0 ? finer : coarser)
                    .emplace_back(halton(i + 1, 2), halton(i + 1, 7));
            for (const auto& part : {finer, coarser}) {
                const auto n = static_cast<double>(part.size());
                EXPECT_LT(discrepancy(part), (1.0 + 0.9 * std::log(n)) / n + 0.06) << part.size() << " of " << count;
            }
        }
}

TEST(SharingTest, EverySampleHasOneParentNearIt) {
    for (const int count : {1, 3, 8, 32, 200})
        for (const double radius : {0.0, 0.2, 0.499, 1.0, 3.7, 20.0})
            for (const int grid : {1, 2}) {
                SCOPED_TRACE(testing::Message() << count << " samples, " << radius << " px, grid " << grid);
                const std::vector<LensSample> samples = firstSamples(count);
                const SharedRenderings shared = shareRenderings(samples, radius, grid);
                ASSERT_EQ(shared.parentOf.size(), samples.size());
                std::vector<int> children(shared.parents.size());
                std::set<std::pair<double, double>> cells;
                for (std::size_t i = 0; i < samples.size(); ++i) {
                    const auto parent = static_cast<std::size_t>(shared.parentOf[i]);
                    ASSERT_LT(parent, shared.parents.size());
                    ++children[parent];
                    const glm::dvec2 mine = glm::round(samples[i].lens * radius * static_cast<double>(grid));
                    cells.insert({mine.x, mine.y});
                    EXPECT_LE(glm::distance(samples[i].lens, shared.parents[parent].lens) * radius,
                              std::numbers::sqrt2 / grid + 1e-9);
                }
                EXPECT_THAT(children, testing::Each(testing::Ge(1)));
                EXPECT_GE(shared.parents.size(), cells.size());
                EXPECT_GE(shared.parents.size(), std::min(samples.size(), std::size_t{kLeastJitters}) / 2);
                EXPECT_THAT(children, testing::Each(testing::Le((count + kLeastJitters - 1) / kLeastJitters)));
                std::set<std::pair<double, double>> jitters;
                for (const LensSample& parent : shared.parents) jitters.insert({parent.pixel.x, parent.pixel.y});
                EXPECT_EQ(jitters.size(), shared.parents.size());
            }
}

TEST(SharingTest, ParentsShareTheirChildrenEvenly) {
    const SharedRenderings shared = shareRenderings(firstSamples(128), 0.2, 2);
    std::vector<int> children(shared.parents.size());
    for (const int parent : shared.parentOf) ++children[static_cast<std::size_t>(parent)];
    EXPECT_THAT(children, testing::ElementsAreArray(std::vector<int>(kLeastJitters, 128 / kLeastJitters)));
}

TEST(SubsamplesTest, WithTheirPrimariesTheyAreThePrefixOfTheSequence) {
    for (const int blades : {0, 6})
        for (const int count : {1, 5, 32, 64})
            for (const int each : {1, 4, 16}) {
                Lens lens;
                lens.blades = blades;
                const Subsamples subs = subsamples(count, each, lens);
                ASSERT_EQ(subs.first.size(), static_cast<std::size_t>(count) + 1);
                EXPECT_EQ(subs.first.front(), 0);
                EXPECT_EQ(subs.first.back(), count * each);
                const std::vector<LensSample> primaries = firstSamples(count, lens);
                std::vector<glm::dvec2> found;
                double farthest = 0.0;
                for (int i = 0; i < count; ++i)
                    for (int k = subs.first[static_cast<std::size_t>(i)];
                         k < subs.first[static_cast<std::size_t>(i) + 1]; ++k) {
                        const glm::dvec2 offset(subs.offsets[static_cast<std::size_t>(k)]);
                        const glm::dvec2 point = primaries[static_cast<std::size_t>(i)].lens + offset;
                        farthest = std::max(farthest, glm::length(offset));
                        for (const LensSample& other : primaries)
                            EXPECT_GE(glm::distance(other.lens, point), glm::length(offset) - 1e-6);
                        found.push_back(point);
                    }
                EXPECT_NEAR(subs.farthest, farthest, 1e-6);
                for (int i = count; i < count * (each + 1); ++i) {
                    const glm::dvec2 point = lensSample(i, lens).lens;
                    EXPECT_TRUE(std::any_of(found.begin(), found.end(),
                                            [&](const glm::dvec2& p) { return glm::distance(p, point) < 1e-6; }))
                        << "sample " << i << " of " << count << " with " << each;
                }
            }
}

// A spot of one pixel, at all places in a level's texel: their mean over the texel, then the spline.
TEST(FootprintsTest, VarianceIsThatOfTheSplineOverALevel) {
    const auto spline = [](double x) {
        const double a = std::abs(x);
        if (a < 1.0) return 2.0 / 3.0 - a * a + 0.5 * a * a * a;
        return a < 2.0 ? (2.0 - a) * (2.0 - a) * (2.0 - a) / 6.0 : 0.0;
    };
    for (int level = 0; level <= 4; ++level) {
        const int side = 1 << level;
        double light = 0.0, variance = 0.0;
        for (int spot = 0; spot < side; ++spot)
            for (int x = -4 * side; x <= 4 * side; ++x) {
                const double weight = spline((x + 0.5) / side - 0.5) / side;
                light += weight / side;
                variance += weight / side * (x - spot) * (x - spot);
            }
        EXPECT_NEAR(light, 1.0, 1e-9) << level;
        EXPECT_NEAR(variance, splineVariance(level), 1e-9) << level;
    }
}

TEST(FootprintsTest, AreWideWhereBlurOutgrowsThePoints) {
    const View view = aView();
    const auto seenAt = [](double near, double far) {
        DrawList::Seen seen;
        seen.box = {{0.0, 0.0, -0.5 * (near + far)}, {0.1, 0.1, 0.5 * (far - near)}};
        return seen;
    };
    const auto of = [&](double apertureRadius, double focus, double points, const DrawList::Seen& seen) {
        return requiredFootprints(view, {Metres(apertureRadius), Metres(0.017), Dioptres(focus)}, points, {&seen, 1});
    };
    struct Case {
        double radius, focus, near;
        bool wide, inFront;
    };
    // At 72 points from 1.47 px on. f is 640 px: 4 mm are 2.56 px for a dioptre.
    for (const Case& c : {Case{0.0, 1.0, 0.2, false, false},
                          {0.004, 0.5, 2.0, false, false},
                          {0.004, 0.6, 2.0, true, false},
                          {0.004, 0.5, 0.98, false, false},
                          {0.004, 0.5, 0.9, true, true},
                          {0.004, 0.0, 1.8, false, false},
                          {0.004, 0.0, 1.7, true, true},
                          {0.004, -0.6, 1e9, true, true},
                          {0.004, 2.0, 0.01, true, true}}) {
        const Footprints found = of(c.radius, c.focus, 72.0, seenAt(c.near, c.near + 10.0));
        EXPECT_EQ(found.wide, c.wide) << c.radius << " m, " << c.focus << " D, " << c.near << " m";
        EXPECT_EQ(found.inFront, c.inFront) << c.radius << " m, " << c.focus << " D, " << c.near << " m";
        EXPECT_EQ(found.parts(), c.inFront ? 5 : c.wide ? 3 : 1);
        EXPECT_NEAR(found.variance, kFootprint / 72.0, 1e-12);
    }
    EXPECT_EQ(of(0.004, 0.6, 2.0, seenAt(1.0, 2.0)).variance, kMostFootprint);
    View half = view;
    half.width /= 2;
    const DrawList::Seen seen = seenAt(1.0, 2.0);
    const Lens lens{Metres(0.004), Metres(0.017), Dioptres(1.0)};
    EXPECT_NEAR(requiredFootprints(half, lens, 72.0, {&seen, 1}).variance, kFootprint / 72.0, 1e-12);
    View low = view;
    low.height /= 2;
    EXPECT_NEAR(requiredFootprints(low, lens, 72.0, {&seen, 1}).variance, kFootprint / 72.0 / 4.0, 1e-12);
}

TEST(SubsamplesTest, NoneAreAskedForNoneAreThere) {
    const Subsamples subs = subsamples(8, 0, {});
    EXPECT_TRUE(subs.offsets.empty());
    EXPECT_EQ(subs.first.back(), 0);
    EXPECT_EQ(subs.farthest, 0.0);
}

}  // namespace
}  // namespace dioptre
