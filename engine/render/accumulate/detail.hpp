// How much detail an object needs through a lens, and how blurred it can be. Arithmetic, no GL.
// [JKLL13] Jeong et al. 2013, "Real-time defocus rendering with level of detail and sub-sample blur".
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "optics/lens.hpp"
#include "optics/view.hpp"
#include "render/draw_list.hpp"

namespace dioptre {

/// The CoC RADII, without their sign, that a box can have; pixels, the smallest along the axis with fewer, the largest
/// along the other.
struct CocExtent {
    double smallest = 0.0, largest = 0.0;
};
/// Of what of the box lies before the near plane nothing is drawn.
CocExtent cocExtent(const View& view, const Lens& lens, const ViewBox& box);

/// Screen area of the sphere around the box, px²; infinite where the eye is in it.
double sphereArea(const View& view, const ViewBox& box);

/// [JKLL13] eq. 3, L = max(log2(C/A), 0), by areas in px²: what a CoC covers against what a triangle does. 0 for C = 0
/// (in focus), never above `mostLevel` (A = 0).
double detailLevel(double cocArea, double triangleArea, int mostLevel);

/// A level's error (scene/simplify.hpp) may be that share of the CoC radius: simpler surfaces shrink and are shaded
/// otherwise, which blur does not hide. With other values here `bench_accumulate SCENE --reference 1024` gave SSIM and
/// seconds at N = 32, S = 4, with footprints as they were first drawn:
/// toys   0.04: .9902, 5.1   0.02: .9908, 5.5   0.01: .9911, 5.5   level 0 for all: .9913, 5.8
/// fishes 0.04: .9862, 7.5   0.02: .9889, 7.5   0.01: .9901, 7.9   level 0 for all: .9908, 9.1
/// Larger ones, before there were footprints (toys, --quick --reference 384 --size 512x384 --diameter 12), SSIM and
/// triangles left: 0.03: .980, 56 %; 0.1: .977, 40 %; 0.3: .968, 30 %.
inline constexpr double kErrorOfBlur = 0.02;

/// Of an item: eq. 3 with C = pi c² of its smallest CoC radius and, eq. 4, A = A_b / (N_t / 2): half of its triangles
/// face the eye; but no coarser than kErrorOfBlur allows, which [JKLL13] does not ask for. A fraction: so much of the
/// lens takes the next level. It hangs on the depth along the view alone, not on where to the side the eye is: both
/// eyes see the same level.
double detailLevel(const View& view, const Lens& lens, const DrawList::Seen& seen);

/// The level of one of `count` samples: the first (1 - fraction) of them take the finer one. Both parts of the Halton
/// sequence cover the lens about evenly, so that a level comes and goes without a jump: in as many steps as there are
/// groups of samples that are drawn together.
int levelOfSample(double level, int sample, int count);

}  // namespace dioptre
