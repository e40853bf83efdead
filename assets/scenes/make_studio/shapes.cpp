// The shapes of shapes.hpp.
#include "shapes.hpp"

#include <algorithm>
#include <cmath>

namespace studio {

namespace {

/// Mean extents of the grid along u and v; charts follow the mean arc length, so that pictures are not stretched.
void measure(Patch& p) {
    const auto at = [&](int i, int j) { return p.position[static_cast<std::size_t>(j * p.columns + i)]; };
    p.across.assign(1, 0.0f);
    p.down.assign(1, 0.0f);
    for (int i = 1; i < p.columns; ++i) {
        float sum = 0.0f;
        for (int j = 0; j < p.rows; ++j) sum += glm::distance(at(i, j), at(i - 1, j));
        p.across.push_back(p.across.back() + sum / static_cast<float>(p.rows));
    }
    for (int j = 1; j < p.rows; ++j) {
        float sum = 0.0f;
        for (int i = 0; i < p.columns; ++i) sum += glm::distance(at(i, j), at(i, j - 1));
        p.down.push_back(p.down.back() + sum / static_cast<float>(p.columns));
    }
    p.size = {p.across.back(), p.down.back()};
    for (float& x : p.across) x /= p.size.x;
    for (float& y : p.down) y /= p.size.y;
}

template <class Vector>
Vector catmullRom(const std::vector<Vector>& points, float t) {
    const int last = static_cast<int>(points.size()) - 1;
    const float x = std::clamp(t, 0.0f, 1.0f) * static_cast<float>(last);
    const int i = std::min(static_cast<int>(x), last - 1);
    const float f = x - static_cast<float>(i);
    // End points are reflected, so the curve leaves them straight.
    const auto at = [&](int k) {
        if (k < 0) return 2.0f * points[0] - points[1];
        if (k > last) return 2.0f * points[static_cast<std::size_t>(last)] - points[static_cast<std::size_t>(last - 1)];
        return points[static_cast<std::size_t>(k)];
    };
    const Vector a = at(i - 1), b = at(i), c = at(i + 1), d = at(i + 2);
    return 0.5f * (2.0f * b + (c - a) * f + (2.0f * a - 5.0f * b + 4.0f * c - d) * f * f +
                   (3.0f * (b - c) + d - a) * f * f * f);
}

float way(int i, int count) {
    return static_cast<float>(i) / static_cast<float>(count - 1);
}

}  // namespace

vec3 curvePoint(const std::vector<vec3>& points, float t) {
    return catmullRom(points, t);
}
vec2 curvePoint(const std::vector<vec2>& points, float t) {
    return catmullRom(points, t);
}

Patch surface(int columns, int rows, const std::function<vec3(float, float)>& point, bool closed) {
    Patch patch;
    patch.columns = columns;
    patch.rows = rows;
    const float step = 2e-3f;
    const auto normalAt = [&](float u, float v) {
        const float u0 = closed ? u - step : std::max(0.0f, u - step),
                    u1 = closed ? u + step : std::min(1.0f, u + step);
        const float v0 = std::max(0.0f, v - step), v1 = std::min(1.0f, v + step);
        return glm::cross(point(u, v1) - point(u, v0), point(u1, v) - point(u0, v));
    };
    for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < columns; ++i) {
            const float u = way(i, columns), v = way(j, rows);
            vec3 n = normalAt(u, v);
            // At a pole the derivative vanishes: take the normal a little inside.
            const float inner = 0.01f;
            if (glm::length(n) < 1e-9f) n = normalAt(u, std::clamp(v, inner, 1.0f - inner));
            if (glm::length(n) < 1e-12f)
                n = normalAt(std::clamp(u, inner, 1.0f - inner), std::clamp(v, inner, 1.0f - inner));
            patch.position.push_back(point(u, v));
            patch.normal.push_back(glm::length(n) > 0.0f ? glm::normalize(n) : kY);
        }
    }
    measure(patch);
    return patch;
}

