// What a view requires before anybody plans how to draw it, and what can be left out unseen.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "optics/lens.hpp"
#include "quality/view_class.hpp"

namespace dioptre {

/// Nothing with a CoC of at most that DIAMETER, px, needs blurring. A disc of 0.5 px kept SSIM at 0.9998 or more on two
/// path-traced pinhole pictures full of edges, one of 0.7 px at 0.9994, one of 1 px at 0.9980.
inline constexpr double kSharpDiameter = 0.5;

/// Samples that antialias what is wholly in focus.
inline constexpr int kAntialiasingSamples = 8;

/// Signed CoC RADII, px, > 0 behind focus: the nearest and the farthest of what is seen. A background is: infinitely
/// far.
struct CocRange {
    double nearest = 0.0, farthest = 0.0;
};
/// Of vergences, in either order; `focalLengthPixels` as from focalLengthPixels(View).
CocRange cocRange(const Lens& lens, double focalLengthPixels, Dioptres nearest, Dioptres farthest);

/// One bin of a picture's histogram of signed CoC RADII, px.
struct CocBin {
    double least = 0.0, most = 0.0;
    double pixels = 0.0;  // a count or a share; >= 0
};

/// Of a picture of about this view: for its class. What it requires hangs on the boxes, which bound what comes next,
/// too.
struct PixelStatistics {
    double inFront = 0.0, behind = 0.0;                // shares of the picture whose CoC is not sharp, 0..1
    double meanDiameter = 0.0, largestDiameter = 0.0;  // CoC DIAMETERS, px
    std::optional<CocRange> range;                     // none: an empty histogram
};
PixelStatistics pixelStatistics(std::span<const CocBin> histogram);

/// What is known of a view.
struct ViewFacts {
    std::optional<CocRange> boxes;          // none: nothing is in view
    std::optional<PixelStatistics> pixels;  // none: no picture was looked at yet
    bool highlights = false;                // something much brighter than white is in view
    bool transparency = false;              // blended surfaces are
    bool moving = true;                     // what is shown, or the eye that looks
    int blades = 0;                         // of the lens; 0: round
};

/// A piece of work that this view can do without.
struct Omission {
    std::string_view what, why;  // one line each
};

struct Requirements {
    bool blur = true;             // else a pinhole's picture is the picture
    bool foreground = true;       // something in front of focus is blurred
    double largestInFront = 0.0;  // CoC RADIUS, px, >= 0
    double largestBehind = 0.0;   // CoC RADIUS, px, >= 0
    bool shapedDiscs = false;     // highlights show the aperture's corners
    bool mayRefine = false;       // nothing moves: frames may continue one another
    std::vector<Omission> omitted;
};
Requirements require(const ViewFacts& facts);

/// Levels of the mipmap technique's pyramid that are read, of `all`: as many as the largest blur needs; with a
/// foreground all, since its largest radius is at the top. Never one alone: some drivers then switch to a cheaper
/// fetch, and the price would jump in the middle of a focus pull.
int pyramidLevels(double largestBehind, bool foreground, int all);

/// The class of a view for prices and errors: by pixels where they are known, else by boxes.
ViewClass classOf(const ViewFacts& facts, double triangles, double pixels, int eyes);

}  // namespace dioptre
