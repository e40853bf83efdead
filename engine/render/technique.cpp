#include "render/technique.hpp"

#include "render/accumulate/accumulate.hpp"
#include "render/mipmap/mipmap.hpp"
#include "render/pinhole/pinhole.hpp"
#include "render/reference/reference.hpp"

namespace dioptre {

std::unique_ptr<Technique> makeTechnique(TechniqueChoice choice) {
    switch (choice) {
        case TechniqueChoice::pinhole:
            return std::make_unique<Pinhole>();
        case TechniqueChoice::mipmap:
            return std::make_unique<Mipmap>();
        case TechniqueChoice::accumulate:
            return std::make_unique<Accumulate>();
        case TechniqueChoice::reference:
            return std::make_unique<Reference>();
    }
    return nullptr;
}

void apply(const Plan& plan, EyeFrame& frame) {
    if (plan.msaa) frame.msaa = *plan.msaa;
    if (plan.samples) frame.samples = *plan.samples;
    if (plan.subsamples) frame.subsamples = *plan.subsamples;
    frame.detailPx = detailPx(plan);
}

std::vector<Plan> measuredPlans() {
    std::vector<Plan> all;
    for (const TechniqueChoice choice : {TechniqueChoice::pinhole, TechniqueChoice::mipmap})
        for (const int msaa : {0, 4}) all.push_back({choice, msaa, {}, {}});
    for (const auto& [samples, subsamples] : {std::pair(8, 4), {8, 8}, {16, 4}, {32, 4}, {64, 0}})
        all.push_back({TechniqueChoice::accumulate, {}, samples, subsamples});
    for (const int samples : {4, 16, 64}) all.push_back({TechniqueChoice::reference, {}, samples, {}});
    return all;
}

CocTransform cocTransform(const EyeFrame& frame) {
    return cocFromDepth(frame.lens, focalLengthPixels(frame.view).x, frame.view.near);
}

}  // namespace dioptre
