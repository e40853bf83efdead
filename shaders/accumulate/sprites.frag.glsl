// A sample begins with the rendering that it shares with others.
#include "shared/scene_types.h"

layout(binding = 0) uniform sampler2DArray colors;
layout(binding = 1) uniform sampler2DArray depths;
uniform int spriteOf[kMostMatrices];  // of each sample

layout(location = 0) out vec4 color;

void main() {
    ivec3 texel = ivec3(gl_FragCoord.xy, spriteOf[gl_Layer]);
    color = texelFetch(colors, texel, 0);
    gl_FragDepth = texelFetch(depths, texel, 0).r;
}
