// The kinds of fish: outlines and colours.
#include <algorithm>

#include "scene/builtin/fishes.hpp"

namespace dioptre::builtin {

namespace {

/// 1 between `from` and `to`, over soft edges.
float band(float x, float from, float to, float soft = 0.012f) {
    return glm::smoothstep(from - soft, from + soft, x) * (1.0f - glm::smoothstep(to - soft, to + soft, x));
}

/// Shingles: darker where one lies under the next.
float shingle(float u, float v, float count) {
    const float row = v * count * 1.7f, shift = 0.5f * std::fmod(std::floor(row), 2.0f);
    const vec2 p(fraction(u * count * 0.5f + shift) - 0.5f, fraction(row));
    return 1.0f - 0.22f * glm::smoothstep(0.6f, 1.0f, p.y + 1.2f * p.x * p.x);
}

Paint scaled(float count, const Paint& paint) {
    return [=](float u, float v) {
        const float head = glm::smoothstep(0.17f, 0.22f, v);
        return paint(u, v) * glm::mix(1.0f, shingle(u, v, count), head) *
               (0.94f + 0.06f * noise({u * 60.0f, v * 90.0f, 0}));
    };
}

/// Rays from root to rim.
Paint rays(const vec3& root, const vec3& rim, const vec3& edge, float edgeFrom = 0.88f) {
    return [=](float u, float v) {
        const float ray = 0.5f + 0.5f * std::cos(2.0f * kPi * 18.0f * v);
        const vec3 color = glm::mix(root, rim, u) * (0.72f + 0.28f * ray);
        return glm::mix(color, edge, glm::smoothstep(edgeFrom - 0.03f, edgeFrom + 0.03f, u));
    };
}

Species clown() {
    Species s;
    s.name = "clownfish";
    s.above = {0.0f, 0.1f, 0.15f, 0.17f, 0.165f, 0.14f, 0.1f, 0.06f};
    s.below = {0.0f, 0.08f, 0.13f, 0.155f, 0.15f, 0.125f, 0.09f, 0.055f};
    s.width = {0.0f, 0.06f, 0.08f, 0.085f, 0.075f, 0.055f, 0.035f, 0.018f};
    s.eye = 0.11f, s.eyeRadius = 0.024f;
    s.dorsalHeight = 0.075f, s.tailSpan = 0.13f, s.tailFork = 0.0f, s.pectoral = 0.17f;
    s.skin = scaled(44.0f, [](float u, float v) {
        vec3 color = glm::mix(srgb(0xf0641a), srgb(0xf7922e), u);
        const float wave = 0.03f * std::cos(3.0f * u);
        for (const float at : {0.25f, 0.56f, 0.9f}) {
            const float half = at < 0.3f   ? 0.05f
                               : at < 0.6f ? 0.06f
                                           : 0.03f,
                        bulge = at > 0.5f && at < 0.6f ? -0.07f * band(u, 0.3f, 0.7f, 0.2f) : 0.0f;
            color = glm::mix(color, srgb(0x14100e), band(v + wave, at - half - 0.022f + bulge, at + half + 0.022f));
            color = glm::mix(color, srgb(0xf7f4ec), band(v + wave, at - half + bulge, at + half));
        }
        return color;
    });
    s.finColor = rays(srgb(0xf0701e), srgb(0xf59436), srgb(0x15110f), 0.82f);
    return s;
}

Species tang() {
    Species s;
    s.name = "blue tang";
    s.above = {0.0f, 0.12f, 0.19f, 0.22f, 0.22f, 0.18f, 0.1f, 0.045f};
    s.below = {0.0f, 0.1f, 0.17f, 0.2f, 0.2f, 0.165f, 0.095f, 0.04f};
    s.width = {0.0f, 0.045f, 0.06f, 0.065f, 0.06f, 0.045f, 0.025f, 0.014f};
    s.eye = 0.12f, s.eyeRadius = 0.02f;
    s.dorsalFrom = 0.2f, s.dorsalHeight = 0.06f, s.analFrom = 0.5f, s.analHeight = 0.06f, s.tailFork = 0.35f;
    s.skin = scaled(60.0f, [](float u, float v) {
        vec3 color = glm::mix(srgb(0x1b46c8), srgb(0x2f74e4), u);
        const float sweep = v - 0.25f;
        const float palette =
            band(u, 0.1f, 0.28f + 0.12f * std::sin(5.0f * sweep), 0.03f) * band(v, 0.16f, 1.2f, 0.02f);
        const float hook =
            band(std::abs(glm::length(vec2(v - 0.62f, (u - 0.32f) * 0.7f)) - 0.15f), -1.0f, 0.035f, 0.015f) *
            band(v, 0.5f, 1.0f, 0.02f);
        color = glm::mix(color, srgb(0x080a1e), std::max(palette, hook));
        return glm::mix(color, srgb(0xf8d21e), band(v, 0.93f + 0.06f * std::abs(u - 0.5f), 2.0f));
    });
    s.finColor = rays(srgb(0x1c49cc), srgb(0x2c66dc), srgb(0x0a0d28));
    return s;
}

Species angel() {
    Species s;
    s.name = "emperor";
    s.above = {0.0f, 0.13f, 0.22f, 0.26f, 0.26f, 0.21f, 0.12f, 0.06f};
    s.below = {0.0f, 0.11f, 0.2f, 0.24f, 0.23f, 0.19f, 0.11f, 0.055f};
    s.width = {0.0f, 0.05f, 0.07f, 0.075f, 0.065f, 0.05f, 0.03f, 0.016f};
    s.eye = 0.14f, s.eyeRadius = 0.02f;
    s.dorsalFrom = 0.25f, s.dorsalHeight = 0.1f, s.dorsalLean = 0.7f, s.analHeight = 0.1f, s.tailFork = 0.0f;
    s.skin = scaled(54.0f, [](float u, float v) {
        const float line = std::sin(62.0f * (u + 0.10f * v) + 0.8f * std::sin(7.0f * v));
        vec3 color = glm::mix(srgb(0x15429a), srgb(0xf4cf2a), glm::smoothstep(-0.25f, 0.3f, line));
        color = glm::mix(color, srgb(0x0c1a4e), 1.0f - glm::smoothstep(0.24f, 0.27f, v));
        color = glm::mix(color, srgb(0x0a0f26), band(v - 0.06f * std::sin(3.0f * u), 0.09f, 0.16f));
        color = glm::mix(color, srgb(0x4fb4e8), band(v - 0.06f * std::sin(3.0f * u), 0.165f, 0.175f, 0.005f));
        return glm::mix(color, srgb(0xe9e7d8), 1.0f - glm::smoothstep(0.07f, 0.09f, v));
    });
    s.finColor = rays(srgb(0x1d4aa6), srgb(0xf2cc3c), srgb(0x59b9e6), 0.9f);
    return s;
}

Species moorish() {
    Species s;
    s.name = "idol";
    s.above = {0.0f, 0.07f, 0.2f, 0.31f, 0.32f, 0.24f, 0.12f, 0.05f};
    s.below = {0.0f, 0.06f, 0.17f, 0.27f, 0.29f, 0.22f, 0.11f, 0.045f};
    s.width = {0.0f, 0.035f, 0.05f, 0.055f, 0.05f, 0.04f, 0.025f, 0.014f};
    s.eye = 0.21f, s.eyeRadius = 0.02f;
    s.dorsalFrom = 0.36f, s.dorsalTo = 0.85f, s.dorsalHeight = 0.09f, s.trail = 0.5f, s.analFrom = 0.5f,
    s.tailFork = 0.3f;
    s.skin = scaled(64.0f, [](float u, float v) {
        vec3 color = glm::mix(srgb(0xf7f4e4), srgb(0xf6d535), glm::smoothstep(0.55f, 0.72f, v));
        color = glm::mix(color, srgb(0x11120f), band(v + 0.05f * u, 0.25f, 0.42f));
        color = glm::mix(color, srgb(0x11120f), band(v + 0.06f * u, 0.76f, 0.93f));
        color = glm::mix(color, srgb(0xf2b424), band(v, 0.05f, 0.11f) * band(u, -1.0f, 0.4f));
        return glm::mix(color, srgb(0x6aa0d4), band(v + 0.06f * u, 0.93f, 0.945f, 0.004f));
    });
    s.finColor = rays(srgb(0xf7f0d0), srgb(0xf6dc5a), srgb(0x16150f), 0.93f);
    return s;
}

Species parrot() {
    Species s;
    s.name = "parrotfish";
    s.above = {0.0f, 0.1f, 0.135f, 0.145f, 0.14f, 0.12f, 0.09f, 0.07f};
    s.below = {0.0f, 0.09f, 0.125f, 0.14f, 0.135f, 0.115f, 0.085f, 0.065f};
    s.width = {0.0f, 0.065f, 0.085f, 0.09f, 0.085f, 0.065f, 0.045f, 0.025f};
    s.eye = 0.13f, s.eyeRadius = 0.017f;
    s.dorsalFrom = 0.25f, s.dorsalTo = 0.95f, s.dorsalHeight = 0.06f, s.tailSpan = 0.15f, s.tailFork = 0.3f;
    s.scales = 26.0f;
    s.skin = scaled(26.0f, [](float u, float v) {
        const vec3 teal = glm::mix(srgb(0x16a0a0), srgb(0x5ad0b4), u);
        const float row = v * 26.0f * 1.7f, shift = 0.5f * std::fmod(std::floor(row), 2.0f);
        const vec2 p(fraction(u * 13.0f + shift) - 0.5f, fraction(row) - 0.5f);
        vec3 color = glm::mix(teal, srgb(0xe8709a), 0.75f * glm::smoothstep(0.25f, 0.5f, glm::length(p)));
        const float head = 1.0f - glm::smoothstep(0.17f, 0.2f, v);
        color = glm::mix(
            color,
            glm::mix(srgb(0x26b0a8), srgb(0xf08f6a), glm::smoothstep(0.2f, 0.5f, std::sin(30.0f * u + 14.0f * v))),
            head);
        return glm::mix(color, srgb(0xf0d060), band(v, 0.95f, 2.0f) * 0.5f);
    });
    s.finColor = rays(srgb(0x2ab4ae), srgb(0xf08aa6), srgb(0x1d70c8));
    return s;
}

Species snapper() {
    Species s;
    s.name = "snapper";
    s.above = {0.0f, 0.1f, 0.15f, 0.155f, 0.14f, 0.11f, 0.07f, 0.04f};
    s.below = {0.0f, 0.07f, 0.1f, 0.115f, 0.11f, 0.09f, 0.06f, 0.036f};
    s.width = {0.0f, 0.05f, 0.07f, 0.075f, 0.065f, 0.05f, 0.03f, 0.016f};
    s.eye = 0.14f, s.eyeRadius = 0.025f;
    s.dorsalFrom = 0.28f, s.dorsalHeight = 0.08f, s.tailSpan = 0.17f, s.tailFork = 0.55f;
    s.metallic = 0.45f, s.roughness = 0.28f;
    s.skin = scaled(50.0f, [](float u, float v) {
        vec3 color = glm::mix(srgb(0xf2c21a), srgb(0xf8ecc8), glm::smoothstep(0.5f, 0.85f, u));
        for (const float at : {0.24f, 0.37f, 0.5f, 0.63f}) {
            color = glm::mix(color, srgb(0x2c62b8),
                             band(u + 0.05f * v, at - 0.022f, at + 0.022f, 0.006f) * band(v, 0.12f, 0.97f));
        }
        return color;
    });
    s.finColor = rays(srgb(0xf2c522), srgb(0xf6d860), srgb(0xfaf0c0));
    return s;
}

Species tuna() {
    Species s;
    s.name = "jack";
    s.above = {0.0f, 0.075f, 0.11f, 0.12f, 0.11f, 0.08f, 0.045f, 0.016f};
    s.below = {0.0f, 0.07f, 0.11f, 0.125f, 0.115f, 0.085f, 0.045f, 0.016f};
    s.width = {0.0f, 0.05f, 0.07f, 0.078f, 0.07f, 0.05f, 0.028f, 0.018f};
    s.eye = 0.11f, s.eyeRadius = 0.02f;
    s.dorsalFrom = 0.45f, s.dorsalHeight = 0.09f, s.dorsalLean = 0.9f, s.analFrom = 0.55f, s.tailSpan = 0.2f,
    s.tailFork = 0.75f;
    s.metallic = 0.8f, s.roughness = 0.24f;
    s.skin = scaled(70.0f, [](float u, float v) {
        vec3 color = glm::mix(srgb(0x3f6f8f), srgb(0xdfe6e8), glm::smoothstep(0.15f, 0.55f, u));
        color = glm::mix(color, srgb(0xe8cf5a), band(u, 0.40f, 0.46f, 0.02f) * band(v, 0.2f, 1.1f));
        return glm::mix(color, srgb(0x223a48), band(u, -1.0f, 0.12f, 0.06f));
    });
    s.finColor = rays(srgb(0x5a6f74), srgb(0xd8c860), srgb(0x2c3a40));
    return s;
}

Species gramma() {
    Species s;
    s.name = "gramma";
    s.above = {0.0f, 0.09f, 0.125f, 0.135f, 0.13f, 0.11f, 0.085f, 0.06f};
    s.below = {0.0f, 0.075f, 0.11f, 0.125f, 0.12f, 0.105f, 0.08f, 0.055f};
    s.width = {0.0f, 0.055f, 0.07f, 0.075f, 0.07f, 0.055f, 0.035f, 0.02f};
    s.eye = 0.12f, s.eyeRadius = 0.026f;
    s.dorsalFrom = 0.25f, s.dorsalHeight = 0.09f, s.analHeight = 0.09f, s.tailFork = 0.2f, s.pectoral = 0.16f;
    s.skin = scaled(46.0f, [](float u, float v) {
        const float mix = glm::smoothstep(0.42f, 0.58f, v + 0.06f * noise({u * 30.0f, v * 30.0f, 0}));
        vec3 color = glm::mix(srgb(0x8a2bc0), srgb(0xf9cf1c), mix);
        return glm::mix(color, srgb(0x14081e), band(u - 0.6f * (v - 0.1f), 0.2f, 0.25f, 0.02f) * band(v, -1.0f, 0.18f));
    });
    s.finColor = rays(srgb(0x8f35c4), srgb(0xf2c238), srgb(0x5a1e8a), 0.95f);
    return s;
}

Species puffer() {
    Species s;
    s.name = "puffer";
    s.above = {0.0f, 0.12f, 0.19f, 0.22f, 0.21f, 0.16f, 0.09f, 0.045f};
    s.below = {0.0f, 0.12f, 0.21f, 0.26f, 0.25f, 0.18f, 0.09f, 0.045f};
    s.width = {0.0f, 0.12f, 0.19f, 0.215f, 0.2f, 0.14f, 0.07f, 0.025f};
    s.eye = 0.13f, s.eyeRadius = 0.035f;
    s.dorsalFrom = 0.72f, s.dorsalTo = 0.92f, s.dorsalHeight = 0.07f, s.analFrom = 0.75f, s.tailSpan = 0.1f,
    s.tailFork = 0.0f, s.pectoral = 0.1f;
    s.roughness = 0.45f, s.scales = 22.0f;
    s.skin = [](float u, float v) {
        const Cell dots = worley({u * 12.0f, v * 17.0f}, 4);
        vec3 color = glm::mix(srgb(0x9a7a3c), srgb(0xf6efda), glm::smoothstep(0.45f, 0.7f, u));
        return glm::mix(color, srgb(0x3a2a16),
                        spot(dots.nearest, 0.2f + 0.15f * dots.id, 0.05f) * (1.0f - glm::smoothstep(0.5f, 0.7f, u)));
    };
    s.finColor = rays(srgb(0xc7a662), srgb(0xe6d5a4), srgb(0xf0e6c8));
    return s;
}

Species wrasse() {
    Species s;
    s.name = "wrasse";
    s.above = {0.0f, 0.06f, 0.085f, 0.095f, 0.095f, 0.085f, 0.068f, 0.05f};
    s.below = {0.0f, 0.055f, 0.08f, 0.09f, 0.09f, 0.08f, 0.062f, 0.046f};
    s.width = {0.0f, 0.04f, 0.052f, 0.058f, 0.055f, 0.045f, 0.03f, 0.018f};
    s.eye = 0.12f, s.eyeRadius = 0.017f;
    s.dorsalFrom = 0.22f, s.dorsalTo = 0.95f, s.dorsalHeight = 0.05f, s.analFrom = 0.5f, s.analHeight = 0.045f,
    s.tailFork = 0.25f;
    s.skin = scaled(52.0f, [](float u, float v) {
        vec3 color = glm::mix(srgb(0xe23a4e), srgb(0xf6a04a), u);
        color = glm::mix(color, srgb(0x2fbf9a), band(u, 0.34f, 0.5f, 0.03f));
        const float stripe = 0.5f + 0.5f * std::sin(90.0f * v + 3.0f * std::sin(9.0f * u));
        return glm::mix(color, srgb(0x285ac8), 0.55f * stripe * band(u, 0.1f, 0.34f, 0.04f));
    });
    s.finColor = rays(srgb(0xe6485a), srgb(0xf4b24e), srgb(0x2a8fd0));
    return s;
}

}  // namespace

std::vector<Species> allSpecies() {
    return {clown(), tang(), angel(), moorish(), parrot(), snapper(), tuna(), gramma(), puffer(), wrasse()};
}

}  // namespace dioptre::builtin
