// The one settings tree: plain members for the code, one table (name, unit, default, range, help) for the command line,
// JSON files and the panel. Order: built-in defaults < --config file < command line.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dioptre {

struct LensSettings {
    std::string lens = "eye";          // a preset's name in config/lenses, or a file
    std::optional<double> apertureMm;  // DIAMETER of lens or pupil; none: the lens's own
    std::optional<double> ageYears;    // of the eye; none: the lens's own
    double luminance = 10.0;           // what the eye adapts to, cd/m^2
    int blades = 0;                    // of the aperture; 0: round
    double bladeRotationDeg = 0.0;
};

enum class FocusMode { metres, infinity, gaze };

struct FocusChoice {
    FocusMode mode = FocusMode::gaze;
    double metres = 0.0;  // > 0 where mode is metres

    bool operator==(const FocusChoice&) const = default;
};

enum class DynamicsChoice { natural, snappy, instant };
enum class GazeSource { pointer, point };

struct FocusSettings {
    FocusChoice focus;
    std::array<double, 2> gaze = {0.5, 0.5};      // x, y in 0..1 from the top left
    GazeSource gazeSource = GazeSource::pointer;  // in a window, where no trace says it
    DynamicsChoice dynamics = DynamicsChoice::natural;
    double gazeErrorDeg = 0.5;  // standard deviation of the tracker, degrees
    std::string gazeTrace;      // file; empty: none
    std::string headTrace;      // file; empty: none
};

struct PictureSize {
    int width = 640;
    int height = 480;

    bool operator==(const PictureSize&) const = default;
};

enum class EyeChoice { left, right, centre, both };
enum class DisplayChoice { mono, sideBySide, sideBySideHalf, topBottom, anaglyph };
inline constexpr int kDisplays = 5;

struct ViewSettings {
    std::string camera;                         // glTF camera, name or index; empty: the first
    std::optional<std::array<double, 7>> pose;  // x, y, z in metres, quaternion x, y, z, w (not zero; any length)
    PictureSize size;                           // ONE eye's picture, px
    EyeChoice eye = EyeChoice::both;
    double ipdMm = 63.0;
    DisplayChoice display = DisplayChoice::sideBySide;
    bool swapEyes = false;
    double time = 0.0;  // seconds: of a picture; where a sequence or a window begins
    std::optional<double> screenWidthMm;
    std::optional<double> screenDistanceMm;
};

enum class TechniqueChoice { pinhole, mipmap, accumulate, reference };
enum class ToneMapChoice { none, neutral };
enum class ShowChoice { none, vergence, coc, dob, don, level, lod, pyramid };

struct ShowStage {
    ShowChoice stage = ShowChoice::none;
    int level = 0;  // 0..12, where stage is pyramid

    bool operator==(const ShowStage&) const = default;
};

struct RenderSettings {
    std::optional<TechniqueChoice> technique;  // none: the most accurate that the budget affords
    std::optional<double> budgetMs;            // of a frame, all eyes; none: as the command has it
    int msaa = 4;                              // samples per pixel: 0 or 4
    std::optional<int> samples;                // lens samples of accumulate or reference; none: the technique's own
    int subsamples = 4;                        // of each of accumulate's samples
    ShowStage show;
    double exposureEv = 0.0;
    ToneMapChoice tonemap = ToneMapChoice::none;
};

enum class ContextChoice { automatic, osmesa, egl };

struct SystemSettings {
    ContextChoice context = ContextChoice::automatic;
    int maxSceneMb = 6144;       // memory that loading a scene may take, 2^20 bytes
    int maxTextureSide = 16384;  // px
    double uiScale = 1.0;        // of the window's text
    std::string monitor;         // of full screen: its number from 1 or its name; empty: where the window is
};

struct Settings {
    LensSettings lens;
    FocusSettings focus;
    ViewSettings view;
    RenderSettings render;
    SystemSettings system;
};

enum class SettingKind { number, integer, boolean, text, choice };

/// One row of the table: everything that the command line, a file or a panel needs to know about one setting.
struct Setting {
    std::string_view group;  // "lens"
    std::string_view name;   // "aperture-mm": --aperture-mm, and { "lens": { "aperture-mm": ... } }
    SettingKind kind = SettingKind::text;
    std::string_view help;                       // one line
    std::string_view unit = "";                  // "mm"; empty: none
    double min = 0.0, max = 0.0;                 // number; integer without choices
    bool minExclusive = false;                   // number: min itself is not allowed
    bool optional = false;                       // may be empty (null in a file)
    std::vector<std::string_view> choices = {};  // choice; integer: the values allowed
    std::string_view form = "";                  // text: how it is written, "METRES|inf|gaze"
    std::string_view limits = "";                // text: what its numbers may be, "0.001..1e9 m"

    /// The value as text; empty for an optional one that is not set. Numbers read back to the same bits.
    std::string (*get)(const Settings&, const Setting&) = nullptr;
    /// InputError "NAME: VALUE is not ...: LIMIT".
    void (*set)(Settings&, const Setting&, std::string_view text) = nullptr;
    std::string defaultText = {};

    /// "0..1000 mm", "left|right|centre|both": what is allowed, for help and errors.
    std::string rangeText() const;
};

/// Every setting, in order of groups.
std::span<const Setting> settingsTable();

/// Sets one by its name ("aperture-mm"). InputError: unknown name (with the nearest known one), wrong value.
void applySetting(Settings& settings, std::string_view name, std::string_view text);

/// Reads a JSON file with comments, { "group": { "name": value } }, over `settings`; what it does not name stays.
/// InputError "FILE:LINE: ..." for broken JSON, unknown or repeated keys, wrong types, values out of range.
void loadSettings(const std::filesystem::path& path, Settings& settings);
/// The same from memory; `where` stands for the file's name in errors.
void parseSettings(std::string_view json, std::string_view where, Settings& settings);

/// The whole tree as JSON; read back it gives the same settings, to the bit.
std::string printSettings(const Settings& settings);

}  // namespace dioptre
