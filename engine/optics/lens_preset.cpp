#include "optics/lens_preset.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <string_view>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/text.hpp"

namespace dioptre {

namespace {

using nlohmann::json;

constexpr double kLargestDiameter = 1.0;   // m; 0.2 m is a large lens, beyond 1 m somebody mistook a unit
constexpr double kBrightest = 1e8;         // cd/m2; the sun's disc has 1.6e9, nobody adapts to it
constexpr double kAges[2] = {3.0, 120.0};  // years; below 3 accommodation was not measured
constexpr double kClosestFocus = 1.001;    // focal lengths; keeps the image within 1001 of them behind the lens

constexpr std::array<std::string_view, 11> kKeys = {
    "name",     "description", "kind",          "focalLengthMm",      "apertureDiameterMm",
    "fNumber",  "ageYears",    "accommodation", "refractionDioptres", "pupilFieldSquareDegrees",
    "pupilEyes"};
constexpr std::array<std::string_view, 5> kEyeKeys = {"ageYears", "accommodation", "refractionDioptres",
                                                      "pupilFieldSquareDegrees", "pupilEyes"};
constexpr std::array<std::string_view, 1> kCameraKeys = {"fNumber"};

bool contains(std::span<const std::string_view> names, std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// The file's top-level object, read key by key; every complaint names the file.
class Prescription {
  public:
    explicit Prescription(const std::filesystem::path& file) : file_(file.string()) {
        constexpr std::size_t kLimitBytes = 1 << 20;  // a prescription is a few hundred bytes
        const std::string text = readFile(file, kLimitBytes);
        std::set<std::string> seen;
        const auto refuseRepeats = [&](int depth, json::parse_event_t event, json& parsed) {
            if (event == json::parse_event_t::key && depth == 1 && !seen.insert(parsed.get<std::string>()).second)
                fail(fmt::format("key {} appears twice", quote(parsed.get<std::string>())));
            return true;
        };
        try {
            root_ = json::parse(text, refuseRepeats, true, true);
        } catch (const json::exception& e) {
            fail("broken JSON" + reasonOf(e.what()) + "; a lens preset is as those in config/lenses");
        }
        if (!root_.is_object()) fail(fmt::format("holds {}, must be an object", root_.type_name()));
    }

    [[noreturn]] void fail(const std::string& what) const { throw InputError(fmt::format("{}: {}", file_, what)); }

    const json& root() const { return root_; }
    bool has(std::string_view key) const { return root_.contains(key); }

    const json& required(std::string_view key) const {
        const auto found = root_.find(key);
        if (found == root_.end()) fail(fmt::format("key '{}' is missing", key));
        return *found;
    }

    std::string text(std::string_view key) const {
        const json& value = required(key);
        if (!value.is_string()) fail(fmt::format("{}: {}, must be text", key, quote(value.dump())));
        return value.get<std::string>();
    }

    double number(std::string_view key, double least, double most) const {
        const json& value = required(key);
        const double number = value.is_number() ? value.get<double>() : std::nan("");
        if (!(number >= least && number <= most))
            fail(fmt::format("{}: {}, must be a number from {} to {}", key, quote(value.dump()), least, most));
        return number;
    }

    std::size_t choice(std::string_view key, std::span<const std::string_view> names) const {
        const json& value = required(key);
        for (std::size_t i = 0; i < names.size(); ++i)
            if (value.is_string() && value.get_ref<const std::string&>() == names[i]) return i;
        fail(fmt::format("{}: {}, must be one of {}", key, quote(value.dump()), fmt::join(names, ", ")));
    }

  private:
    /// Of "[json.exception.parse_error.101] parse error at line 1, column 2: syntax error - ...; last read: ..." the
    /// place.
    static std::string reasonOf(std::string_view what) {
        const std::size_t begin = what.find(" at line "), end = what.find(':', begin);
        return begin == std::string_view::npos ? "" : std::string(what.substr(begin, end - begin));
    }

    std::string file_;
    json root_;
};

void checkKeys(const Prescription& file, LensKind kind) {
    for (const auto& [key, value] : file.root().items()) {
        if (!contains(kKeys, key)) {
            const std::string_view nearest = nearestName(key, kKeys);
            file.fail(fmt::format("unknown key {}{}", quote(key),
                                  nearest.empty() ? "" : fmt::format(", did you mean '{}'?", nearest)));
        }
        if (kind == LensKind::camera && contains(kEyeKeys, key)) file.fail(fmt::format("{}: a camera has none", key));
        if (kind == LensKind::eye && contains(kCameraKeys, key)) file.fail(fmt::format("{}: an eye has none", key));
    }
}

std::optional<Metres> readAperture(const Prescription& file, LensKind kind, Metres focalLength) {
    const bool hasDiameter = file.has("apertureDiameterMm"), hasNumber = file.has("fNumber");
    if (hasDiameter && hasNumber) file.fail("apertureDiameterMm and fNumber: must not both be given");
    if (hasDiameter) return Metres(1e-3 * file.number("apertureDiameterMm", 0.0, 1e3 * kLargestDiameter));
    if (hasNumber) return focalLength / file.number("fNumber", 0.1, 1000.0);
    if (kind == LensKind::camera) file.fail("key 'apertureDiameterMm' or 'fNumber' is missing");
    return std::nullopt;
}

void readEye(const Prescription& file, LensPreset& preset) {
    constexpr std::array<std::string_view, 4> kAccommodation = {"unlimited", "hofstetter-minimum", "hofstetter-mean",
                                                                "hofstetter-maximum"};
    if (file.has("ageYears")) preset.ageYears = file.number("ageYears", kAges[0], kAges[1]);
    if (file.has("accommodation"))
        if (const std::size_t choice = file.choice("accommodation", kAccommodation); choice > 0)
            preset.accommodation = static_cast<AmplitudeEstimate>(choice - 1);
    if (file.has("refractionDioptres")) preset.refraction = Dioptres(file.number("refractionDioptres", -20.0, 20.0));
    if (file.has("pupilFieldSquareDegrees"))
        preset.pupilField = file.number("pupilFieldSquareDegrees", 0.1, 41253.0);  // the whole sphere
    if (file.has("pupilEyes")) {
        const double eyes = file.number("pupilEyes", 1.0, 2.0);
        preset.pupilEyes = static_cast<int>(eyes);
        if (eyes != preset.pupilEyes) file.fail(fmt::format("pupilEyes: '{}', must be 1 or 2", eyes));
    }
}

void requireWithin(std::string_view what, double value, double least, double most) {
    if (!(value >= least && value <= most))
        throw InputError(fmt::format("lens: {} {}, must be from {} to {}", what, value, least, most));
}

}  // namespace

LensPreset loadLensPreset(const std::filesystem::path& path) {
    constexpr std::array<std::string_view, 2> kKinds = {"eye", "camera"};
    const Prescription file(path);
    LensPreset preset;
    preset.kind = static_cast<LensKind>(file.choice("kind", kKinds));
    checkKeys(file, preset.kind);
    preset.name = file.text("name");
    if (file.has("description")) preset.description = file.text("description");
    preset.focalLength = Metres(1e-3 * file.number("focalLengthMm", 1.0, 2000.0));
    preset.apertureDiameter = readAperture(file, preset.kind, preset.focalLength);
    if (preset.kind == LensKind::eye) readEye(file, preset);
    return preset;
}

ResolvedLens resolveLens(const LensPreset& preset, const LensConditions& conditions, Dioptres target) {
    if (!std::isfinite(target.value))
        throw InputError(fmt::format("lens: focus target {} D, must be finite", target.value));
    requireWithin("luminance (cd/m2)", conditions.luminance, 0.0, kBrightest);
    if (conditions.ageYears) requireWithin("age (years)", *conditions.ageYears, kAges[0], kAges[1]);
    if (conditions.apertureDiameter)
        requireWithin("aperture diameter (m)", conditions.apertureDiameter->value, 0.0, kLargestDiameter);

    ResolvedLens resolved;
    const double ageYears = conditions.ageYears.value_or(preset.ageYears);
    if (conditions.apertureDiameter) {
        resolved.apertureDiameter = *conditions.apertureDiameter;
    } else if (preset.apertureDiameter) {
        resolved.apertureDiameter = *preset.apertureDiameter;
    } else {
        resolved.apertureDiameter =
            pupilDiameter({conditions.luminance, preset.pupilField, ageYears, preset.pupilEyes});
    }

    // What the optics can do at all; accommodation narrows it.
    const Dioptres nearestOfAll = vergence(preset.focalLength * kClosestFocus);
    resolved.range = {Dioptres(0.0) - preset.refraction, nearestOfAll};
    const bool limited = preset.accommodation || (preset.kind == LensKind::eye && conditions.ageYears);
    if (limited) {
        const auto estimate = preset.accommodation.value_or(AmplitudeEstimate::mean);
        resolved.range = accommodationRange(preset.refraction, accommodationAmplitude(ageYears, estimate));
        resolved.range.nearest = std::min(resolved.range.nearest, nearestOfAll);
    }
    resolved.range.farthest = std::min(resolved.range.farthest, resolved.range.nearest);

    const ReachedFocus reached = reachFocus(target, resolved.range);
    resolved.residual = reached.residual;
    resolved.focusLimited = reached.focus != target;
    resolved.lens = {resolved.apertureDiameter / 2.0, preset.focalLength, reached.focus};
    validate(resolved.lens);
    return resolved;
}

}  // namespace dioptre
