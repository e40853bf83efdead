// Shapes as patches. Every shape is built around its own origin, y up; `place` puts it into the world.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "model.hpp"

namespace studio {

/// A grid over (u, v) in [0, 1]^2; the outside is where u runs right and v runs down. `closed`: periodic in u.
Patch surface(int columns, int rows, const std::function<vec3(float u, float v)>& point, bool closed = false);

/// A flat rectangle from its top left corner.
Patch rectangle(const vec3& topLeft, const vec3& right, const vec3& down, int columns = 2, int rows = 2);

/// A box between two corners with sharp edges; `bottom` false leaves the face away that nobody sees.
Patches box(const vec3& low, const vec3& high, bool bottom = true);

/// A box with rounded edges; `steps` quads along each face. `bulge` inflates the faces' middles by metres (cushions).
Patches roundedBox(const vec3& low, const vec3& high, float radius, int steps = 5, float bulge = 0.0f);

/// A profile of (radius, height) from top to bottom turned about y, one smooth surface through the points.
Patch lathe(const std::vector<vec2>& profile, int segments, int rings);

/// A closed disc facing up (or down), radius in metres.
Patch disc(float radius, float height, int segments, bool facingUp = true);

Patch ball(float radius, int segments, int rings);

/// A tube along a smooth curve through `path`; radius as a function of the way along, 0 to 1.
Patch tube(const std::vector<vec3>& path, const std::function<float(float)>& radius, int sides, int rings);
Patch tube(const std::vector<vec3>& path, float radius, int sides, int rings);

/// A ring in the xz plane. `arc` 1: the whole circle.
Patch torus(float ringRadius, float tubeRadius, int segments, int sides, float arc = 1.0f);

/// A leaf from the origin along +z, upper side +y: pointed ellipse with a folded midrib, drooping by `droop` at its
/// tip.
Patch leaf(float length, float width, float fold, float droop, int columns = 3, int rows = 6);

/// A small eight-faced bead as a patch of 8 triangles (a coarse ball), for distant lamps.
Patch bead(const vec3& centre, float radius);

/// Point on the Catmull-Rom curve through `points` at t in [0, 1].
vec3 curvePoint(const std::vector<vec3>& points, float t);
vec2 curvePoint(const std::vector<vec2>& points, float t);

Patch place(Patch patch, const mat4& worldFromShape);
Patches place(Patches patches, const mat4& worldFromShape);
/// Everything that is given, in one list.
Patches join(std::initializer_list<Patches> parts);

}  // namespace studio
