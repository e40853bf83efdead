// The sprig close to the eye, dry twigs in the vase, and pots on the window sill.
#include <cmath>

#include "paints.hpp"
#include "scene.hpp"
#include "shapes.hpp"

namespace studio {

namespace {

/// A frame at `at` whose +z is `along` and whose +y is near `up`.
mat4 aim(const vec3& at, const vec3& along, const vec3& up) {
    const vec3 z = glm::normalize(along), x = glm::normalize(glm::cross(up, z)), y = glm::cross(z, x);
    return mat4(vec4(x, 0), vec4(y, 0), vec4(z, 0), vec4(at, 1));
}

struct LeafHabit {
    float length, width, spread;  // metres, metres, degrees from the stem
    int pairs;
    float from = 0.15f;  // first pair's place along the stem
    bool fine = false;   // seen close by: more triangles
};

/// A stem with leaves on alternating sides that shrink towards its tip.
void addStem(Object& stems, Object& leaves, const std::vector<vec3>& path, float radius, const LeafHabit& habit,
             Rng& rng, const Paint& stemPaint, const Paint& leafPaint) {
    const int sides = habit.fine ? 7 : 4, rings = habit.fine ? 16 : 6;
    stems.add(tube(
                  path, [radius](float t) { return radius * (1.0f - 0.75f * t); }, sides, rings),
              stemPaint);
    float turn = rng.range(0.0f, 2.0f * kPi);
    for (int k = 0; k < habit.pairs * 2; ++k) {
        const float t =
            habit.from + (1.0f - habit.from) * (static_cast<float>(k) + 0.5f) / static_cast<float>(habit.pairs * 2);
        const vec3 at = curvePoint(path, t),
                   along = glm::normalize(curvePoint(path, std::min(1.0f, t + 0.02f)) - curvePoint(path, t - 0.02f));
        turn += 2.4f + rng.range(-0.25f, 0.25f);  // the golden angle
        const glm::mat3 frame = frameAround(along);
        const vec3 side = frame * vec3(std::cos(turn), std::sin(turn), 0.0f);
        const float open = glm::radians(habit.spread + rng.range(-12.0f, 12.0f)) * (1.0f - 0.45f * t);
        const vec3 direction = std::cos(open) * along + std::sin(open) * side;
        const float size = (1.05f - 0.5f * t) * rng.range(0.8f, 1.15f);
        const vec3 up = glm::normalize(along * 0.8f + kY * 0.5f + frame[0] * rng.range(-0.25f, 0.25f));
        leaves.add(place(leaf(habit.length * size, habit.width * size, rng.range(0.06f, 0.2f),
                              habit.length * rng.range(0.05f, 0.3f), habit.fine ? 4 : 3, habit.fine ? 8 : 5),
                         aim(at, direction, up)),
                   leafPaint);
    }
}

void addSprig(Model& model) {
    Object stems, leaves;
    stems.name = "foreground stems";
    leaves.name = "foreground leaves";
    leaves.thin = true;
    leaves.textureWidth = 1024;
    leaves.textureHeight = 512;
    leaves.lightStep = 7.0f;
    stems.textureWidth = stems.textureHeight = 128;
    stems.lightStep = 3.0f;
    Rng rng(11);
    const Paint stemPaint = bark(srgb(0x7a6a48)), leafPaint = foliage(srgb(0xb4cc66), srgb(0x55824a));
    const LeafHabit habit{0.056f, 0.0205f, 60.0f, 11, 0.30f, true};
    const vec3 pot(0.585f, kDeskTop + 0.10f, -0.40f);
    const std::vector<vec3> paths[] = {
        {pot, {0.555f, 0.98f, -0.385f}, {0.515f, 1.12f, -0.36f}, {0.462f, 1.24f, -0.345f}, {0.405f, 1.315f, -0.33f}},
        {pot, {0.560f, 0.97f, -0.375f}, {0.520f, 1.07f, -0.345f}, {0.465f, 1.155f, -0.315f}, {0.412f, 1.19f, -0.29f}},
        {pot, {0.590f, 1.00f, -0.39f}, {0.575f, 1.14f, -0.38f}, {0.540f, 1.28f, -0.37f}, {0.490f, 1.39f, -0.36f}},
        {pot, {0.560f, 0.94f, -0.41f}, {0.525f, 1.01f, -0.43f}, {0.480f, 1.06f, -0.44f}, {0.435f, 1.075f, -0.45f}},
        {pot, {0.600f, 0.98f, -0.36f}, {0.585f, 1.08f, -0.32f}, {0.545f, 1.17f, -0.28f}, {0.500f, 1.23f, -0.26f}},
        {pot, {0.625f, 1.00f, -0.42f}, {0.650f, 1.14f, -0.43f}, {0.660f, 1.28f, -0.43f}}};
    for (const auto& path : paths) addStem(stems, leaves, path, 0.0024f, habit, rng, stemPaint, leafPaint);
    const mat4 onDesk = translation({pot.x, kDeskTop, pot.z});
    stems.add(place(lathe({{0.052f, 0.098f},
                           {0.058f, 0.108f},
                           {0.061f, 0.105f},
                           {0.058f, 0.07f},
                           {0.046f, 0.008f},
                           {0.044f, 0.0f}},
                          28, 18),
                    onDesk),
              plain(srgb(0xb56b45), 0.1f));
    stems.add(place(disc(0.053f, 0.098f, 24), onDesk), plain(srgb(0x3a2a1e), 0.3f));
    model.objects.push_back(std::move(stems));
    model.objects.push_back(std::move(leaves));
}

void addTwigs(Model& model) {
    Object twigs, berries;
    twigs.name = "twigs";
    twigs.textureWidth = twigs.textureHeight = 128;
    twigs.lightStep = 4.0f;
    berries.name = "berries";
    berries.textureWidth = berries.textureHeight = 256;
    berries.lightStep = 3.0f;
    const vec3 mouth(0.655f, kDeskTop + 0.19f, -1.14f);
    const Paint wood = bark(srgb(0x6a4a38)), berry = fruit(srgb(0xb8321e));
    Rng rng(31);
    for (int k = 0; k < 6; ++k) {
        const float a = 2.0f * kPi * static_cast<float>(k) / 6.0f + 0.5f, reach = rng.range(0.10f, 0.24f),
                    rise = rng.range(0.34f, 0.52f);
        const vec3 tip = mouth + vec3(reach * std::cos(a), rise, 0.55f * reach * std::sin(a));
        const vec3 bend = glm::mix(mouth, tip, 0.5f) + vec3(rng.range(-0.02f, 0.02f), 0.05f, rng.range(-0.02f, 0.02f));
        const std::vector<vec3> path{mouth - vec3(0, 0.12f, 0), mouth, bend, tip};
        twigs.add(tube(
                      path, [](float t) { return 0.0030f - 0.0021f * t; }, 5, 12),
                  wood);
        for (int b = 0; b < 9; ++b) {
            const float t = 0.5f + 0.5f * static_cast<float>(b) / 8.5f;
            const vec3 from = curvePoint(path, t);
            const float turn = 2.4f * static_cast<float>(b), length = rng.range(0.022f, 0.06f) * (1.25f - t * 0.6f);
            const vec3 to = from + length * glm::normalize(vec3(std::cos(turn), rng.range(0.4f, 1.0f), std::sin(turn)));
            twigs.add(tube(
                          {from, glm::mix(from, to, 0.5f) + vec3(0, 0.003f, 0), to},
                          [](float s) { return 0.0011f - 0.0005f * s; }, 3, 3),
                      wood, 0.5f);
            berries.add(place(ball(rng.range(0.0044f, 0.0066f), 7, 4), translation(to)), berry);
        }
    }
    model.objects.push_back(std::move(twigs));
    model.objects.push_back(std::move(berries));
}

void addSillPots(Model& model) {
    Object pots, leaves;
    pots.name = "sill pots";
    pots.textureWidth = pots.textureHeight = 128;
    pots.lightStep = 3.0f;
    leaves.name = "sill plants";
    leaves.thin = true;
    leaves.textureWidth = 512;
    leaves.textureHeight = 256;
    leaves.lightStep = 4.0f;
    Rng rng(51);
    const float xs[] = {-0.16f, 0.16f, 1.12f, 1.34f};
    const vec3 glazes[] = {srgb(0xb56b45), srgb(0xd8d0bc), srgb(0x3f6f7a), srgb(0xb56b45)};
    for (int k = 0; k < 4; ++k) {
        const vec3 base(xs[k], kWindowSill + 0.008f, kNorth + 0.07f);
        pots.add(place(lathe({{0.046f, 0.098f},
                              {0.054f, 0.105f},
                              {0.055f, 0.098f},
                              {0.051f, 0.07f},
                              {0.040f, 0.005f},
                              {0.038f, 0.0f}},
                             20, 10),
                       translation(base)),
                 plain(glazes[k], 0.08f));
        pots.add(place(disc(0.047f, 0.096f, 16), translation(base)), plain(srgb(0x3a2a1e), 0.3f), 0.5f);
        const int count = k % 2 == 0 ? 7 : 5;
        for (int s = 0; s < count; ++s) {
            const float a = 2.0f * kPi * static_cast<float>(s) / static_cast<float>(count) + rng.range(-0.3f, 0.3f);
            const float reach = k % 2 == 0 ? rng.range(0.05f, 0.16f) : rng.range(0.06f, 0.12f),
                        rise = k % 2 == 0 ? rng.range(0.14f, 0.34f) : rng.range(0.10f, 0.2f);
            const vec3 from = base + vec3(0.012f * std::cos(a), 0.094f, 0.012f * std::sin(a));
            const vec3 to = from + vec3(reach * std::cos(a), rise, 0.55f * reach * std::sin(a));
            const LeafHabit habit{k % 2 == 0 ? 0.062f : 0.08f, k % 2 == 0 ? 0.026f : 0.05f, 62.0f, k % 2 == 0 ? 5 : 3,
                                  0.25f};
            addStem(pots, leaves, {from, glm::mix(from, to, 0.55f) + vec3(0, 0.05f, 0), to}, 0.0022f, habit, rng,
                    bark(srgb(0x6a7a48)), foliage(srgb(0x94b060), srgb(0x35603c)));
        }
    }
    model.objects.push_back(std::move(pots));
    model.objects.push_back(std::move(leaves));
}

}  // namespace

void addPlants(Model& model) {
    addSprig(model);
    addTwigs(model);
    addSillPots(model);
}

}  // namespace studio
