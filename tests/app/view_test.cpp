// dioptre view in a window of a display in memory; skipped where Xvfb, xdotool or openbox is missing.
#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include "view_program.hpp"

namespace dioptre::test {
namespace {

TEST_F(ViewTest, EscapeClosesTheWindowAndLeavesTheLog) {
    const Outcome outcome = view(R"(
xdotool getwindowgeometry "$window"
xdotool mousemove --window "$window" 40 90
)");
    ASSERT_EQ(outcome.status, 0) << outcome.out << outcome.err;
    EXPECT_THAT(outcome.out, testing::HasSubstr("Geometry: 320x120"));
    ASSERT_GE(log().size(), 2u);
    // A quarter of the left eye's width, three quarters of its height
    EXPECT_THAT(log().back(), testing::HasSubstr(",0.25000,0.75000,1,"));
}

TEST_F(ViewTest, AWindowOfAnotherShapeKeepsThePicturesShape) {
    // 400x400 holds the picture of 320x120 as 400x150, 125 pixels below the top.
    const Outcome outcome = view(R"(
xdotool windowsize --sync "$window" 400 400
xdotool mousemove --window "$window" 250 155
)");
    ASSERT_EQ(outcome.status, 0) << outcome.out << outcome.err;
    // A quarter of the right eye's width, a fifth of its height
    EXPECT_THAT(log().back(), testing::HasSubstr(",0.25000,0.20000,1,"));
    const Outcome above = view(R"(
xdotool windowsize --sync "$window" 400 400
xdotool mousemove --window "$window" 250 100
)");
    ASSERT_EQ(above.status, 0) << above.out << above.err;
    EXPECT_THAT(log().back(), testing::HasSubstr(",0,,")) << "beside the picture there is no gaze";
}

TEST_F(ViewTest, ASignalEndsItInOrder) {
    const Outcome outcome = view("kill -TERM $program");
    EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
    EXPECT_GE(log().size(), 2u);
}

TEST_F(ViewTest, AFileDroppedIsShownOrRefused) {
    if (std::string(DIOPTRE_DROP).empty()) GTEST_SKIP() << "built without X11";
    std::string other = read("scene.gltf");
    other.insert(other.find("\"nodes\": [0, 1]"), "\"name\": \"another\", ");
    write("scene.another.gltf", other);
    write("scene.broken.gltf", "{");
    const Outcome outcome = view(R"(
"$drop" "$window" scene.broken.gltf
title 'scene.broken.gltf: JSON'
kill -0 $program || exit 92
xdotool key Escape
title 'Dioptre: scene  focus'
"$drop" "$window" scene.another.gltf
title 'Dioptre: another  focus'
)");
    EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
    EXPECT_THAT(outcome.err, testing::HasSubstr("error: scene.broken.gltf: JSON: "));
    EXPECT_EQ(linesOf(outcome.err).size(), 1u) << outcome.err;
}

TEST_F(ViewTest, LevelsOfDetailAreMadeWhileTheWindowShowsTheScene) {
    const Outcome outcome = view(R"(
title 'accumulate, 8 samples'
for try in $(seq 100); do
    ls cache/dioptre/lods/* >/dev/null 2>&1 && break
    sleep 0.1
done
ls cache/dioptre/lods | wc -l
)",
                                 "builtin:studio --technique accumulate --samples 8");
    ASSERT_EQ(outcome.status, 0) << outcome.out << outcome.err;
    EXPECT_EQ(outcome.err, "");
    ASSERT_FALSE(outcome.out.empty());
    EXPECT_GT(std::stoi(linesOf(outcome.out).back()), 0) << outcome.out;
}

TEST_F(ViewTest, TheScreenShowsThePictureThatIsWritten) {
    if (std::string(DIOPTRE_GRAB).empty()) GTEST_SKIP() << "built without X11";
    const Outcome outcome = view(R"(
xdotool mousemove --window "$window" 40 60
sleep 2
grab screen.png
xdotool key F12
there dioptre-0001.json
)",
                                 "scene.gltf --technique mipmap");
    ASSERT_EQ(outcome.status, 0) << outcome.out << outcome.err;
    const Image png = readImage(folder / "dioptre-0001.png"), exr = readImage(folder / "dioptre-0001.exr");
    EXPECT_LE(stepsApart(png, exr), 0.51) << "8 bits";
    // A focus that has all but arrived was shown; the one it has arrived at was written.
    EXPECT_LE(stepsApart(readImage(folder / "screen.png"), png), 2.01);
    expectDrawnAgain("dioptre-0001");
    EXPECT_NEAR(settingsIn("dioptre-0001.json").focus.focus.metres, 0.4, 0.01) << "of the square under the pointer";
}

TEST_F(ViewTest, KeysAndMouseMoveTheHead) {
    const Outcome outcome = view(R"(
xdotool mousemove --window "$window" 40 60
xdotool keydown w; sleep 0.4; xdotool keyup w
xdotool key F12; there dioptre-0001.json
drag 3 10 0
xdotool key F12; there dioptre-0002.json
xdotool click 4; sleep 0.3
xdotool key F12; there dioptre-0003.json
drag 1 0 5
xdotool key F12; there dioptre-0004.json
xdotool key Home; sleep 0.3
xdotool key F12; there dioptre-0005.json
)");
    ASSERT_EQ(outcome.status, 0) << outcome.out << outcome.err;
    const auto pose = [&](int n) { return settingsIn(fmt::format("dioptre-{:04}.json", n)).view.pose; };
    for (int n = 1; n <= 4; ++n) ASSERT_TRUE(pose(n).has_value()) << n;
    EXPECT_LT((*pose(1))[2], -0.05) << "W flies ahead, along -z";
    EXPECT_EQ((*pose(1))[0], 0.0);
    EXPECT_NE((*pose(2))[4], (*pose(1))[4]) << "a right drag turns";
    EXPECT_EQ((*pose(2))[2], (*pose(1))[2]) << "on the spot";
    EXPECT_NE((*pose(3))[2], (*pose(2))[2]) << "the wheel moves";
    // A pose is written and read on the way, and its quaternion made a unit again.
    EXPECT_NEAR((*pose(3))[4], (*pose(2))[4], 1e-12) << "and turns nothing";
    EXPECT_NE((*pose(4))[1], (*pose(3))[1]) << "a left drag goes around";
    EXPECT_FALSE(pose(5).has_value()) << "Home is the camera";
    for (const int n : {1, 4, 5}) expectDrawnAgain(fmt::format("dioptre-{:04}", n));
}

TEST_F(ViewTest, ARecordingIsReplayedByRender) {
    const Outcome outcome = view(R"(
xdotool mousemove --window "$window" 40 60; sleep 0.3
xdotool key r; sleep 0.3
xdotool mousemove --window "$window" 120 20; sleep 0.3
xdotool keydown d; sleep 0.3; xdotool keyup d
xdotool key r
there dioptre-0001.json
)");
    ASSERT_EQ(outcome.status, 0) << outcome.out << outcome.err;
    EXPECT_TRUE(read("dioptre-0001.head.csv").starts_with("t_s,x,y,z,qx,qy,qz,qw\n"));
    EXPECT_THAT(read("dioptre-0001.gaze.csv"), testing::HasSubstr(",0.25,0.5,1\n"));
    const Outcome replay = run({"render", "scene.gltf", "--config", "dioptre-0001.json", "--frames", "3", "--fps", "2",
                                "--out", "replay", "--log", "replay.csv"});
    ASSERT_EQ(replay.status, 0) << replay.err;
    EXPECT_THAT(linesOf(read("replay.csv")).at(1), testing::HasSubstr(",0.25000,0.50000,1,"));
    EXPECT_THAT(linesOf(read("replay.csv")).at(3), testing::HasSubstr(",0.75000,0.16667,1,"));
}

TEST_F(ViewTest, SettingsAreEditedTakenBackAndRefused) {
    write("mine.json", R"({"view": {"display": "top-bottom"}, "lens": {"aperture-mm": 7}})");
    const Outcome outcome = view(R"(
title 'mipmap, msaa 4'
setting technique pinhole
title 'pinhole, msaa 4'
xdotool key ctrl+z
title 'mipmap, msaa 4'
xdotool key ctrl+y
title 'pinhole, msaa 4'
setting show level
setting ipd-mm 5000
setting aperture-mm 3
title 'pinhole, msaa 4'
xdotool key F12; there dioptre-0001.json
"$drop" "$window" mine.json
sleep 0.5
xdotool key F12; there dioptre-0002.json
xdotool key ctrl+z; sleep 0.5
xdotool key v; sleep 0.3; xdotool key x; sleep 0.3
xdotool key F12; there dioptre-0003.json
)",
                                 "scene.gltf --technique mipmap");
    ASSERT_EQ(outcome.status, 0) << outcome.out << outcome.err;
    const Settings first = settingsIn("dioptre-0001.json"), second = settingsIn("dioptre-0002.json"),
                   third = settingsIn("dioptre-0003.json");
    EXPECT_EQ(first.render.technique, TechniqueChoice::pinhole);
    EXPECT_EQ(first.render.show.stage, ShowChoice::none) << "level is no stage of pinhole";
    EXPECT_EQ(first.view.ipdMm, 63.0);
    EXPECT_EQ(first.lens.apertureMm, 3.0);
    EXPECT_EQ(second.lens.apertureMm, 7.0);
    EXPECT_EQ(second.view.display, DisplayChoice::topBottom);
    EXPECT_EQ(third.lens.apertureMm, 3.0);
    EXPECT_EQ(third.view.display, DisplayChoice::sideBySideHalf);
    EXPECT_TRUE(third.view.swapEyes);
    for (const char* name : {"dioptre-0001", "dioptre-0002", "dioptre-0003"}) expectDrawnAgain(name);
}

TEST_F(ViewTest, ValuesInThePanelAreSetByTheMouse) {
    // The search leaves one row: name, value, unit.
    const Outcome outcome = view(R"(
find() { xdotool key ctrl+f; sleep 0.4; xdotool type --delay 30 "$1"; sleep 0.4; }
xdotool windowsize --sync "$window" 640 480
find swap-eyes
click 150 99
find ipd-mm
xdotool mousemove --window "$window" 185 99; sleep 0.2
xdotool mousedown 1; sleep 0.2; xdotool mousemove_relative 8 0; sleep 0.2; xdotool mousemove_relative 8 0; sleep 0.2
xdotool mouseup 1; sleep 0.4
xdotool key F12; there dioptre-0001.json
xdotool key ctrl+z; sleep 0.4
xdotool key F12; there dioptre-0002.json
)");
    ASSERT_EQ(outcome.status, 0) << outcome.out << outcome.err;
    const Settings dragged = settingsIn("dioptre-0001.json"), undone = settingsIn("dioptre-0002.json");
    EXPECT_TRUE(dragged.view.swapEyes);
    EXPECT_GT(dragged.view.ipdMm, 64.0);
    EXPECT_EQ(undone.view.ipdMm, 63.0) << "a drag is one edit";
    EXPECT_TRUE(undone.view.swapEyes);
    EXPECT_FALSE(dragged.view.pose.has_value()) << "what is typed and dragged in the panel moves nothing else";
    EXPECT_EQ(dragged.view.display, DisplayChoice::sideBySide);
}

// As the system counts it. tests/window asks whether it draws, in frames.
TEST_F(ViewTest, AStillViewSleeps) {
    const Outcome outcome = view(R"(
xdotool mousemove --window "$window" 40 60
ticks() { set -- $(cat /proc/$program/stat); shift 13; echo $(($1 + $2)); }
percent() { # of a core, in so many seconds
    before=$(ticks); sleep $1; after=$(ticks)
    echo $((100 * (after - before) / ($1 * $(getconf CLK_TCK))))
}
for try in $(seq 60); do # until it is refined, which takes what the machine lets it take
    [ $(percent 1) -ge 5 ] || break
done
percent 5
)",
                                 "scene.gltf --technique mipmap");
    ASSERT_EQ(outcome.status, 0) << outcome.out << outcome.err;
    EXPECT_LT(std::stoi(linesOf(outcome.out).back()), 5) << "percent of a core";
}

TEST_F(ViewTest, ATrackerLeadsTheGaze) {
    // Half of the samples are broken; then none come, and focus stays.
    const Outcome outcome =
        view(R"(
xdotool mousemove --window "$window" 300 10
for i in $(seq 2000); do
    printf '%s.0,0.25,0.5,1\nbroken\n' "$i" > samples
    xdotool getwindowname "$window" | grep -q -F 'focus 2.5' && break
    sleep 0.02
done
title 'focus 2.5'
sleep 1
xdotool key F12; there dioptre-0001.json
)",
             "scene.gltf --technique mipmap --gaze-input stdin <>samples", false, "mkfifo samples\n");
    ASSERT_EQ(outcome.status, 0) << outcome.out << outcome.err;
    // The title tells two digits; what moved there goes on to arrive.
    EXPECT_NEAR(settingsIn("dioptre-0001.json").focus.focus.metres, 0.4, 0.01) << "of the square at the gaze";
}

TEST_F(ViewTest, AnEndlessTrackerDoesNotKeepTheWindowWaiting) {
    // As fast as they can be made, garbage between them
    const Outcome outcome = view(R"(
xdotool mousemove --window "$window" 300 10
title 'focus 2.5'
xdotool key F12; there dioptre-0001.json
)",
                                 "scene.gltf --technique mipmap --gaze-input stdin <samples", false, R"(mkfifo samples
awk 'BEGIN { for (t = 0; ; t += 0.001) printf "nonsense\n%.3f,0.25,0.5,1\n,,\n", t }' > samples 2>/dev/null &
)");
    ASSERT_EQ(outcome.status, 0) << outcome.out << outcome.err;
    EXPECT_NEAR(settingsIn("dioptre-0001.json").focus.focus.metres, 0.4, 0.01);
}

TEST_F(ViewTest, APortInUseIsRefusedBeforeAWindowOpens) {
    const int taken = ::socket(AF_INET, SOCK_DGRAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    ASSERT_EQ(::bind(taken, reinterpret_cast<const sockaddr*>(&address), size), 0);
    ASSERT_EQ(::getsockname(taken, reinterpret_cast<sockaddr*>(&address), &size), 0);
    const std::string port = std::to_string(ntohs(address.sin_port));
    expectRefused(run({"view", "scene.gltf", "--gaze-input", "udp:" + port}),
                  {"--gaze-input: UDP port " + port, "in use"});
    ::close(taken);
    expectRefused(run({"view", "scene.gltf", "--gaze-input", "udp:70000"}), {"--gaze-input", "70000", "1..65535"});
}

// Where the monitor that is asked for is not there, the one that the window is on will do.
TEST_F(ViewTest, FullScreenAndBack) {
    const Outcome outcome = view(R"(
xdotool key F11; sleep 1
xdotool getwindowgeometry "$window"
xdotool key F11; sleep 1
xdotool getwindowgeometry "$window"
)",
                                 "scene.gltf --monitor nowhere", true);
    ASSERT_EQ(outcome.status, 0) << outcome.out << outcome.err;
    const std::size_t full = outcome.out.find("Geometry: 800x600"), back = outcome.out.find("Geometry: 320x120");
    EXPECT_NE(full, std::string::npos) << outcome.out;
    EXPECT_NE(back, std::string::npos) << outcome.out;
    EXPECT_LT(full, back);
}

TEST_F(ViewTest, MinimisedOrTinyItGoesOn) {
    const Outcome outcome = view(R"(
xdotool windowminimize "$window"; sleep 1
xdotool windowmap "$window"; sleep 1
xdotool windowsize --sync "$window" 320 200
xdotool windowfocus "$window"
xdotool key F2; sleep 0.5
grab panel.png
xdotool key F1; sleep 0.5
grab keys.png
xdotool key F1; sleep 0.2; xdotool key F2; sleep 0.5
xdotool key F12; there dioptre-0001.json
)",
                                 "scene.gltf", true);
    ASSERT_EQ(outcome.status, 0) << outcome.out << outcome.err;
    EXPECT_EQ(readImage(folder / "panel.png").width, 320);
    EXPECT_GT(stepsApart(readImage(folder / "panel.png"), readImage(folder / "keys.png")), 100.0);
    expectDrawnAgain("dioptre-0001");
}

TEST_F(ViewTest, TheWindowTellsOfASceneThatIsBeingMadeAndClosingGivesItUp) {
    if (std::string(DIOPTRE_GRAB).empty()) GTEST_SKIP() << "built without X11";
    leaksAllowed = true;
    const Outcome outcome = runProgram(DIOPTRE_WITH_DISPLAY, {"320x200", "sh", "-c", R"(
export XDG_CACHE_HOME=$PWD/cache
"$0" view builtin:dragons --size 160x120 & program=$!
until window=$(xdotool search --onlyvisible --name '^Dioptre: builtin:dragons'); do
    kill -0 $program || exit 90
    sleep 0.1
done
grab() { "$grabber" "$window" "$1" || exit 93; }
grabber=$1
for try in $(seq 100); do
    grab before.png; sleep 0.1; grab after.png
    cmp -s before.png after.png || break
done
cmp -s before.png after.png && exit 95
kill -TERM $program
wait $program
)",
                                                              DIOPTRE_PROGRAM, DIOPTRE_GRAB});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_FALSE(there("cache/dioptre")) << "it was made to its end";
}

TEST_F(ViewTest, WithoutADisplayTheRunFailsInOneLine) {
    const Outcome outcome =
        runProgram("env", {"-u", "DISPLAY", "-u", "WAYLAND_DISPLAY", DIOPTRE_PROGRAM, "view", "scene.gltf"});
    EXPECT_EQ(outcome.status, 1);
    EXPECT_EQ(linesOf(outcome.err).size(), 1u) << outcome.err;
    EXPECT_THAT(outcome.err, testing::HasSubstr("window"));
}

}  // namespace
}  // namespace dioptre::test
