// A fish from its outlines: body with scales in relief, fins, eyes; bent as it swims.
#include <algorithm>

#include "scene/builtin/fishes.hpp"

namespace dioptre::builtin {

namespace {

constexpr float kSnout = 0.5f, kRoot = -0.36f;  // x of snout and tail root

/// An outline at `t` from snout to tail root: a smooth curve through its values, round at the snout.
float outline(const std::vector<float>& values, float t) {
    std::vector<vec3> points;
    points.reserve(values.size());
    for (const float v : values) points.emplace_back(v, 0.0f, 0.0f);
    const float smooth = curvePoint(points, t).x;
    const float first = 1.0f / toFloat(static_cast<int>(values.size()) - 1);
    // Below the first station as a root, so that the snout is blunt
    const float blunt = values[1] * std::sqrt(std::max(0.0f, t / first));
    return t < first ? glm::mix(blunt, smooth, glm::smoothstep(0.3f * first, first, t)) : smooth;
}

vec3 bodyPoint(const Species& s, float u, float t) {
    const float a = 2.0f * kPi * u, c = std::cos(a), n = std::sin(a);
    const float height = outline(c >= 0.0f ? s.above : s.below, t), width = outline(s.width, t);
    const float sharp = 1.15f;  // > 1: back and belly are keels
    return {glm::mix(kSnout, kRoot, t), height * std::copysign(std::pow(std::abs(c), 1.0f / sharp), c),
            width * std::copysign(std::pow(std::abs(n), sharp), n)};
}

/// Overlapping scales in relief, behind the head.
float scaleHeight(const Species& s, float u, float t) {
    const float m = 1.0f - std::abs(1.0f - 2.0f * u), row = t * s.scales * 1.7f;
    const float shift = 0.5f * std::fmod(std::floor(row), 2.0f);
    const float across = fraction(m * s.scales * 0.5f + shift) - 0.5f, along = fraction(row);
    const float head = glm::smoothstep(0.18f, 0.24f, t) * (1.0f - glm::smoothstep(0.93f, 1.0f, t));
    return 0.045f / s.scales * head * (along - 1.6f * across * across);
}

/// The gill cover: a step behind the head.
float gillHeight(float u, float t) {
    const float m = 1.0f - std::abs(1.0f - 2.0f * u);
    const float edge = 0.2f - 0.25f * (m - 0.5f) * (m - 0.5f);
    return 0.006f * glm::smoothstep(edge - 0.12f, edge, t) * (1.0f - glm::smoothstep(edge, edge + 0.012f, t)) *
           glm::smoothstep(0.12f, 0.3f, m) * (1.0f - glm::smoothstep(0.8f, 0.95f, m));
}

/// Swims: the body's rear swings sideways.
vec3 bent(const vec3& p, const Pose& pose) {
    const float back = (kSnout - p.x), lever = back * back;
    const float angle = pose.phase + 4.2f * back;
    const float slope = pose.swing * (2.0f * back * std::sin(angle) + lever * 4.2f * std::cos(angle));
    return {p.x + slope * p.z, p.y, p.z + pose.swing * lever * std::sin(angle)};
}

/// A fin in the fish's plane of symmetry, with rays and a ripple; `rippled` metres at the rim.
Shape medianFin(const Model& model, const std::function<vec3(float)>& root, const std::function<vec3(float)>& rim,
                float thickness, float rippled) {
    Fin f;
    f.root = root;
    f.rim = [=](float t) { return rim(t) + rippled * std::sin(17.0f * t) * kZ; };
    f.side = [=](float t, float out) {
        const float ray = 1.0f + 0.35f * std::cos(2.0f * kPi * 18.0f * t);
        return thickness * (1.0f - 0.75f * out) * ray * kZ;
    };
    return fin(model.detail.around(40), model.detail.along(96), f);
}

Shape dorsalFin(const Model& model, const Species& s) {
    const auto along = [=](float t) { return glm::mix(s.dorsalFrom, s.dorsalTo, t); };
    const auto root = [=](float t) { return bodyPoint(s, 0.0f, along(t)) - 0.015f * kY; };
    const auto rim = [=](float t) {
        const float shape =
            std::pow(std::sin(kPi * glm::mix(0.08f, 0.97f, t)), 0.6f) * (0.75f + 0.25f * std::cos(9.0f * t));
        const float trail = s.trail * std::pow(std::max(0.0f, 1.0f - 6.0f * t), 2.0f);
        return bodyPoint(s, 0.0f, along(t)) +
               vec3(-s.dorsalLean * s.dorsalHeight * (0.3f + t) - 1.4f * trail, s.dorsalHeight * shape + trail, 0.0f);
    };
    return medianFin(model, root, rim, 0.006f, 0.004f);
}

Shape analFin(const Model& model, const Species& s) {
    const auto along = [=](float t) { return glm::mix(s.analFrom, s.analTo, t); };
    const auto root = [=](float t) { return bodyPoint(s, 0.5f, along(t)) + 0.012f * kY; };
    const auto rim = [=](float t) {
        const float shape = std::pow(std::sin(kPi * glm::mix(0.1f, 0.95f, t)), 0.7f);
        return bodyPoint(s, 0.5f, along(t)) - vec3(0.5f * s.analHeight * (0.3f + t), s.analHeight * shape, 0.0f);
    };
    return medianFin(model, root, rim, 0.005f, 0.003f);
}

Shape tailFin(const Model& model, const Species& s) {
    const float high = s.above.back(), low = s.below.back();
    const auto root = [=](float t) { return vec3(kRoot + 0.02f, glm::mix(0.9f * high, -0.9f * low, t), 0.0f); };
    const auto rim = [=](float t) {
        const float side = 1.0f - 2.0f * t, notch = s.tailFork * (1.0f - std::abs(side));
        const float round = 0.035f * (1.0f - side * side);
        return vec3(-0.5f + 0.13f * notch - round * (1.0f - s.tailFork), s.tailSpan * side, 0.0f);
    };
    return medianFin(model, root, rim, 0.006f, 0.006f);
}

Shape sideFins(const Model& model, const Species& s) {
    Shape both;
    for (const float side : {-1.0f, 1.0f}) {
        Fin f;
        const float at = 0.27f, z = outline(s.width, at) * 0.94f, y = -0.25f * outline(s.below, at);
        const float x = glm::mix(kSnout, kRoot, at);
        f.root = [=](float t) { return vec3(x + 0.01f, y + 0.03f * (0.5f - t), side * z); };
        f.rim = [=](float t) {
            const float a = glm::mix(0.35f, -1.1f, t), reach = s.pectoral * (0.8f + 0.2f * std::sin(kPi * t));
            return vec3(x - reach * std::cos(a) * 0.85f, y + reach * std::sin(a), side * (z + 0.5f * reach));
        };
        f.side = [=](float t, float out) {
            return 0.004f * (1.0f - 0.7f * out) * (1.0f + 0.35f * std::cos(2.0f * kPi * 18.0f * t)) *
                   vec3(0.5f, 0.0f, side);
        };
        both.add(fin(model.detail.around(32), model.detail.along(64), f));
        // The pair below
        Fin g;
        const float under = 0.36f;
        const vec3 belly = bodyPoint(s, 0.5f - side * 0.07f, under);
        g.root = [=](float t) { return belly + vec3(-0.06f * t + 0.02f, 0.012f, 0.0f); };
        g.rim = [=](float t) {
            return belly + vec3(-0.06f * t - 0.09f, -0.55f * s.pectoral * std::sin(kPi * glm::mix(0.25f, 0.9f, t)),
                                side * 0.05f);
        };
        g.side = [](float, float out) { return 0.004f * (1.0f - 0.7f * out) * kZ; };
        both.add(fin(model.detail.around(24), model.detail.along(48), g));
    }
    return both;
}

}  // namespace

int addFish(Model& model, const Species& s, const Pose& pose, int skin, int fins, float haze) {
    const Detail detail = model.detail;
    // Water takes the red first and adds its own blue.
    const vec3 through = glm::mix(vec3(1.0f), vec3(0.35f, 0.62f, 0.75f), haze),
               veil = haze * vec3(0.010f, 0.055f, 0.085f);
    const auto surface = [&](const char* part, float roughness, float metallic, int image) {
        const int material = model.material(s.name + part, through, roughness, metallic, image);
        model.materialAt(material).emissive = veil;
        return material;
    };
    const int body = surface("", s.roughness, s.metallic * (1.0f - 0.7f * haze), skin);
    const int fin = surface("'s fins", 0.4f, 0.0f, fins);
    const int eyeWhite = surface("'s eyes", 0.15f, 0.0f, -1), pupil = surface("'s pupils", 0.08f, 0.0f, -1);
    model.materialAt(eyeWhite).baseColor *= vec4(srgb(0xe9d9a0), 1.0f);
    model.materialAt(pupil).baseColor *= vec4(srgb(0x0a0a0c), 1.0f);
    const auto swim = [pose](Shape shape) {
        shape.bend([&](const vec3& p) { return bent(p, pose); });
        return shape;
    };
    const auto trunk = [=] {
        return swim(polar(detail.around(88), detail.along(200), [&](float u, float v) {
            const vec3 p = bodyPoint(s, u, v);
            const float a = 2.0f * kPi * u;
            const vec3 out = glm::normalize(vec3(0.0f, std::cos(a) * 0.6f, std::sin(a)));
            return p + (scaleHeight(s, u, v) + gillHeight(u, v)) * out;
        }));
    };
    const auto eyes = [=](float radius, float outwards) {
        Shape both;
        for (const float side : {-1.0f, 1.0f}) {
            const vec3 at = bodyPoint(s, side > 0.0f ? 0.19f : 0.81f, s.eye);
            both.add(ball(detail, {at.x, at.y, at.z + side * outwards * s.eyeRadius},
                          vec3(radius, radius, 0.6f * radius) * s.eyeRadius, 32));
        }
        return swim(both);
    };
    const Model* all = &model;
    return model.mesh(s.name, {{body, trunk},
                               {fin, [=] { return swim(dorsalFin(*all, s)); }},
                               {fin, [=] { return swim(analFin(*all, s)); }},
                               {fin, [=] { return swim(tailFin(*all, s)); }},
                               {fin, [=] { return swim(sideFins(*all, s)); }},
                               {eyeWhite, [=] { return eyes(1.0f, -0.1f); }},
                               {pupil, [=] { return eyes(0.62f, 0.25f); }}});
}

}  // namespace dioptre::builtin
