// Toys to make music with, and to fly.
#include <array>

#include "scene/builtin/toys.hpp"

namespace dioptre::builtin {

int addXylophone(Model& model, const ToyPictures& pictures) {
    const Detail detail = model.detail;
    const std::array<std::uint32_t, 8> colors{0xd6332f, 0xe9742a, 0xf3c52c, 0x8bbf3c,
                                              0x34a06a, 0x2b9bc0, 0x3c62b4, 0x7b45a0};
    const int wood = model.material("xylophone", srgb(0xdcae74), 0.5f, 0.0f, pictures.wood);
    const int steel = model.material("xylophone's pins", srgb(0xd0d3d8), 0.2f, 1.0f, pictures.metal);
    std::vector<Model::Part> parts{
        {wood, [=] {
             Shape s;
             for (const float side : {-1.0f, 1.0f})
                 s.add(roundedBox(detail, {0.21f, 0.016f, 0.012f}, 0.006f)
                           .move(translation({0, 0.016f, side * 0.06f}) * rotation(side * 6.0f, kY)));
             return s.add(tube(
                 detail, {{-0.1f, 0.062f, 0.13f}, {0, 0.066f, 0.03f}, {0.05f, 0.07f, -0.03f}},
                 [](float) { return 0.006f; }, 16, 24));
         }}};
    for (int k = 0; k < 8; ++k) {
        const float x = -0.182f + 0.052f * toFloat(k), half = 0.115f - 0.007f * toFloat(k);
        const int color =
            model.material("xylophone's bar", srgb(colors[static_cast<std::size_t>(k)]), 0.2f, 0.35f, pictures.paint);
        parts.push_back(
            {color, [=] {
                 return roundedBox(detail, {0.022f, 0.006f, half}, 0.005f, 24).move(translation({x, 0.042f, 0}));
             }});
    }
    parts.push_back({steel, [=] {
                         Shape s;
                         for (int k = 0; k < 16; ++k) {
                             const float x = -0.182f + 0.052f * toFloat(k / 2),
                                         z = (k % 2 ? 0.062f : -0.062f) + (k % 2 ? -1.0f : 1.0f) * 0.1f * x * 0.8f;
                             s.add(ball(detail, {x, 0.048f, z}, {0.005f, 0.004f, 0.005f}, 16));
                         }
                         return s;
                     }});
    const int red = model.material("xylophone's mallet", srgb(0xd2302c), 0.3f, 0.0f, pictures.paint);
    parts.push_back({red, [=] { return ball(detail, {0.05f, 0.07f, -0.03f}, vec3(0.017f), 32); }});
    return model.mesh("xylophone", std::move(parts));
}

int addKite(Model& model, const ToyPictures& pictures) {
    const Detail detail = model.detail;
    const int image = model.picture("kite", 256, 512, [](float u, float v) {
        const float weave = 0.92f + 0.08f * noise({u * 120.0f, v * 240.0f, 2});
        const bool left = u < 0.5f, top = v < 0.36f;
        vec3 color = srgb(left == top ? 0xe23d31 : 0xf5c832);
        const float sun = glm::length((vec2(u, v) - vec2(0.5f, 0.36f)) * vec2(1.0f, 1.5f));
        color = glm::mix(color, srgb(0x2467ae), spot(sun, 0.2f, 0.008f));
        color = glm::mix(color, srgb(0xf8f3e6), spot(sun, 0.12f, 0.008f));
        return color * weave;
    });
    const int cloth = model.material("kite", vec3(1.0f), 0.7f, 0.0f, image);
    const int wood = model.material("kite's spars", srgb(0xb98950), 0.5f, 0.0f, pictures.wood);
    const int red = model.material("kite's bows", srgb(0xe23d31), 0.7f, 0.0f, pictures.felt);
    const int line = model.material("kite's line", srgb(0xf2ecd8), 0.8f);
    const auto tailPoint = [](float t) {
        return vec3(0.09f * std::sin(7.0f * t) * (0.4f + t), -0.42f - 0.75f * t, 0.08f * std::sin(5.0f * t + 1.0f));
    };
    const auto sail = [=] {
        Fin kite;
        const auto half = [](float v) { return v < 0.36f ? 0.3f * v / 0.36f : 0.3f * (1.0f - v) / 0.64f; };
        const auto at = [=](float v, float side) {
            const float x = side * (half(v) + 0.002f);
            return vec3(x, 0.36f - 0.78f * v, -0.25f * std::abs(x) + 0.02f * std::sin(9.0f * v));
        };
        kite.root = [=](float v) { return at(v, -1.0f); };
        kite.rim = [=](float v) { return at(v, 1.0f); };
        kite.side = [](float, float) { return 0.0015f * kZ; };
        Shape s = fin(detail.around(128), detail.along(120), kite);
        // Belly between the spars
        return s.bend([](const vec3& p) { return p + vec3(0, 0, 0.05f * std::cos(p.x * 5.0f)); });
    };
    const auto spars = [=] {
        Shape s = tube(
            detail, {{0, 0.37f, 0.045f}, {0, 0, 0.042f}, {0, -0.42f, 0.045f}}, [](float) { return 0.005f; }, 16, 40);
        return s.add(tube(
            detail, {{-0.31f, 0.08f, -0.06f}, {0, 0.08f, 0.04f}, {0.31f, 0.08f, -0.06f}}, [](float) { return 0.005f; },
            16, 40));
    };
    const auto bows = [=] {
        Shape s;
        for (int k = 0; k < 6; ++k) {
            const vec3 p = tailPoint(0.12f + 0.15f * toFloat(k));
            for (const float side : {-1.0f, 1.0f})
                s.add(ball(detail, side * 0.035f * kX, {0.034f, 0.02f, 0.006f}, 32)
                          .bend([](const vec3& q) { return vec3(q.x, q.y * (0.35f + 18.0f * std::abs(q.x)), q.z); })
                          .move(translation(p) * rotation(25.0f * std::sin(3.0f * toFloat(k)), kZ)));
            s.add(ball(detail, p, vec3(0.009f), 16));
        }
        return s;
    };
    const auto tail = [=] {
        std::vector<vec3> path;
        for (int k = 0; k <= 24; ++k) path.push_back(tailPoint(toFloat(k) / 24.0f));
        Shape s = tube(
            detail, path, [](float) { return 0.003f; }, 8, 120);
        return s.add(tube(
            detail, {{0, 0.05f, 0.05f}, {0.1f, -0.7f, 0.9f}, {0.1f, -1.9f, 2.0f}}, [](float) { return 0.002f; }, 8,
            60));
    };
    return model.mesh("kite", {{cloth, sail}, {wood, spars}, {red, bows}, {line, tail}});
}

}  // namespace dioptre::builtin
