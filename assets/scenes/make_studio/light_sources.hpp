// What shines into and in the room, sampled with shadow rays: windows as area lights, the sun, small lamps.
#pragma once

#include "bake.hpp"
#include "bvh.hpp"

namespace studio {

inline constexpr float kOffset = 1.5e-3f;  // metres a ray starts above its surface

/// Irradiance at a point (already lifted off its surface) with a unit normal.
struct LightSources {
    const Model& model;
    const Bvh& bvh;
    BakeQuality quality;

    vec3 skyThroughWindows(const vec3& p, const vec3& n, Rng& rng) const;
    vec3 sunlight(const vec3& p, const vec3& n, Rng& rng) const;
    /// `onlyUnexported`: leaves out the lamps that the viewer shades by itself.
    vec3 lamplight(const vec3& p, const vec3& n, Rng& rng, bool onlyUnexported) const;
    /// Whether a ray from inside points at a window's opening; what may stand in between is not asked.
    bool leavesByWindow(const vec3& origin, const vec3& direction) const;
};

}  // namespace studio
