// dioptre render and compare: what ends up in the files.
#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "core/error.hpp"
#include "core/image.hpp"
#include "metrics/metrics.hpp"
#include "program.hpp"

namespace dioptre::test {
namespace {

using testing::HasSubstr;

class RenderTest : public ProgramTest {
  protected:
    Image drawn(std::vector<std::string> options, const std::string& name = "picture.pfm") const {
        options.insert(options.end(), {"--out", name});
        draw(options);
        return readImage(folder / name);
    }
};

Image part(const Image& image, int x, int y, int width, int height) {
    Image out(width, height);
    for (int row = 0; row < height; ++row)
        std::copy_n(&image.pixels[image.index(x, y + row)], 3 * width, &out.pixels[out.index(0, row)]);
    return out;
}

/// A rounding error has no place where nothing but the file format changes.
void expectSame(const Image& a, const Image& b) {
    ASSERT_EQ(a.width, b.width);
    ASSERT_EQ(a.height, b.height);
    // Not as two long lists in the message.
    EXPECT_TRUE(a.pixels == b.pixels) << psnr(a, b) << " dB apart";
}

TEST_F(RenderTest, WritesEachFormat) {
    const Image pfm = drawn({}, "a.pfm");
    EXPECT_EQ(pfm.width, 80);  // two eyes of 40
    EXPECT_EQ(pfm.height, 30);
    EXPECT_EQ(countNotFinite(pfm), 0u);
    const Image exr = drawn({}, "a.exr");
    const Image png = drawn({}, "a.png");
    // PNG: 8 bits, an error of at most 1/510 in sRGB, 54 dB. EXR: 32-bit floats.
    expectSame(exr, pfm);
    EXPECT_GT(psnr(pfm, png), 54.0);
    EXPECT_TRUE(read("a.png").starts_with("\x89PNG"));
    EXPECT_EQ(leftBehind(), (std::vector<std::string>{"a.exr", "a.pfm", "a.png"}));
}

TEST_F(RenderTest, DrawsTheSceneWhereItIs) {
    // f = 15 px / tan(0.4) = 35.5 px: the square reaches from x = 20 - 17.7 to 20 and y = 15 -+ 8.9, 0.4 m away.
    const Image sharp = drawn({"--eye", "centre", "--technique", "pinhole"});
    const auto at = [&](int x, int y) { return &sharp.pixels[sharp.index(x, y)]; };
    EXPECT_NEAR(at(10, 15)[0], 0.8f, 0.01f);
    EXPECT_NEAR(at(10, 15)[1], 0.1f, 0.01f);
    EXPECT_NEAR(at(10, 10)[0], 0.8f, 0.01f);
    EXPECT_NEAR(at(30, 15)[0], 0.5f, 0.01f);
    EXPECT_NEAR(at(10, 3)[0], 0.5f, 0.01f);
    // +1 EV doubles the light.
    const Image brighter = drawn({"--eye", "centre", "--technique", "pinhole", "--exposure", "1"});
    EXPECT_NEAR(brighter.pixels[brighter.index(30, 15)], 1.0f, 0.01f);
}

TEST_F(RenderTest, BlursWhatIsOutOfFocusAndOnlyThat) {
    const std::vector<std::string> eye = {"--eye", "centre", "--aperture-mm", "120"};
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.end(), eye.begin(), eye.end());
        return drawn(more);
    };
    const Image sharp = with({"--technique", "pinhole"});
    const Image onSquare = with({"--gaze", "0.25,0.5"}), onWall = with({"--gaze", "0.8,0.5"});
    // The square's edge at x = 20: sharp under the gaze; from the wall 35.5 px * 60 mm * 2.25 D = 4.8 px of radius.
    const auto slope = [](const Image& image) {
        float steepest = 0.0f;
        for (int x = 12; x < 28; ++x)
            steepest =
                std::max(steepest, std::abs(image.pixels[image.index(x, 15)] - image.pixels[image.index(x + 1, 15)]));
        return steepest;
    };
    EXPECT_GT(slope(onSquare), 0.8f * slope(sharp));
    EXPECT_LT(slope(onWall), 0.5f * slope(sharp));
    // A pupil of no width has no blur wherever it looks.
    EXPECT_GT(psnr(sharp, drawn({"--eye", "centre", "--aperture-mm", "0", "--gaze", "0.8,0.5"})), 40.0);
}

