// Everything that shines indoors: the desk lamp, hanging bulbs, the standard lamp, a candle, strings of tiny lights.
#include <cmath>

#include "paints.hpp"
#include "scene.hpp"
#include "shapes.hpp"

namespace studio {

namespace {

const vec3 kTungsten(1.0f, 0.62f, 0.28f);

void addDeskLamp(Model& model) {
    const vec3 head(-0.10f, 1.225f, -0.985f);
    const mat4 m = translation(head) * rotation(17, kZ) * rotation(-3, kX);
    Object& lamp = model.add("desk lamp", Finish::baked, 256, 256);
    lamp.lightStep = 2.0f;
    lamp.gloss = {vec3(0.05f), 0.16f};
    const Paint enamel = plain(srgb(0x1f4a44), 0.08f), inside = plain(vec3(0.40f, 0.40f, 0.16f), 0.03f),
                metal = plain(srgb(0x8a6a3c), 0.15f);
    const std::vector<vec2> shade{
        {0.012f, 0.135f}, {0.030f, 0.128f}, {0.036f, 0.085f}, {0.062f, 0.045f}, {0.085f, -0.022f}};
    lamp.add(place(lathe(shade, 36, 14), m), enamel);
    lamp.add(place(lathe({{0.084f, -0.022f}, {0.061f, 0.043f}, {0.034f, 0.082f}, {0.0f, 0.10f}}, 36, 9), m), inside);
    const vec3 neck = vec3(m * vec4(0, 0.135f, 0, 1)), elbow(-0.41f, 1.27f, -1.17f),
               foot(-0.33f, kDeskTop + 0.03f, -1.14f);
    lamp.add(tube({foot, glm::mix(foot, elbow, 0.5f), elbow}, 0.0065f, 8, 4), metal);
    lamp.add(tube({elbow, glm::mix(elbow, neck, 0.5f) + vec3(0, 0.012f, 0), neck}, 0.0065f, 8, 6), metal);
    lamp.add(place(ball(0.015f, 12, 8), translation(elbow)), metal);
    lamp.add(place(ball(0.013f, 12, 8), translation(neck)), metal);
    lamp.add(place(lathe({{0.0f, 0.042f},
                          {0.012f, 0.040f},
                          {0.015f, 0.026f},
                          {0.070f, 0.022f},
                          {0.082f, 0.014f},
                          {0.084f, 0.0f}},
                         32, 14),
                   translation({-0.33f, kDeskTop, -1.14f})),
             enamel);

    Object& bulb = model.add("desk lamp bulb", Finish::glowing, 0, 0);
    bulb.add(place(ball(0.027f, 20, 13), m * translation({0, 0.006f, 0})), plain(vec3(1.0f)));
    bulb.emissive = {1.0f, 0.74f, 0.42f};
    bulb.emissiveStrength = 9.0f;
    model.lamps.push_back({"desk lamp", head + vec3(m * vec4(0, 0.004f, 0, 0)), 0.024f, kTungsten * 0.85f, true});
}

/// A pear-shaped bulb whose glass glows most in the middle, hanging from its origin.
Patch pear(float scale) {
    return lathe({{0.010f * scale, -0.005f * scale},
                  {0.011f * scale, -0.025f * scale},
                  {0.024f * scale, -0.055f * scale},
                  {0.031f * scale, -0.080f * scale},
                  {0.024f * scale, -0.105f * scale},
                  {0.0f, -0.115f * scale}},
                 18, 14);
}

void addHangingBulbs(Model& model) {
    const vec3 places[] = {{-0.02f, 1.83f, -2.30f}, {0.42f, 1.70f, -2.75f}, {0.82f, 1.80f, -2.25f}};
    Object& cords = model.add("lamp cords", Finish::baked, 128, 128);
    cords.castsShadow = false;
    cords.lightStep = 2.0f;
    Object shining;
    for (const vec3& p : places) {
        cords.add(tube({{p.x, kCeiling, p.z}, {p.x + 0.003f, 2.3f, p.z}, {p.x, p.y + 0.03f, p.z}}, 0.0032f, 6, 6),
                  plain(srgb(0x2c2420)), 0.3f);
        cords.add(
            place(lathe({{0.004f, 0.05f}, {0.013f, 0.044f}, {0.016f, 0.02f}, {0.016f, -0.008f}, {0.012f, -0.012f}}, 14,
                        8),
                  translation(p)),
            plain(srgb(0x9a7438), 0.15f));
    }
    Object& bulbs = model.add("hanging bulbs", Finish::shining, 64, 64);
    bulbs.emissiveStrength = 7.0f;
    int k = 0;
    for (const vec3& p : places) {
        bulbs.add(place(pear(1.0f), translation(p)), [](const SurfacePoint& s) {
            const float core = std::exp(-std::pow((s.unit.y - 0.55f) / 0.20f, 2.0f));
            Coat coat;
            coat.glow = glm::mix(vec3(0.20f, 0.085f, 0.02f), vec3(1.0f, 0.66f, 0.30f), core);
            return coat;
        });
        if (k > 0) bulbs.patches.back().sharedChart = 0;
        model.lamps.push_back(
            {"hanging bulb " + std::to_string(++k), p - vec3(0, 0.07f, 0), 0.03f, kTungsten * 0.42f, true});
    }
}

void addStandardLamp(Model& model) {
    const vec3 foot(-0.69f, 0.0f, -3.52f);
    Object& pole = model.add("standard lamp", Finish::baked, 128, 128);
    pole.lightStep = 2.0f;
    pole.add(
        place(lathe({{0.0f, 1.22f}, {0.010f, 1.21f}, {0.010f, 0.06f}, {0.03f, 0.03f}, {0.14f, 0.02f}, {0.145f, 0.0f}},
                    20, 16),
              translation(foot)),
        plain(srgb(0x6a5030), 0.1f));
    Object& shade = model.add("lamp shade", Finish::shining, 128, 64);
    shade.thin = true;
    shade.emissiveStrength = 1.35f;
    shade.add(place(lathe({{0.115f, 1.42f}, {0.205f, 1.12f}}, 40, 6), translation(foot)), [](const SurfacePoint& s) {
        const float hot = std::exp(-std::pow((s.unit.y - 0.52f) / 0.34f, 2.0f));
        const float weave = 0.92f + 0.08f * noise({s.metres * 420.0f, 1.0f});
        const float seam = std::min(s.unit.y, 1.0f - s.unit.y) < 0.03f ? 0.55f : 1.0f;
        Coat coat;
        coat.glow = glm::mix(vec3(0.42f, 0.19f, 0.06f), vec3(1.0f, 0.66f, 0.32f), hot) * weave * seam;
        return coat;
    });
    model.lamps.push_back({"standard lamp", foot + vec3(0, 1.27f, 0), 0.10f, kTungsten * 1.25f, true});
}

void addCandle(Model& model) {
    const vec3 at(0.285f, kDeskTop, -1.185f);
    Object& wax = model.add("candle", Finish::baked, 128, 128);
    wax.lightStep = 2.0f;
    wax.gloss = {vec3(0.04f), 0.3f};
    wax.add(
        place(lathe({{0.0f, 0.118f}, {0.006f, 0.116f}, {0.0105f, 0.122f}, {0.0115f, 0.118f}, {0.0115f, 0.03f}}, 20, 12),
              translation(at)),
        plain(srgb(0xf0e2c4) * 1.0f, 0.03f));
    wax.add(place(lathe({{0.0125f, 0.040f},
                         {0.015f, 0.042f},
                         {0.016f, 0.038f},
                         {0.014f, 0.020f},
                         {0.020f, 0.012f},
                         {0.046f, 0.010f},
                         {0.052f, 0.014f},
                         {0.054f, 0.012f},
                         {0.046f, 0.0f}},
                        24, 16),
                  translation(at)),
            plain(srgb(0x8a6a3c), 0.15f));
    wax.add(tube({at + vec3(0, 0.115f, 0), at + vec3(0.0005f, 0.122f, 0), at + vec3(0.001f, 0.128f, 0)}, 0.0008f, 5, 3),
            plain(srgb(0x1a1410)));
    Object& flame = model.add("candle flame", Finish::shining, 64, 64);
    flame.emissiveStrength = 6.0f;
    flame.add(place(lathe({{0.0f, 0.162f},
                           {0.0022f, 0.152f},
                           {0.0052f, 0.139f},
                           {0.0058f, 0.133f},
                           {0.0035f, 0.126f},
                           {0.0f, 0.124f}},
                          16, 18),
                    translation(at)),
              [](const SurfacePoint& s) {
                  Coat coat;
                  coat.glow = glm::mix(vec3(1.0f, 0.60f, 0.20f), vec3(0.95f, 0.34f, 0.06f),
                                       glm::smoothstep(0.55f, 0.0f, s.unit.y));
                  coat.glow = glm::mix(coat.glow, vec3(0.10f, 0.10f, 0.25f), glm::smoothstep(0.85f, 1.0f, s.unit.y));
                  return coat;
              });
    model.lamps.push_back({"candle", at + vec3(0, 0.142f, 0), 0.008f, vec3(1.0f, 0.52f, 0.18f) * 0.07f, false});
}

/// A wire hung along `path` with beads of light on it.
void addString(Object& wire, Object& beads, std::vector<Lamp>& lamps, const std::vector<vec3>& path, int count,
               float radius, float candela, std::uint32_t seed) {
    Rng rng(seed);
    wire.add(tube(path, 0.0011f, 3, 6 * static_cast<int>(path.size())), plain(srgb(0x3a3420)));
    for (int k = 0; k < count; ++k) {
        const float t = (static_cast<float>(k) + 0.5f + rng.range(-0.2f, 0.2f)) / static_cast<float>(count);
        const vec3 p = curvePoint(path, t) +
                       vec3(rng.range(-0.006f, 0.006f), rng.range(-0.016f, -0.006f), rng.range(-0.006f, 0.006f));
        beads.add(bead(p, radius * rng.range(0.85f, 1.15f)), plain(vec3(1.0f)));
        if (candela > 0.0f) lamps.push_back({"", p, radius, vec3(1.0f, 0.55f, 0.2f) * candela, false});
    }
}

}  // namespace

void addLamps(Model& model) {
    addDeskLamp(model);
    addHangingBulbs(model);
    addStandardLamp(model);
    addCandle(model);

    Object wire, beads;
    wire.name = "string light wires";
    wire.textureWidth = wire.textureHeight = 128;
    wire.castsShadow = false;
    wire.lightStep = 3.0f;
    beads.name = "string lights";
    beads.finish = Finish::glowing;
    beads.emissive = {1.0f, 0.42f, 0.07f};
    beads.emissiveStrength = 13.0f;
    // Along the window's top, down its left side, and over the bookcase's shelves.
    addString(wire, beads, model.lamps,
              {{-0.30f, 2.16f, kNorth + 0.03f},
               {0.05f, 2.06f, kNorth + 0.03f},
               {0.50f, 2.02f, kNorth + 0.03f},
               {1.0f, 2.05f, kNorth + 0.03f},
               {1.45f, 2.18f, kNorth + 0.03f}},
              16, 0.0068f, 0.004f, 3u);
    addString(wire, beads, model.lamps,
              {{-0.95f, 1.53f, -1.5f},
               {-0.94f, 1.44f, -1.9f},
               {-0.95f, 1.52f, -2.3f},
               {-0.94f, 1.42f, -2.75f},
               {-0.95f, 1.52f, -3.2f},
               {-0.94f, 1.43f, -3.55f},
               {-0.95f, 1.52f, -3.88f}},
              26, 0.0062f, 0.006f, 5u);
    addString(wire, beads, model.lamps,
              {{-0.94f, 1.88f, -1.6f},
               {-0.93f, 1.78f, -2.1f},
               {-0.94f, 1.87f, -2.65f},
               {-0.93f, 1.76f, -3.2f},
               {-0.94f, 1.87f, -3.85f}},
              20, 0.0062f, 0.006f, 9u);
    model.objects.push_back(std::move(wire));
    model.objects.push_back(std::move(beads));
}

}  // namespace studio
