// Toys without an edge: isosurfaces of smooth unions.
#include <algorithm>
#include <array>

#include "scene/builtin/toys.hpp"

namespace dioptre::builtin {

namespace {

int cellsOf(const Detail& detail, int cells) {
    return std::max(16, static_cast<int>(toFloat(cells) * detail.scale));
}

vec3 mirrored(const vec3& p) {
    return {std::abs(p.x), p.y, p.z};
}

/// Tufts, a third of a millimetre to a millimetre deep.
float fur(const vec3& p) {
    return 0.0022f * fbm(p * 190.0f, 2, 5);
}

Shape pair(const Detail& detail, const vec3& at, const vec3& radii, int around = 24) {
    Shape s = ball(detail, at, radii, around);
    return s.add(ball(detail, at * vec3(-1, 1, 1), radii, around));
}

}  // namespace

int addDuck(Model& model, const ToyPictures& pictures) {
    const Detail detail = model.detail;
    const int yellow = model.material("duck", srgb(0xf6c21c), 0.22f, 0.0f, pictures.paint);
    const int orange = model.material("duck's beak", srgb(0xe8701a), 0.25f, 0.0f, pictures.paint);
    const int black = model.material("duck's eyes", srgb(0x111114), 0.08f);
    const auto body = [=] {
        return isosurface(
            [](const vec3& w) {
                const vec3 p = mirrored(w);
                float d = ellipsoid(p, {0, 0.045f, -0.005f}, {0.058f, 0.046f, 0.072f});
                d = smoothMin(d, ellipsoid(p, {0, 0.072f, -0.07f}, {0.022f, 0.02f, 0.034f}), 0.04f);          // tail
                d = smoothMin(d, ellipsoid(p, {0, 0.122f, 0.032f}, {0.041f, 0.039f, 0.041f}), 0.022f);        // head
                d = smoothMin(d, ellipsoid(p, {0.052f, 0.058f, -0.012f}, {0.016f, 0.026f, 0.042f}), 0.012f);  // wings
                const float feathers =
                    0.0012f * std::sin(190.0f * p.z + 60.0f * p.y) * glm::smoothstep(0.05f, 0.056f, p.x);
                return std::max(d - feathers, -p.y);
            },
            {-0.085f, -0.006f, -0.12f}, {0.085f, 0.175f, 0.095f}, cellsOf(detail, 110));
    };
    const auto beak = [=] {
        Shape s = ball(detail, {0, 0.116f, 0.078f}, {0.022f, 0.006f, 0.02f}, 40);
        return s.add(ball(detail, {0, 0.108f, 0.074f}, {0.018f, 0.005f, 0.016f}, 40));
    };
    const auto eyes = [=] { return pair(detail, {0.022f, 0.133f, 0.062f}, vec3(0.0065f)); };
    return model.mesh("duck", {{yellow, body}, {orange, beak}, {black, eyes}});
}

int addTeddy(Model& model, const ToyPictures& pictures) {
    const Detail detail = model.detail;
    const int plush = model.material("teddy", srgb(0xa8713c), 0.95f, 0.0f, pictures.felt);
    const int pale = model.material("teddy's snout", srgb(0xe3c292), 0.95f, 0.0f, pictures.felt);
    const int black = model.material("teddy's eyes", srgb(0x15110f), 0.1f);
    const int red = model.material("teddy's ribbon", srgb(0xc22536), 0.45f, 0.0f, pictures.felt);
    const auto body = [=] {
        return isosurface(
            [](const vec3& w) {
                const vec3 p = mirrored(w);
                float d = ellipsoid(p, {0, 0.1f, 0}, {0.078f, 0.092f, 0.07f});
                d = smoothMin(d, ellipsoid(p, {0, 0.24f, 0.008f}, {0.072f, 0.064f, 0.062f}), 0.025f);
                d = smoothMin(d, capsule(p, {0.062f, 0.15f, 0.005f}, {0.122f, 0.085f, 0.045f}, 0.03f, 0.028f), 0.02f);
                d = smoothMin(d, capsule(p, {0.045f, 0.042f, 0.02f}, {0.07f, 0.036f, 0.115f}, 0.042f, 0.035f), 0.02f);
                const float ear = std::max(ellipsoid(p, {0.058f, 0.292f, 0}, {0.03f, 0.03f, 0.016f}),
                                           -ellipsoid(p, {0.058f, 0.294f, 0.02f}, {0.02f, 0.02f, 0.012f}));
                d = smoothMin(d, ear, 0.014f);
                return d - fur(w);
            },
            {-0.17f, -0.01f, -0.09f}, {0.17f, 0.34f, 0.17f}, cellsOf(detail, 150));
    };
    const auto snout = [=] {
        return isosurface(
            [](const vec3& w) {
                const vec3 p = mirrored(w);
                const float soles = ellipsoid(p, {0.075f, 0.036f, 0.141f}, {0.027f, 0.03f, 0.014f});
                return std::min({ellipsoid(p, {0, 0.222f, 0.062f}, {0.036f, 0.029f, 0.032f}), soles}) - 0.7f * fur(w);
            },
            {-0.11f, -0.005f, 0.02f}, {0.11f, 0.26f, 0.165f}, cellsOf(detail, 100));
    };
    const auto eyes = [=] {
        Shape s = pair(detail, {0.027f, 0.258f, 0.06f}, vec3(0.0085f));
        return s.add(ball(detail, {0, 0.232f, 0.093f}, {0.013f, 0.009f, 0.008f}, 32));
    };
    const auto ribbon = [=] {
        Shape s =
            torus(detail, 0.055f, 0.011f, 80, 20).move(translation({0, 0.183f, 0.006f}) * scaling({1.0f, 0.8f, 0.95f}));
        for (const float side : {-1.0f, 1.0f})
            s.add(ball(detail, side * 0.03f * kX, {0.03f, 0.02f, 0.009f}, 40)
                      .bend([](const vec3& q) { return vec3(q.x, q.y * (0.35f + 20.0f * std::abs(q.x)), q.z); })
                      .move(translation({0, 0.178f, 0.07f})));
        return s.add(ball(detail, {0, 0.178f, 0.074f}, vec3(0.01f), 24));
    };
    return model.mesh("teddy", {{plush, body}, {pale, snout}, {black, eyes}, {red, ribbon}});
}

int addHorse(Model& model, const ToyPictures& pictures) {
    const Detail detail = model.detail;
    const int image = model.picture("horse", 512, 512, [](float u, float v) {
        vec3 color = srgb(0xc93a26) * (0.9f + 0.2f * noise({u * 20.0f, v * 20.0f, 3}));
        const float saddle = spot(glm::length(vec2((u - 0.5f) * 1.6f, (v - 0.42f) * 2.0f)), 0.24f, 0.008f);
        color = glm::mix(color, srgb(0x2c5fa8), saddle);
        const Cell dots = worley({u * 14.0f, v * 9.0f}, 5);
        color = glm::mix(color, srgb(0xf3e7c6), (1.0f - saddle) * spot(dots.nearest, 0.16f, 0.03f));
        return glm::mix(color, srgb(0xf0c23a), saddle * spot(dots.nearest, 0.22f, 0.03f));
    });
    const int paint = model.material("horse", vec3(1.0f), 0.3f, 0.0f, image);
    const int mane = model.material("horse's mane", srgb(0xf0d9a0), 0.8f, 0.0f, pictures.felt);
    const int wood = model.material("horse's rockers", srgb(0xd8a563), 0.45f, 0.0f, pictures.wood);
    const int black = model.material("horse's eyes", srgb(0x101014), 0.1f);
    const auto body = [=] {
        return isosurface(
            [](const vec3& w) {
                const vec3 p = mirrored(w);
                float d = ellipsoid(p, {0, 0.24f, -0.01f}, {0.062f, 0.062f, 0.12f});
                d = smoothMin(d, capsule(p, {0, 0.27f, 0.08f}, {0, 0.37f, 0.135f}, 0.042f, 0.03f), 0.05f);
                d = smoothMin(d, capsule(p, {0, 0.385f, 0.14f}, {0, 0.345f, 0.215f}, 0.032f, 0.022f), 0.02f);
                d = smoothMin(d, capsule(p, {0.016f, 0.41f, 0.13f}, {0.022f, 0.437f, 0.128f}, 0.01f, 0.003f), 0.012f);
                d = smoothMin(d, capsule(p, {0.042f, 0.21f, 0.075f}, {0.058f, 0.05f, 0.115f}, 0.028f, 0.014f), 0.04f);
                d = smoothMin(d, capsule(p, {0.042f, 0.21f, -0.09f}, {0.058f, 0.05f, -0.125f}, 0.03f, 0.014f), 0.04f);
                return d;
            },
            {-0.1f, 0.02f, -0.17f}, {0.1f, 0.45f, 0.26f}, cellsOf(detail, 120));
    };
    const auto hair = [=] {
        Shape s;
        for (int k = 0; k < 9; ++k) {
            const vec3 root = glm::mix(vec3(0, 0.418f, 0.13f), vec3(0, 0.3f, 0.055f), toFloat(k) / 8.0f);
            for (const float side : {-1.0f, 1.0f})
                s.add(tube(
                    detail,
                    {root, root + vec3(side * 0.03f, 0.002f, -0.016f), root + vec3(side * 0.042f, -0.05f, -0.012f)},
                    [](float v) { return 0.011f * (1.0f - 0.8f * v); }, 16, 16));
        }
        for (int k = 0; k < 5; ++k) {
            const float x = 0.012f * (toFloat(k) - 2.0f);
            s.add(tube(
                detail, {{0.3f * x, 0.27f, -0.12f}, {x, 0.24f, -0.18f}, {1.6f * x, 0.12f, -0.19f}},
                [](float v) { return 0.012f * (1.0f - 0.7f * v); }, 16, 24));
        }
        return s;
    };
    const auto rockers = [=] {
        Shape s;
        for (const float side : {-1.0f, 1.0f}) {
            std::vector<vec3> path;
            for (int k = 0; k <= 12; ++k) {
                const float z = -0.24f + 0.04f * toFloat(k);
                path.emplace_back(side * 0.06f, 0.014f + 1.15f * z * z, z);
            }
            s.add(tube(
                detail, path, [](float) { return 0.014f; }, 24, 72));
        }
        for (const float z : {-0.15f, 0.15f})
            s.add(tube(
                detail, {{-0.07f, 0.042f, z}, {0, 0.042f, z}, {0.07f, 0.042f, z}}, [](float) { return 0.009f; }, 16,
                24));
        return s;
    };
    const auto eyes = [=] { return pair(detail, {0.029f, 0.388f, 0.16f}, vec3(0.0055f)); };
    return model.mesh("rocking horse", {{paint, body}, {mane, hair}, {wood, rockers}, {black, eyes}});
}

int addOctopus(Model& model, const ToyPictures& pictures) {
    const Detail detail = model.detail;
    const int image = model.picture("octopus", 256, 256, [](float u, float v) {
        const Cell dots = worley({u * 9.0f, v * 12.0f}, 8);
        return glm::mix(srgb(0x8e4bb0), srgb(0xd59be0),
                        spot(dots.nearest, 0.13f + 0.15f * dots.id, 0.05f) * spot(v, 0.55f, 0.2f));
    });
    const int skin = model.material("octopus", vec3(1.0f), 0.4f, 0.0f, image);
    const int white = model.material("octopus's eyes", srgb(0xf6f4f0), 0.15f);
    const int black = model.material("octopus's pupils", srgb(0x101014), 0.1f);
    (void)pictures;
    const auto body = [=] {
        std::vector<std::array<vec3, 4>> arms;
        for (int k = 0; k < 8; ++k) {
            const float a = 2.0f * kPi * (toFloat(k) + 0.5f) / 8.0f, wave = k % 2 ? 0.5f : -0.4f;
            const auto at = [&](float r, float y, float turn) {
                return vec3(r * std::sin(a + turn), y, r * std::cos(a + turn));
            };
            arms.push_back({at(0.03f, 0.06f, 0), at(0.085f, 0.022f, 0.2f * wave), at(0.14f, 0.016f, 0.6f * wave),
                            at(0.17f, 0.03f, 1.1f * wave)});
        }
        return isosurface(
            [arms](const vec3& p) {
                float d = ellipsoid(p, {0, 0.13f, -0.01f}, {0.064f, 0.074f, 0.062f});
                d = smoothMin(d, ellipsoid(p, {0, 0.06f, 0}, {0.05f, 0.03f, 0.05f}), 0.03f);
                for (const auto& arm : arms) {
                    float one = capsule(p, arm[0], arm[1], 0.024f, 0.018f);
                    one = smoothMin(one, capsule(p, arm[1], arm[2], 0.018f, 0.012f), 0.008f);
                    one = smoothMin(one, capsule(p, arm[2], arm[3], 0.012f, 0.006f), 0.006f);
                    d = smoothMin(d, one, 0.014f);
                }
                return d;
            },
            {-0.2f, -0.005f, -0.2f}, {0.2f, 0.215f, 0.2f}, cellsOf(detail, 150));
    };
    const auto eyes = [=] { return pair(detail, {0.026f, 0.115f, 0.05f}, vec3(0.015f), 32); };
    const auto pupils = [=] { return pair(detail, {0.027f, 0.117f, 0.061f}, vec3(0.0068f)); };
    return model.mesh("octopus", {{skin, body}, {white, eyes}, {black, pupils}});
}

int addCar(Model& model, const ToyPictures& pictures) {
    const Detail detail = model.detail;
    const int paint = model.material("car", srgb(0x1f78c8), 0.12f, 0.0f, pictures.paint);
    const int glass = model.material("car's windows", srgb(0x1a222c), 0.05f);
    const int tyre = model.material("car's tyres", srgb(0x222225), 0.8f, 0.0f, pictures.felt);
    const int chrome = model.material("car's chrome", srgb(0xe2e4e8), 0.12f, 1.0f, pictures.metal);
    const int lamps = model.glowing("car's lamps", {8.0f, 7.6f, 6.2f});
    const auto bodyAt = [](const vec3& w, float grow) {
        const vec3 p = mirrored(w);
        float d = roundBox(p, {0, 0.052f, 0}, {0.056f, 0.026f, 0.125f}, 0.024f);
        return smoothMin(d, roundBox(p, {0, 0.09f, -0.018f}, {0.044f, 0.032f, 0.062f}, 0.028f), 0.03f) - grow;
    };
    const auto body = [=] {
        return isosurface(
            [=](const vec3& w) {
                const vec3 p = mirrored(w);
                float d = bodyAt(p, 0.0f);
                for (const float z : {-0.075f, 0.078f}) {
                    const float arch = std::max(glm::length(vec2(p.y - 0.028f, p.z - z)) - 0.034f, 0.036f - p.x);
                    d = std::max(d, -arch);
                }
                // Windows are let in
                const float pane = roundBox(p, {0.045f, 0.098f, -0.018f}, {0.02f, 0.016f, 0.045f}, 0.008f);
                return std::max(d, -std::min(pane, roundBox(p, {0, 0.098f, -0.018f}, {0.034f, 0.016f, 0.1f}, 0.008f)));
            },
            {-0.075f, 0.015f, -0.14f}, {0.075f, 0.135f, 0.14f}, cellsOf(detail, 160));
    };
    const auto windows = [=] {
        return isosurface([=](const vec3& p) { return std::max(bodyAt(p, -0.004f), 0.078f - p.y); },
                          {-0.065f, 0.07f, -0.1f}, {0.065f, 0.125f, 0.07f}, cellsOf(detail, 70));
    };
    const auto tyres = [=] {
        Shape s;
        for (const float z : {-0.075f, 0.078f})
            for (const float side : {-1.0f, 1.0f})
                s.add(torus(detail, 0.02f, 0.009f, 56, 20)
                          .move(translation({side * 0.05f, 0.029f, z}) * rotation(90.0f, kZ)));
        return s;
    };
    const auto bright = [=] {
        Shape s;
        for (const float z : {-0.075f, 0.078f})
            for (const float side : {-1.0f, 1.0f})
                s.add(ball(detail, {side * 0.051f, 0.029f, z}, {0.005f, 0.015f, 0.015f}, 32));
        for (const float z : {-1.0f, 1.0f})
            s.add(tube(
                detail, {{-0.054f, 0.036f, z * 0.12f}, {0, 0.036f, z * 0.131f}, {0.054f, 0.036f, z * 0.12f}},
                [](float) { return 0.005f; }, 16, 32));
        return s;
    };
    const auto light = [=] { return pair(detail, {0.035f, 0.058f, 0.122f}, {0.01f, 0.01f, 0.005f}); };
    return model.mesh("car", {{paint, body}, {glass, windows}, {tyre, tyres}, {chrome, bright}, {lamps, light}});
}

}  // namespace dioptre::builtin
