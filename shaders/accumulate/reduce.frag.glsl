// Bounds of squares of tiles: a step towards those of the whole layer.
#include "shared/accumulate_types.h"

layout(binding = 0) uniform sampler2DArray tiles;

layout(location = 0) out vec2 bounds;

void main() {
    ivec2 first = ivec2(gl_FragCoord.xy) * kReduction, last = textureSize(tiles, 0).xy - 1;
    bounds = vec2(1e30, 0.0);
    for (int y = 0; y < kReduction; ++y)
        for (int x = 0; x < kReduction; ++x) {
            vec2 b = texelFetch(tiles, ivec3(min(first + ivec2(x, y), last), gl_Layer), 0).rg;
            bounds = vec2(min(bounds.x, b.x), max(bounds.y, b.y));
        }
}
