// The batch's samples to the sum, which blending adds up.
layout(binding = 0) uniform sampler2DArray samples;
uniform int count;

layout(location = 0) out vec4 sum;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    sum = vec4(0.0);
    for (int i = 0; i < count; ++i) sum += texelFetch(samples, ivec3(pixel, i), 0);
}
