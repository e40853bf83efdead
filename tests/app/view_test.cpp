// dioptre view in a window of a display in memory; skipped where xvfb-run or xdotool is missing.
#include "program.hpp"

namespace dioptre::test {
namespace {

class ViewTest : public ProgramTest {
  protected:
    /// Opens the scene, with options, in a window of 320x120, does the steps (a shell script: $window, $program, $drop), and waits until
    /// the program ends.
    Outcome view(const std::string& steps, const std::string& scene = "scene.gltf") {
        leaksAllowed = true;
        write("steps.sh",
              "export XDG_CACHE_HOME=$PWD/cache; \"$1\" view " + scene + R"( --size 160x120 --log log.csv & program=$!
drop=$2
for try in $(seq 100); do
    window=$(xdotool search --onlyvisible --name '^Dioptre: .*focus' 2>/dev/null) && break
    kill -0 $program || exit 90
    sleep 0.1
done
xdotool windowfocus "$window"
title() { # waits for one that holds $1
    for try in $(seq 50); do
        xdotool getwindowname "$window" | grep -F -e "$1" && return
        sleep 0.1
    done
    xdotool getwindowname "$window"
    exit 91
}
)" + steps + R"(
sleep 0.5
for try in $(seq 50); do
    kill -0 $program 2>/dev/null || break
    xdotool key Escape
    sleep 0.2
done
wait $program
)");
        // Tests that run at once must not look for a free display from the same number on.
        const std::string firstDisplay = std::to_string(100 + ::getpid() % 30000);
        return runProgram("xvfb-run", {"-a", "-n", firstDisplay, "-s", "-screen 0 800x600x24", "sh", "steps.sh",
                                       DIOPTRE_PROGRAM, DIOPTRE_DROP});
    }

    void SetUp() override {
        if (runProgram("sh", {"-c", "command -v xvfb-run && command -v xdotool"}).status != 0)
            GTEST_SKIP() << "xvfb-run or xdotool is not there";
    }
    std::vector<std::string> log() const { return linesOf(read("log.csv")); }
};

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

TEST_F(ViewTest, WithoutADisplayTheRunFailsInOneLine) {
    const Outcome outcome =
        runProgram("env", {"-u", "DISPLAY", "-u", "WAYLAND_DISPLAY", DIOPTRE_PROGRAM, "view", "scene.gltf"});
    EXPECT_EQ(outcome.status, 1);
    EXPECT_EQ(linesOf(outcome.err).size(), 1u) << outcome.err;
    EXPECT_THAT(outcome.err, testing::HasSubstr("window"));
}

}  // namespace
}  // namespace dioptre::test
