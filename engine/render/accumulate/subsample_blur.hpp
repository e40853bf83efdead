// Sub-sample blur: what points of the lens near a primary sample's see, looked up in that sample's picture.
// [JKLL13] Jeong et al. 2013, "Real-time defocus rendering with level of detail and sub-sample blur";
// [LES09] Lee, Eisemann, Seidel 2009, "Depth-of-field rendering with multiview synthesis"; Decoret 2005, "N-buffers".
//
// Seen from v, a point with signed CoC radius c (optics/lens.hpp) is c v away from where the middle of the lens sees
// it. So what v + o sees at pixel p, v sees at p - c o: on a line whose every place belongs to one c. The first place,
// from the near end, whose picture has the c that belongs to it is what v + o sees: a ray cast against the one layer of
// depths that v sees. No place has it where v sees nothing of what v + o does. There [JKLL13] takes p itself where a
// surface bounds the line ("blocked"), the background where none does. Here both are one: the last place whose picture
// lies behind the ray, since what is hidden continues what lies behind it (SSIM 0.980 for 0.978 with p itself). A place
// that nothing covers has depth 0, which is a c like any other: the background.
//
// The line is as short as the CoC radii that can be met allow. They are bounded for tiles of pixels: by those of the
// whole picture, then, a few times, by the least and greatest depth in the square of tiles that the former bounds can
// reach: four lookups in an N-buffer. Where they are within a pixel's shift there is one lookup and no search.
// [JKLL13] has N-buffers of pixels, of the coarsest level's depths; by tiles they cost a sixteenth, and are exact.
//
// Blended surfaces leave no depth. Up to alpha 0.5 they move more and more with what is behind them; from there on
// neither moves: there are the primary samples alone.
#pragma once

#include <map>
#include <vector>

#include "gl/program.hpp"
#include "optics/lens.hpp"
#include "render/accumulate/footprints.hpp"
#include "render/accumulate/subsamples.hpp"
#include "render/sample_sum.hpp"

namespace dioptre {

class SubsampleBlur {
  public:
    struct Group {
        const SampleLayers& layers;
        int first = 0, count = 1;  // samples: layer 0 is sample `first`
        CocTransform coc;
        double stretch = 1.0;  // pixels along y for one along x
        Footprints footprints = {};
    };
    /// Adds the group's layers and their sub-samples to the sum, which has the footprints' parts.
    void add(const Group& group, const Subsamples& subsamples, SampleSum& sum);
    std::size_t bytes() const;

    // For tests, RG32F, a layer per sample and a texel per tile:
    /// CoC radii (nearest, farthest) that bound the tile's lookups.
    const Texture& bounds() const { return bounds_.texture; }
    /// The N-buffer: least and greatest depth in the square of 2^level tiles that begins at the tile.
    const Texture& squares(std::size_t level) const { return squares_[level].texture; }

  private:
    struct Target {
        Texture texture;
        Framebuffer framebuffer;
    };
    void resize(const Texture& depths);
    void bound(const Group& group, double farthest);

    int width_ = 0, height_ = 0, layers_ = 0;
    std::vector<Target> squares_;    // of 1, 2, 4, ... tiles, everywhere
    std::vector<Target> reduction_;  // from tiles to one texel
    Target bounds_;
    FullscreenPass tilePass_, reducePass_, nBufferPass_, boundPass_;
    std::map<int, FullscreenPass> lookupPasses_;  // by parts of the sum
};

}  // namespace dioptre
