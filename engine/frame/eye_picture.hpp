// One eye's picture as plans say: techniques made when first needed, smaller pictures enlarged, two plans faded, a
// still view refined.
#pragma once

#include <array>
#include <memory>

#include "gl/objects.hpp"
#include "gl/program.hpp"
#include "quality/plan.hpp"
#include "render/technique.hpp"

namespace dioptre {

class EyePicture {
  public:
    // All are valid until the next call of the same kind.

    /// By one plan, at its size: what shows it stretches it to that of frame.view.
    const Texture& draw(const Plan& plan, const EyeFrame& frame);
    /// `weight`, 0..1, of `to` over `from`; of frame.view's size, as all that follow.
    const Texture& fade(const Plan& from, const Plan& to, double weight, const EyeFrame& frame);
    /// Goes on with `plan` by `samplesNow` samples, in buffers of its own: what draw() gave stays as it is.
    const Texture& refine(const Plan& plan, int samplesNow, const EyeFrame& frame);
    int refinedSamples() const { return refinedSamples_; }

    /// Keeps what was shown, for soften().
    void remember(const Texture& shown, const EyeFrame& frame) {
        if (&shown != &remembered_.picture) stretch(shown, 1.0, remembered_, frame);
    }
    /// `weight`, 0..1, of a picture over what is remembered, which from now on is that.
    const Texture& soften(const Texture& picture, double weight, const EyeFrame& frame) {
        stretch(picture, weight, remembered_, frame);
        return remembered_.picture;
    }

    /// Of the technique that drew last. Refining draws nothing that counts.
    const Technique& technique() const { return *drawnBy_; }
    /// Of what it drew, 0..1; 0: nothing yet.
    double progress() const { return drawnBy_ ? drawnBy_->progress() : 0.0; }
    std::size_t bytes() const;

  private:
    struct Canvas {
        Texture picture;
        Framebuffer target;
    };
    void stretch(const Texture& picture, double weight, Canvas& onto, const EyeFrame& frame);

    std::array<std::unique_ptr<Technique>, std::size(kTechniques)> techniques_;
    std::unique_ptr<Technique> refining_;
    const Technique* drawnBy_ = nullptr;
    int refinedSamples_ = 0;
    FullscreenPass stretchPass_;
    Canvas stretched_, remembered_;
};

}  // namespace dioptre
