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

/// A sample that falls into the cone, in cells of one pixel around the gaze in the midpoint view.
struct Landed {
    double vergence = 0.0;
    double weight = 0.0;
    int cellX = 0, cellY = 0;
    double pixelsPerDioptre = 0.0;  // of its eye, without sign
};

void landInCone(const EyeVergence& eye, glm::dvec2 gaze, glm::dvec2 sigma, std::vector<Landed>& landed) {
    assert(eye.region.empty() || eye.vergence.size() == static_cast<std::size_t>(eye.region.width) *
                                                            static_cast<std::size_t>(eye.region.height));
    for (int row = 0; row < eye.region.height; ++row) {
        const double y = eye.region.y + row + 0.5 - gaze.y;
        if (std::abs(y) > kCut * sigma.y) continue;
        for (int column = 0; column < eye.region.width; ++column) {
            const double vergence = static_cast<double>(
                eye.vergence[static_cast<std::size_t>(row) * static_cast<std::size_t>(eye.region.width) +
                             static_cast<std::size_t>(column)]);
            if (!std::isfinite(vergence) || vergence < 0.0) continue;
            const double x = eye.region.x + column + 0.5 + eye.toMidpoint.pixelsPerDioptre * vergence +
                             eye.toMidpoint.pixels - gaze.x;
            const double squared = (x / sigma.x) * (x / sigma.x) + (y / sigma.y) * (y / sigma.y);
            if (!(squared <= kCut * kCut)) continue;
            landed.push_back({vergence, std::exp(-0.5 * squared), static_cast<int>(std::floor(x)),
                              static_cast<int>(std::floor(y)), std::abs(eye.toMidpoint.pixelsPerDioptre)});
        }
    }
}

/// The nearest vergence in each cell, to tell what the midpoint cannot see.
class NearestInCell {
  public:
    explicit NearestInCell(std::span<const Landed> samples) {
        int right = -1, bottom = -1;
        if (!samples.empty()) left_ = right = samples[0].cellX, top_ = bottom = samples[0].cellY;
        for (const Landed& s : samples) {
            left_ = std::min(left_, s.cellX), right = std::max(right, s.cellX);
            top_ = std::min(top_, s.cellY), bottom = std::max(bottom, s.cellY);
        }
        width_ = right - left_ + 1;
        cells_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(bottom - top_ + 1), 0.0);
        for (const Landed& s : samples) {
            double& nearest = cells_[index(s.cellX, s.cellY)];
            nearest = std::max(nearest, s.vergence);
        }
    }

    bool hides(const Landed& s) const {
        // One cell to either side: where a near surface is stretched, its samples land up to two pixels apart.
        double nearest = 0.0;
        for (int x = std::max(s.cellX - 1, left_); x <= std::min(s.cellX + 1, left_ + width_ - 1); ++x)
            nearest = std::max(nearest, cells_[index(x, s.cellY)]);
        const double nearer = nearest - s.vergence;
        return nearer > kHiddenDioptres && nearer * s.pixelsPerDioptre > kHiddenPixels;
    }

  private:
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y - top_) * static_cast<std::size_t>(width_) +
               static_cast<std::size_t>(x - left_);
    }

    int left_ = 0, top_ = 0, width_ = 0;
    std::vector<double> cells_;
};

std::optional<Dioptres> weightedMedian(std::vector<Landed>& samples) {
    std::sort(samples.begin(), samples.end(), [](const Landed& a, const Landed& b) { return a.vergence < b.vergence; });
    double total = 0.0;
    for (const Landed& s : samples) total += s.weight;
    // A tie must not depend on the last bit of a sum.
    const double half = 0.5 * total * (1.0 - 1e-9);
    double sum = 0.0;
    for (const Landed& s : samples) {
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

    std::vector<Landed> samples;
    for (const EyeVergence& eye : eyes) landInCone(eye, gaze, sigma, samples);
    const NearestInCell nearest(samples);
    std::erase_if(samples, [&](const Landed& s) { return nearest.hides(s); });
    return weightedMedian(samples);
}

}  // namespace dioptre
