// dioptre view in a window of a display in memory; skipped where xvfb-run or xdotool is missing.
#include "program.hpp"

namespace dioptre::test {
namespace {

using ViewTest = ProgramTest;

TEST_F(ViewTest, EscapeClosesTheWindowAndLeavesTheLog) {
    if (runProgram("sh", {"-c", "command -v xvfb-run && command -v xdotool"}).status != 0)
        GTEST_SKIP() << "xvfb-run or xdotool is not there";
    leaksAllowed = true;
    write("steps.sh", R"(
"$1" view scene.gltf --size 160x120 --log log.csv & program=$!
for try in $(seq 100); do
    window=$(xdotool search --onlyvisible --name '^Dioptre: .*focus' 2>/dev/null) && break
    kill -0 $program || exit 90
    sleep 0.1
done
xdotool getwindowgeometry "$window"
xdotool windowfocus "$window" mousemove --window "$window" 80 60
sleep 0.5
for try in $(seq 50); do
    kill -0 $program 2>/dev/null || break
    xdotool key Escape
    sleep 0.2
done
wait $program
)");
    const Outcome outcome =
        runProgram("xvfb-run", {"-a", "-s", "-screen 0 800x600x24", "sh", "steps.sh", DIOPTRE_PROGRAM});
    ASSERT_EQ(outcome.status, 0) << outcome.out << outcome.err;
    EXPECT_THAT(outcome.out, testing::HasSubstr("Geometry: 320x120"));
    const std::vector<std::string> log = linesOf(read("log.csv"));
    ASSERT_GE(log.size(), 2u);
    // The pointer, at a quarter of the width and half the height, is the middle of the left eye's picture.
    EXPECT_THAT(log.back(), testing::HasSubstr(",0.50000,0.50000,1,"));
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
