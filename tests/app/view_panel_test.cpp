// What is switched, compared and saved while the window shows a scene.
#include <fmt/format.h>

#include <array>

#include "metrics/metrics.hpp"
#include "view_program.hpp"

namespace dioptre::test {
namespace {

// Nothing moves and nothing is refined: a picture is finished in its first frame.
constexpr const char* kSharp = "scene.gltf --technique pinhole --msaa 0 --focus 0.5";

TEST_F(ViewTest, DisplayModesSwitchWhileTheSceneIsShown) {
    if (std::string(DIOPTRE_GRAB).empty()) GTEST_SKIP() << "built without X11";
    const Outcome outcome = view(R"(
next() { # KEY WIDTH HEIGHT NAME
    xdotool key "$1"
    xdotool windowsize "$window" "$2" "$3"
    settled "$4.png" "$last.png"
    last=$4
}
settled sbs.png none.png; last=sbs
next v 160 120 sbs-half
next v 160 240 top-bottom
next v 160 120 anaglyph
next v 160 120 mono
next v 320 120 again
next x 320 120 swapped
)",
                                 kSharp);
    ASSERT_EQ(outcome.status, 0) << outcome.out << outcome.err;
    const auto expectShown = [&](const std::string& name, const std::vector<std::string>& options) {
        std::vector<std::string> arguments = {"render", "scene.gltf", "--size",  "160x120", "--technique", "pinhole",
                                              "--msaa", "0",          "--focus", "0.5",     "--out",       "drawn.png"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        ASSERT_EQ(run(arguments).status, 0);
        EXPECT_LE(stepsApart(readImage(folder / (name + ".png")), readImage(folder / "drawn.png")), 1.01) << name;
    };
    for (const char* mode : {"sbs", "sbs-half", "top-bottom", "anaglyph", "mono"})
        expectShown(mode, {"--display", mode});
    expectShown("swapped", {"--swap-eyes"});
    EXPECT_GT(stepsApart(readImage(folder / "swapped.png"), readImage(folder / "sbs.png")), 50.0);
}

TEST_F(ViewTest, TwoTechniquesOnEitherSideOfALine) {
    if (std::string(DIOPTRE_GRAB).empty()) GTEST_SKIP() << "built without X11";
    const Outcome outcome = view(R"(
settled mipmap.png none.png
xdotool key t
title ' dB, SSIM '
settled split.png mipmap.png
xdotool key g
settled difference.png split.png
)",
                                 "scene.gltf --technique mipmap --display mono --aperture-mm 40 --focus 4");
    ASSERT_EQ(outcome.status, 0) << outcome.out << outcome.err;
    const auto drawn = [&](const std::string& technique) {
        EXPECT_EQ(run({"render", "scene.gltf", "--size", "160x120", "--technique", technique, "--display", "mono",
                       "--aperture-mm", "40", "--focus", "4", "--out", technique + ".exr"})
                      .status,
                  0);
        return readImage(folder / (technique + ".exr"));
    };
    const Image mipmap = drawn("mipmap"), pinhole = drawn("pinhole");
    const Image split = readImage(folder / "split.png"), difference = readImage(folder / "difference.png");
    ASSERT_EQ(split.width, 160);
    ASSERT_EQ(split.height, 120);
    const auto shown = [](const Image& image, int x, int y, int c) {
        return 255.0 * static_cast<double>(srgbFromLinear(clampUnit(image.at(x, y, c))));
    };
    double most = 0.0;
    for (int y = 60; y < 120; ++y)  // below what the sides are called
        for (int x = 0; x < 160; ++x)
            for (int c = 0; c < 3; ++c) {
                const double a = shown(mipmap, x, y, c), b = shown(pinhole, x, y, c);
                const std::string where = fmt::format("{},{} {}", x, y, c);
                if (std::abs(x - 80) > 2) {
                    EXPECT_NEAR(shown(split, x, y, c), x < 80 ? a : b, 1.01) << where;
                }
                EXPECT_NEAR(shown(difference, x, y, c), std::min(255.0, 4.0 * std::abs(a - b)), 2.01) << where;
                most = std::max(most, std::abs(a - b));
            }
    EXPECT_GT(most, 50.0) << "the square is blurred";
    EXPECT_THAT(outcome.out, testing::HasSubstr(fmt::format("PSNR {:.1f} dB", psnr(pinhole, mipmap))));
}

TEST_F(ViewTest, WhatIsComparedMayChangeItsSize) {
    const Outcome outcome = view(R"(
xdotool key t
title 'dB, SSIM'
for display in 1 2 3; do
    xdotool key v
    sleep 0.3
    title 'dB, SSIM'
done
)",
                                 kSharp);
    ASSERT_EQ(outcome.status, 0) << outcome.out << outcome.err;
}

