// What prices and errors hang on, of what a frame shows.
#pragma once

#include <array>
#include <optional>

namespace dioptre {

struct ViewClass {
    double triangles = 0.0;                      // of what one eye sees, at full detail
    double pixels = 0.0;                         // of one eye's picture
    double meanCocPx = 0.0, largestCocPx = 0.0;  // DIAMETERS of circles of confusion, >= 0, of what is seen
    double behindShare = 0.5;                    // 0..1: of what is not in focus, what lies behind it
    int eyes = 1;                                // pictures in a frame
    // `triangles` where levels of detail are drawn, at 2/8 and at 3/8 of the size; none: as many
    std::array<std::optional<double>, 2> leveled = {};

    bool operator==(const ViewClass&) const = default;
};

}  // namespace dioptre