TEST_F(RenderTest, PrintedConfigDrawsTheSamePicture) {
    const std::vector<std::string> options = {
        "--aperture-mm", "12.3", "--gaze",     "0.3,0.5", "--ipd-mm",  "61.7",    "--display",   "sbs",
        "--msaa",        "0",    "--exposure", "-0.3",    "--tonemap", "neutral", "--technique", "mipmap"};
    std::vector<std::string> printing = options;
    printing.insert(printing.begin(), {"render", "--size", "40x30", "--print-config"});
    const Outcome printed = run(printing);
    ASSERT_EQ(printed.status, 0) << printed.err;
    write("all.json", printed.out);
    const Image given = drawn(options, "given.png");
    const Outcome again = run({"render", "scene.gltf", "--config", "all.json", "--out", "read.png"});
    ASSERT_EQ(again.status, 0) << again.err;
    EXPECT_EQ(read("given.png"), read("read.png"));
    // The command line wins over the file.
    const Image wins = drawn({"--config", "all.json", "--exposure", "1"}, "wins.pfm");
    EXPECT_GT(*std::max_element(wins.pixels.begin(), wins.pixels.end()),
              *std::max_element(given.pixels.begin(), given.pixels.end()));
}

TEST_F(RenderTest, DisplaysHaveTheirSizesAndHoldTheEyes) {
    const Image left = drawn({"--eye", "left"}), right = drawn({"--eye", "right"});
    EXPECT_LT(psnr(left, right), 40.0) << "the eyes see different pictures";
    const Image wide = drawn({"--display", "sbs"});
    ASSERT_EQ(wide.width, 80);
    expectSame(part(wide, 0, 0, 40, 30), left);
    expectSame(part(wide, 40, 0, 40, 30), right);
    const Image swapped = drawn({"--display", "sbs", "--swap-eyes"});
    expectSame(part(swapped, 0, 0, 40, 30), right);
    expectSame(part(swapped, 40, 0, 40, 30), left);
    const Image tall = drawn({"--display", "top-bottom"});
    ASSERT_EQ(tall.height, 60);
    expectSame(part(tall, 0, 0, 40, 30), left);
    expectSame(part(tall, 0, 30, 40, 30), right);
    const Image mono = drawn({"--display", "mono"});
    expectSame(mono, drawn({"--eye", "centre"}));
    for (const char* display : {"mono", "sbs-half", "anaglyph"}) {
        const Image one = drawn({"--display", display});
        EXPECT_EQ(one.width, 40) << display;
        EXPECT_EQ(one.height, 30) << display;
    }
}

TEST_F(RenderTest, EyesAtOnePlaceSeeTheSameToTheBit) {
    for (const char* technique : {"pinhole", "mipmap"}) {
        const Image both = drawn({"--ipd-mm", "0", "--technique", technique, "--aperture-mm", "10"});
        expectSame(part(both, 0, 0, 40, 30), part(both, 40, 0, 40, 30));
    }
}

TEST_F(RenderTest, StagesOfTheFrameCanBeSeen) {
    const Image vergence = drawn({"--eye", "centre", "--show", "vergence", "--technique", "pinhole"});
    EXPECT_GT(vergence.pixels[vergence.index(10, 15)], vergence.pixels[vergence.index(30, 15)]) << "nearer is brighter";
    for (const char* stage : {"coc", "dob"}) EXPECT_EQ(countNotFinite(drawn({"--show", stage})), 0u) << stage;
}

