// What becomes of the faces around a vertex v that is moved onto one of its neighbours: whether they stay sound, and
// how far the surface moves. Plain arithmetic, for the simplifier.
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>

namespace dioptre {

/// Vertices with more neighbours wait until they have fewer.
constexpr std::size_t kMostNeighbours = 32;

/// The faces F_i = (v, ring i, ring i+1) around v at the origin, which is to become ring 0. What is left of them then
/// is G_i = (ring 0, ring i, ring i+1), for 0 < i < count - 1.
struct Fan {
    std::size_t count = 0;  // of neighbours, at least 3
    bool open = false;      // v is on a border, between the last and the first of the ring, on a straight line
    std::array<glm::dvec3, kMostNeighbours> ring;

    std::size_t faces() const { return open ? count - 1 : count; }
    std::size_t after(std::size_t i) const { return i + 1 == count ? 0 : i + 1; }
};

/// Whether the new faces lie over the old ones as over a map, none turned far, none much thinner than those before.
class FanChange {
  public:
    explicit FanChange(const Fan& fan);
    bool sound() const { return sound_; }

    /// Upper bounds of how far the points of the new faces are from level 0, and the points of level 0 that they stand
    /// for from them, given those of the old faces. Result i is that of G_i.
    std::array<float, kMostNeighbours> errors(const std::array<float, kMostNeighbours>& before) const;

  private:
    bool project();
    bool facesStaySound() const;
    bool lieOverMap() const;
    std::size_t sectorOfVertex() const;
    double heightOverSector(std::size_t sector) const;
    double gap(std::size_t oldSpoke, std::size_t newSpoke, std::size_t sector) const;

    const Fan& fan_;
    std::array<glm::dvec3, kMostNeighbours> map_;  // x, y in the map's plane, z above it
    bool sound_ = false;
};

}  // namespace dioptre
