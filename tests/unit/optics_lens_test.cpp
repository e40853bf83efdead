#include "optics/lens.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "core/error.hpp"
#include "csv_table.hpp"

namespace dioptre {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Lens lensOf(double apertureRadius, double focalLength, double focusDistance) {
    return {Metres(apertureRadius), Metres(focalLength), vergence(Metres(focusDistance))};
}

TEST(LensTest, CocAgreesWithExactArithmetic) {
    const CsvTable table = testTable("optics_coc.csv");
    for (std::size_t row = 0; row < table.size(); ++row) {
        SCOPED_TRACE(table.describe(row));
        const double focusDistance = table.number(row, "df_m");
        const Lens lens = lensOf(table.number(row, "E_radius_m"), table.number(row, "F_m"), focusDistance);
        const Dioptres object = vergence(Metres(table.number(row, "d_m")));
        validate(lens);
        const auto expectNear = [](double value, double expected, double relative) {
            EXPECT_NEAR(value, expected, relative * std::abs(expected) + 1e-18);
        };
        // Where the difference of two vergences is 1e-6 of them, a double keeps ten digits of it.
        expectNear(imageDistance(lens).value, table.number(row, "uf_m"), 1e-9);
        expectNear(cocRadiusOnImage(lens, object).value, table.number(row, "c_signed_radius_m"), 1e-9);
        expectNear(2.0 * std::abs(cocRadiusOnImage(lens, object).value), table.number(row, "c_diameter_m"), 1e-9);
        expectNear(cocRadiusPixels(lens, 1.0, object), table.number(row, "tan_ang_radius"), 1e-9);
    }
}

TEST(LensTest, FloatMultiplyAddStaysWithinOneUlpOfVergence) {
    const CsvTable table = testTable("optics_coc_float32.csv");
    constexpr double kFocalLengthPixels = 1000.0;
    const Metres near(0.01);
    for (std::size_t row = 0; row < table.size(); ++row) {
        SCOPED_TRACE(table.describe(row));
        const Lens lens =
            lensOf(table.number(row, "E_radius_m"), static_cast<double>(static_cast<float>(table.number(row, "F_m"))),
                   static_cast<double>(static_cast<float>(table.number(row, "df_m"))));
        const double distance = static_cast<double>(static_cast<float>(table.number(row, "d_m")));
        const double exact =
            table.number(row, "exact_of_f32_inputs_m") / imageDistance(lens).value * kFocalLengthPixels;
        const float depth = static_cast<float>(near.value / distance);
        const float coc = cocFromDepth(lens, kFocalLengthPixels, near).radius(depth);
        // Scale, depth and bias are each rounded: half an ulp of the larger product, thrice, and the sum's.
        const double largest =
            lens.apertureRadius.value * kFocalLengthPixels * std::max(lens.focus.value, 1.0 / distance);
        EXPECT_NEAR(static_cast<double>(coc), exact, 2.0 * 1.2e-7 * largest + 1e-5 * std::abs(exact));
        EXPECT_NEAR(static_cast<double>(coc), exact, 0.001 + 1e-5 * std::abs(exact));  // never visible
    }
}

TEST(LensTest, DepthTransformIsTheSameAsVergence) {
    const Metres near(0.02);
    for (const double focusDistance : {0.051, 0.3, 2.0, kInfinity}) {
        for (const double radius : {0.0, 0.002, 0.1}) {
            const Lens lens = lensOf(radius, 0.05, focusDistance);
            const CocTransform transform = cocFromDepth(lens, 700.0, near);
            for (const double distance : {0.02, 0.1, 1.0, 77.0, kInfinity}) {
                const double expected = cocRadiusPixels(lens, 700.0, vergence(Metres(distance)));
                const double largest = radius * 700.0 * (lens.focus.value + 1.0 / distance);
                EXPECT_NEAR(static_cast<double>(transform.radius(static_cast<float>(near.value / distance))), expected,
                            3e-7 * largest)
                    << "focus " << focusDistance << " radius " << radius << " distance " << distance;
            }
        }
    }
}

// Lee, Kim, Choi 2009: diameter 4 mm, F = 17 mm, 0.32 dots per mm, display 3 m away (projected through their dr = 24 mm
// retina), object at 0.3 m, focus at infinity: the circle's DIAMETER "does not exceed 10" pixels.
TEST(LensTest, ExampleOfLeeKimChoi) {
    const Lens lens = lensOf(0.002, 0.017, kInfinity);
    const double diameter = 2.0 * std::abs(cocRadiusOnImage(lens, vergence(Metres(0.3))).value);
    EXPECT_NEAR(diameter * 320.0 * 3.0 / 0.024, 9.07, 0.005);
    // The consistent value projects through the image distance, i.e. F: 1 / 0.708 of it.
    EXPECT_NEAR(2.0 * std::abs(cocRadiusPixels(lens, 320.0 * 3.0, vergence(Metres(0.3)))), 9.0667 / 0.70833, 1e-3);
}

TEST(LensTest, SignIsPositiveBehindFocusAndZeroOnIt) {
    const Lens lens = lensOf(0.0025, 0.01667, 2.0);
    EXPECT_GT(cocRadiusPixels(lens, 800.0, vergence(Metres(3.0))), 0.0);
    EXPECT_LT(cocRadiusPixels(lens, 800.0, vergence(Metres(1.0))), 0.0);
    EXPECT_EQ(cocRadiusPixels(lens, 800.0, vergence(Metres(2.0))), 0.0);
    EXPECT_GT(cocRadiusPixels(lens, 800.0, Dioptres(0.0)), 0.0);
}

TEST(LensTest, PinholeBlursNothing) {
    const Lens lens = lensOf(0.0, 0.05, 0.3);
    for (const double distance : {0.001, 0.3, 10.0, kInfinity}) {
        EXPECT_EQ(cocRadiusOnImage(lens, vergence(Metres(distance))).value, 0.0);
        EXPECT_EQ(cocRadiusPixels(lens, 1000.0, vergence(Metres(distance))), 0.0);
    }
}

TEST(LensTest, ExtremesAreOrdinary) {
    for (const Lens& lens : {lensOf(0.2, 0.05, 0.051), lensOf(0.1, 0.05, kInfinity), lensOf(0.2, 0.01667, 0.01767)}) {
        EXPECT_NO_THROW(validate(lens)) << lens.focus.value;
        EXPECT_TRUE(std::isfinite(imageDistance(lens).value));
        EXPECT_GT(imageDistance(lens).value, 0.0);
        EXPECT_TRUE(std::isfinite(cocRadiusPixels(lens, 1e4, Dioptres(1e4))));
    }
    EXPECT_NEAR(imageDistance(lensOf(0.1, 0.05, 0.051)).value, 0.05 * 0.051 / 0.001, 1e-9);
    EXPECT_EQ(imageDistance(lensOf(0.1, 0.05, kInfinity)).value, 0.05);
}

TEST(LensTest, RefusesWhatNoLensCanBe) {
    const double nan = std::nan("");
    EXPECT_THROW(validate(lensOf(0.01, 0.05, 0.05)), InputError);  // at the focal length
    EXPECT_THROW(validate(lensOf(0.01, 0.017, 0.017)), InputError);
    EXPECT_THROW(validate(lensOf(0.01, 0.05, 0.049)), InputError);
    EXPECT_THROW(validate(lensOf(0.01, 0.05, 0.0)), InputError);
    EXPECT_THROW(validate(lensOf(-1e-9, 0.05, 1.0)), InputError);
    EXPECT_THROW(validate(lensOf(nan, 0.05, 1.0)), InputError);
    EXPECT_THROW(validate(lensOf(kInfinity, 0.05, 1.0)), InputError);
    EXPECT_THROW(validate(lensOf(0.01, 0.0, 1.0)), InputError);
    EXPECT_THROW(validate(lensOf(0.01, -0.05, 1.0)), InputError);
    EXPECT_THROW(validate(lensOf(0.01, nan, 1.0)), InputError);
    EXPECT_THROW(validate({Metres(0.01), Metres(0.05), Dioptres(nan)}), InputError);
    EXPECT_THROW(validate({Metres(0.01), Metres(0.05), Dioptres(-20.5)}), InputError);
    EXPECT_NO_THROW(validate({Metres(0.01), Metres(0.05), Dioptres(-1.0)}));  // a hyperope's residual
}

TEST(LensTest, ErrorNamesValueAndLimit) {
    try {
        validate(lensOf(0.01, 0.05, 0.04));
        FAIL() << "accepted";
    } catch (const InputError& error) {
        const std::string message = error.what();
        EXPECT_NE(message.find("0.04"), std::string::npos) << message;
        EXPECT_NE(message.find("0.05"), std::string::npos) << message;
        EXPECT_EQ(message.find('\n'), std::string::npos);
    }
}

}  // namespace
}  // namespace dioptre
