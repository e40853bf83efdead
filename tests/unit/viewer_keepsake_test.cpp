#include "viewer/keepsake.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <set>
#include <string>

#include "viewer/keymap.hpp"

namespace dioptre {
namespace {

class KeepsakeTest : public testing::Test {
  protected:
    KeepsakeTest()
        : folder_(std::filesystem::temp_directory_path() / ("dioptre_keepsake_" + std::to_string(getpid()))) {
        std::filesystem::create_directories(folder_);
    }
    ~KeepsakeTest() override { std::filesystem::remove_all(folder_); }

    std::filesystem::path folder_;
};

Moment someMoment() {
    Moment moment;
    moment.time = 2.5;
    moment.head = {{1.0, 2.0, 3.0}, glm::angleAxis(0.5, glm::dvec3(0.0, 1.0, 0.0))};
    moment.gaze = {2.5, {0.25, 1.5}, true};
    moment.focus = Dioptres(0.8);
    return moment;
}

TEST_F(KeepsakeTest, SettingsOfAMomentFixFocusAndTime) {
    const Settings settings = settingsOf(someMoment(), {});
    EXPECT_EQ(settings.focus.focus.mode, FocusMode::metres);
    EXPECT_DOUBLE_EQ(settings.focus.focus.metres, 1.25);
    EXPECT_EQ(settings.view.time, 2.5);
    EXPECT_EQ(settings.focus.gaze, (std::array<double, 2>{0.25, 1.0})) << "beside the picture: its border";
    EXPECT_FALSE(settings.view.pose.has_value()) << "the camera says it";
    // Another reading gives the same settings, to the bit.
    Settings again;
    parseSettings(printSettings(settings), "printed", again);
    EXPECT_EQ(printSettings(again), printSettings(settings));
}

TEST_F(KeepsakeTest, SettingsOfAMomentHoldTheHeadThatATraceMoved) {
    Settings shown;
    shown.focus.headTrace = "head.csv";
    shown.focus.gazeTrace = "gaze.csv";
    const Settings settings = settingsOf(someMoment(), shown);
    EXPECT_EQ(settings.focus.headTrace, "");
    EXPECT_EQ(settings.focus.gazeTrace, "");
    ASSERT_TRUE(settings.view.pose.has_value());
    EXPECT_EQ((*settings.view.pose)[2], 3.0);
    EXPECT_DOUBLE_EQ((*settings.view.pose)[6], std::cos(0.25));
}

TEST_F(KeepsakeTest, SettingsOfAMomentNameThePlanAtFullSize) {
    Settings shown;  // that leave it to the governor
    shown.render.budgetMs = 5.0;
    Moment moment = someMoment();
    moment.plan = {TechniqueChoice::mipmap, 0, {}, {}, 6};
    const Settings settings = settingsOf(moment, shown);
    const auto plan = planOf(settings.render);
    ASSERT_TRUE(plan.has_value());
    EXPECT_EQ(planText(*plan), "mipmap, msaa 0");
    EXPECT_FALSE(settings.render.budgetMs.has_value());
    moment.plan = {TechniqueChoice::accumulate, {}, 12, 3};
    EXPECT_EQ(planText(*planOf(settingsOf(moment, shown).render)), "accumulate, 12 samples, 3 sub-samples each");
}

TEST_F(KeepsakeTest, FarFocusIsInfinity) {
    for (const double focus : {0.0, 1e-12, -0.5}) {
        Moment moment = someMoment();
        moment.focus = Dioptres(focus);
        EXPECT_EQ(settingsOf(moment, {}).focus.focus.mode, FocusMode::infinity) << focus;
    }
}

TEST_F(KeepsakeTest, NamesAreCountedPastWhatIsThere) {
    EXPECT_EQ(nextName(folder_).filename(), "dioptre-0001");
    std::ofstream(folder_ / "dioptre-0001.exr") << "1";
    std::ofstream(folder_ / "dioptre-0002.gaze.csv") << "1";
    EXPECT_EQ(nextName(folder_).filename(), "dioptre-0003");
}

TEST_F(KeepsakeTest, ARecordingReplaysHeadAndGaze) {
    const Pose start{{0.0, 1.5, 4.0}, glm::angleAxis(-0.3, glm::dvec3(0.0, 1.0, 0.0))};
    Recording recording(start);
    std::vector<Moment> moments;
    for (int i = 0; i < 5; ++i) {
        Moment moment = someMoment();
        moment.time = 10.0 + 0.1 * i;
        moment.head.position.x += 0.01 * i;
        moment.gaze = {moment.time, {0.1 * i, 0.5}, i != 2};
        recording.add(moment);
        moments.push_back(moment);
    }
    Moment past = someMoment();
    past.time = 3.0;
    recording.add(past);  // a clock that went back is no part of it
    EXPECT_NEAR(recording.seconds(), 0.4, 1e-12);
    Settings shown;
    recording.write(folder_ / "walk", shown);

    Settings settings;
    loadSettings(folder_ / "walk.json", settings);
    EXPECT_EQ(settings.view.time, 10.0);
    const auto head = readHeadTrace(settings.focus.headTrace);
    const auto gaze = readGazeTrace(settings.focus.gazeTrace);
    ASSERT_EQ(head.size(), 5u);
    ASSERT_EQ(gaze.size(), 5u);
    const auto& p = *settings.view.pose;
    const Pose base{{p[0], p[1], p[2]}, {p[6], p[3], p[4], p[5]}};
    for (const Moment& moment : moments) {
        const Pose local = headPoseAt(head, moment.time);
        EXPECT_LT(glm::distance(base.position + base.orientation * local.position, moment.head.position), 1e-9);
        EXPECT_NEAR(std::abs(glm::dot(base.orientation * local.orientation, moment.head.orientation)), 1.0, 1e-12);
        EXPECT_EQ(gazeAt(gaze, moment.time).valid, moment.gaze.valid);
        EXPECT_EQ(gazeAt(gaze, moment.time).position, moment.gaze.position);
    }
}

TEST(KeyMapTest, NoKeyDoesTwoThings) {
    std::set<std::pair<int, bool>> seen;
    for (const KeyBinding& binding : keyMap())
        if (binding.action != Action::none) {
            EXPECT_TRUE(seen.emplace(binding.key, binding.control).second) << binding.keys;
            EXPECT_EQ(actionOf(binding.key, binding.control), binding.action);
        }
    for (const FlyKey& key : flyKeys()) EXPECT_TRUE(seen.emplace(key.key, false).second) << key.key;
    EXPECT_EQ(actionOf(-1, false), Action::none);
}

TEST(KeyMapTest, TheListSaysWhatEachDoes) {
    for (const KeyBinding& binding : keyMap()) {
        EXPECT_FALSE(binding.keys.empty());
        EXPECT_FALSE(binding.what.empty()) << binding.keys;
    }
}

}  // namespace
}  // namespace dioptre
