// Base colour and opacity of a surface, and which texels are there: for what shades and for depth alone.
// MASK: none below the cut-off. SOLID and BLEND: a blended surface's opaque texels, and the others.
#include "shared/scene_types.h"
#define STAGE in
#include "scene/varyings.glsl"

// Texels of a blended surface this opaque hide what is behind them: half a step of 8 bits below 1.
const float kSolidAlpha = 0.998;

layout(std430, binding = 1) readonly buffer Materials { MaterialData materials[]; };

layout(binding = 0) uniform sampler2D baseColorTexture;

/// Where one of the material's textures is read.
vec2 uvOf(int slot) {
#ifdef MAPPED
    return surface.uv[slot];
#else
    return surface.uv;
#endif
}

vec4 baseColorOf(MaterialData m) {
    vec4 color = m.baseColor * texture(baseColorTexture, uvOf(kBaseColor));
#ifdef EXTRAS
    color *= surface.color;
#endif
#ifdef MASK
    if (color.a < m.surface.z) discard;
#endif
#ifdef SOLID
    if (color.a < kSolidAlpha) discard;
#endif
#ifdef BLEND
    if (color.a >= kSolidAlpha) discard;
#endif
    return color;
}
