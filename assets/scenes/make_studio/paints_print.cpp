// Paints with something drawn on them: books, paper, pictures, the rug, the globe.
#include <algorithm>
#include <cmath>

#include "paints.hpp"

namespace studio {

namespace {

float segment(const vec2& p, const vec2& a, const vec2& b) {
    const vec2 ab = b - a;
    return glm::distance(p, a + glm::clamp(glm::dot(p - a, ab) / glm::dot(ab, ab), 0.0f, 1.0f) * ab);
}

/// Ink of a line of given half width at distance d, both in metres.
float stroke(float d, float halfWidth) {
    return 1.0f - glm::smoothstep(halfWidth * 0.6f, halfWidth * 1.5f, d);
}

/// Lines of invented writing: words of 3 x 5 dot letters. `p` in line heights from the first line's left end.
float writing(const vec2& p, float lineLength, std::uint32_t seed) {
    if (p.x < 0.0f || p.y < 0.0f) return 0.0f;
    const float line = std::floor(p.y);
    const auto lineSeed = hash(seed, static_cast<std::uint32_t>(line));
    if (p.x > lineLength * (0.6f + 0.4f * unitFloat(lineSeed))) return 0.0f;
    const vec2 in(fraction(p.x / 0.36f), (p.y - line) / 0.62f);
    if (in.y > 1.0f) return 0.0f;
    const auto letterSeed = hash(lineSeed, static_cast<std::uint32_t>(p.x / 0.36f));
    if (letterSeed % 6u == 0u || in.x > 0.78f) return 0.0f;
    const int dot = static_cast<int>(in.x / 0.26f) + 3 * static_cast<int>(in.y * 5.0f);
    return (hash(letterSeed, 3u) >> dot & 1u) ? 1.0f : 0.0f;
}

vec3 bindingColor(std::uint32_t seed) {
    static const std::uint32_t kPalette[] = {0x7a2e2a, 0x2f4858, 0x3f5a44, 0xb58a4a, 0x86604a, 0x2b3a55,
                                             0xa4503a, 0xc9b48c, 0x5a3a52, 0x64744c, 0xd8cdb4, 0x8c3f4a,
                                             0x41636a, 0x4a3a30, 0xb96f3c, 0x1f3f46};
    return srgb(kPalette[hash(seed, 1u) % 16u]);
}

vec3 paperColor(const SurfacePoint& s) {
    return srgb(0xf0e6d0) * (0.93f + 0.07f * fbm(s.position * 40.0f, 2) + 0.03f * noise(s.position * 900.0f));
}

}  // namespace

Paint bookSpine(std::uint32_t seed) {
    return [seed](const SurfacePoint& s) {
        const vec3 base = bindingColor(seed);
        const bool dark = luminance(base) < 0.25f;
        const vec3 foil = dark ? srgb(0xd9b05c) : srgb(0x3a2a20);
        const float cloth = 0.8f + 0.25f * noise(s.position * 700.0f) + 0.15f * fbm(s.position * 40.0f, 3);
        const float rounding = 1.0f - 0.35f * std::pow(std::abs(2.0f * s.unit.x - 1.0f), 4.0f);
        const float y = s.unit.y;
        const int style = static_cast<int>(hash(seed, 2u) % 4u);
        float ink = 0.0f;
        const auto band = [&](float at, float half) {
            ink = std::max(ink, 1.0f - glm::smoothstep(half * 0.8f, half * 1.2f, std::abs(y - at)));
        };
        vec3 color = base;
        if (style != 3) {
            band(0.08f, 0.006f);
            band(0.92f, 0.006f);
        }
        if (style == 0) {
            band(0.105f, 0.003f);
            band(0.895f, 0.003f);
            band(0.20f, 0.004f);
            band(0.42f, 0.004f);
        }
        if (style == 1 && y > 0.16f && y < 0.34f) color = dark ? srgb(0x6e2320) : srgb(0x2f3a44);
        if (style == 2) band(0.5f, 0.02f);
        // The title runs down the spine.
        const float lines = unitFloat(hash(seed, 6u)) > 0.5f && s.metres.x > 0.0f ? 2.0f : 1.0f;
        const float width = 1.0f / (lines + 0.9f);
        const vec2 title((y - 0.22f) * 16.0f, (1.0f - s.unit.x) / width - 0.45f);
        if (y > 0.2f && y < 0.8f && s.unit.x > 0.12f && s.unit.x < 0.88f && title.y < lines)
            ink = std::max(ink, writing(title, 8.0f, seed));
        return Coat{glm::mix(color * cloth, foil, 0.85f * ink) * rounding, 0.6f};
    };
}

Paint bookCover(std::uint32_t seed) {
    return [seed](const SurfacePoint& s) {
        const float cloth = 0.8f + 0.25f * noise(s.position * 700.0f) + 0.15f * fbm(s.position * 40.0f, 3);
        const vec2 edge = glm::min(s.unit, 1.0f - s.unit) * s.size;
        const float d = std::min(edge.x, edge.y);
        const float worn = glm::smoothstep(0.006f, 0.0f, d) * fbm(s.position * 90.0f, 3);
        const float frame = stroke(std::abs(d - 0.018f), 0.0012f);
        const vec3 color = glm::mix(bindingColor(seed) * cloth, srgb(0xd9c8a0), 0.6f * worn);
        return Coat{glm::mix(color, srgb(0xd9b05c), 0.7f * frame), 0.6f};
    };
}

Paint bookPages() {
    return [](const SurfacePoint& s) {
        const float leaves = noise({s.unit.y * 90.0f, s.unit.x * 1.5f, 1.0f}) * 0.6f +
                             noise({s.unit.x * 90.0f, s.unit.y * 1.5f, 2.0f}) * 0.4f;
        return Coat{srgb(0xe2d3b0) * (0.66f + 0.4f * leaves), 0.9f};
    };
}

Paint notebookPage(bool left) {
    return [left](const SurfacePoint& s) {
        const vec2 p = s.unit * vec2(0.20f, 0.28f);  // metres on the nominal page
        vec3 color = paperColor(s);
        float ink = 0.0f, red = 0.0f, pencil = 0.0f;
        if (left) {
            ink = writing((p - vec2(0.022f, 0.03f)) / 0.0085f, 17.0f, 3u) * (p.y < 0.13f ? 1.0f : 0.0f);
            ink =
                std::max(ink, writing((p - vec2(0.022f, 0.225f)) / 0.0085f, 17.0f, 8u) * (p.y < 0.262f ? 1.0f : 0.0f));
            // Concentric circles of confusion, growing to the right.
            for (int k = 0; k < 5; ++k) {
                const vec2 centre(0.035f + 0.033f * static_cast<float>(k), 0.178f);
                const float r = 0.003f + 0.0042f * static_cast<float>(k);
                pencil = std::max(pencil, stroke(std::abs(glm::distance(p, centre) - r), 0.0005f));
                pencil = std::max(pencil, 0.28f * (glm::distance(p, centre) < r ? 1.0f : 0.0f));
            }
        } else {
            const vec2 lens(0.085f, 0.115f), image(0.172f, 0.115f), far(0.014f, 0.115f);
            pencil = stroke(segment(p, {0.010f, 0.115f}, {0.192f, 0.115f}), 0.0004f);
            for (const float side : {-1.0f, 1.0f}) {
                const float arc = std::abs(glm::distance(p, lens + vec2(side * 0.085f, 0.0f)) - 0.093f);
                if (std::abs(p.y - lens.y) < 0.042f && (p.x - lens.x) * side < 0.0f)
                    ink = std::max(ink, stroke(arc, 0.0007f));
            }
            for (int k = -2; k <= 2; ++k) {
                const vec2 at = lens + vec2(0.0f, 0.017f * static_cast<float>(k));
                red = std::max({red, stroke(segment(p, far, at), 0.00045f),
                                stroke(segment(p, at, image + (image - at) * 0.16f), 0.00045f)});
            }
            ink = std::max(ink, stroke(segment(p, {0.172f, 0.085f}, {0.172f, 0.145f}), 0.0006f));
            ink = std::max(ink, writing((p - vec2(0.02f, 0.026f)) / 0.011f, 7.0f, 21u) * (p.y < 0.036f ? 1.0f : 0.0f));
            ink = std::max(ink, writing((p - vec2(0.022f, 0.19f)) / 0.0085f, 17.0f, 5u) * (p.y < 0.257f ? 1.0f : 0.0f));
        }
        color = glm::mix(color, srgb(0x8d8a86), 0.75f * pencil);
        color = glm::mix(color, srgb(0xb8452e), 0.9f * red);
        color = glm::mix(color, srgb(0x243050), 0.85f * ink);
        // The gutter between the pages.
        const float gutter = left ? 1.0f - s.unit.x : s.unit.x;
        return Coat{color * (0.72f + 0.28f * glm::smoothstep(0.0f, 0.09f, gutter)), 0.9f};
    };
}

Paint letter(std::uint32_t seed) {
    return [seed](const SurfacePoint& s) {
        const float ink =
            writing((s.metres - vec2(0.022f, 0.03f)) / 0.009f, 17.0f, seed) * (s.unit.y < 0.85f ? 1.0f : 0.0f);
        return Coat{glm::mix(paperColor(s), srgb(0x2c3448), 0.8f * ink), 0.9f};
    };
}

Paint framedPicture(int motif) {
    return [motif](const SurfacePoint& s) {
        const vec2 u = s.unit;
        const vec2 edge = glm::min(u, 1.0f - u) * s.size;
        const float mat = glm::smoothstep(0.028f, 0.03f, std::min(edge.x, edge.y));
        vec3 c = srgb(0xe9dcc0);
        if (motif == 0) {
            c = glm::mix(srgb(0x1d3448), srgb(0xe0a070), glm::smoothstep(0.0f, 0.75f, u.y));
            if (glm::distance(u * s.size, vec2(0.62f, 0.3f) * s.size) < 0.12f * s.size.x) c = srgb(0xf6ead0);
            for (int k = 0; k < 4; ++k) {
                const float ridge = 0.5f + 0.12f * static_cast<float>(k) +
                                    0.13f * (fbm({u.x * 3.0f, static_cast<float>(k), 2.0f}, 3) - 0.5f);
                if (u.y > ridge) c = glm::mix(srgb(0x6a6f86), srgb(0x16222e), static_cast<float>(k) / 3.0f);
            }
        } else if (motif == 1) {
            c = u.y < 0.46f ? srgb(0xb4492c) : u.y < 0.78f ? srgb(0xd9a53c) : srgb(0x2b3c4e);
            if (std::abs(u.y - 0.46f) < 0.012f) c = srgb(0x3a201a);
        } else if (motif == 2) {
            const float d = glm::distance(u * s.size, vec2(0.5f, 0.45f) * s.size) / s.size.x;
            const float ring = std::floor(d * 14.0f);
            if (d < 0.38f) c = static_cast<int>(ring) % 2 == 0 ? srgb(0x264653) : srgb(0xe0b05a);
            if (d < 0.07f) c = srgb(0xb4432e);
        } else {
            // A stem with paired leaves.
            const vec2 p((u.x - 0.5f) * s.size.x / s.size.y, u.y);
            float ink = stroke(std::abs(p.x - 0.02f * std::sin(u.y * 7.0f)), 0.004f) *
                        (u.y > 0.15f && u.y < 0.86f ? 1.0f : 0.0f);
            for (int k = 0; k < 6; ++k) {
                const vec2 base(0.0f, 0.26f + 0.095f * static_cast<float>(k));
                const vec2 q(std::abs(p.x) - base.x, p.y - base.y + 0.55f * std::abs(p.x));
                const float l = 0.21f - 0.02f * std::abs(static_cast<float>(k) - 2.0f);
                if (q.x > 0.0f && q.x < l && std::abs(q.y) < 0.030f * std::sin(kPi * q.x / l)) ink = 1.0f;
            }
            c = glm::mix(c, srgb(0x3d5a3c), 0.9f * ink);
        }
        c *= 0.85f + 0.3f * fbm(s.position * 150.0f, 3);
        return Coat{glm::mix(srgb(0xe9e2d2), c, mat), 0.7f};
    };
}

Paint rug() {
    return [](const SurfacePoint& s) {
        // Fold into one quarter; everything is drawn by distance from the edge and from the middle.
        const vec2 fold = 0.5f - glm::abs(s.unit - 0.5f);
        const vec2 edge = fold * s.size;
        const float border = std::min(edge.x, edge.y);
        const vec2 m = glm::abs(s.unit - 0.5f) * s.size;
        const vec3 red = srgb(0x7d2a24), navy = srgb(0x22304a), cream = srgb(0xd9c6a0), ochre = srgb(0xb7813c),
                   teal = srgb(0x3f6a68);
        const auto motif = [&](float pitch, vec2 p) {
            const vec2 c = glm::abs(glm::fract(p / pitch) - 0.5f);
            return c.x + c.y;
        };
        vec3 c = red;
        if (border < 0.03f)
            c = navy;
        else if (border < 0.04f)
            c = cream;
        else if (border < 0.16f) {
            const float d = motif(0.12f, edge.x < edge.y ? vec2(edge.x - 0.04f, m.y) : vec2(edge.y - 0.04f, m.x));
            c = d < 0.16f ? cream : d < 0.26f ? red : d < 0.40f ? ochre : navy;
        } else if (border < 0.172f)
            c = cream;
        else if (border < 0.20f)
            c = fraction((m.x + m.y) / 0.04f) < 0.5f ? teal : ochre;
        else {
            const float medallion = m.x / 0.42f + m.y / 0.62f + 0.05f * std::sin(24.0f * std::atan2(m.y, m.x));
            if (medallion < 1.0f)
                c = medallion < 0.25f   ? ochre
                    : medallion < 0.32f ? cream
                    : medallion < 0.62f ? navy
                    : medallion < 0.68f ? cream
                                        : teal;
            else {
                const float d = motif(0.16f, m);
                if (d < 0.14f)
                    c = cream;
                else if (d < 0.22f)
                    c = navy;
                else if (std::abs(d - 0.46f) < 0.025f)
                    c = ochre;
            }
            if (medallion < 0.62f && motif(0.09f, m) < 0.16f) c = red;
        }
        const float knots = 0.7f + 0.3f * noise({s.metres * 330.0f, 1.0f}) +
                            0.25f * (fbm({s.metres.x * 4.0f, s.metres.y * 60.0f, 2.0f}, 3) - 0.5f);
        return Coat{c * knots * (0.85f + 0.3f * fbm({s.metres * 5.0f, 6.0f}, 3)), 0.95f};
    };
}

Paint earth() {
    return [](const SurfacePoint& s) {
        const float a = 2.0f * kPi * s.unit.x, e = kPi * s.unit.y;
        const vec3 p(std::sin(e) * std::cos(a), std::cos(e), std::sin(e) * std::sin(a));
        const float relief = fbm(p * 1.7f + 4.2f, 6, 12u) + 0.08f * (fbm(p * 9.0f, 3) - 0.5f);
        const float land = glm::smoothstep(0.525f, 0.535f, relief);
        const float coast = stroke(std::abs(relief - 0.53f), 0.006f);
        const vec3 sea = glm::mix(srgb(0x5f8f96), srgb(0x9fb9a8), glm::smoothstep(0.40f, 0.53f, relief));
        vec3 ground = glm::mix(srgb(0xd2b57a), srgb(0x9c7a4a), glm::smoothstep(0.54f, 0.68f, relief));
        ground = glm::mix(ground, srgb(0x8f9a5e), glm::smoothstep(0.45f, 0.6f, fbm(p * 3.0f, 3, 7u)));
        vec3 c = glm::mix(sea, ground, land);
        const vec2 grid = glm::abs(glm::fract(s.unit * vec2(24.0f, 12.0f) + 0.5f) - 0.5f) / vec2(24.0f, 12.0f) *
                          vec2(2.0f * std::sin(e), 1.0f);
        c = glm::mix(c, srgb(0x4a3a2a), 0.5f * stroke(std::min(grid.x, grid.y), 0.0012f));
        c = glm::mix(c, srgb(0x4a3a2a), 0.55f * coast);
        return Coat{c * (0.85f + 0.25f * fbm(p * 12.0f, 3, 3u)), glm::mix(0.22f, 0.6f, land), 0.0f};
    };
}

}  // namespace studio
