// Light sampling of light_sources.hpp.
#include "light_sources.hpp"

#include <algorithm>
#include <cmath>

namespace studio {

namespace {

constexpr float kSunRadius = 0.011f;  // radians; twice the real sun's, for softer mullion shadows

std::size_t size(int i) {
    return static_cast<std::size_t>(i);
}

}  // namespace

vec3 LightSources::skyThroughWindows(const vec3& p, const vec3& n, Rng& rng) const {
    vec3 sum(0.0f);
    // Stratified over each opening: columns of a square-ish grid.
    const int across = std::max(1, static_cast<int>(std::sqrt(static_cast<float>(quality.windowRays) * 1.4f)));
    const int up = std::max(1, quality.windowRays / across);
    for (const Portal& portal : model.daylight.portals) {
        const vec3 inwards = portal.inwards();
        const float area = glm::length(glm::cross(portal.right, portal.up));
        if (glm::dot(p - portal.corner, inwards) <= 0.0f) continue;
        for (int k = 0; k < across * up; ++k) {
            const float u = (static_cast<float>(k % across) + rng.next()) / static_cast<float>(across);
            const float v = (static_cast<float>(k / across) + rng.next()) / static_cast<float>(up);
            const vec3 to = portal.corner + u * portal.right + v * portal.up - p;
            const float distance = glm::length(to);
            const vec3 direction = to / distance;
            const float cosine = glm::dot(n, direction), facing = -glm::dot(inwards, direction);
            if (cosine <= 0.0f || facing <= 0.0f) continue;
            if (bvh.blocked({p, direction, distance - kOffset})) continue;
            sum += model.daylight.sky(direction) * (cosine * facing * area / (distance * distance));
        }
    }
    return sum / static_cast<float>(across * up);
}

vec3 LightSources::sunlight(const vec3& p, const vec3& n, Rng& rng) const {
    const Daylight& day = model.daylight;
    if (glm::dot(n, day.toSun) <= 0.0f || !leavesByWindow(p, day.toSun)) return vec3(0.0f);
    const glm::mat3 frame = frameAround(day.toSun);
    float sum = 0.0f;
    for (int k = 0; k < quality.sunRays; ++k) {
        const float r = kSunRadius * std::sqrt(rng.next()), a = 2.0f * kPi * rng.next();
        const vec3 direction = glm::normalize(frame * vec3(r * std::cos(a), r * std::sin(a), 1.0f));
        const float cosine = glm::dot(n, direction);
        if (cosine > 0.0f && !bvh.blocked({p, direction, 40.0f})) sum += cosine;
    }
    return day.sunIrradiance * (sum / static_cast<float>(quality.sunRays));
}

vec3 LightSources::lamplight(const vec3& p, const vec3& n, Rng& rng, bool onlyUnexported) const {
    // Choose lamps in proportion to their unshadowed light here: only visibility is left to chance.
    float cumulative[128];
    const int count = std::min(static_cast<int>(model.lamps.size()), 128);
    float total = 0.0f;
    const auto unshadowed = [&](const Lamp& lamp, const vec3& at) {
        const vec3 to = at - p;
        const float d2 = std::max(glm::dot(to, to), lamp.radius * lamp.radius);
        return std::max(0.0f, glm::dot(n, to)) / (d2 * std::sqrt(d2));
    };
    for (int k = 0; k < count; ++k) {
        const Lamp& lamp = model.lamps[size(k)];
        // A lamp just below the horizon can still show its upper half.
        const float share = onlyUnexported && lamp.exported ? 0.0f : unshadowed(lamp, lamp.position + n * lamp.radius);
        total += share * luminance(lamp.intensity);
        cumulative[k] = total;
    }
    if (total <= 0.0f) return vec3(0.0f);
    vec3 sum(0.0f);
    for (int s = 0; s < quality.lampRays; ++s) {
        const float pick = (static_cast<float>(s) + rng.next()) / static_cast<float>(quality.lampRays) * total;
        const int k =
            std::min(static_cast<int>(std::upper_bound(cumulative, cumulative + count, pick) - cumulative), count - 1);
        const float probability = (cumulative[k] - (k > 0 ? cumulative[k - 1] : 0.0f)) / total;
        const Lamp& lamp = model.lamps[size(k)];
        const float z = rng.range(-1.0f, 1.0f), a = 2.0f * kPi * rng.next(), r = std::sqrt(1.0f - z * z);
        const vec3 at = lamp.position + lamp.radius * vec3(r * std::cos(a), r * std::sin(a), z);
        const float arriving = unshadowed(lamp, at);
        if (arriving <= 0.0f || probability <= 0.0f || bvh.blocked({p, at - p, 0.999f})) continue;
        sum += lamp.intensity * (arriving / probability);
    }
    return sum / static_cast<float>(quality.lampRays);
}

bool LightSources::leavesByWindow(const vec3& origin, const vec3& direction) const {
    for (const Portal& portal : model.daylight.portals) {
        const vec3 inwards = portal.inwards();
        const float along = glm::dot(direction, inwards);
        if (along >= 0.0f) continue;
        const float t = glm::dot(portal.corner - origin, inwards) / along;
        const vec3 in = origin + t * direction - portal.corner;
        const float u = glm::dot(in, portal.right) / glm::dot(portal.right, portal.right);
        const float v = glm::dot(in, portal.up) / glm::dot(portal.up, portal.up);
        if (t > 0.0f && u >= 0.0f && u <= 1.0f && v >= 0.0f && v <= 1.0f) return true;
    }
    return false;
}

}  // namespace studio
