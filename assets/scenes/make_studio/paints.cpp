// Woods, walls, cloth and other materials that repeat; paints_print.cpp has the things with drawings on them.
#include "paints.hpp"

#include <algorithm>
#include <cmath>

namespace studio {

namespace {

float seedOffset(std::uint32_t seed) {
    return unitFloat(hash(seed)) * 91.0f;
}

/// Wood seen along the grain `l` and across it `c`, both in metres: 0 dark late wood to 1 light early wood.
float woodGrain(float l, float c, float offset) {
    const float warp = fbm({c * 5.0f, l * 0.8f, offset}, 3) + 0.12f * fbm({c * 30.0f, l * 3.0f, offset + 3.0f}, 2);
    const float rings = 0.5f + 0.5f * std::sin(2.0f * kPi * (c * 16.0f + warp * 6.0f));
    const float fibre = fbm({c * 420.0f, l * 9.0f, offset + 7.0f}, 3);
    const float pores = glm::smoothstep(0.72f, 0.9f, noise({c * 800.0f, l * 22.0f, offset + 11.0f}));
    return glm::clamp(0.25f + 0.42f * std::pow(rings, 0.7f) + 0.55f * (fibre - 0.35f) - 0.28f * pores, 0.0f, 1.0f);
}

}  // namespace

Paint plain(const vec3& color, float variation) {
    return [=](const SurfacePoint& s) {
        const float cloud = fbm(s.position * 9.0f, 3) - 0.5f + 0.4f * (noise(s.position * 160.0f) - 0.5f);
        return Coat{color * (1.0f + 2.0f * variation * cloud), 0.6f};
    };
}

Paint wood(const vec3& light, const vec3& dark, bool alongU, float roughness) {
    return [=](const SurfacePoint& s) {
        const float l = alongU ? s.metres.x : s.metres.y, c = alongU ? s.metres.y : s.metres.x;
        const float g = woodGrain(l, c, seedOffset(s.seed));
        const float tint = 0.88f + 0.24f * unitFloat(hash(s.seed, 5u));
        return Coat{glm::mix(dark, light, g) * tint, roughness};
    };
}

Paint floorBoards(const vec3& light, const vec3& dark) {
    return [=](const SurfacePoint& s) {
        const float width = 0.125f, length = 1.3f;
        const float column = std::floor(s.metres.x / width);
        const auto columnSeed = hash(static_cast<std::uint32_t>(column), 77u);
        const float along = s.metres.y + unitFloat(columnSeed) * length;
        const auto board = hash(columnSeed, static_cast<std::uint32_t>(std::floor(along / length)));
        const vec2 in(fraction(s.metres.x / width) * width, fraction(along / length) * length);
        const vec2 edge = glm::min(in, vec2(width, length) - in);
        const float gap = glm::smoothstep(0.0f, 0.0028f, std::min(edge.x, edge.y));
        const float bevel = glm::smoothstep(0.0028f, 0.009f, std::min(edge.x, edge.y));
        const float g = woodGrain(along, s.metres.x, seedOffset(board));
        const float tint = 0.72f + 0.5f * unitFloat(hash(board, 9u));
        const float wear = 0.9f + 0.25f * fbm(s.position * 2.3f, 3, 41u);
        return Coat{glm::mix(dark, light, g) * (tint * wear * (0.22f + 0.78f * gap) * (0.88f + 0.12f * bevel))};
    };
}

Paint tableBoards(const vec3& light, const vec3& dark, int boards) {
    return [=](const SurfacePoint& s) {
        const float across = s.unit.y * static_cast<float>(boards);
        const auto board = hash(static_cast<std::uint32_t>(across), 19u);
        const float edge = std::min(fraction(across), 1.0f - fraction(across));
        const float seam = glm::smoothstep(0.0f, 0.012f, edge);
        const float g = woodGrain(s.metres.x + 3.0f * unitFloat(board), s.metres.y, seedOffset(board));
        const float tint = 0.85f + 0.28f * unitFloat(hash(board, 3u));
        // A few rings where cups stood, and scratches.
        float marks = 1.0f;
        for (std::uint32_t k = 0; k < 3; ++k) {
            const vec2 centre =
                s.metres - vec2(0.35f + 0.33f * static_cast<float>(k), 0.30f + 0.17f * static_cast<float>((k * 5) % 3));
            const float d = std::abs(glm::length(centre) - 0.038f - 0.002f * noise({centre * 30.0f, 1.0f}));
            marks -= 0.16f * (1.0f - glm::smoothstep(0.0006f, 0.0022f, d)) * noise({centre * 25.0f, 4.0f});
        }
        return Coat{glm::mix(dark, light, g) * (tint * marks * (0.45f + 0.55f * seam)), 0.35f};
    };
}

Paint brick() {
    return [](const SurfacePoint& s) {
        const float course = 0.076f, length = 0.225f, joint = 0.010f;
        // Courses run on over all walls: laid out in the room, not on the patch.
        const vec2 at(s.position.x + s.position.z, 8.0f - s.position.y);
        const float row = std::floor(at.y / course);
        const float shift = fraction(row * 0.5f) * length;
        const vec2 wobble = 0.0028f * (vec2(fbm({at * 60.0f, 1.0f}, 2), fbm({at * 60.0f, 2.0f}, 2)) - 0.5f);
        const vec2 p = at + wobble + vec2(shift, 0.0f);
        const auto id =
            hash(static_cast<std::uint32_t>(std::floor(p.x / length) + 64.0f), static_cast<std::uint32_t>(row + 64.0f));
        const vec2 in(fraction(p.x / length) * length, fraction(p.y / course) * course);
        const vec2 edge = glm::min(in, vec2(length, course) - in) - joint * 0.5f;
        const float inside = glm::smoothstep(-0.001f, 0.002f, std::min(edge.x, edge.y));
        const float r = unitFloat(id);
        vec3 clay = glm::mix(srgb(0x8a4a36), srgb(0xb06a4a), r);
        if (r > 0.8f) clay = glm::mix(srgb(0x6d3b30), srgb(0x5a4038), unitFloat(hash(id, 2u)));
        if (r < 0.16f) clay = srgb(0xc08a68);
        const float grain = fbm({p * 130.0f, seedOffset(id)}, 4), blotch = fbm({p * 17.0f, 3.0f}, 3);
        clay *= 0.55f + 0.6f * grain + 0.3f * blotch;
        // Upper edges catch the light, lower ones lie in the shade of the joint.
        const float relief = glm::smoothstep(0.010f, 0.0f, in.y - joint * 0.5f) * 0.22f -
                             glm::smoothstep(0.010f, 0.0f, course - in.y - joint * 0.5f) * 0.25f;
        const vec3 mortar = srgb(0x9a8f82) * (0.6f + 0.5f * fbm({p * 200.0f, 9.0f}, 3)) *
                            (0.75f + 0.25f * glm::smoothstep(joint, 0.0f, in.y));
        return Coat{glm::mix(mortar, clay * (1.0f + relief), inside)};
    };
}

Paint plaster(const vec3& color) {
    return [=](const SurfacePoint& s) {
        const float trowel = fbm(s.position * vec3(5.0f, 9.0f, 5.0f), 4) - 0.5f,
                    fine = fbm(s.position * 120.0f, 3) - 0.5f;
        return Coat{color * (1.0f + 0.16f * trowel + 0.12f * fine)};
    };
}

Paint wainscot(const vec3& color, float panelWidth) {
    return [=](const SurfacePoint& s) {
        const float x = fraction(s.metres.x / panelWidth) * panelWidth, edge = std::min(x, panelWidth - x);
        const float groove = glm::smoothstep(0.0f, 0.004f, edge), lip = glm::smoothstep(0.004f, 0.010f, edge);
        return Coat{color * (0.35f + 0.5f * groove + 0.15f * lip) *
                    (0.94f + 0.12f * fbm(s.position * vec3(80.0f, 6.0f, 80.0f), 3))};
    };
}

Paint fabric(const vec3& color, float pitch) {
    return [=](const SurfacePoint& s) {
        const vec2 t = s.metres / pitch;
        const bool warpOnTop = (static_cast<int>(std::floor(t.x)) + static_cast<int>(std::floor(t.y))) % 2 == 0;
        const float across = fraction(warpOnTop ? t.x : t.y) - 0.5f;
        const float thread = 1.0f - 1.6f * across * across;
        const float slub =
            fbm({warpOnTop ? t.x * 1.0f : t.x * 0.05f, warpOnTop ? t.y * 0.05f : t.y, warpOnTop ? 1.0f : 2.0f}, 2);
        const float wear = fbm(s.position * 11.0f, 3);
        return Coat{color * (thread * (0.62f + 0.5f * slub) * (0.85f + 0.3f * wear)), 0.9f};
    };
}

Paint linen(const vec3& color) {
    return [=](const SurfacePoint& s) {
        const float upright = fbm({s.metres.x * 420.0f, s.metres.y * 6.0f, 1.0f}, 3),
                    level = fbm({s.metres.x * 8.0f, s.metres.y * 300.0f, 2.0f}, 3);
        return Coat{color * (0.84f + 0.18f * upright + 0.14f * level), 0.9f};
    };
}

Paint leather(const vec3& color) {
    return [=](const SurfacePoint& s) {
        const Cell cell = worley(s.metres * 260.0f, s.seed);
        const float crease = glm::smoothstep(0.02f, 0.25f, cell.second - cell.nearest);
        const float wear = fbm(s.position * 7.0f, 4);
        return Coat{color * ((0.7f + 0.3f * crease) * (0.6f + 0.8f * wear)), 0.45f};
    };
}

Paint ceramic(const vec3& glaze, const vec3& clay, float roughness, float bareFrom) {
    return [=](const SurfacePoint& s) {
        const float drip = s.unit.y - bareFrom + 0.12f * (fbm({s.unit.x * 9.0f, 0.0f, 3.0f}, 2) - 0.5f);
        const float bare = glm::smoothstep(-0.008f, 0.008f, drip);
        const float speck = glm::smoothstep(0.74f, 0.8f, noise(s.position * 420.0f));
        const float run = fbm(vec3(s.unit.x * 26.0f, s.unit.y * 2.2f, 1.0f), 3);
        const vec3 glazed = glaze * (0.72f + 0.5f * run) * (1.0f - 0.45f * speck);
        return Coat{glm::mix(glazed, clay * (0.85f + 0.3f * fbm(s.position * 200.0f, 2)), bare),
                    glm::mix(roughness, 0.8f, bare)};
    };
}

Paint brass(float roughness, float tarnish) {
    return [=](const SurfacePoint& s) {
        const float dull = tarnish * glm::smoothstep(0.4f, 0.7f, fbm(s.position * 38.0f, 4));
        return Coat{glm::mix(vec3(0.91f, 0.68f, 0.32f), vec3(0.24f, 0.16f, 0.08f), dull), roughness + 0.3f * dull,
                    1.0f - 0.55f * dull};
    };
}

Paint hammeredBrass() {
    return [](const SurfacePoint& s) {
        // Dents on a grid that closes around the bowl.
        const float around = std::round(s.metres.x / 0.014f);
        const Cell cell = worley({s.unit.x * around, s.metres.y / 0.014f}, 5u);
        Coat coat = brass(0.34f, 0.8f)(s);
        coat.height = 0.0016f * std::min(cell.nearest * cell.nearest, 0.5f);
        coat.albedo *= 0.75f + 0.35f * cell.nearest;
        return coat;
    };
}

Paint foliage(const vec3& young, const vec3& old) {
    return [=](const SurfacePoint& s) {
        const float side = std::abs(2.0f * s.unit.x - 1.0f), along = 1.0f - s.unit.y;
        const float midrib = glm::smoothstep(0.10f, 0.03f, side * (1.2f - along));
        const float vein = std::abs(fraction((along - 0.42f * side) * 9.0f) - 0.5f);
        const float veins = glm::smoothstep(0.12f, 0.03f, vein) * (1.0f - side);
        const float age = 0.35f + 0.5f * unitFloat(hash(s.seed, 4u)) + 0.3f * (fbm(s.position * 70.0f, 3) - 0.5f);
        const vec3 blade =
            glm::mix(young, old, glm::clamp(age, 0.0f, 1.0f)) * (0.85f + 0.3f * noise(s.position * 900.0f));
        return Coat{glm::mix(blade, young * 1.35f, 0.55f * std::max(midrib, 0.6f * veins)), 0.5f};
    };
}

Paint bark(const vec3& color) {
    return [=](const SurfacePoint& s) {
        const float ridge = fbm({s.unit.x * 14.0f, s.metres.y * 24.0f, 2.0f}, 4);
        return Coat{color * (0.45f + 1.0f * ridge), 0.9f};
    };
}

Paint fruit(const vec3& color) {
    return [=](const SurfacePoint& s) {
        const float pores = glm::smoothstep(0.55f, 0.8f, noise(s.position * 700.0f));
        const float stalk = glm::smoothstep(0.10f, 0.05f, s.unit.y);
        const vec3 skin = color * (0.9f + 0.3f * fbm(s.position * 30.0f, 3)) * (1.0f - 0.18f * pores);
        return Coat{glm::mix(skin, srgb(0x4c5a2a), stalk), 0.4f};
    };
}

}  // namespace studio
