// Where each patch's picture lies in its object's texture.
#pragma once

#include "model.hpp"

namespace studio {

/// Free texels kept around every chart, so that four mip levels do not mix neighbours.
inline constexpr int kChartMargin = 4;

/// Gives every patch its chart, with the largest common texel density that fits the object's texture.
/// Throws std::runtime_error with the object's name if not even tiny charts fit.
void packCharts(Object& object);

/// Texture coordinate of a place in the patch's unit square: the chart's outer texel centres are the square's edges.
vec2 textureCoordinate(const Object& object, const Patch& patch, const vec2& unit);

/// Position, normal and metres at a place in the patch's unit square.
SurfacePoint surfacePoint(const Patch& patch, const vec2& unit);

}  // namespace studio
