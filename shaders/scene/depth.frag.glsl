// Depth only; with MASK, texels below the cut-off are not there.
#ifdef MASK
#include "shared/scene_types.h"

in Surface {
    vec3 viewPosition;
    vec3 normal;
    vec4 tangent;
    vec2 uv;
} surface;
flat in uint material;
layout(std430, binding = 1) readonly buffer Materials { MaterialData materials[]; };
layout(binding = 0) uniform sampler2D baseColorTexture;

void main() {
    MaterialData m = materials[material];
    if (m.baseColor.a * texture(baseColorTexture, surface.uv).a < m.surface.z) discard;
}
#else
void main() {}
#endif
