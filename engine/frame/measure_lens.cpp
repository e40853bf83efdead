#include "frame/measure_lens.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dioptre {

namespace {

// An eye's, as the other parts of the program have it: only F Df < 1 depends on it.
constexpr Metres kFocalLength{0.017};
constexpr Metres kLeastRadius{0.0005}, kMostRadius{0.5};
constexpr double kNothing = 1e-6;  // dioptres; a millionth is beyond what the depth buffer tells apart

}  // namespace

VergenceStatistics::VergenceStatistics(std::vector<double> vergences) : sorted(std::move(vergences)) {
    std::sort(sorted.begin(), sorted.end());
}

double VergenceStatistics::at(double share) const {
    if (sorted.empty()) return 0.0;
    // A vergence that is there, never a mean of two: focus lies on a surface.
    const auto last = static_cast<double>(sorted.size() - 1);
    return sorted[static_cast<std::size_t>(std::lround(std::clamp(share, 0.0, 1.0) * last))];
}

double VergenceStatistics::meanDifference(double focus) const {
    double sum = 0.0;
    for (const double d : sorted) sum += std::abs(focus - d);
    return sorted.empty() ? 0.0 : sum / static_cast<double>(sorted.size());
}

Lens measuredLens(const VergenceStatistics& seen, const MeasuredFocus& focus, const MeasuredBlur& blur,
                  double focalLengthPixels, int width) {
    Lens lens;
    lens.focalLength = kFocalLength;
    // Nearer than the focal length nothing can be in focus.
    lens.focus = Dioptres(std::min(seen.at(focus.share), 0.5 / kFocalLength.value));
    const double difference = seen.meanDifference(lens.focus.value);
    const double wanted = 0.5 * blur.meanDiameterPx * width / kMeasuredWidth;
    lens.apertureRadius = difference > kNothing
                              ? Metres(std::clamp(wanted / (focalLengthPixels * difference), 1e-6, kMostRadius.value))
                              : kLeastRadius;
    return lens;
}

}  // namespace dioptre
