#include "quality/requirements.hpp"

#include <algorithm>
#include <cmath>

#include "shaders/shared/mipmap.h"

namespace dioptre {

namespace {

constexpr double kSharpRadius = 0.5 * kSharpDiameter;

double finiteRadius(double radius) {
    // Beyond any picture's width
    constexpr double kMost = 1e5;
    return std::isfinite(radius) ? std::clamp(radius, -kMost, kMost) : kMost;
}

}  // namespace

CocRange cocRange(const Lens& lens, double focalLengthPixels, Dioptres nearest, Dioptres farthest) {
    const double a = cocRadiusPixels(lens, focalLengthPixels, nearest);
    const double b = cocRadiusPixels(lens, focalLengthPixels, farthest);
    return {std::min(a, b), std::max(a, b)};
}

PixelStatistics pixelStatistics(std::span<const CocBin> histogram) {
    PixelStatistics result;
    double all = 0.0, sum = 0.0;
    for (const CocBin& bin : histogram) {
        if (!(bin.pixels > 0.0)) continue;
        const double middle = 0.5 * (bin.least + bin.most);
        all += bin.pixels;
        sum += bin.pixels * 2.0 * std::abs(middle);
        if (middle < -kSharpRadius) result.inFront += bin.pixels;
        if (middle > kSharpRadius) result.behind += bin.pixels;
        if (!result.range) result.range = CocRange{bin.least, bin.most};
        result.range->nearest = std::min(result.range->nearest, bin.least);
        result.range->farthest = std::max(result.range->farthest, bin.most);
    }
    if (!result.range) return result;
    result.inFront /= all;
    result.behind /= all;
    result.meanDiameter = sum / all;
    result.largestDiameter = 2.0 * std::max(std::abs(result.range->nearest), std::abs(result.range->farthest));
    return result;
}

Requirements require(const ViewFacts& facts) {
    Requirements r;
    const auto omit = [&](std::string_view what, std::string_view why) { r.omitted.push_back({what, why}); };
    const CocRange range = facts.boxes.value_or(CocRange{});
    r.largestInFront = std::max(0.0, finiteRadius(-range.nearest));
    r.largestBehind = std::max(0.0, finiteRadius(range.farthest));
    r.foreground = r.largestInFront > kSharpRadius;
    r.blur = r.foreground || r.largestBehind > kSharpRadius;
    r.mayRefine = !facts.moving;
    r.shapedDiscs = r.blur && facts.highlights && facts.blades >= 3;
    if (!facts.boxes) {
        omit("everything", "nothing is in view");
    } else if (!r.blur) {
        omit("blur", "no circle of confusion is wider than half a pixel");
    } else if (!r.foreground) {
        omit("foreground", "nothing in front of focus is blurred by more than half a pixel");
    }
    if (!r.blur) omit("lens samples", "in focus, eight samples antialias as well as more");
    if (r.blur && !r.shapedDiscs)
        omit("shaped highlights", facts.blades < 3 ? "the aperture is round" : "nothing in view is bright enough");
    if (!facts.transparency) omit("blended surfaces", "nothing in view is transparent");
    return r;
}

int pyramidLevels(double largestBehind, bool foreground, int all) {
    if (foreground) return all;
    const auto radius = static_cast<float>(std::max(finiteRadius(largestBehind), double{mipmap::kFrontComplete}));
    return std::min(all, std::max(static_cast<int>(mipmap::tapLevel(radius)) + 1, 2));
}

ViewClass classOf(const ViewFacts& facts, double triangles, double pixels, int eyes) {
    ViewClass view{triangles, pixels, 0.0, 0.0, 0.5, eyes};
    if (facts.pixels && facts.pixels->range) {
        const PixelStatistics& p = *facts.pixels;
        view.meanCocPx = p.meanDiameter;
        view.largestCocPx = p.largestDiameter;
        const double blurred = p.inFront + p.behind;
        view.behindShare = blurred > 0.0 ? p.behind / blurred : 0.5;
    } else if (const auto& range = facts.boxes) {
        // In diameters, as if everything between the bounds were seen equally often
        const double nearest = -finiteRadius(-range->nearest), farthest = finiteRadius(range->farthest);
        const double span = farthest - nearest;
        view.largestCocPx = 2.0 * std::max(std::abs(nearest), std::abs(farthest));
        view.meanCocPx =
            span > 0.0 ? (farthest * std::abs(farthest) - nearest * std::abs(nearest)) / span : view.largestCocPx;
        if (span > 0.0) view.behindShare = (std::max(farthest, 0.0) - std::max(nearest, 0.0)) / span;
    }
    return view;
}

}  // namespace dioptre
