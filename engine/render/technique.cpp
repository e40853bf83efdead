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

CocTransform cocTransform(const EyeFrame& frame) {
    return cocFromDepth(frame.lens, focalLengthPixels(frame.view).x, frame.view.near);
}

}  // namespace dioptre
