// Stages of the mipmap technique as pictures (mipmap.hpp): 0 degree of foreground neighbours' blur, white from a radius
// of 16 px on; 1 level of the blur, white at the 5th; 2 a level of the pyramid, texel by texel.
#include "mipmap/layers.glsl"
layout(binding = 0) uniform sampler2D depth;
layout(binding = 1) uniform sampler2D reach;
layout(binding = 2) uniform sampler2DArray layers;
uniform int mode;
uniform int front;  // 0: no foreground in view
uniform int level;
uniform vec2 size;  // of the picture

layout(location = 0) out vec4 color;

const float kWhiteRadius = 16.0;
const float kWhiteLevel = 5.0;

ivec2 texelOf(ivec2 texels) { return min(ivec2(gl_FragCoord.xy / size * vec2(texels)), texels - 1); }

void main() {
    float near = front != 0 ? texelFetch(reach, texelOf(textureSize(reach, 0)), 0).x : 0.0;
    if (mode == 0) {
        color = vec4(vec3(min(near / kWhiteRadius, 1.0)), 1.0);
    } else if (mode == 1) {
        // A whole disc's sigma is a quarter of its diameter.
        float sigma = 0.5 * max(abs(cocRadius(texelFetch(depth, ivec2(gl_FragCoord.xy), 0).r)), near);
        color = vec4(vec3(min(levelForSigma(sigma) / kWhiteLevel, 1.0)), 1.0);
    } else {
        ivec2 texel = texelOf(textureSize(layers, level).xy);
        vec4 base = texelFetch(layers, ivec3(texel, 0), level);
        vec3 rgb = base.a > 0.0 ? base.rgb / base.a : vec3(0.0);
        if (front != 0) {
            vec4 over = texelFetch(layers, ivec3(texel, 1), level);
            rgb = over.rgb + (1.0 - over.a) * rgb;
        }
        color = vec4(min(rgb, vec3(65504.0)), 1.0);
    }
}
