// Four times the difference of two pictures as a screen shows them.
#include "present/srgb.glsl"

layout(binding = 0) uniform sampler2D first;   // linear
layout(binding = 1) uniform sampler2D second;  // linear, same size
uniform vec2 origin;  // of the picture in the target, pixels
uniform vec2 size;    // of the picture in the target, pixels

layout(location = 0) out vec4 color;

void main() {
    vec2 at = (gl_FragCoord.xy - origin) / size;
    vec3 a = sRgb(textureLod(first, at, 0.0).rgb), b = sRgb(textureLod(second, at, 0.0).rgb);
    color = vec4(4.0 * abs(a - b), 1.0);
}
