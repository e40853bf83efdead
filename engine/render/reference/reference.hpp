// The reference: the mean of pictures through many points of the lens.
// Haeberli, Akeley 1990, "The Accumulation Buffer". The points and their projections: optics/lens_samples.hpp.
//
// Each sample has its own sub-pixel jitter, so edges are antialiased and msaa is not used. Sums are 32-bit floats.
// Textures are read finer as the samples grow: the samples filter them, a level of 1/2 log2 N is theirs.
// Blended surfaces are blended at each point of the lens, over what is seen through them from there: every surface has
// its own blur, before and behind focus.
// The sequence nests: more samples only add to the picture. Memory does not grow with their number.
#pragma once

#include "gl/program.hpp"
#include "render/geometry_pass.hpp"
#include "render/show_pass.hpp"
#include "render/technique.hpp"

namespace dioptre {

class Reference final : public Technique {
  public:
    const Texture& draw(const EyeFrame& frame) override;
    double progress() const override { return static_cast<double>(drawn_) / key_.samples; }
    std::size_t bytes() const override;
    /// Each sample is read once, the sum once.
    std::optional<double> fetchesPerPixel() const override { return drawn_ + 1.0; }

  private:
    /// What the sum so far is of.
    struct Key {
        const GpuScene* scene = nullptr;
        View view;
        Lens lens;
        float exposure = 0.0f;
        int samples = 1, firstSample = 0;
        std::uint64_t poseNumber = 0;

        bool operator==(const Key&) const = default;
    };
    void resize(int width, int height, int layers);
    void addBatch(const EyeFrame& frame, int count);

    Key key_;
    int drawn_ = 0;            // samples in the sum
    int prepared_ = 0;         // matrices that the scene is prepared for
    Texture colors_, depths_;  // a layer per sample of a batch
    Texture sum_, output_;     // RGBA32F
    Framebuffer batchTarget_, sumTarget_, outputTarget_;
    FullscreenPass accumulate_, average_;
    GeometryPass geometry_;  // for --show
    ShowPass show_;
};

}  // namespace dioptre
