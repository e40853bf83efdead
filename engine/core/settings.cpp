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
    setting.optional = setting.optional || values::kIsOptional<T>;
    setting.get = [](const Settings& s, const Setting& self) { return values::write(self, (s.*Group).*Member); };
    setting.set = [](Settings& s, const Setting& self, std::string_view text) {
        if (values::read(self, text, (s.*Group).*Member)) return;
        const std::string value = parseNumber(text) ? std::string(text) : quote(text);
        throw InputError(std::string(self.name) + ": " + value + " is not allowed, it takes " + self.rangeText());
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
        row<&S::lens, &Lens::lens>({.group = "lens",
                                    .name = "lens",
                                    .help = "lens or eye: a preset's name in config/lenses, or a file",
                                    .form = "NAME|FILE"}),
        row<&S::lens, &Lens::apertureMm>({.group = "lens",
                                          .name = "aperture-mm",
                                          .help = "diameter of the lens or pupil, not given: as the lens says",
                                          .unit = "mm",
                                          .min = 0.0,
                                          .max = 1000.0}),
        row<&S::lens, &Lens::ageYears>({.group = "lens",
                                        .name = "age",
                                        .help = "age of the eye, which limits its focus and pupil",
                                        .unit = "years",
                                        .min = 20.0,
                                        .max = 83.0}),
        row<&S::lens, &Lens::luminance>({.group = "lens",
                                         .name = "luminance",
                                         .help = "brightness the eye is adapted to, 10 is a lit room",
                                         .unit = "cd/m^2",
                                         .min = 1e-6,
                                         .max = 1e6}),

        row<&S::focus, &Focus::focus>({.group = "focus",
                                       .name = "focus",
                                       .help = "distance in focus, or what lies under the gaze",
                                       .unit = "m",
                                       .form = "METRES|inf|gaze",
                                       .limits = "0.001..1e9 m"}),
        row<&S::focus, &Focus::gaze>({.group = "focus",
                                      .name = "gaze",
                                      .help = "point looked at, from the picture's top left",
                                      .form = "X,Y",
                                      .limits = "each 0..1"}),
        row<&S::focus, &Focus::dynamics>({.group = "focus",
                                          .name = "focus-dynamics",
                                          .help = "how fast focus follows the gaze in a sequence",
                                          .choices = {"natural", "snappy", "instant"}}),
        row<&S::focus, &Focus::gazeErrorDeg>({.group = "focus",
                                              .name = "gaze-error-deg",
                                              .help = "standard deviation of the eye tracker",
                                              .unit = "degrees",
                                              .min = 0.0,
                                              .max = 10.0}),
        row<&S::focus, &Focus::gazeTrace>({.group = "focus",
                                           .name = "gaze-trace",
                                           .help = "file of recorded gaze points, for a sequence",
                                           .optional = true,
                                           .form = "FILE"}),
        row<&S::focus, &Focus::headTrace>({.group = "focus",
                                           .name = "head-trace",
                                           .help = "file of recorded head poses, for a sequence",
                                           .optional = true,
                                           .form = "FILE"}),

        row<&S::view, &View::camera>({.group = "view",
                                      .name = "camera",
                                      .help = "camera of the scene, not given: its first, else the scene is framed",
                                      .optional = true,
                                      .form = "NAME|INDEX"}),
        row<&S::view, &View::pose>(
            {.group = "view",
             .name = "pose",
             .help = "pose of the head: position in metres and quaternion, not given: the camera's",
             .form = "x,y,z,qx,qy,qz,qw",
             .limits = "finite, quaternion not 0"}),
        row<&S::view, &View::size>({.group = "view",
                                    .name = "size",
                                    .help = "size of one eye's picture",
                                    .unit = "px",
                                    .form = "WxH",
                                    .limits = "each 1..16384 px"}),
        row<&S::view, &View::eye>({.group = "view",
                                   .name = "eye",
                                   .help = "eyes that are drawn",
                                   .choices = {"left", "right", "centre", "both"}}),
        row<&S::view, &View::ipdMm>({.group = "view",
                                     .name = "ipd-mm",
                                     .help = "distance between the two pupils",
                                     .unit = "mm",
                                     .min = 0.0,
                                     .max = 200.0}),
        row<&S::view, &View::display>({.group = "view",
                                       .name = "display",
                                       .help = "how two eyes share one picture",
                                       .choices = {"mono", "sbs", "sbs-half", "top-bottom", "anaglyph"}}),
        row<&S::view, &View::swapEyes>(
            {.group = "view", .name = "swap-eyes", .help = "left and right change places, for cross-eyed viewing"}),
        row<&S::view, &View::screenWidthMm>({.group = "view",
                                             .name = "screen-width-mm",
                                             .help = "width of one eye's picture on the screen, not given: no screen",
                                             .unit = "mm",
                                             .min = 0.0,
                                             .max = 1e6,
                                             .minExclusive = true}),
        row<&S::view, &View::screenDistanceMm>({.group = "view",
                                                .name = "screen-distance-mm",
                                                .help = "distance from the eyes to the screen, not given: no screen",
                                                .unit = "mm",
                                                .min = 0.0,
                                                .max = 1e6,
                                                .minExclusive = true}),

        row<&S::render, &Render::technique>({.group = "render",
                                             .name = "technique",
                                             .help = "way of drawing defocus, pinhole draws none",
                                             .choices = {"pinhole", "mipmap"}}),
        row<&S::render, &Render::msaa>({.group = "render",
                                        .name = "msaa",
                                        .help = "samples per pixel against jagged edges",
                                        .choices = {"0", "4"}}),
        row<&S::render, &Render::show>({.group = "render",
                                        .name = "show",
                                        .help = "shows a stage of the frame in place of the picture",
                                        .form = "none|vergence|coc|dob|don|level|pyramid:0..12"}),
        row<&S::render, &Render::exposureEv>({.group = "render",
                                              .name = "exposure",
                                              .help = "exposure, +1 doubles the light",
                                              .unit = "EV",
                                              .min = -20.0,
                                              .max = 20.0}),
        row<&S::render, &Render::tonemap>({.group = "render",
                                           .name = "tonemap",
                                           .help = "how light beyond white is shown, none cuts it off",
                                           .choices = {"none", "neutral"}}),

        row<&S::system, &SystemSettings::context>(
            {.group = "system", .name = "context", .help = "headless OpenGL context", .choices = {"osmesa", "egl"}}),
    };
}

}  // namespace

std::string Setting::rangeText() const {
    if (kind == SettingKind::boolean) return "true|false";
    std::string text;
    if (kind == SettingKind::number) {
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
