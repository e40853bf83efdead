// The table of settings: one row per member, its kind found from the member's type.
#include "core/settings.hpp"

#include <type_traits>

#include "core/error.hpp"
#include "core/setting_values.hpp"
#include "core/text.hpp"

namespace dioptre {

namespace {

template <class T>
constexpr SettingKind kindOf() {
    if constexpr (values::kIsOptional<T>) {
        return kindOf<typename T::value_type>();
    } else if constexpr (std::is_same_v<T, bool>) {
        return SettingKind::boolean;
    } else if constexpr (std::is_same_v<T, double>) {
        return SettingKind::number;
    } else if constexpr (std::is_same_v<T, int>) {
        return SettingKind::integer;
    } else {
        return std::is_enum_v<T> ? SettingKind::choice : SettingKind::text;
    }
}

/// Completes a row for the member Settings::*Group.*Member.
template <auto Group, auto Member>
Setting row(Setting setting) {
    using T = std::remove_reference_t<decltype((Settings{}.*Group).*Member)>;
    setting.kind = kindOf<T>();
    if constexpr (values::kIsOptional<T>) setting.optional = values::write(setting, T{}).empty();
    setting.get = [](const Settings& s, const Setting& self) { return values::write(self, (s.*Group).*Member); };
    setting.set = [](Settings& s, const Setting& self, std::string_view text) {
        if (values::read(self, text, (s.*Group).*Member)) return;
        const std::string value = parseNumber(text) ? std::string(text) : quote(text);
        const bool fraction =
            self.kind == SettingKind::integer && self.choices.empty() && parseNumber(text) && !parseInteger(text);
        throw InputError(std::string(self.name) + ": " + value +
                         (fraction ? " is no whole number, it takes " : " is not allowed, it takes ") +
                         self.rangeText());
    };
    setting.defaultText = setting.get(Settings{}, setting);
    return setting;
}

std::vector<Setting> makeTable() {
    using S = Settings;
    using Lens = LensSettings;
    using Focus = FocusSettings;
    using View = ViewSettings;
    using Render = RenderSettings;
    return {
        row<&S::lens, &Lens::lens>(
            {.group = "lens",
             .name = "lens",
             .help = "eye or lens to see with: a name in config/lenses (eye, eye-60, camera-50mm-f1.4, ...) or a file",
             .form = "NAME|FILE"}),
        row<&S::lens, &Lens::apertureMm>(
            {.group = "lens",
             .name = "aperture-mm",
             .help = "diameter of the pupil or aperture; not given: the eye's by luminance and age, the lens's own",
             .unit = "mm",
             .min = 0.0,
             .max = 1000.0}),
        row<&S::lens, &Lens::ageYears>(
            {.group = "lens",
             .name = "age",
             .help = "age of the eye, limits how near it can focus and how wide its pupil opens",
             .unit = "years",
             .min = 20.0,
             .max = 83.0}),
        row<&S::lens, &Lens::luminance>({.group = "lens",
                                         .name = "luminance",
                                         .help = "brightness the eye is adapted to, sets its pupil; 10 is a lit room",
                                         .unit = "cd/m^2",
                                         .min = 1e-6,
                                         .max = 1e6}),
        row<&S::lens, &Lens::blades>(
            {.group = "lens",
             .name = "blades",
             .help = "corners of the aperture as accumulate and reference draw it; below 3 it is round",
             .min = 0.0,
             .max = 32.0}),
        row<&S::lens, &Lens::bladeRotationDeg>({.group = "lens",
                                                .name = "blade-rotation-deg",
                                                .help = "where the aperture's first corner is, from the right",
                                                .unit = "deg",
                                                .min = -360.0,
                                                .max = 360.0}),

        row<&S::focus, &Focus::focus>(
            {.group = "focus",
             .name = "focus",
             .help = "distance in focus; gaze: of what lies under the gaze, the same for both eyes",
             .unit = "m",
             .form = "METRES|inf|gaze",
             .limits = "0.001..1e9 m"}),
        row<&S::focus, &Focus::gaze>(
            {.group = "focus",
             .name = "gaze",
             .help = "point looked at in an eye's picture, 0,0 is its top left and 1,1 its bottom right",
             .form = "X,Y",
             .limits = "each 0..1"}),
        row<&S::focus, &Focus::gazeSource>(
            {.group = "focus",
             .name = "gaze-source",
             .help = "what leads the gaze in a window where no trace does: the pointer, or the point that gaze says",
             .choices = {"pointer", "point"}}),
        row<&S::focus, &Focus::dynamics>(
            {.group = "focus",
             .name = "focus-dynamics",
             .help = "how fast focus follows the gaze: natural as an eye does, snappy in a quarter of the time",
             .choices = {"natural", "snappy", "instant"}}),
        row<&S::focus, &Focus::gazeErrorDeg>(
            {.group = "focus",
             .name = "gaze-error-deg",
             .help = "error of the gaze, standard deviation: focus takes a median over a cone that wide",
             .unit = "degrees",
             .min = 0.0,
             .max = 10.0}),
        row<&S::focus, &Focus::gazeTrace>(
            {.group = "focus",
             .name = "gaze-trace",
             .help = "CSV of gaze points over time, t_s,x,y,valid; plays in a window or a sequence",
             .optional = true,
             .form = "FILE"}),
        row<&S::focus, &Focus::headTrace>(
            {.group = "focus",
             .name = "head-trace",
             .help = "CSV of head poses over time, t_s,x,y,z,qx,qy,qz,qw, in the camera's frame, metres",
             .optional = true,
             .form = "FILE"}),

        row<&S::view, &View::camera>(
            {.group = "view",
             .name = "camera",
             .help = "camera of the scene; not given: its first, or where it has none one that sees all of it",
             .optional = true,
             .form = "NAME|INDEX"}),
        row<&S::view, &View::pose>(
            {.group = "view",
             .name = "pose",
             .help = "where the head is: position in metres and quaternion; not given: where the camera is",
             .form = "x,y,z,qx,qy,qz,qw",
             .limits = "finite, quaternion not 0"}),
        row<&S::view, &View::time>(
            {.group = "view",
             .name = "time",
             .help = "moment of the scene's animations and of the traces; where a sequence or a window begins",
             .unit = "s",
             .min = 0.0,
             .max = 1e6}),
        row<&S::view, &View::size>({.group = "view",
                                    .name = "size",
                                    .help = "size of ONE eye's picture; side by side is twice as wide",
                                    .unit = "px",
                                    .form = "WxH",
                                    .limits = "each 1..16384 px"}),
        row<&S::view, &View::eye>({.group = "view",
                                   .name = "eye",
                                   .help = "eyes that are drawn; centre: one eye midway",
                                   .choices = {"left", "right", "centre", "both"}}),
        row<&S::view, &View::ipdMm>({.group = "view",
                                     .name = "ipd-mm",
                                     .help = "distance between the two pupils; 0: both eyes see the same",
                                     .unit = "mm",
                                     .min = 0.0,
                                     .max = 200.0}),
        row<&S::view, &View::display>(
            {.group = "view",
             .name = "display",
             .help = "how two eyes share one picture: side by side, squeezed to half, red-cyan; mono: one eye",
             .choices = {"mono", "sbs", "sbs-half", "top-bottom", "anaglyph"}}),
        row<&S::view, &View::swapEyes>(
            {.group = "view", .name = "swap-eyes", .help = "left and right change places, for cross-eyed viewing"}),
        row<&S::view, &View::screenWidthMm>(
            {.group = "view",
             .name = "screen-width-mm",
             .help = "width of one eye's picture on your screen, so that depth appears true; needs the distance too",
             .unit = "mm",
             .min = 0.0,
             .max = 1e6,
             .minExclusive = true}),
        row<&S::view, &View::screenDistanceMm>({.group = "view",
                                                .name = "screen-distance-mm",
                                                .help = "distance from your eyes to the screen; needs the width too",
                                                .unit = "mm",
                                                .min = 0.0,
                                                .max = 1e6,
                                                .minExclusive = true}),

        row<&S::render, &Render::technique>(
            {.group = "render",
             .name = "technique",
             .help = "way of drawing defocus; pinhole draws none, all is sharp; mipmap is fast, accumulate accurate, "
                     "reference slow and exact; auto: whatever is most accurate within the budget, "
                     "with dials of its own",
             .choices = {"auto", "pinhole", "mipmap", "accumulate", "reference"}}),
        row<&S::render, &Render::budgetMs>(
            {.group = "render",
             .name = "budget-ms",
             .help =
                 "time for a frame, both eyes, that auto keeps to; not given: a frame of the sequence, the screen's "
                 "refresh; 1000 ms for one picture",
             .unit = "ms",
             .min = 0.0,
             .max = 1e6,
             .minExclusive = true}),
        row<&S::render, &Render::samples>(
            {.group = "render",
             .name = "samples",
             .help = "points of the lens that are averaged: of accumulate (32 where not said), of the reference (512)",
             .min = 1.0,
             .max = 65536.0}),
        row<&S::render, &Render::subsamples>(
            {.group = "render",
             .name = "subsamples",
             .help = "more points of the lens that each of accumulate's serves, on average, at a fraction of the price",
             .min = 0.0,
             .max = 16.0}),
        row<&S::render, &Render::msaa>({.group = "render",
                                        .name = "msaa",
                                        .help = "samples per pixel against jagged edges",
                                        .choices = {"0", "4"}}),
        row<&S::render, &Render::show>({.group = "render",
                                        .name = "show",
                                        .help = "a stage of the frame in place of the picture: vergence (depth), coc "
                                                "(blur: red before focus, blue behind), ...",
                                        .form = "none|vergence|coc|dob|don|level|lod|pyramid:0..12"}),
        row<&S::render, &Render::exposureEv>({.group = "render",
                                              .name = "exposure",
                                              .help = "exposure, +1 doubles the light",
                                              .unit = "EV",
                                              .min = -20.0,
                                              .max = 20.0}),
        row<&S::render, &Render::tonemap>({.group = "render",
                                           .name = "tonemap",
                                           .help = "how light beyond white is shown; none cuts it off",
                                           .choices = {"none", "neutral"}}),

        row<&S::system, &SystemSettings::context>(
            {.group = "system",
             .name = "context",
             .help = "what draws without a window: osmesa on the CPU, egl; auto: osmesa where built in",
             .choices = {"auto", "osmesa", "egl"}}),
        row<&S::system, &SystemSettings::maxSceneMb>({.group = "system",
                                                      .name = "max-scene-mb",
                                                      .help = "memory that loading a scene may take",
                                                      .unit = "MB",
                                                      .min = 1.0,
                                                      .max = 1e6}),
        row<&S::system, &SystemSettings::maxTextureSide>({.group = "system",
                                                          .name = "max-texture-side",
                                                          .help = "largest width or height of a scene's images",
                                                          .unit = "px",
                                                          .min = 1.0,
                                                          .max = values::kLargestSide}),
        row<&S::system, &SystemSettings::uiScale>({.group = "system",
                                                   .name = "ui-scale",
                                                   .help = "size of the window's text and buttons",
                                                   .min = 0.5,
                                                   .max = 4.0}),
        row<&S::system, &SystemSettings::monitor>(
            {.group = "system",
             .name = "monitor",
             .help = "monitor that full screen fills, by number from 1 or by name; not given: where the window is",
             .optional = true,
             .form = "NUMBER|NAME"}),
    };
}

}  // namespace

std::string Setting::rangeText() const {
    if (kind == SettingKind::boolean) return "true|false";
    std::string text;
    if (kind == SettingKind::number || (kind == SettingKind::integer && choices.empty())) {
        text = minExclusive ? "more than " + printNumber(min) + ", at most " + printNumber(max)
                            : printNumber(min) + ".." + printNumber(max);
    } else if (!form.empty()) {
        return std::string(form) + (limits.empty() ? "" : ", " + std::string(limits));
    }
    for (const std::string_view choice : choices) {
        if (!text.empty()) text += '|';
        text += choice;
    }
    return unit.empty() ? text : text + " " + std::string(unit);
}

std::span<const Setting> settingsTable() {
    static const std::vector<Setting> table = makeTable();
    return table;
}

void applySetting(Settings& settings, std::string_view name, std::string_view text) {
    std::vector<std::string_view> names;
    for (const Setting& setting : settingsTable()) {
        if (setting.name == name) return setting.set(settings, setting, text);
        names.push_back(setting.name);
    }
    const std::string_view nearest = nearestName(name, names);
    throw InputError("unknown setting " + quote(name) + (nearest.empty() ? "" : ", did you mean " + quote(nearest)));
}

}  // namespace dioptre
