#include "focus/gaze_depth.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

namespace dioptre {

namespace {

constexpr double kCut = 2.0;              // standard deviations
constexpr double kLargestSigma = 1024.0;  // px; bounds the work, far beyond any tracker's error

// A sample counts as hidden behind one that is nearer by more than this: less would not change focus (it is the dead
// zone of an eye), and a slanted surface must not hide itself.
constexpr double kHiddenDioptres = 0.25;
constexpr double kHiddenPixels = 1.0;  // and only if the two moved relative to each other by more than a pixel

constexpr double kNothing = -1.0;  // farther than the sky, and no sample

/// Whether a sample lies behind a nearer one, in the view of an eye that moves so much to the midpoint.
bool hidden(double vergence, double nearest, double pixelsPerDioptre) {
    const double nearer = nearest - vergence;
    return nearer > kHiddenDioptres && nearer * std::abs(pixelsPerDioptre) > kHiddenPixels;
}

/// The midpoint's pixels around the gaze, in which the cone is: columns and rows of its picture.
struct Cone {
    glm::dvec2 gaze, sigma;
    int left, right, top, bottom;  // the last ones included

    double weight(int x, int y) const {
        const glm::dvec2 d = (glm::dvec2(x, y) + 0.5 - gaze) / sigma;
        const double squared = glm::dot(d, d);
        return squared <= kCut * kCut ? std::exp(-0.5 * squared) : 0.0;
    }
};

/// What the midpoint sees in one row of the cone, told from one eye's picture: the nearest of what lands in a pixel.
std::vector<double> rowFrom(const EyeVergence& eye, const Cone& cone, int y) {
    const auto count = static_cast<std::size_t>(cone.right - cone.left + 1);
    std::vector<double> row(count, kNothing);
    if (y < eye.region.y || y >= eye.region.y + eye.region.height) return row;
    const std::size_t first = static_cast<std::size_t>(y - eye.region.y) * static_cast<std::size_t>(eye.region.width);
    for (int column = 0; column < eye.region.width; ++column) {
        const double vergence = static_cast<double>(eye.vergence[first + static_cast<std::size_t>(column)]);
        if (!std::isfinite(vergence) || vergence < 0.0) continue;
        const double x = std::floor(eye.region.x + column + 0.5 + eye.toMidpoint.pixelsPerDioptre * vergence +
                                    eye.toMidpoint.pixels - cone.left);
        if (!(x >= 0.0 && x < static_cast<double>(count))) continue;
        double& nearest = row[static_cast<std::size_t>(x)];
        nearest = std::max(nearest, vergence);
    }
    // Where a near surface is stretched, its samples land up to two pixels apart: between two of them it is, too.
    const std::vector<double> landed = row;
    for (std::size_t i = 1; i + 1 < count; ++i) {
        const double between = std::min(landed[i - 1], landed[i + 1]);
        if (hidden(landed[i], between, eye.toMidpoint.pixelsPerDioptre)) row[i] = between;
    }
    // What a near thing hides from this eye alone is as far away as the farther of what is beside it.
    std::size_t last = count;
    for (std::size_t i = 0; i < count; ++i) {
        if (row[i] == kNothing) continue;
        for (std::size_t gap = last + 1; last < count && gap < i; ++gap) row[gap] = std::min(row[last], row[i]);
        last = i;
    }
    return row;
}

struct Seen {
    double vergence = 0.0;
    double weight = 0.0;
};

/// Both eyes' rows share the weight of a pixel. What only one of them sees (the picture ends for the other) hides what
/// the other one sees behind it, but for the pixel at its rim, which they may see differently.
void addRow(std::span<const EyeVergence> eyes, const Cone& cone, int y, std::vector<Seen>& seen) {
    std::vector<std::vector<double>> rows;
    for (const EyeVergence& eye : eyes) rows.push_back(rowFrom(eye, cone, y));
    const auto visible = [&](std::size_t e, std::size_t i) {
        if (rows[e][i] == kNothing) return false;
        for (std::size_t other = 0; other < rows.size(); ++other) {
            const std::vector<double>& row = rows[other];
            if (other == e || i == 0 || i + 1 == row.size()) continue;
            const double nearest = std::min({row[i - 1], row[i], row[i + 1]});
            if (hidden(rows[e][i], nearest, eyes[e].toMidpoint.pixelsPerDioptre)) return false;
        }
        return true;
    };
    for (int x = cone.left; x <= cone.right; ++x) {
        const auto i = static_cast<std::size_t>(x - cone.left);
        const double weight = cone.weight(x, y);
        if (weight <= 0.0) continue;
        const std::size_t before = seen.size();
        for (std::size_t e = 0; e < rows.size(); ++e)
            if (visible(e, i)) seen.push_back({rows[e][i], weight});
        for (std::size_t k = before; k < seen.size(); ++k) seen[k].weight /= static_cast<double>(seen.size() - before);
    }
}

std::optional<Dioptres> weightedMedian(std::vector<Seen>& samples) {
    std::sort(samples.begin(), samples.end(), [](const Seen& a, const Seen& b) { return a.vergence < b.vergence; });
    double total = 0.0;
    for (const Seen& s : samples) total += s.weight;
    // A tie must not depend on the last bit of a sum.
    const double half = 0.5 * total * (1.0 - 1e-9);
    double sum = 0.0;
    for (const Seen& s : samples) {
        sum += s.weight;
        if (sum >= half) return Dioptres(s.vergence);
    }
    return std::nullopt;
}

}  // namespace

MidpointShift midpointShift(const View& eye, const View& centre) {
    const glm::dvec3 right = centre.pose.orientation * glm::dvec3(1.0, 0.0, 0.0);
    const double offset = glm::dot(eye.pose.position - centre.pose.position, right);
    const double pixelsPerTangent = focalLengthPixels(eye).x;
    return {pixelsPerTangent * offset, pixelsPerTangent * (eye.frustum.left - centre.frustum.left)};
}

glm::dvec2 coneSigmaPixels(const View& view, Radians error) {
    return focalLengthPixels(view) * std::tan(error.value);
}

PixelRegion gazeRegion(const View& eye, const MidpointShift& toMidpoint, glm::dvec2 gaze, glm::dvec2 coneSigma,
                       Dioptres nearest) {
    const glm::dvec2 reach = kCut * glm::clamp(coneSigma, 0.5, kLargestSigma);
    const double nearestShift = toMidpoint.pixelsPerDioptre * nearest.value;
    const double left = gaze.x - reach.x - toMidpoint.pixels - std::max(0.0, nearestShift);
    const double right = gaze.x + reach.x - toMidpoint.pixels - std::min(0.0, nearestShift);
    const double top = gaze.y - reach.y, bottom = gaze.y + reach.y;
    if (!std::isfinite(left + right + top + bottom)) return {};
    const auto first = [](double edge, int size) {
        return static_cast<int>(std::floor(std::clamp(edge, 0.0, static_cast<double>(size))));
    };
    const auto last = [](double edge, int size) {
        return static_cast<int>(std::ceil(std::clamp(edge, 0.0, static_cast<double>(size))));
    };
    PixelRegion region{first(left, eye.width), first(top, eye.height), 0, 0};
    region.width = last(right, eye.width) - region.x;
    region.height = last(bottom, eye.height) - region.y;
    return region.empty() ? PixelRegion{} : region;
}

std::optional<Dioptres> gazeVergence(std::span<const EyeVergence> eyes, glm::dvec2 gaze, glm::dvec2 coneSigma) {
    if (!std::isfinite(gaze.x) || !std::isfinite(gaze.y) || std::isnan(coneSigma.x) || std::isnan(coneSigma.y))
        return std::nullopt;
    // Half a pixel: the pixel under the gaze always counts.
    const glm::dvec2 sigma = glm::clamp(coneSigma, 0.5, kLargestSigma);

    const glm::dvec2 reach = kCut * sigma;
    // Outside of what a picture can have nothing lands.
    constexpr double kFarthest = 1e8;
    if (std::abs(gaze.x) > kFarthest || std::abs(gaze.y) > kFarthest) return std::nullopt;
    // A pixel more to either side, for the neighbours
    const Cone cone{gaze,
                    sigma,
                    static_cast<int>(std::floor(gaze.x - reach.x)) - 1,
                    static_cast<int>(std::floor(gaze.x + reach.x)) + 1,
                    static_cast<int>(std::floor(gaze.y - reach.y)),
                    static_cast<int>(std::floor(gaze.y + reach.y))};
    for ([[maybe_unused]] const EyeVergence& eye : eyes)
        assert(eye.region.empty() || eye.vergence.size() == static_cast<std::size_t>(eye.region.width) *
                                                                static_cast<std::size_t>(eye.region.height));
    std::vector<Seen> seen;
    for (int y = cone.top; y <= cone.bottom; ++y) addRow(eyes, cone, y, seen);
    return weightedMedian(seen);
}

}  // namespace dioptre
