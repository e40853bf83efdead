// A dragon's body with its scales, and the whole dragon.
#include <algorithm>

#include "scene/builtin/dragons.hpp"

namespace dioptre::builtin {

ScalePlace scaleAt(float m, float row, int around, int rowPeriod) {
    constexpr float kLength = 1.75f;  // of a scale, in rows: the tip lies on the next row
    const float number = std::floor(row), along = row - number;
    const auto across = [&](float ofRow, float& column) {
        const float x = m * toFloat(around) * 0.5f + 0.5f * std::fmod(std::abs(ofRow), 2.0f);
        column = std::floor(x);
        return x - column - 0.5f;
    };
    const auto place = [&](float ofRow, float column, float height, float edge) {
        const auto wrapped = static_cast<std::uint32_t>(
            static_cast<int>(ofRow - std::floor(ofRow / toFloat(rowPeriod)) * toFloat(rowPeriod)));
        return ScalePlace{height,
                          unitFloat(hash(wrapped * 131u + static_cast<std::uint32_t>(static_cast<int>(column)))), edge};
    };
    float column = 0.0f;
    const float upper = across(number - 1.0f, column);
    const float reach = (kLength - 1.0f) * std::sqrt(std::max(0.0f, 1.0f - 4.0f * upper * upper));
    if (along < reach) {
        const float keel = 0.18f * (1.0f - std::min(1.0f, 5.0f * std::abs(upper)));
        return place(number - 1.0f, column, (1.0f + along) / kLength + keel, saturate((reach - along) * 3.5f));
    }
    const float own = across(number, column);
    const float keel = 0.18f * (1.0f - std::min(1.0f, 5.0f * std::abs(own)));
    return place(number, column, along / kLength + keel * along, saturate((along - reach) * 1.5f + 0.25f));
}

ScaledTube scaledTube(const std::vector<vec3>& path, const std::function<float(float)>& radius, int scales, int steps) {
    ScaledTube tube;
    tube.stations = sweep(path, steps);
    tube.scales = scales;
    float row = 0.0f;
    for (int j = 0; j <= steps; ++j) {
        const float r = radius(toFloat(j) / toFloat(steps));
        tube.radius.push_back(r);
        // Rows as far apart as scales are wide, so that these are as long as wide everywhere
        const auto k = static_cast<std::size_t>(j);
        if (j > 0)
            row += glm::distance(tube.stations[k].p, tube.stations[k - 1].p) /
                   std::max(1.2f * 2.0f * kPi * r / toFloat(scales), 1e-4f);
        tube.row.push_back(row);
    }
    return tube;
}

Shape shapeOf(const Detail& detail, const ScaledTube& tube, int around) {
    const int n = detail.around(around), steps = static_cast<int>(tube.stations.size()) - 1;
    const float end = toFloat(n / 8) / toFloat(steps);
    Shape s = polar(n, steps, [&](float u, float v) {
        const auto j = static_cast<std::size_t>(std::lround(v * toFloat(steps)));
        const Station& at = tube.stations[j];
        const float m = 1.0f - std::abs(1.0f - 2.0f * u), a = 2.0f * kPi * u;
        const float in = std::min({1.0f, v / end, (1.0f - v) / end});
        const float r = tube.radius[j] * std::sqrt(std::max(0.0f, 1.0f - (1.0f - in) * (1.0f - in)));
        // Plates under the belly, scales elsewhere; rows are counted from the tail and their tips point there
        const float belly = glm::smoothstep(0.78f, 0.84f, m);
        const float scale = scaleAt(m, -tube.row[j], tube.scales, kScaleRows).height;
        const float plate = fraction(-0.5f * tube.row[j]);
        const float high = 0.55f * 2.0f * kPi / toFloat(tube.scales) * glm::mix(scale, 0.9f * plate, belly);
        // A little higher than wide
        return at.p + r * (1.0f + high * in) * (1.06f * std::cos(a) * at.n + 0.96f * std::sin(a) * at.b);
    });
    // The picture's rows are the relief's
    for (vec2& t : s.uv) {
        const auto j = static_cast<std::size_t>(std::lround(t.y * toFloat(steps)));
        t.y = -tube.row[j] / toFloat(kScaleRows);
    }
    return s;
}

float bodyRadius(const Dragon& d, float t) {
    // Tail, trunk, neck
    const float tail = std::pow(glm::smoothstep(-0.02f, 0.55f, t), 1.1f),
                neck = 1.0f - 0.42f * glm::smoothstep(0.66f, 0.9f, t);
    const float thin = 0.19f * d.headSize;  // where it meets the head
    return std::max(0.02f * d.girth, glm::mix(d.girth * tail * neck, thin, glm::smoothstep(0.9f, 1.0f, t)));
}

int addDragon(Model& model, const Dragon& d) {
    const Detail detail{model.detail.scale * d.fineness};
    const Hide hide = d.hide;
    const int scales = d.scales;
    const int hidePicture = model.picture(d.name, 512, 512, [=](float u, float v) {
        const float row = v * toFloat(kScaleRows);
        const ScalePlace place = scaleAt(u, row, scales, kScaleRows);
        const float belly = glm::smoothstep(0.78f, 0.84f, u), pattern = tiledNoise({u * 0.7f, v}, 5, 3);
        vec3 color = glm::mix(hide.back, hide.flank, glm::smoothstep(0.12f, 0.7f, u + 0.5f * (pattern - 0.5f)));
        color *= 0.75f + 0.5f * place.id;
        color = glm::mix(hide.edge, color, glm::smoothstep(0.0f, 0.55f, place.edge));
        color *= 0.55f + 0.55f * place.height;
        const float plate = fraction(0.5f * row);
        const vec3 under =
            glm::mix(hide.edge, hide.belly, glm::smoothstep(0.0f, 0.25f, std::min(plate, 2.0f * (1.0f - plate)))) *
            (0.7f + 0.4f * plate);
        return glm::mix(color, under, belly);
    });
    const int headPicture = model.picture(d.name + "'s head", 512, 512, [=](float u, float v) {
        // As headShape: u around from the crown, v along
        const Cell cell = worley({v / 0.9f * 17.0f, u * kPi * 5.0f}, 21);
        vec3 color = glm::mix(hide.back, hide.flank, glm::smoothstep(0.2f, 0.6f, u));
        color = glm::mix(color, hide.belly, glm::smoothstep(0.72f, 0.85f, u)) * (0.75f + 0.45f * cell.id);
        return glm::mix(hide.edge, color, glm::smoothstep(0.02f, 0.25f, cell.second - cell.nearest));
    });
    const int hornPicture = model.picture(d.name + "'s horn", 64, 256, [=](float u, float v) {
        const float streak = noise({u * 14.0f, v * 3.0f, 1});
        return glm::mix(hide.horn * 0.4f, hide.horn, glm::smoothstep(0.0f, 0.6f, v)) * (0.75f + 0.35f * streak);
    });
    const int membranePicture = model.picture(d.name + "'s wings", 256, 256, [=](float u, float v) {
        const float vein =
            std::pow(1.0f - std::abs(2.0f * fraction(3.0f * v + 0.3f * noise({u * 5.0f, v * 5.0f, 4})) - 1.0f), 6.0f);
        const vec3 color =
            glm::mix(hide.membrane, hide.membrane * 0.5f, 0.6f * u + 0.4f * noise({u * 18.0f, v * 18.0f, 2}));
        return glm::mix(color, hide.back, 0.5f * vein * (1.0f - u));
    });
    const int skin = model.material(d.name, vec3(1.0f), hide.roughness, hide.metallic, hidePicture);
    const int face = model.material(d.name + "'s head", vec3(1.0f), hide.roughness, hide.metallic, headPicture);
    const int horn = model.material(d.name + "'s horns", vec3(1.0f), 0.35f, 0.0f, hornPicture);
    const int tooth = model.material(d.name + "'s teeth", srgb(0xf0e6cc), 0.25f);
    const int tongue = model.material(d.name + "'s tongue", srgb(0xa8283a), 0.3f);
    const int eye = model.glowing(d.name + "'s eyes", hide.eye),
              pupil = model.material(d.name + "'s pupils", srgb(0x080604), 0.1f);
    const int membrane = model.material(d.name + "'s wings", vec3(1.0f), 0.6f, 0.0f, membranePicture);

    const auto body = [=] {
        return scaledTube(
            d.path, [&](float t) { return bodyRadius(d, t); }, d.scales, detail.along(620));
    };
    const vec3 z = glm::normalize(d.gaze), x = glm::normalize(glm::cross(kY, z));
    const mat4 headPlace =
        mat4(vec4(x, 0), vec4(glm::cross(z, x), 0), vec4(z, 0), vec4(d.path.back(), 1)) * scaling(d.headSize);
    const auto onHead = [=](Shape (*make)(const Detail&)) { return [=] { return make(detail).move(headPlace); }; };
    std::vector<Model::Part> parts{{skin, [=] { return shapeOf(detail, body(), 208); }},
                                   {face, onHead(headShape)},
                                   {horn, [=] { return hornsShape(detail, d.hornCurl).move(headPlace); }},
                                   {horn, [=] { return spinesShape(detail, body(), d); }},
                                   {tooth, onHead(teethShape)},
                                   {tongue, onHead(tongueShape)},
                                   {eye, onHead(eyesShape)},
                                   {pupil, onHead(pupilsShape)},
                                   {membrane, [=] { return tailFinShape(detail, body(), 2.2f * d.girth); }}};
    if (d.whiskers) parts.push_back({horn, onHead(whiskersShape)});
    if (d.wings > 0.0f) {
        const auto shoulder = [=](const ScaledTube& t) {
            return static_cast<std::size_t>(d.wingsAt * toFloat(static_cast<int>(t.stations.size()) - 1));
        };
        parts.push_back({membrane, [=] {
                             const ScaledTube t = body();
                             return membraneShape(detail, t.stations[shoulder(t)], t.radius[shoulder(t)], d.wings);
                         }});
        parts.push_back({face, [=] {
                             const ScaledTube t = body();
                             return wingBonesShape(detail, t.stations[shoulder(t)], t.radius[shoulder(t)], d.wings);
                         }});
    }
    using Limb = Shape (*)(const Detail&, const Station&, float, float, float);
    const auto limbs = [=](Limb make) {
        return [=] {
            const ScaledTube t = body();
            Shape all;
            for (const float at : d.legs) {
                const auto j = static_cast<std::size_t>(at * toFloat(static_cast<int>(t.stations.size()) - 1));
                for (const float side : {-1.0f, 1.0f})
                    all.add(make(detail, t.stations[j], std::max(t.radius[j], 0.6f * d.girth), side,
                                 t.stations[j].p.y - 2.4f * d.girth));
            }
            return all;
        };
    };
    if (!d.legs.empty()) {
        parts.push_back({skin, limbs(legShape)});
        parts.push_back({horn, limbs(clawsShape)});
    }
    return model.mesh(d.name, std::move(parts));
}

}  // namespace dioptre::builtin
