// Frames of a window that somebody plays with: scenes, techniques, settings, sizes, heads and gazes change all the time.
// No GL error, no GL object left behind, no memory leaked, memory flat. A hundred frames; DIOPTRE_FRAMES says how many
// else, DIOPTRE_SEED which.
#include <unistd.h>

#include <fstream>
#include <random>

#include "gl_objects.hpp"
#include "window_fixture.hpp"
#ifdef DIOPTRE_SANITIZED
#include <sanitizer/lsan_interface.h>

// While the window is open: its drivers are unloaded with it, and what they keep could not be named any more. What was
// freed is kept from use, but not so long that growth could not be told from it.
extern "C" const char* __asan_default_options() {
    return "leak_check_at_exit=0:quarantine_size_mb=16";
}
extern "C" int __lsan_do_recoverable_leak_check();
#endif

namespace dioptre::test {
namespace {

int fromEnvironment(const char* name, int otherwise) {
    const char* text = std::getenv(name);
    return text ? std::atoi(text) : otherwise;
}

double residentMegabytes() {
    std::ifstream statm("/proc/self/statm");
    double all = 0.0, resident = 0.0;
    statm >> all >> resident;
    return resident * static_cast<double>(::sysconf(_SC_PAGESIZE)) / 1e6;
}

class EnduranceTest : public WindowTest {
  protected:
    void writeScenes() const {
        const std::string plain = read("scene.gltf");
        std::string pane = plain, moving = plain;
        pane.replace(pane.find("0.8, 0.1, 0.1, 1]}"), 18, R"(0.1, 0.8, 0.1, 0.4]}, "alphaMode": "BLEND")");
        write("pane.gltf", pane);
        // The square goes from side to side: two moments and two places.
        const float keys[] = {0.0f, 0.5f, 1.0f, 0.0f, 0.0f, 0.0f, 0.2f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f};
        write("keys.bin", std::string(reinterpret_cast<const char*>(keys), sizeof keys));
        const auto put = [&](const std::string& before, const std::string& text) {
            moving.insert(moving.find(before), text);
        };
        put("\"materials\"", R"("animations": [{"samplers": [{"input": 3, "output": 4}],
 "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]}],
)");
        put("],\n\"bufferViews\"", R"(,
    {"bufferView": 2, "componentType": 5126, "type": "SCALAR", "count": 3, "min": [0], "max": [1]},
    {"bufferView": 2, "byteOffset": 12, "componentType": 5126, "type": "VEC3", "count": 3})");
        put("],\n\"buffers\"", R"(, {"buffer": 1, "byteLength": 48})");
        moving.insert(moving.rfind("]}"), R"(, {"uri": "keys.bin", "byteLength": 48})");
        write("moving.gltf", moving);
        write("broken.gltf", "{");
    }
};

/// Somebody at the window who never stops.
class Player {
  public:
    Player(ViewerDriver& driver, unsigned seed) : driver_(driver), random_(seed) {}

    void play(int frames) {
        const int last = driver_.viewer.drawn().frames + frames;
        while (driver_.viewer.drawn().frames < last) {
            act();
            driver_.draw(whole(1, 6));
        }
    }

    /// As it was in the beginning: another scene makes all that draws it anew.
    void reset() {
        if (panel_) driver_.xdotool("key F2");
        panel_ = false;
        driver_.xdotool("windowsize $W 320 120 mousemove --window $W 80 60");
        std::ofstream("first.json") << printSettings(viewCommand("").settings);
        driver_.drop("first.json");
        driver_.draw(3);
        driver_.drop("scene.gltf");
        driver_.xdotool("key Home");
        driver_.settle();
    }

  private:
    int whole(int least, int most) { return std::uniform_int_distribution(least, most)(random_); }
    template <std::size_t N>
    std::string oneOf(const char* const (&choices)[N]) {
        return choices[static_cast<std::size_t>(whole(0, static_cast<int>(N) - 1))];
    }

