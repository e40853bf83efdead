// LOD-accelerated accumulation: the accurate end of what is drawn in real time.
// [JKLL13] Jeong et al. 2013, "Real-time defocus rendering with level of detail and sub-sample blur"; and
// Jeong's dissertation, ch. 3.
//
// The mean of N pictures through points of the lens, as the reference's, made cheaper in four ways:
// - what is blurred is drawn with as many triangles as its blur can tell from more (detail.hpp);
// - what is hardly blurred is drawn once for all points of the lens that see it in the same places (sharing.hpp), into
//   sprites that samples begin with. [JKLL13] groups the samples for each object, and copies each; here all objects up
//   to one CoC share one grouping, so that thousands take one copy, and it hangs on the samples alone, so that edges in
//   focus do not flicker while lens or view change. Blended surfaces are drawn for each sample;
// - each picture serves some more points of the lens around its own (subsample_blur.hpp);
// - with these, what points see is smoothed by how far apart they see it (footprints.hpp). [JKLL13] has the plain mean.
// Textures of what is blurred are read no finer than its samples lie apart. With no textures, level 0 for all, nothing
// shared and no sub-samples it is the reference, to the bit.
//
// Samples come in groups of as many as one submission of the geometry can draw; memory does not grow with their number.
// Each has its own sub-pixel jitter (of shared renderings: sharing.hpp), so edges are antialiased and msaa is not
// used.
#pragma once

#include <vector>

#include "render/accumulate/sharing.hpp"
#include "render/accumulate/subsample_blur.hpp"
#include "render/geometry_pass.hpp"
#include "render/sample_sum.hpp"
#include "render/show_pass.hpp"
#include "render/technique.hpp"

namespace dioptre {

class Accumulate final : public Technique {
  public:
    const Texture& draw(const EyeFrame& frame) override;
    double progress() const override { return showsStage_ ? 1.0 : sum_.progress(); }
    const Texture& depth() const override { return layers_.depths(); }
    std::size_t bytes() const override;

    /// For tests: what a view's plan is made of.
    struct Plan {
        std::vector<double> levels;  // of detail, of each seen item
        std::vector<bool> shared;    // of each seen item: whether samples share renderings of it
        SharedRenderings sharing;    // no parents where nothing is shared
        Footprints footprints;       // narrow without sub-samples
    };
    const Plan& plan() const { return plan_; }

  private:
    struct Sharing {
        double radius = -1.0;  // what has at most this CoC RADIUS is shared, px; < 0: nothing is
        SharedRenderings renderings;
    };

    const Texture& showLevels(const EyeFrame& frame);
    /// What hangs on the lens's samples alone.
    void prepareSamples(const EyeFrame& frame);
    static Sharing sharingOf(const EyeFrame& frame);
    void makePlan(const EyeFrame& frame);
    /// Those that are missing of the first `needed`.
    void drawSprites(const EyeFrame& frame, int needed);
    void drawGroup(const EyeFrame& frame, int count);
    void beginWithSprites(int first, int count);
    /// Those of the shared items, or of the others, that renderings `first` and on of `total` take; the rest hidden.
    std::vector<std::int8_t> levelsFor(bool shared, int first, int count, int total) const;

    DrawList list_;
    std::vector<std::int8_t> arranged_;  // levels that the list is arranged for
    int arrangedFor_ = 0;                // matrices
    bool showsStage_ = false;
    Plan plan_;
    struct SampleKey {
        int samples = 0, each = 0, first = 0, blades = 0;
        Radians bladeRotation{0.0};

        bool operator==(const SampleKey&) const = default;
    };
    SampleKey sampleKey_;  // what subsamples_ and sharing_ are of
    Subsamples subsamples_;
    Sharing sharing_;
    SampleLayers layers_{"lens samples"};
    struct {
        SampleLayers layers{"shared renderings"};
        int drawn = 0;
    } sprites_;
    SampleSum sum_;
    SubsampleBlur blur_;
    FootprintPass footprintPass_;
    FullscreenPass spritePass_;
    GeometryPass geometry_;  // for --show
    ShowPass show_;
};

}  // namespace dioptre
