#include "viewer/sharp_range.hpp"

#include "quality/requirements.hpp"

namespace dioptre {

SharpRange sharpRange(const Lens& lens, double focalLengthPixels) {
    // |c| = E f_px |Df - D| is a RADIUS
    const Dioptres half(0.5 * kSharpDiameter / (lens.apertureRadius.value * focalLengthPixels));
    return {lens.focus - half, lens.focus + half};
}

Radians screenDisparity(Metres ipd, Metres screen, Dioptres depth) {
    return Radians(ipd.value * (depth - vergence(screen)).value);
}

}  // namespace dioptre
