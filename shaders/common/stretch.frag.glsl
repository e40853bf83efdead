// A picture at another size, filtered.
layout(binding = 0) uniform sampler2D picture;
uniform vec2 size;  // of the target, pixels

layout(location = 0) out vec4 radiance;

void main() { radiance = vec4(textureLod(picture, gl_FragCoord.xy / size, 0.0).rgb, 1.0); }
