// The geometry pass that every technique starts from: radiance and reversed depth (which is vergence) of one view.
#pragma once

#include "gl/objects.hpp"
#include "gl/pass.hpp"
#include "gl/program.hpp"

namespace dioptre {

struct EyeFrame;

class GeometryPass {
  public:
    /// Draws the scene at the view's size. A resolved pixel has the mean radiance of its samples and
    /// the nearest depth, so that an edge in focus belongs to what is in focus and never to the blur behind it.
    void draw(const EyeFrame& frame);

    const Texture& color() const { return color_; }  // RGBA16F, linear radiance × exposure, background black
    const Texture& depth() const { return depth_; }  // D32F, near/d; 0 is infinitely far
    std::size_t bytes() const;
    /// Texture fetches a pixel of the resolve, as Technique::fetchesPerPixel counts them.
    static double fetchesPerPixel(int msaa) { return 2.0 * msaa; }

  private:
    void resize(int width, int height, int msaa);

    Texture color_, depth_, samplesColor_, samplesDepth_;
    Framebuffer target_, samplesTarget_;
    FullscreenPass resolve_;
};

}  // namespace dioptre
