// What the fishes live among.
#include <algorithm>

#include "scene/builtin/fishes.hpp"

namespace dioptre::builtin {

namespace {

int reefPicture(Model& model, const std::string& name, const vec3& color, float cells, std::uint32_t seed) {
    return model.picture(name, 256, 256, [=](float u, float v) {
        const Cell cell = worley({u * cells, v * cells}, seed, static_cast<int>(cells));
        const float pore = glm::smoothstep(0.1f, 0.45f, cell.second - cell.nearest);
        return color * (0.55f + 0.45f * pore) * (0.8f + 0.4f * tiledNoise({u, v}, 8, seed));
    });
}

/// A branch and what grows from it.
void grow(const Detail& detail, Shape& shape, Rng& rng, const vec3& from, const vec3& direction, float length,
          float radius, int depth) {
    const vec3 side = glm::normalize(glm::cross(direction, std::abs(direction.y) < 0.9f ? kY : kX));
    const vec3 curl = 0.2f * length * (rng.next() - 0.5f) * side;
    const vec3 middle = from + 0.5f * length * direction + curl, end = from + length * direction;
    const float thin = depth == 0 ? 0.55f : 0.72f;
    const std::uint32_t seed = static_cast<std::uint32_t>(rng.next() * 1e6f);
    Shape branch = tube(
        detail, {from, middle, end},
        [=](float v) {
            return radius * glm::mix(1.0f, thin, v) * (0.94f + 0.12f * noise({v * 9.0f, 0, 0}, seed));
        },
        depth > 1 ? 32 : 24, depth > 1 ? 40 : 28);
    shape.add(branch.scaleUv({2.0f, 3.0f}));
    if (depth == 0) return;
    const int count = 2 + static_cast<int>(rng.next() * 1.6f);
    for (int k = 0; k < count; ++k) {
        const float turn = 2.0f * kPi * (toFloat(k) + 0.5f * rng.next()) / toFloat(count);
        const vec3 other = glm::cross(direction, side);
        const vec3 tilt = std::cos(turn) * side + std::sin(turn) * other;
        grow(detail, shape, rng, end - 0.3f * radius * direction, glm::normalize(direction + 0.75f * tilt + 0.15f * kY),
             length * rng.range(0.68f, 0.9f), radius * thin, depth - 1);
    }
}

}  // namespace

int addBranchCoral(Model& model, const vec3& color, std::uint32_t seed) {
    const Detail detail = model.detail;
    const int material =
        model.material("coral", vec3(1.0f), 0.7f, 0.0f, reefPicture(model, "coral", color, 20.0f, seed));
    return model.mesh("branching coral",
                      {{material, [=] {
                            Shape s;
                            Rng rng(seed);
                            for (int k = 0; k < 4; ++k) {
                                const float a = 2.0f * kPi * (toFloat(k) + 0.3f * rng.next()) / 4.0f;
                                grow(detail, s, rng, {0.06f * std::sin(a), -0.03f, 0.06f * std::cos(a)},
                                     glm::normalize(vec3(0.45f * std::sin(a), 1.0f, 0.45f * std::cos(a))), 0.3f, 0.07f,
                                     3);
                            }
                            return s;
                        }}});
}

int addBrainCoral(Model& model, const vec3& color) {
    const Detail detail = model.detail;
    const auto groove = [](const vec3& d) {
        const vec3 q =
            5.5f * d + 1.3f * vec3(fbm(3.0f * d, 3, 1), fbm(3.0f * d + 7.0f, 3, 2), fbm(3.0f * d + 13.0f, 3, 3));
        return std::sin(7.0f * fbm(q, 2, 4) * kPi);
    };
    const int image = model.picture("brain coral", 512, 512, [=](float u, float v) {
        const float a = kPi * u, e = kPi * v;
        const vec3 d(std::sin(e) * std::sin(a), std::cos(e), std::sin(e) * std::cos(a));
        return glm::mix(color * 0.45f, color, glm::smoothstep(-0.7f, 0.6f, groove(d)));
    });
    const int material = model.material("brain coral", vec3(1.0f), 0.75f, 0.0f, image);
    return model.mesh(
        "brain coral",
        {{material, [=] {
              return polar(detail.around(256), detail.along(150), [=](float u, float v) {
                  const float a = 2.0f * kPi * u, e = kPi * v;
                  vec3 d(std::sin(e) * std::sin(a), std::cos(e), std::sin(e) * std::cos(a));
                  const float r = 0.5f + 0.016f * groove({std::abs(d.x), d.y, d.z}) + 0.05f * fbm(2.0f * d, 3, 9);
                  return r * d * vec3(1.0f, 0.75f, 1.0f) + 0.12f * kY;
              });
          }}});
}

int addFanCoral(Model& model, const vec3& color, std::uint32_t seed) {
    const Detail detail = model.detail;
    const int material =
        model.material("sea fan", vec3(1.0f), 0.8f, 0.0f, reefPicture(model, "sea fan", color, 24.0f, seed));
    return model.mesh("sea fan",
                      {{material, [=] {
                            Shape s;
                            Rng rng(seed);
                            struct Twig {
                                vec2 at;
                                float angle, length, radius;
                                int depth;
                            };
                            std::vector<Twig> twigs{{{0.0f, -0.02f}, 0.0f, 0.22f, 0.026f, 6}};
                            while (!twigs.empty()) {
                                const Twig t = twigs.back();
                                twigs.pop_back();
                                const vec2 end = t.at + t.length * vec2(std::sin(t.angle), std::cos(t.angle));
                                const auto lift = [](const vec2& p) {
                                    return vec3(p, 0.10f * std::sin(3.0f * p.x + 2.0f * p.y));
                                };
                                s.add(tube(
                                    detail, {lift(t.at), lift(0.5f * (t.at + end)), lift(end)},
                                    [=](float v) { return t.radius * (1.0f - 0.25f * v); }, 16, 16));
                                if (t.depth == 0) continue;
                                for (const float side : {-1.0f, 1.0f})
                                    twigs.push_back({end, t.angle + side * rng.range(0.22f, 0.5f),
                                                     t.length * rng.range(0.7f, 0.9f), t.radius * 0.74f, t.depth - 1});
                            }
                            return s;
                        }}});
}

int addTubeSponge(Model& model, const vec3& color, std::uint32_t seed) {
    const Detail detail = model.detail;
    const int material =
        model.material("sponge", vec3(1.0f), 0.85f, 0.0f, reefPicture(model, "sponge", color, 14.0f, seed));
    return model.mesh("tube sponge",
                      {{material, [=] {
                            Shape s;
                            Rng rng(seed);
                            for (int k = 0; k < 7; ++k) {
                                const float a = 2.4f * toFloat(k), out = 0.05f + 0.03f * toFloat(k),
                                            high = rng.range(0.45f, 0.95f), wide = rng.range(0.06f, 0.09f);
                                // Outside up, over the lip, inside down
                                Shape one = lathe(detail,
                                                  {{0, -0.03f},
                                                   {0.7f * wide, -0.03f},
                                                   {wide, 0.3f * high},
                                                   {0.9f * wide, 0.7f * high},
                                                   {1.15f * wide, high},
                                                   {0.95f * wide, 1.02f * high},
                                                   {0.7f * wide, 0.95f * high},
                                                   {0.6f * wide, 0.5f * high},
                                                   {0, 0.45f * high}},
                                                  56, 110);
                                one.bend([&](const vec3& p) {
                                    const float bump = 1.0f + 0.12f * (fbm(p * 26.0f + toFloat(k), 3, seed) - 0.5f) +
                                                       0.05f * std::sin(60.0f * p.y);
                                    return vec3(p.x * bump, p.y, p.z * bump) +
                                           vec3(out * std::sin(a), 0.0f, out * std::cos(a)) * (1.0f + 1.1f * p.y);
                                });
                                s.add(one.scaleUv({2.0f, 4.0f}));
                            }
                            return s;
                        }}});
}

int addKelp(Model& model, std::uint32_t seed) {
    const Detail detail = model.detail;
    const int image = model.picture("kelp", 128, 256, [seed](float u, float v) {
        const float vein = 0.5f + 0.5f * std::sin(40.0f * v + 14.0f * u);
        return glm::mix(srgb(0x4c7a2a), srgb(0xa8b84a), 0.5f * u + 0.3f * noise({u * 9.0f, v * 30.0f, 0}, seed)) *
               (0.8f + 0.2f * vein);
    });
    const int material = model.material("kelp", vec3(1.0f), 0.5f, 0.0f, image);
    return model.mesh("kelp",
                      {{material, [=] {
                            Shape s;
                            Rng rng(seed);
                            for (int k = 0; k < 9; ++k) {
                                const float a = rng.range(0.0f, 6.28f), r = rng.range(0.02f, 0.16f),
                                            high = rng.range(0.7f, 1.5f), wave = rng.range(0.0f, 6.0f),
                                            wide = rng.range(0.03f, 0.05f);
                                const vec3 foot(r * std::sin(a), -0.02f, r * std::cos(a)),
                                    across(std::cos(a), 0.0f, -std::sin(a)), normal(std::sin(a), 0.0f, std::cos(a));
                                const auto spine = [=](float t) {
                                    return foot + high * t * kY + 0.16f * t * std::sin(wave + 4.0f * t) * across +
                                           0.1f * t * std::cos(wave + 3.0f * t) * normal;
                                };
                                const auto half = [=](float t) {
                                    return wide * std::pow(std::sin(kPi * glm::mix(0.06f, 0.985f, t)), 0.5f);
                                };
                                Fin blade;
                                blade.root = [=](float t) {
                                    return spine(t) - half(t) * across + 0.02f * std::sin(30.0f * t) * normal;
                                };
                                blade.rim = [=](float t) {
                                    return spine(t) + half(t) * across + 0.02f * std::sin(30.0f * t + 2.0f) * normal;
                                };
                                blade.side = [=](float, float) { return 0.004f * normal; };
                                s.add(fin(detail.around(24), detail.along(120), blade));
                            }
                            return s;
                        }}});
}

int addAnemone(Model& model, const vec3& color, std::uint32_t seed) {
    const Detail detail = model.detail;
    const int image = model.picture("anemone", 64, 256, [color](float, float v) {
        return glm::mix(color, srgb(0xf6f0c8), glm::smoothstep(0.75f, 0.95f, v)) * (0.7f + 0.3f * v);
    });
    const int material = model.material("anemone", vec3(1.0f), 0.45f, 0.0f, image);
    return model.mesh(
        "anemone", {{material, [=] {
                         Shape s = lathe(
                             detail, {{0, -0.02f}, {0.2f, -0.02f}, {0.26f, 0.08f}, {0.22f, 0.16f}, {0, 0.17f}}, 48, 32);
                         Rng rng(seed);
                         for (int k = 0; k < 90; ++k) {
                             const float a = 2.39996f * toFloat(k), r = 0.25f * std::sqrt((toFloat(k) + 0.5f) / 90.0f),
                                         turn = rng.range(-0.5f, 0.5f);
                             const vec3 root(r * std::sin(a), 0.14f, r * std::cos(a)),
                                 out(std::sin(a + turn), 0.0f, std::cos(a + turn));
                             const float length = rng.range(0.2f, 0.34f);
                             s.add(tube(
                                 detail,
                                 {root, root + length * (0.6f * kY + (0.2f + r) * out),
                                  root + length * ((0.9f - 1.2f * r) * kY + (0.4f + 2.6f * r) * out)},
                                 [](float v) { return 0.017f * (v > 0.85f ? 1.25f : 1.0f - 0.3f * v); }, 16, 20));
                         }
                         return s;
                     }}});
}

int addBoulder(Model& model, std::uint32_t seed) {
    const Detail detail = model.detail;
    const int image = model.picture("boulder", 512, 512, [seed](float u, float v) {
        const float a = kPi * u, e = kPi * v;
        const vec3 d(std::sin(e) * std::sin(a), std::cos(e), std::sin(e) * std::cos(a));
        const vec3 algae = glm::mix(srgb(0x9a6a8a), srgb(0x6a8a5a), fbm(4.0f * d, 4, seed + 5));
        return glm::mix(rock(1.3f * d + toFloat(static_cast<int>(seed))), algae,
                        0.55f * glm::smoothstep(0.45f, 0.6f, fbm(3.0f * d, 4, seed)));
    });
    const int material = model.material("boulder", vec3(1.0f), 0.9f, 0.0f, image);
    return model.mesh("boulder",
                      {{material, [=] {
                            return polar(detail.around(160), detail.along(90), [=](float u, float v) {
                                const float a = 2.0f * kPi * u, e = kPi * v;
                                const vec3 d(std::sin(e) * std::sin(a), std::cos(e), std::sin(e) * std::cos(a));
                                const float ridge =
                                    std::abs(2.0f * fbm(2.2f * d + toFloat(static_cast<int>(seed)), 5, seed) - 1.0f);
                                return (0.42f + 0.35f * fbm(1.6f * d, 2, seed + 1) - 0.25f * ridge +
                                        0.03f * fbm(14.0f * d, 3, seed + 2)) *
                                           d * vec3(1.1f, 0.8f, 1.0f) +
                                       0.15f * kY;
                            });
                        }}});
}

int addStarfish(Model& model, const vec3& color) {
    const Detail detail = model.detail;
    const int image = model.picture("starfish", 256, 256, [color](float u, float v) {
        const Cell dots = worley({u * 18.0f, v * 14.0f}, 3);
        return glm::mix(color, srgb(0xf8e0b0), 0.8f * spot(dots.nearest, 0.2f, 0.05f));
    });
    const int material = model.material("starfish", vec3(1.0f), 0.6f, 0.0f, image);
    return model.mesh(
        "starfish",
        {{material, [=] {
              return polar(detail.around(240), detail.along(80), [](float u, float v) {
                  const float a = 2.0f * kPi * u, arm = std::pow(0.5f + 0.5f * std::cos(5.0f * a), 1.6f);
                  const float e = kPi * v, reach = 0.2f + 0.8f * arm;
                  const float r = std::sin(e) * reach;
                  const float bump = 0.012f * std::sin(70.0f * r) * std::sin(25.0f * a);
                  return vec3(r * std::sin(a),
                              0.05f +
                                  std::cos(e) * (0.05f + 0.13f * (1.0f - std::sin(e)) * 0.6f) * (0.5f + 0.5f * arm) +
                                  (v < 0.5f ? bump * std::sin(e) : 0.0f),
                              r * std::cos(a));
              });
          }}});
}

int addBubbles(Model& model, std::uint32_t seed) {
    const Detail detail = model.detail;
    const int material = model.material("bubbles", vec3(0.75f, 0.9f, 1.0f), 0.03f);
    model.materialAt(material).emissive = {0.05f, 0.1f, 0.12f};
    return model.mesh("bubbles", {{material, [=] {
                                       Shape s;
                                       Rng rng(seed);
                                       for (int k = 0; k < 16; ++k) {
                                           const float y = 0.1f * toFloat(k) + 0.05f * rng.next(),
                                                       r = rng.range(0.006f, 0.018f) * (0.6f + 0.05f * toFloat(k));
                                           s.add(ball(detail,
                                                      {0.06f * std::sin(3.0f * y) + rng.range(-0.04f, 0.04f), y,
                                                       rng.range(-0.05f, 0.05f)},
                                                      {r, 0.85f * r, r}, 32));
                                       }
                                       return s;
                                   }}});
}

}  // namespace dioptre::builtin
