// From what a hand does to what the window shows: counted in frames, which no clock and no busy machine changes.
#include <chrono>
#include <ctime>

#include "core/settings.hpp"
#include "window_fixture.hpp"

namespace dioptre::test {
namespace {

class InputTest : public WindowTest {
  protected:
    /// Frames until what the window shows is another; a hundred where it stays the same. Every other time the view is
    /// still and asleep before, else it goes on drawing the same.
    int framesUntilShown(ViewerDriver& driver, const std::string& input) {
        asleep_ = !asleep_;
        if (asleep_)
            driver.settle();
        else
            driver.draw(5);
        const auto before = driver.shown();
        const int first = driver.viewer.drawn().frames;
        driver.xdotool(input);
        for (int turns = 0; turns < 20; ++turns) {
            driver.turn();
            const int frames = driver.viewer.drawn().frames - first;
            if (frames > 0 && driver.shown() != before) return frames;
        }
        return 100;
    }

    static Command slowCommand() {
        Command command = viewCommand("scene.gltf");
        command.settings.render.technique = TechniqueChoice::reference;
        command.settings.render.samples = 2000;
        return command;
    }
    /// Of the camera's view, begun anew: it takes many frames.
    static void beginLongPicture(ViewerDriver& driver) {
        driver.xdotool("key w");
        driver.draw(3);
        driver.xdotool("key Home");
        driver.draw(1);
        driver.xdotool("key F12");
        driver.draw(2);
    }

