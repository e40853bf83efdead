// Points on the lens, and the projection through each of them.
// Haeberli, Akeley 1990, "The Accumulation Buffer"; Shirley, Chiu 1997, "A low distortion map between disk and square".
#pragma once

#include <glm/glm.hpp>

#include "optics/lens.hpp"
#include "optics/view.hpp"

namespace dioptre {

struct LensSample {
    glm::dvec2 lens{0.0};   // in the unit disc (or the blades' polygon in it), x right, y up
    glm::dvec2 pixel{0.0};  // sub-pixel jitter, each -0.5..0.5 of a pixel
};

/// Sample `index` >= 0 of one sequence, so that prefixes nest: N + 1 samples add one. Halton (2, 7) on the lens,
/// (3, 5) in the pixel.
LensSample lensSample(int index, const Lens& lens);

/// The radical inverse of `index` in a prime base, 0 <= h < 1.
double halton(int index, int base);

/// Unit square to unit disc, areas kept.
glm::dvec2 concentricDisc(glm::dvec2 square);

/// Unit square to the regular polygon inscribed in the unit circle with a corner at `rotation` (0: on +x), areas kept.
/// blades >= 3.
glm::dvec2 polygon(glm::dvec2 square, int blades, Radians rotation);

/// The view's matrix seen through a point of the lens: a shear that leaves the plane in focus where it is. In clip
/// space the shift is P.xy E v (Df d - 1), linear in w = d and constant, so with d = -z it folds into the projection,
///   P02 -= P00 E vx Df,  P03 -= P00 E vx,  likewise in y;
/// the pixel's jitter is a constant shift in ndc. Works for off-axis frusta too.
glm::dmat4 clipFromView(const View& view, const Lens& lens, const LensSample& sample);

}  // namespace dioptre