TEST_F(RenderTest, SequencesComeWithAPageAndALog) {
    write("gaze.csv", "t_s,x,y,valid\n0,0.25,0.5,1\n0.1,0.8,0.5,1\n");
    write("head.csv", "t_s,x,y,z,qx,qy,qz,qw\n0,0,0,0,0,0,0,1\n1,0.05,0,0,0,0,0,1\n");
    const Outcome outcome = draw({"--frames", "4", "--fps", "20", "--out", "seq", "--log", "log.csv", "--gaze-trace",
                                  "gaze.csv", "--head-trace", "head.csv", "--focus-dynamics", "instant"});
    EXPECT_THAT(outcome.err, HasSubstr("index.html"));
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "seq"))
        names.push_back(entry.path().filename());
    EXPECT_THAT(names, testing::UnorderedElementsAre("frame_0000.png", "frame_0001.png", "frame_0002.png",
                                                     "frame_0003.png", "index.html"));
    EXPECT_THAT(read("seq/index.html"), HasSubstr("frame_0003.png"));
    EXPECT_NE(read("seq/frame_0000.png"), read("seq/frame_0001.png")) << "the head moves";
    const std::vector<std::string> log = linesOf(read("log.csv"));
    ASSERT_EQ(log.size(), 5u);
    EXPECT_TRUE(log[0].starts_with("t_s,gaze_x,gaze_y,gaze_valid,under_gaze_D,focus_D")) << log[0];
    // The square at 2.5 D, then the wall at 0.25 D.
    EXPECT_TRUE(log[1].starts_with("0.000000,0.25000,0.50000,1,2.5")) << log[1];
    EXPECT_TRUE(log[4].starts_with("0.150000,0.80000,0.50000,1,0.2")) << log[4];
}

TEST_F(RenderTest, DrawsTheMomentThatIsAskedFor) {
    // The square on the left, in steps: back by 0.1 m a second, for 3 s, then from the start.
    std::string gltf = read("scene.gltf");
    const std::vector<float> keys = {0, 1, 2, 3, 0, 0, 0, 0, 0, -0.1f, 0, 0, -0.2f, 0, 0, 0};
    write("scene.keys.bin", std::string(reinterpret_cast<const char*>(keys.data()), keys.size() * sizeof(float)));
    const auto insert = [&](const std::string& after, const std::string& text) {
        const std::size_t at = gltf.find(after);
        ASSERT_NE(at, std::string::npos) << after;
        gltf.insert(at + after.size(), text);
    };
    insert(R"("count": 6})", R"(,
    {"bufferView": 2, "componentType": 5126, "type": "SCALAR", "count": 4, "min": [0], "max": [3]},
    {"bufferView": 2, "byteOffset": 16, "componentType": 5126, "type": "VEC3", "count": 4})");
    insert(R"("byteOffset": 96, "byteLength": 12})", R"(, {"buffer": 1, "byteLength": 64})");
    insert(R"("byteLength": 108})", R"(, {"uri": "scene.keys.bin", "byteLength": 64}], "animations": [{"name": "back",
    "samplers": [{"input": 3, "output": 4, "interpolation": "STEP"}],
    "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]})");
    write("scene.gltf", gltf);
    const auto moment = [&](const char* seconds) { return drawn({"--technique", "pinhole", "--time", seconds}); };
    const Image start = drawn({"--technique", "pinhole"}), second = moment("1");
    expectSame(start, moment("0"));
    expectSame(second, moment("1"));
    expectSame(second, moment("1.9"));
    EXPECT_LT(psnr(start, second), 40.0) << "it moved";
    expectSame(start, moment("3"));
    expectSame(second, moment("4"));

    // Sequences show each frame's moment; the window's clock is the same.
    draw({"--technique", "pinhole", "--frames", "3", "--fps", "1", "--time", "1", "--out", "seq", "--log", "log.csv"});
    for (const auto& [frame, seconds] : {std::pair("seq/frame_0000.png", "1"), {"seq/frame_0002.png", "3"}}) {
        drawn({"--technique", "pinhole", "--time", seconds}, "one.png");
        EXPECT_EQ(read(frame), read("one.png")) << frame;
    }
    EXPECT_TRUE(linesOf(read("log.csv")).at(1).starts_with("1.000000,"));
    const Outcome inspected = run({"inspect", "scene.gltf", "--time", "1"});
    EXPECT_THAT(inspected.out, HasSubstr("animation 0 back, 3 s, 1 channel"));
    expectRefused(run({"render", "scene.gltf", "--out", "x.png", "--time", "-1"}), {"--time", "-1", "0..1e+06 s"});
}

