// Stages that follow from the depth buffer alone (show_pass.hpp).
layout(binding = 0) uniform sampler2D depth;
uniform int mode;       // 0 vergence, 1 signed CoC, 2 degree of blur
uniform vec2 coc;       // radius in pixels = x * depth + y (optics/lens.hpp)
uniform float largest;  // what is drawn white

layout(location = 0) out vec4 color;

void main() {
    float z = texelFetch(depth, ivec2(gl_FragCoord.xy), 0).r;
    float c = (mode == 0 ? z : coc.x * z + coc.y) / largest;
    vec3 shown = vec3(abs(c));
    if (mode == 1) shown = c < 0.0 ? vec3(-c, c * c, c * c) : vec3(c * c, c * c, c);
    color = vec4(min(shown, vec3(1.0)), 1.0);
}
