// The CoC radii, signed, that any lookup from a tile can meet (render/accumulate/subsample_blur.hpp). Begins with those
// of the whole layer; what can be reached with these is bounded anew by four lookups of the N-buffer, a few times.
#include "shared/accumulate_types.h"

layout(binding = 0) uniform sampler2DArray whole;
layout(binding = 1) uniform sampler2DArray squares[kNBufferLevels];  // of 1, 2, 4, ... tiles
uniform int levels;      // of them there are
uniform vec2 coc;        // CoC radius = x * depth + y
uniform float farthest;  // the longest offset of a sub-sample, as a share of the lens's radius
uniform float stretch;   // pixels along y for one along x

layout(location = 0) out vec2 radii;  // nearest, farthest: increasing

const int kRounds = 3;

vec2 square(int level, ivec2 at) {
    ivec3 texel = ivec3(at, gl_Layer);
    switch (level) {
        case 0: return texelFetch(squares[0], texel, 0).rg;
        case 1: return texelFetch(squares[1], texel, 0).rg;
        case 2: return texelFetch(squares[2], texel, 0).rg;
        case 3: return texelFetch(squares[3], texel, 0).rg;
        case 4: return texelFetch(squares[4], texel, 0).rg;
        default: return texelFetch(squares[5], texel, 0).rg;
    }
}

vec2 radiiOf(vec2 depths) { return coc.x * depths.yx + coc.y; }

void main() {
    ivec2 tile = ivec2(gl_FragCoord.xy), last = textureSize(squares[0], 0).xy - 1;
    radii = radiiOf(texelFetch(whole, ivec3(0, 0, gl_Layer), 0).rg);
    for (int round = 0; round < kRounds; ++round) {
        // One pixel for the rounding of lookups
        float reach = max(abs(radii.x), abs(radii.y)) * farthest + 1.0;
        ivec2 tiles = ivec2(ceil(vec2(reach, reach * stretch) / float(kTileSide)));
        ivec2 from = max(tile - tiles, 0), to = min(tile + tiles, last);
        ivec2 spans = to - from + 1;
        int level = findMSB(max(min(spans.x, spans.y), 1));
        int side = 1 << level;
        // Four squares cover it while the longer span is at most twice their side.
        if (level >= levels || max(spans.x, spans.y) > 2 * side) {
            level = findMSB(max(spans.x, spans.y));
            side = 1 << level;
            if (level >= levels) break;
            from = max(min(from, last - side + 1), 0);
        }
        ivec2 end = max(to - side + 1, from);
        vec2 a = square(level, from), b = square(level, ivec2(end.x, from.y));
        vec2 c = square(level, ivec2(from.x, end.y)), d = square(level, end);
        radii = radiiOf(vec2(min(min(a.x, b.x), min(c.x, d.x)), max(max(a.y, b.y), max(c.y, d.y))));
    }
}
