// dioptre export, and scenes that are asked for by name.
#include <cstdio>

#include "program.hpp"

namespace dioptre::test {
namespace {

using testing::HasSubstr;
using testing::Not;
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

TEST_F(ExportTest, InspectTellsLevelsOfDetail) {
    ::setenv("XDG_CACHE_HOME", folder.c_str(), 1);
    const Outcome made = run({"inspect", "--lods"}), again = run({"inspect", "builtin:studio", "--lods"});
    ::unsetenv("XDG_CACHE_HOME");
    for (const Outcome* outcome : {&made, &again}) {
        EXPECT_EQ(outcome->status, 0) << outcome->err;
        for (const char* word : {"level  0", "level  1", "triangles, error", " mm, ", " s\n", "memory", "of one core"})
            EXPECT_THAT(outcome->out, HasSubstr(word));
    }
    EXPECT_THAT(made.out, Not(HasSubstr(", cached\n")));
    EXPECT_THAT(again.out, HasSubstr(", cached\n"));
    EXPECT_FALSE(std::filesystem::is_empty(folder / "dioptre" / "lods"));
}

#ifndef DIOPTRE_SANITIZED  // which make millions of triangles slow
// As large as the scenes that they stand in for.
TEST_F(ExportTest, BuiltinScenesHaveTheirSizes) {
    ::setenv("XDG_CACHE_HOME", folder.c_str(), 1);
    struct Least {
        const char* name;
        int objects, triangles;
    };
    for (const Least& least : {Least{"toys", 17, 520000}, {"fishes", 67, 1700000}, {"dragons", 10, 3800000}}) {
        const Outcome outcome = run({"inspect", std::string("builtin:") + least.name, "--size", "64x48"});
        ASSERT_EQ(outcome.status, 0) << outcome.err;
        const auto line = outcome.out.find("objects ");
        ASSERT_NE(line, std::string::npos) << outcome.out;
        int objects = 0, meshes = 0, triangles = 0;
        ASSERT_EQ(std::sscanf(outcome.out.c_str() + line, "objects %d instances of %d meshes, %d triangles", &objects,
                              &meshes, &triangles),
                  3)
            << outcome.out;
        EXPECT_GE(objects, least.objects) << least.name;
        EXPECT_GE(triangles, least.triangles) << least.name;
    }
    ::unsetenv("XDG_CACHE_HOME");
}
#endif

}  // namespace
}  // namespace dioptre::test
