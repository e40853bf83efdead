// The thin lens in dioptres: one aperture, one focal length, one focus, and the circle of confusion (CoC) they give.
//
// Derivation (Lee, Eisemann, Seidel 2009, eq. 3; Jeong et al. 2013, eq. 2), which the shaders refer to:
//   E     aperture (pupil) RADIUS, m               F     focal length, m
//   df    focus distance, m, Df = 1/df its vergence d, D  an object's distance and vergence
//   u_f = F df / (df - F) = F / (1 - F Df)         image distance of the focal plane, m
//   u   = F d  / (d  - F)                          image distance of the object, m
// A cone of light of radius E at the lens meets at u; cut at the sensor, u_f, its radius is by similar triangles
//   r   = E (u - u_f) / u  up to the sign  =  E F (d - df) / ((df - F) d)  =  E u_f (Df - D)
// and seen from the lens at the focal length f_px = (W/2) / tan(hfov/2) pixels, where r/u_f becomes pixels:
//   c   = E f_px (Df - D)                          signed RADIUS in pixels, > 0 behind the focal plane
// With reversed Z and an infinite far plane (view.hpp) the depth buffer holds z = n/d, n the near plane, so D = z/n:
//   c   = (-E f_px / n) z + E f_px Df              one multiply-add on the stored depth.
// Infinity is the number D = 0. Never |V - Vf| E / V: it cancels to nothing in 32-bit floats where d is near df.
#pragma once

#include "optics/units.hpp"

namespace dioptre {

struct Lens {
    Metres apertureRadius{0.0};   // E >= 0; a RADIUS; 0 is a pinhole
    Metres focalLength{0.01667};  // F > 0
    Dioptres focus{0.0};          // Df < 1/F; 0 focuses at infinity; < 0 only as a hyperope's unreached infinity
    int blades = 0;               // 0: round; >= 3: a regular polygon inscribed in the round aperture
    Radians bladeRotation{0.0};   // where its first corner is, counter-clockwise from the right

    bool operator==(const Lens&) const = default;
};

/// A far-sighted eye that cannot reach infinity is focused beyond it: the least vergence a lens may have.
inline constexpr Dioptres kLeastFocus{-20.0};

/// Throws InputError unless kLeastFocus <= focus and the focus distance is beyond the focal length (F Df < 1).
void validateFocus(Metres focalLength, Dioptres focus);

/// Throws InputError for a value that is not finite, radius < 0, focal length <= 0, or a focus out of validateFocus.
void validate(const Lens& lens);

/// u_f = F / (1 - F Df): how far behind the lens the focal plane is imaged.
Metres imageDistance(const Lens& lens);

/// E u_f (Df - D): signed CoC RADIUS on the sensor or retina of an object at vergence D >= 0; > 0 behind focus.
Metres cocRadiusOnImage(const Lens& lens, Dioptres objectVergence);

/// E f_px (Df - D): signed CoC RADIUS in pixels; > 0 behind focus. f_px as from focalLengthPixels(View), x or y.
double cocRadiusPixels(const Lens& lens, double focalLengthPixels, Dioptres objectVergence);

/// Signed CoC radius in pixels from a stored reversed-Z depth: radius = scale * depth + bias.
struct CocTransform {
    float scale = 0.0f;
    float bias = 0.0f;

    float radius(float storedDepth) const { return scale * storedDepth + bias; }
};

/// The multiply-add of the derivation above; `near` > 0 is the near plane of the view that wrote the depth.
CocTransform cocFromDepth(const Lens& lens, double focalLengthPixels, Metres near);

}  // namespace dioptre
