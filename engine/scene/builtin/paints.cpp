#include "scene/builtin/paints.hpp"

#include <algorithm>
#include <map>
#include <memory>

namespace dioptre::builtin {

Paint mottled(int cells, float depth, std::uint32_t seed) {
    return [=](float u, float v) {
        float sum = 0.0f, weight = 0.5f;
        for (int octave = 0; octave < 5; ++octave, weight *= 0.5f)
            sum += weight * tiledNoise({u, v}, cells << octave, seed + static_cast<std::uint32_t>(octave));
        return vec3(1.0f - depth * sum);
    };
}

Paint woodGrain(std::uint32_t seed) {
    return [=](float u, float v) {
        const float waver = tiledNoise({u, v}, 4, seed) + 0.4f * tiledNoise({u, v}, 9, seed + 1);
        const float rings = 0.5f + 0.5f * std::sin(2.0f * kPi * (6.0f * u + 1.3f * waver));
        const float fine =
            tiledNoise({u, v * 0.25f}, 64, seed + 2) * tiledNoise({u, fraction(v * 0.5f)}, 160, seed + 3);
        const vec3 dark(0.55f, 0.47f, 0.40f);
        return glm::mix(vec3(1.0f), dark, 0.55f * rings * rings + 0.45f * fine);
    };
}

Paint felt(std::uint32_t seed) {
    return [=](float u, float v) {
        const float soft = tiledNoise({u, v}, 12, seed), fine = tiledNoise({u, v}, 220, seed + 1);
        const float hair = tiledNoise({u, v}, 90, seed + 2);
        return vec3(0.72f + 0.28f * (0.3f * soft + 0.35f * fine + 0.35f * hair));
    };
}

Paint brushed(std::uint32_t seed) {
    return [=](float u, float v) {
        return vec3(0.8f + 0.2f * tiledNoise({u * 0.02f, v}, 250, seed) - 0.1f * tiledNoise({u, v}, 6, seed + 1));
    };
}

vec3 floorBoard(const vec2& xz) {
    constexpr float kWidth = 0.11f, kLength = 1.4f;
    const float column = std::floor(xz.x / kWidth);
    const std::uint32_t seed = hash(static_cast<std::uint32_t>(static_cast<int>(column)));
    const float along = xz.y / kLength + unitFloat(seed), row = std::floor(along);
    const std::uint32_t board = hash(seed + static_cast<std::uint32_t>(static_cast<int>(row)));
    const float shift = 40.0f * unitFloat(board);
    const float grain = fbm({xz.x * 38.0f + shift, xz.y * 2.2f, shift}, 3, 3);
    const float rings = 0.5f + 0.5f * std::sin(26.0f * (grain + xz.x * 3.0f));
    const float fine = noise({xz.x * 700.0f, xz.y * 14.0f, shift}, 4);
    vec3 color = glm::mix(srgb(0xc89a62), srgb(0x8d5d33), 0.45f * rings + 0.25f * fine);
    color *= 0.82f + 0.3f * unitFloat(hash(board + 7u));
    const float gapX = kWidth * std::abs(fraction(xz.x / kWidth) - 0.5f) * 2.0f,
                gapZ = kLength * std::abs(fraction(along) - 0.5f) * 2.0f;
    const float gap = std::max(glm::smoothstep(kWidth - 0.006f, kWidth - 0.001f, gapX),
                               glm::smoothstep(kLength - 0.006f, kLength - 0.001f, gapZ));
    return color * (1.0f - 0.65f * gap);
}

vec3 rock(const vec3& p) {
    const float large = fbm(p * 1.7f, 5, 11), fine = fbm(p * 19.0f, 3, 12);
    const float band = 0.5f + 0.5f * std::sin(14.0f * (p.y + 0.5f * large));
    vec3 color = glm::mix(srgb(0x6f675e), srgb(0xa79b8a), large);
    color = glm::mix(color, srgb(0x5b4f45), 0.35f * band * fine);
    const float moss = glm::smoothstep(0.52f, 0.68f, fbm(p * 2.6f + 9.0f, 4, 13));
    color = glm::mix(color, srgb(0x5f6b35), 0.6f * moss);
    return color * (0.65f + 0.6f * fine);
}

float strokeDistance(const vec2& p, const std::vector<vec2>& line) {
    float nearest = 1e9f;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const vec2 ab = line[i + 1] - line[i];
        const float t = saturate(glm::dot(p - line[i], ab) / glm::dot(ab, ab));
        nearest = std::min(nearest, glm::distance(p, line[i] + t * ab));
    }
    return nearest;
}

