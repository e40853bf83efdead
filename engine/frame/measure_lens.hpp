// The lenses that `dioptre measure` looks through, chosen so that scenes of any size get comparable blurs.
// By optics/lens.hpp a circle of confusion has the radius c = E f_px (Df - D). For a mean |c| over the visible pixels
//   E = mean|c| / (f_px mean|Df - D|).
// Blurs are named by DIAMETERS, 2 |c|.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "optics/lens.hpp"

namespace dioptre {

/// A blur by the mean DIAMETER of the circles of confusion, px in a picture 640 px wide; wider ones have as much more.
struct MeasuredBlur {
    std::string_view name;
    double meanDiameterPx = 0.0;
};
// Two pixels: a wide pupil in a room. Eight: the pictures of papers on depth of field. Twenty: a fast lens close up,
// where techniques come apart.
inline constexpr MeasuredBlur kMeasuredBlurs[] = {{"small", 2.0}, {"paper", 8.0}, {"strong", 20.0}};
inline constexpr double kMeasuredWidth = 640.0;

/// Where focus is, as a share of the visible pixels that are farther.
struct MeasuredFocus {
    std::string_view name;
    double share = 0.0;
};
inline constexpr MeasuredFocus kMeasuredFocuses[] = {{"near", 0.85}, {"far", 0.15}};

/// Of visible pixels' vergences, D >= 0.
struct VergenceStatistics {
    std::vector<double> sorted;

    explicit VergenceStatistics(std::vector<double> vergences);
    double nearest() const { return sorted.empty() ? 0.0 : sorted.back(); }
    double farthest() const { return sorted.empty() ? 0.0 : sorted.front(); }
    double at(double share) const;
    double meanDifference(double focus) const;
};

/// A round lens focused there, with that mean CoC; `width` in pixels. Nothing that can be seen has another
/// vergence than the focus: a lens of 1 mm.
Lens measuredLens(const VergenceStatistics& seen, const MeasuredFocus& focus, const MeasuredBlur& blur,
                  double focalLengthPixels, int width);

}  // namespace dioptre
