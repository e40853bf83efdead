// The reference: the mean of pictures through many points of the lens.
// Haeberli, Akeley 1990, "The Accumulation Buffer". The points and their projections: optics/lens_samples.hpp.
//
// Each sample has its own sub-pixel jitter, so edges are antialiased and msaa is not used. Sums are 32-bit floats.
// Textures are read finer as the samples grow: the samples filter them, a level of 1/2 log2 N is theirs.
// Blended surfaces are blended at each point of the lens, over what is seen through them from there: every surface has
// its own blur, before and behind focus.
// The sequence nests: more samples only add to the picture. Memory does not grow with their number.
#pragma once

#include "render/geometry_pass.hpp"
#include "render/sample_sum.hpp"
#include "render/show_pass.hpp"
#include "render/technique.hpp"

namespace dioptre {

class Reference final : public Technique {
  public:
    const Texture& draw(const EyeFrame& frame) override;
    double progress() const override { return showsStage_ ? 1.0 : sum_.progress(); }
    const Texture& depth() const override { return layers_.depths(); }
    std::size_t bytes() const override { return geometry_.bytes() + layers_.bytes() + sum_.bytes(); }
    /// Each sample is read once, the sum once.
    std::optional<double> fetchesPerPixel() const override { return sum_.drawn() + 1.0; }

  private:
    void addBatch(const EyeFrame& frame, int count);

    DrawList list_;
    int arranged_ = 0;  // matrices that the list is arranged for
    bool showsStage_ = false;
    SampleLayers layers_{"reference samples"};
    SampleSum sum_;
    GeometryPass geometry_;  // for --show
    ShowPass show_;
};

}  // namespace dioptre
