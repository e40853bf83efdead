// Sizes that the accumulation's passes share, read by C++ and GLSL alike.
#ifdef __cplusplus
#pragma once
namespace dioptre::gpu {
#endif

const int kTileSide = 4;            // pixels of a tile whose depths are bounded together
const int kNBufferLevels = 6;       // squares of 1 ... 32 tiles
const int kMostOffsets = 192;       // sub-samples of one pass
const int kReduction = 4;           // tiles a side that a step of the reduction to the whole picture's bounds joins

#ifdef __cplusplus
}  // namespace dioptre::gpu
#endif
