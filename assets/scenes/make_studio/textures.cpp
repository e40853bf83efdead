// Composition of textures.hpp.
#include "textures.hpp"

#include <algorithm>
#include <cmath>

#include "atlas.hpp"

namespace studio {

namespace {

// Where the shoulder begins; below it the picture is exactly the light that was computed.
constexpr float kShoulder = 0.55f;
// The viewer adds a weak hemisphere of light of its own to lit objects; what is baked for them makes room for it.
constexpr float kLitShare = 0.8f;

std::uint8_t toByte(float x) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(x, 0.0f, 1.0f) * 255.0f));
}

void write(Picture& picture, int x, int y, const vec4& value) {
    for (int c = 0; c < 4; ++c) {
        picture.rgba[static_cast<std::size_t>((y * picture.width + x) * 4 + c)] = toByte(value[c]);
    }
}

vec4 encoded(const vec3& linear, float alpha = 1.0f) {
    return {encodeSrgb(linear.x), encodeSrgb(linear.y), encodeSrgb(linear.z), alpha};
}

Picture blank(const Object& object) {
    Picture picture{object.textureWidth, object.textureHeight, {}};
    picture.rgba.assign(static_cast<std::size_t>(picture.width * picture.height * 4), 0);
    return picture;
}

/// Surface slope of the paint's height at a place, as a tangent-space normal (x right, y up in the picture).
vec3 reliefNormal(const Patch& patch, const vec2& unit) {
    const vec2 step(1.0f / static_cast<float>(patch.chartWidth), 1.0f / static_cast<float>(patch.chartHeight));
    const auto height = [&](const vec2& at) {
        return patch.paint(surfacePoint(patch, glm::clamp(at, 0.0f, 1.0f))).height;
    };
    const float dx = height(unit + vec2(step.x, 0)) - height(unit - vec2(step.x, 0));
    const float dy = height(unit + vec2(0, step.y)) - height(unit - vec2(0, step.y));
    return glm::normalize(vec3(-dx / (2.0f * step.x * patch.size.x), dy / (2.0f * step.y * patch.size.y), 1.0f));
}

/// Fills free texels near charts with their nearest chart's colour and the rest with the mean colour.
void spreadCharts(Picture& picture, std::vector<std::uint8_t> covered) {
    const int w = picture.width, h = picture.height;
    const auto at = [w](int x, int y) { return static_cast<std::size_t>(y * w + x); };
    for (int pass = 0; pass < 3 * kChartMargin; ++pass) {
        const std::vector<std::uint8_t> before = covered;
        for (int y = 0; y < h; ++y) {
            for (int x = 0; x < w; ++x) {
                if (before[at(x, y)]) continue;
                const int neighbours[4][2] = {{x - 1, y}, {x + 1, y}, {x, y - 1}, {x, y + 1}};
                for (const auto& n : neighbours) {
                    if (n[0] < 0 || n[1] < 0 || n[0] >= w || n[1] >= h || !before[at(n[0], n[1])]) continue;
                    std::copy_n(&picture.rgba[4 * at(n[0], n[1])], 4, &picture.rgba[4 * at(x, y)]);
                    covered[at(x, y)] = 1;
                    break;
                }
            }
        }
    }
    std::uint64_t sum[4] = {0, 0, 0, 0}, count = 0;
    for (std::size_t k = 0; k < covered.size(); ++k) {
        if (!covered[k]) continue;
        for (std::size_t c = 0; c < 4; ++c) sum[c] += picture.rgba[4 * k + c];
        ++count;
    }
    for (std::size_t k = 0; k < covered.size() && count > 0; ++k) {
        if (covered[k]) continue;
        for (std::size_t c = 0; c < 4; ++c) picture.rgba[4 * k + c] = static_cast<std::uint8_t>(sum[c] / count);
    }
}

struct Range {
    float low = 1e9f, high = -1e9f;
    void add(float x) {
        low = std::min(low, x);
        high = std::max(high, x);
    }
    bool varies() const { return high - low > 0.02f; }
};

