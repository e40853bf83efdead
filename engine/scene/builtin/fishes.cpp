// builtin:fishes: a reef with a crowd of fishes, from before one's mask to where the water closes.
#include "scene/builtin/fishes.hpp"

#include <algorithm>

namespace dioptre::builtin {

namespace {

const vec3 kToLight{0.35f, 1.0f, 0.3f};

/// Bright threads where waves gather the light.
float caustics(const vec2& p) {
    const Cell a = worley(p + 0.35f * vec2(noise({p * 1.7f, 0}), noise({p * 1.7f, 5})), 1);
    const Cell b = worley(p * 1.7f + 9.0f, 2);
    return std::pow(1.0f - saturate(a.second - a.nearest), 5.0f) +
           0.6f * std::pow(1.0f - saturate(b.second - b.nearest), 6.0f);
}

vec3 waterAt(float height) {
    return glm::mix(vec3(0.004f, 0.035f, 0.075f), vec3(0.10f, 0.42f, 0.58f), glm::smoothstep(-0.2f, 1.0f, height));
}

vec3 sand(const vec2& xz) {
    const float ripple = std::sin(26.0f * xz.y + 6.0f * fbm({xz * 0.9f, 0}, 3, 7) * 3.0f);
    const float grain = noise({xz * 420.0f, 0}, 8), patch = fbm({xz * 0.7f, 3}, 4, 9);
    vec3 color = glm::mix(srgb(0xb8a47c), srgb(0xe0d2ac), 0.5f + 0.28f * ripple);
    color *= (0.8f + 0.35f * grain) * (0.75f + 0.45f * patch);
    color *= 0.85f + 0.55f * caustics(xz * 2.4f);
    // What is far is behind water
    const float far = saturate((-xz.y - 1.0f) / 15.0f);
    return glm::mix(color * glm::mix(vec3(1.0f), vec3(0.3f, 0.6f, 0.75f), far), waterAt(0.05f), 0.75f * far * far);
}

void addSea(Model& model) {
    const Ground grounds[] = {{{-2.2f, -3.6f}, {2.2f, 0.4f}, 1024}, {{-10.5f, -17.0f}, {10.5f, -3.6f}, 1024}};
    for (const Ground& ground : grounds)
        model.place("sand", addGround(model, "sand", ground, kToLight, 0.9f, 0.45f, sand), mat4(1.0f), false);
    const int image = model.picture("water", 512, 512, [](float u, float v) {
        const float height = 1.0f - v, ray = fbm({u * 16.0f + 0.6f * v, v * 0.8f, 2}, 3, 3);
        return waterAt(height) * (0.85f + 0.3f * ray * height) +
               0.25f * height * height * caustics({u * 9.0f, v * 4.0f}) * vec3(0.08f, 0.2f, 0.22f);
    });
    const int water = model.material("water", vec3(1.0f), 1.0f, 0.0f, image);
    model.materialAt(water).unlit = true;
    const auto wall = [] {
        return sheet(96, 24, [](float u, float v) {
            const float a = glm::mix(-1.45f, 1.45f, u);
            return vec3(10.5f * std::sin(a), 9.0f - 9.3f * v, -5.6f - 11.0f * std::cos(a));
        });
    };
    model.place("water", model.mesh("water", {{water, wall}}), mat4(1.0f), false);
}

void addReef(Model& model) {
    const int corals[] = {addBranchCoral(model, srgb(0xf07a5a), 1), addBranchCoral(model, srgb(0x9a6ad0), 2)};
    const int brain = addBrainCoral(model, srgb(0xc8b860)), fan = addFanCoral(model, srgb(0xd8448a), 4);
    const int sponge = addTubeSponge(model, srgb(0xe8b83a), 5), kelp = addKelp(model, 6),
              starfish = addStarfish(model, srgb(0xd8502a));
    const int anemone = addAnemone(model, srgb(0x8ac06a), 7), boulder = addBoulder(model, 8),
              bubbles = addBubbles(model, 9);
    const auto stand = [&](const char* name, int mesh, float x, float z, float scale, float turn, float y = 0.0f) {
        model.place(name, mesh, translation({x, y, z}) * rotation(turn, kY) * scaling(scale));
    };
    stand("starfish", starfish, 0.16f, -0.68f, 0.075f, 20.0f);
    stand("anemone", anemone, -0.38f, -1.0f, 0.42f, 0.0f);
    stand("coral", corals[0], 0.62f, -1.35f, 0.42f, 0.0f);
    stand("brain coral", brain, -0.95f, -1.9f, 0.5f, 0.0f);
    stand("sea fan", fan, 1.15f, -2.2f, 0.75f, -20.0f);
    stand("boulder", boulder, -1.6f, -3.0f, 1.3f, 0.0f);
    stand("coral 2", corals[1], -1.55f, -2.9f, 0.75f, 40.0f, 0.45f);
    stand("sponge", sponge, 0.35f, -2.9f, 0.7f, 0.0f);
    stand("boulder 2", boulder, 1.9f, -4.2f, 1.9f, 130.0f);
    stand("coral 3", corals[0], 1.8f, -4.0f, 1.0f, 90.0f, 0.75f);
    stand("brain coral 2", brain, 0.0f, -4.9f, 1.0f, 60.0f);
    stand("kelp", kelp, -2.7f, -4.6f, 1.6f, 0.0f);
    stand("kelp 2", kelp, 3.3f, -5.8f, 2.0f, 100.0f);
    stand("sea fan 2", fan, -1.1f, -6.2f, 1.7f, 15.0f);
    stand("boulder 3", boulder, -3.9f, -8.0f, 3.4f, 210.0f);
    stand("coral 4", corals[1], 0.9f, -8.2f, 2.0f, 10.0f);
    stand("sponge 2", sponge, 3.6f, -9.0f, 2.4f, 70.0f);
    stand("boulder 4", boulder, 4.9f, -12.5f, 5.0f, 300.0f);
    stand("coral 5", corals[0], -1.6f, -11.6f, 3.0f, 200.0f);
    stand("kelp 3", kelp, -5.6f, -12.0f, 3.4f, 60.0f);
    stand("bubbles", bubbles, 0.30f, -0.95f, 0.5f, 0.0f, 0.15f);
    stand("bubbles 2", bubbles, -0.8f, -2.6f, 1.0f, 90.0f, 0.3f);
    stand("bubbles 3", bubbles, 1.1f, -5.6f, 2.0f, 30.0f, 0.5f);
}

/// Where a fish swims: picture coordinates in [-1, 1] at a distance, so that the crowd fills the view at every depth.
struct Swimmer {
    std::size_t kind;
    float x, y, distance, length, heading, pitch;  // metres, degrees; heading 0: to the right
};

void addFishes(Model& model) {
    const std::vector<Species> species = allSpecies();
    struct Kind {
        std::vector<int> near, far;  // meshes, one per pose
    };
    std::vector<Kind> kinds;
    for (const Species& s : species) {
        const int skin = model.picture(s.name, 512, 512, s.skin),
                  fins = model.picture(s.name + "'s fins", 256, 256, s.finColor);
        Kind kind;
        kind.near = {addFish(model, s, {0.16f, 0.4f}, skin, fins, 0.0f),
                     addFish(model, s, {0.2f, 3.2f}, skin, fins, 0.12f)};
        kind.far = {addFish(model, s, {0.2f, 1.8f}, skin, fins, 0.55f)};
        kinds.push_back(std::move(kind));
    }
    std::vector<Swimmer> swimmers{// Before the mask
                                  {0, -0.42f, -0.16f, 0.43f, 0.09f, -25.0f, 8.0f},
                                  {7, 0.50f, 0.30f, 0.58f, 0.10f, 205.0f, -6.0f},
                                  {1, 0.05f, -0.42f, 0.75f, 0.15f, 20.0f, 4.0f},
                                  {0, -0.78f, -0.50f, 0.90f, 0.12f, 15.0f, 0.0f},
                                  {9, 0.02f, 0.62f, 0.80f, 0.16f, 168.0f, 5.0f},
                                  {7, 0.82f, -0.30f, 0.95f, 0.11f, 190.0f, 10.0f},
                                  // Middle distance
                                  {2, 0.48f, -0.08f, 1.25f, 0.32f, 200.0f, 0.0f},
                                  {3, -0.50f, 0.38f, 1.35f, 0.30f, 12.0f, -4.0f},
                                  {4, -0.02f, 0.12f, 1.80f, 0.45f, -18.0f, 3.0f},
                                  {5, 0.60f, 0.55f, 1.70f, 0.34f, 170.0f, -3.0f},
                                  {1, -0.82f, 0.02f, 1.80f, 0.30f, 30.0f, 6.0f},
                                  {8, 0.80f, 0.20f, 1.95f, 0.34f, 215.0f, 2.0f},
                                  {3, -0.32f, 0.62f, 2.20f, 0.36f, 20.0f, 0.0f},
                                  {9, 0.28f, -0.25f, 2.10f, 0.30f, -12.0f, 0.0f},
                                  {2, -0.62f, -0.28f, 2.50f, 0.40f, 25.0f, 8.0f}};
    // Schools, and the crowd behind
    Rng rng(11);
    const auto add = [&](std::size_t kind, float x, float y, float distance, float length, float heading) {
        swimmers.push_back({kind, x, y, distance, length, heading + rng.range(-9.0f, 9.0f), rng.range(-6.0f, 6.0f)});
    };
    for (int k = 0; k < 11; ++k)
        add(5, rng.range(0.05f, 0.85f), rng.range(0.25f, 0.8f), rng.range(3.0f, 4.6f), rng.range(0.36f, 0.5f), 175.0f);
    for (int k = 0; k < 8; ++k)
        add(6, rng.range(-0.9f, 0.1f), rng.range(0.35f, 0.9f), rng.range(5.0f, 8.0f), rng.range(0.8f, 1.1f), 8.0f);
    const std::size_t crowd[] = {2, 4, 1, 3, 8, 2, 4, 9, 1, 3, 6, 2, 4, 8, 3, 1, 6, 6, 4, 2};
    for (std::size_t k = 0; k < std::size(crowd); ++k) {
        const float t = static_cast<float>(k) / static_cast<float>(std::size(crowd) - 1),
                    distance = glm::mix(3.2f, 14.0f, t);
        const float x = fraction(0.618f * static_cast<float>(k) + 0.2f) * 1.8f - 0.9f;
        add(crowd[k], x, rng.range(-0.12f, 0.62f), distance, 0.18f * distance * rng.range(0.75f, 1.15f),
            x > 0.0f ? 185.0f : 5.0f);
    }
    // The camera's frame: what it sees at unit distance
    constexpr float kHalfHeight = 0.414f, kHalfWidth = 0.552f;
    for (std::size_t k = 0; k < swimmers.size(); ++k) {
        const Swimmer& s = swimmers[k];
        const Kind& kind = kinds[s.kind];
        const int mesh = s.distance > 4.2f ? kind.far[0] : kind.near[k % 2];
        const vec3 at(s.x * kHalfWidth * s.distance, 0.55f + s.y * kHalfHeight * s.distance, -s.distance);
        model.place(species[s.kind].name, mesh,
                    translation(at) * rotation(s.heading, kY) * rotation(s.pitch, kZ) * scaling(s.length));
    }
}

}  // namespace

void makeFishes(Model& model) {
    addSea(model);
    addReef(model);
    addFishes(model);
    model.camera({0.0f, 0.55f, 0.0f}, {0.0f, 0.55f, -3.0f});
    model.light(directional("sun", kToLight, vec3(2.5f, 2.7f, 2.7f)));
    model.light(pointLight("diver's lamp", {0.35f, 0.9f, 0.3f}, vec3(1.5f, 1.4f, 1.2f)));
    model.light(pointLight("glow", {-3.0f, 3.0f, -7.0f}, vec3(3.0f, 7.0f, 9.0f)));
}

}  // namespace dioptre::builtin
