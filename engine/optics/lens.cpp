#include "optics/lens.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/error.hpp"

namespace dioptre {

namespace {

// F Df this close to 1 is "at the focal length" though rounding of Df = 1/df may have left it on either side.
constexpr double kAtFocalLength = 1.0 - 1e-12;

void validateFocalLength(Metres focalLength) {
    if (!std::isfinite(focalLength.value) || focalLength.value <= 0.0)
        throw InputError(fmt::format("lens: focal length {} m, must be finite and > 0", focalLength.value));
}

}  // namespace

void validateFocus(Metres focalLength, Dioptres focus) {
    validateFocalLength(focalLength);
    if (std::isnan(focus.value) || focus < kLeastFocus)
        throw InputError(
            fmt::format("lens: focus at {} D, must be a number and at least {} D", focus.value, kLeastFocus.value));
    if (!(focalLength.value * focus.value < kAtFocalLength))
        throw InputError(fmt::format("lens: focus distance {} m, must be beyond the focal length {} m",
                                     1.0 / focus.value, focalLength.value));
}

void validate(const Lens& lens) {
    if (!std::isfinite(lens.apertureRadius.value) || lens.apertureRadius.value < 0.0)
        throw InputError(
            fmt::format("lens: aperture radius {} m, must be finite and not negative", lens.apertureRadius.value));
    validateFocus(lens.focalLength, lens.focus);
}

Metres imageDistance(const Lens& lens) {
    return lens.focalLength / (1.0 - lens.focalLength.value * lens.focus.value);
}

Metres cocRadiusOnImage(const Lens& lens, Dioptres objectVergence) {
    return lens.apertureRadius * (imageDistance(lens).value * (lens.focus - objectVergence).value);
}

double cocRadiusPixels(const Lens& lens, double focalLengthPixels, Dioptres objectVergence) {
    return lens.apertureRadius.value * focalLengthPixels * (lens.focus - objectVergence).value;
}

CocTransform cocFromDepth(const Lens& lens, double focalLengthPixels, Metres near) {
    const double pixelsPerDioptre = lens.apertureRadius.value * focalLengthPixels;
    return {static_cast<float>(-pixelsPerDioptre / near.value),
            static_cast<float>(pixelsPerDioptre * lens.focus.value)};
}

}  // namespace dioptre
