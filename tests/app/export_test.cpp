// dioptre export, and scenes that are asked for by name.
#include "program.hpp"

namespace dioptre::test {
namespace {

using testing::HasSubstr;
using ExportTest = ProgramTest;

TEST_F(ExportTest, WritesAFileThatOpens) {
    for (const char* name : {"studio", "builtin:studio"}) {
        const Outcome outcome = run({"export", name, "--out", "copy.glb"});
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        EXPECT_EQ(outcome.out, "");
        EXPECT_THAT(outcome.err, HasSubstr("copy.glb"));
        EXPECT_TRUE(read("copy.glb").starts_with("glTF"));
        std::filesystem::remove(folder / "copy.glb");
    }
}

TEST_F(ExportTest, NamesFilesAndFoldersThatAreNotThereAreRefused) {
    expectRefused(run({"export"}), {"NAME", "toys"});
    expectRefused(run({"export", "toys"}), {"--out"});
    expectRefused(run({"export", "toy", "--out", "x.glb"}), {"'toy'", "studio", "toys", "fishes", "dragons"});
    expectRefused(run({"export", "toys", "--out", "absent/x.glb"}), {"absent"});
    expectRefused(run({"export", "toys", "--out", "."}), {"."});
    expectRefused(run({"export", "toys", "--out", "x.gltf"}), {"x.gltf", ".glb"});
    expectRefused(run({"render", "builtin:toy", "--out", "x.png"}), {"toy", "dragons"});
    expectRefused(run({"inspect", "builtin:"}), {"dragons"});
    EXPECT_FALSE(there("x.png"));
}

TEST_F(ExportTest, InspectTellsWhatASceneTakes) {
    const Outcome outcome = run({"inspect", "builtin:studio"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    for (const char* word : {"objects", "triangles", "bounds", "memory", "MB for the GPU"})
        EXPECT_THAT(outcome.out, HasSubstr(word));
}

}  // namespace
}  // namespace dioptre::test
