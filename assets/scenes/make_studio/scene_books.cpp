// The bookcase's contents.
#include <algorithm>
#include <cmath>

#include "paints.hpp"
#include "scene.hpp"
#include "shapes.hpp"

namespace studio {

void addBook(Object& object, const mat4& m, const BookSize& b, std::uint32_t seed, float sideDetail) {
    const float w = b.thickness * 0.5f, h = b.height, d = b.depth * 0.5f, round = 0.14f * b.thickness;
    const auto spine = surface(5, 2, [=](float u, float v) {
        const float x = 2.0f * u - 1.0f;
        return vec3(x * w, h * (1.0f - v), d + round * (1.0f - x * x));
    });
    object.add(place(spine, m), bookSpine(seed));
    const Patches boards{rectangle({-w, h, -d}, {0, 0, 2 * d}, {0, -h, 0}),
                         rectangle({w, h, d}, {0, 0, -2 * d}, {0, -h, 0})};
    object.add(place(boards, m), bookCover(seed), sideDetail);
    const float board = std::min(0.0025f, 0.2f * b.thickness), gap = 0.004f;
    object.add(place(rectangle({-w + board, h - gap, -d}, {2 * (w - board), 0, 0}, {0, 0, 2 * d}), m), bookPages(),
               sideDetail);
    if (sideDetail < 0.3f) return;  // on a shelf nobody sees more
    object.add(place(rectangle({w - board, h - gap, -d + gap}, {-2 * (w - board), 0, 0}, {0, -h + 2 * gap, 0}), m),
               bookPages(), sideDetail);
    // The boards' edges around the pages.
    const Patches edges{rectangle({-w, h, -d}, {board, 0, 0}, {0, 0, 2 * d}),
                        rectangle({w - board, h, -d}, {board, 0, 0}, {0, 0, 2 * d}),
                        rectangle({-w + board, h, -d}, {0, 0, 0.0f + 2 * d}, {0, -gap, 0}),
                        rectangle({w - board, h, d}, {0, 0, -2 * d}, {0, -gap, 0}),
                        rectangle({w, h, -d}, {-board, 0, 0}, {0, -h, 0}),
                        rectangle({-w + board, h, -d}, {-board, 0, 0}, {0, -h, 0})};
    object.add(place(edges, m), bookCover(seed), 0.3f * sideDetail);
}

void addBooks(Model& model) {
    Object& books = model.add("books", Finish::baked, 1024, 512);
    books.lightStep = 5.0f;
    const float front = kWest + 0.26f;
    const float floors[] = {0.06f, 0.44f, 0.80f, 1.15f, 1.50f, 1.85f};
    Rng rng(2024);
    std::uint32_t seed = 100;
    Patches jars;
    for (int shelf = 0; shelf < 6; ++shelf) {
        for (int bay = 0; bay < 2; ++bay) {
            float z = bay == 0 ? -1.49f : -2.71f;
            const float end = z - 1.14f;
            const float gapAt = rng.range(0.15f, 0.75f) * 1.14f, start = z;
            bool gapDone = false;
            while (z > end + 0.07f) {
                if (!gapDone && start - z > gapAt) {
                    // A gap with something in it: a jar, or books lying down.
                    gapDone = true;
                    if (rng.next() < 0.45f) {
                        const float r = rng.range(0.045f, 0.065f), h = rng.range(0.12f, 0.2f);
                        jars.push_back(place(lathe({{r * 0.35f, h},
                                                    {r * 0.42f, h * 0.96f},
                                                    {r * 0.40f, h * 0.86f},
                                                    {r * 0.95f, h * 0.62f},
                                                    {r, h * 0.4f},
                                                    {r * 0.7f, 0.02f},
                                                    {r * 0.6f, 0.0f}},
                                                   16, 10),
                                             translation({front - 0.09f, floors[shelf], z - 0.085f})));
                        z -= 0.17f;
                    } else {
                        float y = floors[shelf];
                        for (int k = 0; k < 3; ++k) {
                            const BookSize size{rng.range(0.02f, 0.04f), rng.range(0.19f, 0.23f),
                                                rng.range(0.14f, 0.16f)};
                            const mat4 lying = translation({front - 0.08f, y + size.thickness * 0.5f, z - 0.01f}) *
                                               rotation(rng.range(-5, 5), kY) * rotation(90, kY) * rotation(-90, kZ) *
                                               translation({0, 0.0f, 0});
                            addBook(books, lying, size, seed++, 0.25f);
                            y += size.thickness;
                        }
                        z -= 0.25f;
                    }
                    continue;
                }
                const BookSize size{rng.range(0.016f, 0.046f), rng.range(0.19f, 0.285f), rng.range(0.13f, 0.19f)};
                const bool leans = rng.next() < 0.07f;
                if (leans) z -= 0.03f;
                const mat4 m = translation({front - size.depth * 0.5f - rng.range(0.0f, 0.012f), floors[shelf],
                                            z - size.thickness * 0.5f}) *
                               rotation(90, kY) * rotation(leans ? -9.0f : 0.0f, kZ);
                addBook(books, m, size, seed++, 0.22f);
                z -= size.thickness + 0.0015f;
                if (leans) z -= 0.02f;
            }
        }
    }
    Object& pots = model.add("shelf jars", Finish::baked, 256, 256);
    pots.gloss = {vec3(0.05f), 0.2f};
    pots.lightStep = 3.0f;
    const vec3 glazes[] = {srgb(0xd8d0bc), srgb(0x3f6f7a), srgb(0xb0582f), srgb(0x6a7f52), srgb(0x2e3a4c)};
    for (std::size_t k = 0; k < jars.size(); ++k) pots.add(jars[k], ceramic(glazes[k % 5], srgb(0xa9825c), 0.3f));
    // A plaster head-like form and a ball on top of the case.
    pots.add(place(lathe({{0.0f, 0.30f},
                          {0.05f, 0.29f},
                          {0.085f, 0.22f},
                          {0.075f, 0.15f},
                          {0.045f, 0.10f},
                          {0.05f, 0.07f},
                          {0.09f, 0.04f},
                          {0.09f, 0.0f}},
                         24, 20),
                   translation({kWest + 0.15f, 2.2f, -2.2f})),
             plain(srgb(0xe0d8cc)));
}

}  // namespace studio
