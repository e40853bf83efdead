// Base colour and opacity of a surface, and which texels are there: for what shades and for depth alone.
// MASK: none below the cut-off. SOLID and BLEND: a blended surface's opaque texels, and the others.
#include "shared/scene_types.h"
#define STAGE in
#include "scene/varyings.glsl"

// Texels of a blended surface this opaque hide what is behind them: half a step of 8 bits below 1.
const float kSolidAlpha = 0.998;

layout(std140, binding = 0) uniform Material { MaterialData material; };

layout(binding = 0) uniform sampler2D baseColorTexture;

#ifdef SPACED
// By depth: how many times as coarsely as the sampler says what is blurred is read, where that is more than 1.
uniform vec2 textureSpacing;

vec4 readTexture(sampler2D t, vec2 uv) {
    return texture(t, uv, log2(max(1.0, abs(textureSpacing.x * gl_FragCoord.z + textureSpacing.y))));
}
#else
vec4 readTexture(sampler2D t, vec2 uv) { return texture(t, uv); }
#endif

/// Where one of the material's textures is read.
vec2 uvOf(int slot) {
#ifdef MAPPED
    return surface.uv[slot];
#else
    return surface.uv;
#endif
}

vec4 baseColorOf() {
    vec4 color = material.baseColor * readTexture(baseColorTexture, uvOf(kBaseColor));
#ifdef EXTRAS
    color *= surface.color;
#endif
#ifdef MASK
    if (color.a < material.surface.z) discard;
#endif
#ifdef SOLID
    if (color.a < kSolidAlpha) discard;
#endif
#ifdef BLEND
    if (color.a >= kSolidAlpha) discard;
#endif
    return color;
}
