// What the program says: help, version, and one line for each way of using it wrongly.
#include "program.hpp"

namespace dioptre::test {
namespace {

using testing::HasSubstr;
using UsageTest = ProgramTest;

TEST_F(UsageTest, HelpFitsTheTerminalAndGoesToStdout) {
    for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{{"--help"},
                                                                                           {"-h"},
                                                                                           {"render", "--help"},
                                                                                           {"view", "--help"},
                                                                                           {"inspect", "--help"},
                                                                                           {"compare", "-h"},
                                                                                           {"budget", "--help"}}) {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.status, 0);
        EXPECT_EQ(outcome.err, "");
        EXPECT_THAT(outcome.out, HasSubstr("Usage: dioptre"));
        for (const std::string& line : linesOf(outcome.out)) EXPECT_LE(line.size(), 100u) << line;
    }
    EXPECT_THAT(run({"render", "--help"}).out, HasSubstr("--aperture-mm"));
}

TEST_F(UsageTest, VersionGoesToStdout) {
    const Outcome outcome = run({"--version"});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_THAT(outcome.out, testing::MatchesRegex("dioptre [0-9]+\\.[0-9]+\\.[0-9]+\n"));
}

TEST_F(UsageTest, CommandsAndOptionsThatDoNotExistNameTheNearest) {
    expectRefused(run({}), {"no command"});
    expectRefused(run({"rendr"}), {"unknown command", "rendr", "render"});
    expectRefused(run({"render", "--apperture-mm", "3"}), {"unknown option", "--apperture-mm", "--aperture-mm"});
    expectRefused(run({"inspect", "--ipd=3"}), {"unknown option", "--ipd", "--ipd-mm"});
    expectRefused(run({"rendr", "a.glb", "--out", "a.png"}), {"rendr", "render"});
    expectRefused(run({"compare", "a.png", "b.png", "c.png"}), {"unexpected argument", "c.png"});
}

TEST_F(UsageTest, ValuesOutOfRangeNameOptionValueAndLimit) {
    for (const std::vector<std::string>& wrong : std::vector<std::vector<std::string>>{
             {"--ipd-mm", "500", "0..200 mm"},
             {"--aperture-mm", "nan", "0..1000 mm"},
             {"--aperture-mm", "-1", "0..1000 mm"},
             {"--focus", "0", "0.001..1e9 m"},
             {"--gaze", "0.5,1.5", "each 0..1"},
             {"--gaze", "0.5", "X,Y"},
             {"--size", "0x480", "1..16384"},
             {"--size", "640", "WxH"},
             {"--eye", "middle", "left|right|centre|both"},
             {"--display", "3d", "anaglyph"},
             {"--technique", "magic", "pinhole|mipmap"},
             {"--msaa", "3", "0|4"},
             {"--age", "12", "20..83 years"},
             {"--camera", "nobody", "0 'eye'"},
             {"--lens", "spectacles", "eye-60"},
             {"--pose", "0,0,0,0,0,0,0", "quaternion"},
             {"--blades", "2.5", "no whole number"},
             {"--frames", "0", "1..1000000"},
             {"--frames", "2.5", "no whole number"},
             {"--fps", "0", "0.001..1000"},
             {"--fps", "fast", "0.001..1000"},
             {"--size", "16384x10", "32768x10"},
             {"--screen-width-mm", "500", "needs --screen-distance-mm"},
             {"--screen-distance-mm", "500", "needs --screen-width-mm"},
         }) {
        const Outcome outcome = run({"render", "scene.gltf", "--out", "x.png", wrong[0], wrong[1]});
        expectRefused(outcome, {wrong[0], wrong[2]});
        if (!wrong[0].starts_with("--screen")) {
            EXPECT_THAT(outcome.err, HasSubstr(wrong[1]));
        }
        EXPECT_FALSE(there("x.png")) << wrong[0];
    }
    expectRefused(run({"render", "scene.gltf", "--frames", "3", "--out", "x.png"}),
                  {"--out x.png", "3 frames", "folder"});
    EXPECT_FALSE(there("x.png"));
    // Within the sides' limit, but 4 GB of samples
    expectRefused(run({"render", "scene.gltf", "--out", "x.png", "--eye", "centre", "--size", "16384x8192"}),
                  {"--size", "16384x8192", "--msaa 4"});
}

TEST_F(UsageTest, ScenesThatCannotBeReadAreRefusedInOneLine) {
    write("text.glb", "no scene at all");
    write("short.gltf", read("scene.gltf").substr(0, 300));
    write("scene.wild.gltf", [this] {
        std::string json = read("scene.gltf");
        return json.replace(json.find("\"mesh\": 0"), 9, "\"mesh\": 7");
    }());
    write("scene.cut.gltf", [this] {
        std::string json = read("scene.gltf");
        return json.replace(json.find("\"count\": 4"), 10, "\"count\": 90");
    }());
    for (const char* scene : {"absent.glb", "text.glb", "short.gltf", "scene.wild.gltf", "scene.cut.gltf", "."}) {
        expectRefused(run({"render", scene, "--out", "x.png"}), {scene});
        expectRefused(run({"inspect", scene}), {scene});
        EXPECT_FALSE(there("x.png")) << scene;
    }
}

