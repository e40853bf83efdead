#include "render/technique.hpp"

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
        case TechniqueChoice::reference:
            return "reference";
    }
    return "";
}

std::vector<std::pair<std::string_view, int>> TechniqueDials::dials() const {
    std::vector<std::pair<std::string_view, int>> list;
    if (msaa) list.emplace_back("msaa", *msaa);
    if (samples) list.emplace_back("samples", *samples);
    return list;
}

void TechniqueDials::apply(EyeFrame& frame) const {
    if (msaa) frame.msaa = *msaa;
    if (samples) frame.samples = *samples;
}

std::vector<TechniqueDials> measuredDials() {
    std::vector<TechniqueDials> all;
    for (const TechniqueChoice choice : {TechniqueChoice::pinhole, TechniqueChoice::mipmap})
        for (const int msaa : {0, 4}) all.push_back({choice, msaa, {}});
    for (const int samples : {4, 16, 64}) all.push_back({TechniqueChoice::reference, {}, samples});
    return all;
}

CocTransform cocTransform(const EyeFrame& frame) {
    return cocFromDepth(frame.lens, focalLengthPixels(frame.view).x, frame.view.near);
}

}  // namespace dioptre
