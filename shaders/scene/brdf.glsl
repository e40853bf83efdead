// Walter, Marschner, Li, Torrance 2007: GGX. Heitz 2014: height-correlated Smith. Karis 2014: environment term.
const float kPi = 3.14159265358979;

struct Reflectance {
    vec3 diffuse;       // albedo of the diffuse part
    vec3 f0;            // specular reflectance at normal incidence
    vec3 environment;   // reflectance of an even environment
    float alpha;        // squared perceptual roughness
    float nv;
};

Reflectance reflectance(vec3 baseColor, float metallic, float roughness, float nv) {
    Reflectance r;
    r.f0 = mix(vec3(0.04), baseColor, metallic);
    r.diffuse = baseColor * (1.0 - metallic);
    // 0.045: below it the highlight of a point light leaves half-float precision.
    float perceptual = clamp(roughness, 0.045, 1.0);
    r.alpha = perceptual * perceptual;
    r.nv = nv;
    // Karis 2014, analytic fit of the pre-integrated GGX.
    vec4 k = perceptual * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
    float a004 = min(k.x * k.x, exp2(-9.28 * nv)) * k.x + k.y;
    vec2 ab = vec2(-1.04, 1.04) * a004 + k.zw;
    r.environment = r.f0 * ab.x + ab.y;
    return r;
}

/// Diffuse and specular together, times the cosine.
vec3 brdf(Reflectance r, vec3 n, vec3 v, vec3 l) {
    float nl = dot(n, l);
    if (nl <= 0.0) return vec3(0.0);
    vec3 h = normalize(v + l);
    float nh = max(dot(n, h), 0.0);
    float vh = max(dot(v, h), 0.0);
    float a2 = r.alpha * r.alpha;
    float q = nh * nh * (a2 - 1.0) + 1.0;
    float d = a2 / (kPi * q * q);
    float visibility = 0.5 / (nl * sqrt(r.nv * r.nv * (1.0 - a2) + a2) + r.nv * sqrt(nl * nl * (1.0 - a2) + a2));
    vec3 fresnel = r.f0 + (1.0 - r.f0) * pow(1.0 - vh, 5.0);
    return (r.diffuse * (1.0 - fresnel) / kPi + d * visibility * fresnel) * nl;
}

/// Irradiance on a surface facing the light, and the direction to it (KHR_lights_punctual).
vec3 incoming(LightData light, vec3 position, vec3 n, out vec3 l) {
    if (light.position.w < 0.5) {
        l = -light.direction.xyz;
        return light.color.rgb;
    }
    vec3 toLight = light.position.xyz - position;
    float d2 = max(dot(toLight, toLight), 1e-8);
    l = toLight * inversesqrt(d2);
    float attenuation = 1.0 / d2;
    if (light.direction.w > 0.0) {
        float x = d2 / (light.direction.w * light.direction.w);
        attenuation *= clamp(1.0 - x * x, 0.0, 1.0);
    }
    if (light.position.w > 1.5) {
        float cosine = dot(light.direction.xyz, -l);
        float t = clamp((cosine - light.cone.y) / max(light.cone.x - light.cone.y, 1e-4), 0.0, 1.0);
        attenuation *= t * t;
    }
    return light.color.rgb * attenuation;
}

/// A soft sky: bluish above, a warm floor's reflection below. up.w is the radiance at the zenith.
vec3 sky(vec3 direction, vec4 up) {
    float height = dot(direction, up.xyz) * 0.5 + 0.5;
    return up.w * mix(vec3(0.34, 0.31, 0.28), vec3(0.92, 0.98, 1.06), smoothstep(0.0, 1.0, height));
}
