// Multisample resolve: mean radiance, nearest depth (see geometry_pass.hpp for why).
layout(binding = 0) uniform sampler2DMS samplesColor;
layout(binding = 1) uniform sampler2DMS samplesDepth;
uniform int samples;

layout(location = 0) out vec4 radiance;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec3 sum = vec3(0.0);
    float nearest = 0.0;
    for (int i = 0; i < samples; ++i) {
        sum += texelFetch(samplesColor, pixel, i).rgb;
        nearest = max(nearest, texelFetch(samplesDepth, pixel, i).r);
    }
    radiance = vec4(sum / float(samples), 1.0);
    gl_FragDepth = nearest;
}
