// The evening sky: what is seen behind the hills and what lights the room.
#include <algorithm>
#include <cmath>

#include "scene.hpp"

namespace studio {

namespace {
// The sun stands low to the right, outside the main camera's view; it reaches the bookcase, and the desk through the
// side window.
constexpr float kSunAzimuthDegrees = 46.0f, kSunElevationDegrees = 9.0f;
// An eye adapts to the room; a display cannot. Sky light indoors is lifted by this much against the sky that is seen.
constexpr float kIndoorGain = 3.4f;
}  // namespace

vec3 toSun() {
    const float a = glm::radians(kSunAzimuthDegrees), e = glm::radians(kSunElevationDegrees);
    return {std::cos(e) * std::sin(a), std::sin(e), -std::cos(e) * std::cos(a)};
}

vec3 skyColor(const vec3& direction, bool clouds) {
    const vec3 d = glm::normalize(direction);
    const vec2 flat = glm::length(vec2(d.x, d.z)) > 1e-4f ? glm::normalize(vec2(d.x, d.z)) : vec2(0, -1);
    const vec2 sunFlat = glm::normalize(vec2(toSun().x, toSun().z));
    const float nearSun = std::pow(0.5f + 0.5f * glm::dot(flat, sunFlat), 5.0f);
    const float e = std::max(0.0f, d.y);
    const vec3 horizon = glm::mix(srgb(0xe8a894), srgb(0xffc684) * 1.05f, nearSun);
    const vec3 middle = glm::mix(srgb(0xa8a6c0), srgb(0xf0bfa0), nearSun);
    const vec3 upper = srgb(0x5f86b4), zenith = srgb(0x2c4a7c);
    vec3 c = glm::mix(horizon, middle, glm::smoothstep(0.01f, 0.13f, e));
    c = glm::mix(c, upper, glm::smoothstep(0.09f, 0.27f, e));
    c = glm::mix(c, zenith, glm::smoothstep(0.3f, 0.95f, e));
    if (clouds) {
        // A layer of cloud overhead, seen at a grazing angle near the horizon.
        const vec2 p = vec2(d.x, d.z) / (e + 0.10f);
        const float bank =
            fbm({p * vec2(0.9f, 1.5f), 1.5f}, 6, 5u) + 0.2f * (fbm({p * vec2(3.0f, 6.0f), 4.0f}, 4, 9u) - 0.5f);
        const float cover = glm::smoothstep(0.47f, 0.66f, bank) * glm::smoothstep(0.0f, 0.1f, e);
        const float lit = glm::smoothstep(0.75f, 0.5f, bank);
        const vec3 cloud = glm::mix(srgb(0x8f86a8), glm::mix(srgb(0xf3a98c), srgb(0xffcf94), nearSun), lit);
        c = glm::mix(c, cloud, 0.8f * cover);
    }
    return c;
}

Daylight makeDaylight() {
    Daylight day;
    const float outside = kNorth - kWallDepth, side = kEast + kWallDepth;
    day.portals.push_back(
        {{kWindowLeft, kWindowSill, outside}, {kWindowRight - kWindowLeft, 0, 0}, {0, kWindowTop - kWindowSill, 0}});
    day.portals.push_back({{side, kSideSill, kSideFar}, {0, 0, kSideNear - kSideFar}, {0, kSideTop - kSideSill, 0}});
    day.toSun = toSun();
    day.sunIrradiance = vec3(6.2f, 3.5f, 1.55f);
    day.sky = [](const vec3& d) {
        const vec3 ground = srgb(0x5a5a58) * 0.5f;
        return kIndoorGain * glm::mix(ground, skyColor(d, false), glm::smoothstep(-0.03f, 0.02f, d.y));
    };
    return day;
}

}  // namespace studio
