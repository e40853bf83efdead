// Everything sharp, also what is seen through blended surfaces: the price and the picture that all other techniques are
// compared with.
#pragma once

#include "render/geometry_pass.hpp"
#include "render/show_pass.hpp"
#include "render/technique.hpp"

namespace dioptre {

class Pinhole final : public Technique {
  public:
    const Texture& draw(const EyeFrame& frame) override;
    const Texture& depth() const override { return geometry_.depth(); }
    std::size_t bytes() const override { return geometry_.bytes(); }
    std::optional<double> fetchesPerPixel() const override { return GeometryPass::fetchesPerPixel(msaa_); }

  private:
    int msaa_ = 0;  // of the last picture
    GeometryPass geometry_;
    ShowPass show_;
};

}  // namespace dioptre
