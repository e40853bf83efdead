// Houses and their lights on the slope and along the shore, trees, and a string of lanterns before the window.
#include <algorithm>
#include <cmath>

#include "paints.hpp"
#include "scene.hpp"
#include "scene_outside.hpp"
#include "shapes.hpp"

namespace studio {

namespace {

vec3 onGround(float azimuthDegrees, float distance, float above = 0.0f) {
    const float a = glm::radians(azimuthDegrees);
    const vec2 p(distance * std::sin(a), -distance * std::cos(a));
    return {p.x, groundHeight(p) + above, p.y};
}

/// A gabled house, 6 patches: four walls and two roofs. Foot's middle at the origin.
Patches house(float width, float depth, float height) {
    const float x = width * 0.5f, z = depth * 0.5f, top = height + 0.42f * depth, eave = 0.5f;
    return {rectangle({-x, height, z}, {width, 0, 0}, {0, -height, 0}),
            rectangle({x, height, -z}, {-width, 0, 0}, {0, -height, 0}),
            surface(3, 2,
                    [=](float u, float v) {
                        return vec3(x, v == 1.0f ? 0.0f : (u == 0.5f ? top : height), z - depth * u);
                    }),
            surface(3, 2,
                    [=](float u, float v) {
                        return vec3(-x, v == 1.0f ? 0.0f : (u == 0.5f ? top : height), -z + depth * u);
                    }),
            rectangle({-x - eave, top, 0}, {width + 2 * eave, 0, 0}, {0, -(top - height) - 0.3f, z + eave}),
            rectangle({x + eave, top, 0}, {-width - 2 * eave, 0, 0}, {0, -(top - height) - 0.3f, -z - eave})};
}

Paint houseWall(const vec3& color) {
    return [=](const SurfacePoint& s) {
        // Two or three rows of windows, some of them lit.
        const vec2 cell = s.metres / vec2(2.4f, 2.7f);
        const vec2 in = glm::fract(cell);
        const auto id = hash(hash(s.seed, static_cast<std::uint32_t>(cell.x)), static_cast<std::uint32_t>(cell.y));
        const bool pane = in.x > 0.3f && in.x < 0.7f && in.y > 0.25f && in.y < 0.72f && s.unit.y > 0.12f;
        if (pane && id % 5u < 3u)
            return Coat{throughAir(vec3(1.0f, 0.62f, 0.25f) * (0.75f + 0.35f * unitFloat(id)), s.position)};
        return Coat{lightOutside(pane ? srgb(0x3a4454) : color * (0.9f + 0.2f * noise(s.position * 2.0f)), s.normal,
                                 s.position)};
    };
}

Paint houseRoof(const vec3& color) {
    return [=](const SurfacePoint& s) {
        const float rows = 0.8f + 0.25f * fraction(s.metres.y / 0.4f);
        return Coat{lightOutside(color * rows * (0.8f + 0.4f * noise(s.position * 1.5f)), s.normal, s.position)};
    };
}

void addHouses(Model& model) {
    Object& houses = model.add("houses", Finish::painted, 256, 256);
    Rng rng(8);
    // Nine models share their charts: three looks at each of three distances, so that haze stays right.
    const int looks = 9;
    const vec3 walls[] = {srgb(0xd8c8b0), srgb(0xb89a80), srgb(0xcfc4c0)},
               roofs[] = {srgb(0x7a4436), srgb(0x5a4a48), srgb(0x6e5040)};
    for (int k = 0; k < 118; ++k) {
        const int ring = k % 3;
        const float distance = ring == 0   ? rng.range(120.0f, 185.0f)
                               : ring == 1 ? rng.range(190.0f, 330.0f)
                                           : rng.range(340.0f, 470.0f);
        const float azimuth = rng.range(-22.0f, 34.0f);
        const float width = rng.range(8.0f, 13.0f), depth = rng.range(7.0f, 9.0f),
                    height = rng.range(4.5f, ring == 2 ? 9.5f : 7.0f);
        if (ring == 0 && k > 40) continue;
        const mat4 m =
            translation(onGround(azimuth, distance, -0.8f)) * rotation(-azimuth + rng.range(-38.0f, 38.0f), kY);
        const Patches parts = place(house(width, depth, height), m);
        const int look = k % looks;
        for (std::size_t part = 0; part < 6; ++part) {
            houses.add(parts[part], part < 4 ? houseWall(walls[(k / 3) % 3]) : houseRoof(roofs[(k / 3) % 3]));
            if (k >= looks) houses.patches.back().sharedChart = look * 6 + static_cast<int>(part);
        }
    }
}

void addCityLights(Model& model) {
    struct Kind {
        const char* name;
        vec3 color;
        float strength;
        int count;
    };
    Rng rng(21);
    for (const Kind& kind : {Kind{"amber town lights", {1.0f, 0.50f, 0.11f}, 15.0f, 210},
                             Kind{"white town lights", {1.0f, 0.78f, 0.50f}, 12.0f, 90},
                             Kind{"signal lights", {1.0f, 0.13f, 0.07f}, 16.0f, 12}}) {
        Object& lights = model.add(kind.name, Finish::glowing, 0, 0);
        lights.emissive = kind.color;
        lights.emissiveStrength = kind.strength;
        for (int k = 0; k < kind.count; ++k) {
            // Streets wind down to the shore; a promenade follows it; a few lights on the far side.
            const float pick = rng.next();
            vec3 p;
            if (pick < 0.30f) {
                const int street = rng.index(4);
                const float t = rng.next(), distance = glm::mix(60.0f, 420.0f, std::pow(t, 0.8f));
                p = onGround(-14.0f + 11.0f * static_cast<float>(street) +
                                 5.0f * std::sin(t * 7.0f + static_cast<float>(street)),
                             distance, 5.0f);
            } else if (pick < 0.45f) {
                p = onGround(rng.range(-20.0f, 30.0f), rng.range(425.0f, 445.0f), 6.0f);
            } else {
                const float a = glm::radians(rng.range(-24.0f, 38.0f)), d = 1510.0f + 560.0f * rng.next() * rng.next();
                p = {d * std::sin(a), farShoreHeight(a, d) + 5.0f, -d * std::cos(a)};
            }
            lights.add(bead(p, glm::length(p) * rng.range(0.0009f, 0.0015f)), plain(vec3(1.0f)));
        }
    }
}

/// A bough full of leaves on a card (motif 0) or a conifer's outline (motif 1).
Paint treeCard(int motif) {
    return [motif](const SurfacePoint& s) {
        const vec2 u = s.unit;
        Coat coat;
        coat.alpha = 0.0f;
        if (motif == 1) {
            const float y = u.y, tier = fraction(y * 9.0f + 0.6f * fbm({u.x * 9.0f, y * 4.0f, 1.0f}, 2));
            const float half = 0.03f + 0.44f * std::pow(y, 0.85f) * (0.62f + 0.38f * tier) *
                                           (0.8f + 0.4f * fbm({u.x * 30.0f, y * 40.0f, 2.0f}, 2));
            if (std::abs(u.x - 0.5f) < half && y < 0.95f) coat.alpha = 1.0f;
            if (std::abs(u.x - 0.5f) < 0.025f) coat.alpha = 1.0f;
            coat.albedo = srgb(0x22382c) * (0.45f + 0.7f * tier) * (0.6f + 0.7f * fbm({u * 40.0f, 3.0f}, 3));
        } else {
            coat.albedo = srgb(0x3e5230) * 0.8f;
            for (std::uint32_t k = 0; k < 64; ++k) {
                const float a = 2.0f * kPi * unitFloat(hash(k, 1u)), r = 0.44f * std::sqrt(unitFloat(hash(k, 2u)));
                const vec2 d = u - 0.5f - r * vec2(std::cos(a), std::sin(a));
                const float turn = a + 3.0f * (unitFloat(hash(k, 3u)) - 0.5f);
                const vec2 q(d.x * std::cos(turn) + d.y * std::sin(turn), -d.x * std::sin(turn) + d.y * std::cos(turn));
                const float l = 0.085f;
                if (std::abs(q.x) < l && std::abs(q.y) < 0.030f * (1.0f - q.x * q.x / (l * l))) {
                    coat.alpha = 1.0f;
                    const vec3 tint =
                        glm::mix(srgb(0x3c5a34), srgb(0xb08a3c), unitFloat(hash(k, 4u)) * unitFloat(hash(k, 6u)));
                    coat.albedo =
                        tint * (0.4f + 0.65f * unitFloat(hash(k, 5u))) * (std::abs(q.y) < 0.003f ? 1.3f : 1.0f);
                }
            }
        }
        return coat;
    };
}

void addTrees(Model& model) {
    Object& trees = model.add("trees", Finish::masked, 256, 128);
    Rng rng(90);
    const auto card = [&](const vec3& foot, const vec3& right, const vec3& up, int motif) {
        trees.add(rectangle(foot - 0.5f * right + up, right, -up), treeCard(motif));
        if (trees.patches.size() > 2) trees.patches.back().sharedChart = motif;
    };
    // The first two cards own the charts.
    card(onGround(-9.0f, 20.0f), {0.8f, 0, 0}, {0, 0.8f, 0}, 0);
    card(onGround(12.0f, 160.0f), {4.0f, 0, 0}, {0, 9.0f, 0}, 1);
    trees.patches[0].size = trees.patches[1].size = {1.0f, 1.0f};
    // Conifers: crossed cards.
    for (int k = 0; k < 130; ++k) {
        // Beyond 110 m their tops stay below the horizon and the lake stays in view.
        const float distance = 110.0f + 300.0f * rng.next();
        const vec3 foot = onGround(rng.range(-28.0f, 42.0f), distance, -0.4f);
        const float h = rng.range(6.0f, 11.0f), w = h * rng.range(0.38f, 0.5f), turn = rng.range(0.0f, kPi);
        for (int c = 0; c < 2; ++c) {
            const float a = turn + kPi * 0.5f * static_cast<float>(c);
            card(foot, w * vec3(std::cos(a), 0, std::sin(a)), {0, h, 0}, 1);
        }
    }
    // Bushes on the bank below the window.
    for (int k = 0; k < 34; ++k) {
        const vec3 foot = onGround(rng.range(-26.0f, 36.0f), rng.range(14.0f, 62.0f), -0.15f);
        const float size = rng.range(0.7f, 1.5f);
        for (int c = 0; c < 5; ++c) {
            const float turn = rng.range(-0.9f, 0.9f);
            const vec3 at = foot + size * vec3(rng.range(-0.6f, 0.6f), rng.range(-0.1f, 0.35f), rng.range(-0.4f, 0.4f));
            card(at, size * vec3(std::cos(turn), rng.range(-0.2f, 0.2f), std::sin(turn)),
                 {rng.range(-0.2f, 0.2f) * size, size, 0}, 0);
        }
    }
    // Two broad-leaved trees close to the house.
    Object trunks;
    trunks.name = "trunks";
    trunks.finish = Finish::painted;
    trunks.textureWidth = trunks.textureHeight = 64;
    const auto grow = [&](const vec3& foot, float height, int cards) {
        const vec3 fork = foot + vec3(0.2f, 0.45f * height, 0.0f);
        const Paint barkPaint = [](const SurfacePoint& s) {
            return Coat{lightOutside(bark(srgb(0x6a5a4c))(s).albedo, s.normal, s.position)};
        };
        trunks.add(tube(
                       {foot, glm::mix(foot, fork, 0.5f) + vec3(0.12f, 0, 0), fork},
                       [=](float t) { return height * (0.026f - 0.010f * t); }, 9, 6),
                   barkPaint);
        for (int b = 0; b < 11; ++b) {
            const float a = 2.4f * static_cast<float>(b), reach = height * rng.range(0.16f, 0.30f);
            const vec3 tip = fork + vec3(reach * std::cos(a), height * rng.range(0.12f, 0.5f), reach * std::sin(a));
            trunks.add(tube(
                           {fork - vec3(0, 0.1f * height * rng.next(), 0),
                            glm::mix(fork, tip, 0.45f) + vec3(0, 0.04f * height, 0), tip},
                           [=](float t) { return height * (0.011f - 0.009f * t); }, 5, 5),
                       barkPaint, 0.4f);
            for (int c = 0; c < cards / 11; ++c) {
                const vec3 at = glm::mix(fork, tip, rng.range(0.45f, 1.12f)) +
                                height * 0.07f * vec3(rng.range(-1, 1), rng.range(-1, 1), rng.range(-1, 1));
                const float size = height * rng.range(0.085f, 0.14f), turn = rng.range(0.0f, kPi);
                const vec3 right =
                    size * glm::normalize(vec3(std::cos(turn), rng.range(-0.4f, 0.4f), 0.7f * std::sin(turn)));
                const vec3 up = size * glm::normalize(glm::cross(
                                           right, vec3(rng.range(-0.4f, 0.4f), rng.range(-0.3f, 0.3f), 1.0f)));
                card(at - 0.5f * up * glm::sign(up.y), right, up * glm::sign(up.y), 0);
            }
        }
    };
    grow(onGround(17.0f, 17.5f, -0.5f), 7.6f, 320);
    grow(onGround(-12.5f, 24.0f, -0.5f), 8.0f, 264);
    model.objects.push_back(std::move(trunks));
}

void addLanterns(Model& model) {
    // Hung between the window's corners' posts, 2 m outside.
    Object wire, lights;
    wire.name = "lantern wire";
    wire.finish = Finish::painted;
    wire.textureWidth = wire.textureHeight = 64;
    lights.name = "lanterns";
    lights.finish = Finish::glowing;
    lights.emissive = {1.0f, 0.48f, 0.09f};
    lights.emissiveStrength = 9.0f;
    const std::vector<vec3> path{
        {-1.6f, 2.55f, -6.2f}, {-0.5f, 2.13f, -6.3f}, {0.6f, 1.95f, -6.4f}, {1.7f, 2.06f, -6.5f}, {3.1f, 2.6f, -6.6f}};
    const Paint dark = [](const SurfacePoint&) { return Coat{vec3(0.012f, 0.011f, 0.012f)}; };
    wire.add(tube(path, 0.005f, 4, 40), dark);
    for (int k = 0; k < 15; ++k) {
        const vec3 p = curvePoint(path, (static_cast<float>(k) + 0.5f) / 15.0f);
        wire.add(place(lathe({{0.004f, 0.01f}, {0.013f, 0.0f}, {0.013f, -0.045f}}, 7, 3), translation(p)), dark);
        lights.add(place(ball(0.026f, 10, 7), translation(p - vec3(0, 0.066f, 0))), plain(vec3(1.0f)));
    }
    model.objects.push_back(std::move(wire));
    model.objects.push_back(std::move(lights));
}

}  // namespace

void addTown(Model& model) {
    addHouses(model);
    addCityLights(model);
    addTrees(model);
    addLanterns(model);
}

}  // namespace studio
