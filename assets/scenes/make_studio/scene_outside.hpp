// What the parts of the world outside share.
#pragma once

#include "atlas.hpp"
#include "common.hpp"

namespace studio {

/// Texels that a chart leaves free of a texture it fills.
inline constexpr int kChartInset = kChartMargin;

/// Height of the slope below the house at (x, z), metres.
float groundHeight(const vec2& xz);
/// Height of the hills behind the lake; azimuth in radians to the right of -z, distance in metres.
float farShoreHeight(float azimuth, float distance);
/// Painted light of dusk on a surface outside, air included; display radiance.
vec3 lightOutside(const vec3& albedo, const vec3& normal, const vec3& position);
/// A radiance at a place, seen through the evening haze from the room.
vec3 throughAir(const vec3& radiance, const vec3& position);

}  // namespace studio