TEST_F(UsageTest, ScenesAreNamedOnceAndToldFromPictures) {
    EXPECT_EQ(run({"inspect", "absent.glb"}).err, "error: absent.glb: no such file\n");
    expectRefused(run({"inspect", ""}), {"SCENE", "empty"});
    // 1 MB of zeros as positions
    write("scene.large.gltf", [this] {
        std::string json = read("scene.gltf");
        json.replace(json.find("{\"bufferView\": 0"), 16, "{\"name\": \"zeros\"");
        return json.replace(json.find("\"count\": 4"), 10, "\"count\": 90000");
    }());
    expectRefused(run({"inspect", "scene.large.gltf", "--max-scene-mb", "1"}),
                  {"meshes[0].primitives[0]", "of at most 1048576 bytes"});
    ASSERT_EQ(run({"render", "scene.gltf", "--size", "8x6", "--out", "x.png"}).status, 0);
    expectRefused(run({"inspect", "x.png"}), {"x.png: is a PNG picture, not a glTF scene"});
    expectRefused(run({"inspect", "scene.gltf", "--lens", "x.png"}), {"x.png: broken JSON", "lens preset"});
}

TEST_F(UsageTest, ConfigFilesNameFileAndLine) {
    write("key.json", "{\n  // comment\n  \"lens\": {\n    \"apperture-mm\": 3\n  }\n}\n");
    expectRefused(run({"render", "scene.gltf", "--out", "x.png", "--config", "key.json"}),
                  {"key.json:4:", "apperture-mm", "aperture-mm"});
    write("value.json", "{ \"view\": {\n \"ipd-mm\": 900 } }");
    expectRefused(run({"inspect", "scene.gltf", "--config", "value.json"}), {"value.json:2:", "900", "0..200 mm"});
    write("broken.json", "{ \"view\": \n\n { ");
    expectRefused(run({"inspect", "scene.gltf", "--config", "broken.json"}), {"broken.json:3:"});
    expectRefused(run({"inspect", "scene.gltf", "--config", "absent.json"}), {"absent.json"});
}

TEST_F(UsageTest, TracesNameFileAndLine) {
    write("gaze.csv", "t_s,x,y,valid\n0,0.5,0.5,1\n0.1,0.5,oops,1\n");
    expectRefused(run({"render", "scene.gltf", "--out", "x.png", "--gaze-trace", "gaze.csv"}), {"gaze.csv:3:", "oops"});
    write("empty.csv", "");
    expectRefused(run({"render", "scene.gltf", "--out", "x.png", "--gaze-trace", "empty.csv"}),
                  {"empty.csv: holds no line", "t_s,x,y,valid"});
    write("head.csv", "t_s,x,y,z,qx,qy,qz\n0,0,0,0,0,0,0\n");
    expectRefused(run({"render", "scene.gltf", "--out", "x.png", "--head-trace", "head.csv"}), {"head.csv:1:"});
}

TEST_F(UsageTest, InspectSaysWhatTheEyeCannotFocus) {
    // Hofstetter's mean at 60 years: 18.5 - 0.3 * 60 = 0.5 D, so nothing nearer than 2 m.
    const Outcome old = run({"inspect", "scene.gltf", "--lens", "eye-60", "--focus", "0.4", "--size", "40x30"});
    ASSERT_EQ(old.status, 0) << old.err;
    EXPECT_THAT(old.out, HasSubstr("focuses from 2 m (0.50 D)"));
    EXPECT_THAT(old.out, HasSubstr("2.500 D was asked for, +2.000 D out of reach"));
    const Outcome young = run({"inspect", "scene.gltf", "--focus", "0.4", "--size", "40x30"});
    EXPECT_THAT(young.out, HasSubstr("2.500 D (0.4 m)"));
    EXPECT_THAT(young.out, testing::Not(HasSubstr("out of reach")));
    EXPECT_THAT(young.out, HasSubstr("4 triangles"));
}

TEST_F(UsageTest, InspectSaysWhatIsLeftOutAndWhy) {
    using testing::ElementsAre;
    const auto leftOut = [&](const std::vector<std::string>& options) {
        std::vector<std::string> arguments = {"inspect", "scene.gltf", "--size",      "40x30",
                                              "--msaa",  "0",          "--technique", "mipmap"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        EXPECT_THAT(outcome.out, HasSubstr("passes     "));
        std::vector<std::string> told;
        for (const std::string& line : linesOf(outcome.out))
            if (line.starts_with("left out   ")) told.push_back(line.substr(11));
        return told;
    };
    const std::string resolve = "resolve: one sample a pixel";
    EXPECT_THAT(leftOut({"--focus", "0.4", "--aperture-mm", "0.1"}),
                ElementsAre(resolve, "blur: nothing is out of focus"));
    EXPECT_THAT(leftOut({"--focus", "0.4", "--aperture-mm", "60"}),
                ElementsAre(resolve, "pyramid's coarsest levels: the largest blur does not read them",
                            "reach: nothing lies so far in front of focus that it blurs",
                            "foreground layers: nothing lies so far in front of focus that it blurs"))
        << "each once for both eyes";
    EXPECT_THAT(leftOut({"--focus", "inf", "--aperture-mm", "60"}), ElementsAre(resolve));
}

TEST_F(UsageTest, WithOrWithoutEglTheRunEndsInOrder) {
    leaksAllowed = true;
    const Outcome outcome = run({"render", "scene.gltf", "--out", "x.png", "--size", "40x30", "--context", "egl"});
    EXPECT_THAT(outcome.status, testing::AnyOf(0, 1)) << outcome.err;
    EXPECT_EQ(there("x.png"), outcome.status == 0);
    if (outcome.status == 1) {
        EXPECT_THAT(outcome.err, HasSubstr("--context egl"));
    }
}

}  // namespace
}  // namespace dioptre::test