Patch rectangle(const vec3& topLeft, const vec3& right, const vec3& down, int columns, int rows) {
    return surface(columns, rows, [&](float u, float v) { return topLeft + u * right + v * down; });
}

Patches box(const vec3& a, const vec3& b, bool bottom) {
    const vec3 s = b - a, x = kX * s.x, y = kY * s.y, z = kZ * s.z;
    Patches faces{rectangle({a.x, b.y, b.z}, x, -y), rectangle({b.x, b.y, a.z}, -x, -y),
                  rectangle({b.x, b.y, b.z}, -z, -y), rectangle({a.x, b.y, a.z}, z, -y),
                  rectangle({a.x, b.y, a.z}, x, z)};
    if (bottom) faces.push_back(rectangle({a.x, a.y, b.z}, x, -z));
    return faces;
}

Patches roundedBox(const vec3& low, const vec3& high, float radius, int steps, float bulge) {
    const vec3 centre = (low + high) * 0.5f, half = (high - low) * 0.5f;
    const float r = std::min({radius, half.x, half.y, half.z});
    const vec3 core = half - r;
    Patches faces = box(-vec3(1.0f), vec3(1.0f));
    for (Patch& face : faces) {
        const vec3 corner = face.position[0], right = face.position[1] - corner, down = face.position[2] - corner;
        // The outer rows of the grid lie on the rounding, the others on the flat.
        const float edge = steps >= 6 ? 2.0f : 1.0f, count = static_cast<float>(steps);
        const auto spread = [&](float t, float extent) {
            const float k = t * count, f = r / extent;
            if (k < edge) return f * k / edge;
            if (k > count - edge) return 1.0f - f * (count - k) / edge;
            return f + (1.0f - 2.0f * f) * (k - edge) / (count - 2.0f * edge);
        };
        face = surface(steps + 1, steps + 1, [&](float u, float v) {
            const vec3 cube =
                corner + spread(u, glm::length(right * half)) * right + spread(v, glm::length(down * half)) * down;
            const vec3 target = cube * half;
            const vec3 inner = glm::clamp(target, -core, core);
            const vec3 out = target - inner;
            const float dome =
                (1.0f - (2.0f * u - 1.0f) * (2.0f * u - 1.0f)) * (1.0f - (2.0f * v - 1.0f) * (2.0f * v - 1.0f));
            const float length = glm::length(out);
            const vec3 direction = length > 0.0f ? out / length : vec3(0.0f);
            return centre + inner + direction * (r + bulge * dome);
        });
    }
    return faces;
}

Patch lathe(const std::vector<vec2>& profile, int segments, int rings) {
    return surface(
        segments + 1, rings + 1,
        [&](float u, float v) {
            const vec2 p = curvePoint(profile, v);
            const float angle = 2.0f * kPi * u;
            return vec3(std::max(p.x, 0.0f) * std::cos(angle), p.y, -std::max(p.x, 0.0f) * std::sin(angle));
        },
        true);
}

Patch disc(float radius, float height, int segments, bool facingUp) {
    // A square drawn onto the disc (concentric), so its chart is not pinched at the centre.
    const int n = std::max(2, segments / 4);
    return surface(n + 1, n + 1, [&](float u, float v) {
        const vec2 q(2.0f * u - 1.0f, 2.0f * v - 1.0f);
        const vec2 p(q.x * std::sqrt(1.0f - 0.5f * q.y * q.y), q.y * std::sqrt(1.0f - 0.5f * q.x * q.x));
        return vec3(p.x * radius, height, (facingUp ? p.y : -p.y) * radius);
    });
}

Patch ball(float radius, int segments, int rings) {
    return surface(
        segments + 1, rings + 1,
        [&](float u, float v) {
            const float a = 2.0f * kPi * u, e = kPi * v;
            return radius * vec3(std::sin(e) * std::cos(a), std::cos(e), -std::sin(e) * std::sin(a));
        },
        true);
}

