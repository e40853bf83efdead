// Walls, floor, windows, curtains.
#include <cmath>

#include "paints.hpp"
#include "scene.hpp"
#include "shapes.hpp"

namespace studio {

namespace {

/// A wall with one opening as four rectangles around it. `right` and `down` span the wall from its top left corner.
Patches wallWithOpening(const vec3& topLeft, const vec3& right, const vec3& down, const vec2& low, const vec2& high) {
    const auto part = [&](float u0, float v0, float u1, float v1) {
        return rectangle(topLeft + u0 * right + v0 * down, (u1 - u0) * right, (v1 - v0) * down);
    };
    return {part(0, 0, low.x, 1), part(high.x, 0, 1, 1), part(low.x, 0, high.x, low.y), part(low.x, high.y, high.x, 1)};
}

/// Frame and glazing bars of a two-casement window, in its plane: x from 0 to width, y from 0 to height, z outwards
/// negative.
Patches casements(float width, float height) {
    Patches parts;
    const auto bar = [&](float x0, float y0, float x1, float y1, float depth) {
        const Patches b = box({x0, y0, -depth}, {x1, y1, 0.0f});
        parts.insert(parts.end(), b.begin(), b.end());
    };
    const float f = 0.055f, half = width * 0.5f;
    bar(0, 0, width, f, 0.07f);
    bar(0, height - f, width, height, 0.07f);
    bar(0, f, f, height - f, 0.07f);
    bar(width - f, f, width, height - f, 0.07f);
    bar(half - 0.045f, f, half + 0.045f, height - f, 0.075f);
    for (const float side : {0.0f, 1.0f}) {
        const float x0 = side == 0.0f ? f : half + 0.045f, x1 = side == 0.0f ? half - 0.045f : width - f;
        const float middle = 0.5f * (x0 + x1);
        bar(middle - 0.011f, f, middle + 0.011f, height - f, 0.03f);
        for (const float y : {0.36f, 0.70f}) bar(x0, height * y - 0.011f, x1, height * y + 0.011f, 0.032f);
    }
    return parts;
}

Patch curtain(float x0, float x1, float folds, float phase) {
    const float top = 2.47f, bottom = 0.06f;
    return surface(65, 9, [=](float u, float v) {
        const float gather = 0.75f + 0.25f * v;  // folds open towards the hem
        const float middle = 0.5f * (x0 + x1);
        const float wave = std::sin(2.0f * kPi * (folds * u + phase)) +
                           0.35f * std::sin(2.0f * kPi * (folds * 2.3f * u + phase + v * 0.4f));
        return vec3(middle + (x0 + (x1 - x0) * u - middle) * gather + 0.008f * wave, top + (bottom - top) * v,
                    kNorth + 0.11f + (0.022f + 0.016f * v) * wave);
    });
}

}  // namespace

void addShell(Model& model) {
    Object& floor = model.add("floor", Finish::baked, 1024, 512);
    floor.lightStep = 5.0f;
    floor.gloss = {vec3(0.045f), 0.16f};
    // The part that the main camera sees has most of the texels.
    floor.add(rectangle({kWest, 0, kNorth}, {kEast - kWest, 0, 0}, {0, 0, 2.6f}, 13, 13),
              floorBoards(srgb(0xb98a58), srgb(0x6e4626)));
    floor.add(rectangle({kWest, 0, kNorth + 2.6f}, {kEast - kWest, 0, 0}, {0, 0, kSouth - kNorth - 2.6f}, 9, 9),
              floorBoards(srgb(0xb98a58), srgb(0x6e4626)), 0.45f);

    Object& wall = model.add("brick wall", Finish::baked, 1024, 512);
    wall.lightStep = 5.0f;
    const float width = kEast - kWest;
    const vec2 low((kWindowLeft - kWest) / width, (kCeiling - kWindowTop) / kCeiling);
    const vec2 high((kWindowRight - kWest) / width, (kCeiling - kWindowSill) / kCeiling);
    Patches parts = wallWithOpening({kWest, kCeiling, kNorth}, {width, 0, 0}, {0, -kCeiling, 0}, low, high);
    parts[1].detail = 0.7f;
    parts[2].detail = 0.5f;
    wall.add(parts, brick());
    const vec3 in(0, 0, kWallDepth);
    const float back = kNorth - kWallDepth, tall = kWindowTop - kWindowSill, wide = kWindowRight - kWindowLeft;
    wall.add(Patches{rectangle({kWindowLeft, kWindowTop, kNorth}, {0, 0, -kWallDepth}, {0, -tall, 0}),
                     rectangle({kWindowRight, kWindowTop, back}, in, {0, -tall, 0}),
                     rectangle({kWindowLeft, kWindowTop, kNorth}, {wide, 0, 0}, {0, 0, -kWallDepth}),
                     rectangle({kWindowLeft, kWindowSill, back}, {wide, 0, 0}, in)},
             plaster(srgb(0xd9cbb4)), 0.4f);

    Object& room = model.add("plaster walls", Finish::baked, 512, 512);
    room.lightStep = 4.0f;
    const float deep = kSouth - kNorth;
    const vec3 tone = srgb(0xc9bda6);
    room.add(rectangle({kWest, kCeiling, kSouth}, {0, 0, -deep}, {0, -kCeiling, 0}), plaster(tone));
    const vec2 sideLow((kSideFar - kNorth) / deep, (kCeiling - kSideTop) / kCeiling),
        sideHigh((kSideNear - kNorth) / deep, (kCeiling - kSideSill) / kCeiling);
    room.add(wallWithOpening({kEast, kCeiling, kNorth}, {0, 0, deep}, {0, -kCeiling, 0}, sideLow, sideHigh),
             plaster(tone));
    room.add(rectangle({kEast, kCeiling, kSouth}, {-width, 0, 0}, {0, -kCeiling, 0}), plaster(srgb(0x5f7470)));
    room.add(rectangle({kWest, kCeiling, kSouth}, {width, 0, 0}, {0, 0, -deep}), plaster(srgb(0xe0d8c8)));
    const vec3 outwards(kWallDepth, 0, 0);
    const float sideTall = kSideTop - kSideSill, sideWide = kSideNear - kSideFar;
    room.add(Patches{rectangle({kEast, kSideTop, kSideFar}, outwards, {0, -sideTall, 0}),
                     rectangle({kEast + kWallDepth, kSideTop, kSideNear}, -outwards, {0, -sideTall, 0}),
                     rectangle({kEast, kSideTop, kSideNear}, {0, 0, -sideWide}, outwards),
                     rectangle({kEast, kSideSill, kSideFar}, {0, 0, sideWide}, outwards)},
             plaster(tone), 0.5f);
    // A door behind the viewer.
    const mat4 turned = translation({1.75f, 0.0f, kSouth}) * rotation(180, kY);
    Patches door = box({0.0f, 0.0f, 0.0f}, {0.92f, 2.08f, 0.03f});
    for (const float y : {0.18f, 1.12f})
        for (const float x : {0.16f, 0.51f}) {
            const Patches panel = roundedBox({x, y, 0.02f}, {x + 0.27f, y + 0.76f, 0.045f}, 0.012f, 3);
            door.insert(door.end(), panel.begin(), panel.end());
        }
    room.add(place(door, turned), wood(srgb(0xa87848), srgb(0x6a4526), false), 0.7f);
    room.add(place(ball(0.032f, 14, 10), turned * translation({0.84f, 1.02f, 0.07f})), plain(srgb(0x8a6a3c)), 0.7f);
    const Patches beams = join({box({kWest, 2.66f, -2.9f}, {kEast, kCeiling, -2.74f}),
                                box({kWest, 2.66f, -1.5f}, {kEast, kCeiling, -1.34f}),
                                box({kWest, 2.66f, -0.1f}, {kEast, kCeiling, 0.06f})});
    room.add(beams, wood(srgb(0x8a6038), srgb(0x4a2f1c), true), 0.5f);

    Object& window = model.add("windows", Finish::baked, 512, 512);
    window.lightStep = 3.0f;
    const Paint painted = plain(srgb(0xe6dcc8), 0.05f);
    window.add(place(casements(wide, tall), translation({kWindowLeft, kWindowSill, kNorth - 0.07f})), painted);
    window.add(
        place(casements(sideWide, sideTall), translation({kEast + 0.07f, kSideSill, kSideFar}) * rotation(-90, kY)),
        painted, 0.4f);
    window.add(roundedBox({kWindowLeft - 0.08f, kWindowSill - 0.03f, kNorth - 0.08f},
                          {kWindowRight + 0.08f, kWindowSill + 0.008f, kNorth + 0.16f}, 0.012f, 4),
               wood(srgb(0xd8c8a8), srgb(0xb49a70), true), 0.8f);
    // Curtain rod with turned ends.
    const Paint iron = plain(srgb(0x3a3028), 0.1f);
    window.add(tube({{-0.72f, 2.49f, kNorth + 0.11f}, {1.95f, 2.49f, kNorth + 0.11f}}, 0.011f, 8, 2), iron, 0.5f);
    window.add(place(ball(0.026f, 12, 8), translation({-0.74f, 2.49f, kNorth + 0.11f})), iron, 0.5f);
    window.add(place(ball(0.026f, 12, 8), translation({1.97f, 2.49f, kNorth + 0.11f})), iron, 0.5f);
    // Skirting boards.
    window.add(box({kWest, 0, kNorth}, {kEast, 0.11f, kNorth + 0.018f}), painted, 0.3f);

    Object& drapes = model.add("curtains", Finish::baked, 512, 512);
    drapes.thin = true;
    drapes.lightStep = 3.0f;
    drapes.add(curtain(-0.66f, -0.24f, 6.0f, 0.1f), linen(srgb(0xe6d9c0)));
    drapes.add(curtain(1.34f, 1.88f, 7.0f, 0.6f), linen(srgb(0xe6d9c0)));
}

}  // namespace studio
