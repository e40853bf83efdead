// Each primary sample's picture, and what its sub-samples see of it: the sum over a group of samples.
// render/accumulate/subsample_blur.hpp
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

layout(location = 0) out vec4 sum;

// A surface within so many pixels of the ray is hit. A surface that the ray meets is met within half a step of a pixel.
const float kTolerance = 0.75;
const int kMostSteps = 32;

ivec3 texelAt(vec2 position, int layer) {
    return ivec3(clamp(ivec2(position), ivec2(0), textureSize(depths, 0).xy - 1), layer);
}
float radiusAt(vec2 position, int layer) { return coc.x * texelFetch(depths, texelAt(position, layer), 0).r + coc.y; }

// Where the layer has what is seen at `pixel` through the point of the lens that is `offset` away from its own. The
// search only looks at depths: software renderers run both sides of every branch.
vec2 place(vec2 pixel, int layer, vec2 offset, vec2 radii) {
    float perRadius = max(abs(offset.x), abs(offset.y));  // pixels along the ray for one of CoC radius
    float length = (radii.y - radii.x) * perRadius;
    bool found = length < kTolerance;
    vec2 at = pixel - 0.5 * (radii.x + radii.y) * offset;
    int steps = min(int(ceil(length)), kMostSteps);
    float stride = (radii.y - radii.x) / float(max(steps, 1));
    float tolerance = max(kTolerance, 0.75 * abs(stride) * perRadius) / perRadius;
    vec2 behind = pixel;  // the nearest bound is before all there is: but for rounding, the first place is behind
    for (int i = 0; i <= steps && !found; ++i) {
        float radius = radii.x + float(i) * stride;
        at = pixel - radius * offset;
        float difference = radiusAt(at, layer) - radius;
        found = abs(difference) <= tolerance;
        if (difference > 0.0) behind = at;
    }
    // The texel's middle: next to it is what hides the rest.
    return found ? at : floor(behind) + 0.5;
}

// Between texels: nearest ones gave SSIM 0.980 to the reference where linear ones gave 0.984.
vec3 lookup(vec2 pixel, int layer, vec2 offset, vec2 radii) {
    vec2 at = place(pixel, layer, offset, radii);
    return texture(colors, vec3(at / vec2(textureSize(colors, 0).xy), layer)).rgb;
}

void main() {
    vec2 pixel = gl_FragCoord.xy;
    sum = vec4(0.0);
    for (int layer = 0; layer < count; ++layer) {
        vec3 own = texelFetch(colors, texelAt(pixel, layer), 0).rgb;
        vec2 radii = texelFetch(bounds, ivec3(ivec2(pixel) / kTileSide, layer), 0).rg;
        int from = firstOffset[layer], to = firstOffset[layer + 1];
        sum.rgb += own;
        if (max(abs(radii.x), abs(radii.y)) * farthest < 0.5) {
            sum.rgb += own * float(to - from);
            continue;
        }
        for (int i = from; i < to; ++i) sum.rgb += lookup(pixel, layer, offsets[i], radii);
    }
}
