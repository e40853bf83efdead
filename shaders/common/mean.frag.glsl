// The sum to the picture.
layout(binding = 0) uniform sampler2D sum;
uniform float scale;

layout(location = 0) out vec4 radiance;

void main() { radiance = vec4(texelFetch(sum, ivec2(gl_FragCoord.xy), 0).rgb * scale, 1.0); }
