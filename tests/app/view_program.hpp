// dioptre view, driven as a user does it, in a window of a display in memory. Skips where Xvfb, xdotool or openbox is
// missing.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "core/color.hpp"
#include "core/image.hpp"
#include "core/settings.hpp"
#include "program.hpp"

namespace dioptre::test {

/// The largest difference of two pictures, in steps of 1/255 of what a screen shows.
inline double stepsApart(const Image& a, const Image& b) {
    if (a.width != b.width || a.height != b.height) return 1e9;
    double most = 0.0;
    const auto shown = [](float value) { return static_cast<double>(srgbFromLinear(clampUnit(value))); };
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        most = std::max(most, 255.0 * std::abs(shown(a.pixels[i]) - shown(b.pixels[i])));
    return most;
}

class ViewTest : public ProgramTest {
  protected:
    /// Opens the scene, with options, in a window of 320x120, does the steps (a shell script: $window, $program, $drop,
    /// and the functions below), and waits until the program ends.
    Outcome view(const std::string& steps, const std::string& scene = "scene.gltf", bool managed = false,
                 const std::string& before = "") {
        leaksAllowed = true;
        write("steps.sh", before + (managed ? "openbox & manager=$!; sleep 1\n" : "") +
                              "export XDG_CACHE_HOME=$PWD/cache; \"$1\" view " + scene +
                              R"( --size 160x120 --log log.csv & program=$!
drop=$2
grab() { # what the window shows, to a PNG; it may be on its way to the screen
    for try in $(seq 50); do
        "$grabber" "$window" "$1" 2>/dev/null && return
        sleep 0.1
    done
    exit 93
}
grabber=$3
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
there() { # waits for a file
    for try in $(seq 600); do
        [ -s "$1" ] && return
        sleep 0.1
    done
    exit 94
}
settled() { # grabs $1, once it is another picture than $2 and stays as it is
    same=0
    for try in $(seq 100); do
        grab "$1"
        cmp -s "$1" last-grabbed.png && same=$((same + 1)) || same=0
        cp "$1" last-grabbed.png
        [ $same -ge 3 ] && ! cmp -s "$1" "$2" && return
        sleep 0.05
    done
    echo "$1 is not settled" >&2
    exit 95
}
click() { # X Y
    xdotool mousemove --window "$window" "$1" "$2"
    sleep 0.2
    xdotool click 1
    sleep 0.3
}
drag() { # BUTTON DX DY, twice that far, so that a slow frame does not swallow it
    xdotool mousedown "$1"; sleep 0.2
    xdotool mousemove_relative -- "$2" "$3"; sleep 0.2
    xdotool mousemove_relative -- "$2" "$3"; sleep 0.2
    xdotool mouseup "$1"
}
setting() { # NAME VALUE, typed into the panel's search
    xdotool key ctrl+f
    sleep 0.4
    xdotool type --delay 30 "$1 $2"
    xdotool key Return
    sleep 0.4
}
)" + steps + R"(
sleep 0.5
for try in $(seq 50); do
    kill -0 $program 2>/dev/null || break
    xdotool key Escape
    sleep 0.2
done
wait $program; status=$?
[ -z "$manager" ] || kill $manager
exit $status
)");
        return runProgram(DIOPTRE_WITH_DISPLAY,
                          {"800x600", "sh", "steps.sh", DIOPTRE_PROGRAM, DIOPTRE_DROP, DIOPTRE_GRAB});
    }

    void SetUp() override {
        if (runProgram("sh", {"-c", "command -v Xvfb && command -v xdotool && command -v openbox"}).status != 0)
            GTEST_SKIP() << "Xvfb, xdotool or openbox is not there";
    }
    std::vector<std::string> log() const { return linesOf(read("log.csv")); }
    Settings settingsIn(const std::string& name) const {
        Settings settings;
        loadSettings(folder / name, settings);
        return settings;
    }
    /// The picture that a key wrote is the one that `render` draws by the settings beside it.
    void expectDrawnAgain(const std::string& name, const std::string& scene = "scene.gltf") const {
        const Outcome outcome = run({"render", scene, "--config", name + ".json", "--out", "again.png"});
        ASSERT_EQ(outcome.status, 0) << outcome.err;
        EXPECT_LE(stepsApart(readImage(folder / (name + ".png")), readImage(folder / "again.png")), 1.01) << name;
    }
};

}  // namespace dioptre::test
