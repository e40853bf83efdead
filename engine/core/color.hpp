// The sRGB transfer function (IEC 61966-2-1) and its inverse, on one channel. Exact: no 2.2 power, no table.
#pragma once

#include <cmath>
#include <concepts>

namespace dioptre {

/// Linear to display-referred; any finite value (negative ones stay on the linear toe, nothing is clamped).
template <std::floating_point T>
T srgbFromLinear(T linear) {
    return linear <= T(0.0031308) ? T(12.92) * linear : T(1.055) * std::pow(linear, T(1) / T(2.4)) - T(0.055);
}

/// Display-referred to linear; nothing is clamped.
template <std::floating_point T>
T linearFromSrgb(T encoded) {
    return encoded <= T(0.04045) ? encoded / T(12.92) : std::pow((encoded + T(0.055)) / T(1.055), T(2.4));
}

/// Clamped to 0..1; NaN becomes 0.
template <std::floating_point T>
constexpr T clampUnit(T x) {
    return x > T(0) ? (x < T(1) ? x : T(1)) : T(0);
}

}  // namespace dioptre
