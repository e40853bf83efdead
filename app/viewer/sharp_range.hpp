// What of the depths is sharp, and what of them strains the eyes before a screen.
#pragma once

#include "optics/lens.hpp"

namespace dioptre {

/// Vergences at which a circle of confusion is at most as wide as nobody sees (kSharpDiameter); a negative one is beyond
/// infinity, and so is an infinite one for a pinhole.
struct SharpRange {
    Dioptres farthest, nearest;
};
SharpRange sharpRange(const Lens& lens, double focalLengthPixels);

/// How far two eyes that look at a depth have to turn from where they look at a screen: > 0 for what is in front of it.
/// For small angles: IPD (D - D_screen).
Radians screenDisparity(Metres ipd, Metres screen, Dioptres depth);

/// Beyond one degree two pictures are hard to fuse.
inline constexpr double kComfortableDegrees = 1.0;

}  // namespace dioptre
