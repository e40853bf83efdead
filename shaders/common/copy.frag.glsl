// One bilinear fetch per pixel: the unit in which passes are priced.
layout(binding = 0) uniform sampler2D source;
uniform vec2 size;
layout(location = 0) out vec4 color;

void main() { color = texture(source, gl_FragCoord.xy / size); }
