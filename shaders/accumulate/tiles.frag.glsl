// The least and greatest depth in each tile of a layer.
#include "shared/accumulate_types.h"

layout(binding = 0) uniform sampler2DArray depths;

layout(location = 0) out vec2 bounds;

void main() {
    ivec2 first = ivec2(gl_FragCoord.xy) * kTileSide, last = textureSize(depths, 0).xy - 1;
    bounds = vec2(1e30, 0.0);
    for (int y = 0; y < kTileSide; ++y)
        for (int x = 0; x < kTileSide; ++x) {
            float z = texelFetch(depths, ivec3(min(first + ivec2(x, y), last), gl_Layer), 0).r;
            bounds = vec2(min(bounds.x, z), max(bounds.y, z));
        }
}