TEST_F(RenderTest, AFileThatCannotBeWrittenIsNotThere) {
    const std::vector<std::string> scene = {"render", "scene.gltf", "--size", "40x30", "--out"};
    const auto into = [&](const std::string& name, std::vector<std::string> more = {}) {
        std::vector<std::string> arguments = scene;
        arguments.push_back(name);
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(arguments);
    };
    expectRefused(run({"render", "scene.gltf"}), {"--out"});
    expectRefused(into("absent/x.png"), {"absent/x.png", "does not exist"});
    expectRefused(into("x.jpeg"), {"x.jpeg", ".png"});
    expectRefused(into("."), {".: is a folder"});
    expectRefused(into("scene.gltf/x.png"), {"scene.gltf"});
    expectRefused(into("scene.gltf", {"--frames", "2"}), {"scene.gltf"});
    expectRefused(into("x.png", {"--log", "absent/log.csv"}), {"absent/log.csv"});
    EXPECT_EQ(leftBehind(), std::vector<std::string>{});

    write("old.pfm", "as it was");
    fileSizeLimit = 2000;  // of 28 815 bytes
    const Outcome full = into("x.pfm");
    EXPECT_EQ(full.status, 1) << full.err;
    EXPECT_THAT(full.err, HasSubstr("x.pfm: cannot be written"));
    EXPECT_EQ(into("old.pfm").status, 1);
    EXPECT_EQ(read("old.pfm"), "as it was");
    EXPECT_EQ(leftBehind(), std::vector<std::string>{"old.pfm"});
}

TEST_F(RenderTest, FoldersAndFilesThatCannotBeMadeAreAlike) {
    for (const auto& [frames, out] : {std::pair("1", "/proc/x.png"), {"2", "/proc/x"}}) {
        const Outcome outcome = run({"render", "scene.gltf", "--size", "8x6", "--frames", frames, "--out", out});
        EXPECT_EQ(outcome.status, 1);
        EXPECT_EQ(linesOf(outcome.err).size(), 1u) << outcome.err;
        EXPECT_THAT(outcome.err, HasSubstr(out));
    }
}

TEST_F(RenderTest, TheLogMayLieInTheFolderThatASequenceMakes) {
    draw({"--frames", "2", "--out", "new/seq", "--log", "./new/seq/log.csv"});
    EXPECT_EQ(linesOf(read("new/seq/log.csv")).size(), 3u);
    EXPECT_TRUE(there("new/seq/index.html"));
    expectRefused(run({"render", "scene.gltf", "--frames", "2", "--out", "other", "--log", "another/log.csv"}),
                  {"another/log.csv", "does not exist"});
    EXPECT_FALSE(there("other"));
}

TEST_F(RenderTest, WhatIsRedirectedKeepsWhatElseIsWrittenThere) {
    write("steps.sh", R"(
exec >all.txt
echo before
"$1" render scene.gltf --size 8x6 --out x.png --log /dev/stdout
echo after
)");
    ASSERT_EQ(runProgram("sh", {"steps.sh", DIOPTRE_PROGRAM}).status, 0);
    const std::vector<std::string> lines = linesOf(read("all.txt"));
    ASSERT_EQ(lines.size(), 4u);
    EXPECT_EQ(lines[0], "before");
    EXPECT_TRUE(lines[1].starts_with("t_s,")) << lines[1];
    EXPECT_EQ(lines[3], "after");
}

