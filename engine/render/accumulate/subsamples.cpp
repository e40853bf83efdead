#include "render/accumulate/subsamples.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "optics/lens_samples.hpp"

namespace dioptre {

namespace {

/// Finds the nearest of some points of the disc: about one in each cell of a grid.
class NearestPoint {
  public:
    explicit NearestPoint(std::vector<glm::dvec2> points)
        : points_(std::move(points)),
          side_(std::max(1, static_cast<int>(std::sqrt(static_cast<double>(points_.size()))))),
          cells_(static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_)) {
        for (std::size_t i = 0; i < points_.size(); ++i) {
            const glm::ivec2 cell = cellOf(points_[i]);
            at(cell).push_back(static_cast<int>(i));
        }
    }

    int nearest(glm::dvec2 p) {
        int best = 0;
        double distance = 1e9;
        const glm::ivec2 home = cellOf(p);
        // Rings of cells; those beyond the first with a point can still hold a nearer one, by a cell's diagonal.
        for (int ring = 0; ring <= side_; ++ring) {
            if ((ring - 1) * 2.0 / side_ > distance) break;
            for (int y = home.y - ring; y <= home.y + ring; ++y)
                for (int x = home.x - ring; x <= home.x + ring; ++x) {
                    const bool onRing = std::max(std::abs(x - home.x), std::abs(y - home.y)) == ring;
                    if (!onRing || x < 0 || y < 0 || x >= side_ || y >= side_) continue;
                    for (const int i : at({x, y})) {
                        const double d = glm::distance(points_[static_cast<std::size_t>(i)], p);
                        if (d < distance) {
                            distance = d;
                            best = i;
                        }
                    }
                }
        }
        return best;
    }

  private:
    glm::ivec2 cellOf(glm::dvec2 p) const {
        return glm::clamp(glm::ivec2((p + 1.0) * 0.5 * static_cast<double>(side_)), 0, side_ - 1);
    }
    std::vector<int>& at(glm::ivec2 cell) { return cells_[static_cast<std::size_t>(cell.y * side_ + cell.x)]; }

    std::vector<glm::dvec2> points_;
    int side_;
    std::vector<std::vector<int>> cells_;
};

}  // namespace

Subsamples subsamples(int samples, int perSample, const Lens& lens, int first) {
    std::vector<glm::dvec2> primaries;
    primaries.reserve(static_cast<std::size_t>(samples));
    for (int i = 0; i < samples; ++i) primaries.push_back(lensSample(first + i, lens).lens);
    NearestPoint nearest(primaries);
    std::vector<std::vector<glm::vec2>> ofPrimary(primaries.size());
    Subsamples result;
    for (int i = samples; i < samples * (perSample + 1); ++i) {
        const glm::dvec2 point = lensSample(first + i, lens).lens;
        const auto primary = static_cast<std::size_t>(nearest.nearest(point));
        const glm::dvec2 offset = point - primaries[primary];
        ofPrimary[primary].emplace_back(offset);
        result.farthest = std::max(result.farthest, glm::length(offset));
    }
    for (const auto& offsets : ofPrimary) {
        result.first.push_back(static_cast<int>(result.offsets.size()));
        result.offsets.insert(result.offsets.end(), offsets.begin(), offsets.end());
    }
    result.first.push_back(static_cast<int>(result.offsets.size()));
    return result;
}

}  // namespace dioptre
