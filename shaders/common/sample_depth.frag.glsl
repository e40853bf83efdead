// Depth at places evenly spread over a picture (frame/vergence_sampler.hpp).
#ifdef ARRAY
layout(binding = 0) uniform sampler2DArray depth;
#else
layout(binding = 0) uniform sampler2D depth;
#endif
uniform vec2 places;

layout(location = 0) out float stored;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy / places * vec2(textureSize(depth, 0).xy));
#ifdef ARRAY
    stored = texelFetch(depth, ivec3(at, 0), 0).r;
#else
    stored = texelFetch(depth, at, 0).r;
#endif
}
