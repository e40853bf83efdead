// Degree of foreground neighbours' blur (Lee, Kim, Choi 2009, eq. 10 and 11) as a radius: for each tile the largest, px,
// of the foreground's circles of confusion that touch it. 7×7 texels are searched, at the level whose texels are no
// smaller than a third of the largest radius in the picture and half a tile.
#include "shared/mipmap.h"
layout(binding = 0) uniform sampler2D spread;
uniform int top;     // coarsest level of `spread`, one texel
uniform vec2 tiles;  // size of the target

layout(location = 0) out vec4 reach;

void main() {
    float largest = texelFetch(spread, ivec2(0), top).x;
    float result = 0.0;
    if (largest > 0.0) {
        int level = clamp(int(ceil(log2((largest * 0.5 + 0.5 * float(kReachTile)) / 3.0))), 0, top);
        vec2 size = vec2(textureSize(spread, level));
        vec2 texelPixels = vec2(textureSize(spread, 0)) * 2.0 / size;
        vec2 at = gl_FragCoord.xy / tiles * size;  // the tile's centre, in texels of `level`
        vec2 halfTile = 0.5 * size / tiles;
        ivec2 centre = ivec2(floor(at));
        for (int i = 0; i < 49; ++i) {
            ivec2 q = centre + ivec2(i % 7 - 3, i / 7 - 3);
            float c = texelFetch(spread, clamp(q, ivec2(0), ivec2(size) - 1), level).x;
            vec2 gap = max(abs(vec2(q) + 0.5 - at) - 0.5 - halfTile, vec2(0.0)) * texelPixels;
            if (dot(gap, gap) <= c * c) result = max(result, c);
        }
    }
    reach = vec4(result);
}
