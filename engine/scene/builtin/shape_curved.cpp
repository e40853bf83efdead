// The curved part of shape.hpp: balls, lathes, tubes, fins, distances.
#include <algorithm>

#include "scene/builtin/shape.hpp"

namespace dioptre::builtin {

namespace {

/// Chaikin 1974: each pass cuts every corner at a quarter of its sides.
std::vector<vec2> cutCorners(std::vector<vec2> points, int passes) {
    for (int pass = 0; pass < passes; ++pass) {
        std::vector<vec2> cut{points.front()};
        for (std::size_t i = 0; i + 1 < points.size(); ++i) {
            if (i > 0) cut.push_back(glm::mix(points[i], points[i + 1], 0.25f));
            if (i + 2 < points.size()) cut.push_back(glm::mix(points[i], points[i + 1], 0.75f));
        }
        cut.push_back(points.back());
        points = std::move(cut);
    }
    return points;
}

}  // namespace

vec3 curvePoint(const std::vector<vec3>& points, float t) {
    const int last = static_cast<int>(points.size()) - 1;
    const float x = glm::clamp(t, 0.0f, 1.0f) * toFloat(last);
    const int i = std::min(static_cast<int>(x), last - 1);
    const float f = x - toFloat(i);
    // End points are reflected, so the curve leaves them straight.
    const auto at = [&](int k) {
        const auto n = [&](int m) { return points[static_cast<std::size_t>(m)]; };
        if (k < 0) return 2.0f * n(0) - n(1);
        if (k > last) return 2.0f * n(last) - n(last - 1);
        return n(k);
    };
    const vec3 a = at(i - 1), b = at(i), c = at(i + 1), d = at(i + 2);
    return 0.5f * (2.0f * b + (c - a) * f + (2.0f * a - 5.0f * b + 4.0f * c - d) * f * f +
                   (3.0f * (b - c) + d - a) * f * f * f);
}

Shape ball(const Detail& detail, const vec3& centre, const vec3& radii, int around) {
    const int n = detail.around(around);
    return polar(n, n / 2, [&](float u, float v) {
        const float a = 2.0f * kPi * u, e = kPi * v;
        return centre + radii * vec3(std::sin(e) * std::sin(a), std::cos(e), std::sin(e) * std::cos(a));
    });
}

Shape lathe(const Detail& detail, std::vector<vec2> profile, int around, int along, int rounding) {
    profile = cutCorners(std::move(profile), rounding);
    std::vector<float> length{0.0f};
    for (std::size_t i = 1; i < profile.size(); ++i)
        length.push_back(length.back() + glm::distance(profile[i], profile[i - 1]));
    return polar(detail.around(around), detail.along(along), [&](float u, float v) {
        const float at = v * length.back();
        const auto above = std::upper_bound(length.begin() + 1, length.end() - 1, at);
        const auto i = static_cast<std::size_t>(above - length.begin());
        const float step = length[i] - length[i - 1];
        const vec2 p = glm::mix(profile[i - 1], profile[i], step > 0.0f ? saturate((at - length[i - 1]) / step) : 0.0f);
        const float a = 2.0f * kPi * u;
        return vec3(p.x * std::sin(a), p.y, p.x * std::cos(a));
    });
}

Shape torus(const Detail& detail, float ringRadius, float tubeRadius, int around, int along) {
    return loop(detail.around(around), detail.around(along), [&](float u, float v) {
        const float a = 2.0f * kPi * u, b = 2.0f * kPi * v, r = ringRadius + tubeRadius * std::cos(b);
        return vec3(r * std::sin(a), tubeRadius * std::sin(b), r * std::cos(a));
    });
}

std::vector<Station> sweep(const std::vector<vec3>& path, int steps, const vec3& up, float pull) {
    // Equal steps of length: sample finely, then walk
    const int fine = 16 * steps;
    std::vector<float> length{0.0f};
    vec3 previous = curvePoint(path, 0.0f);
    for (int i = 1; i <= fine; ++i) {
        const vec3 p = curvePoint(path, toFloat(i) / toFloat(fine));
        length.push_back(length.back() + glm::distance(p, previous));
        previous = p;
    }
    std::vector<Station> stations;
    std::size_t at = 0;
    for (int j = 0; j <= steps; ++j) {
        const float wanted = length.back() * toFloat(j) / toFloat(steps);
        while (at + 2 < length.size() && length[at + 1] < wanted) ++at;
        const float step = length[at + 1] - length[at];
        const float t =
            (static_cast<float>(at) + (step > 0.0f ? saturate((wanted - length[at]) / step) : 0.0f)) / toFloat(fine);
        const float h = 0.5f / toFloat(steps);
        const vec3 tangent =
            glm::normalize(curvePoint(path, std::min(1.0f, t + h)) - curvePoint(path, std::max(0.0f, t - h)));
        const vec3 sideways = up - tangent * glm::dot(up, tangent);
        vec3 n = sideways;
        if (j > 0) {
            const vec3 carried = stations.back().n - tangent * glm::dot(tangent, stations.back().n);
            n = glm::normalize(carried) + pull * sideways;
        } else if (glm::length(n) < 1e-3f) {
            n = glm::cross(tangent, std::abs(tangent.x) < 0.9f ? kX : kZ);
        }
        n = glm::normalize(n - tangent * glm::dot(n, tangent));
        stations.push_back({curvePoint(path, t), tangent, n, glm::cross(tangent, n)});
    }
    return stations;
}

Shape tube(const Detail& detail, const std::vector<vec3>& path, const std::function<float(float)>& radius, int around,
           int along) {
    const int n = detail.around(around), steps = std::max(detail.along(along), n / 4 + 1);
    const std::vector<Station> stations = sweep(path, steps);
    // The ends are rounded over as many rows as their caps have
    const float end = toFloat(n / 8) / toFloat(steps);
    return polar(n, steps, [&](float u, float v) {
        const auto j = static_cast<std::size_t>(std::lround(v * toFloat(steps)));
        const Station& s = stations[j];
        const float in = std::min({1.0f, v / end, (1.0f - v) / end}), a = 2.0f * kPi * u;
        const float r = radius(v) * std::sqrt(std::max(0.0f, 1.0f - (1.0f - in) * (1.0f - in)));
        return s.p + r * (std::cos(a) * s.n + std::sin(a) * s.b);
    });
}

Shape fin(int around, int along, const Fin& fin) {
    Shape shape = polar(around, along, [&](float u, float v) {
        const float out = 0.5f - 0.5f * std::cos(2.0f * kPi * u);
        return glm::mix(fin.root(v), fin.rim(v), out) + std::sin(2.0f * kPi * u) * fin.side(v, out);
    });
    for (vec2& t : shape.uv) t.x = 0.5f - 0.5f * std::cos(kPi * t.x);
    return shape;
}

float ellipsoid(const vec3& p, const vec3& centre, const vec3& radii) {
    // Quilez: a first-order distance
    const vec3 q = (p - centre) / radii;
    const float k0 = glm::length(q), k1 = glm::length(q / radii);
    return k1 > 0.0f ? k0 * (k0 - 1.0f) / k1 : -std::min({radii.x, radii.y, radii.z});
}

float capsule(const vec3& p, const vec3& a, const vec3& b, float radiusA, float radiusB) {
    const vec3 ab = b - a;
    const float t = saturate(glm::dot(p - a, ab) / glm::dot(ab, ab));
    return glm::distance(p, a + t * ab) - glm::mix(radiusA, radiusB, t);
}

float roundBox(const vec3& p, const vec3& centre, const vec3& half, float radius) {
    const vec3 q = glm::abs(p - centre) - (half - radius);
    return glm::length(glm::max(q, 0.0f)) + std::min(std::max({q.x, q.y, q.z}), 0.0f) - radius;
}

float smoothMin(float a, float b, float k) {
    const float h = std::max(k - std::abs(a - b), 0.0f) / k;
    return std::min(a, b) - h * h * k * 0.25f;
}

}  // namespace dioptre::builtin
