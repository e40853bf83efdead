// The seam between a frame and the ways of drawing defocus: a technique turns a scene and an eye's view into a picture.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/settings.hpp"
#include "gl/objects.hpp"
#include "gl/pass.hpp"
#include "optics/lens.hpp"
#include "optics/view.hpp"
#include "quality/plan.hpp"
#include "render/gpu_scene.hpp"

namespace dioptre {

/// All that a technique may know about one eye's picture.
struct EyeFrame {
    const GpuScene& scene;
    const View& view;
    const Lens& lens;
    float exposure = 1.0f;  // factor on radiance
    int msaa = 0;           // 0 or 4
    ShowStage show;         // a stage of the technique instead of the picture
    PassLog& log;
    int samples = 512;    // reference, accumulate: points of the lens, >= 1
    int subsamples = 0;   // accumulate: more points of the lens for each, on average; 0..16
    int firstSample = 0;  // reference, accumulate: where in the sequence they begin
    // reference, accumulate: 0 draws all samples now; more: at most so many more in this picture, which goes on from
    // the last one while nothing else here changes.
    int samplesNow = 0;
    double detailPx = 0.0;         // pinhole, mipmap: what levels of detail may be off, pixels of the view; 0: level 0
    const Sight* sight = nullptr;  // GpuScene::inSight of all eyes' frames; none: this view looks for itself
    // reference, accumulate: told the share of the samples that is drawn, 0..1, after each group; empty: nobody is
    std::function<void(double)> onDrawn = {};
};

class Technique {
  public:
    Technique() = default;
    virtual ~Technique() = default;
    Technique(const Technique&) = delete;
    Technique& operator=(const Technique&) = delete;

    /// Linear radiance × exposure, RGBA16F or RGBA32F, view.width × view.height, a texture that filters and ends at its
    /// edges; valid until the next call. Leaves depth test and blending off. Throws InputError for a stage it does not
    /// have, RunError where the GL fails.
    virtual const Texture& draw(const EyeFrame& frame) = 0;

    /// How much of what was asked for the last picture has, 0..1; below 1 while it still refines.
    virtual double progress() const { return 1.0; }

    /// Reversed depth of (one point of the lens in) the picture drawn last, at its size: a texture, or the first layer
    /// of an array.
    virtual const Texture& depth() const = 0;

    /// Textures held, the geometry pass's included.
    virtual std::size_t bytes() const = 0;

    /// Texture fetches of the full-screen passes of the last picture, divided by its pixels: the most that any pixel
    /// can ask for (loops that a pixel may leave out count in full). A bilinear fetch, a gather or a texelFetch is one;
    /// fetches of the scene's surfaces are left out. None where nobody counted them.
    virtual std::optional<double> fetchesPerPixel() const { return std::nullopt; }
};

/// One instance per eye: it keeps that eye's buffers.
std::unique_ptr<Technique> makeTechnique(TechniqueChoice choice);

/// Sets the dials that the plan has. Its size is the view's: whoever makes the frame shrinks it.
void apply(const Plan& plan, EyeFrame& frame);

/// What is worth measuring of each technique, cheapest first within one.
std::vector<Plan> measuredPlans();

/// CoC transform of an eye's picture: pixel radii along x (pixels are square but for half-width displays).
CocTransform cocTransform(const EyeFrame& frame);

}  // namespace dioptre
