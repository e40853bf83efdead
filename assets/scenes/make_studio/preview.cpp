// The ray caster of preview.hpp.
#include "preview.hpp"

#include <algorithm>
#include <cmath>

#include "atlas.hpp"
#include "bvh.hpp"

namespace studio {

namespace {

// The viewer's own weak light from above, which lit objects get in addition.
const vec3 kAmbientSky(0.15f), kAmbientGround(0.05f);

vec3 decoded(const vec4& c) {
    return {decodeSrgb(c.x), decodeSrgb(c.y), decodeSrgb(c.z)};
}

/// Metallic-roughness shading by glTF 2.0, appendix B.
vec3 shadeLit(const Model& model, const ObjectPictures& pictures, const vec2& uv, const vec3& p, const vec3& n,
              const vec3& toEye) {
    const vec3 base = decoded(sample(pictures.color, uv));
    float roughness = pictures.roughness, metallic = pictures.metallic;
    if (!pictures.metallicRoughness.empty()) {
        const vec4 mr = sample(pictures.metallicRoughness, uv);
        roughness *= mr.y;
        metallic *= mr.z;
    }
    const float alpha = std::max(0.01f, roughness * roughness), a2 = alpha * alpha;
    const vec3 f0 = glm::mix(vec3(0.04f), base, metallic), diffuse = base * (1.0f - metallic);
    vec3 sum =
        decoded(sample(pictures.emissive, uv)) + diffuse * glm::mix(kAmbientGround, kAmbientSky, 0.5f + 0.5f * n.y);
    const auto add = [&](const vec3& l, const vec3& light) {
        const float nl = glm::dot(n, l), nv = std::max(1e-3f, glm::dot(n, toEye));
        if (nl <= 0.0f) return;
        const vec3 h = glm::normalize(l + toEye);
        const float nh = glm::dot(n, h), q = nh * nh * (a2 - 1.0f) + 1.0f;
        const float d = a2 / (kPi * q * q);
        const float v =
            0.5f / (nl * std::sqrt(nv * nv * (1.0f - a2) + a2) + nv * std::sqrt(nl * nl * (1.0f - a2) + a2));
        const vec3 f = f0 + (1.0f - f0) * std::pow(1.0f - std::max(0.0f, glm::dot(h, toEye)), 5.0f);
        sum += ((1.0f - f) * diffuse / kPi + f * d * v) * light * nl;
    };
    add(model.daylight.toSun, model.daylight.sunIrradiance);
    for (const Lamp& lamp : model.lamps) {
        if (!lamp.exported) continue;
        const vec3 to = lamp.position - p;
        add(glm::normalize(to), lamp.intensity / glm::dot(to, to));
    }
    return sum;
}

vec3 trace(const Model& model, const std::vector<ObjectPictures>& pictures, const Bvh& bvh, Ray ray) {
    for (int layer = 0; layer < 64; ++layer) {
        const Hit hit = bvh.nearest(ray);
        if (!hit.found()) return vec3(0.0f);
        const Object& object = model.objects[static_cast<std::size_t>(hit.object)];
        const ObjectPictures& own = pictures[static_cast<std::size_t>(hit.object)];
        const Patch& patch = object.patches[static_cast<std::size_t>(hit.patch)];
        const vec2 uv = textureCoordinate(object, patch, hit.unit);
        const bool twoSided = object.thin || object.finish == Finish::masked;
        const vec4 texel = sample(own.color, uv);
        if ((hit.back && !twoSided) || (object.finish == Finish::masked && texel.w < 0.5f)) {
            ray.origin += ray.direction * (hit.distance * 1.00001f + 1e-5f);
            continue;
        }
        if (object.finish == Finish::glowing) return object.emissive * object.emissiveStrength;
        if (object.finish == Finish::shining) return decoded(sample(own.emissive, uv)) * object.emissiveStrength;
        if (object.finish != Finish::lit) return decoded(texel);
        vec3 n = hit.normal;
        if (!own.normal.empty()) {
            const vec4 relief = sample(own.normal, uv) * 2.0f - 1.0f;
            const SurfacePoint a = surfacePoint(patch, hit.unit - vec2(0.01f, 0.0f)),
                               b = surfacePoint(patch, hit.unit + vec2(0.01f, 0.0f));
            const vec3 along = b.position - a.position;
            const vec3 t = glm::normalize(along - n * glm::dot(n, along));
            n = glm::normalize(relief.x * t + relief.y * glm::cross(n, t) + relief.z * n);
        }
        return shadeLit(model, own, uv, ray.origin + ray.direction * hit.distance, n, -glm::normalize(ray.direction));
    }
    return vec3(0.0f);
}

}  // namespace

Picture renderPreview(const Model& model, const std::vector<ObjectPictures>& pictures, const PreviewOptions& options) {
    const Bvh bvh(model, [](const Object&) { return true; });
    const CameraView& camera = model.cameras[std::min(options.camera, model.cameras.size() - 1)];
    const vec3 back = glm::normalize(camera.position - camera.target), right = glm::normalize(glm::cross(kY, back));
    const vec3 up = glm::cross(back, right);
    const float halfHeight = std::tan(glm::radians(camera.yfovDegrees) * 0.5f);
    const float width = static_cast<float>(options.width), height = static_cast<float>(options.height);
    Picture picture{options.width, options.height, {}};
    picture.rgba.assign(static_cast<std::size_t>(options.width * options.height * 4), 255);
    parallelFor(options.height, [&](int y) {
        for (int x = 0; x < options.width; ++x) {
            Rng rng(hash(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)));
            vec3 sum(0.0f);
            for (int s = 0; s < options.samples; ++s) {
                const float px =
                    (2.0f * (static_cast<float>(x) + rng.next()) / width - 1.0f) * halfHeight * width / height;
                const float py = (1.0f - 2.0f * (static_cast<float>(y) + rng.next()) / height) * halfHeight;
                const float r = 0.5f * options.apertureDiameter * std::sqrt(rng.next()), a = 2.0f * kPi * rng.next();
                const vec3 lens = r * (std::cos(a) * right + std::sin(a) * up);
                const vec3 direction = (px * right + py * up - back) * options.focusDistance - lens;
                sum += trace(model, pictures, bvh, {camera.position + lens, glm::normalize(direction)});
            }
            const vec3 mean = sum / static_cast<float>(options.samples);
            for (int c = 0; c < 3; ++c) {
                picture.rgba[static_cast<std::size_t>((y * options.width + x) * 4 + c)] =
                    static_cast<std::uint8_t>(std::lround(encodeSrgb(mean[c]) * 255.0f));
            }
        }
    });
    return picture;
}

}  // namespace studio
