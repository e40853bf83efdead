// Chart packing by stb_rect_pack, and the way from charts to surfaces.
#include "atlas.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#define STB_RECT_PACK_IMPLEMENTATION
#include <stb_rect_pack.h>

namespace studio {

namespace {

constexpr int kSmallestChart = 3;

/// Tries one density (texels per metre); keeps the charts if they fit.
bool tryPack(Object& object, float density) {
    std::vector<stbrp_rect> rects;
    for (std::size_t i = 0; i < object.patches.size(); ++i) {
        const Patch& p = object.patches[i];
        if (p.sharedChart >= 0) continue;
        const auto texels = [&](float metres, int limit) {
            const float wanted = std::round(metres * density * p.detail);
            return static_cast<int>(
                std::clamp(wanted, static_cast<float>(kSmallestChart), static_cast<float>(limit - kChartMargin)));
        };
        stbrp_rect r{};
        r.id = static_cast<int>(i);
        r.w = static_cast<stbrp_coord>(texels(p.size.x, object.textureWidth) + kChartMargin);
        r.h = static_cast<stbrp_coord>(texels(p.size.y, object.textureHeight) + kChartMargin);
        rects.push_back(r);
    }
    std::vector<stbrp_node> nodes(static_cast<std::size_t>(object.textureWidth));
    stbrp_context context;
    stbrp_init_target(&context, object.textureWidth, object.textureHeight, nodes.data(), object.textureWidth);
    if (!stbrp_pack_rects(&context, rects.data(), static_cast<int>(rects.size()))) return false;
    for (const stbrp_rect& r : rects) {
        Patch& p = object.patches[static_cast<std::size_t>(r.id)];
        p.chartX = r.x + kChartMargin / 2;
        p.chartY = r.y + kChartMargin / 2;
        p.chartWidth = r.w - kChartMargin;
        p.chartHeight = r.h - kChartMargin;
    }
    for (Patch& p : object.patches) {
        if (p.sharedChart < 0) continue;
        const Patch& owner = object.patches[static_cast<std::size_t>(p.sharedChart)];
        p.chartX = owner.chartX;
        p.chartY = owner.chartY;
        p.chartWidth = owner.chartWidth;
        p.chartHeight = owner.chartHeight;
    }
    return true;
}

/// The grid interval that holds x, and the place within it.
std::pair<int, float> interval(const std::vector<float>& edges, float x) {
    const auto above = std::upper_bound(edges.begin() + 1, edges.end() - 1, x);
    const auto i = static_cast<int>(above - edges.begin()) - 1;
    const float low = edges[static_cast<std::size_t>(i)], high = edges[static_cast<std::size_t>(i + 1)];
    return {i, high > low ? std::clamp((x - low) / (high - low), 0.0f, 1.0f) : 0.0f};
}

}  // namespace

void packCharts(Object& object) {
    if (object.patches.empty()) return;
    float low = 0.0f, high = 1.0f;
    while (tryPack(object, high) && high < 1e6f) high *= 2.0f;
    for (int i = 0; i < 18; ++i) {
        const float middle = 0.5f * (low + high);
        (tryPack(object, middle) ? low : high) = middle;
    }
    if (!tryPack(object, low))
        throw std::runtime_error("make_studio: " + object.name + ": texture too small for its charts");
}

vec2 textureCoordinate(const Object& object, const Patch& p, const vec2& unit) {
    const vec2 texel(static_cast<float>(p.chartX) + 0.5f + unit.x * static_cast<float>(p.chartWidth - 1),
                     static_cast<float>(p.chartY) + 0.5f + unit.y * static_cast<float>(p.chartHeight - 1));
    return texel / vec2(static_cast<float>(object.textureWidth), static_cast<float>(object.textureHeight));
}

SurfacePoint surfacePoint(const Patch& p, const vec2& unit) {
    const auto [i, fx] = interval(p.across, unit.x);
    const auto [j, fy] = interval(p.down, unit.y);
    const auto blend = [&, i = i, j = j, fx = fx, fy = fy](const std::vector<vec3>& grid) {
        const auto at = [&](int x, int y) { return grid[static_cast<std::size_t>(y * p.columns + x)]; };
        return glm::mix(glm::mix(at(i, j), at(i + 1, j), fx), glm::mix(at(i, j + 1), at(i + 1, j + 1), fx), fy);
    };
    SurfacePoint s;
    s.unit = unit;
    s.metres = unit * p.size;
    s.size = p.size;
    s.position = blend(p.position);
    s.normal = blend(p.normal);
    s.normal = glm::length(s.normal) > 1e-6f ? glm::normalize(s.normal) : kY;
    s.seed = p.seed;
    return s;
}

}  // namespace studio
