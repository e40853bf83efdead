// Radiance of a surface: unlit, or metallic-roughness under punctual lights and a soft sky (glTF 2.0, appendix B).
// Without LIT the base colour is the radiance; with EMISSIVE the emission is added. SURFACE_MAP, NORMAL_MAP, OCCLUSION:
// the material has that texture.
#include "scene/base_color.glsl"
#include "scene/brdf.glsl"

layout(std430, binding = 0) readonly buffer Lights { LightData lights[]; };

layout(binding = 1) uniform sampler2D metallicRoughnessTexture;
layout(binding = 2) uniform sampler2D normalTexture;
layout(binding = 3) uniform sampler2D emissiveTexture;
layout(binding = 4) uniform sampler2D occlusionTexture;

uniform int lightCount;
uniform vec4 up;           // xyz: the world's up in view space; w: the sky's radiance at the zenith
uniform float exposure;    // radiance is scaled by it here, so that half floats keep their digits

layout(location = 0) out vec4 radiance;

#ifdef LIT
vec3 shadingNormal() {
    vec3 n = normalize(surface.normal) * (gl_FrontFacing ? 1.0 : -1.0);
#ifdef NORMAL_MAP
    vec3 t = surface.tangent.xyz - n * dot(n, surface.tangent.xyz);
    if (dot(t, t) > 1e-20) {
        t = normalize(t);
        vec3 b = cross(n, t) * surface.tangent.w;
        vec3 local = readTexture(normalTexture, uvOf(kNormal)).xyz * 2.0 - 1.0;
        local.xy *= material.emissive.w;
        n = normalize(mat3(t, b, n) * local);
    }
#endif
    return n;
}

vec3 lit(vec3 baseColor) {
    float metallic = material.surface.x;
    float roughness = material.surface.y;
#ifdef SURFACE_MAP
    vec4 mr = readTexture(metallicRoughnessTexture, uvOf(kMetallicRoughness));
    metallic *= mr.b;
    roughness *= mr.g;
#endif
    vec3 n = shadingNormal();
    vec3 v = normalize(-surface.viewPosition);
    Reflectance r = reflectance(baseColor, metallic, roughness, max(dot(n, v), 1e-4));
    vec3 sum = r.diffuse * sky(n, up) + r.environment * sky(reflect(-v, n), up);
#ifdef OCCLUSION
    // glTF 2.0, 3.9.3: of indirect light only
    sum *= 1.0 + material.light.x * (readTexture(occlusionTexture, uvOf(kOcclusion)).r - 1.0);
#endif
    for (int i = 0; i < lightCount; ++i) {
        vec3 l;
        vec3 irradiance = incoming(lights[i], surface.viewPosition, n, l);
        sum += irradiance * brdf(r, n, v, l);
    }
    return sum;
}
#endif

void main() {
    vec4 baseColor = baseColorOf();
#ifdef LIT
    vec3 color = lit(baseColor.rgb);
#else
    vec3 color = baseColor.rgb;
#endif
#ifdef EMISSIVE
    color += material.emissive.rgb * readTexture(emissiveTexture, uvOf(kEmissive)).rgb;
#endif
    // Half floats end at 65504; NaN (0/0 in a degenerate triangle) becomes black by the order of max's arguments. Black
    // is less than any half float, but not 0: --show lod makes all shine.
    const float kBlack = 1e-24;
    radiance = vec4(min(max(vec3(kBlack), color) * exposure, vec3(65504.0)), 1.0);
#ifdef BLEND
    radiance *= baseColor.a;  // premultiplied: what is behind keeps 1 - alpha
#endif
}
