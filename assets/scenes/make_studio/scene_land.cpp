// The world outside, at its real distance: sky at 12 km, mountains at 7 km, ridges, a lake, the slope below the house.
// Its light is simple and painted: the low sun, the sky, and haze that grows with distance.
#include <algorithm>
#include <cmath>

#include "paints.hpp"
#include "scene.hpp"
#include "scene_outside.hpp"
#include "shapes.hpp"

namespace studio {

namespace {

constexpr float kLakeLevel = -36.0f;     // metres below the room's floor
constexpr float kHazeLength = 14000.0f;  // metres after which 63 % of what is seen is air

/// Ridged noise over the ground in kilometres: sharp crests, round valleys.
float crests(const vec2& kilometres, int octaves, std::uint32_t seed) {
    float sum = 0.0f, weight = 0.55f, total = 0.0f;
    vec2 q = kilometres;
    for (int k = 0; k < octaves; ++k) {
        const float n = 1.0f - std::abs(2.0f * noise({q, 0.5f}, seed + static_cast<std::uint32_t>(k)) - 1.0f);
        sum += weight * n * n;
        total += weight;
        weight *= 0.5f;
        q = vec2(0.8f * q.x - 0.6f * q.y, 0.6f * q.x + 0.8f * q.y) * 2.1f + 7.3f;
    }
    return sum / total;
}

float ridge(float azimuth, float scale, int octaves, std::uint32_t seed) {
    const float n = fbm({azimuth * scale, 0.5f, 0.5f}, octaves, seed);
    return 1.0f - std::abs(2.0f * n - 1.0f);
}

/// A strip of land between two distances; height as a function of azimuth (radians, right of -z) and distance.
Patch strip(float nearMetres, float farMetres, int columns, int rows,
            const std::function<float(float, float)>& height) {
    // Most columns and texels go to what the big window shows; the rest is seen by the side window or not at all.
    const auto azimuthAt = [](float u) {
        const float degrees = u < 0.1f    ? glm::mix(-62.0f, -27.0f, u / 0.1f)
                              : u < 0.82f ? glm::mix(-27.0f, 35.0f, (u - 0.1f) / 0.72f)
                                          : glm::mix(35.0f, 142.0f, (u - 0.82f) / 0.18f);
        return glm::radians(degrees);
    };
    Patch p = surface(columns, rows, [=](float u, float v) {
        const float azimuth = azimuthAt(u), distance = farMetres * std::pow(nearMetres / farMetres, v);
        return vec3(distance * std::sin(azimuth), height(azimuth, distance), -distance * std::cos(azimuth));
    });
    // The chart follows the grid, not the metres: distance is foreshortened.
    for (int i = 0; i < columns; ++i)
        p.across[static_cast<std::size_t>(i)] = static_cast<float>(i) / static_cast<float>(columns - 1);
    for (int j = 0; j < rows; ++j)
        p.down[static_cast<std::size_t>(j)] = static_cast<float>(j) / static_cast<float>(rows - 1);
    return p;
}

/// One strip fills its object's texture.
void addStrip(Model& model, const std::string& name, int width, int height, Patch patch, const Paint& paint) {
    Object& land = model.add(name, Finish::painted, width, height);
    land.jpegQuality = 84;
    patch.size = {static_cast<float>(width - kChartInset), static_cast<float>(height - kChartInset)};
    land.add(std::move(patch), paint);
}

Paint landPaint(const vec3& meadow, const vec3& forest, float forestScale, float snowLine) {
    return [=](const SurfacePoint& s) {
        const vec3& p = s.position;
        const float woods = fbm(p * forestScale, 5, 3u);
        vec3 albedo = glm::mix(forest, meadow, glm::smoothstep(0.50f, 0.62f, woods));
        albedo *= 0.7f + 0.6f * fbm(p * forestScale * 9.0f, 3, 8u);
        // Relief finer than the mesh: what rises towards the sun is lighter.
        const float relief = fbm(p * forestScale * 3.0f, 5, 29u) -
                             fbm((p + toSun() * (0.12f / forestScale)) * forestScale * 3.0f, 5, 29u);
        const float snow = glm::smoothstep(snowLine, snowLine + 90.0f,
                                           p.y + 500.0f * (fbm(p * 0.0045f, 5, 17u) - 0.5f) + 1100.0f * relief);
        albedo = glm::mix(albedo, vec3(0.85f), snow) * glm::clamp(1.0f + 3.2f * relief, 0.35f, 1.8f);
        return Coat{lightOutside(albedo, s.normal, p)};
    };
}

}  // namespace

float farShoreHeight(float azimuth, float distance) {
    const float peak = 0.12f + 0.88f * ridge(azimuth + 0.35f, 2.1f, 5, 80u);
    const float roll = 0.85f + 0.3f * fbm({azimuth * 26.0f, distance * 0.008f, 0.0f}, 3);
    return kLakeLevel - 1.0f + 150.0f * peak * glm::smoothstep(1480.0f, 2250.0f, distance) * roll;
}

float groundHeight(const vec2& p) {
    const float distance = glm::length(p), azimuth = std::atan2(p.x, -p.y);
    const float fall = -3.2f - 33.5f * glm::smoothstep(10.0f, 380.0f, distance) -
                       6.0f * glm::smoothstep(300.0f, 520.0f + 110.0f * fbm({azimuth * 3.0f, 1, 1}, 3), distance);
    const float roll = 3.2f * (fbm({p * 0.022f, 2.0f}, 4, 21u) - 0.5f) * glm::smoothstep(10.0f, 60.0f, distance);
    return fall + roll;
}

vec3 lightOutside(const vec3& albedo, const vec3& normal, const vec3& position) {
    const vec3 sun = vec3(3.9f, 1.9f, 1.15f), sky = vec3(0.30f, 0.40f, 0.66f);
    // The valley already lies in the mountains' shadow; only heights see the sun.
    const float lit = glm::smoothstep(230.0f, 720.0f, position.y);
    const vec3 light = sun * (lit * (0.25f + 0.75f * std::max(0.0f, glm::dot(normal, toSun())))) +
                       sky * (0.55f + 0.45f * normal.y) * glm::mix(0.62f, 1.0f, lit);
    return throughAir(albedo * light / kPi * 1.25f, position);
}

vec3 throughAir(const vec3& radiance, const vec3& position) {
    const float distance = glm::length(position), low = std::exp(-std::max(0.0f, position.y - kLakeLevel) / 420.0f);
    const float air = 1.0f - std::exp(-distance / kHazeLength * (0.35f + 1.0f * low));
    const vec3 glow = skyColor(vec3(position.x, 0.02f * distance, position.z), false);
    return glm::mix(radiance, glm::mix(vec3(0.20f, 0.27f, 0.46f), glow, 0.10f + 0.38f * air), air);
}

void addLand(Model& model) {
    Object& sky = model.add("sky", Finish::painted, 1024, 512);
    sky.jpegQuality = 90;
    Patch dome = surface(33, 13, [](float u, float v) {
        const float azimuth = glm::radians(-95.0f + 245.0f * u),
                    elevation = glm::radians(62.0f * std::pow(1.0f - v, 1.5f) - 2.5f);
        return kSkyRadius * vec3(std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                                 -std::cos(elevation) * std::cos(azimuth));
    });
    for (int j = 0; j < dome.rows; ++j)
        dome.down[static_cast<std::size_t>(j)] = static_cast<float>(j) / static_cast<float>(dome.rows - 1);
    dome.size = {2.0f, 1.0f};
    sky.add(std::move(dome), [](const SurfacePoint& s) {
        // Half a step of noise hides the 8-bit steps of so smooth a gradient.
        const float dither = (noise(vec3(s.unit * 4096.0f, 1.0f)) - 0.5f) * 0.006f;
        return Coat{skyColor(s.position, true) * (1.0f + dither)};
    });

    addStrip(
        model, "mountains", 2048, 256,
        strip(6200.0f, 7900.0f, 150, 15,
              [](float a, float d) {
                  const float peak = 0.18f + 0.82f * crests(vec2(d * std::sin(a), -d * std::cos(a)) / 1250.0f, 5, 44u);
                  const float massif = 0.62f + 0.38f * std::sin(a * 4.1f + 1.2f);
                  const float rise = glm::smoothstep(6200.0f, 7400.0f, d) - 0.4f * glm::smoothstep(7400.0f, 7900.0f, d);
                  return kLakeLevel + 1650.0f * peak * massif * rise;
              }),
        landPaint(srgb(0x6a6a72), srgb(0x484c5a), 0.0030f, 560.0f));
    addStrip(model, "far ridge", 512, 128,
             strip(3000.0f, 4100.0f, 110, 7,
                   [](float a, float d) {
                       const float peak = 0.25f + 0.75f * ridge(a, 2.7f, 5, 60u);
                       return kLakeLevel + 385.0f * peak * glm::smoothstep(2950.0f, 3900.0f, d) *
                                               (0.9f + 0.2f * fbm({a * 20.0f, d * 0.004f, 0.0f}, 3));
                   }),
             landPaint(srgb(0x7f8a58), srgb(0x2f4638), 0.004f, 4000.0f));
    addStrip(model, "near ridge", 512, 128, strip(1500.0f, 2300.0f, 110, 7, farShoreHeight),
             landPaint(srgb(0x8a9660), srgb(0x2a4234), 0.009f, 4000.0f));
    addStrip(model, "lake", 512, 128, strip(420.0f, 1650.0f, 40, 6, [](float, float) { return kLakeLevel; }),
             [](const SurfacePoint& s) {
                 // The lake mirrors the low sky, broken by long ripples.
                 const vec3 p = s.position;
                 const float distance = glm::length(p);
                 const float ripple = fbm({p.x * 0.012f, std::log(distance) * 60.0f, 1.0f}, 4) - 0.5f;
                 const vec3 mirrored = skyColor(vec3(p.x, (0.16f + 0.30f * ripple) * distance, p.z), false);
                 // The far hills' image lies along the far shore.
                 const float hills = glm::smoothstep(850.0f, 1500.0f, distance + 260.0f * ripple);
                 return Coat{throughAir(mirrored * (0.92f + 0.5f * ripple) * (1.0f - 0.62f * hills), p)};
             });
    addStrip(model, "slope", 512, 512,
             strip(9.0f, 560.0f, 70, 30,
                   [](float a, float d) {
                       return groundHeight({d * std::sin(a), -d * std::cos(a)});
                   }),
             [](const SurfacePoint& s) {
                 const vec3& p = s.position;
                 const float woods = fbm(p * 0.03f, 4, 3u);
                 vec3 albedo = glm::mix(srgb(0x2f4a34), srgb(0x7a8a4e), glm::smoothstep(0.42f, 0.6f, woods));
                 albedo *= 0.55f + 0.9f * fbm(vec3(s.unit * vec2(170.0f, 110.0f), 1.0f), 4, 8u);
                 // The house's own windows shine on the grass below.
                 const vec3 glow =
                     vec3(0.34f, 0.20f, 0.08f) * albedo * (1.0f - glm::smoothstep(8.0f, 34.0f, glm::length(p)));
                 return Coat{1.35f * lightOutside(albedo, s.normal, p) + 2.0f * glow};
             });
}

}  // namespace studio
