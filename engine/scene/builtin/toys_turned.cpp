// Toys that a lathe or a mould makes.
#include <algorithm>
#include <array>

#include "scene/builtin/toys.hpp"

namespace dioptre::builtin {

ToyPictures addToyPictures(Model& model) {
    return {model.picture("paint", 256, 256, mottled(6, 0.16f, 1)), model.picture("wood", 512, 512, woodGrain(2)),
            model.picture("felt", 512, 512, felt(3)), model.picture("metal", 256, 256, brushed(4))};
}

int addBall(Model& model) {
    // Six panels that meet at the poles; every texel of the cube's unfolded faces knows its direction.
    const int image = model.picture("ball", 768, 512, [](float u, float v) {
        const float s = fraction(u * 3.0f) * 2.0f - 1.0f, t = fraction(v * 2.0f) * 2.0f - 1.0f;
        const int face = static_cast<int>(u * 3.0f) + 3 * static_cast<int>(v * 2.0f);
        const std::array<vec3, 6> places{vec3{1, -t, -s}, {-1, -t, s}, {s, 1, t},
                                         {s, -1, -t},     {s, -t, 1},  {-s, -t, -1}};
        const vec3 d = glm::normalize(places[static_cast<std::size_t>(face)]);
        const float panel = (std::atan2(d.x, d.z) / (2.0f * kPi) + 0.5f) * 6.0f;
        const std::array<std::uint32_t, 6> colors{0xd8262c, 0xf4f1ea, 0x1f5fae, 0xf6c52b, 0xf4f1ea, 0x2f9a55};
        vec3 color = srgb(colors[static_cast<std::size_t>(panel) % 6]);
        const float seam = std::min(fraction(panel), 1.0f - fraction(panel)) * std::sqrt(1.0f - d.y * d.y);
        color *= 1.0f - 0.35f * spot(seam, 0.02f, 0.01f);
        return glm::mix(color, srgb(0xf4f1ea), spot(1.0f - std::abs(d.y), 0.035f, 0.003f)) *
               (0.92f + 0.08f * noise(d * 30.0f));
    });
    const int material = model.material("ball", vec3(1.0f), 0.28f, 0.0f, image);
    const int steps = model.detail.around(64);
    return model.mesh("ball", {{material, [=] {
                                    return cube(steps, [](const vec3& c) {
                                        // Tangents spread the grid evenly
                                        return 0.12f * (kY + glm::normalize(glm::tan(c * (0.25f * kPi))));
                                    });
                                }}});
}

int addTop(Model& model, const ToyPictures& pictures) {
    const int stripes = model.picture("top", 64, 512, [](float, float v) {
        const std::array<std::uint32_t, 5> colors{0xe23b2e, 0xf7d13d, 0x2a7fc4, 0xf4efe2, 0x35a162};
        const float at = v * 17.0f;
        const vec3 color = srgb(colors[static_cast<std::size_t>(at) % 5]);
        return color * (1.0f - 0.5f * spot(std::min(fraction(at), 1.0f - fraction(at)), 0.03f, 0.02f));
    });
    const Detail detail = model.detail;
    const int paint = model.material("top", vec3(1.0f), 0.22f, 0.0f, stripes);
    const int metal = model.material("top's tip", srgb(0xd9c27a), 0.25f, 1.0f, pictures.metal);
    const mat4 lean = rotation(14.0f, {1.0f, 0.0f, 0.4f});
    const auto body = [=] {
        return lathe(detail,
                     {{0, 0.012f},
                      {0.012f, 0.014f},
                      {0.05f, 0.03f},
                      {0.085f, 0.058f},
                      {0.088f, 0.07f},
                      {0.06f, 0.083f},
                      {0.02f, 0.09f},
                      {0.012f, 0.1f},
                      {0.01f, 0.145f},
                      {0.014f, 0.152f},
                      {0.012f, 0.162f},
                      {0, 0.164f}},
                     96, 120)
            .move(lean);
    };
    const auto tip = [=] {
        return lathe(detail, {{0, 0}, {0.003f, 0.001f}, {0.011f, 0.013f}, {0.012f, 0.018f}, {0, 0.018f}}, 32, 24)
            .move(lean);
    };
    return model.mesh("spinning top", {{paint, body}, {metal, tip}});
}

int addDoll(Model& model) {
    // Painted from the crown (v = 0) to the foot, mirrored: u = 0 in front
    const int image = model.picture("doll", 512, 1024, [](float u, float v) {
        const float x = u * 2.2f, y = v;  // about square metres of surface
        vec3 color = glm::mix(srgb(0xb9202f), srgb(0x8e1526), noise({u * 5.0f, v * 9.0f, 0}));
        // Apron with flowers
        const float apron = spot(glm::length(vec2(x * 0.8f, (y - 0.68f) * 2.2f)), 0.46f, 0.01f);
        vec3 cloth = srgb(0xf3e3b5);
        for (int i = 0; i < 5; ++i) {
            const std::array<vec2, 5> places{
                vec2{0.0f, 0.66f}, {0.24f, 0.60f}, {0.22f, 0.75f}, {0.42f, 0.68f}, {0.0f, 0.80f}};
            const vec2 q = (vec2(x, y) - places[static_cast<std::size_t>(i)]) * vec2(1.0f, 2.0f);
            const float petals = 0.055f * (1.0f + 0.35f * std::cos(6.0f * std::atan2(q.y, q.x)));
            cloth = glm::mix(cloth, srgb(i % 2 ? 0x2b5fa8 : 0xd3352f), spot(glm::length(q), petals, 0.006f));
            cloth = glm::mix(cloth, srgb(0xf7cd39), spot(glm::length(q), 0.018f, 0.005f));
        }
        color = glm::mix(color, cloth, apron);
        // Kerchief with dots, face
        if (v < 0.42f) color = srgb(0xe9a527);
        const vec2 cell(fraction(u * 6.0f) - 0.5f, fraction(v * 16.0f) - 0.5f);
        if (v < 0.42f) color = glm::mix(color, srgb(0x7d1d55), spot(glm::length(cell), 0.16f, 0.04f));
        const vec2 f((x) / 0.50f, (y - 0.26f) / 0.13f);
        const float face = spot(glm::length(f), 1.0f, 0.03f);
        vec3 skin = srgb(0xf6d3ae);
        skin = glm::mix(skin, srgb(0xe58a78), 0.7f * spot(glm::length(f - vec2(0.55f, 0.30f)), 0.22f, 0.2f));
        skin = glm::mix(skin, srgb(0x3b2314),
                        spot(glm::length((f - vec2(0.38f, -0.12f)) * vec2(1.0f, 0.75f)), 0.10f, 0.03f));
        skin =
            glm::mix(skin, srgb(0xc02733), spot(glm::length((f - vec2(0.0f, 0.45f)) * vec2(0.7f, 1.4f)), 0.13f, 0.03f));
        skin = glm::mix(skin, srgb(0x3b2314), spot(glm::length(f - vec2(0.0f, -1.15f)), 0.62f, 0.03f));  // hair
        color = glm::mix(color, skin, face);
        color = glm::mix(color, srgb(0x2b5fa8), spot(std::abs(v - 0.43f), 0.008f, 0.003f));
        color = glm::mix(color, srgb(0xf0c435), spot(std::abs(v - 0.93f), 0.012f, 0.003f));
        return color;
    });
    const Detail detail = model.detail;
    const int paint = model.material("doll", vec3(1.0f), 0.3f, 0.0f, image);
    const auto shape = [=] {
        return lathe(detail,
                     {{0, 0.19f},
                      {0.02f, 0.19f},
                      {0.04f, 0.178f},
                      {0.046f, 0.15f},
                      {0.04f, 0.124f},
                      {0.043f, 0.112f},
                      {0.06f, 0.085f},
                      {0.064f, 0.055f},
                      {0.056f, 0.018f},
                      {0.048f, 0.002f},
                      {0.044f, 0},
                      {0, 0}},
                     128, 128);
    };
    return model.mesh("doll", {{paint, shape}});
}

int addRingStack(Model& model, const ToyPictures& pictures) {
    const Detail detail = model.detail;
    const int wood = model.material("stack's foot", srgb(0xe2b77a), 0.5f, 0.0f, pictures.wood);
    std::vector<Model::Part> parts{{wood, [=] {
                                        return lathe(detail,
                                                     {{0, 0},
                                                      {0.08f, 0},
                                                      {0.085f, 0.004f},
                                                      {0.085f, 0.016f},
                                                      {0.07f, 0.02f},
                                                      {0.014f, 0.021f},
                                                      {0.012f, 0.03f},
                                                      {0.011f, 0.2f},
                                                      {0.004f, 0.212f},
                                                      {0, 0.213f}},
                                                     64, 72);
                                    }}};
    const std::array<std::uint32_t, 6> colors{0xd62f2f, 0xee7d22, 0xf4c92e, 0x3fa34d, 0x2c77be, 0x7a3fa0};
    float height = 0.021f;
    for (std::size_t i = 0; i < colors.size(); ++i) {
        const float tubeRadius = 0.0165f - 0.0007f * static_cast<float>(i),
                    ring = 0.062f - 0.0062f * static_cast<float>(i);
        const float tilt = i == 4 ? 5.0f : 0.0f;
        const int color = model.material("ring", srgb(colors[i]), 0.3f, 0.0f, pictures.paint);
        const float y = height + tubeRadius;
        parts.push_back(
            {color,
             [=] { return torus(detail, ring, tubeRadius, 96, 32).move(translation(y * kY) * rotation(tilt, kX)); }});
        height += 1.86f * tubeRadius;
    }
    return model.mesh("ring stack", std::move(parts));
}

int addDrum(Model& model, const ToyPictures& pictures) {
    const Detail detail = model.detail;
    const int shellPicture = model.picture("drum", 512, 256, [](float u, float v) {
        // A zigzag of cord over red, 7 teeth to each half
        const float zigzag = std::abs(fraction(u * 7.0f) * 2.0f - 1.0f);
        const vec3 red = srgb(0xc4252c) * (0.9f + 0.2f * noise({u * 30.0f, v * 30.0f, 0}));
        return glm::mix(red, srgb(0xf5ead0), spot(std::abs(v - 0.18f - 0.64f * zigzag), 0.035f, 0.015f));
    });
    const int shell = model.material("drum", vec3(1.0f), 0.4f, 0.0f, shellPicture);
    const int rim = model.material("drum's rim", srgb(0x2d5fa5), 0.3f, 0.0f, pictures.paint);
    const int skin = model.material("drum's skin", srgb(0xf0e4cb), 0.6f, 0.0f, pictures.felt);
    const int wood = model.material("drum sticks", srgb(0xd9a15c), 0.45f, 0.0f, pictures.wood);
    const auto body = [=] {
        return lathe(detail,
                     {{0, 0.01f}, {0.118f, 0.01f}, {0.12f, 0.012f}, {0.12f, 0.148f}, {0.118f, 0.15f}, {0, 0.15f}}, 96,
                     64, 1);
    };
    const auto rims = [=] {
        Shape rings = torus(detail, 0.121f, 0.009f, 96, 24).move(translation(0.009f * kY));
        return rings.add(torus(detail, 0.121f, 0.009f, 96, 24).move(translation(0.151f * kY)));
    };
    const auto head = [=] {
        return lathe(detail, {{0, 0.15f}, {0.116f, 0.15f}, {0.118f, 0.154f}, {0, 0.156f}}, 64, 40);
    };
    const auto sticks = [=] {
        Shape both;
        for (const float side : {-1.0f, 1.0f}) {
            const vec3 a(side * 0.02f, 0.166f, 0.12f), b(side * 0.075f, 0.168f, -0.11f);
            both.add(tube(
                detail, {a, glm::mix(a, b, 0.5f), b}, [](float) { return 0.0055f; }, 16, 24));
            both.add(ball(detail, b, vec3(0.012f), 24));
        }
        return both;
    };
    return model.mesh("drum", {{shell, body}, {rim, rims}, {skin, head}, {wood, sticks}});
}

int addSkittle(Model& model, const ToyPictures& pictures) {
    const Detail detail = model.detail;
    const int image = model.picture("skittle", 64, 512, [](float, float v) {
        const bool band = (v > 0.23f && v < 0.27f) || (v > 0.29f && v < 0.33f) || v > 0.9f;
        return band ? srgb(0xc2282d) : srgb(0xf5f0e4);
    });
    (void)pictures;
    const int paint = model.material("skittle", vec3(1.0f), 0.2f, 0.0f, image);
    return model.mesh("skittle", {{paint, [=] {
                                       return lathe(detail,
                                                    {{0, 0.3f},
                                                     {0.018f, 0.3f},
                                                     {0.028f, 0.285f},
                                                     {0.028f, 0.262f},
                                                     {0.018f, 0.232f},
                                                     {0.017f, 0.21f},
                                                     {0.03f, 0.16f},
                                                     {0.044f, 0.11f},
                                                     {0.042f, 0.06f},
                                                     {0.03f, 0.012f},
                                                     {0.028f, 0},
                                                     {0, 0}},
                                                    72, 96);
                                   }}});
}

int addRocket(Model& model, const ToyPictures& pictures) {
    const Detail detail = model.detail;
    const int image = model.picture("rocket", 256, 512, [](float u, float v) {
        if (v < 0.22f) return srgb(0xd8312c);
        const bool check =
            v > 0.72f && v < 0.80f && (static_cast<int>(u * 16.0f) + static_cast<int>((v - 0.72f) * 50.0f)) % 2;
        return (check ? srgb(0x20242c) : srgb(0xeef0f2)) * (0.93f + 0.07f * noise({u * 20.0f, v * 40.0f, 1}));
    });
    const int body = model.material("rocket", vec3(1.0f), 0.25f, 0.0f, image);
    const int red = model.material("rocket's fins", srgb(0xd8312c), 0.3f, 0.0f, pictures.paint);
    const int metal = model.material("rocket's nozzle", srgb(0x9aa0a8), 0.3f, 1.0f, pictures.metal);
    const int window = model.glowing("rocket's window", {1.2f, 3.2f, 4.4f});
    const auto hull = [=] {
        return lathe(detail,
                     {{0, 0.5f},
                      {0.012f, 0.49f},
                      {0.05f, 0.41f},
                      {0.07f, 0.31f},
                      {0.072f, 0.2f},
                      {0.055f, 0.1f},
                      {0.045f, 0.08f},
                      {0, 0.08f}},
                     96, 128);
    };
    const auto fins = [=] {
        Shape all;
        for (int k = 0; k < 3; ++k) {
            Fin blade;
            blade.root = [](float t) { return vec3(0.0f, 0.22f - 0.14f * t, 0.05f); };
            blade.rim = [](float t) { return vec3(0.0f, 0.2f - 0.2f * t, 0.06f + 0.09f * std::pow(t, 0.7f)); };
            blade.side = [](float t, float out) {
                return 0.012f * (1.0f - 0.6f * out) *
                       std::sqrt(std::max(0.0f, 1.0f - std::pow(2.0f * t - 1.0f, 6.0f))) * kX;
            };
            all.add(fin(detail.around(48), detail.along(40), blade).move(rotation(60.0f + 120.0f * toFloat(k), kY)));
        }
        return all;
    };
    const auto nozzle = [=] {
        return lathe(detail, {{0, 0.05f}, {0.03f, 0.05f}, {0.038f, 0.052f}, {0.03f, 0.085f}, {0, 0.09f}}, 48, 32);
    };
    const auto rings = [=] {
        return torus(detail, 0.026f, 0.006f, 48, 16).move(translation({0, 0.33f, 0.062f}) * rotation(80.0f, kX));
    };
    const auto pane = [=] { return ball(detail, {0, 0.33f, 0.062f}, {0.022f, 0.022f, 0.008f}); };
    return model.mesh("rocket", {{body, hull}, {red, fins}, {metal, nozzle}, {metal, rings}, {window, pane}});
}

int addMarble(Model& model, const vec3& color) {
    const int image = model.picture("marble", 128, 128, [color](float u, float v) {
        const float swirl =
            0.5f + 0.5f * std::sin(14.0f * v + 6.0f * u + 5.0f * noise({u * 4.0f, v * 4.0f, color.x * 9.0f}));
        return glm::mix(color * 0.35f, glm::mix(color, vec3(0.9f), 0.5f), swirl * swirl);
    });
    const int glass = model.material("marble", vec3(1.0f), 0.06f, 0.0f, image);
    const Detail detail = model.detail;
    return model.mesh("marble", {{glass, [=] { return ball(detail, {0, 0.018f, 0}, vec3(0.018f), 48); }}});
}

}  // namespace dioptre::builtin