Patch tube(const std::vector<vec3>& path, const std::function<float(float)>& radius, int sides, int rings) {
    // Rotation-minimising frames: carry one normal along the curve and re-orthogonalise it.
    const int frames = 8 * rings;
    std::vector<vec3> normals;
    vec3 previous(0.0f);
    const auto tangentAt = [&](float t) {
        return glm::normalize(curvePoint(path, std::min(1.0f, t + 1e-3f)) -
                              curvePoint(path, std::max(0.0f, t - 1e-3f)));
    };
    for (int i = 0; i <= frames; ++i) {
        const vec3 tangent = tangentAt(way(i, frames + 1));
        if (i == 0) previous = frameAround(tangent)[0];
        previous = glm::normalize(previous - tangent * glm::dot(previous, tangent));
        normals.push_back(previous);
    }
    return surface(
        sides + 1, rings + 1,
        [&](float u, float v) {
            const float x = v * static_cast<float>(frames);
            const auto i = static_cast<std::size_t>(std::min(static_cast<int>(x), frames - 1));
            const vec3 tangent = tangentAt(v);
            const vec3 n = glm::normalize(glm::mix(normals[i], normals[i + 1], x - static_cast<float>(i)));
            const vec3 b = glm::cross(tangent, n);
            const float angle = 2.0f * kPi * u;
            return curvePoint(path, v) + radius(v) * (std::cos(angle) * n - std::sin(angle) * b);
        },
        true);
}

Patch tube(const std::vector<vec3>& path, float radius, int sides, int rings) {
    return tube(
        path, [radius](float) { return radius; }, sides, rings);
}

Patch torus(float ringRadius, float tubeRadius, int segments, int sides, float arc) {
    return surface(
        segments + 1, sides + 1,
        [&](float u, float v) {
            const float a = 2.0f * kPi * arc * u, b = 2.0f * kPi * (0.5f - v);
            const float r = ringRadius + tubeRadius * std::cos(b);
            return vec3(r * std::cos(a), tubeRadius * std::sin(b), -r * std::sin(a));
        },
        arc == 1.0f);
}

Patch leaf(float length, float width, float fold, float droop, int columns, int rows) {
    return surface(columns, rows, [&](float u, float v) {
        const float along = 1.0f - v;  // v runs down the picture: the tip is on top
        const float side = 2.0f * u - 1.0f;
        // Pointed ellipse, widest at 40 %; never quite zero, so that normals exist at both ends.
        const float outline = std::pow(along + 0.004f, 0.75f) * std::pow(1.004f - along, 0.95f) * 1.95f;
        return vec3(-side * 0.5f * width * outline, fold * width * outline * std::abs(side) - droop * along * along,
                    length * along);
    });
}

Patch bead(const vec3& centre, float radius) {
    Patch p = ball(radius, 4, 2);
    // Exact normals and coordinates, so that equal vertices are equal to the last bit and can be merged.
    for (int j = 0; j < p.rows; ++j) {
        for (int i = 0; i < p.columns; ++i) {
            static const vec3 kAround[] = {kX, -kZ, -kX, kZ, kX};
            const auto k = static_cast<std::size_t>(j * p.columns + i);
            p.normal[k] = j == 0 ? kY : j == 2 ? -kY : kAround[i];
            p.position[k] = centre + radius * p.normal[k];
        }
    }
    return p;
}

Patch place(Patch patch, const mat4& m) {
    const glm::mat3 normalMatrix = glm::transpose(glm::inverse(glm::mat3(m)));
    for (vec3& p : patch.position) p = vec3(m * vec4(p, 1.0f));
    for (vec3& n : patch.normal) n = glm::normalize(normalMatrix * n);
    measure(patch);
    return patch;
}

Patches place(Patches patches, const mat4& m) {
    for (Patch& p : patches) p = place(std::move(p), m);
    return patches;
}

Patches join(std::initializer_list<Patches> parts) {
    Patches all;
    for (const Patches& part : parts) all.insert(all.end(), part.begin(), part.end());
    return all;
}

}  // namespace studio
