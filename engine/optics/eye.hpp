// The human eye as numbers: pupil, accommodation, blur and convergence.
//   Watson, Yellott 2012, A unified formula for light-adapted pupil size (Journal of Vision 12(10):12).
//   Hofstetter 1950, Useful age-amplitude formula (Optical World 38).
#pragma once

#include <numbers>

#include "optics/units.hpp"

namespace dioptre {

/// What the pupil answers to.
struct PupilConditions {
    double luminance = 100.0;                     // cd/m2, >= 0, of the adapting field
    double fieldArea = 900.0 * std::numbers::pi;  // deg2, > 0; default: a disc 60 deg across (2827.43 deg2)
    double ageYears = 28.58;                      // clamped to 20..83, the ages the formula was fitted to
    int eyes = 2;                                 // 1 or 2 eyes see the field (M = 0.1 or 1)
};

/// Watson and Yellott 2012: pupil DIAMETER, 2 to 8.2 mm. Throws InputError for values outside the ranges above.
Metres pupilDiameter(const PupilConditions& conditions);

/// The three lines of Hofstetter 1950; the mean is the usual one.
enum class AmplitudeEstimate { minimum, mean, maximum };

/// How many dioptres the eye can accommodate at an age: 15 - a/4, 18.5 - 0.3 a, 25 - 0.4 a; never below 0.
Dioptres accommodationAmplitude(double ageYears, AmplitudeEstimate estimate = AmplitudeEstimate::mean);

/// What can be brought into focus, as vergences: farthest <= nearest.
struct FocusRange {
    Dioptres farthest{0.0};
    Dioptres nearest{0.0};
};

/// [-R, -R + A] of an eye with refraction R (< 0 short-sighted, > 0 far-sighted) and amplitude A >= 0. A far-sighted
/// eye uses up R before it sees infinity sharply; with A < R the whole range is negative (beyond infinity).
FocusRange accommodationRange(Dioptres refraction, Dioptres amplitude);

struct ReachedFocus {
    Dioptres focus{0.0};
    Dioptres residual{0.0};  // target - focus: what stays out of focus at the target; 0 within the range
};

/// clamp(target, farthest, nearest), and what is missing.
ReachedFocus reachFocus(Dioptres target, const FocusRange& range);

/// Angular blur DIAMETER of a point at `object` for an eye focused at `focus`: pupil diameter (m) * |Df - D|.
Radians blurDiameter(Metres pupilDiameter, Dioptres focus, Dioptres object);

/// Angle between the two eyes' axes when they fixate straight ahead at vergence D: 2 atan(D IPD / 2).
Radians convergenceAngle(Dioptres vergence, Metres ipd);

/// The inverse, 2 tan(v/2) / IPD; a diverged pair (v <= 0) fixates at infinity, 0. Throws InputError for IPD <= 0.
Dioptres fixatedVergence(Radians convergence, Metres ipd);

}  // namespace dioptre
