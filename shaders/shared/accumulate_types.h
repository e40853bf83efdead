// Sizes that the accumulation's passes share, read by C++ and GLSL alike.
#ifdef __cplusplus
#pragma once
namespace dioptre::gpu {
#endif

const int kTileSide = 4;            // pixels of a tile whose depths are bounded together
const int kNBufferLevels = 6;       // squares of 1 ... 32 tiles
const int kMostOffsets = 192;       // sub-samples of one pass
const int kReduction = 4;           // tiles a side that a step of the reduction to the whole picture's bounds joins

// What lookups are summed up in, by their footprints: all that is narrow; then, behind and in front of focus, what is as
// wide as a smoothed texel of the fine level, and of the coarse level.
const int kSharp = 0, kFineBehind = 1, kCoarseBehind = 2, kFineInFront = 3, kCoarseInFront = 4;
const int kFineLevel = 1, kCoarseLevel = 3;  // mipmap levels

#ifdef __cplusplus
}  // namespace dioptre::gpu
#endif
