// Units that live in the type, so that metres, dioptres and radians cannot be mixed up. No implicit conversion.
#pragma once

#include <compare>

namespace dioptre {

template <class Unit>
struct Quantity {
    double value = 0.0;

    constexpr Quantity() = default;
    constexpr explicit Quantity(double v) : value(v) {}

    constexpr auto operator<=>(const Quantity&) const = default;
    constexpr Quantity operator-() const { return Quantity(-value); }
    constexpr Quantity operator+(Quantity o) const { return Quantity(value + o.value); }
    constexpr Quantity operator-(Quantity o) const { return Quantity(value - o.value); }
    constexpr Quantity operator*(double s) const { return Quantity(value * s); }
    constexpr Quantity operator/(double s) const { return Quantity(value / s); }
    constexpr double operator/(Quantity o) const { return value / o.value; }
};

using Metres = Quantity<struct MetreUnit>;
using Dioptres = Quantity<struct DioptreUnit>;  // 1/m; 0 is infinitely far
using Radians = Quantity<struct RadianUnit>;
using Seconds = Quantity<struct SecondUnit>;

/// Vergence of a distance (> 0, may be infinite) and back; infinity and zero map to each other.
constexpr Dioptres vergence(Metres distance) {
    return Dioptres(1.0 / distance.value);
}
constexpr Metres distance(Dioptres vergence) {
    return Metres(1.0 / vergence.value);
}

}  // namespace dioptre
