// builtin:dragons: a court of dragons on their rocks at dusk, from statuettes at arm's length to giants.
#include "scene/builtin/dragons.hpp"

#include <algorithm>

namespace dioptre::builtin {

namespace {

const vec3 kToLight{-0.75f, 0.8f, 0.45f};
constexpr float kRock = 0.62f;  // height of the pillar that dragons coil about, metres

vec3 around(float degrees, float radius, float y) {
    const float a = glm::radians(degrees);
    return {radius * std::sin(a), y, radius * std::cos(a)};
}

/// Winds up a pillar, then rears.
std::vector<vec3> coiled(float turns, float direction, float rear) {
    std::vector<vec3> path;
    const int steps = static_cast<int>(turns * 8.0f);
    for (int k = 0; k <= steps; ++k) {
        const float t = toFloat(k) / toFloat(steps);
        path.push_back(
            around(direction * (180.0f - 360.0f * turns * (1.0f - t)), glm::mix(0.47f, 0.335f, t), 0.06f + 0.68f * t));
    }
    path.insert(path.end(), {{direction * 0.10f, kRock + 0.36f, -0.30f},
                             {0.0f, kRock + 0.36f + 0.5f * rear, -0.24f},
                             {0.0f, kRock + 0.40f + rear, -0.02f},
                             {0.0f, kRock + 0.42f + rear, 0.18f}});
    return path;
}

/// Lies on the rock in bends, its neck raised.
std::vector<vec3> lying(float bend, float direction) {
    return {around(100 * direction, 0.62f, 0.05f),
            around(140 * direction, 0.6f, 0.2f),
            around(190 * direction, 0.52f, 0.42f),
            around(250 * direction, 0.42f, kRock + 0.08f),
            {-0.36f * direction, kRock + 0.12f, 0.02f},
            {-0.10f * direction, kRock + 0.13f, 0.22f * bend},
            {0.12f * direction, kRock + 0.14f, 0.0f},
            {0.26f * direction, kRock + 0.17f, -0.22f * bend},
            {0.20f * direction, kRock + 0.38f, -0.30f},
            {0.06f * direction, kRock + 0.62f, -0.18f},
            {0.0f, kRock + 0.72f, 0.06f},
            {0.0f, kRock + 0.70f, 0.22f}};
}

/// Winds through the air above the rock, as those of the east do.
std::vector<vec3> flying(float lift) {
    std::vector<vec3> path;
    for (int k = 0; k <= 14; ++k) {
        const float t = toFloat(k) / 14.0f;
        path.emplace_back(glm::mix(-0.9f, 0.42f, t),
                          kRock + 0.42f + lift * std::sin(9.0f * t + 0.5f) * (1.0f - 0.35f * t),
                          0.32f * std::cos(9.0f * t) - 0.1f);
    }
    path.insert(path.end(),
                {{0.56f, kRock + 0.72f, 0.02f}, {0.44f, kRock + 0.86f, 0.22f}, {0.28f, kRock + 0.84f, 0.36f}});
    return path;
}

void addLand(Model& model) {
    const auto paving = [](const vec2& xz) {
        // Flagstones, moss between
        const vec2 warped = xz * 3.1f + 0.3f * vec2(noise({xz * 1.3f, 1}), noise({xz * 1.3f, 2}));
        const Cell cell = worley(warped, 17);
        vec3 stone = glm::mix(srgb(0x857a70), srgb(0xb0a393), cell.id) * (0.7f + 0.5f * fbm({xz * 7.0f, 3}, 4, 5)) *
                     (0.85f + 0.25f * noise({xz * 160.0f, 0}, 6));
        const vec3 moss = glm::mix(srgb(0x4a5a2c), srgb(0x6f7f3a), noise({xz * 60.0f, 4}));
        stone = glm::mix(stone, moss, 0.8f * glm::smoothstep(0.55f, 0.72f, fbm({xz * 1.1f, 9}, 4, 8)));
        return glm::mix(moss * 0.45f, stone, glm::smoothstep(0.03f, 0.10f, cell.second - cell.nearest));
    };
    const Ground grounds[] = {{{-2.2f, -3.6f}, {2.2f, 0.4f}, 1024}, {{-11.0f, -18.0f}, {11.0f, -3.6f}, 1024}};
    for (const Ground& ground : grounds)
        model.place("paving", addGround(model, "paving", ground, kToLight, 0.8f, 0.68f, paving), mat4(1.0f), false);

    const int image = model.picture("dusk", 1024, 512, [](float u, float v) {
        const float height = 1.0f - v, sun = glm::length((vec2(u, height) - vec2(0.66f, 0.25f)) * vec2(2.0f, 1.0f));
        vec3 color = glm::mix(vec3(0.95f, 0.42f, 0.16f), vec3(0.12f, 0.17f, 0.38f),
                              glm::smoothstep(0.1f, 0.85f, height + 0.1f * sun));
        color += vec3(0.75f, 0.5f, 0.2f) * std::exp(-7.0f * sun);
        const float cloud = glm::smoothstep(0.48f, 0.75f, fbm({u * 7.0f, height * 22.0f, 4}, 5, 3));
        color = glm::mix(color, vec3(0.95f, 0.55f, 0.42f) * (0.5f + 0.6f * std::exp(-2.0f * sun)),
                         0.55f * cloud * glm::smoothstep(0.22f, 0.5f, height));
        // Three ranges of mountains, the nearest darkest
        for (int range = 0; range < 3; ++range) {
            const float r = toFloat(range);
            const float ridge = 0.36f - 0.09f * r +
                                (0.15f - 0.03f * r) * (fbm({u * (7.0f + 4.0f * r), r * 7.0f, 0}, 6, 20) - 0.5f) * 2.0f;
            const vec3 hill = glm::mix(vec3(0.42f, 0.26f, 0.30f), vec3(0.05f, 0.06f, 0.07f), 0.5f * r);
            color = glm::mix(color, hill * (0.85f + 0.3f * fbm({u * 60.0f, height * 60.0f, r}, 3, 22)),
                             glm::smoothstep(-0.003f, 0.003f, ridge - height));
        }
        return color;
    });
    const int dusk = model.material("dusk", vec3(1.0f), 1.0f, 0.0f, image);
    model.materialAt(dusk).unlit = true;
    const auto wall = [] {
        return sheet(96, 24, [](float u, float v) {
            const float a = glm::mix(-1.45f, 1.45f, u);
            return vec3(11.0f * std::sin(a), 8.5f - 8.8f * v, -6.3f - 11.0f * std::cos(a));
        });
    };
    model.place("dusk", model.mesh("dusk", {{dusk, wall}}), mat4(1.0f), false);
}

int addRock(Model& model, std::uint32_t seed) {
    const Detail detail = model.detail;
    const float shift = toFloat(static_cast<int>(seed)) * 3.7f;
    const int image = model.picture("rock", 512, 512, [=](float u, float v) {
        const float a = kPi * u;
        return rock(2.2f * vec3(0.5f * std::sin(a) + shift, 1.1f * v, 0.5f * std::cos(a)));
    });
    const int material = model.material("rock", vec3(1.0f), 0.9f, 0.0f, image);
    return model.mesh(
        "rock", {{material, [=] {
                      return polar(detail.around(128), detail.along(100), [=](float u, float v) {
                          // From the middle of the top over the rim down to the foot
                          const float a = 2.0f * kPi * u, top = 0.3f;
                          const float down = saturate((v - top) / (0.94f - top)), in = v < top     ? v / top
                                                                                       : v > 0.94f ? (1.0f - v) / 0.06f
                                                                                                   : 1.0f;
                          const vec3 d(std::sin(a), 0.0f, std::cos(a));
                          const vec3 q = 1.6f * d + vec3(shift, 2.3f * down, 0.0f);
                          const float ledge = 0.05f * std::sin(15.0f * down + 5.0f * fbm(q, 3, seed));
                          const float r =
                              (0.25f + 0.16f * std::pow(down, 1.5f) + 0.14f * (fbm(1.3f * q, 4, seed + 1) - 0.5f) +
                               ledge * (0.3f + down) + 0.05f * (fbm(6.0f * q, 3, seed + 3) - 0.5f)) *
                              in;
                          const float y = kRock * (1.0f - down) +
                                          0.06f * (fbm(4.0f * d * in + shift, 4, seed + 2) - 0.5f) * (1.0f - down) -
                                          0.02f * down;
                          return vec3(r * d.x, y, r * d.z);
                      });
                  }}});
}

int addLantern(Model& model) {
    const Detail detail = model.detail;
    const int stone =
        model.material("lantern", srgb(0x8f867a), 0.85f, 0.0f, model.picture("stone", 256, 256, mottled(9, 0.5f, 31)));
    const int fire = model.glowing("lantern's light", {14.0f, 7.4f, 2.4f});
    const auto post = [=] {
        Shape s = lathe(detail,
                        {{0, 0},
                         {0.17f, 0},
                         {0.17f, 0.06f},
                         {0.08f, 0.1f},
                         {0.06f, 0.5f},
                         {0.12f, 0.56f},
                         {0.14f, 0.6f},
                         {0, 0.6f}},
                        48, 80, 2);
        s.add(lathe(detail,
                    {{0, 0.8f},
                     {0.19f, 0.78f},
                     {0.24f, 0.8f},
                     {0.12f, 0.9f},
                     {0.03f, 0.96f},
                     {0.04f, 1.0f},
                     {0.01f, 1.05f},
                     {0, 1.05f}},
                    48, 80, 2));
        for (int k = 0; k < 4; ++k)
            s.add(roundedBox(detail, {0.014f, 0.11f, 0.014f}, 0.005f)
                      .move(translation(around(45.0f + 90.0f * toFloat(k), 0.12f, 0.69f))));
        return s;
    };
    return model.mesh("lantern", {{stone, post}, {fire, [=] {
                                                      return ball(detail, 0.69f * kY, {0.065f, 0.085f, 0.065f}, 40);
                                                  }}});
}

}  // namespace

std::vector<Dragon> allDragons() {
    const auto hide = [](std::uint32_t back, std::uint32_t flank, std::uint32_t belly, std::uint32_t edge,
                         std::uint32_t horn, std::uint32_t membrane, const vec3& eye, float metallic, float roughness) {
        return Hide{srgb(back),     srgb(flank), srgb(belly), srgb(edge), srgb(horn),
                    srgb(membrane), eye,         roughness,   metallic};
    };
    std::vector<Dragon> all(6);
    all[0] = {"emerald dragon",
              coiled(1.75f, 1.0f, 0.34f),
              0.105f,
              {0.15f, -0.15f, 1.0f},
              0.36f,
              44,
              0.0f,
              0.8f,
              {},
              64,
              1.0f,
              false,
              hide(0x0f5c3a, 0x3fa860, 0xd8cf8a, 0x06251a, 0xe6d8b0, 0x2f7a4a, {5.0f, 3.2f, 0.3f}, 0.15f, 0.3f)};
    all[1] = {"crimson dragon",
              lying(1.0f, 1.0f),
              0.11f,
              {-0.2f, -0.2f, 1.0f},
              0.38f,
              40,
              0.95f,
              0.66f,
              {0.44f, 0.64f},
              52,
              0.6f,
              false,
              hide(0x7a1014, 0xc8342a, 0xe8b870, 0x2a0508, 0x3a2c28, 0xb85a2a, {4.5f, 4.0f, 0.6f}, 0.1f, 0.36f)};
    all[2] = {"golden dragon",
              flying(0.26f),
              0.085f,
              {-0.5f, -0.2f, 1.0f},
              0.33f,
              36,
              0.0f,
              0.6f,
              {0.5f, 0.74f},
              72,
              1.4f,
              true,
              hide(0xb87a14, 0xe8b83a, 0xf4e4b0, 0x4a2a08, 0xf0e8d0, 0xd8502a, {0.6f, 3.2f, 4.6f}, 0.85f, 0.28f)};
    all[3] = {"azure dragon",
              coiled(2.1f, -1.0f, 0.24f),
              0.092f,
              {-0.15f, -0.25f, 1.0f},
              0.34f,
              48,
              0.8f,
              0.86f,
              {},
              60,
              1.3f,
              true,
              hide(0x123a8a, 0x3f8ad0, 0xd0dce0, 0x061432, 0xd8dce4, 0x5a9ac0, {4.8f, 2.2f, 0.4f}, 0.3f, 0.28f)};
    all[4] = {"black dragon",
              lying(-1.0f, -1.0f),
              0.115f,
              {0.3f, -0.25f, 1.0f},
              0.4f,
              34,
              1.05f,
              0.66f,
              {0.44f, 0.64f},
              48,
              0.3f,
              false,
              hide(0x1c1a22, 0x4a4656, 0x8a7a70, 0x060608, 0xc8bca8, 0x5a2a4a, {6.0f, 1.2f, 0.3f}, 0.5f, 0.33f)};
    all[5] = {"ivory dragon",
              coiled(1.5f, 1.0f, 0.46f),
              0.1f,
              {0.0f, -0.35f, 1.0f},
              0.36f,
              40,
              0.0f,
              0.8f,
              {},
              56,
              1.6f,
              true,
              hide(0xc8b89a, 0xeee2c8, 0xf6eedc, 0x6a5238, 0xa87c3a, 0xd8b88a, {0.8f, 4.2f, 2.2f}, 0.05f, 0.4f)};
    // Each about 390 000 triangles
    const float fineness[] = {1.01f, 0.885f, 0.935f, 0.93f, 0.885f, 0.985f};
    for (std::size_t k = 0; k < all.size(); ++k) all[k].fineness = fineness[k];
    return all;
}

void makeDragons(Model& model) {
    addLand(model);
    const int rocks[] = {addRock(model, 1), addRock(model, 2), addRock(model, 3)};
    const int lantern = addLantern(model);
    const std::vector<Dragon> dragons = allDragons();
    std::vector<int> meshes;
    meshes.reserve(dragons.size());
    for (const Dragon& dragon : dragons) meshes.push_back(addDragon(model, dragon));
    struct Place {
        std::size_t kind;
        float x, y, z, size, turn;  // y: of the rock's foot
    };
    const Place places[] = {{2, -0.20f, 0.13f, -0.54f, 0.17f, 35.0f}, {0, 0.25f, 0.08f, -0.72f, 0.21f, -30.0f},
                            {5, -0.54f, 0.0f, -1.25f, 0.40f, 30.0f},  {1, 0.66f, 0.0f, -1.85f, 0.50f, -25.0f},
                            {3, -0.06f, 0.0f, -2.05f, 0.50f, 10.0f},  {4, -1.40f, 0.0f, -3.10f, 0.80f, 25.0f},
                            {2, 1.75f, 0.0f, -4.20f, 0.95f, -40.0f},  {0, 0.35f, 0.0f, -5.00f, 1.05f, -10.0f},
                            {3, -2.30f, 0.0f, -7.00f, 1.60f, 20.0f},  {1, 2.90f, 0.0f, -9.00f, 1.90f, -20.0f},
                            {4, -1.00f, 0.0f, -12.5f, 2.60f, 10.0f}};
    int number = 0;
    for (const Place& p : places) {
        const mat4 place = translation({p.x, p.y, p.z}) * rotation(p.turn, kY) * scaling(p.size);
        model.place(dragons[p.kind].name, meshes[p.kind], place);
        model.place("rock", rocks[number % 3], place * rotation(70.0f * toFloat(number), kY));
        // Statuettes stand on a second rock
        if (p.y > 0.0f)
            model.place("plinth", rocks[(number + 1) % 3],
                        translation({p.x, 0.0f, p.z}) * scaling({0.5f, p.y / kRock * 1.1f, 0.5f}));
        ++number;
    }
    const vec3 lanterns[] = {
        {-0.62f, 0.0f, -2.3f}, {1.1f, 0.0f, -2.6f}, {-1.9f, 0.0f, -5.0f}, {2.0f, 0.0f, -6.2f}, {-0.8f, 0.0f, -7.5f}};
    for (const vec3& at : lanterns) model.place("lantern", lantern, translation(at) * scaling(0.55f - 0.08f * at.z));

    model.camera({0.0f, 0.42f, 0.0f}, {0.0f, 0.40f, -2.5f});
    model.light(directional("low sun", kToLight, vec3(3.0f, 2.3f, 1.6f)));
    model.light(pointLight("sky", {2.5f, 3.0f, 1.0f}, vec3(4.0f, 5.0f, 7.5f)));
    model.light(pointLight("lantern", lanterns[0] + vec3(0, 0.5f, 0.1f), vec3(0.5f, 0.3f, 0.12f)));
}

}  // namespace dioptre::builtin
