// A dragon's head: an isosurface of smooth unions, with horns, teeth, tongue and eyes.
#include <algorithm>

#include "scene/builtin/dragons.hpp"

namespace dioptre::builtin {

namespace {

const vec3 kEye{0.150f, 0.135f, 0.46f};

/// Scales of the head, in metres of relief; the sign of x does not matter.
float headRelief(const vec3& p) {
    const float around = std::atan2(std::abs(p.x), p.y + 0.12f);
    const Cell cell = worley({p.z * 17.0f, around * 5.0f}, 21);
    const float snout = glm::smoothstep(0.75f, 0.95f, p.z);
    return (0.013f - 0.006f * snout) * glm::smoothstep(0.0f, 0.28f, cell.second - cell.nearest);
}

float headDistance(const vec3& w) {
    const vec3 p(std::abs(w.x), w.y, w.z);
    float d = ellipsoid(p, {0, 0.06f, 0.3f}, {0.215f, 0.185f, 0.27f});
    d = smoothMin(d, capsule(p, {0, 0.0f, -0.12f}, {0, 0.03f, 0.25f}, 0.2f, 0.2f), 0.1f);        // neck
    d = smoothMin(d, capsule(p, {0, 0.045f, 0.45f}, {0, 0.015f, 0.92f}, 0.16f, 0.095f), 0.09f);  // snout
    d = smoothMin(d, capsule(p, {0.05f, 0.055f, 0.6f}, {0.055f, 0.06f, 0.93f}, 0.06f, 0.05f), 0.05f);
    d = smoothMin(d, ellipsoid(p, {0.055f, 0.105f, 0.94f}, {0.045f, 0.035f, 0.05f}), 0.04f);           // nostrils
    d = smoothMin(d, capsule(p, {0.125f, 0.2f, 0.56f}, {0.2f, 0.255f, 0.3f}, 0.03f, 0.055f), 0.05f);   // brows
    d = smoothMin(d, capsule(p, {0.18f, -0.02f, 0.3f}, {0.15f, -0.12f, 0.36f}, 0.07f, 0.07f), 0.07f);  // cheeks
    // The lower jaw hangs open
    float jaw = capsule(p, {0.12f, -0.13f, 0.32f}, {0.055f, -0.275f, 0.83f}, 0.065f, 0.04f);
    jaw = smoothMin(jaw, capsule(p, {0, -0.16f, 0.3f}, {0, -0.29f, 0.82f}, 0.09f, 0.04f), 0.06f);
    d = smoothMin(d, jaw, 0.035f);
    d = smoothMin(d, capsule(p, {0, -0.3f, 0.8f}, {0, -0.37f, 0.83f}, 0.03f, 0.012f), 0.03f);
    // Palate and gullet, eyes' sockets, nostrils' holes
    const auto carve = [&](float hole, float k) { d = -smoothMin(-d, hole, k); };
    carve(capsule(p, {0, -0.085f, 0.5f}, {0, -0.115f, 1.05f}, 0.07f, 0.06f), 0.03f);
    carve(glm::length(p - kEye - vec3(0.05f, 0.01f, 0.02f)) - 0.07f, 0.03f);
    carve(ellipsoid(p, {0.085f, 0.125f, 0.985f}, {0.022f, 0.016f, 0.03f}), 0.015f);
    return d - headRelief(p);
}

/// A spike from `root` along a curve, its ridges around it.
Shape spike(const Detail& detail, const std::vector<vec3>& path, float radius, int around, int along,
            float ridges = 0.0f) {
    return tube(
        detail, path,
        [=](float v) {
            const float ridge = ridges > 0.0f ? 1.0f + 0.09f * std::sin(2.0f * kPi * ridges * v) : 1.0f;
            return radius * std::pow(1.0f - 0.97f * v, 0.8f) * ridge;
        },
        around, along);
}

Shape bothSides(Shape one) {
    Shape other = one;
    other.move(scaling({-1, 1, 1}));
    return one.add(other);
}

}  // namespace

Shape headShape(const Detail& detail) {
    const int cells = std::max(20, static_cast<int>(118.0f * detail.scale));
    Shape s = isosurface(headDistance, {-0.36f, -0.48f, -0.4f}, {0.36f, 0.4f, 1.1f}, cells);
    for (std::size_t i = 0; i < s.uv.size(); ++i) {
        const vec3 p = s.position[i];
        s.uv[i] = {std::abs(std::atan2(p.x, p.y + 0.05f)) / kPi, 0.9f * p.z};
    }
    return s;
}

Shape hornsShape(const Detail& detail, float curl) {
    Shape s = spike(
        detail, {{0.13f, 0.2f, 0.22f}, {0.2f, 0.36f, 0.0f}, {0.24f, 0.46f, -0.3f}, {0.2f, 0.46f + 0.2f * curl, -0.62f}},
        0.062f, 32, 110, 16.0f);
    s.add(spike(detail, {{0.19f, 0.1f, 0.14f}, {0.32f, 0.18f, -0.05f}, {0.4f, 0.2f + 0.1f * curl, -0.3f}}, 0.042f, 24,
                60, 9.0f));
    s.add(spike(detail, {{0.2f, -0.03f, 0.2f}, {0.33f, -0.06f, 0.06f}, {0.4f, -0.1f + 0.06f * curl, -0.14f}}, 0.032f,
                24, 40, 6.0f));
    s.add(spike(detail, {{0.13f, -0.16f, 0.36f}, {0.19f, -0.24f, 0.24f}, {0.22f, -0.3f, 0.08f}}, 0.026f, 16, 30, 4.0f));
    s = bothSides(std::move(s));
    return s.add(
        spike(detail, {{0.0f, 0.13f, 0.84f}, {0.0f, 0.24f, 0.86f}, {0.0f, 0.33f, 0.8f}}, 0.035f, 24, 40, 4.0f));
}

Shape teethShape(const Detail& detail) {
    Shape s;
    for (int k = 0; k < 8; ++k) {
        const float t = toFloat(k) / 7.0f, size = k == 6 ? 0.085f : 0.036f + 0.02f * t;
        const vec3 up(glm::mix(0.115f, 0.062f, t), glm::mix(-0.052f, -0.05f, t), glm::mix(0.52f, 0.93f, t));
        s.add(spike(detail, {up, up - vec3(0, 0.5f * size, 0.004f), up - vec3(0.004f, size, -0.012f)}, 0.014f, 16, 14));
        const vec3 low(glm::mix(0.1f, 0.045f, t), glm::mix(-0.165f, -0.265f, t), glm::mix(0.5f, 0.84f, t));
        s.add(spike(detail, {low, low + vec3(0, 0.45f * size, 0), low + vec3(0, 0.9f * size, -0.01f)}, 0.012f, 16, 14));
    }
    return bothSides(std::move(s));
}

Shape tongueShape(const Detail& detail) {
    Shape s = tube(
        detail, {{0, -0.13f, 0.35f}, {0, -0.17f, 0.6f}, {0, -0.18f, 0.85f}, {0, -0.12f, 1.02f}},
        [](float v) { return 0.045f * (1.0f - 0.6f * v); }, 24, 60);
    for (const float side : {-1.0f, 1.0f})
        s.add(spike(detail, {{0, -0.125f, 1.01f}, {side * 0.03f, -0.08f, 1.09f}, {side * 0.075f, -0.07f, 1.16f}},
                    0.017f, 16, 24));
    return s;
}

Shape eyesShape(const Detail& detail) {
    return bothSides(ball(detail, kEye + vec3(0.012f, 0.002f, 0.004f), vec3(0.058f), 40));
}

Shape pupilsShape(const Detail& detail) {
    const vec3 out = glm::normalize(vec3(0.8f, 0.1f, 0.55f));
    return bothSides(ball(detail, kEye + vec3(0.012f, 0.002f, 0.004f) + 0.049f * out, {0.014f, 0.04f, 0.014f}, 24));
}

Shape whiskersShape(const Detail& detail) {
    return bothSides(spike(detail,
                           {{0.08f, 0.03f, 0.93f},
                            {0.3f, -0.08f, 1.0f},
                            {0.48f, 0.05f, 0.75f},
                            {0.66f, -0.16f, 0.45f},
                            {0.8f, -0.02f, 0.1f}},
                           0.018f, 16, 120));
}

}  // namespace dioptre::builtin
