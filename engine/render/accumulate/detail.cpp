#include "render/accumulate/detail.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace dioptre {

CocExtent cocExtent(const View& view, const Lens& lens, const ViewBox& box) {
    const double near = std::max(view.near.value, box.nearest());
    const double far = std::max(near, box.farthest());
    const glm::dvec2 f = focalLengthPixels(view);
    const double less = std::min(f.x, f.y), more = std::max(f.x, f.y);
    const auto radius = [&](double pixels, double d) { return cocRadiusPixels(lens, pixels, Dioptres(1.0 / d)); };
    const bool focusWithin = radius(less, near) <= 0.0 && radius(less, far) >= 0.0;
    return {focusWithin ? 0.0 : std::min(std::abs(radius(less, near)), std::abs(radius(less, far))),
            std::max(std::abs(radius(more, near)), std::abs(radius(more, far)))};
}

double sphereArea(const View& view, const ViewBox& box) {
    const double radius = glm::length(box.half), distance = -box.centre.z;
    if (distance <= radius) return std::numeric_limits<double>::infinity();
    const glm::dvec2 f = focalLengthPixels(view);
    return std::numbers::pi * f.x * f.y * radius * radius / (distance * distance);
}

double detailLevel(double cocArea, double triangleArea, int mostLevel) {
    if (!(cocArea > 0.0)) return 0.0;
    return std::clamp(std::log2(cocArea / triangleArea), 0.0, static_cast<double>(mostLevel));
}

double detailLevel(const View& view, const Lens& lens, const DrawList::Seen& seen) {
    if (seen.levels() < 2) return 0.0;
    const double radius = cocExtent(view, lens, seen.box).smallest;
    const double asPublished = detailLevel(std::numbers::pi * radius * radius,
                                           sphereArea(view, seen.box) / (0.5 * seen.triangles), seen.levels() - 1);
    return std::min(asPublished, levelWithin(view, seen, kErrorOfBlur * radius));
}

int levelOfSample(double level, int sample, int count) {
    const double whole = std::floor(level);
    const bool finer = sample < (1.0 - (level - whole)) * count;
    return static_cast<int>(whole) + (finer ? 0 : 1);
}

}  // namespace dioptre
