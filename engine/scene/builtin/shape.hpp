// Triangle shapes as the built-in scenes are made of: closed where sensible, no vertex with more than 16 neighbours, no
// sliver at a pole. Every shape is built around its own origin, y up; `move` puts it where it belongs.
#pragma once

#include "scene/builtin/common.hpp"
#include "scene/scene.hpp"

namespace dioptre::builtin {

struct Shape {
    std::vector<vec3> position;
    std::vector<vec2> uv;  // u right, v down in the picture
    std::vector<std::uint32_t> index;
    bool seams = false;  // vertices at one place that differ in uv alone: they share a normal

    Shape& add(const Shape& other);
    Shape& move(const mat4& m);
    Shape& scaleUv(const vec2& factor);
    /// Moves every vertex by a function of where it is.
    Shape& bend(const std::function<vec3(const vec3&)>& to);
};

/// Triangles without area left out, normals from the faces around a vertex.
Primitive toPrimitive(const Shape& shape, int material);

using Surface = std::function<vec3(float u, float v)>;

/// How finely to build: 1 for the scenes as they are, less for quick tests.
struct Detail {
    float scale = 1.0f;
    int around(int count) const;  // a multiple of 8
    int along(int count) const;
};

/// A closed surface over u in [0, 1), periodic, and v in [0, 1] with a pole at each end. Near a pole the grid is a
/// square drawn onto a disc, so that no vertex there has more than 6 neighbours. uv = (1 - |1 - 2u|, v): mirrored, no
/// seam.
Shape polar(int around, int along, const Surface& point);
/// Periodic in both: uv mirrored in both.
Shape loop(int around, int along, const Surface& point);
/// An open grid over the unit square; columns and rows of quads.
Shape sheet(int columns, int rows, const Surface& point);

Shape ball(const Detail& detail, const vec3& centre, const vec3& radii, int around = 32);
/// A profile of (radius, height) turned about y, from the axis to the axis; `rounding` times its corners are cut.
Shape lathe(const Detail& detail, std::vector<vec2> profile, int around, int along, int rounding = 3);
/// A ring in the xz plane.
Shape torus(const Detail& detail, float ringRadius, float tubeRadius, int around, int along);
/// The surface of a cube, pushed to where `point` says for a place on the cube [-1, 1]^3. Every face has its own
/// picture, three beside one another in two rows: +x -x +y, -y +z -z; it lies `inset` of a face inside.
Shape cube(int steps, const std::function<vec3(const vec3& onCube)>& point, float inset = 0.01f);
/// `steps` quads along each face, a quarter of them on the rounding at either end.
Shape roundedBox(const Detail& detail, const vec3& half, float radius, int steps = 16);

/// A point of a swept curve and the frame around it: t along, n towards the reference, b = t x n.
struct Station {
    vec3 p, t, n, b;
};
/// Stations at equal steps along a smooth curve through `path`; n turns as little as it can, drawn gently to `up`.
std::vector<Station> sweep(const std::vector<vec3>& path, int steps, const vec3& up = kY, float pull = 0.05f);
/// A tube with round ends; radius as a function of the way along. Angle 0 is at n.
Shape tube(const Detail& detail, const std::vector<vec3>& path, const std::function<float(float)>& radius, int around,
           int along);
/// A flat thing of some thickness between a root and a rim: both as functions of the way along, in [0, 1]; the
/// thickness in metres as a function of the way along and from root to rim. u = 0 at the root, 1 at the rim.
struct Fin {
    std::function<vec3(float)> root, rim;
    std::function<vec3(float along, float out)> side;  // half the thickness, as a vector
};
Shape fin(int around, int along, const Fin& fin);

/// Where `distance` is 0, inside being negative; `cells` along the longest side of the box. Closed if the box is large
/// enough. uv is mirrored around the y axis: u = |angle from +z| / pi, v = from top to bottom.
Shape isosurface(const std::function<float(const vec3&)>& distance, const vec3& low, const vec3& high, int cells);

// Distances to simple bodies, for isosurface.
float ellipsoid(const vec3& p, const vec3& centre, const vec3& radii);
float capsule(const vec3& p, const vec3& a, const vec3& b, float radiusA, float radiusB);
float roundBox(const vec3& p, const vec3& centre, const vec3& half, float radius);
float smoothMin(float a, float b, float k);

/// Point on the Catmull-Rom curve through `points` at t in [0, 1].
vec3 curvePoint(const std::vector<vec3>& points, float t);

}  // namespace dioptre::builtin