  private:
    bool asleep_ = false;
};

TEST_F(InputTest, ReachesThePictureWithinTwoFrames) {
    ViewerDriver driver(viewCommand("scene.gltf"));
    struct Case {
        const char* what;
        const char* input;
        int frames;
    };
    for (const Case& c : {
             Case{"a key that flies", "key w", 1},
             {"another", "key d", 1},
             {"the wheel", "click 4", 1},
             {"back to the camera", "key Home", 1},
             {"press and pull in one frame", "mousedown 3 mousemove_relative 20 0", 1},
             {"going on", "mousemove_relative 0 15", 1},
             {"let go while it still moves", "mousemove_relative 0 15 mouseup 3", 1},
             {"press, pull and let go in one frame", "mousedown 1 mousemove_relative 12 0 mouseup 1", 1},
             {"another display", "key v", 1},
             {"eyes change places", "key x", 1},
             {"taken back", "key ctrl+z", 1},
             {"and made again", "key ctrl+y", 1},
             {"a window of another size", "windowsize $W 400 300", 1},
             {"the list of keys", "key F1", 2},
             {"and away", "key F1", 2},
             {"settings", "key F2", 2},
         })
        EXPECT_LE(framesUntilShown(driver, c.input), c.frames) << c.what;
}

// The depth is read a frame late, and then answered: with a filter that does not wait, the second frame shows it.
TEST_F(InputTest, TheGazeReachesTheFocusInTheSecondFrame) {
    Command command = viewCommand("scene.gltf");
    command.settings.lens.apertureMm = 8.0;
    ViewerDriver driver(command);
    for (const char* place : {"40 60", "140 60", "45 65", "150 20"})
        EXPECT_EQ(framesUntilShown(driver, std::string("mousemove --window $W ") + place), 2) << place;
}

// Typed, as a whole line; one key more takes it over.
TEST_F(InputTest, AnEditInThePanelReachesThePictureWithinTwoFrames) {
    Command command = viewCommand("scene.gltf");
    command.settings.lens.apertureMm = 8.0;
    ViewerDriver driver(command);
    driver.xdotool("windowsize $W 640 240");
    for (const char* edit : {"technique pinhole", "technique mipmap", "exposure-ev 2", "show vergence", "show none"}) {
        driver.xdotool("key ctrl+f");
        driver.draw(5);
        driver.xdotool(std::string("type --delay 0 '") + edit + "'");
        EXPECT_LE(framesUntilShown(driver, "key Return"), 2) << edit;
    }
}

// Each line of input is there as a whole before the next frame, as much as a slow one lets come.
TEST_F(InputTest, APressIsOfWhatWasThereAndADragGoesAllOfItsWay) {
    ViewerDriver driver(viewCommand("scene.gltf"));
    driver.xdotool("windowsize $W 640 480");
    // Leaves one row in the panel: name, value, unit.
    const auto find = [&](const std::string& name) {
        driver.xdotool("key ctrl+f");
        driver.draw(5);
        driver.xdotool("type --delay 0 " + name);
        driver.draw(5);
    };
    int pictures = 0;
    const auto now = [&] {
        driver.draw(8);
        driver.xdotool("key F12");
        const std::string name = fmt::format("dioptre-{:04}.json", ++pictures);
        driver.until([&] { return std::filesystem::exists(name); }, "a picture");
        Settings settings;
        loadSettings(name, settings);
        return settings.view;
    };
    find("ipd-mm");
    driver.xdotool("mousemove --window $W 185 99 mousedown 1 mousemove_relative 16 0 mouseup 1");
    const ViewSettings there = now();
    EXPECT_NEAR(there.ipdMm, 63.0 + 16 * 0.1, 1e-6);
    driver.xdotool("mousemove --window $W 195 99 mousedown 1 mousemove --window $W 215 400 mouseup 1");
    const ViewSettings out = now();
    EXPECT_NEAR(out.ipdMm, there.ipdMm + 20 * 0.1, 1e-6) << "from the panel onto the picture";
    EXPECT_FALSE(out.pose.has_value());
    driver.xdotool("mousemove --window $W 500 300 mousedown 3 mousemove --window $W 185 99 mouseup 3");
    const ViewSettings in = now();
    EXPECT_TRUE(in.pose.has_value()) << "from the picture onto the panel";
    EXPECT_EQ(in.ipdMm, out.ipdMm);

    find("swap-eyes");
    driver.xdotool("mousemove --window $W 200 139");
    driver.draw(5);
    EXPECT_FALSE(now().swapEyes);
    driver.xdotool("windowmove --relative -- $W 50 40");
    driver.draw(5);
    driver.xdotool("click 1");
    EXPECT_TRUE(now().swapEyes) << "the window moved under the pointer";
}

TEST_F(InputTest, StepsBackAreTakenOneByOneHoweverFastTheyCome) {
    ViewerDriver driver(viewCommand("scene.gltf"));
    const auto first = driver.shown();
    driver.xdotool("key v");
    driver.settle();
    driver.xdotool("key x");
    driver.settle();
    const auto last = driver.shown();
    EXPECT_NE(first, last);
    driver.xdotool("key ctrl+z key ctrl+z");
    driver.settle();
    EXPECT_EQ(driver.shown(), first);
    driver.xdotool("key ctrl+y key ctrl+y");
    driver.settle();
    EXPECT_EQ(driver.shown(), last);
}

TEST_F(InputTest, WhatIsAskedForWhileAPictureIsFinishedComesAfterIt) {
    ViewerDriver driver(slowCommand());
    write("brighter.json", R"({"render": {"exposure": 1}})");
    driver.drop("brighter.json");
    driver.xdotool("key v");
    driver.settle();
    const auto other = driver.shown();
    driver.xdotool("key ctrl+z key ctrl+z");
    driver.settle();
    ASSERT_NE(driver.shown(), other);

    const auto written = [&] { return std::filesystem::exists("dioptre-0001.png"); };
    beginLongPicture(driver);
    driver.xdotool("key v");
    driver.draw(2);
    ASSERT_FALSE(written()) << "it takes longer";
    driver.drop("brighter.json");
    driver.drop("scene.gltf");
    driver.until(written, "a picture");
    EXPECT_EQ(read("dioptre-0001.json").find("\"exposure\": 1"), std::string::npos) << "it is of the moment before";
    // The settings, another display, and the scene, of which the camera is the same
    driver.until([&] { return driver.shown() == other; }, "what was asked for");
    driver.xdotool("key ctrl+z");
    driver.settle();
    EXPECT_EQ(driver.shown(), other) << "nothing is taken back that was of the scene before";
}

TEST_F(InputTest, WhatWaitsForAPictureKeepsNobodyFromGivingItUp) {
    ViewerDriver driver(slowCommand());
    const auto first = driver.shown();
    driver.xdotool("key v");
    driver.settle();
    ASSERT_NE(driver.shown(), first);
    beginLongPicture(driver);
    driver.xdotool("key ctrl+z");
    driver.draw(2);
    driver.xdotool("key F12");
    driver.draw(1);
    driver.settle();
    EXPECT_FALSE(std::filesystem::exists("dioptre-0001.png"));
    EXPECT_EQ(driver.shown(), first) << "then it is taken back";
}

TEST_F(InputTest, ARecordingEndsWhenAnotherSceneComes) {
    ViewerDriver driver(viewCommand("scene.gltf"));
    driver.xdotool("key r");
    driver.draw(10);
    driver.drop("scene.gltf");
    driver.until([] { return std::filesystem::exists("dioptre-0001.head.csv"); }, "a recording");
}

TEST_F(InputTest, AStillViewStopsDrawingAndSleeps) {
    struct Case {
        const char* what;
        bool automatic, panel;
    };
    for (const Case& c : {Case{"one technique", false, false},
                          {"refined by the governor", true, false},
                          {"with the panel", false, true}}) {
        Command command = viewCommand("scene.gltf");
        if (c.automatic) command.settings.render.technique.reset();
        ViewerDriver driver(command);
        if (c.panel) driver.xdotool("windowsize $W 640 400 key F2");
        driver.settle();

        // Of the processor, so that nothing else on the machine counts
        const auto processor = [] { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; };
        const Viewer::Drawn before = driver.viewer.drawn();
        const double used = processor();
        const auto begin = std::chrono::steady_clock::now();
        double seconds = 0.0;
        while (seconds < 3.0) {
            driver.turn();
            seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        }
        EXPECT_LT((processor() - used) / seconds, 0.05) << c.what;
        EXPECT_EQ(driver.viewer.drawn().frames, before.frames) << c.what;
        EXPECT_EQ(driver.viewer.drawn().pictures, before.pictures) << c.what;
    }
}

}  // namespace
}  // namespace dioptre::test
