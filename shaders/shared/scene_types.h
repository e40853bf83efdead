// Structs of the scene's buffers, read by C++ and GLSL alike (std140 and std430 alike: vec4 members only).
#ifdef __cplusplus
#pragma once
#include <glm/glm.hpp>
namespace dioptre::gpu {
using glm::vec4;
#endif

// Lens samples that one submission of the geometry can draw, each to a layer.
const int kMostMatrices = 4;

// A material's textures, in the order of their units.
const int kBaseColor = 0, kMetallicRoughness = 1, kNormal = 2, kEmissive = 3, kOcclusion = 4;
const int kMaterialTextures = 5;

struct MaterialData {
    vec4 baseColor;
    vec4 emissive;  // rgb: radiance; w: normal map's scale
    vec4 surface;   // x: metallic, y: roughness, z: alpha cut-off, w unused
    vec4 light;     // x: occlusion's strength
    // How each texture is read (KHR_texture_transform): uv = mat2(xy, zw) * the vertex's + xy, its second set if z is 1.
    vec4 uvLinear[kMaterialTextures];
    vec4 uvOffset[kMaterialTextures];
    vec4 unused[2];  // to 256 bytes, at which any uniform block may begin
};

struct LightData {
    vec4 position;   // xyz: view space, metres; w: kind (0 directional, 1 point, 2 spot)
    vec4 direction;  // xyz: view space, the way the light travels; w: range in metres, 0 without limit
    vec4 color;      // rgb: lux (directional) or candela; w unused
    vec4 cone;       // x: cosine of the inner angle, y: of the outer
};

#ifdef __cplusplus
static_assert(sizeof(MaterialData) == 256 && sizeof(LightData) == 64);
}  // namespace dioptre::gpu
#endif
