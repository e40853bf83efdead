// What techniques share that average pictures through many points of the lens: layers to draw samples to, and their
// sum.
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

#include "gl/objects.hpp"
#include "gl/program.hpp"
#include "render/technique.hpp"

namespace dioptre {

/// Radiance (RGBA16F; in alpha, what blended surfaces leave of it) and reversed depth of some samples, a layer each.
class SampleLayers {
  public:
    explicit SampleLayers(std::string_view label) : label_(label) {}

    void resize(int width, int height, int layers);
    /// Makes all layers the draw target; with `clear`, black and infinitely far.
    void bind(bool clear) const;
    /// Some layers alone to black and infinitely far.
    void clear(int first, int count) const;
    const Texture& colors() const { return colors_; }
    const Texture& depths() const { return depths_; }
    std::size_t bytes() const { return colors_ ? colors_.bytes() + depths_.bytes() : 0; }

  private:
    std::string_view label_;
    Texture colors_, depths_;
    Framebuffer target_;
};

/// The sum of samples, 32-bit floats, and their mean. It can go on over several frames.
class SampleSum {
  public:
    /// Ready for more samples of `frame`: those of former frames are kept where it draws some of them at a time and
    /// nothing that the picture depends on is new.
    void begin(const EyeFrame& frame);
    /// With nothing drawn yet: the sum is kept in so many parts from now on, at first in one. `levels`: of the mipmaps
    /// that mean() makes of all but the first; 1: none. Parts are larger than the picture, right and on top, where the
    /// coarsest level would not have whole texels: what is added fills that, too.
    void divide(int parts, int levels);
    /// Calls `draw` with the number of samples, at most `most`, that it is to draw and add next, until there are as
    /// many as the frame asks for, at all or now.
    void refine(const EyeFrame& frame, int most, const std::function<void(int)>& draw);
    /// Of the samples asked for; counts those that add() and addDrawn() were told of.
    int drawn() const { return drawn_; }
    double progress() const { return static_cast<double>(drawn_) / key_.samples; }

    /// Adds the first `count` layers.
    void add(const SampleLayers& layers, int count);
    /// Adds what `pass` draws over the whole picture, to an output for each part: the sum, in rgb, of `count` samples,
    /// which together count as `weight`.
    void addDrawn(const FullscreenPass& pass, int count, int weight);
    /// Their mean, RGBA32F, where there is one part.
    const Texture& mean();
    /// What `pass` makes of the parts, bound to units 0 and on, with `scale` to multiply them by.
    const Texture& mean(const FullscreenPass& pass);
    std::size_t bytes() const;

  private:
    void allocate(int width, int height, int count, int levels);
    void clear();

    /// What the sum so far is of.
    struct Key {
        const GpuScene* scene = nullptr;
        View view;
        Lens lens;
        float exposure = 0.0f;
        int samples = 1, firstSample = 0, subsamples = 0;
        ShowStage show;
        std::uint64_t version = 0;  // of the scene

        bool operator==(const Key&) const = default;
    };

    Key key_;
    int drawn_ = 0;
    double weight_ = 0.0;
    int levels_ = 1;
    std::vector<Texture> parts_;
    Texture output_;
    Framebuffer sumTarget_, outputTarget_;
    FullscreenPass add_, mean_;
};

/// What is added to the level of textures where `samples` samples of a pixel filter them, too.
float textureLodBias(int samples);

}  // namespace dioptre
