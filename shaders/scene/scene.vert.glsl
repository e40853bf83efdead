// All geometry goes through here: clip position, and what the fragment stage needs in view space.
#ifdef LAYERED
#extension GL_ARB_shader_viewport_layer_array : require
#endif
#include "shared/scene_types.h"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 tangent;
layout(location = 3) in vec2 uv;
layout(location = 4) in uint drawIndex;  // one per draw, by the base instance
#ifdef EXTRAS
layout(location = 5) in vec2 uv1;
layout(location = 6) in vec4 color;
#endif

layout(std430, binding = 0) readonly buffer Instances { InstanceData instances[]; };
#ifdef MAPPED
layout(std430, binding = 1) readonly buffer Materials { MaterialData materials[]; };
#endif

uniform mat4 clipFromView[kMostMatrices];
#ifdef LAYERED
uniform int firstLayer;
#endif

#define STAGE out
#include "scene/varyings.glsl"

void main() {
    mat4 viewFromMesh = instances[drawIndex].viewFromMesh;
    material = instances[drawIndex].material.x;
    vec4 viewPosition = viewFromMesh * vec4(position, 1.0);
#ifdef MAPPED
    // Not per pixel: pixels of a quad that a triangle does not cover may read no buffer, and the level of a texture
    // hangs on them.
    for (int slot = 0; slot < kMaterialTextures; ++slot) {
        vec4 linear = materials[material].uvLinear[slot], offset = materials[material].uvOffset[slot];
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
