// The settings tree: table, files with line numbers in errors, round trips, order of sources.
#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>
#include <string>

#include "core/error.hpp"
#include "core/settings.hpp"

namespace dioptre {
namespace {

std::string valueOf(const Settings& settings, std::string_view name) {
    for (const Setting& setting : settingsTable())
        if (setting.name == name) return setting.get(settings, setting);
    return "no such setting";
}

std::string errorOf(std::string_view json) {
    Settings settings;
    try {
        parseSettings(json, "f.json", settings);
    } catch (const InputError& e) {
        EXPECT_EQ(printSettings(settings), printSettings(Settings{})) << "an error changed the settings";
        EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
        return e.what();
    }
    return "none";
}

std::string errorOf(std::string_view name, std::string_view text) {
    Settings settings;
    try {
        applySetting(settings, name, text);
    } catch (const InputError& e) {
        return e.what();
    }
    return "none";
}

TEST(SettingsTest, TheTableIsCompleteAndItsDefaultsAreTheBuiltInOnes) {
    std::set<std::string_view> names;
    Settings again;
    for (const Setting& setting : settingsTable()) {
        SCOPED_TRACE(setting.name);
        EXPECT_TRUE(names.insert(setting.name).second);
        EXPECT_FALSE(setting.help.empty());
        EXPECT_FALSE(setting.rangeText().empty());
        if (setting.kind == SettingKind::number) {
            EXPECT_LT(setting.min, setting.max);
        }
        EXPECT_EQ(setting.defaultText, setting.get(Settings{}, setting));
        setting.set(again, setting, setting.defaultText);
    }
    EXPECT_EQ(printSettings(again), printSettings(Settings{}));
}

TEST(SettingsTest, DefaultFileHoldsEverySettingWithItsBuiltInDefault) {
    // From other values, so that what the file leaves out would show.
    Settings settings;
    for (const auto& [name, text] : {std::pair("lens", "x"),
                                     {"aperture-mm", "3"},
                                     {"age", "30"},
                                     {"luminance", "1"},
                                     {"focus", "2"},
                                     {"gaze", "0,0"},
                                     {"gaze-source", "point"},
                                     {"focus-dynamics", "instant"},
                                     {"gaze-error-deg", "1"},
                                     {"gaze-trace", "g"},
                                     {"head-trace", "h"},
                                     {"camera", "c"},
                                     {"pose", "1,2,3,0,0,0,1"},
                                     {"time", "2"},
                                     {"size", "8x8"},
                                     {"eye", "left"},
                                     {"ipd-mm", "60"},
                                     {"display", "mono"},
                                     {"swap-eyes", "true"},
                                     {"screen-width-mm", "9"},
                                     {"screen-distance-mm", "9"},
                                     {"technique", "pinhole"},
                                     {"budget-ms", "20"},
                                     {"samples", "64"},
                                     {"subsamples", "2"},
                                     {"blades", "6"},
                                     {"blade-rotation-deg", "30"},
                                     {"msaa", "0"},
                                     {"show", "coc"},
                                     {"exposure", "1"},
                                     {"tonemap", "neutral"},
                                     {"context", "egl"},
                                     {"max-scene-mb", "100"},
                                     {"max-texture-side", "256"},
                                     {"ui-scale", "2"},
                                     {"monitor", "2"}})
        applySetting(settings, name, text);
    for (const Setting& setting : settingsTable())
        EXPECT_NE(setting.get(settings, setting), setting.defaultText) << setting.name << " is missing in this test";
    loadSettings(DIOPTRE_CONFIG "/default.json", settings);
    EXPECT_EQ(printSettings(settings), printSettings(Settings{}));
}

TEST(SettingsTest, PrintedSettingsReadBackToTheBit) {
    Settings settings;
    settings.lens.lens = "a \"quoted\"\\name\twith tab, ä";
    settings.lens.apertureMm = 0.1 + 0.2;
    settings.lens.luminance = 1.0 / 3.0;
    settings.focus.focus = {FocusMode::metres, 1.0 / 7.0};
    settings.focus.gaze = {1.0 / 3.0, 0.1};
    settings.view.pose = {{1e-9, -2.0 / 3.0, 3, 0.1, 0.2, 0.3, 0.9}};
    settings.view.size = {1, 16384};
    settings.view.eye = EyeChoice::centre;
    settings.view.display = DisplayChoice::sideBySideHalf;
    settings.view.swapEyes = true;
    settings.view.screenWidthMm = 123.456;
    settings.render.msaa = 0;
    settings.render.show = {ShowChoice::pyramid, 12};
    settings.render.exposureEv = -1e-6;
    Settings back;
    parseSettings(printSettings(settings), "printed", back);
    EXPECT_EQ(printSettings(back), printSettings(settings));
    EXPECT_EQ(back.lens.lens, settings.lens.lens);
    EXPECT_EQ(back.lens.apertureMm, settings.lens.apertureMm);
    EXPECT_EQ(back.lens.luminance, settings.lens.luminance);
    EXPECT_EQ(back.focus.focus, settings.focus.focus);
    EXPECT_EQ(back.focus.gaze, settings.focus.gaze);
    EXPECT_EQ(back.view.pose, settings.view.pose);
    EXPECT_EQ(back.view.size, settings.view.size);
    EXPECT_EQ(back.view.display, settings.view.display);
    EXPECT_EQ(back.render.show, settings.render.show);
}

TEST(SettingsTest, FilesChangeOnlyWhatTheyName) {
    Settings settings;
    settings.lens.luminance = 5.0;
    parseSettings(R"({ "lens": { "aperture-mm": 4 }, "focus": { "focus": 2.5 }, "view": { "camera": 3 } })", "f",
                  settings);
    EXPECT_EQ(settings.lens.apertureMm, 4.0);
    EXPECT_EQ(settings.lens.luminance, 5.0);
    EXPECT_EQ(settings.focus.focus, (FocusChoice{FocusMode::metres, 2.5}));
    EXPECT_EQ(settings.view.camera, "3");
    // default < file < command line
    applySetting(settings, "aperture-mm", "6");
    EXPECT_EQ(settings.lens.apertureMm, 6.0);
    parseSettings(R"({ "lens": { "aperture-mm": null } })", "f", settings);
    EXPECT_FALSE(settings.lens.apertureMm.has_value());
    parseSettings("{}", "f", settings);
    parseSettings("\xEF\xBB\xBF// a byte order mark\n{ \"lens\": {} }", "f", settings);
}

TEST(SettingsTest, ErrorsInFilesNameFileLineAndLimit) {
    const struct {
        const char *json, *error;
    } cases[] = {
        {"{\n // c\n /* d\n */ \"lens\": {\n  \"aperture-mm\":\n\n  2000 } }",
         "f.json:5: lens.aperture-mm: 2000 is not allowed, it takes 0..1000 mm"},
        {"{ \"lens\": {\n\n \"apertur-mm\": 1 } }",
         "f.json:3: unknown setting 'lens.apertur-mm', did you mean 'aperture-mm'"},
        {"{\n\"lense\": {} }", "f.json:2: unknown group 'lense', did you mean 'lens'"},
        {"{ \"lens\": { \"quite-else\": 1 } }", "f.json:1: unknown setting 'lens.quite-else'"},
        {"{ \"view\": {\n\"age\": 30 } }", "f.json:2: view.age: this setting belongs into group 'lens'"},
        {"{ \"lens\": { \"age\": 30,\n // \"age\"\n \"luminance\": 2,\n \"age\": 31 } }",
         "f.json:4: lens.age: given twice, first in line 1"},
        {"{ \"lens\": {},\n \"view\": {},\n \"lens\": {} }", "f.json:3: lens: given twice, first in line 1"},
        {"{ \"view\": {\r\n \"swap-eyes\": 1\r\n} }",
         "f.json:2: view.swap-eyes: 1 is of the wrong type, it takes true|false"},
        {"{ \"lens\": { \"age\": \"old\" } }",
         "f.json:1: lens.age: 'old' is of the wrong type, it takes 20..83 years, or null"},
        {"{ \"lens\": { \"luminance\": null } }",
         "f.json:1: lens.luminance: null is of the wrong type, it takes 1e-06..1e+06 cd/m^2"},
        {"{ \"view\": { \"size\": [8, 8] } }",
         "f.json:1: view.size: an array is of the wrong type, it takes WxH, each 1..16384 px"},
        {"{ \"view\": { \"size\":\n {} } }",
         "f.json:1: view.size: an object is of the wrong type, it takes WxH, each 1..16384 px"},
        {"{ \"render\": { \"msaa\": 2 } }", "f.json:1: render.msaa: 2 is not allowed, it takes 0|4"},
        {"{ \"render\": { \"msaa\": 4.5 } }", "f.json:1: render.msaa: 4.5 is not allowed, it takes 0|4"},
        {"{ \"view\": { \"eye\": \"a\\nb\" } }",
         "f.json:1: view.eye: 'a?b' is not allowed, it takes left|right|centre|both"},
        {"{ \"lens\":\n 4 }", "f.json:1: lens: 4 in place of an object { \"name\": value }"},
        {"\n[]", "f.json:2: an array in place of an object { \"group\": { \"name\": value } }"},
    };
    for (const auto& c : cases) EXPECT_EQ(errorOf(c.json), c.error) << c.json;
}

TEST(SettingsTest, BrokenJsonNamesItsLine) {
    for (const auto& [json, start] : {std::pair("{ \"lens\": {\n \"age\": 30,\n } }", "f.json:3: broken JSON: "),
                                      {"", "f.json:1: broken JSON: "},
                                      {"{ \"lens\": {", "f.json:1: broken JSON: "},
                                      {"{}\n{}", "f.json:2: broken JSON: "},
                                      {"{ \"lens\": { \"age\": 1e999 } }", "f.json:1: broken JSON: number overflow"},
                                      {"{ \"lens\": { \"age\": NaN } }", "f.json:1: broken JSON: "},
                                      {"{ \"lens\": { \"lens\": \"\xFF\" } }", "f.json:1: broken JSON: "}})
        EXPECT_TRUE(errorOf(json).starts_with(start)) << json << " gives " << errorOf(json);
    EXPECT_NE(errorOf(std::string(100000, '[')), "none");
}

TEST(SettingsTest, ValuesAreCheckedWithTheirLimits) {
    const struct {
        const char *name, *good, *bad;
    } cases[] = {
        {"aperture-mm", "0", "-0.1"},
        {"aperture-mm", "", "nan"},
        {"aperture-mm", "1000", "inf"},
        {"age", "20", "19.9"},
        {"luminance", "1e-6", "0"},
        {"luminance", "+3", ""},
        {"focus", "0.5", "0"},
        {"focus", "inf", "-inf"},
        {"focus", "gaze", "Gaze"},
        {"focus", "1e9", "nan"},
        {"gaze", "0,1", "0,1.1"},
        {"gaze", "0.25,0.75", "0.5"},
        {"gaze", "1,1", "0.5,0.5,"},
        {"pose", "0,1,2,0,0,0,1", "0,1,2,0,0,0,0"},
        {"pose", "", "0,0,0,1"},
        {"pose", "-1,0,0,0,0,0,-2", "0,0,inf,0,0,0,1"},
        {"size", "1x16384", "0x5"},
        {"size", "3x4", "3x4x5"},
        {"size", "640x480", "16385x1"},
        {"size", "2x2", "99999999999x2"},
        {"screen-width-mm", "0.001", "0"},
        {"screen-distance-mm", "600", "-600"},
        {"show", "pyramid:12", "pyramid:13"},
        {"show", "vergence", "pyramid"},
        {"show", "level", "pyramid:-1"},
        {"exposure", "-20", "-20.5"},
        {"technique", "reference", "raytrace"},
        {"samples", "65536", "65537"},
        {"samples", "1", "1.5"},
        {"blades", "6", "-1"},
        {"msaa", "0", "1"},
        {"swap-eyes", "true", "yes"},
        {"lens", "eye", ""},
        {"display", "top-bottom", "hmd"},
        {"ipd-mm", "0", "63mm"},
    };
    for (const auto& c : cases) {
        SCOPED_TRACE(c.name);
        EXPECT_EQ(errorOf(c.name, c.good), "none") << c.good;
        const std::string error = errorOf(c.name, c.bad);
        EXPECT_TRUE(error.starts_with(std::string(c.name) + ": ")) << c.bad << " gives " << error;
        EXPECT_NE(error.find("it takes"), std::string::npos) << error;
    }
    EXPECT_EQ(errorOf("size", "0x5"), "size: '0x5' is not allowed, it takes WxH, each 1..16384 px");
    EXPECT_EQ(errorOf("screen-width-mm", "0"),
              "screen-width-mm: 0 is not allowed, it takes more than 0, at most 1e+06 mm");
}

TEST(SettingsTest, UnknownNamesFindTheirNearest) {
    EXPECT_EQ(errorOf("expsure", "1"), "unknown setting 'expsure', did you mean 'exposure'");
    EXPECT_EQ(errorOf("ipd", "1"), "unknown setting 'ipd', did you mean 'ipd-mm'");
    EXPECT_EQ(errorOf("dispaly", "1"), "unknown setting 'dispaly', did you mean 'display'");
    EXPECT_EQ(errorOf("wavelength", "1"), "unknown setting 'wavelength'");
    EXPECT_EQ(errorOf(std::string(100000, 'a'), "1"), "unknown setting '" + std::string(60, 'a') + "...'");
}

TEST(SettingsTest, AMissingFileIsNamed) {
    Settings settings;
    EXPECT_THROW(loadSettings("/no/such/file.json", settings), InputError);
    EXPECT_THROW(loadSettings("/dev/zero", settings), InputError);  // endless
    EXPECT_THROW(loadSettings("/tmp", settings), InputError);
    EXPECT_EQ(valueOf(settings, "size"), "640x480");
}

}  // namespace
}  // namespace dioptre
