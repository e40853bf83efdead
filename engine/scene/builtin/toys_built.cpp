// Toys put together from boxes, discs and rods.
#include <algorithm>
#include <array>

#include "scene/builtin/toys.hpp"

namespace dioptre::builtin {

namespace {

Shape box(const Detail& detail, const vec3& centre, const vec3& half, float radius, int steps = 16) {
    return roundedBox(detail, half, radius, steps).move(translation(centre));
}

/// A disc with rounded edges, its axis along y, its middle at the origin.
Shape disc(const Detail& detail, float radius, float height, int around = 48) {
    const float h = 0.5f * height, e = std::min(0.3f * height, 0.15f * radius);
    return lathe(detail, {{0, -h}, {radius - e, -h}, {radius, e - h}, {radius, h - e}, {radius - e, h}, {0, h}}, around,
                 around, 2);
}

/// A wheel standing on y = 0, its axle along x.
Shape wheel(const Detail& detail, const vec3& at, float radius, float width) {
    Shape shape = torus(detail, radius - 0.3f * width, 0.3f * width, 64, 16);
    shape.add(disc(detail, radius - 0.3f * width, 0.45f * width, 32));
    shape.add(disc(detail, 0.25f * radius, width, 24));
    return shape.move(translation(at + radius * kY) * rotation(90.0f, kZ));
}

Shape wheels(const Detail& detail, const std::vector<float>& along, float track, float radius) {
    Shape all;
    for (const float z : along)
        for (const float side : {-1.0f, 1.0f}) all.add(wheel(detail, {side * track, 0.0f, z}, radius, 0.014f));
    return all;
}

}  // namespace

int addBlock(Model& model, const char* letters, std::uint32_t colors) {
    const std::string six(letters);
    const int image = model.picture("block " + six, 768, 512, [six, colors](float u, float v) {
        const vec2 p(fraction(u * 3.0f), fraction(v * 2.0f));
        const int face = static_cast<int>(u * 3.0f) + 3 * static_cast<int>(v * 2.0f);
        const std::array<std::uint32_t, 4> palette{0xc8322f, 0x2c6cb0, 0x2f9150, 0xe3a51f};
        const vec3 ink = srgb(palette[(colors + static_cast<std::uint32_t>(face)) % 4]);
        const float grain = fbm({p.x * 4.0f, p.y * 40.0f, toFloat(face)}, 3, colors);
        const vec3 wood = glm::mix(srgb(0xe9c48c), srgb(0xc3935a), grain);
        const vec2 q = glm::abs(p - 0.5f);
        const float edge = std::max(q.x, q.y);
        const float frame = glm::smoothstep(0.35f, 0.36f, edge) * (1.0f - glm::smoothstep(0.42f, 0.43f, edge));
        const vec2 inner = (p - 0.5f) / 0.62f + 0.5f;
        const float letter = spot(letterDistance(six[static_cast<std::size_t>(face)], inner), 0.085f, 0.012f);
        return glm::mix(wood, ink * (0.85f + 0.2f * grain), std::max(frame, letter));
    });
    const int material = model.material("block", vec3(1.0f), 0.5f, 0.0f, image);
    const Detail detail = model.detail;
    return model.mesh("block " + six, {{material, [=] { return box(detail, 0.03f * kY, vec3(0.03f), 0.0045f, 24); }}});
}

int addDie(Model& model) {
    // Pips are dents, coloured by the same places
    constexpr float kPip = 0.2f, kGap = 0.5f;
    const auto pipsOf = [](int face) {
        static const std::array<int, 6> counts{1, 6, 2, 5, 3, 4};
        const int n = counts[static_cast<std::size_t>(face)];
        std::vector<vec2> pips;
        if (n % 2) pips.emplace_back(0.0f, 0.0f);
        if (n >= 2) pips.insert(pips.end(), {{-kGap, -kGap}, {kGap, kGap}});
        if (n >= 4) pips.insert(pips.end(), {{-kGap, kGap}, {kGap, -kGap}});
        if (n == 6) pips.insert(pips.end(), {{-kGap, 0.0f}, {kGap, 0.0f}});
        return pips;
    };
    const int image = model.picture("die", 768, 512, [=](float u, float v) {
        constexpr float kInset = 0.01f;
        const vec2 p = (vec2(fraction(u * 3.0f), fraction(v * 2.0f)) - kInset) / (1.0f - 2.0f * kInset) * 2.0f - 1.0f;
        float nearest = 9.0f;
        for (const vec2& pip : pipsOf(static_cast<int>(u * 3.0f) + 3 * static_cast<int>(v * 2.0f)))
            nearest = std::min(nearest, glm::distance(p, pip));
        return glm::mix(srgb(0xf3ece0) * (0.94f + 0.06f * noise({u * 40.0f, v * 40.0f, 0})), srgb(0x1b1c22),
                        spot(nearest, kPip * 0.95f, 0.015f));
    });
    const int material = model.material("die", vec3(1.0f), 0.18f, 0.0f, image);
    const int steps = model.detail.around(56);
    return model.mesh(
        "die", {{material, [=] {
                     return cube(steps, [=](const vec3& c) {
                         constexpr float kRound = 0.22f, kHalf = 0.02f;
                         const vec3 core = glm::clamp(c, kRound - 1.0f, 1.0f - kRound);
                         const vec3 out = c - core;
                         vec3 p = core + (glm::length(out) > 0.0f ? glm::normalize(out) * kRound : vec3(0.0f));
                         // The same frames as cube()'s faces
                         const std::array<vec3, 6> middle{kX, -kX, kY, -kY, kZ, -kZ}, right{-kZ, kZ, kX, kX, kX, -kX},
                             down{-kY, -kY, kZ, -kZ, -kY, -kY};
                         for (std::size_t f = 0; f < 6; ++f) {
                             if (glm::dot(c, middle[f]) < 0.999f) continue;
                             for (const vec2& pip : pipsOf(static_cast<int>(f))) {
                                 const float d =
                                     glm::distance(vec2(glm::dot(c, right[f]), glm::dot(c, down[f])), pip) / kPip;
                                 if (d < 1.0f) p -= middle[f] * (0.5f * kPip * (1.0f - d * d));
                             }
                         }
                         return kHalf * (p + kY);
                     });
                 }}});
}

int addLocomotive(Model& model, const ToyPictures& pictures) {
    const Detail detail = model.detail;
    const int green = model.material("locomotive", srgb(0x2c7a4b), 0.35f, 0.0f, pictures.paint);
    const int red = model.material("locomotive's wheels", srgb(0xcf3227), 0.35f, 0.0f, pictures.paint);
    const int black = model.material("locomotive's chimney", srgb(0x2a2b30), 0.4f, 0.0f, pictures.paint);
    const int brass = model.material("locomotive's brass", srgb(0xd9b25f), 0.22f, 1.0f, pictures.metal);
    const int wood = model.material("locomotive's frame", srgb(0xd9a866), 0.5f, 0.0f, pictures.wood);
    const int lamp = model.glowing("locomotive's lamp", {9.0f, 7.2f, 4.2f});
    const auto frame = [=] {
        Shape s = box(detail, {0, 0.042f, 0}, {0.05f, 0.009f, 0.14f}, 0.005f);
        return s.add(box(detail, {0, 0.037f, 0.148f}, {0.054f, 0.014f, 0.008f}, 0.004f));
    };
    const auto body = [=] {
        Shape s =
            lathe(detail,
                  {{0, -0.085f}, {0.042f, -0.085f}, {0.044f, -0.08f}, {0.044f, 0.075f}, {0.04f, 0.085f}, {0, 0.087f}},
                  96, 96, 2)
                .move(translation({0, 0.095f, 0.045f}) * rotation(90.0f, kX));
        s.add(box(detail, {0, 0.105f, -0.085f}, {0.05f, 0.054f, 0.045f}, 0.006f));
        return s;
    };
    const auto roof = [=] {
        Shape s = box(detail, {0, 0.168f, -0.085f}, {0.06f, 0.008f, 0.056f}, 0.007f);
        for (const float side : {-1.0f, 1.0f})
            s.add(box(detail, {side * 0.051f, 0.126f, -0.085f}, {0.001f, 0.018f, 0.022f}, 0.0008f, 8));
        s.add(wheels(detail, {0.105f, 0.045f}, 0.058f, 0.03f));
        return s;
    };
    const auto dark = [=] {
        Shape s = lathe(detail,
                        {{0, 0},
                         {0.018f, 0},
                         {0.015f, 0.01f},
                         {0.014f, 0.04f},
                         {0.024f, 0.058f},
                         {0.024f, 0.064f},
                         {0.014f, 0.064f},
                         {0.01f, 0.05f},
                         {0, 0.05f}},
                        48, 72, 2)
                      .move(translation({0, 0.132f, 0.095f}));
        return s.add(disc(detail, 0.036f, 0.012f).move(translation({0, 0.095f, 0.132f}) * rotation(90.0f, kX)));
    };
    const auto bright = [=] {
        Shape s = ball(detail, {0, 0.142f, 0.035f}, {0.018f, 0.02f, 0.018f}, 40);
        for (const float z : {-0.02f, 0.06f, 0.11f})
            s.add(torus(detail, 0.0445f, 0.0025f, 72, 12).move(translation({0, 0.095f, z}) * rotation(90.0f, kX)));
        s.add(torus(detail, 0.012f, 0.004f, 32, 12).move(translation({0, 0.146f, 0.128f}) * rotation(90.0f, kX)));
        return s.add(tube(
            detail, {{0.066f, 0.034f, 0.105f}, {0.066f, 0.034f, 0.04f}, {0.066f, 0.034f, -0.08f}},
            [](float) { return 0.0035f; }, 12, 20));
    };
    const auto large = [=] { return wheels(detail, {-0.085f}, 0.06f, 0.044f); };
    const auto light = [=] { return ball(detail, {0, 0.146f, 0.13f}, {0.011f, 0.011f, 0.006f}, 24); };
    return model.mesh(
        "locomotive",
        {{wood, frame}, {green, body}, {red, roof}, {black, dark}, {brass, bright}, {red, large}, {lamp, light}});
}

int addWagon(Model& model, const ToyPictures& pictures, const vec3& color, bool logs) {
    const Detail detail = model.detail;
    const int paint = model.material("wagon", color, 0.35f, 0.0f, pictures.paint);
    const int red = model.material("wagon's wheels", srgb(0xcf3227), 0.35f, 0.0f, pictures.paint);
    const int wood = model.material("wagon's load", srgb(0xc98f54), 0.6f, 0.0f, pictures.wood);
    const int bright = model.material("wagon's balls", srgb(0xf0b92c), 0.2f, 0.0f, pictures.paint);
    const auto body = [=] {
        Shape s = box(detail, {0, 0.044f, 0}, {0.05f, 0.008f, 0.09f}, 0.004f);
        for (const float side : {-1.0f, 1.0f}) {
            s.add(box(detail, {side * 0.046f, 0.068f, 0}, {0.005f, 0.022f, 0.088f}, 0.003f));
            s.add(box(detail, {0, 0.068f, side * 0.083f}, {0.045f, 0.022f, 0.005f}, 0.003f));
        }
        return s;
    };
    const auto rolling = [=] { return wheels(detail, {-0.055f, 0.055f}, 0.056f, 0.028f); };
    const auto load = [=] {
        Shape s;
        if (logs) {
            for (int k = 0; k < 5; ++k) {
                const float x = k < 3 ? -0.027f + 0.027f * toFloat(k) : -0.0135f + 0.027f * toFloat(k - 3),
                            y = k < 3 ? 0.068f : 0.092f;
                s.add(disc(detail, 0.0132f, 0.15f, 32)
                          .move(translation({x, y, 0.004f * toFloat(k % 3)}) * rotation(90.0f, kX)));
            }
        } else {
            for (int k = 0; k < 6; ++k)
                s.add(
                    ball(detail, {k % 2 ? 0.02f : -0.02f, 0.075f, -0.05f + 0.05f * toFloat(k / 2)}, vec3(0.024f), 40));
        }
        return s;
    };
    return model.mesh("wagon", {{paint, body}, {red, rolling}, {logs ? wood : bright, load}});
}

int addRobot(Model& model, const ToyPictures& pictures) {
    const Detail detail = model.detail;
    const int shell = model.material("robot", srgb(0x8fa6b8), 0.34f, 0.85f, pictures.metal);
    const int dark = model.material("robot's joints", srgb(0x3a3d45), 0.45f, 0.6f, pictures.metal);
    const int red = model.material("robot's knobs", srgb(0xd23a2e), 0.25f, 0.0f, pictures.paint);
    const int eyes = model.glowing("robot's eyes", {0.8f, 6.0f, 7.0f});
    const int panel = model.material("robot's panel", srgb(0xf2d35b), 0.4f, 0.0f, pictures.paint);
    const auto body = [=] {
        Shape s = box(detail, {0, 0.17f, 0}, {0.065f, 0.07f, 0.045f}, 0.012f, 32);
        s.add(box(detail, {0, 0.29f, 0}, {0.048f, 0.038f, 0.04f}, 0.012f, 32));
        for (const float side : {-1.0f, 1.0f}) {
            s.add(box(detail, {side * 0.036f, 0.014f, 0.012f}, {0.027f, 0.014f, 0.042f}, 0.009f, 24));
            s.add(box(detail, {side * 0.095f, 0.105f, 0.018f}, {0.014f, 0.02f, 0.02f}, 0.008f, 24));
        }
        return s;
    };
    const auto joints = [=] {
        Shape s = disc(detail, 0.022f, 0.03f).move(translation({0, 0.246f, 0}));
        for (const float side : {-1.0f, 1.0f}) {
            for (int ring = 0; ring < 5; ++ring) {
                s.add(torus(detail, 0.012f, 0.006f, 40, 16)
                          .move(translation({side * 0.036f, 0.036f + 0.015f * toFloat(ring), 0})));
                const float t = toFloat(ring) / 4.0f;
                s.add(torus(detail, 0.009f, 0.006f, 40, 16)
                          .move(translation(
                                    {side * (0.074f + 0.02f * std::sin(t * 2.0f)), 0.215f - 0.09f * t, 0.012f * t}) *
                                rotation(side * 25.0f * (1.0f - t), kZ)));
            }
            s.add(torus(detail, 0.013f, 0.005f, 40, 16)
                      .move(translation({side * 0.021f, 0.297f, 0.041f}) * rotation(90.0f, kX)));
        }
        for (int bar = 0; bar < 5; ++bar)
            s.add(box(detail, {-0.02f + 0.01f * toFloat(bar), 0.268f, 0.041f}, {0.003f, 0.007f, 0.002f}, 0.001f, 8));
        return s.add(tube(
            detail, {{0, 0.32f, 0}, {0, 0.345f, 0}, {0.006f, 0.37f, 0}}, [](float) { return 0.003f; }, 12, 16));
    };
    const auto knobs = [=] {
        Shape s = ball(detail, {0.007f, 0.374f, 0}, vec3(0.009f), 32);
        for (const float side : {-1.0f, 1.0f})
            s.add(disc(detail, 0.014f, 0.014f).move(translation({side * 0.053f, 0.29f, 0}) * rotation(90.0f, kZ)));
        for (int k = 0; k < 3; ++k)
            s.add(disc(detail, 0.007f, 0.008f, 24)
                      .move(translation({-0.03f + 0.02f * toFloat(k), 0.15f, 0.049f}) * rotation(90.0f, kX)));
        return s;
    };
    const auto light = [=] {
        Shape s;
        for (const float side : {-1.0f, 1.0f})
            s.add(ball(detail, {side * 0.021f, 0.297f, 0.04f}, {0.0115f, 0.0115f, 0.006f}, 32));
        return s;
    };
    const auto plate = [=] { return box(detail, {0, 0.19f, 0.045f}, {0.042f, 0.02f, 0.002f}, 0.0015f); };
    return model.mesh("robot", {{shell, body}, {dark, joints}, {red, knobs}, {eyes, light}, {panel, plate}});
}

int addGears(Model& model, const ToyPictures& pictures) {
    const Detail detail = model.detail;
    struct Gear {
        int teeth;
        vec2 at;
        std::uint32_t color;
        float turn;
    };
    constexpr float kModule = 0.0085f;  // pitch radius per tooth, metres
    const std::array<Gear, 3> gears{Gear{18, {0, 0.17f}, 0xe8b923, 0.0f},
                                    Gear{12, {0.255f * 0.8f, 0.17f - 0.255f * 0.6f + 0.02f}, 0xd23c34, 0.5f},
                                    Gear{10, {-0.2f, 0.105f}, 0x2d74b8, 0.2f}};
    std::vector<Model::Part> parts;
    for (const Gear& gear : gears) {
        const int material = model.material("gear", srgb(gear.color), 0.28f, 0.0f, pictures.paint);
        parts.push_back(
            {material, [=] {
                 const float pitch = kModule * toFloat(gear.teeth);
                 return loop(detail.around(48), detail.along(24 * gear.teeth), [=](float u, float v) {
                     // Around the cross-section: a rounded rectangle from the hub's hole to the teeth
                     const float a = 2.0f * kPi * u, c = std::cos(a), s = std::sin(a);
                     const float square =
                         1.0f / std::pow(std::pow(std::abs(c), 8.0f) + std::pow(std::abs(s), 8.0f), 0.125f);
                     const float tooth = glm::smoothstep(
                         -0.45f, 0.45f,
                         std::cos(2.0f * kPi * toFloat(gear.teeth) * (v + gear.turn / toFloat(gear.teeth))));
                     const float outer = pitch + kModule * (2.1f * tooth - 1.15f), hole = 0.25f * pitch;
                     const float r = glm::mix(hole, outer, 0.5f + 0.5f * c * square);
                     const float web =
                         glm::smoothstep(0.42f, 0.46f, r / pitch) * (1.0f - glm::smoothstep(0.76f, 0.8f, r / pitch));
                     const float half = 0.02f - 0.009f * web, angle = 2.0f * kPi * v;
                     return vec3(gear.at.x + r * std::cos(angle), gear.at.y + r * std::sin(angle), half * s * square);
                 });
             }});
    }
    const int wood = model.material("gears' stand", srgb(0xd9a866), 0.5f, 0.0f, pictures.wood);
    parts.push_back({wood, [=] {
                         Shape s = box(detail, {0, 0.012f, -0.01f}, {0.32f, 0.012f, 0.07f}, 0.006f);
                         s.add(box(detail, {0, 0.12f, -0.04f}, {0.3f, 0.12f, 0.01f}, 0.006f));
                         for (const Gear& gear : gears)
                             s.add(disc(detail, 0.24f * kModule * toFloat(gear.teeth), 0.07f)
                                       .move(translation({gear.at, 0.0f}) * rotation(90.0f, kX)));
                         return s;
                     }});
    return model.mesh("gears", std::move(parts));
}

int addKnot(Model& model, const ToyPictures& pictures) {
    const Detail detail = model.detail;
    const int image = model.picture("knot", 64, 512, [](float u, float v) {
        const float stripe = glm::smoothstep(0.45f, 0.55f, fraction(v * 24.0f + u));
        return glm::mix(srgb(0xe85d9a), srgb(0xf7e7c4), stripe);
    });
    (void)pictures;
    const int material = model.material("knot", vec3(1.0f), 0.12f, 0.0f, image);
    return model.mesh("knot",
                      {{material, [=] {
                            const auto curve = [](float v) {
                                const float a = 2.0f * kPi * v, r = 0.075f + 0.03f * std::cos(3.0f * a);
                                return vec3(r * std::cos(2.0f * a), 0.133f + r * std::sin(2.0f * a),
                                            0.042f * std::sin(3.0f * a));
                            };
                            return loop(detail.around(48), detail.along(480), [=](float u, float v) {
                                const float h = 1e-3f, a = 2.0f * kPi * u;
                                const vec3 p = curve(v), t = glm::normalize(curve(v + h) - curve(v - h));
                                const vec3 outward = p - vec3(0.0f, 0.133f, 0.0f);
                                const vec3 n = glm::normalize(outward - t * glm::dot(outward, t)), b = glm::cross(t, n);
                                const float r = 0.0235f * (1.0f + 0.06f * std::cos(2.0f * kPi * 36.0f * v + 2.0f * a));
                                return p + r * (std::cos(a) * n + std::sin(a) * b);
                            });
                        }}});
}

}  // namespace dioptre::builtin
