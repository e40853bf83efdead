#include "optics/eye.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace dioptre {

Metres pupilDiameter(const PupilConditions& conditions) {
    const auto& [luminance, fieldArea, ageYears, eyes] = conditions;
    if (!std::isfinite(luminance) || luminance < 0.0)
        throw InputError(fmt::format("pupil: luminance {} cd/m2, must be finite and not negative", luminance));
    if (!std::isfinite(fieldArea) || fieldArea <= 0.0)
        throw InputError(fmt::format("pupil: field area {} deg2, must be finite and > 0", fieldArea));
    if (std::isnan(ageYears)) throw InputError("pupil: age is not a number");
    if (eyes != 1 && eyes != 2) throw InputError(fmt::format("pupil: {} eyes, must be 1 or 2", eyes));

    // Watson, Yellott 2012, eq. 21 on top of Stanley, Davies 1995, both in mm.
    const double monocular = eyes == 1 ? 0.1 : 1.0;
    const double q = std::pow(luminance * fieldArea * monocular / 846.0, 0.41);
    const double stanleyDavies = 7.75 - 5.75 * (q / (q + 2.0));
    const double age = std::clamp(ageYears, 20.0, 83.0);
    const double millimetres = stanleyDavies + (age - 28.58) * (0.02132 - 0.009562 * stanleyDavies);
    return Metres(millimetres * 1e-3);
}

Dioptres accommodationAmplitude(double ageYears, AmplitudeEstimate estimate) {
    double amplitude = 0.0;
    switch (estimate) {
        case AmplitudeEstimate::minimum:
            amplitude = 15.0 - 0.25 * ageYears;
            break;
        case AmplitudeEstimate::mean:
            amplitude = 18.5 - 0.3 * ageYears;
            break;
        case AmplitudeEstimate::maximum:
            amplitude = 25.0 - 0.4 * ageYears;
            break;
    }
    return Dioptres(std::max(0.0, amplitude));
}

FocusRange accommodationRange(Dioptres refraction, Dioptres amplitude) {
    const Dioptres farthest = Dioptres(0.0) - refraction;  // not -R: no negative zero
    return {farthest, farthest + amplitude};
}

ReachedFocus reachFocus(Dioptres target, const FocusRange& range) {
    const Dioptres focus = std::clamp(target, range.farthest, range.nearest);
    return {focus, target - focus};
}

Radians blurDiameter(Metres pupilDiameter, Dioptres focus, Dioptres object) {
    return Radians(pupilDiameter.value * std::abs((focus - object).value));
}

Radians convergenceAngle(Dioptres vergence, Metres ipd) {
    return Radians(2.0 * std::atan(0.5 * vergence.value * ipd.value));
}

Dioptres fixatedVergence(Radians convergence, Metres ipd) {
    if (!(ipd.value > 0.0))
        throw InputError(fmt::format("eyes: interpupillary distance {} m, must be > 0 to tell a depth", ipd.value));
    return Dioptres(std::max(0.0, 2.0 * std::tan(0.5 * convergence.value) / ipd.value));
}

}  // namespace dioptre
