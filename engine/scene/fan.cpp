// Cohen, Manocha, Olano 1997, "Simplifying polygonal models using successive mappings": old and new faces overlaid in a
// plane. Klein, Liebich, Strasser 1996, "Mesh reduction with error control": the distance from the first surface,
// carried along from step to step.
//
// Both fans are seen along the normal n of their common border, the sum of the faces' vector areas, which is the same
// for both. Where all faces of both look up, seeing along n relates each point of one fan to one of the other. The
// heights of both are linear in each cell of the overlay, so that they differ most at its corners: where v is, and
// where old spokes (from v) cross new ones (from ring 0); on the border they do not differ. If all points of the old
// face F were within e(F) of what they stand for at level 0, those of the new face G are within
//   e(G) = max over old faces F that G overlaps of  e(F) + max over corners of the cell of the height difference.
#include "scene/fan.hpp"

#include <algorithm>
#include <cmath>

namespace dioptre {

namespace {

constexpr double kLeastTurnCosine = 0.3;  // of a face: less than 73 degrees
// Of 1 for an equilateral triangle: below it a new face must not be thinner than the thinnest before.
constexpr double kThin = 0.1;

double cross2(const glm::dvec3& a, const glm::dvec3& b) {
    return a.x * b.y - a.y * b.x;
}

// 4 sqrt(3) area / sum of squared edges
double shapeOf(const glm::dvec3& a, const glm::dvec3& b, double twiceArea) {
    const glm::dvec3 c = b - a;
    return 3.4641016 * twiceArea / (glm::dot(a, a) + glm::dot(b, b) + glm::dot(c, c));
}

}  // namespace

FanChange::FanChange(const Fan& fan) : fan_(fan) {
    sound_ = project() && facesStaySound();
}

bool FanChange::project() {
    glm::dvec3 n(0.0);
    double area = 0.0;
    for (std::size_t i = 0; i < fan_.faces(); ++i) {
        const glm::dvec3 vector = glm::cross(fan_.ring[i], fan_.ring[fan_.after(i)]);
        n += vector;
        area += glm::length(vector);
    }
    const double length = glm::length(n);
    // Of a sheet folded flat no direction sees both sides
    if (!(length > 1e-3 * area)) return false;
    n /= length;
    const glm::dvec3 helper = std::abs(n.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 x = glm::normalize(glm::cross(helper, n)), y = glm::cross(n, x);
    for (std::size_t i = 0; i < fan_.count; ++i)
        map_[i] = {glm::dot(fan_.ring[i], x), glm::dot(fan_.ring[i], y), glm::dot(fan_.ring[i], n)};
    return true;
}

bool FanChange::facesStaySound() const {
    const glm::dvec3& target = fan_.ring[0];
    double thinnest = kThin;
    for (std::size_t i = 0; i < fan_.faces(); ++i) {
        const glm::dvec3 &a = fan_.ring[i], &b = fan_.ring[fan_.after(i)];
        thinnest = std::min(thinnest, shapeOf(a, b, glm::length(glm::cross(a, b))));
    }
    for (std::size_t i = 1; i + 1 < fan_.count; ++i) {
        if (!(cross2(map_[i] - map_[0], map_[i + 1] - map_[0]) > 0.0)) return false;
        const glm::dvec3 before = glm::cross(fan_.ring[i], fan_.ring[i + 1]);
        const glm::dvec3 a = fan_.ring[i] - target, b = fan_.ring[i + 1] - target;
        const glm::dvec3 after = glm::cross(a, b);
        const double area = glm::length(after);
        if (!(glm::dot(before, after) >= kLeastTurnCosine * glm::length(before) * area)) return false;
        if (!(shapeOf(a, b, area) >= thinnest)) return false;
    }
    return true;
}

/// Whether the old faces do, too: all look up, and they go around v once.
bool FanChange::lieOverMap() const {
    int turns = 0;
    for (std::size_t i = 0; i < fan_.faces(); ++i) {
        const glm::dvec3 &a = map_[i], &b = map_[fan_.after(i)];
        if (!(cross2(a, b) > 0.0)) return false;
        turns += a.y < 0.0 && b.y >= 0.0 ? 1 : 0;
    }
    return turns <= 1;
}

/// The new face that v lies over: sector j is G_j, between the new spokes j and j + 1.
std::size_t FanChange::sectorOfVertex() const {
    if (fan_.open) return fan_.count - 2;
    std::size_t best = 1;
    double most = -1e300;
    for (std::size_t j = 1; j + 1 < fan_.count; ++j) {
        const glm::dvec3 a = map_[j] - map_[0], b = map_[j + 1] - map_[0];
        const double area = cross2(a, b);
        const double least = std::min(cross2(a, -map_[0]), cross2(-map_[0], b)) / area;
        if (least > most) {
            most = least;
            best = j;
        }
    }
    return best;
}

double FanChange::heightOverSector(std::size_t sector) const {
    const glm::dvec3 a = map_[sector] - map_[0], b = map_[sector + 1] - map_[0];
    const double area = cross2(a, b);
    const double s = std::clamp(cross2(-map_[0], b) / area, 0.0, 1.0);
    const double t = std::clamp(cross2(a, -map_[0]) / area, 0.0, 1.0);
    // At the border: the distance from the straight line
    if (fan_.open) return glm::length(map_[0] + t * b);
    return std::abs(map_[0].z + s * a.z + t * b.z);
}

/// Between the two surfaces where the old spoke crosses the new one; 0 where they do not cross.
double FanChange::gap(std::size_t oldSpoke, std::size_t newSpoke, std::size_t sector) const {
    // The old one starts in `sector` and ends where new spoke `oldSpoke` does.
    const std::size_t i = oldSpoke == fan_.count ? 0 : oldSpoke, j = newSpoke;
    const bool crosses = i > 0 && j > 1 && j + 1 < fan_.count && ((j > sector && j < i) || (j > i && j <= sector));
    if (!crosses) return 0.0;
    const glm::dvec3 &to = map_[i], along = map_[j] - map_[0];
    const double scale = cross2(to, along);
    if (std::abs(scale) < 1e-12 * (glm::length(to) * glm::length(along))) return glm::length(fan_.ring[0]);
    const double t = std::clamp(cross2(map_[0], along) / scale, 0.0, 1.0);
    const double s = std::clamp(cross2(map_[0], to) / scale, 0.0, 1.0);
    return std::abs(t * to.z - (map_[0].z + s * along.z));
}

std::array<float, kMostNeighbours> FanChange::errors(const std::array<float, kMostNeighbours>& before) const {
    const std::size_t last = fan_.count - 2;
    std::array<double, kMostNeighbours> error{}, plain{};
    // Another relation holds always: each point goes with v, as far as it is of v.
    const double way = glm::length(fan_.ring[0]);
    double worst = 0.0, worstPlain = 0.0;
    for (std::size_t i = 0; i < fan_.faces(); ++i) {
        double& e = plain[std::clamp<std::size_t>(i, 1, last)];
        e = std::max(e, before[i] + way);
        worstPlain = std::max(worstPlain, e);
    }
    if (lieOverMap()) {
        const std::size_t sector = sectorOfVertex();
        const double atVertex = heightOverSector(sector);
        for (std::size_t i = 0; i < fan_.faces(); ++i) {
            const std::size_t own = std::clamp<std::size_t>(i, 1, last);
            for (std::size_t j = std::min(sector, own); j <= std::max(sector, own); ++j) {
                double most = j == sector ? atVertex : 0.0;
                for (const std::size_t spoke : {i, i + 1})
                    most = std::max({most, gap(spoke, j, sector), gap(spoke, j + 1, sector)});
                // Off the border by rounding, all of an open fan is
                if (fan_.open) most += atVertex;
                error[j] = std::max(error[j], before[i] + most);
                worst = std::max(worst, error[j]);
            }
        }
    } else {
        worst = worstPlain + 1.0;
    }
    const auto& chosen = worst < worstPlain ? error : plain;
    std::array<float, kMostNeighbours> result{};
    for (std::size_t i = 1; i <= last; ++i) result[i] = static_cast<float>(chosen[i]);
    return result;
}

}  // namespace dioptre
