// What C++ and GLSL share of the mipmap technique; the reasons stand in engine/render/mipmap/mipmap.hpp.
// Radii are of the circle of confusion (CoC) in pixels of the picture.
#ifdef __cplusplus
#pragma once
#include <algorithm>
#include <cmath>
namespace dioptre::mipmap {
using std::clamp;
using std::exp2;
using std::floor;
using std::log2;
using std::max;
using std::sqrt;
inline float smoothstep(float low, float high, float x) {
    const float t = clamp((x - low) / (high - low), 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}
#define DIOPTRE_CONST inline constexpr
#define DIOPTRE_FUNCTION inline
#else
#define DIOPTRE_CONST const
#define DIOPTRE_FUNCTION
#endif

// Lee, Kim, Choi 2009, eq. 6: the level whose blur is sigma, 0 for the picture itself; kσ makes eq. 5,
// sigma = 3/2 2^(m-1), continuous where the first level begins.
DIOPTRE_CONST float kSigmaScale = 2.0f / 3.0f;
DIOPTRE_FUNCTION float levelForSigma(float sigma) {
    float t = kSigmaScale * sigma;
    return t < 0.5f ? 0.0f : 1.0f + log2(t);
}

// Degree of blur of one tap per CoC diameter. A whole disc has 0.25; sixteen taps share it.
DIOPTRE_CONST float kTapSigmaPerCocDiameter = 0.09f;

// What leaves focus enters the foreground's layer between these radii, px: below the first it is as good as sharp.
DIOPTRE_CONST float kFrontBegins = 1.0f;
DIOPTRE_CONST float kFrontComplete = 2.0f;
DIOPTRE_FUNCTION float frontShare(float signedRadius) {
    return smoothstep(kFrontBegins, kFrontComplete, -signedRadius);
}

// Eq. 9 made continuous: a pixel gives to a blur behind focus by the square of its own blur, in focus (below
// kSharpRadius) nothing. `largest`: the layer's largest radius, no more than kMostBaseRadius. Weights stay above
// kLeastWeight, the least normal half float: below, they could no longer carry a colour.
DIOPTRE_CONST float kSharpRadius = 0.5f;
DIOPTRE_CONST float kMostBaseRadius = 200.0f;
DIOPTRE_CONST float kLeastWeight = 6.2e-5f;
DIOPTRE_FUNCTION float baseWeight(float radius, float largest) {
    float x = clamp((radius - kSharpRadius) / largest, 0.0f, 1.0f);
    return x > 0.0f ? max(x * x, kLeastWeight) : 0.0f;
}
DIOPTRE_FUNCTION float radiusOfBaseWeight(float weight, float largest) {
    return sqrt(weight) * largest + kSharpRadius;
}

// Eq. 10: a foreground blurred to `radius` spreads over what is blurred to `mine` in front of focus (0: not in front) if
// it is nearer. From this ratio on two foregrounds count as two.
DIOPTRE_CONST float kNearerRatio = 1.3f;
DIOPTRE_FUNCTION bool spreadsOver(float radius, float mine) {
    return radius > mine * kNearerRatio + kSharpRadius;
}

// Half-size texels per texel of the foreground's reach: 8×8 pixels.
DIOPTRE_CONST int kReachTile = 4;

// Radii are kept below this in half floats.
DIOPTRE_CONST float kMostRadius = 60000.0f;

// Variance along one axis of what the half-size layers do to the picture, px²: one tap at level 0, and at level l > 0
// in units of 4^(l+1) (box of the first level, binomials of the others, bilinear reading), then the bilinear step back
// to full size.
DIOPTRE_CONST float kTapVarianceFirst = 1.0f;
DIOPTRE_CONST float kTapVariance = 0.41f;
DIOPTRE_CONST float kUpsampleVariance = 0.67f;
// Second moment of the sixteen taps' pattern along one axis, for a circle of radius 1.
DIOPTRE_CONST float kPatternMoment = 0.255f;
// Least variance that the half-size blur has: below, it is mixed with the sharp picture. 1.0 + 0.67 by the above; 1.3
// measured best against path-traced pictures, because a mixture has longer tails than a small disc.
DIOPTRE_CONST float kLeastVariance = 1.3f;

// Level of the half-size layers (0: their full size) at which a disc's taps are read: eq. 6, whole levels, so that a
// tap is one bilinear fetch; tapCircle() makes up for the rounding.
DIOPTRE_FUNCTION float tapLevel(float radius) {
    return max(floor(levelForSigma(kTapSigmaPerCocDiameter * 2.0f * radius) - 0.5f), 0.0f);
}
// Radius of the taps' pattern, half-size texels, so that taps at `level` and pattern together have the disc's variance,
// radius²/4 along one axis.
DIOPTRE_FUNCTION float tapCircle(float radius, float level) {
    float tap = level > 0.5f ? kTapVariance * 4.0f * exp2(2.0f * level) : kTapVarianceFirst;
    return 0.5f * sqrt(max(0.25f * radius * radius - tap - kUpsampleVariance, 0.0f) / kPatternMoment);
}
// Share of the half-size blur in a pixel of CoC radius c: all of it where that has no more variance than the disc.
DIOPTRE_FUNCTION float blurShare(float c) {
    return clamp(0.25f * c * c / kLeastVariance, 0.0f, 1.0f);
}

#undef DIOPTRE_CONST
#undef DIOPTRE_FUNCTION
#ifdef __cplusplus
}  // namespace dioptre::mipmap
#endif
