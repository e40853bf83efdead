// Some of the vergences that a picture shows, taken from its depth without waiting for it: for statistics of the blur.
#pragma once

#include <span>
#include <vector>

#include "gl/objects.hpp"
#include "gl/pass.hpp"
#include "gl/program.hpp"
#include "optics/units.hpp"
#include "optics/view.hpp"

namespace dioptre {

class VergenceSampler {
  public:
    /// Reads a picture's depth (a texture, or the first layer of an array) at places evenly spread over it; nothing
    /// while an earlier reading is under way.
    void start(const Texture& depth, Metres near, PassLog& log);
    /// Of surfaces, not of the sky: the last reading that the GL has finished, D. Empty: none, or only sky.
    std::span<const double> vergences();

  private:
    FullscreenPass plain_, layered_;
    Texture places_;
    Framebuffer target_;
    Buffer pixels_;
    Fence fence_;
    bool started_ = false;
    Metres near_{1.0};
    std::vector<double> vergences_;
};

}  // namespace dioptre
