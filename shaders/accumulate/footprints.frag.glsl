// The sums of what is sharp and of what is blurred, each smoothed by its footprints, to the picture.
// render/accumulate/footprints.hpp
#include "shared/accumulate_types.h"

layout(binding = kSharp) uniform sampler2D sharpSum;
layout(binding = kFineBehind) uniform sampler2D fineBehindSum;
layout(binding = kCoarseBehind) uniform sampler2D coarseBehindSum;
#ifdef IN_FRONT
layout(binding = kFineInFront) uniform sampler2D fineInFrontSum;
layout(binding = kCoarseInFront) uniform sampler2D coarseInFrontSum;
#endif
uniform float scale;

layout(location = 0) out vec4 radiance;

const float kNothing = 1e-6;  // a share of all lookups of which nothing can be said

// A level's texels under a cubic B-spline, by four bilinear fetches.
vec4 smoothed(sampler2D sums, int level) {
    vec2 size = vec2(textureSize(sums, level));
    vec2 at = gl_FragCoord.xy / vec2(textureSize(sums, 0)) * size - 0.5;
    vec2 whole = floor(at), t = at - whole, s = 1.0 - t;
    vec2 w0 = s * s * s / 6.0, w1 = (4.0 - 6.0 * t * t + 3.0 * t * t * t) / 6.0, w3 = t * t * t / 6.0;
    vec2 before = w0 + w1, after = 1.0 - before;
    vec2 a = (whole - 0.5 + w1 / before) / size, b = (whole + 1.5 + w3 / after) / size;
    float lod = float(level);
    vec4 above = mix(textureLod(sums, b, lod), textureLod(sums, vec2(a.x, b.y), lod), before.x);
    vec4 below = mix(textureLod(sums, vec2(b.x, a.y), lod), textureLod(sums, a, lod), before.x);
    return scale * mix(above, below, before.y);
}

// As much of it as is seen at the pixel, in the mean colour around it.
vec4 recoloured(sampler2D sums, int level) {
    vec4 own = scale * texelFetch(sums, ivec2(gl_FragCoord.xy), 0), around = smoothed(sums, level);
    return around.a < kNothing ? own : vec4(around.rgb * (own.a / around.a), own.a);
}

void main() {
    vec4 sum = scale * texelFetch(sharpSum, ivec2(gl_FragCoord.xy), 0) + recoloured(fineBehindSum, kFineLevel) +
               recoloured(coarseBehindSum, kCoarseLevel);
    vec3 color = sum.rgb / max(sum.a, kNothing);
#ifdef IN_FRONT
    // What is in front hides so much of the rest.
    vec4 inFront = smoothed(fineInFrontSum, kFineLevel) + smoothed(coarseInFrontSum, kCoarseLevel);
    color = sum.a < kNothing ? inFront.rgb / max(inFront.a, kNothing)
                             : inFront.rgb + max(1.0 - inFront.a, 0.0) * color;
#endif
    radiance = vec4(color, 1.0);
}
