// Stages that follow from the depth buffer alone (show_pass.hpp).
layout(binding = 0) uniform sampler2D depth;
uniform int mode;    // 0 vergence, 1 signed CoC, 2 degree of blur
uniform vec2 coc;    // radius in pixels = x * depth + y (optics/lens.hpp)
uniform float near;  // metres: vergence = depth / near

layout(location = 0) out vec4 color;

const float kFullRadius = 16.0;

void main() {
    float z = texelFetch(depth, ivec2(gl_FragCoord.xy), 0).r;
    float vergence = z / near;
    float c = clamp((coc.x * z + coc.y) / kFullRadius, -1.0, 1.0);
    if (mode == 0) color = vec4(vec3(vergence / (1.0 + vergence)), 1.0);
    if (mode == 1) color = vec4(c < 0.0 ? vec3(-c, c * c * c * c, c * c * c * c) : vec3(c * c * c * c, c * c * c * c, c), 1.0);
    if (mode == 2) color = vec4(vec3(abs(c)), 1.0);
}
