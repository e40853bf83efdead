// The fast path: defocus from one picture, its depth and an image pyramid.
//
// [LKC09] Lee, Kim, Choi 2009, "Real-Time Depth-of-Field Rendering Using Anisotropically Filtered Mipmap
// Interpolation".
//
// What is taken from it: depth as blur (DoB, here the signed circle-of-confusion radius c in pixels, one multiply-add
// on the depth buffer, optics/lens.hpp); a pyramid in one pass a level, 3×3 Gaussian centred on the coarse texel, that
// keeps what is sharp out of what is blurred (eq. 9); the blur that foreground neighbours spread (DoN, eq. 10, 11),
// measured in the same passes; the level from the blur (eq. 6); a nonlinear interpolation over a circle at the end.
//
// What is changed, and why (measured against path-traced pictures):
// - Eq. 9 is continuous: colours are premultiplied by a weight that grows with c and is 0 in focus. So bilinear fetches
//   stay exact at every level, nothing in focus can leak, and there is no δ to choose: a cut at δ = 0.5 ... 4 px on top
//   of it changed SSIM by less than 0.0005 on six scenes.
// - The foreground is a layer of its own, with coverage, laid over what is behind it; [LKC09] blurs both together
//   ("unnatural partial occlusion"). What it hides is filled from the finest pyramid level that shows something of the
//   rest there. Thin branches before a figure went from SSIM 0.874 to 0.932.
// - A foreground pixel is blurred over its own circle; what is nearer still spreads over it by DoN.
// - Blur is evaluated at half size, from whole levels: sixteen bilinear taps for nine trilinear ones (the same eighteen
//   fetches, less two). Taps and their circle together are given the variance of the disc, c²/4 along an axis, with the
//   variance of the half-size steps taken off; where those alone have more, blur and sharp picture are mixed. [LKC09]'s
//   σ = C/2 is an overestimate: its magnification delivers 0.58 of it.
//
// What is seen through blended surfaces: a pixel has one colour and one depth, that of the surface which gives it most
// of its light (gpu_scene.hpp). A pane of alpha 0.5 or more is blurred, before and behind focus, as if it were opaque,
// and what is seen through it takes its blur; a fainter one takes the blur of what is behind it. So glass in focus
// keeps its edges, and a tint over a view does not change how sharp the view is. Both at once, each with its own blur,
// only the reference has.
//
// Passes: geometry; split (2×2 pixels to a texel of the layers base, front, back and of the foreground's radii);
// pyramid (a pass a level); reach (DoN per tile); blur (half size); composite (full size). Without a foreground in view
// the layers front and back, the radii and reach are left out; with nothing beyond half a pixel of radius, all but the
// geometry.
#pragma once

#include <vector>

#include "gl/program.hpp"
#include "render/geometry_pass.hpp"
#include "render/show_pass.hpp"
#include "render/technique.hpp"

namespace dioptre {

class Mipmap final : public Technique {
  public:
    const Texture& draw(const EyeFrame& frame) override;
    const Texture& depth() const override { return geometry_.depth(); }
    std::size_t bytes() const override;
    std::optional<double> fetchesPerPixel() const override;

  private:
    /// What the view requires, from bounding boxes.
    struct Blur {
        CocTransform coc;
        float base = 0.0f;  // largest |radius| outside the foreground, px
        bool front = false;
        bool any = false;  // anything beyond the radius that counts as sharp
    };
    /// The passes in two kinds: with and without a foreground.
    struct Passes {
        FullscreenPass split, down, blur, composite;
        std::vector<Framebuffer> levels;
        Framebuffer blurred;
    };

    static Blur requiredBlur(const EyeFrame& frame);
    void resize(int width, int height);
    void makeTargets(Passes& passes, bool front);
    void buildPyramid(const Blur& blur, PassLog& log);
    void blurHalfSize(const Blur& blur, PassLog& log);
    void composite(const Blur& blur, PassLog& log);
    const Texture& show(const EyeFrame& frame, const Blur& blur);
    Passes& passesFor(const Blur& blur) { return blur.front ? withFront_ : behindOnly_; }

    GeometryPass geometry_;
    ShowPass show_;
    int levelCount_ = 0;
    int builtLevels_ = 0;  // of the last pyramid
    int drawnMsaa_ = 0;    // of the last picture
    bool drawnBlur_ = false, drawnFront_ = false;
    Texture layers_;  // RGBA16F array, half size, a pyramid: base, front, back, each rgb·weight, weight
    Texture spread_;  // RG16F, half size, a pyramid: the foreground's largest radius, and its mean · coverage, px
    Texture reach_;   // R16F, a texel per 8×8 pixels: the largest foreground radius that reaches it, px
    Texture behind_, front_;  // RGBA16F, half size, premultiplied
    Texture output_;
    Framebuffer reachTarget_, outputTarget_;
    Passes behindOnly_, withFront_;
    FullscreenPass reachPass_, showPass_;
};

}  // namespace dioptre
