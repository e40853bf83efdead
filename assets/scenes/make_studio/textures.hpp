// The finished pictures of every object: paint times baked light, squeezed into 8-bit sRGB.
#pragma once

#include <vector>

#include "bake.hpp"
#include "model.hpp"

namespace studio {

/// 4 channels of 8 bits, row 0 on top; empty when not used.
struct Picture {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgba;
    bool empty() const { return rgba.empty(); }
};

struct ObjectPictures {
    Picture color, metallicRoughness, normal, emissive;
    float roughness = 1.0f, metallic = 0.0f;  // the constants, where no picture varies them
};

/// Leaves the lower range alone and bends highlights into [0, 1] without a kink.
vec3 compressHighlights(const vec3& radiance);

std::vector<ObjectPictures> composePictures(const Model& model, const BakedLight& light);

/// Bilinear look-up, rgba in [0, 1], no decoding.
vec4 sample(const Picture& picture, const vec2& coordinate);

}  // namespace studio
