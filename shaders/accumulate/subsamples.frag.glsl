// Each primary sample's picture, and what its sub-samples see of it: the sum over a group of samples.
// render/accumulate/subsample_blur.hpp; with WIDE, and with IN_FRONT, in parts by their footprints: footprints.hpp.
#include "shared/accumulate_types.h"
#include "shared/scene_types.h"

layout(binding = 0) uniform sampler2DArray colors;
layout(binding = 1) uniform sampler2DArray depths;
layout(binding = 2) uniform sampler2DArray bounds;  // CoC radii of a tile's lookups
uniform int count;                                  // layers
uniform int firstOffset[kMostMatrices + 1];
uniform vec2 offsets[kMostOffsets];  // of the sub-samples from their primary, in lens radii; y in the pixels' ratio
uniform float farthest;              // the longest of all
uniform vec2 coc;                    // CoC radius = x * depth + y

// Variances of footprints, px²: x of a CoC radius of 1 px, y from where on they are not narrow; z and w, those of the
// fine and of the coarse parts.
uniform vec4 variances;

// Sums of colours, and in alpha of how many
layout(location = kSharp) out vec4 sharp;
#ifdef WIDE
layout(location = kFineBehind) out vec4 fineBehind;
layout(location = kCoarseBehind) out vec4 coarseBehind;
#endif
#ifdef IN_FRONT
layout(location = kFineInFront) out vec4 fineInFront;
layout(location = kCoarseInFront) out vec4 coarseInFront;
#endif

// A surface within so many pixels of the ray is hit. A surface that the ray meets is met within half a step of a pixel.
const float kTolerance = 0.75;
const int kMostSteps = 32;

ivec3 texelAt(vec2 position, int layer) {
    return ivec3(clamp(ivec2(position), ivec2(0), textureSize(depths, 0).xy - 1), layer);
}
float radiusAt(vec2 position, int layer) { return coc.x * texelFetch(depths, texelAt(position, layer), 0).r + coc.y; }

// Where the layer has what is seen at `pixel` through the point of the lens that is `offset` away from its own, and the
// CoC radius that is there. The search only looks at depths: software renderers run both sides of every branch.
vec3 place(vec2 pixel, int layer, vec2 offset, vec2 radii) {
    float perRadius = max(abs(offset.x), abs(offset.y));  // pixels along the ray for one of CoC radius
    float length = (radii.y - radii.x) * perRadius;
    bool found = length < kTolerance;
    float middle = 0.5 * (radii.x + radii.y);
    vec3 at = vec3(pixel - middle * offset, 0.0);
    at.z = radiusAt(at.xy, layer);
    int steps = min(int(ceil(length)), kMostSteps);
    float stride = (radii.y - radii.x) / float(max(steps, 1));
    float tolerance = max(kTolerance, 0.75 * abs(stride) * perRadius) / max(perRadius, 1e-9);
    // The nearest bound is before all there is: but for rounding, the first place is behind.
    vec3 behind = vec3(pixel, radii.x);
    for (int i = 0; i <= steps && !found; ++i) {
        float radius = radii.x + float(i) * stride;
        at.xy = pixel - radius * offset;
        at.z = radiusAt(at.xy, layer);
        float difference = at.z - radius;
        found = abs(difference) <= tolerance;
        if (difference > 0.0) behind = at;
    }
    // The texel's middle: next to it is what hides the rest.
    return found ? at : vec3(floor(behind.xy) + 0.5, behind.z);
}

// A blended surface is not where what is behind it is: of a color with that alpha, which such surfaces leave of what has
// a depth, so much moves and blurs with that. From alpha 0.5 of theirs on nothing does.
float ofDepth(float alpha) { return smoothstep(0.5, 1.0, alpha); }

void add(vec4 seen, float radius) {
    vec4 one = vec4(seen.rgb, 1.0);
#ifdef WIDE
    float variance = radius * radius * variances.x;
    float wide = ofDepth(seen.a) * clamp((variance - variances.y) / (variances.z - variances.y), 0.0, 1.0);
    float coarse = ofDepth(seen.a) * clamp((variance - variances.z) / (variances.w - variances.z), 0.0, 1.0);
    sharp += (1.0 - wide) * one;
    vec4 fineShare = (wide - coarse) * one, coarseShare = coarse * one;
#ifdef IN_FRONT
    float inFront = radius < 0.0 ? 1.0 : 0.0;
    fineInFront += inFront * fineShare;
    coarseInFront += inFront * coarseShare;
    fineShare *= 1.0 - inFront;
    coarseShare *= 1.0 - inFront;
#endif
    fineBehind += fineShare;
    coarseBehind += coarseShare;
#else
    sharp += one;
#endif
}

void main() {
    // Beyond the picture, where there is more of the sum, it is mirrored.
    vec2 size = vec2(textureSize(depths, 0).xy);
    vec2 pixel = max(min(gl_FragCoord.xy, 2.0 * size - gl_FragCoord.xy), vec2(0.5));
    sharp = vec4(0.0);
#ifdef WIDE
    fineBehind = coarseBehind = vec4(0.0);
#endif
#ifdef IN_FRONT
    fineInFront = coarseInFront = vec4(0.0);
#endif
    for (int layer = 0; layer < count; ++layer) {
        vec4 own = texelFetch(colors, texelAt(pixel, layer), 0);
        vec2 radii = texelFetch(bounds, ivec3(ivec2(pixel) / kTileSide, layer), 0).rg;
        int from = firstOffset[layer], to = firstOffset[layer + 1];
        float largest = max(abs(radii.x), abs(radii.y));
        // All lookups would find the pixel itself, and none is wide.
        if (largest * farthest < 0.5 && largest * largest * variances.x <= variances.y) {
            sharp += vec4(own.rgb, 1.0) * float(to - from + 1);
            continue;
        }
        float ownRadius = radiusAt(pixel, layer);
        add(own, ownRadius);
        for (int i = from; i < to; ++i) {
            vec3 found = place(pixel, layer, offsets[i], radii);
            // Between texels: nearest ones gave SSIM 0.980 to the reference where linear ones gave 0.984.
            vec4 seen = textureLod(colors, vec3(found.xy / size, layer), 0.0);
            float moves = ofDepth(min(seen.a, own.a));
            add(mix(own, seen, moves), mix(ownRadius, found.z, moves));
        }
    }
}
