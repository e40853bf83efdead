// The blur, at half size: what lies behind, over its own circle of confusion; and the foreground over it.
#include "mipmap/layers.glsl"
#include "mipmap/taps.glsl"

layout(binding = 0) uniform sampler2DArray layers;  // base, front, back
layout(binding = 1) uniform sampler2D depth;        // full size
#ifdef FRONT
layout(binding = 2) uniform sampler2D spread;
layout(binding = 3) uniform sampler2D reach;
uniform vec2 reachScale;  // texels of `reach` per texel of the target
#endif

layout(location = 0) out vec4 behind;  // rgb·valid, valid
#ifdef FRONT
layout(location = 1) out vec4 front;   // rgb·coverage, coverage

// Softness of the edge of a tap's reach, in radii: the width of a tap.
const float kReachSoftness = 0.3;
// A small circle's taps stand for more than their share of a large one's; at most by this factor.
const float kMostAreaRatio = 4.0;
// Coverage × this is full: what the foreground hides is taken from the finest level that shows a little of it.
const float kFillGain = 8.0;
const int kFillLevels = 4;
// Half-size texels per px of radius for which one tap alone has a disc's variance: r²/4 = kTapVariance (2 s)².
const float kOneTapPerRadius = 0.39;

/// The rest of the picture at a place that a foreground with taps at `level` hides: of so many levels the finest that
/// has something here, but no finer than its own blur asks for.
vec4 hidden(vec2 uv, float level, int levels) {
    float seen = textureLod(layers, vec3(uv, 2.0), level + 1.0).a;
    float radius = radiusOfBaseWeight(textureLod(layers, vec3(uv, 0.0), level + 1.0).a / max(seen, 1e-3), baseLargest);
    float finest = max(floor(log2(kOneTapPerRadius * radius + 1e-6) + 0.5), 0.0);
    // As far as the blur sees past the edge of what hides: texels of the last level are as large as its circle.
    float step = max(floor((level + 3.0 - finest) / float(kFillLevels - 1) + 0.5), 1.0);
    vec4 sum = vec4(0.0);
    for (int i = 0; i < levels; ++i) {
        vec4 t = textureLod(layers, vec3(uv, 2.0), finest + step * float(i));
        sum += vec4(t.rgb / max(t.a, 1e-3), 1.0) * (1.0 - sum.a) * clamp(t.a * kFillGain, 0.0, 1.0);
    }
    return sum.a > 1e-3 ? vec4(sum.rgb / sum.a, 1.0) : vec4(0.0);
}

/// Colour and coverage of what is nearer than `mine` (0: not in front itself), over the circle of radius r.
vec4 nearerForeground(vec2 uv, vec2 texel, float r, float mine) {
    float level = tapLevel(r);
    float circle = tapCircle(r, level);
    int n = spreadsOver(r, mine) ? kTaps : 0;
    vec4 sum = vec4(0.0);
    for (int i = 0; i < n; ++i) {
        vec2 at = uv + kDisc[i] * circle * texel;
        vec4 t = textureLod(layers, vec3(at, 1.0), level);
        float c = textureLod(spread, at, level).y / max(t.a, 1e-4);
        float isNearer = mine > 0.0 ? smoothstep(mine, mine * kNearerRatio, c) : 1.0;
        float reaches = clamp((c - length(kDisc[i]) * circle * 2.0) / (kReachSoftness * r) + 0.5, 0.0, 1.0);
        sum += t * isNearer * reaches * min(r * r / max(c * c, 1e-3), kMostAreaRatio);
    }
    sum /= float(kTaps);
    return sum / max(sum.a, 1.0);
}
#endif

void main() {
    vec2 texel = 1.0 / vec2(textureSize(layers, 0).xy);
    vec2 uv = gl_FragCoord.xy * texel;
    vec4 z = textureGather(depth, (floor(gl_FragCoord.xy) * 2.0 + 1.0) / vec2(textureSize(depth, 0)));
    float nearest = cocRadius(max(max(z.x, z.y), max(z.z, z.w)));
    float farthest = cocRadius(min(min(z.x, z.y), min(z.z, z.w)));
#ifdef FRONT
    bool inFront = frontShare(nearest) > 0.5;
#else
    const bool inFront = false;
#endif

    // Its own layer, over its own circle
    float r = inFront ? -nearest : max(abs(nearest), abs(farthest));
    float level = tapLevel(r);
    float circle = tapCircle(r, level);
    float layer = inFront ? 1.0 : 0.0;
    float least = inFront ? 1.0 : max(baseWeight(r, baseLargest), kLeastWeight);
    int n = r > kSharpRadius ? kTaps : 0;
    vec4 own = vec4(0.0);
    for (int i = 0; i < n; ++i) {
        vec4 t = textureLod(layers, vec3(uv + kDisc[i] * circle * texel, layer), level);
        // Behind focus a tap counts by how much of it is as blurred as this; in front by its coverage.
        own += t / max(t.a, least);
    }
    behind = own.a > 1e-3 ? vec4(own.rgb / own.a, 1.0) * clamp(r - kSharpRadius, 0.0, 1.0) : vec4(0.0);
#ifdef FRONT
    // A loop of no rounds costs one where branches do not: CPU rasterisers run both sides of an if.
    vec4 rest = hidden(uv, level, inFront ? kFillLevels : 0);
    if (inFront) behind = rest;
    ivec2 tile = min(ivec2(gl_FragCoord.xy * reachScale), textureSize(reach, 0) - 1);
    vec4 nearer = nearerForeground(uv, texel, texelFetch(reach, tile, 0).x, inFront ? r : 0.0);
    front = nearer + (1.0 - nearer.a) * (inFront ? own / float(kTaps) : vec4(0.0));
#endif
}
