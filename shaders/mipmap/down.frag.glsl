// One level down: binomial [1 3 3 1]², a 3×3 Gaussian centred on the coarse texel, by four bilinear taps.
layout(binding = 0) uniform sampler2DArray layers;
#ifdef FRONT
layout(binding = 1) uniform sampler2D spread;
#endif
uniform vec2 targetSize;

layout(location = 0) out vec4 base;
#ifdef FRONT
layout(location = 1) out vec4 front;
layout(location = 2) out vec4 back;
layout(location = 3) out vec4 spreadOut;
#endif

void main() {
    vec2 uv = gl_FragCoord.xy / targetSize;
    vec2 d = 0.75 / vec2(textureSize(layers, 0).xy);
    base = vec4(0.0);
#ifdef FRONT
    front = vec4(0.0);
    back = vec4(0.0);
    spreadOut = vec4(0.0);
#endif
    for (int i = 0; i < 4; ++i) {
        vec2 at = uv + vec2((i & 1) == 0 ? -d.x : d.x, i < 2 ? -d.y : d.y);
        base += textureLod(layers, vec3(at, 0.0), 0.0) * 0.25;
#ifdef FRONT
        front += textureLod(layers, vec3(at, 1.0), 0.0) * 0.25;
        back += textureLod(layers, vec3(at, 2.0), 0.0) * 0.25;
        spreadOut.y += textureLod(spread, at, 0.0).y * 0.25;
        // The maximum is of all 4×4 texels: an odd size must not lose a row.
        vec4 four = textureGather(spread, at, 0);
        spreadOut.x = max(spreadOut.x, max(max(four.x, four.y), max(four.z, four.w)));
#endif
    }
}
