// How the panel writes a setting, and how finely the mouse moves its number.
#pragma once

#include <string>

#include "core/settings.hpp"

namespace dioptre {

/// "aperture-mm" as "Aperture": the unit stands beside the value.
std::string labelOf(const Setting& setting);

/// "°" for "deg", "cd/m²": as people write it; UTF-8.
std::string unitOf(const Setting& setting);

/// By what a pixel's movement of the mouse changes a number: 1, 2 or 5 times a power of ten, about a four-hundredth of the
/// value; of small ones, of a tenth of what the setting's range allows, at most of 5.
double dragStep(const Setting& setting, double value);

/// What a value is rounded to while it is dragged, for printf.
std::string dragFormat(double value, double step);

}  // namespace dioptre
