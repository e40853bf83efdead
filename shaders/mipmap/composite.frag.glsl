// Full size: in focus the pixel itself, else the blur behind it; the foreground's blur over that.
#include "mipmap/layers.glsl"
layout(binding = 0) uniform sampler2D color;
layout(binding = 1) uniform sampler2D depth;
layout(binding = 2) uniform sampler2D behind;
#ifdef FRONT
layout(binding = 3) uniform sampler2D front;
#endif

layout(location = 0) out vec4 result;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float c = cocRadius(texelFetch(depth, pixel, 0).r);
    vec3 rgb = texelFetch(color, pixel, 0).rgb;
    vec2 uv = gl_FragCoord.xy * 0.5 / vec2(textureSize(behind, 0));
    vec4 blurred = textureLod(behind, uv, 0.0);
    float share = blurShare(c);
#ifdef FRONT
    share = max(share, frontShare(c));
#endif
    if (blurred.a > 1e-3) rgb = mix(rgb, blurred.rgb / blurred.a, share);
#ifdef FRONT
    vec4 over = textureLod(front, uv, 0.0);
    rgb = over.rgb + (1.0 - over.a) * rgb;
#endif
    result = vec4(min(rgb, vec3(65504.0)), 1.0);
}
