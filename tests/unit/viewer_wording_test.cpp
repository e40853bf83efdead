#include "viewer/wording.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <set>
#include <stdexcept>

namespace dioptre {
namespace {

const Setting& named(std::string_view name) {
    for (const Setting& setting : settingsTable())
        if (setting.name == name) return setting;
    throw std::out_of_range(std::string(name));
}

TEST(WordingTest, LabelsAreWordsWithoutUnits) {
    EXPECT_EQ(labelOf(named("aperture-mm")), "Aperture");
    EXPECT_EQ(labelOf(named("ipd-mm")), "IPD");
    EXPECT_EQ(labelOf(named("blade-rotation-deg")), "Blade rotation");
    EXPECT_EQ(labelOf(named("max-scene-mb")), "Max scene");
    EXPECT_EQ(labelOf(named("ui-scale")), "UI scale");
}

TEST(WordingTest, EverySettingHasALabelOfItsOwn) {
    std::set<std::string> labels;
    for (const Setting& setting : settingsTable()) {
        EXPECT_FALSE(labelOf(setting).empty()) << setting.name;
        EXPECT_TRUE(labels.insert(labelOf(setting)).second) << setting.name;
    }
}

TEST(WordingTest, AnglesAndSquaresAreWrittenAsUsual) {
    EXPECT_EQ(unitOf(named("gaze-error-deg")), "\u00b0");
    EXPECT_EQ(unitOf(named("luminance")), "cd/m\u00b2");
    EXPECT_EQ(unitOf(named("ipd-mm")), "mm");
}

TEST(WordingTest, ADragIsFineAndGivesShortNumbers) {
    EXPECT_DOUBLE_EQ(dragStep(named("ipd-mm"), 63.0), 0.1);
    EXPECT_DOUBLE_EQ(dragStep(named("aperture-mm"), 4.32), 0.01);
    EXPECT_DOUBLE_EQ(dragStep(named("exposure"), 0.0), 0.01);
    for (const Setting& setting : settingsTable()) {
        if (setting.kind != SettingKind::number) continue;
        for (const double share : {0.0, 0.001, 0.03, 0.5, 1.0}) {
            const double value = setting.min + share * (setting.max - setting.min);
            const double step = dragStep(setting, value);
            const std::string where = fmt::format("{} {}", setting.name, value);
            EXPECT_GT(step, 0.0) << where;
            EXPECT_LE(step, 0.0031 * std::max(std::abs(value), 5.0)) << where;
            EXPECT_GE(step, 0.0014 * std::abs(value)) << where;
            // What is shown of a value a step away is that value
            char text[64];
            const double moved = std::round(value / step) * step + step;
            std::snprintf(text, sizeof text, dragFormat(moved, step).c_str(), moved);
            EXPECT_NEAR(std::strtod(text, nullptr), moved, 1e-9 * std::abs(moved)) << where;
        }
    }
}

}  // namespace
}  // namespace dioptre
