// Andersson, Nilsson, Akenine-Moller, Oskarsson, Astrom, Fairchild 2020: FLIP: A Difference Evaluator for Alternating
// Images (HPG 2020), for low dynamic range pictures. Section numbers below are the paper's.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/glm.hpp>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "core/color.hpp"
#include "core/error.hpp"
#include "metrics/metrics.hpp"

namespace dioptre {

namespace {

constexpr double kPi = std::numbers::pi;

// Exponents and thresholds of sections 4.1 and 4.3.
constexpr double kColourExponent = 0.7;    // q_c
constexpr double kColourKnee = 0.4;        // p_c, fraction of the largest difference
constexpr double kColourKneeValue = 0.95;  // p_t, what that fraction is mapped to
constexpr double kFeatureWidth = 0.082;    // w, width of a feature, degrees
constexpr double kFeatureExponent = 0.5;   // q_f

struct Size {
    int width = 0, height = 0;
    std::size_t count() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
};
using Plane = std::vector<float>;
using Kernel = std::vector<float>;  // odd length, its middle at 0

// ---- Colour spaces (linear sRGB, white D65; section 4.1.1). Columns of a glm matrix are written as rows here. ----

const glm::dmat3 kXyzFromRgb = glm::transpose(glm::dmat3(                     //
    10135552.0 / 24577794.0, 8788810.0 / 24577794.0, 4435075.0 / 24577794.0,  //
    2613072.0 / 12288897.0, 8788810.0 / 12288897.0, 887015.0 / 12288897.0,    //
    1425312.0 / 73733382.0, 8788810.0 / 73733382.0, 70074185.0 / 73733382.0));
const glm::dvec3 kWhite = kXyzFromRgb * glm::dvec3(1.0);

// Linear YyCxCz, and CIELAB: the same form without and with the cube root.
const glm::dmat3 kOpponentFromXyz = glm::transpose(glm::dmat3(0, 116, 0, 500, -500, 0, 0, 200, -200));

glm::dvec3 ycxczFromRgb(const glm::dvec3& rgb) {
    return kOpponentFromXyz * (kXyzFromRgb * rgb / kWhite) - glm::dvec3(16, 0, 0);
}

glm::dvec3 rgbFromYcxcz(const glm::dvec3& ycxcz) {
    static const glm::dmat3 xyzFromOpponent = glm::inverse(kOpponentFromXyz), rgbFromXyz = glm::inverse(kXyzFromRgb);
    return rgbFromXyz * (xyzFromOpponent * (ycxcz + glm::dvec3(16, 0, 0)) * kWhite);
}

double labCurve(double x) {
    constexpr double kDelta = 6.0 / 29.0;
    return x > kDelta * kDelta * kDelta ? std::cbrt(x) : x / (3.0 * kDelta * kDelta) + 4.0 / 29.0;
}

// CIELAB with the Hunt effect: colours are weaker where it is dark (section 4.1.3).
glm::dvec3 huntLabFromRgb(const glm::dvec3& rgb) {
    const glm::dvec3 xyz = kXyzFromRgb * rgb / kWhite;
    const glm::dvec3 curved(labCurve(xyz.x), labCurve(xyz.y), labCurve(xyz.z));
    const glm::dvec3 lab = kOpponentFromXyz * curved - glm::dvec3(16, 0, 0);
    return {lab.x, 0.01 * lab.x * lab.y, 0.01 * lab.x * lab.z};
}

// HyAB distance (Abasi et al. 2020).
double hyab(const glm::dvec3& a, const glm::dvec3& b) {
    return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
}

// ---- Filters ----

// Separable, the borders repeated.
Plane filter(const Plane& in, Size size, const Kernel& along, const Kernel& down) {
    const auto width = static_cast<std::size_t>(size.width);
    const auto radiusOf = [](const Kernel& kernel) { return static_cast<int>(kernel.size() / 2); };
    Plane between(in.size()), out(in.size(), 0.0F);
    const int r = radiusOf(along);
    std::vector<float> padded(width + along.size() - 1);
    for (int y = 0; y < size.height; ++y) {
        const float* row = &in[static_cast<std::size_t>(y) * width];
        for (int x = -r; x < size.width + r; ++x)
            padded[static_cast<std::size_t>(x + r)] = row[std::clamp(x, 0, size.width - 1)];
        float* to = &between[static_cast<std::size_t>(y) * width];
        std::fill(to, to + width, 0.0F);
        for (std::size_t i = 0; i < along.size(); ++i)
            for (std::size_t x = 0; x < width; ++x) to[x] += along[i] * padded[x + i];
    }
    for (int y = 0; y < size.height; ++y) {
        float* to = &out[static_cast<std::size_t>(y) * width];
        for (int i = -radiusOf(down); i <= radiusOf(down); ++i) {
            const float* from = &between[static_cast<std::size_t>(std::clamp(y + i, 0, size.height - 1)) * width];
            const float weight = down[static_cast<std::size_t>(i + radiusOf(down))];
            for (std::size_t x = 0; x < width; ++x) to[x] += weight * from[x];
        }
    }
    return out;
}

template <class Function>
std::vector<double> sampled(int radius, Function f) {
    std::vector<double> values;
    for (int i = -radius; i <= radius; ++i) values.push_back(f(static_cast<double>(i)));
    return values;
}

// Divides what is positive by its sum, and what is negative by its own.
Kernel normalised(const std::vector<double>& values) {
    double positive = 0.0, negative = 0.0;
    for (const double v : values) (v > 0.0 ? positive : negative) += std::abs(v);
    Kernel kernel;
    for (const double v : values)
        kernel.push_back(static_cast<float>(v == 0.0 ? 0.0 : v / (v > 0.0 ? positive : negative)));
    return kernel;
}

// One Gaussian of a contrast sensitivity function: a * sqrt(pi / b) * exp(-pi^2 x^2 / b), x in degrees.
struct SensitivityTerm {
    double a, b;
};
constexpr double kWidestB = 0.04;  // gives every filter the same radius

// Section 4.1.2, table 1: achromatic, red-green, blue-yellow (a sum of two).
const std::array<std::vector<SensitivityTerm>, 3> kSensitivity = {
    {{{1.0, 0.0047}}, {{1.0, 0.0053}}, {{34.1, 0.04}, {13.5, 0.025}}}};

// The channel as the eye resolves it.
Plane filterBySensitivity(const Plane& in, Size size, const std::vector<SensitivityTerm>& terms, double ppd) {
    const int radius = static_cast<int>(std::ceil(3.0 * std::sqrt(kWidestB / (2.0 * kPi * kPi)) * ppd));
    std::vector<double> shares;
    std::vector<std::vector<double>> shapes;
    for (const SensitivityTerm& term : terms) {
        shapes.push_back(
            sampled(radius, [&](double x) { return std::exp(-kPi * kPi * x * x / (ppd * ppd * term.b)); }));
        double sum = 0.0;
        for (const double v : shapes.back()) sum += v;
        shares.push_back(term.a * std::sqrt(kPi / term.b) * sum * sum);  // of the two-dimensional filter
    }
    double total = 0.0;
    for (const double share : shares) total += share;
    Plane out(in.size(), 0.0F);
    for (std::size_t k = 0; k < terms.size(); ++k) {
        const Kernel kernel = normalised(shapes[k]);
        const Plane part = filter(in, size, kernel, kernel);
        for (std::size_t i = 0; i < out.size(); ++i) out[i] += static_cast<float>(shares[k] / total) * part[i];
    }
    return out;
}

// ---- The two halves of the error ----

using Picture = std::array<Plane, 3>;  // Y, Cx, Cz

Picture pictureOf(const Image& image) {
    Picture picture;
    for (Plane& plane : picture) plane.resize(image.pixels.size() / 3);
    for (std::size_t i = 0; i < picture[0].size(); ++i) {
        glm::dvec3 rgb;
        for (int c = 0; c < 3; ++c)
            rgb[c] = clampUnit(static_cast<double>(image.pixels[3 * i + static_cast<std::size_t>(c)]));
        const glm::dvec3 ycxcz = ycxczFromRgb(rgb);
        for (int c = 0; c < 3; ++c) picture[static_cast<std::size_t>(c)][i] = static_cast<float>(ycxcz[c]);
    }
    return picture;
}

// Section 4.1: both pictures as the eye resolves them, compared in a perceptually even space; 0..1.
Plane colourDifference(const Picture& a, const Picture& b, Size size, double ppd) {
    Picture seenA, seenB;
    for (std::size_t c = 0; c < 3; ++c) {
        seenA[c] = filterBySensitivity(a[c], size, kSensitivity[c], ppd);
        seenB[c] = filterBySensitivity(b[c], size, kSensitivity[c], ppd);
    }
    const auto labAt = [](const Picture& p, std::size_t i) {
        const glm::dvec3 rgb = rgbFromYcxcz({p[0][i], p[1][i], p[2][i]});
        return huntLabFromRgb(glm::clamp(rgb, glm::dvec3(0.0), glm::dvec3(1.0)));
    };
    // The largest difference is that of green and blue.
    const double largest = std::pow(hyab(huntLabFromRgb({0, 1, 0}), huntLabFromRgb({0, 0, 1})), kColourExponent);
    const double knee = kColourKnee * largest;
    Plane out(size.count());
    for (std::size_t i = 0; i < out.size(); ++i) {
        const double difference = std::pow(hyab(labAt(seenA, i), labAt(seenB, i)), kColourExponent);
        const double mapped =
            difference < knee ? kColourKneeValue / knee * difference
                              : kColourKneeValue + (difference - knee) / (largest - knee) * (1.0 - kColourKneeValue);
        out[i] = static_cast<float>(mapped);
    }
    return out;
}

// Strength of edges and points per pixel (section 4.2).
struct Features {
    Plane edge, point;
};

Features featuresOf(const Plane& y, Size size, double ppd) {
    const double sigma = 0.5 * kFeatureWidth * ppd;
    const int radius = static_cast<int>(std::ceil(3.0 * sigma));
    const auto gauss = [&](double x) { return std::exp(-x * x / (2.0 * sigma * sigma)); };
    const Kernel smooth = normalised(sampled(radius, gauss));
    const Kernel slope = normalised(sampled(radius, [&](double x) { return -x * gauss(x); }));
    const Kernel bend =
        normalised(sampled(radius, [&](double x) { return (x * x / (sigma * sigma) - 1.0) * gauss(x); }));
    Plane luminance(y.size());
    for (std::size_t i = 0; i < y.size(); ++i) luminance[i] = (y[i] + 16.0F) / 116.0F;

    const auto length = [&](const Kernel& kernel) {
        Plane x = filter(luminance, size, kernel, smooth);
        const Plane down = filter(luminance, size, smooth, kernel);
        for (std::size_t i = 0; i < x.size(); ++i) x[i] = std::hypot(x[i], down[i]);
        return x;
    };
    return {length(slope), length(bend)};
}

}  // namespace

Image flipMap(const Image& reference, const Image& test, double pixelsPerDegree) {
    requireComparable(reference, test);
    constexpr double kLeastPpd = 1.0, kMostPpd = 1000.0;
    if (!(pixelsPerDegree >= kLeastPpd && pixelsPerDegree <= kMostPpd))
        throw InputError("FLIP: " + std::to_string(pixelsPerDegree) + " pixels per degree are not within 1..1000");
    const Size size{reference.width, reference.height};
    const Picture a = pictureOf(reference), b = pictureOf(test);
    const Plane colour = colourDifference(a, b, size, pixelsPerDegree);
    const Features fa = featuresOf(a[0], size, pixelsPerDegree), fb = featuresOf(b[0], size, pixelsPerDegree);
    Image map(size.width, size.height, 1);
    for (std::size_t i = 0; i < map.pixels.size(); ++i) {
        const double difference =
            static_cast<double>(std::max(std::abs(fa.edge[i] - fb.edge[i]), std::abs(fa.point[i] - fb.point[i])));
        const double feature = std::pow(difference / std::numbers::sqrt2, kFeatureExponent);
        // Section 4.3: features make a colour difference worse.
        map.pixels[i] = static_cast<float>(std::pow(static_cast<double>(colour[i]), 1.0 - feature));
    }
    return map;
}

double flip(const Image& a, const Image& b, double pixelsPerDegree) {
    const Image map = flipMap(a, b, pixelsPerDegree);
    double sum = 0.0;
    for (const float error : map.pixels) sum += static_cast<double>(error);
    return sum / static_cast<double>(map.pixels.size());
}

}  // namespace dioptre
