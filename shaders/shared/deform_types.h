// What the pass that bends meshes reads, the same for C++ and GLSL (std430).
#ifdef __cplusplus
#pragma once
#include <cstdint>
namespace dioptre::gpu {
using uint = std::uint32_t;
#endif

// Vertices per work group.
const int kDeformGroup = 64;

struct InfluenceData {
    uint joint;
    float weight;
};

struct ActiveTarget {
    uint target;
    float weight;
};

#ifdef __cplusplus
static_assert(sizeof(InfluenceData) == 8 && sizeof(ActiveTarget) == 8);
}  // namespace dioptre::gpu
#endif
