// The neighbours of a vertex, and what its corners show once it is moved onto one of them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "scene/fan.hpp"
#include "scene/weld.hpp"

namespace dioptre {

/// Neighbours of a point in order; face i lies between the neighbours i and i + 1.
struct Ring {
    std::uint32_t centre = 0;
    std::size_t count = 0;
    bool open = false;      // the centre is on a border, between the last and the first
    bool mirrored = false;  // clockwise, seen from the front
    std::array<std::uint32_t, kMostNeighbours> point, face;

    std::size_t faces() const { return open ? count - 1 : count; }
    /// The same, beginning at neighbour `first`; of an open one an end.
    Ring startingAt(std::size_t first) const;
};

inline std::uint32_t wedgeAt(const WeldedFace& face, std::uint32_t point) {
    return face.wedge[face.point[0] == point ? 0 : face.point[1] == point ? 1 : 2];
}

/// What the centre's corners show once it is moved onto the ring's first point: the vertex of the removed face on their
/// side.
struct WedgeMove {
    struct Side {
        std::uint32_t before, after;  // of the corners at the centre
        std::uint32_t previous;       // at the other neighbour on the seam or border
    };
    std::array<Side, 2> sides;  // of a seam; of a border and elsewhere only the first counts
    std::size_t count = 0;      // of sides that lie along a seam or border: none, one (a border) or two
    std::size_t behind = 0;     // in the ring: the other neighbour on the seam or border

    std::uint32_t after(std::uint32_t before) const {
        return before == sides[0].before ? sides[0].after : sides[1].after;
    }
};

/// None where that would tear a seam or move it aside.
std::optional<WedgeMove> wedgeMove(const Ring& ring, const std::vector<WeldedFace>& faces);

}  // namespace dioptre