TEST_F(RenderTest, ASequenceThatIsStoppedKeepsItsPageAndLog) {
    // Waits until two frames are there.
    write("steps.sh", R"(
"$1" render scene.gltf --size 40x30 --frames 1000000 --out seq --log log.csv & program=$!
for try in $(seq 300); do
    [ -e seq/frame_0001.png ] && break
    sleep 0.05
done
kill -TERM $program
wait $program
)");
    const Outcome outcome = runProgram("sh", {"steps.sh", DIOPTRE_PROGRAM});
    EXPECT_EQ(outcome.status, 1) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("error: stopped with "));
    const std::size_t frames = linesOf(read("log.csv")).size() - 1;
    EXPECT_GE(frames, 2u);
    std::size_t pictures = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "seq")) {
        const std::string name = entry.path().filename();
        if (name.starts_with("frame_")) ++pictures;
        EXPECT_TRUE(name.starts_with("frame_") || name == "index.html") << name;
    }
    EXPECT_EQ(pictures, frames);
    EXPECT_THAT(read("seq/index.html"), HasSubstr(std::to_string(frames) + " frames"));
}

TEST_F(RenderTest, LightThatIsCutIsSaidOnce) {
    const Outcome bright = run({"render", "scene.gltf", "--exposure", "20", "--out", "bright.pfm"});
    EXPECT_EQ(bright.status, 0);
    ASSERT_EQ(linesOf(bright.err).size(), 1u) << bright.err;
    EXPECT_THAT(bright.err, HasSubstr("65504"));
    const Image picture = readImage(folder / "bright.pfm");
    // Means of samples are rounded.
    EXPECT_NEAR(*std::max_element(picture.pixels.begin(), picture.pixels.end()), 65504.0f, 0.1f);
    EXPECT_EQ(run({"render", "scene.gltf", "--exposure", "16", "--out", "fits.pfm"}).err, "");
}

TEST_F(RenderTest, ComparesPictures) {
    drawn({"--eye", "left"}, "left.png");
    drawn({"--eye", "right"}, "right.pfm");
    drawn({}, "both.png");
    const Outcome same = run({"compare", "left.png", "left.png"});
    EXPECT_EQ(same.out, "PSNR inf dB  SSIM 1.00000  FLIP 0.00000\n");
    const Outcome different = run({"compare", "left.png", "right.pfm"});
    EXPECT_EQ(different.status, 0);
    EXPECT_THAT(different.out, testing::MatchesRegex("PSNR [0-9.]+ dB  SSIM 0\\.[0-9]+  FLIP 0\\.[0-9]+\n"));
    EXPECT_EQ(run({"compare", "left.png", "right.pfm", "--out", "map.pfm"}).status, 0);
    EXPECT_EQ(run({"compare", "left.png", "right.pfm", "--out", "map.png"}).status, 0);
    const Image errors = readImage(folder / "map.pfm");
    const double mean =
        std::accumulate(errors.pixels.begin(), errors.pixels.end(), 0.0) / static_cast<double>(errors.pixels.size());
    EXPECT_THAT(different.out, HasSubstr(fmt::format("FLIP {:.4f}", mean).substr(0, 9)));
    EXPECT_EQ(readImage(folder / "map.png").width, 40);
    expectRefused(run({"compare", "left.png", "right.pfm", "--out", "map.jpg"}), {"map.jpg"});
    expectRefused(run({"compare", "left.png", "both.png"}), {"40", "80"});
    expectRefused(run({"compare", "left.png"}), {"two pictures"});
    expectRefused(run({"compare", "left.png", "absent.png"}), {"absent.png"});
    expectRefused(run({"compare", "left.png", "scene.gltf"}), {"scene.gltf"});
    expectRefused(run({"compare", "left.png", "."}), {".: is a folder"});
}

}  // namespace
}  // namespace dioptre::test