TEST_F(ViewTest, StagesAreShownSmallInThePanel) {
    if (std::string(DIOPTRE_GRAB).empty()) GTEST_SKIP() << "built without X11";
    // The groups that are open at first are closed, the last one, Measure, is opened.
    const Outcome outcome = view(R"(
xdotool windowsize --sync "$window" 640 480
xdotool key F2
sleep 0.2
for y in 72 97 122 222; do click 60 $y; done
xdotool mousemove --window "$window" 600 240
settled panel.png none.png
for technique in pinhole accumulate mipmap; do # each has other stages
    setting technique $technique
    title $technique
    settled "$technique.png" none.png
done
)",
                                 kSharp);
    ASSERT_EQ(outcome.status, 0) << outcome.out << outcome.err;
    EXPECT_THAT(outcome.err, testing::Not(testing::HasSubstr("GL_INVALID")));
    const Image panel = readImage(folder / "panel.png");
    const auto shown = [&](int x, int y, int c) {
        return std::round(255.0 * static_cast<double>(srgbFromLinear(clampUnit(panel.at(x, y, c)))));
    };
    // The picture, then vergence: the red square at 0.4 m is at the left, the grey wall at 4 m right of it.
    constexpr int kY = 310, kSquare = 38, kWall = 98, kNext = 122;
    EXPECT_NEAR(shown(kSquare, kY, 0), 231, 2);
    EXPECT_NEAR(shown(kSquare, kY, 1), 89, 2);
    EXPECT_NEAR(shown(kWall, kY, 0), 188, 2);
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(shown(kSquare + kNext, kY, c), 219, 2) << "2.5 D of 3.5";
        EXPECT_NEAR(shown(kWall + kNext, kY, c), 124, 2) << "0.25 D of 1.25";
    }
}

TEST_F(ViewTest, CamerasAreLookedThroughInTurn) {
    std::string scene = read("scene.gltf");
    const auto replace = [&](const std::string& from, const std::string& to) {
        scene.replace(scene.find(from), from.size(), to);
    };
    replace("\"nodes\": [0, 1]", "\"nodes\": [0, 1, 2]");
    replace("\"name\": \"eye\"}", R"("name": "eye"}, {"camera": 0, "translation": [0.3, 0, 0.2]})");
    write("scene.two.gltf", scene);
    const Outcome outcome = view(R"(
xdotool key c F12; there dioptre-0001.json
xdotool keydown w; sleep 0.2; xdotool keyup w
xdotool key c F12; there dioptre-0002.json
)",
                                 std::string(kSharp).replace(0, 10, "scene.two.gltf"));
    ASSERT_EQ(outcome.status, 0) << outcome.out << outcome.err;
    EXPECT_EQ(settingsIn("dioptre-0001.json").view.camera, "1");
    EXPECT_EQ(settingsIn("dioptre-0002.json").view.camera, "0") << "after the last the first";
    EXPECT_FALSE(settingsIn("dioptre-0002.json").view.pose.has_value()) << "where the camera is";
    for (const char* name : {"dioptre-0001", "dioptre-0002"}) expectDrawnAgain(name, "scene.two.gltf");
    EXPECT_GT(stepsApart(readImage(folder / "dioptre-0001.png"), readImage(folder / "dioptre-0002.png")), 50.0);
}

TEST_F(ViewTest, PresetsAreSavedAndLoadedAndSettingsGoByTheirLabels) {
    const Outcome outcome = view(R"(
xdotool windowsize --sync "$window" 640 480
setting Aperture 3
click 357 43  # Save
there settings.json
setting 'Screen distance' 700
setting Aperture 5
xdotool key F12; there dioptre-0001.json
click 300 43  # Load
xdotool key F12; there dioptre-0002.json
)",
                                 kSharp);
    ASSERT_EQ(outcome.status, 0) << outcome.out << outcome.err;
    EXPECT_EQ(settingsIn("settings.json").lens.apertureMm, 3.0);
    const Settings edited = settingsIn("dioptre-0001.json"), loaded = settingsIn("dioptre-0002.json");
    EXPECT_EQ(edited.lens.apertureMm, 5.0);
    EXPECT_EQ(edited.view.screenDistanceMm, 700.0);
    EXPECT_TRUE(edited.view.screenWidthMm.has_value()) << "a distance needs a width";
    EXPECT_EQ(loaded.lens.apertureMm, 3.0);
    EXPECT_FALSE(loaded.view.screenDistanceMm.has_value());
}

}  // namespace
}  // namespace dioptre::test
