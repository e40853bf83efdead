// How far two pictures are apart: PSNR, SSIM (Wang et al. 2004) and FLIP (Andersson et al. 2020).
// All three look at what a display shows: linear values are clamped to 0..1 and encoded to sRGB first.
#pragma once

#include "core/image.hpp"

namespace dioptre {

/// 0.7 m from a 0.7 m wide screen of 3840 pixels, FLIP's default.
inline constexpr double kFlipPixelsPerDegree = 67.02064327658225;

struct Comparison {
    double psnr = 0.0;  // dB, peak 1, over all channels; infinite where the pictures are equal
    double ssim = 0.0;  // mean over R, G, B; 1 where equal
    double flip = 0.0;  // mean error, 0..1; 0 where equal
};

/// All three. Every function here takes linear pictures of the same size with 3 channels; InputError otherwise, or
/// where a value is not finite.
Comparison compareImages(const Image& a, const Image& b, double pixelsPerDegree = kFlipPixelsPerDegree);

/// What the functions here ask of their pictures, as InputError: same size, 3 channels, all values finite.
void requireComparable(const Image& a, const Image& b);

double psnr(const Image& a, const Image& b);

/// Wang et al. 2004: 11x11 Gaussian, sigma 1.5, K1 0.01, K2 0.03, population covariance, only where the window lies
/// inside. InputError where the pictures are smaller than 11x11.
double ssim(const Image& a, const Image& b);

/// Andersson et al. 2020 (LDR). The mean of flipMap.
double flip(const Image& a, const Image& b, double pixelsPerDegree = kFlipPixelsPerDegree);

/// Error per pixel, 0..1, one channel.
Image flipMap(const Image& reference, const Image& test, double pixelsPerDegree = kFlipPixelsPerDegree);

/// FLIP's colours for an error of 0..1, black over purple and orange to light yellow: even steps look even, in grey,
/// too.
Image errorColours(const Image& errors);

}  // namespace dioptre
