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

std::string_view techniqueName(TechniqueChoice choice) {
    switch (choice) {
        case TechniqueChoice::pinhole:
            return "pinhole";
        case TechniqueChoice::mipmap:
            return "mipmap";
        case TechniqueChoice::accumulate:
            return "accumulate";
        case TechniqueChoice::reference:
            return "reference";
    }
    return "";
}

int defaultSamples(TechniqueChoice choice) {
    // As published: [HA90] as Lee, Eisemann, Seidel 2009 use it, [JKLL13]
    constexpr int kReference = 512, kAccumulate = 32;
    return choice == TechniqueChoice::accumulate ? kAccumulate : kReference;
}

bool usesMsaa(TechniqueChoice choice) {
    return choice == TechniqueChoice::pinhole || choice == TechniqueChoice::mipmap;
}

bool usesLevels(TechniqueChoice choice) {
    return choice == TechniqueChoice::accumulate;
}

std::vector<std::pair<std::string_view, int>> TechniqueDials::dials() const {
    std::vector<std::pair<std::string_view, int>> list;
    if (msaa) list.emplace_back("msaa", *msaa);
    if (samples) list.emplace_back("samples", *samples);
    if (subsamples) list.emplace_back("subsamples", *subsamples);
    return list;
}

void TechniqueDials::apply(EyeFrame& frame) const {
    if (msaa) frame.msaa = *msaa;
    if (samples) frame.samples = *samples;
    if (subsamples) frame.subsamples = *subsamples;
}

std::vector<TechniqueDials> measuredDials() {
    std::vector<TechniqueDials> all;
    for (const TechniqueChoice choice : {TechniqueChoice::pinhole, TechniqueChoice::mipmap})
        for (const int msaa : {0, 4}) all.push_back({choice, msaa, {}, {}});
    for (const auto& [samples, subsamples] : {std::pair(8, 8), {16, 4}, {32, 4}, {64, 0}})
        all.push_back({TechniqueChoice::accumulate, {}, samples, subsamples});
    for (const int samples : {4, 16, 64}) all.push_back({TechniqueChoice::reference, {}, samples, {}});
    return all;
}

CocTransform cocTransform(const EyeFrame& frame) {
    return cocFromDepth(frame.lens, focalLengthPixels(frame.view).x, frame.view.near);
}

}  // namespace dioptre