float letterDistance(char letter, const vec2& p) {
    using Strokes = std::vector<std::vector<vec2>>;
    static const std::map<char, Strokes> kLetters{
        {'A', {{{0.2f, 0.85f}, {0.5f, 0.15f}, {0.8f, 0.85f}}, {{0.31f, 0.6f}, {0.69f, 0.6f}}}},
        {'B',
         {{{0.28f, 0.85f}, {0.28f, 0.15f}, {0.58f, 0.15f}, {0.7f, 0.22f}, {0.7f, 0.4f}, {0.58f, 0.48f}, {0.28f, 0.48f}},
          {{0.58f, 0.48f}, {0.74f, 0.57f}, {0.74f, 0.76f}, {0.6f, 0.85f}, {0.28f, 0.85f}}}},
        {'C',
         {{{0.76f, 0.27f},
           {0.62f, 0.16f},
           {0.45f, 0.16f},
           {0.3f, 0.28f},
           {0.25f, 0.5f},
           {0.3f, 0.72f},
           {0.45f, 0.84f},
           {0.62f, 0.84f},
           {0.76f, 0.73f}}}},
        {'D',
         {{{0.28f, 0.15f},
           {0.5f, 0.15f},
           {0.68f, 0.26f},
           {0.75f, 0.5f},
           {0.68f, 0.74f},
           {0.5f, 0.85f},
           {0.28f, 0.85f},
           {0.28f, 0.15f}}}},
        {'E', {{{0.73f, 0.15f}, {0.3f, 0.15f}, {0.3f, 0.85f}, {0.73f, 0.85f}}, {{0.3f, 0.49f}, {0.64f, 0.49f}}}},
        {'F', {{{0.73f, 0.15f}, {0.3f, 0.15f}, {0.3f, 0.85f}}, {{0.3f, 0.49f}, {0.64f, 0.49f}}}}};
    float nearest = 1e9f;
    for (const auto& stroke : kLetters.at(letter)) nearest = std::min(nearest, strokeDistance(p, stroke));
    return nearest;
}

int addGround(Model& model, const std::string& name, const Ground& ground, const vec3& toLight, float roughness,
              float shadow, const std::function<vec3(const vec2&)>& color) {
    const vec2 size = ground.high - ground.low;
    const float texel = std::max(size.x, size.y) / toFloat(ground.side), shadowTexel = texel / model.pictureScale();
    const int width = static_cast<int>(size.x / texel), height = static_cast<int>(size.y / texel);
    const int image = model.latePicture(name, width, height, [=, &model](const Scene& scene) -> Paint {
        const auto light =
            std::make_shared<FloorShadow>(scene, model.casts(), toLight, ground.low, ground.high, shadowTexel);
        return [=](float u, float v) {
            const vec2 xz = ground.low + vec2(u, v) * size;
            const vec2 lit = light->at(xz);
            return color(xz) * (1.0f - shadow * (1.0f - lit.x)) * (1.0f - 0.5f * lit.y);
        };
    });
    const int material = model.material(name, vec3(1.0f), roughness, 0.0f, image);
    const int columns = model.detail.along(48), rows = model.detail.along(48);
    const auto shape = [=] {
        return sheet(columns, rows, [=](float u, float v) {
            const vec2 xz = ground.low + vec2(u, v) * size;
            return vec3(xz.x, 0.0f, xz.y);
        });
    };
    return model.mesh(name, {{material, shape}});
}

}  // namespace dioptre::builtin
