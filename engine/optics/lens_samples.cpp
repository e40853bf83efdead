#include "optics/lens_samples.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dioptre {

double halton(int index, int base) {
    double value = 0.0, digit = 1.0;
    for (; index > 0; index /= base) value += (digit /= base) * (index % base);
    return value;
}

glm::dvec2 concentricDisc(glm::dvec2 square) {
    const glm::dvec2 s = square * 2.0 - 1.0;
    if (s.x == 0.0 && s.y == 0.0) return s;
    const bool wide = std::abs(s.x) > std::abs(s.y);
    const double radius = wide ? s.x : s.y;
    const double quarter = std::numbers::pi / 4.0;
    const double angle = wide ? quarter * (s.y / s.x) : 2.0 * quarter - quarter * (s.x / s.y);
    return {radius * std::cos(angle), radius * std::sin(angle)};
}

glm::dvec2 polygon(glm::dvec2 square, int blades, Radians rotation) {
    // The sector by the first number, a point in its triangle by what is left of it and the second.
    const double sectors = std::clamp(square.x, 0.0, std::nextafter(1.0, 0.0)) * blades;
    const double sector = std::floor(sectors), along = sectors - sector;
    const double step = 2.0 * std::numbers::pi / blades, from = rotation.value + sector * step;
    const glm::dvec2 a(std::cos(from), std::sin(from)), b(std::cos(from + step), std::sin(from + step));
    return std::sqrt(square.y) * glm::mix(a, b, along);
}

LensSample lensSample(int index, const Lens& lens) {
    // From 1 on: sample 0 of every base is 0, a corner.
    const int i = index + 1;
    const glm::dvec2 square(halton(i, 2), halton(i, 7));
    return {lens.blades > 0 ? polygon(square, lens.blades, lens.bladeRotation) : concentricDisc(square),
            {halton(i, 3) - 0.5, halton(i, 5) - 0.5}};
}

glm::dmat4 clipFromView(const View& view, const Lens& lens, const LensSample& sample) {
    glm::dmat4 clip = clipFromView(view);
    const glm::dvec2 shift = glm::dvec2(clip[0][0], clip[1][1]) * (lens.apertureRadius.value * sample.lens);
    for (int axis = 0; axis < 2; ++axis) {
        clip[2][axis] -= shift[axis] * lens.focus.value;
        clip[3][axis] -= shift[axis];
    }
    // w = -z: a shift of ndc by 2 j / size
    clip[2][0] -= 2.0 * sample.pixel.x / view.width;
    clip[2][1] -= 2.0 * sample.pixel.y / view.height;
    return clip;
}

}  // namespace dioptre
