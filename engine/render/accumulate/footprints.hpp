// What each lookup through the lens stands for, and the picture from their sums.
// Sigg, Hadwiger 2005, "Fast third-order texture filtering" (GPU Gems 2): the B-spline by four bilinear fetches.
//
// N (S + 1) points of the lens share a disc of CoC radius c; each stands for pi c² / (N (S + 1)) px² of what it sees,
// not for a pixel. Where that is more, the copies of what is seen do not join: grain, and dots in place of the disc of
// a lamp. So all that points see is summed up in parts by such a footprint, and smoothed by it, once, whatever N is:
// - what is in focus, or has narrower footprints than kLeastVariance, stays as it is;
// - what is in front of focus is smoothed with its coverage: nothing blurred less can lie before it, so both are at
//   least as smooth as its CoC. What it leaves open is filled with the rest, in the rest's proportions;
// - what is behind focus can be cut off by sharp edges: its colour is smoothed, its coverage stays;
// - what is seen of and through blended surfaces, which leave no depth, stays as it is, the more the more they cover.
// Smoothing is a cubic B-spline over a mipmap level's texels, two levels a side (shared/accumulate_types.h): what lies
// between them goes to both, by its variance, so that nothing pops. Beyond the coarse one grain remains.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "gl/program.hpp"
#include "render/draw_list.hpp"
#include "render/sample_sum.hpp"

namespace dioptre {

/// Variance of a footprint along an axis, in c² / (N (S + 1)): eight times that of a disc as large as a point's even
/// share, since points lie less evenly than that. With other values here `bench_accumulate toys --reference 1024` gave
/// SSIM and dB at N = 32, S = 4; at 8, 8:
/// 0.75: .9898 / 39.8; .9860 / 37.6   1: .9902 / 39.9; .9867 / 37.8   1.5: .9906 / 40.1; .9872 / 37.9
/// 2:    .9909 / 40.2; .9873 / 37.8   3: .9909 / 40.1; .9870 / 37.6   all narrow: .988 / 39.3; .980 / 36.4
inline constexpr double kFootprint = 2.0;
/// The most, in c²: a quarter of the blur's own, which few points would otherwise widen.
inline constexpr double kMostFootprint = 0.0625;
/// Variances below it, px², are within what a pixel's own jitter smooths.
inline constexpr double kLeastVariance = 0.06;

/// What footprints a view has.
struct Footprints {
    double variance = 0.0;  // px², of a CoC radius of 1 px along x
    bool wide = false;      // some are not narrow
    bool inFront = false;   // of what is in front of focus, too

    /// That sums are kept in.
    int parts() const;
    /// What shaders for these parts are compiled with.
    std::vector<std::string> defines() const;
};
/// `points`: N (S + 1). Conservative, by boxes: what the eye is in counts as near.
Footprints requiredFootprints(const View& view, const Lens& lens, double points, std::span<const DrawList::Seen> seen);

/// Variance along an axis, px², of the cubic B-spline over a mipmap level's texels, which are means of 4^level pixels:
/// 4^level / 3 and (4^level - 1) / 12.
double splineVariance(int level);

class FootprintPass {
  public:
    /// The picture from its parts, more than one, RGBA32F.
    const Texture& draw(SampleSum& sum, const Footprints& footprints);

  private:
    FullscreenPass behind_, all_;
};

}  // namespace dioptre
