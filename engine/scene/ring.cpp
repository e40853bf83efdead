#include "scene/ring.hpp"

namespace dioptre {

Ring Ring::startingAt(std::size_t first) const {
    if (first == 0) return *this;
    Ring ring = *this;
    if (open) {
        ring.mirrored = !mirrored;
        for (std::size_t i = 0; i < count; ++i) ring.point[i] = point[count - 1 - i];
        for (std::size_t i = 0; i < faces(); ++i) ring.face[i] = face[faces() - 1 - i];
        return ring;
    }
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t from = (i + first) % count;
        ring.point[i] = point[from];
        ring.face[i] = face[from];
    }
    return ring;
}

std::optional<WedgeMove> wedgeMove(const Ring& ring, const std::vector<WeldedFace>& faces) {
    const std::size_t last = ring.faces() - 1;
    const auto show = [&](std::size_t face, std::uint32_t point) { return wedgeAt(faces[ring.face[face]], point); };
    // Where its two faces show different vertices, the edge to a neighbour is on a seam
    std::size_t seams = 0, behind = ring.count - 1;
    bool aheadIsSeam = false;
    for (std::size_t i = ring.open ? 1 : 0; i <= last; ++i) {
        const std::size_t before = i == 0 ? last : i - 1;
        if (show(before, ring.centre) == show(i, ring.centre) && show(before, ring.point[i]) == show(i, ring.point[i]))
            continue;
        ++seams;
        if (i == 0) aheadIsSeam = true;
        if (i > 0) behind = i;
    }
    WedgeMove move;
    move.behind = behind;
    const std::uint32_t target = ring.point[0], previous = ring.point[behind];
    move.sides[0] = {show(0, ring.centre), show(0, target), 0};
    move.sides[1] = {show(last, ring.centre), show(last, target), 0};
    if (ring.open) {
        if (seams > 0) return std::nullopt;
        move.sides[0].previous = show(last, previous);
        move.sides[1] = move.sides[0];
        move.count = 1;
        return move;
    }
    if (seams == 0) return move;
    // Along the seam or not at all; a seam's end, and where more than two sides meet, stays
    if (seams != 2 || !aheadIsSeam || move.sides[0].before == move.sides[1].before) return std::nullopt;
    move.sides[0].previous = show(behind - 1, previous);
    move.sides[1].previous = show(behind, previous);
    move.count = 2;
    return move;
}

}  // namespace dioptre
