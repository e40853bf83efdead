// The desk and what lies and stands on it, 0.5 to 1.3 m from the eye.
#include <cmath>

#include "paints.hpp"
#include "scene.hpp"
#include "shapes.hpp"

namespace studio {

namespace {

/// A place on the desk's top.
mat4 onDesk(float x, float z, float degrees = 0.0f, float height = 0.0f) {
    return translation({x, kDeskTop + height, z}) * rotation(degrees, kY);
}

void addNotebook(Model& model) {
    Object& book = model.add("notebook", Finish::baked, 1024, 512);
    book.lightStep = 7.0f;
    const mat4 m = onDesk(0.20f, -0.86f, 9.0f);
    for (const float side : {-1.0f, 1.0f}) {
        // Each page rises from the gutter and falls to its outer edge.
        const auto page = surface(17, 9, [side](float u, float v) {
            const float t = side < 0.0f ? 1.0f - u : u;
            const float rise = 0.013f * std::sin(kPi * std::pow(t, 0.45f)) + 0.004f + 0.003f * t * (1.0f - v);
            return vec3(side * 0.20f * t, rise, (v - 0.5f) * 0.28f);
        });
        book.add(place(page, m), notebookPage(side < 0.0f));
        const auto edge = surface(17, 2, [side](float u, float v) {
            const float t = side < 0.0f ? 1.0f - u : u;
            const float rise = 0.013f * std::sin(kPi * std::pow(t, 0.45f)) + 0.004f;
            return vec3(side * 0.20f * t, rise * (1.0f - v), 0.14f);
        });
        book.add(place(edge, m), bookPages(), 0.4f);
    }
    book.add(place(rectangle({-0.208f, 0.002f, -0.147f}, {0.416f, 0, 0}, {0, 0, 0.294f}), m), bookCover(7u), 0.3f);
    book.add(place(rectangle({-0.105f, 0.0012f, -0.148f}, {0.21f, 0, 0}, {0, 0, 0.296f}), onDesk(-0.05f, -1.0f, 31.0f)),
             letter(33u), 0.7f);
    book.add(
        place(rectangle({-0.105f, 0.0006f, -0.148f}, {0.21f, 0, 0}, {0, 0, 0.296f}), onDesk(0.50f, -0.92f, -24.0f)),
        letter(35u), 0.7f);
}

void addSpectacles(Model& model) {
    Object& frame = model.add("spectacles", Finish::baked, 128, 128);
    frame.lightStep = 2.0f;
    frame.gloss = {vec3(0.06f), 0.1f};
    const mat4 m = onDesk(0.305f, -0.80f, -28.0f, 0.034f);
    const Paint horn = plain(srgb(0x4a2412), 0.3f);
    for (const float s : {-1.0f, 1.0f}) {
        std::vector<vec3> rim, temple;
        for (int k = 0; k <= 16; ++k) {
            const float a = 2.0f * kPi * static_cast<float>(k) / 16.0f;
            rim.emplace_back(s * 0.034f + 0.0245f * std::cos(a), 0.021f * std::sin(a) + 0.004f, 0.0f);
        }
        frame.add(place(tube(rim, 0.0019f, 6, 30), m), horn);
        temple = {{s * 0.059f, 0.010f, 0.0f},
                  {s * 0.066f, 0.010f, -0.012f},
                  {s * 0.063f, 0.006f, -0.08f},
                  {s * 0.060f, -0.004f, -0.115f},
                  {s * 0.058f, -0.022f, -0.14f}};
        frame.add(place(tube(temple, 0.0017f, 5, 14), m), horn);
    }
    frame.add(place(tube({{-0.0105f, 0.009f, 0}, {0.0f, 0.0135f, 0.001f}, {0.0105f, 0.009f, 0}}, 0.0018f, 8, 10), m),
              horn);
}

void addStack(Model& model) {
    Object& stack = model.add("stacked books", Finish::baked, 512, 512);
    stack.lightStep = 4.0f;
    struct Entry {
        BookSize size;
        float degrees;
        std::uint32_t seed;
    };
    float y = kDeskTop;
    for (const Entry& e : {Entry{{0.042f, 0.27f, 0.20f}, 8.0f, 501u}, Entry{{0.030f, 0.245f, 0.17f}, -7.0f, 507u},
                           Entry{{0.036f, 0.225f, 0.155f}, 14.0f, 511u}}) {
        const mat4 m = translation({0.43f, y + e.size.thickness * 0.5f, -1.10f}) * rotation(e.degrees, kY) *
                       rotation(-90, kZ) * translation({0, -0.5f * e.size.height, 0});
        addBook(stack, m, e.size, e.seed, 0.6f);
        y += e.size.thickness + 0.0005f;
    }
    // Turned by -90 degrees about z the books' left boards are on top.
}

void addArmillary(Model& model) {
    Object& rings = model.add("armillary sphere", Finish::lit, 256, 256);
    rings.lightStep = 2.0f;
    const mat4 m = translation({0.44f, kDeskTop + 0.109f, -1.10f});
    const Paint metal = brass(0.32f, 0.5f);
    rings.add(place(lathe({{0.0f, 0.062f},
                           {0.007f, 0.060f},
                           {0.008f, 0.040f},
                           {0.016f, 0.032f},
                           {0.009f, 0.024f},
                           {0.014f, 0.014f},
                           {0.052f, 0.009f},
                           {0.055f, 0.0f}},
                          24, 20),
                    m),
              metal);
    const mat4 centre = m * translation({0, 0.152f, 0});
    rings.add(place(torus(0.090f, 0.0042f, 44, 7), centre * rotation(90, kX)), metal);
    rings.add(place(torus(0.084f, 0.0034f, 44, 6), centre * rotation(58, kZ) * rotation(20, kX)), metal);
    rings.add(place(torus(0.078f, 0.0034f, 44, 6), centre * rotation(90, kX) * rotation(72, kZ)), metal);
    rings.add(place(torus(0.072f, 0.0030f, 44, 6), centre * rotation(-24, kZ)), metal);
    rings.add(place(ball(0.021f, 24, 16), centre), metal);
    rings.add(place(tube({{-0.098f, 0, 0}, {0, 0, 0}, {0.098f, 0, 0}}, 0.0018f, 6, 4), centre * rotation(66, kZ)),
              metal);
}

void addGlobe(Model& model) {
    Object& globe = model.add("globe", Finish::lit, 512, 256);
    globe.lightStep = 4.0f;
    globe.add(place(ball(0.105f, 40, 22), onDesk(0.06f, -1.13f, 0, 0.185f) * rotation(-23, kZ) * rotation(150, kY)),
              earth());
    Object& stand = model.add("globe stand", Finish::lit, 128, 128);
    stand.lightStep = 2.0f;
    const mat4 m = onDesk(0.06f, -1.13f);
    const Paint metal = brass(0.3f, 0.35f);
    stand.add(
        place(torus(0.117f, 0.0045f, 44, 6), m * translation({0, 0.185f, 0}) * rotation(-23, kZ) * rotation(90, kX)),
        metal);
    stand.add(place(lathe({{0.0f, 0.072f},
                           {0.010f, 0.070f},
                           {0.009f, 0.045f},
                           {0.019f, 0.036f},
                           {0.010f, 0.026f},
                           {0.020f, 0.016f},
                           {0.072f, 0.010f},
                           {0.078f, 0.0f}},
                          28, 22),
                    m),
              metal);
}

void addVaseAndBowl(Model& model) {
    Object& vase = model.add("vase", Finish::lit, 256, 256);
    vase.lightStep = 2.0f;
    vase.add(place(lathe({{0.021f, 0.20f},
                          {0.026f, 0.235f},
                          {0.032f, 0.243f},
                          {0.029f, 0.236f},
                          {0.025f, 0.205f},
                          {0.035f, 0.18f},
                          {0.064f, 0.135f},
                          {0.074f, 0.09f},
                          {0.062f, 0.04f},
                          {0.045f, 0.008f},
                          {0.044f, 0.0f}},
                         36, 30),
                   onDesk(0.655f, -1.14f)),
             ceramic(srgb(0x1f5f6c), srgb(0xa8744a), 0.16f));

    Object& bowl = model.add("hammered bowl", Finish::lit, 512, 256);
    bowl.normalMap = true;
    bowl.lightStep = 4.0f;
    const mat4 m = onDesk(-0.15f, -0.88f);
    bowl.add(place(lathe({{0.114f, 0.066f},
                          {0.117f, 0.064f},
                          {0.112f, 0.052f},
                          {0.094f, 0.027f},
                          {0.062f, 0.009f},
                          {0.045f, 0.0f}},
                         40, 14),
                   m),
             hammeredBrass());
    bowl.add(
        place(lathe({{0.0f, 0.011f}, {0.058f, 0.014f}, {0.090f, 0.031f}, {0.108f, 0.054f}, {0.114f, 0.066f}}, 40, 12),
              m),
        hammeredBrass(), 0.8f);
    // The inner profile runs upwards, so its outside is the bowl's inside.

    Object& fruits = model.add("clementines", Finish::baked, 256, 256);
    fruits.lightStep = 3.0f;
    fruits.gloss = {vec3(0.04f), 0.25f};
    const vec3 places[] = {
        {-0.035f, 0.047f, 0.032f}, {0.041f, 0.046f, 0.018f}, {-0.004f, 0.047f, -0.044f}, {0.002f, 0.088f, 0.002f}};
    for (const vec3& p : places) {
        const float r = 0.034f;
        fruits.add(place(surface(
                             21, 13,
                             [r](float u, float v) {
                                 const float a = 2.0f * kPi * u, e = kPi * v;
                                 const float flat = 0.86f - 0.10f * std::exp(-e * e * 14.0f);
                                 return r *
                                        vec3(std::sin(e) * std::cos(a), flat * std::cos(e), -std::sin(e) * std::sin(a));
                             },
                             true),
                         m * translation(p) * rotation(p.x * 700.0f, kZ) * rotation(p.z * 600.0f, kX)),
                   fruit(srgb(0xe8862a)));
    }
}

void addTea(Model& model) {
    Object& pot = model.add("teapot", Finish::baked, 256, 256);
    pot.lightStep = 2.0f;
    pot.gloss = {vec3(0.05f), 0.09f};
    const mat4 m = onDesk(-0.27f, -1.02f, 25.0f);
    const Paint glaze = ceramic(srgb(0xb9c3a4), srgb(0x8a5a3a), 0.2f),
                allGlazed = ceramic(srgb(0xb9c3a4), srgb(0x8a5a3a), 0.2f, 2.0f);
    pot.add(place(lathe({{0.030f, 0.106f},
                         {0.052f, 0.100f},
                         {0.075f, 0.075f},
                         {0.080f, 0.05f},
                         {0.068f, 0.02f},
                         {0.045f, 0.004f},
                         {0.044f, 0.0f}},
                        36, 18),
                  m),
            glaze);
    pot.add(place(lathe({{0.0f, 0.133f},
                         {0.011f, 0.130f},
                         {0.012f, 0.122f},
                         {0.006f, 0.115f},
                         {0.012f, 0.112f},
                         {0.034f, 0.106f},
                         {0.036f, 0.100f}},
                        28, 12),
                  m),
            allGlazed);
    pot.add(place(tube(
                      {{0.066f, 0.045f, 0}, {0.095f, 0.055f, 0}, {0.110f, 0.085f, 0}, {0.128f, 0.104f, 0}},
                      [](float t) { return 0.017f - 0.009f * t; }, 12, 10),
                  m),
            allGlazed);
    pot.add(place(tube({{-0.064f, 0.082f, 0},
                        {-0.098f, 0.095f, 0},
                        {-0.116f, 0.065f, 0},
                        {-0.098f, 0.034f, 0},
                        {-0.070f, 0.030f, 0}},
                       0.0065f, 9, 14),
                  m),
            allGlazed);
    // A cup on its saucer.
    const mat4 c = onDesk(-0.02f, -0.80f, -30.0f);
    pot.add(place(lathe({{0.030f, 0.050f},
                         {0.037f, 0.058f},
                         {0.0395f, 0.058f},
                         {0.038f, 0.045f},
                         {0.030f, 0.018f},
                         {0.021f, 0.008f}},
                        30, 12),
                  c),
            allGlazed);
    pot.add(place(disc(0.034f, 0.049f, 24), c), plain(srgb(0x6a3414), 0.05f), 0.5f);
    pot.add(
        place(
            lathe(
                {{0.0f, 0.008f}, {0.035f, 0.008f}, {0.064f, 0.014f}, {0.067f, 0.014f}, {0.060f, 0.008f}, {0.03f, 0.0f}},
                32, 10),
            c),
        allGlazed);
    pot.add(place(tube({{0.036f, 0.046f, 0}, {0.056f, 0.046f, 0}, {0.056f, 0.024f, 0}, {0.034f, 0.022f, 0}}, 0.0038f, 7,
                       10),
                  c),
            allGlazed, 0.7f);
}

void addPencils(Model& model) {
    Object& mug = model.add("pencil mug", Finish::baked, 256, 256);
    mug.lightStep = 2.5f;
    mug.gloss = {vec3(0.03f), 0.25f};
    const mat4 m = onDesk(0.475f, -0.80f);
    mug.add(place(lathe({{0.036f, 0.012f},
                         {0.0375f, 0.09f},
                         {0.039f, 0.094f},
                         {0.0405f, 0.092f},
                         {0.0405f, 0.05f},
                         {0.0395f, 0.004f},
                         {0.037f, 0.0f}},
                        28, 16),
                  m),
            ceramic(srgb(0xc9bfae), srgb(0x9c5f3c), 0.3f));
    mug.add(place(tube({{0.040f, 0.078f, 0}, {0.066f, 0.074f, 0}, {0.068f, 0.036f, 0}, {0.040f, 0.026f, 0}}, 0.0052f, 8,
                       12),
                  m * rotation(-140, kY)),
            ceramic(srgb(0xc9bfae), srgb(0x9c5f3c), 0.3f), 0.7f);
    const std::uint32_t colors[] = {0xc8452c, 0xe0a838, 0x2f6f7a, 0x3c5a3a, 0x28344c,
                                    0xd8682c, 0x8a4a6a, 0xd8c8a8, 0x2a2a2a};
    Rng rng(77);
    for (int k = 0; k < 9; ++k) {
        const float a = 2.0f * kPi * static_cast<float>(k) / 9.0f + rng.range(-0.2f, 0.2f),
                    lean = rng.range(0.010f, 0.017f);
        const float length = rng.range(0.125f, 0.178f);
        const vec3 foot(-lean * std::cos(a), 0.012f, -lean * std::sin(a)),
            tip = foot + glm::normalize(vec3(2.6f * lean * std::cos(a), 0.12f, 2.6f * lean * std::sin(a))) * length;
        const vec3 paint = srgb(colors[k]);
        const bool brush = k % 3 == 2;
        mug.add(
            place(tube(
                      {foot, glm::mix(foot, tip, 0.5f), tip},
                      [=](float t) {
                          if (brush)
                              return t < 0.80f   ? 0.0026f + 0.001f * t
                                     : t < 0.86f ? 0.0042f
                                                 : 0.0048f * (1.02f - t) / 0.16f + 0.0002f;
                          return t < 0.91f ? 0.0037f : 0.0037f * (1.003f - t) / 0.09f;
                      },
                      6, 14),
                  m),
            [=](const SurfacePoint& s) {
                const float t = s.unit.y;
                if (brush) return Coat{t < 0.78f ? paint : t < 0.87f ? srgb(0xb8b0a0) : srgb(0x4a2f1c)};
                return Coat{t < 0.91f ? paint : t < 0.975f ? srgb(0xd8b27a) : paint * 0.6f};
            },
            0.8f);
    }
    // Pencils that were left lying about.
    const auto lying = [&](float x, float z, float degrees, float height, std::uint32_t color) {
        const vec3 paint = srgb(color);
        mug.add(
            place(tube(
                      {{0, 0, -0.085f}, {0, 0, 0.0f}, {0, 0, 0.085f}},
                      [](float t) { return t < 0.91f ? 0.0037f : 0.0037f * (1.003f - t) / 0.09f; }, 6, 12),
                  onDesk(x, z, degrees, height)),
            [=](const SurfacePoint& s) {
                return Coat{s.unit.y < 0.91f ? paint : s.unit.y < 0.975f ? srgb(0xd8b27a) : paint * 0.6f};
            },
            0.8f);
    };
    lying(0.135f, -0.79f, 62.0f, 0.024f, 0xe0a838u);
    lying(0.545f, -0.95f, 20.0f, 0.0044f, 0x2f6f7au);
    lying(-0.20f, -0.74f, 108.0f, 0.0038f, 0xc8452cu);
}

}  // namespace

void addDesk(Model& model) {
    Object& desk = model.add("desk", Finish::baked, 1024, 1024);
    desk.lightStep = 5.5f;
    desk.gloss = {vec3(0.045f), 0.14f};
    const float x0 = -0.42f, x1 = 1.20f, z0 = -1.27f, z1 = -0.34f;
    const Paint top = tableBoards(srgb(0xb07a4a), srgb(0x66401f), 6), side = wood(srgb(0xa06c40), srgb(0x5a361e), true);
    desk.add(rectangle({x0, kDeskTop, z0}, {x1 - x0, 0, 0}, {0, 0, z1 - z0}, 13, 9), top);
    Patches rim = box({x0, kDeskTop - 0.032f, z0}, {x1, kDeskTop, z1});
    rim.erase(rim.begin() + 4);  // the top is there already
    desk.add(rim, side, 0.45f);
    desk.add(box({x0 + 0.05f, kDeskTop - 0.12f, z0 + 0.04f}, {x1 - 0.05f, kDeskTop - 0.032f, z1 - 0.04f}), side, 0.25f);
    for (const float x : {x0 + 0.05f, x1 - 0.11f})
        for (const float z : {z0 + 0.04f, z1 - 0.10f})
            desk.add(box({x, 0, z}, {x + 0.06f, kDeskTop - 0.12f, z + 0.06f}),
                     wood(srgb(0xa06c40), srgb(0x5a361e), false), 0.25f);
}

void addDeskThings(Model& model) {
    addNotebook(model);
    addSpectacles(model);
    addStack(model);
    addArmillary(model);
    addGlobe(model);
    addVaseAndBowl(model);
    addTea(model);
    addPencils(model);
}

}  // namespace studio