    void act() {
        switch (whole(0, 10)) {
            case 0:
                return driver_.drop(oneOf({"scene.gltf", "pane.gltf", "moving.gltf", "broken.gltf", "first.json"}));
            case 1:
            case 2:
            case 3:
                return edit();
            case 4:
                return driver_.xdotool(fmt::format("windowsize $W {} {}", whole(40, 500), whole(40, 400)));
            case 5:
                return driver_.xdotool(
                    "key " +
                    oneOf({"w", "a",    "s",  "d",  "q",   "e", "v",      "x",      "c",      "t",
                           "g", "Home", "F1", "F3", "F12", "r", "ctrl+z", "ctrl+y", "ctrl+z", "ctrl+z ctrl+z"}));
            case 6:
                panel_ = !panel_;
                return driver_.xdotool("key F2");
            case 7:
                return driver_.xdotool(
                    fmt::format("mousemove --window $W 60 60 mousedown {0} mousemove_relative -- {1} {2} "
                                "mouseup {0} click {3}",
                                whole(1, 3), whole(-30, 30), whole(-20, 20), whole(4, 5)));
            case 8:
                return click();
            default:
                return driver_.xdotool(fmt::format("mousemove --window $W {} {}", whole(0, 320), whole(0, 240)));
        }
    }

    /// Anywhere, which in the panel opens a group, chooses something, resets it or saves a preset.
    void click() {
        driver_.xdotool(fmt::format("mousemove --window $W {} {}", whole(0, 320), whole(0, 400)));
        for (const char* button : {"mousedown 1", "mouseup 1"}) {
            driver_.draw(2);
            driver_.xdotool(button);
        }
    }

    /// A setting, typed into the panel's search.
    void edit() {
        driver_.xdotool("key ctrl+f");
        panel_ = true;
        driver_.draw(3);
        const std::string value = oneOf({"technique pinhole",
                                         "technique mipmap",
                                         "technique accumulate",
                                         "technique reference",
                                         "technique auto",
                                         "samples 4",
                                         "samples 9",
                                         "msaa 0",
                                         "msaa 4",
                                         "aperture-mm 3",
                                         "aperture-mm 8",
                                         "lens eye-60",
                                         "lens camera-50mm-f1.4",
                                         "display anaglyph",
                                         "display mono",
                                         "ipd-mm 0",
                                         "ipd-mm 5000",
                                         "show vergence",
                                         "show coc",
                                         "show level",
                                         "show none",
                                         "size 64x48",
                                         "size 160x120",
                                         "focus 0.4",
                                         "focus gaze",
                                         "focus nonsense"});
        driver_.xdotool("type --delay 0 '" + value + "'");
        driver_.xdotool("key Return");
    }

    ViewerDriver& driver_;
    std::mt19937 random_;
    bool panel_ = false;
};

TEST_F(EnduranceTest, NothingIsLeftBehind) {
    writeScenes();
    const int frames = fromEnvironment("DIOPTRE_FRAMES", 100);
    const auto seed = static_cast<unsigned>(fromEnvironment("DIOPTRE_SEED", 1));
    ViewerDriver driver(viewCommand("scene.gltf"));
    Player player(driver, seed);
    // What is made when it is first needed, and kept
    driver.xdotool("windowsize $W 640 400 key F2");
    driver.settle();
    driver.xdotool("key F2");
    player.reset();
    const GlObjects before = glObjectsAlive();
    std::vector<double> memory{residentMegabytes()};
    constexpr int kSteps = 4;
    for (int step = 0; step < kSteps; ++step) {
        player.play(frames / kSteps);
        player.reset();
        const GlObjects now = glObjectsAlive();
        memory.push_back(residentMegabytes());
        for (std::size_t kind = 0; kind < before.size(); ++kind)
            EXPECT_EQ(now[kind], before[kind]) << kGlObjectNames[kind] << ", seed " << seed;
    }
    fmt::print("{} frames, {} pictures; GL objects before and after: {}; MB resident: {:.0f}\n",
               driver.viewer.drawn().frames, driver.viewer.drawn().pictures, fmt::join(before, " "),
               fmt::join(memory, " "));
    // Once everything was done once, which a hundred frames are too few for
    constexpr int kMany = 1000;
    if (frames >= kMany) {
        EXPECT_LT(memory.back(), 1.1 * memory[kSteps / 2]);
    }
#ifdef DIOPTRE_SANITIZED
    EXPECT_EQ(__lsan_do_recoverable_leak_check(), 0);
#endif
}

}  // namespace
}  // namespace dioptre::test
