// Stages that every technique has, as pictures: vergence, signed circle of confusion, degree of blur.
#pragma once

#include "gl/program.hpp"
#include "render/technique.hpp"

namespace dioptre {

class ShowPass {
  public:
    /// vergence: D/(1 + D), so 1 D is half and infinity black. coc: red in front of focus, blue behind, full at a
    /// radius of 16 px. dob: the degree of blur without its sign, on the same scale. Throws InputError for a stage that
    /// only some techniques have.
    const Texture& draw(const EyeFrame& frame, const Texture& depth);

    /// For a technique's own stages: binds a target of that size; what is drawn there is picture().
    void bindTarget(int width, int height);
    const Texture& picture() const { return output_; }

  private:
    FullscreenPass fromDepth_;
    Texture output_;
    Framebuffer target_;
};

}  // namespace dioptre
