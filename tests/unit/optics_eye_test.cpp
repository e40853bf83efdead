#include "optics/eye.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "csv_table.hpp"

namespace dioptre {
namespace {

TEST(EyeTest, PupilFollowsWatsonYellott) {
    const CsvTable table = testTable("pupil.csv");
    for (std::size_t row = 0; row < table.size(); ++row) {
        SCOPED_TRACE(table.describe(row));
        const PupilConditions conditions{table.number(row, "L_cd_m2"), table.number(row, "area_deg2"),
                                         table.number(row, "age_y"), static_cast<int>(table.number(row, "eyes"))};
        EXPECT_NEAR(pupilDiameter(conditions).value * 1e3, table.number(row, "WatsonYellott_mm"), 1e-9);
    }
}

TEST(EyeTest, PupilShrinksWithLightAndWithOneMoreEye) {
    double last = 1.0;
    for (double luminance = 1e-6; luminance < 1e6; luminance *= 3.0) {
        PupilConditions conditions;
        conditions.luminance = luminance;
        const double diameter = pupilDiameter(conditions).value;
        EXPECT_LT(diameter, last) << luminance;
        EXPECT_GT(diameter, 0.0015);
        conditions.eyes = 1;
        EXPECT_GT(pupilDiameter(conditions).value, diameter) << luminance;
        last = diameter;
    }
}

TEST(EyeTest, PupilAgeIsClampedToTheFittedRange) {
    const auto atAge = [](double age) {
        PupilConditions conditions;
        conditions.ageYears = age;
        return pupilDiameter(conditions).value;
    };
    EXPECT_EQ(atAge(5.0), atAge(20.0));
    EXPECT_EQ(atAge(110.0), atAge(83.0));
    EXPECT_NE(atAge(20.0), atAge(83.0));
}

TEST(EyeTest, PupilInTheDarkIsFiniteAndBadInputIsRefused) {
    EXPECT_NEAR(pupilDiameter({0.0, 1000.0, 28.58, 2}).value, 7.75e-3, 1e-12);
    EXPECT_THROW(pupilDiameter({-1.0, 1000.0, 30.0, 2}), InputError);
    EXPECT_THROW(pupilDiameter({std::nan(""), 1000.0, 30.0, 2}), InputError);
    EXPECT_THROW(pupilDiameter({1.0, 0.0, 30.0, 2}), InputError);
    EXPECT_THROW(pupilDiameter({1.0, 1000.0, std::nan(""), 2}), InputError);
    EXPECT_THROW(pupilDiameter({1.0, 1000.0, 30.0, 3}), InputError);
}

TEST(EyeTest, AmplitudeFollowsHofstetter) {
    const CsvTable table = testTable("accommodation_age.csv");
    for (std::size_t row = 0; row < table.size(); ++row) {
        SCOPED_TRACE(table.describe(row));
        const double age = table.number(row, "age_y");
        using enum AmplitudeEstimate;
        EXPECT_NEAR(accommodationAmplitude(age, minimum).value, table.number(row, "min_clamped"), 1e-12);
        EXPECT_NEAR(accommodationAmplitude(age, mean).value, table.number(row, "mean_clamped"), 1e-12);
        EXPECT_NEAR(accommodationAmplitude(age, maximum).value, table.number(row, "max_clamped"), 1e-12);
        const FocusRange range = accommodationRange(Dioptres(0.0), accommodationAmplitude(age));
        const double nearPoint = table.number(row, "near_point_m_emmetrope(mean)");
        if (std::isinf(nearPoint))
            EXPECT_TRUE(std::isinf(distance(range.nearest).value));
        else
            EXPECT_NEAR(distance(range.nearest).value, nearPoint, 1e-9 * nearPoint);
    }
}

TEST(EyeTest, FocusIsClampedToWhatTheEyeReaches) {
    const CsvTable table = testTable("accommodation_clamp.csv");
    for (std::size_t row = 0; row < table.size(); ++row) {
        SCOPED_TRACE(table.describe(row));
        const FocusRange range =
            accommodationRange(Dioptres(table.number(row, "refraction_D")), Dioptres(table.number(row, "amplitude_D")));
        EXPECT_EQ(range.farthest.value, table.number(row, "range_lo_D"));
        EXPECT_EQ(range.nearest.value, table.number(row, "range_hi_D"));
        const ReachedFocus reached = reachFocus(Dioptres(table.number(row, "target_D")), range);
        EXPECT_EQ(reached.focus.value, table.number(row, "focus_D"));
        EXPECT_EQ(reached.residual.value, table.number(row, "residual_defocus_D"));
    }
}

TEST(EyeTest, BlurDiameter) {
    const CsvTable table = testTable("eye_blur.csv");
    const double focalLengthPixels = 1832.0 / 2.0 / std::tan(50.0 * std::numbers::pi / 180.0);
    for (std::size_t row = 0; row < table.size(); ++row) {
        SCOPED_TRACE(table.describe(row));
        const Metres pupil(1e-3 * table.number(row, "pupil_mm"));
        const Dioptres defocus(table.number(row, "defocus_D"));
        const double blur = blurDiameter(pupil, Dioptres(0.0), defocus).value;
        EXPECT_NEAR(blur, table.number(row, "blur_rad"), 1e-15);
        EXPECT_EQ(blurDiameter(pupil, defocus, Dioptres(0.0)).value, blur);
        EXPECT_NEAR(blur * focalLengthPixels, table.number(row, "diam_px_W1832_hfov100"), 1e-9);
    }
}

TEST(EyeTest, ConvergenceAndBack) {
    const CsvTable table = testTable("vergence.csv");
    for (std::size_t row = 0; row < table.size(); ++row) {
        SCOPED_TRACE(table.describe(row));
        const Metres ipd(table.number(row, "ipd_m"));
        const Dioptres at = vergence(Metres(table.number(row, "d_m")));
        const Radians angle = convergenceAngle(at, ipd);
        EXPECT_NEAR(angle.value, table.number(row, "vergence_rad"), 1e-14);
        EXPECT_NEAR(fixatedVergence(angle, ipd).value, table.number(row, "D_from_vergence"), 1e-12);
        // What an error of one degree does, to first order.
        const Radians step(1e-5);
        const double slope = (fixatedVergence(angle + step, ipd) - fixatedVergence(angle, ipd)).value / step.value;
        EXPECT_NEAR(slope * std::numbers::pi / 180.0, table.number(row, "sigma_D_for_1deg_vergence_noise"), 1e-5);
    }
}

TEST(EyeTest, ConvergenceAtExtremes) {
    EXPECT_EQ(convergenceAngle(Dioptres(10.0), Metres(0.0)).value, 0.0);
    EXPECT_GT(convergenceAngle(Dioptres(10.0), Metres(0.2)).value, 1.5);
    EXPECT_EQ(fixatedVergence(Radians(-0.1), Metres(0.2)).value, 0.0);
    EXPECT_THROW(fixatedVergence(Radians(0.1), Metres(0.0)), InputError);
    EXPECT_THROW(fixatedVergence(Radians(0.1), Metres(std::nan(""))), InputError);
}

}  // namespace
}  // namespace dioptre
