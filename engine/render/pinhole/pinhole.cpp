#include "render/pinhole/pinhole.hpp"

namespace dioptre {

const Texture& Pinhole::draw(const EyeFrame& frame) {
    msaa_ = frame.msaa;
    geometry_.draw(frame);
    if (frame.show.stage != ShowChoice::none) return show_.draw(frame, geometry_.depth());
    return geometry_.color();
}

}  // namespace dioptre
