// Bookcase, armchair, rug, telescope, pictures.
#include <cmath>

#include "paints.hpp"
#include "scene.hpp"
#include "shapes.hpp"

namespace studio {

namespace {

const vec3 kWalnutLight = srgb(0xa06c40), kWalnutDark = srgb(0x55321c);

void addArmchair(Model& model) {
    Object& chair = model.add("armchair", Finish::baked, 512, 512);
    chair.lightStep = 4.0f;
    const mat4 m = translation({-0.36f, 0.0f, -2.78f}) * rotation(38, kY);
    const Paint hide = leather(srgb(0x9a5530));
    const mat4 lean = translation({0, 0.40f, -0.27f}) * rotation(-14, kX);
    chair.add(place(roundedBox({-0.33f, 0.26f, -0.32f}, {0.33f, 0.46f, 0.36f}, 0.06f, 6, 0.02f), m), hide);
    chair.add(place(roundedBox({-0.33f, 0.0f, -0.10f}, {0.33f, 0.52f, 0.08f}, 0.07f, 6, 0.03f), m * lean), hide);
    for (const float x : {-0.40f, 0.40f}) {
        chair.add(place(roundedBox({x - 0.065f, 0.17f, -0.36f}, {x + 0.065f, 0.60f, 0.36f}, 0.055f, 6, 0.01f), m), hide,
                  0.8f);
    }
    chair.add(place(roundedBox({-0.36f, 0.15f, -0.36f}, {0.36f, 0.28f, 0.34f}, 0.03f, 4), m), hide, 0.4f);
    for (const float x : {-0.33f, 0.33f}) {
        for (const float z : {-0.30f, 0.30f}) {
            chair.add(place(lathe({{0.022f, 0.16f}, {0.020f, 0.1f}, {0.013f, 0.0f}}, 8, 3), m * translation({x, 0, z})),
                      wood(kWalnutLight, kWalnutDark, false), 0.4f);
        }
    }
    // A cushion and a folded blanket.
    chair.add(place(roundedBox({-0.2f, -0.2f, -0.05f}, {0.2f, 0.2f, 0.05f}, 0.05f, 8, 0.045f),
                    m * translation({-0.08f, 0.66f, -0.10f}) * rotation(-20, kX) * rotation(12, kZ)),
              fabric(srgb(0x3f6a72), 0.005f), 1.2f);
    chair.add(place(surface(13, 25,
                            [](float u, float v) {
                                // Over the arm and down its outer side.
                                const float s = (v - 0.45f) * 0.85f;
                                const float y = std::abs(s) < 0.09f ? 0.612f + 0.004f * std::sin(u * 22.0f)
                                                                    : 0.612f - (std::abs(s) - 0.09f) * 0.98f;
                                const float x = 0.40f + glm::clamp(s, -0.09f, 0.09f) * 0.9f +
                                                0.006f * std::sin(u * 17.0f + v * 6.0f);
                                return vec3(x, y, 0.18f - 0.34f * u + 0.01f * std::sin(v * 9.0f));
                            }),
                    m),
              fabric(srgb(0xd9c29a), 0.007f));
}

void addTelescope(Model& model) {
    Object& scope = model.add("telescope", Finish::baked, 256, 256);
    scope.lightStep = 2.0f;
    scope.gloss = {vec3(0.40f, 0.25f, 0.08f), 0.15f};
    const vec3 head(0.92f, 1.16f, -3.25f);
    const mat4 m =
        translation(head) * rotation(22, kY) * rotation(-72, kX);  // the tube points out of the window and up
    const Paint metal = plain(vec3(0.40f, 0.22f, 0.06f), 0.12f), hide = leather(srgb(0x4a2a1a));
    scope.add(
        place(
            lathe(
                {{0.0f, 0.44f}, {0.040f, 0.44f}, {0.044f, 0.435f}, {0.044f, 0.40f}, {0.039f, 0.395f}, {0.037f, 0.10f}},
                22, 12),
            m),
        metal);
    scope.add(place(lathe({{0.0375f, 0.10f}, {0.0385f, 0.09f}, {0.0385f, -0.10f}, {0.0375f, -0.11f}}, 24, 6), m), hide);
    scope.add(place(lathe({{0.037f, -0.11f},
                           {0.036f, -0.20f},
                           {0.028f, -0.21f},
                           {0.027f, -0.33f},
                           {0.018f, -0.34f},
                           {0.017f, -0.42f},
                           {0.023f, -0.43f},
                           {0.022f, -0.45f},
                           {0.0f, -0.45f}},
                          22, 20),
                    m),
              metal);
    scope.add(place(ball(0.035f, 16, 10), translation(head - vec3(0, 0.06f, 0))), metal);
    for (int k = 0; k < 3; ++k) {
        const float a = 2.0f * kPi * (static_cast<float>(k) / 3.0f + 0.08f);
        const vec3 foot(head.x + 0.42f * std::cos(a), 0.0f, head.z + 0.42f * std::sin(a));
        scope.add(tube(
                      {head - vec3(0, 0.07f, 0), glm::mix(head, foot, 0.5f), foot},
                      [](float t) { return 0.018f - 0.008f * t; }, 7, 4),
                  wood(kWalnutLight, kWalnutDark, false), 0.6f);
    }
}

void addPictures(Model& model) {
    Object& pictures = model.add("pictures", Finish::baked, 512, 256);
    pictures.lightStep = 4.0f;
    struct Frame {
        vec3 centre;
        vec2 half;
        int motif;
        bool onSouth = false;
    };
    for (const Frame& f :
         {Frame{{-0.80f, 1.93f, kNorth}, {0.13f, 0.17f}, 3}, Frame{{-0.80f, 1.49f, kNorth}, {0.13f, 0.12f}, 2},
          Frame{{2.15f, 1.6f, kNorth}, {0.2f, 0.28f}, 0}, Frame{{2.15f, 0.95f, kNorth}, {0.2f, 0.16f}, 1},
          Frame{{0.35f, 1.55f, kNorth}, {0.34f, 0.26f}, 0, true},
          Frame{{-0.45f, 1.55f, kNorth}, {0.2f, 0.26f}, 1, true}}) {
        const float border = 0.022f, depth = 0.025f;
        const vec3 h(f.half, 0.0f);
        const Paint frame = wood(srgb(0x6a4a30), srgb(0x2c1c12), true);
        const mat4 hung = f.onSouth ? translation({0, 0, kSouth + kNorth}) * rotation(180, kY) : mat4(1.0f);
        pictures.add(place(rectangle(f.centre + vec3(-h.x, h.y, 0.012f), {2 * h.x, 0, 0}, {0, -2 * h.y, 0}), hung),
                     framedPicture(f.motif));
        const vec3 low = f.centre - h - vec3(border, border, 0), high = f.centre + h + vec3(border, border, depth);
        pictures.add(place(join({box(low, {low.x + border, high.y, high.z}), box({high.x - border, low.y, low.z}, high),
                                 box({low.x + border, low.y, low.z}, {high.x - border, low.y + border, high.z}),
                                 box({low.x + border, high.y - border, low.z}, {high.x - border, high.y, high.z})}),
                           hung),
                     frame, 0.5f);
    }
}

}  // namespace

void addFurniture(Model& model) {
    Object& bookcase = model.add("bookcase", Finish::baked, 512, 512);
    bookcase.lightStep = 3.5f;
    bookcase.gloss = {vec3(0.03f), 0.35f};
    const float front = kWest + 0.29f, near = -1.45f, far = -3.9f, middle = -2.67f;
    const Paint plank = wood(kWalnutLight, kWalnutDark, true), post = wood(kWalnutLight, kWalnutDark, false);
    for (const float y : {0.06f, 0.44f, 0.80f, 1.15f, 1.50f, 1.85f, 2.20f})
        bookcase.add(box({kWest, y - 0.024f, far}, {front, y, near}), plank);
    for (const float z : {near, middle, far + 0.026f})
        bookcase.add(box({kWest, 0.0f, z - 0.026f}, {front + 0.004f, 2.2f, z}), post);
    bookcase.add(rectangle({kWest + 0.012f, 2.2f, near}, {0, 0, far - near}, {0, -2.2f, 0}), plank, 0.4f);

    Object& carpet = model.add("rug", Finish::baked, 512, 512);
    carpet.lightStep = 6.0f;
    const mat4 onFloor = translation({-0.02f, 0.0f, -2.75f}) * rotation(-7, kY);
    carpet.add(place(surface(21, 17,
                             [](float u, float v) {
                                 const float ripple = 0.004f * std::sin(u * 15.0f + v * 4.0f) * std::sin(v * 11.0f);
                                 return vec3((u - 0.5f) * 1.7f, 0.012f + ripple, (v - 0.5f) * 2.1f);
                             }),
                     onFloor),
               rug());
    addArmchair(model);
    addTelescope(model);
    addPictures(model);
}

}  // namespace studio