ObjectPictures compose(const Model& model, const BakedLight& light, int index) {
    const Object& object = model.objects[static_cast<std::size_t>(index)];
    ObjectPictures out;
    if (object.finish == Finish::glowing || object.patches.empty()) return out;
    const bool lit = object.finish == Finish::lit;
    if (object.finish != Finish::shining) out.color = blank(object);
    if (lit || object.finish == Finish::shining) out.emissive = blank(object);
    if (lit) out.metallicRoughness = blank(object);
    if (lit && object.normalMap) out.normal = blank(object);
    std::vector<std::uint8_t> covered(static_cast<std::size_t>(object.textureWidth * object.textureHeight), 0);
    Range roughness, metallic;

    for (std::size_t p = 0; p < object.patches.size(); ++p) {
        const Patch& patch = object.patches[p];
        if (patch.sharedChart >= 0) continue;
        for (int j = 0; j < patch.chartHeight; ++j) {
            for (int i = 0; i < patch.chartWidth; ++i) {
                const vec2 unit(static_cast<float>(i) / static_cast<float>(patch.chartWidth - 1),
                                static_cast<float>(j) / static_cast<float>(patch.chartHeight - 1));
                const int x = patch.chartX + i, y = patch.chartY + j;
                const Coat coat = patch.paint(surfacePoint(patch, unit));
                covered[static_cast<std::size_t>(y * object.textureWidth + x)] = 1;
                if (object.finish == Finish::shining) {
                    write(out.emissive, x, y, encoded(coat.glow));
                } else if (object.finish == Finish::baked) {
                    const LightGrid& g = light.of(model, index, static_cast<int>(p));
                    const vec3 radiance = coat.albedo * lookUp(g, g.irradiance, unit) / kPi + lookUp(g, g.gloss, unit);
                    write(out.color, x, y, encoded(compressHighlights(radiance)));
                } else if (!lit) {
                    write(out.color, x, y, encoded(coat.albedo, coat.alpha));
                } else {
                    const LightGrid& g = light.of(model, index, static_cast<int>(p));
                    const vec3 diffuse = coat.albedo * (1.0f - coat.metallic) * lookUp(g, g.unexported, unit) / kPi;
                    write(out.color, x, y, encoded(coat.albedo));
                    write(out.emissive, x, y,
                          encoded(compressHighlights(diffuse * kLitShare + lookUp(g, g.gloss, unit))));
                    write(out.metallicRoughness, x, y, {1.0f, coat.roughness, coat.metallic, 1.0f});
                    roughness.add(coat.roughness);
                    metallic.add(coat.metallic);
                    if (object.normalMap) write(out.normal, x, y, vec4(reliefNormal(patch, unit) * 0.5f + 0.5f, 1.0f));
                }
            }
        }
    }
    if (lit && !roughness.varies() && !metallic.varies()) {
        out.metallicRoughness = {};
        out.roughness = roughness.low;
        out.metallic = metallic.low;
    } else if (lit) {
        out.metallic = 1.0f;
    }
    for (Picture* picture : {&out.color, &out.metallicRoughness, &out.normal, &out.emissive}) {
        if (!picture->empty()) spreadCharts(*picture, covered);
    }
    return out;
}

}  // namespace

vec3 compressHighlights(const vec3& radiance) {
    const auto bend = [](float x) {
        return x <= kShoulder ? x : 1.0f - (1.0f - kShoulder) * std::exp(-(x - kShoulder) / (1.0f - kShoulder) * 0.8f);
    };
    // Bending each channel alone turns warm light white, bending the largest alone keeps it gaudy: some of each.
    const float largest = std::max({radiance.x, radiance.y, radiance.z, 1e-6f});
    return 0.4f * vec3(bend(radiance.x), bend(radiance.y), bend(radiance.z)) +
           0.6f * radiance * (bend(largest) / largest);
}

std::vector<ObjectPictures> composePictures(const Model& model, const BakedLight& light) {
    std::vector<ObjectPictures> pictures(model.objects.size());
    parallelFor(static_cast<int>(pictures.size()),
                [&](int o) { pictures[static_cast<std::size_t>(o)] = compose(model, light, o); });
    return pictures;
}

vec4 sample(const Picture& picture, const vec2& coordinate) {
    if (picture.empty()) return vec4(1.0f);
    const float x = coordinate.x * static_cast<float>(picture.width) - 0.5f,
                y = coordinate.y * static_cast<float>(picture.height) - 0.5f;
    const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
    const auto texel = [&](int a, int b) {
        const int cx = std::clamp(a, 0, picture.width - 1), cy = std::clamp(b, 0, picture.height - 1);
        const std::uint8_t* t = &picture.rgba[static_cast<std::size_t>((cy * picture.width + cx) * 4)];
        return vec4(t[0], t[1], t[2], t[3]) / 255.0f;
    };
    const float fx = x - static_cast<float>(i), fy = y - static_cast<float>(j);
    return glm::mix(glm::mix(texel(i, j), texel(i + 1, j), fx), glm::mix(texel(i, j + 1), texel(i + 1, j + 1), fx), fy);
}

}  // namespace studio
