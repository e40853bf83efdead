// Adaptive visibility: samples of the lens that see an object in the same raster cells share one rendering of it.
// [JKLL13] Jeong et al. 2013, "Real-time defocus rendering with level of detail and sub-sample blur".
//
// A point with CoC radius c is moved by c v on the screen, v in the unit disc. Of all that has CoC radii of at most r,
// all samples with r v in the same cell of 1/grid pixels are drawn once, through their parent, and copied. That moves
// nothing by more than the cell's diagonal, 1.42/grid px, and what lies nearer to focus by less. The parent is the mean
// of its samples: with the one nearest to the middle of the cell, as published, an object as a whole can be moved.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "optics/lens_samples.hpp"

namespace dioptre {

struct SharedRenderings {
    // Point of the lens and the pixel's jitter, which all who share have in common; in the order in which samples first
    // need them.
    std::vector<LensSample> parents;
    std::vector<int> parentOf;  // of each sample
};

/// Each sample has one parent. A parent's pixel jitter is that of all who share it, so it stands for at most 1/32 of
/// the samples (rounded up), or edges would not stay antialiased: cells with more are divided among parents. On the
/// checkerboard of AccumulateGLTest.SharedRenderingsMoveNothingByMoreThanTheirCells, 64 samples, CoC radii of 0 to 1.5
/// px, eight jitters gave SSIM 0.988 or more to plain accumulation, sixteen 0.994. With sixteen the edges of what is in
/// focus flicker: in the dolly of `bench_accumulate pops` up to 0.0103 of SSIM from frame to frame, with 32 up to 0.0046.
inline constexpr int kLeastJitters = 32;
SharedRenderings shareRenderings(std::span<const LensSample> samples, double cocRadius, int grid);

}  // namespace dioptre
