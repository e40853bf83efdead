// What grows from a dragon's body: spines, wings, legs, the tail's fin.
#include <algorithm>
#include <array>

#include "scene/builtin/dragons.hpp"

namespace dioptre::builtin {

namespace {

/// A leg's joints: hip, knee, heel, toes.
std::array<vec3, 4> legJoints(const Station& hip, float radius, float side, float ground) {
    const vec3 out = side * hip.b, flatOut = glm::normalize(vec3(out.x, 0.0f, out.z));
    const vec3 ahead = glm::normalize(vec3(hip.t.x, 0.0f, hip.t.z) + 1e-4f * kZ);
    const vec3 root = hip.p + 0.55f * radius * out - 0.2f * radius * hip.n;
    const float drop = std::max(root.y - ground, 1.5f * radius);
    const vec3 knee = root + 1.7f * radius * flatOut + 1.0f * radius * ahead - 0.30f * drop * kY;
    const vec3 heel = root + 1.9f * radius * flatOut - 0.5f * radius * ahead - 0.80f * drop * kY;
    const vec3 toes = root + 2.2f * radius * flatOut + 0.6f * radius * ahead - (drop - 0.12f * radius) * kY;
    return {root, knee, heel, toes};
}

struct WingJoints {
    vec3 shoulder, elbow, wrist, hip;
    std::array<vec3, 4> tips;
};

WingJoints wingJoints(const Station& s, float radius, float span, float side) {
    // Up and out, as a cloak thrown back
    const vec3 out = glm::normalize(vec3(side * s.b.x, 0.0f, side * s.b.z) + 1e-4f * kX);
    const vec3 back = -glm::normalize(vec3(s.t.x, 0.15f * s.t.y, s.t.z) + 1e-4f * kZ);
    const auto at = [&](float o, float y, float b) { return s.p + span * (o * out + y * kY + b * back); };
    WingJoints w;
    w.shoulder = s.p + 0.6f * radius * out + 0.5f * radius * kY;
    w.elbow = at(0.24f, 0.20f, 0.16f);
    w.wrist = at(0.42f, 0.55f, 0.0f);
    w.tips = {at(0.98f, 0.78f, 0.12f), at(1.02f, 0.40f, 0.38f), at(0.80f, 0.08f, 0.56f), at(0.46f, -0.08f, 0.58f)};
    w.hip = s.p + 0.5f * radius * out + 3.2f * radius * back;
    return w;
}

/// From the wrist to a finger's tip, arched.
vec3 finger(const WingJoints& w, std::size_t i, float t) {
    const vec3 straight = glm::mix(w.wrist, w.tips[i], t);
    return straight + 0.16f * std::sin(kPi * t) * glm::distance(w.wrist, w.tips[i]) * kY;
}

}  // namespace

Shape spinesShape(const Detail& detail, const ScaledTube& body, const Dragon& dragon) {
    Shape all;
    for (int k = 0; k < dragon.spines; ++k) {
        const float t = 0.06f + 0.92f * toFloat(k) / toFloat(dragon.spines - 1);
        const auto j = static_cast<std::size_t>(t * toFloat(static_cast<int>(body.stations.size()) - 1));
        const Station& s = body.stations[j];
        const float r = body.radius[j], high = r * (0.75f + 0.35f * std::sin(1.3f * toFloat(k))) + 0.2f * dragon.girth;
        Fin blade;
        blade.root = [=](float v) { return s.p + 0.92f * r * s.n + (v - 0.5f) * 0.8f * high * s.t; };
        blade.rim = [=](float v) {
            return s.p + (r + high * (1.0f - 0.55f * v)) * s.n + ((v - 0.5f) * 0.25f - 0.75f) * high * s.t;
        };
        blade.side = [=](float v, float out) {
            return 0.16f * r * (1.0f - 0.85f * out) * std::sin(kPi * glm::mix(0.08f, 0.92f, v)) * s.b;
        };
        all.add(fin(detail.around(24), detail.along(14), blade));
    }
    return all;
}

Shape membraneShape(const Detail& detail, const Station& shoulder, float radius, float span) {
    Shape all;
    for (const float side : {-1.0f, 1.0f}) {
        const WingJoints w = wingJoints(shoulder, radius, span, side);
        const float thick = 0.006f * span;
        // Between neighbouring fingers, its edge drawn in
        for (std::size_t i = 0; i + 1 < w.tips.size(); ++i) {
            const vec3 normal = glm::normalize(glm::cross(w.tips[i] - w.wrist, w.tips[i + 1] - w.wrist));
            Shape web = polar(detail.around(64), detail.along(48), [&](float u, float v) {
                const float out = 0.5f - 0.5f * std::cos(2.0f * kPi * u),
                            reach = glm::mix(0.02f, 1.0f - 0.22f * std::sin(kPi * v), out);
                const vec3 p = glm::mix(finger(w, i, reach), finger(w, i + 1, reach), v);
                const float sag = 0.05f * span * std::sin(kPi * v) * std::sin(kPi * std::min(1.0f, 0.9f * out));
                return p + (sag + thick * std::sin(2.0f * kPi * u)) * normal;
            });
            all.add(web);
        }
        // From the last finger to the flank
        const vec3 normal = glm::normalize(glm::cross(w.tips[3] - w.elbow, w.hip - w.elbow));
        all.add(polar(detail.around(64), detail.along(48), [&](float u, float v) {
            const float out = 0.5f - 0.5f * std::cos(2.0f * kPi * u);
            const vec3 arm =
                v < 0.5f ? glm::mix(w.wrist, w.elbow, 2.0f * v) : glm::mix(w.elbow, w.shoulder, 2.0f * v - 1.0f);
            const vec3 edge =
                glm::mix(w.tips[3], w.hip, v) - 0.2f * std::sin(kPi * v) * (glm::mix(w.tips[3], w.hip, v) - arm);
            const vec3 straight = v < 1e-4f ? finger(w, 3, out) : glm::mix(arm, edge, out);
            const vec3 nearFinger = glm::mix(finger(w, 3, out), straight, glm::smoothstep(0.0f, 0.25f, v));
            return nearFinger +
                   (0.05f * span * std::sin(kPi * v) * std::sin(kPi * out) + thick * std::sin(2.0f * kPi * u)) * normal;
        }));
    }
    return all.scaleUv({1.0f, 1.0f});
}

Shape wingBonesShape(const Detail& detail, const Station& shoulder, float radius, float span) {
    Shape all;
    for (const float side : {-1.0f, 1.0f}) {
        const WingJoints w = wingJoints(shoulder, radius, span, side);
        all.add(tube(
            detail,
            {w.shoulder, glm::mix(w.shoulder, w.elbow, 0.5f) + 0.02f * span * kY, w.elbow,
             glm::mix(w.elbow, w.wrist, 0.5f) + 0.02f * span * kY, w.wrist},
            [=](float t) { return span * (0.05f - 0.022f * t + 0.012f * std::cos(4.0f * kPi * t)); }, 32, 90));
        for (std::size_t i = 0; i < w.tips.size(); ++i) {
            std::vector<vec3> path;
            for (int k = 0; k <= 8; ++k) path.push_back(finger(w, i, toFloat(k) / 8.0f));
            all.add(tube(
                detail, path, [=](float t) { return span * 0.022f * (1.0f - 0.85f * t); }, 16, 80));
        }
        all.add(tube(
            detail,
            {w.wrist, w.wrist + span * vec3(0, 0.06f, 0),
             w.wrist + span * (0.10f * kY + 0.05f * glm::normalize(w.wrist - w.elbow))},
            [=](float t) { return 0.024f * span * (1.0f - 0.97f * t); }, 16, 24));
    }
    return all;
}

Shape legShape(const Detail& detail, const Station& hip, float radius, float side, float ground) {
    const auto [root, knee, heel, toes] = legJoints(hip, radius, side, ground);
    const auto thickness = [=](float t) {
        return radius * (0.62f - 0.48f * glm::smoothstep(0.0f, 0.7f, t) + 0.06f * std::sin(3.0f * kPi * t));
    };
    Shape s = shapeOf(detail,
                      scaledTube({root, glm::mix(root, knee, 0.55f), knee, glm::mix(knee, heel, 0.5f), heel, toes},
                                 thickness, 24, detail.along(96)),
                      56);
    const vec3 ahead = glm::normalize(toes - heel - glm::dot(toes - heel, kY) * kY), across = glm::cross(kY, ahead);
    for (int toe = -1; toe <= 1; ++toe) {
        const vec3 to = glm::normalize(ahead + 0.55f * toFloat(toe) * across);
        s.add(tube(
            detail,
            {heel + 0.3f * (toes - heel), toes + 0.1f * radius * kY, toes + 0.62f * radius * to - 0.02f * radius * kY},
            [=](float t) { return radius * (0.19f - 0.08f * t); }, 24, 30));
    }
    return s;
}

Shape clawsShape(const Detail& detail, const Station& hip, float radius, float side, float ground) {
    const auto [root, knee, heel, toes] = legJoints(hip, radius, side, ground);
    const vec3 ahead = glm::normalize(toes - heel - glm::dot(toes - heel, kY) * kY), across = glm::cross(kY, ahead);
    Shape s;
    for (int toe = -1; toe <= 1; ++toe) {
        const vec3 to = glm::normalize(ahead + 0.55f * toFloat(toe) * across), tip = toes + 0.58f * radius * to;
        s.add(tube(
            detail, {tip, tip + radius * (0.2f * to + 0.1f * kY), tip + radius * (0.45f * to - 0.06f * kY)},
            [=](float t) { return 0.1f * radius * (1.0f - 0.96f * t); }, 16, 20));
    }
    return s;
}

Shape tailFinShape(const Detail& detail, const ScaledTube& body, float size) {
    const Station& s = body.stations.front();
    Shape all;
    for (const float side : {-1.0f, 1.0f}) {
        Fin leaf;
        leaf.root = [=](float v) { return s.p + size * ((0.35f - 0.9f * v) * s.t + side * 0.01f * s.n); };
        leaf.rim = [=](float v) {
            return s.p + size * ((0.25f - 1.0f * v) * s.t +
                                 side * 0.45f * std::pow(std::sin(kPi * glm::mix(0.05f, 0.98f, v)), 0.8f) *
                                     (1.0f + 0.12f * std::cos(20.0f * v)) * s.n);
        };
        leaf.side = [=](float, float out) { return 0.03f * size * (1.0f - 0.8f * out) * s.b; };
        all.add(fin(detail.around(40), detail.along(56), leaf));
    }
    return all;
}

}  // namespace dioptre::builtin
