// All geometry goes through here: clip position, and what the fragment stage needs in view space.
#ifdef LAYERED
#extension GL_ARB_shader_viewport_layer_array : require
#endif
#include "shared/scene_types.h"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 tangent;
layout(location = 3) in vec2 uv;
// One per draw, by the base instance; eye-relative, so that a scene far from the origin keeps its digits
layout(location = 4) in mat4 viewFromMesh;
#ifdef EXTRAS
layout(location = 8) in vec2 uv1;
layout(location = 9) in vec4 color;
#endif

#ifdef MAPPED
layout(std140, binding = 0) uniform Material { MaterialData material; };
#endif

uniform mat4 clipFromView[kMostMatrices];
#ifdef LAYERED
uniform int firstLayer;
#endif

#define STAGE out
#include "scene/varyings.glsl"

void main() {
    vec4 viewPosition = viewFromMesh * vec4(position, 1.0);
#ifdef MAPPED
    for (int slot = 0; slot < kMaterialTextures; ++slot) {
        vec4 linear = material.uvLinear[slot], offset = material.uvOffset[slot];
#ifdef EXTRAS
        vec2 from = offset.z > 0.5 ? uv1 : uv;
#else
        vec2 from = offset.z > 0.5 ? vec2(0.0) : uv;
#endif
        surface.uv[slot] = linear.xy * from.x + linear.zw * from.y + offset.xy;
    }
#else
    surface.uv = uv;
#endif
#ifdef EXTRAS
    surface.color = color;
#endif
#ifdef LIT
    surface.viewPosition = viewPosition.xyz;
    // Cofactors: right for any scale, its sign included.
    mat3 m = mat3(viewFromMesh);
    surface.normal = mat3(cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])) * normal * sign(determinant(m));
    surface.tangent = vec4(m * tangent.xyz, tangent.w * sign(determinant(m)));
#endif
    gl_Position = clipFromView[gl_InstanceID] * viewPosition;
#ifdef LAYERED
    gl_Layer = firstLayer + gl_InstanceID;
#endif
}
