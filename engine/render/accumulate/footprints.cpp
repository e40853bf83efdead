#include "render/accumulate/footprints.hpp"

#include <algorithm>
#include <cmath>

#include "shaders/shared/accumulate_types.h"

namespace dioptre {

int Footprints::parts() const {
    if (!wide) return gpu::kSharp + 1;
    return (inFront ? gpu::kCoarseInFront : gpu::kCoarseBehind) + 1;
}

std::vector<std::string> Footprints::defines() const {
    std::vector<std::string> all;
    if (wide) all.emplace_back("WIDE");
    if (inFront) all.emplace_back("IN_FRONT");
    return all;
}

Footprints requiredFootprints(const View& view, const Lens& lens, double points, std::span<const DrawList::Seen> seen) {
    const glm::dvec2 f = focalLengthPixels(view);
    // The background counts, too: it is seen wherever nothing is. Nothing behind focus is more blurred.
    const double background = cocRadiusPixels(lens, f.x, Dioptres(0.0));
    double inFront = std::max(0.0, -background);
    for (const DrawList::Seen& item : seen) {
        const Dioptres nearest(1.0 / std::max(view.near.value, item.box.nearest()));
        inFront = std::max(inFront, -cocRadiusPixels(lens, f.x, nearest));
    }
    Footprints result;
    // Where pixels are not square footprints are as narrow as along the axis with less blur.
    const double narrower = std::min(1.0, f.y / f.x);
    result.variance = std::min(kFootprint / points, kMostFootprint) * narrower * narrower;
    const auto wide = [&](double radius) { return radius * radius * result.variance > kLeastVariance; };
    result.inFront = wide(inFront);
    result.wide = result.inFront || wide(std::max(0.0, background));
    return result;
}

double splineVariance(int level) {
    const double pixels = std::exp2(2.0 * level);
    return pixels / 3.0 + (pixels - 1.0) / 12.0;
}

const Texture& FootprintPass::draw(SampleSum& sum, const Footprints& footprints) {
    FullscreenPass& pass = footprints.inFront ? all_ : behind_;
    if (!pass.program()) pass = FullscreenPass("accumulate/footprints.frag.glsl", footprints.defines());
    return sum.mean(pass);
}

}  // namespace dioptre
