// Lens prescriptions: small JSON files (comments allowed) in config/lenses/, and the lens that one gives for an
// observer, a luminance and a wish to focus somewhere.
//
//   key                     of      range         meaning
//   name, description       all     text          name is required
//   kind                    all     eye | camera  required
//   focalLengthMm           all     1..2000       required
//   apertureDiameterMm      all     0..1000       fixed aperture DIAMETER; an eye without it has a pupil
//   fNumber                 camera  0.1..1000     instead of it: diameter = focal length / f-number
//   ageYears                eye     3..120        default 28.58, the pupil formula's reference age
//   accommodation           eye     a name        "unlimited" (default), "hofstetter-minimum", "-mean" or "-maximum"
//   refractionDioptres      eye     -20..20       default 0 (emmetropic); < 0 short-sighted
//   pupilFieldSquareDegrees eye     0.1..41253    default 900 pi, a disc 60 deg across
//   pupilEyes               eye     1 | 2         default 2
#pragma once

#include <filesystem>
#include <numbers>
#include <optional>
#include <string>

#include "optics/eye.hpp"
#include "optics/lens.hpp"

namespace dioptre {

enum class LensKind { eye, camera };

struct LensPreset {
    std::string name, description;
    LensKind kind = LensKind::eye;
    Metres focalLength{0.01667};
    std::optional<Metres> apertureDiameter;  // none: a pupil that follows luminance and age
    double ageYears = 28.58;
    std::optional<AmplitudeEstimate> accommodation;  // none: unlimited
    Dioptres refraction{0.0};
    double pupilField = 900.0 * std::numbers::pi;  // deg2
    int pupilEyes = 2;
};

/// Throws InputError (file, key, value, range) for an unreadable file, broken JSON, an unknown, repeated or missing
/// key, a wrong type, a value out of range, or a key that the kind does not have.
LensPreset loadLensPreset(const std::filesystem::path& file);

/// What the user or the scene says over the preset.
struct LensConditions {
    std::optional<Metres> apertureDiameter;  // DIAMETER, 0..1 m; replaces pupil and preset
    std::optional<double> ageYears;  // 3..120; ages the pupil, and limits an unlimited eye by Hofstetter's mean;
                                     // a camera has no age and ignores it
    double luminance = 100.0;        // cd/m2, 0..1e8; only a pupil answers to it
};

struct ResolvedLens {
    Lens lens;                  // always valid; lens.focus is the reached focus
    Metres apertureDiameter;    // = 2 lens.apertureRadius: pupil or aperture DIAMETER
    Dioptres residual;          // target - lens.focus: the defocus left at the target
    bool focusLimited = false;  // the target lies outside `range`
    FocusRange range;           // what can be focused; a limited eye's accommodation range, else all beyond the lens
};

/// The lens that results when it is asked to focus at `target`. A target out of reach, even one nearer than the focal
/// length, is clamped and shows in `residual` and `focusLimited`: gaze may fall anywhere. For a distance that a user
/// typed, call validateFocus(preset.focalLength, target) first. Throws InputError for a condition out of its range or a
/// target that is not finite.
ResolvedLens resolveLens(const LensPreset& preset, const LensConditions& conditions, Dioptres target);

}  // namespace dioptre
