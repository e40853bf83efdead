// Soft light for a viewer that has neither shadows nor environment light: irradiance on a grid over every patch.
// Sky light comes through the window as an area light with the sky's radiance; lamps are picked in proportion to what
// they could give; two bounces are gathered from the grids themselves, as in progressive radiosity, so that nothing
// is traced twice. All of it is seeded by grid point.
#pragma once

#include <vector>

#include "model.hpp"

namespace studio {

struct BakeQuality {
    int windowRays = 42, lampRays = 24, sunRays = 12, gatherRays = 100, glossRays = 72, bounces = 3;
};

/// Light on one patch, on a grid that includes the edges of the unit square.
struct LightGrid {
    int width = 0, height = 0;
    std::vector<vec3> irradiance;  // all of it
    std::vector<vec3> unexported;  // lit objects: without what the viewer's own lights give
    std::vector<vec3> gloss;       // mirrored radiance towards the main camera
};

/// Bilinear look-up in a grid of `width` by `height` at a place of the unit square; 0 for an empty one.
vec3 lookUp(const LightGrid& grid, const std::vector<vec3>& values, const vec2& unit);

struct BakedLight {
    std::vector<std::vector<LightGrid>> grids;  // per object, per patch; empty for patches that share a chart
    const LightGrid& of(const Model& model, int object, int patch) const;
};

/// Charts must be packed. Only indoor objects (baked, lit) take part.
BakedLight bakeLight(const Model& model, const BakeQuality& quality);

}  // namespace studio
