// The arithmetic that the mipmap technique's shaders share with C++, against the paper's equations in double precision.
#include <gtest/gtest.h>

#include <array>
#include <sstream>

#include "shaders/shared/mipmap.h"
#include "unit/csv_table.hpp"

namespace dioptre {
namespace {

using namespace mipmap;

// Lee, Kim, Choi 2009, eq. 6
TEST(MipmapTest, LevelForSigmaMatchesThePaper) {
    const CsvTable table = testTable("mipmap_level.csv");
    for (std::size_t row = 0; row < table.size(); ++row) {
        const auto sigma = static_cast<float>(table.number(row, "sigma_Lee=C/2"));
        EXPECT_NEAR(levelForSigma(sigma), table.number(row, "m"), 2e-6 * std::max(1.0, table.number(row, "m")))
            << table.describe(row);
    }
}

std::array<double, 9> nine(const std::string& text) {
    std::array<double, 9> values{};
    std::istringstream in(text);
    for (double& value : values) in >> value;
    return values;
}

// Eq. 9 and 10 on the paper's cases. With sigma = C/2, C a diameter, sigma is the radius here. What the layers give,
// foreground over base or back, must be what eq. 9's kernel gives.
TEST(MipmapTest, LayersGiveThePapersAnisotropicKernel) {
    const CsvTable table = testTable("anisotropic_kernel.csv");
    constexpr std::array<double, 9> kGauss{1, 2, 1, 2, 4, 2, 1, 2, 1};
    for (std::size_t row = 0; row < table.size(); ++row) {
        const auto colors = nine(table.text(row, "I_3x3_rowmajor"));
        const auto sigmas = nine(table.text(row, "sigma_3x3"));
        const auto depths = nine(table.text(row, "Z_3x3"));
        const double focus = table.number(row, "Zf");
        double base = 0.0, baseWeights = 0.0, front = 0.0, coverage = 0.0, back = 0.0, rho = 0.0;
        const auto mine = static_cast<float>(depths[4] < focus ? sigmas[4] : 0.0);
        for (std::size_t i = 0; i < 9; ++i) {
            const auto radius = static_cast<float>(sigmas[i]);
            const double share = frontShare(depths[i] < focus ? -radius : radius);
            const double weight = (1.0 - share) * baseWeight(radius, 10.0f);
            base += kGauss[i] * weight * colors[i];
            baseWeights += kGauss[i] * weight;
            front += kGauss[i] * share * colors[i] / 16.0;
            coverage += kGauss[i] * share / 16.0;
            back += kGauss[i] * (1.0 - share) * colors[i] / 16.0;
            if (share > 0.0 && depths[i] < depths[4] && spreadsOver(radius, mine)) rho = std::max(rho, sigmas[i]);
        }
        const bool behind = depths[4] > focus;
        const double rest = coverage < 1.0 ? back / (1.0 - coverage) : 0.0;
        const double value = behind ? base / baseWeights : front + (1.0 - coverage) * rest;
        // The cut of eq. 9 is a slope here: where it lets a slightly sharper neighbour in wholly, this gives it 0.8.
        const double tolerance = table.text(row, "case") == "delta_allows_similar" ? 0.06 : 1e-6;
        EXPECT_NEAR(value, table.number(row, "anisotropic_value"), tolerance) << table.describe(row);
        EXPECT_EQ(rho, table.number(row, "rho_eq10")) << table.describe(row);
    }
}

TEST(MipmapTest, TapsAndCircleHaveTheDiscsVariance) {
    for (float radius = 3.0f; radius < 300.0f; radius *= 1.07f) {
        const float level = tapLevel(radius);
        const float circle = 2.0f * tapCircle(radius, level);  // px
        const float tap = level > 0.5f ? kTapVariance * 4.0f * std::exp2(2.0f * level) : kTapVarianceFirst;
        EXPECT_NEAR(circle * circle * kPatternMoment + tap + kUpsampleVariance, 0.25f * radius * radius,
                    1e-4f * radius * radius)
            << "radius " << radius << " level " << level;
    }
}

TEST(MipmapTest, SharesRunFromNoneToAllWithoutAStep) {
    EXPECT_EQ(frontShare(0.0f), 0.0f);
    EXPECT_EQ(frontShare(50.0f), 0.0f);
    EXPECT_EQ(frontShare(-kFrontComplete), 1.0f);
    EXPECT_EQ(baseWeight(kSharpRadius, 20.0f), 0.0f) << "in focus nothing may leak";
    EXPECT_EQ(blurShare(0.0f), 0.0f);
    EXPECT_EQ(blurShare(-40.0f), 1.0f);
    for (float c = 0.0f; c < 4.0f; c += 0.01f) {
        EXPECT_LT(frontShare(-c - 0.01f) - frontShare(-c), 0.02f) << c;
        EXPECT_LT(blurShare(c + 0.01f) - blurShare(c), 0.02f) << c;
    }
    for (const float radius : {1.0f, 7.0f, 19.0f})
        EXPECT_NEAR(radiusOfBaseWeight(baseWeight(radius, 20.0f), 20.0f), radius, 1e-5f);
}

}  // namespace
}  // namespace dioptre
