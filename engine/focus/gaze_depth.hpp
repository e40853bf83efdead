// The vergence under the gaze: a weighted median over a cone, of what both eyes see. A mean would focus on nothing at a
// depth edge; a median always picks a surface that is there.
//
// Both eyes' samples are first moved to the view midway between them, where the gaze is given. With s the eye's offset
// along x (left -IPD/2, right +IPD/2), t = x/d a tangent, l a frustum's left edge and f_px in pixels per tangent:
//   a point at X, D = 1/d       t_mid = X D,  t_eye = (X - s) D = t_mid - s D
//   a pixel                     x = f_px (t - l)
//   =>                          x_mid = x_eye + f_px s D + f_px (l_eye - l_mid)
// so straight ahead of the midpoint a point at D lies in the LEFT eye's picture f_px IPD/2 D to the right.
// The last term is 0 for equal frusta; with a screen at vergence Ds it is -f_px s Ds: the shift vanishes at the screen.
//
// What is focused on where several things are in the cone: the one at the median of its area, weighted. Blur is linear in
// vergence, and the median has the least sum of distances: no other focus blurs the cone less. So
//   a thin thing (a wire, a pole, a leaf, a fence) that fills less than half of the cone is looked past, whatever is
//   behind it, the sky too; from half on it is focused on;
//   of three depths of which none fills half, the middle one is taken: both others blur least from there;
//   where the neighbours of a hole are one pixel apart, it is none: two eyes' pixels tell no finer.
// What is seen through (frame/gaze_probe.hpp) is not there at all.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>

#include "optics/view.hpp"

namespace dioptre {

/// x_mid = x_eye + pixelsPerDioptre * D + pixels.
struct MidpointShift {
    double pixelsPerDioptre = 0.0;
    double pixels = 0.0;
};

/// From one eye's view to eyeView(Eye::centre, ...) of the same rig: same orientation, size and width of field.
MidpointShift midpointShift(const View& eye, const View& centre);

/// Whole pixels, from the top left.
struct PixelRegion {
    int x = 0, y = 0, width = 0, height = 0;

    bool empty() const { return width <= 0 || height <= 0; }
};

/// A region of one eye's vergence. Stored reversed-Z depth z gives it as z / near.
struct EyeVergence {
    std::span<const float> vergence;  // dioptres, 0 is the sky; region.width * region.height, top row first
    PixelRegion region;               // where in the eye's picture
    MidpointShift toMidpoint;
};

/// Nearer than 10 cm nobody converges: gazeRegion() need not reach further sideways than this asks for.
inline constexpr Dioptres kNearestGaze{10.0};

/// The cone's standard deviation in pixels, (f_px.x, f_px.y) * tan(error): exact at the picture's centre.
glm::dvec2 coneSigmaPixels(const View& view, Radians error);

/// What must be read of one eye's picture so that every sample up to `nearest` that can reach the cone is in it;
/// clipped to the picture, empty when the gaze is that far outside. `gaze` in pixels of the midpoint view from the top
/// left, pixel centres at half integers.
PixelRegion gazeRegion(const View& eye, const MidpointShift& toMidpoint, glm::dvec2 gaze, glm::dvec2 coneSigma,
                       Dioptres nearest = kNearestGaze);

/// Weighted median of the vergence, Gaussian weights around `gaze` with standard deviations `coneSigma` (pixels in x
/// and y, taken as half a pixel to 1024 pixels), cut at 2 standard deviations. One eye or two, which share the weight of
/// each pixel of the midpoint view that both know of. Samples that are not finite or < 0 are skipped; so are samples that
/// the midpoint cannot see because a nearer one hides them there. Of an exact tie the farther one. nullopt if no sample
/// is left, or an argument is not a number.
std::optional<Dioptres> gazeVergence(std::span<const EyeVergence> eyes, glm::dvec2 gaze, glm::dvec2 coneSigma);

}  // namespace dioptre
