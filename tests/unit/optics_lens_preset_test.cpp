#include "optics/lens_preset.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <string>

#include "core/error.hpp"

namespace dioptre {
namespace {

LensPreset shipped(const std::string& name) {
    return loadLensPreset(std::filesystem::path(DIOPTRE_CONFIG) / "lenses" / (name + ".json"));
}

/// A prescription in a file of its own that goes away with the object.
class PresetFile {
  public:
    explicit PresetFile(const std::string& text)
        : path_(std::filesystem::temp_directory_path() / ("dioptre_lens_" + std::to_string(getpid()) + ".json")) {
        std::ofstream(path_) << text;
    }
    ~PresetFile() { std::filesystem::remove(path_); }
    PresetFile(const PresetFile&) = delete;
    PresetFile& operator=(const PresetFile&) = delete;
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

std::string errorOf(const std::string& text) {
    const PresetFile file(text);
    try {
        loadLensPreset(file.path());
    } catch (const InputError& error) {
        const std::string message = error.what();
        EXPECT_EQ(message.find(file.path().string()), 0u) << message;
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        return message;
    }
    return "accepted";
}

TEST(LensPresetTest, EveryShippedLensLoadsAndResolves) {
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(DIOPTRE_CONFIG) / "lenses")) {
        SCOPED_TRACE(entry.path().string());
        const LensPreset preset = loadLensPreset(entry.path());
        EXPECT_EQ(preset.name, entry.path().stem().string());
        EXPECT_FALSE(preset.description.empty());
        for (const double target : {0.0, 0.5, 3.0, 100.0, -5.0})
            EXPECT_NO_THROW(validate(resolveLens(preset, {}, Dioptres(target)).lens)) << target;
        ++count;
    }
    EXPECT_GE(count, 6);
}

TEST(LensPresetTest, DefaultEyeFocusesAnywhereWithAPupil) {
    const LensPreset eye = shipped("eye");
    LensConditions conditions;
    conditions.luminance = 100.0;
    const ResolvedLens dim = resolveLens(eye, conditions, Dioptres(10.0));
    EXPECT_FALSE(dim.focusLimited);
    EXPECT_EQ(dim.residual.value, 0.0);
    EXPECT_EQ(dim.lens.focus.value, 10.0);
    EXPECT_EQ(dim.lens.focalLength.value, 0.01667);
    EXPECT_NEAR(dim.apertureDiameter.value, pupilDiameter({100.0, 2827.43, 25.0, 2}).value, 1e-15);
    EXPECT_EQ(dim.lens.apertureRadius.value, dim.apertureDiameter.value / 2.0);
    conditions.luminance = 1e4;
    EXPECT_LT(resolveLens(eye, conditions, Dioptres(0.0)).apertureDiameter, dim.apertureDiameter);
}

TEST(LensPresetTest, AgeLimitsAccommodation) {
    const ResolvedLens old = resolveLens(shipped("eye-60"), {}, Dioptres(3.0));  // amplitude 0.5 D
    EXPECT_TRUE(old.focusLimited);
    EXPECT_NEAR(old.lens.focus.value, 0.5, 1e-12);
    EXPECT_NEAR(old.residual.value, 2.5, 1e-12);
    EXPECT_NEAR(old.range.nearest.value, 0.5, 1e-12);
    EXPECT_FALSE(resolveLens(shipped("eye-20"), {}, Dioptres(3.0)).focusLimited);
    EXPECT_NEAR(resolveLens(shipped("eye-40"), {}, Dioptres(9.0)).lens.focus.value, 6.5, 1e-12);

    LensConditions sixty;
    sixty.ageYears = 60.0;
    EXPECT_NEAR(resolveLens(shipped("eye"), sixty, Dioptres(3.0)).lens.focus.value, 0.5, 1e-12);
    EXPECT_NEAR(resolveLens(shipped("eye-20"), sixty, Dioptres(3.0)).lens.focus.value, 0.5, 1e-12);
    EXPECT_FALSE(resolveLens(shipped("camera-50mm-f1.4"), sixty, Dioptres(3.0)).focusLimited);
}

TEST(LensPresetTest, ApertureOverride) {
    for (const double diameter : {0.0, 0.004, 0.2, 1.0}) {
        LensConditions conditions;
        conditions.apertureDiameter = Metres(diameter);
        for (const char* name : {"eye", "camera-50mm-f1.4"}) {
            const ResolvedLens resolved = resolveLens(shipped(name), conditions, Dioptres(0.5));
            EXPECT_EQ(resolved.lens.apertureRadius.value, diameter / 2.0) << name;
        }
    }
    EXPECT_NEAR(resolveLens(shipped("camera-50mm-f1.4"), {}, Dioptres(0.5)).lens.apertureRadius.value,
                0.017857142857142856, 1e-16);
    EXPECT_NEAR(resolveLens(shipped("lkc09-eye"), {}, Dioptres(0.0)).lens.apertureRadius.value, 0.002, 1e-16);
}

TEST(LensPresetTest, GazeNearerThanTheFocalLengthIsClamped) {
    const ResolvedLens resolved = resolveLens(shipped("eye"), {}, Dioptres(100.0));
    EXPECT_TRUE(resolved.focusLimited);
    EXPECT_GT(resolved.residual.value, 0.0);
    EXPECT_NEAR(distance(resolved.lens.focus).value, 0.01667 * 1.001, 1e-12);
    // 1 mm beyond F is within reach
    EXPECT_FALSE(resolveLens(shipped("camera-50mm-f1.4"), {}, vergence(Metres(0.051))).focusLimited);
    EXPECT_FALSE(resolveLens(shipped("eye"), {}, vergence(Metres(0.01767))).focusLimited);
}

TEST(LensPresetTest, RefractionShiftsTheRange) {
    LensPreset eye = shipped("eye-40");
    eye.refraction = Dioptres(-2.0);
    const ResolvedLens myope = resolveLens(eye, {}, Dioptres(0.0));
    EXPECT_EQ(myope.lens.focus.value, 2.0);
    EXPECT_EQ(myope.residual.value, -2.0);
    LensConditions sixtyFive;
    sixtyFive.ageYears = 65.0;  // no accommodation left
    eye.refraction = Dioptres(2.0);
    const ResolvedLens hyperope = resolveLens(eye, sixtyFive, Dioptres(0.0));
    EXPECT_EQ(hyperope.lens.focus.value, -2.0);
    EXPECT_EQ(hyperope.residual.value, 2.0);
    EXPECT_TRUE(hyperope.focusLimited);
}

TEST(LensPresetTest, BadConditionsAreRefused) {
    const LensPreset eye = shipped("eye");
    const auto with = [&](auto change) {
        LensConditions conditions;
        change(conditions);
        return resolveLens(eye, conditions, Dioptres(1.0));
    };
    EXPECT_THROW(with([](auto& c) { c.luminance = -1.0; }), InputError);
    EXPECT_THROW(with([](auto& c) { c.luminance = std::nan(""); }), InputError);
    EXPECT_THROW(with([](auto& c) { c.ageYears = 2.0; }), InputError);
    EXPECT_THROW(with([](auto& c) { c.ageYears = 121.0; }), InputError);
    EXPECT_THROW(with([](auto& c) { c.apertureDiameter = Metres(-0.001); }), InputError);
    EXPECT_THROW(with([](auto& c) { c.apertureDiameter = Metres(1.001); }), InputError);
    EXPECT_THROW(resolveLens(eye, {}, Dioptres(std::nan(""))), InputError);
    EXPECT_THROW(resolveLens(eye, {}, Dioptres(std::numeric_limits<double>::infinity())), InputError);
}

TEST(LensPresetTest, CommentsAreFineAndDefaultsHold) {
    const PresetFile file("// my eye\n{\"name\": \"a\", /* c */ \"kind\": \"eye\", \"focalLengthMm\": 17}\n");
    const LensPreset preset = loadLensPreset(file.path());
    EXPECT_EQ(preset.name, "a");
    EXPECT_FALSE(preset.apertureDiameter);
    EXPECT_FALSE(preset.accommodation);
    EXPECT_EQ(preset.focalLength.value, 0.017);
    EXPECT_EQ(preset.ageYears, 28.58);
}

struct BadPreset {
    std::string text;
    std::string mustName;  // what the message has to contain
};

TEST(LensPresetTest, BadFilesNameTheKeyAndTheRange) {
    const std::string eye = R"({"name": "a", "kind": "eye", "focalLengthMm": 17)";
    const std::string camera = R"({"name": "a", "kind": "camera", "focalLengthMm": 50)";
    const std::vector<BadPreset> cases = {
        {"", "broken JSON at line 1"},
        {"{", "broken JSON at line 1"},
        {"[1]", "array"},
        {"null", "null"},
        {R"({"name": "a", "focalLengthMm": 17})", "kind"},
        {R"({"name": "a", "kind": "telescope", "focalLengthMm": 17})", "eye, camera"},
        {R"({"name": "a", "kind": 7, "focalLengthMm": 17})", "kind"},
        {R"({"kind": "eye", "focalLengthMm": 17})", "name"},
        {R"({"name": 3, "kind": "eye", "focalLengthMm": 17})", "name"},
        {R"({"name": "a", "kind": "eye"})", "focalLengthMm"},
        {R"({"name": "a", "kind": "eye", "focalLengthMm": "17"})", "focalLengthMm"},
        {R"({"name": "a", "kind": "eye", "focalLengthMm": 0})", "from 1 to 2000"},
        {R"({"name": "a", "kind": "eye", "focalLengthMm": 1e999})", ""},
        {eye + R"(, "ageYears": 2})", "from 3 to 120"},
        {eye + R"(, "ageYears": true})", "ageYears"},
        {eye + R"(, "agesYears": 30})", "did you mean 'ageYears'"},
        {eye + R"(, "ageYears": 30, "ageYears": 40})", "twice"},
        {eye + R"(, "accommodation": "none"})", "unlimited, hofstetter-minimum"},
        {eye + R"(, "refractionDioptres": -21})", "from -20 to 20"},
        {eye + R"(, "pupilFieldSquareDegrees": 0})", "pupilFieldSquareDegrees"},
        {eye + R"(, "pupilEyes": 3})", "pupilEyes"},
        {eye + R"(, "pupilEyes": 1.5})", "pupilEyes"},
        {eye + R"(, "apertureDiameterMm": -1})", "from 0 to 1000"},
        {eye + R"(, "apertureDiameterMm": null})", "apertureDiameterMm"},
        {eye + R"(, "fNumber": 4})", "fNumber"},
        {camera + "}", "fNumber"},
        {camera + R"(, "fNumber": 0})", "fNumber"},
        {camera + R"(, "fNumber": 2, "apertureDiameterMm": 25})", "both"},
        {camera + R"(, "fNumber": 2, "ageYears": 30})", "ageYears"},
        {"{\"name\": \"\xff\", \"kind\": \"eye\", \"focalLengthMm\": 17}", "broken JSON at line 1"},
    };
    for (const BadPreset& bad : cases) {
        SCOPED_TRACE(bad.text);
        const std::string message = errorOf(bad.text);
        EXPECT_NE(message, "accepted");
        EXPECT_NE(message.find(bad.mustName), std::string::npos) << message;
    }
    EXPECT_THROW(loadLensPreset("/nowhere/lens.json"), InputError);
    EXPECT_THROW(loadLensPreset(std::filesystem::temp_directory_path()), InputError);
}

}  // namespace
}  // namespace dioptre
