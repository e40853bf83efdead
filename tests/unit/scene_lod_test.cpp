// Chains of a scene's meshes: in the background, in any number of threads, and their cache.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <thread>

#include "lod_meshes.hpp"
#include "scene/deformation.hpp"
#include "scene/lod.hpp"

namespace dioptre {
namespace {

namespace fs = std::filesystem;

/// By mesh, primitive and level.
using Found = std::map<std::tuple<std::size_t, std::size_t, int>, BuiltLevel>;

class LodTest : public testing::Test {
  protected:
    LodTest() {
        std::string name = (fs::temp_directory_path() / "dioptre-lod-XXXXXX").string();
        if (!::mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
        folder = name;
        scene.meshes = {{"torus", {test::torus(24, 12, 0.02)}},
                        {"sheets", {test::sheet(12, 0.05), test::sheet(12, 0.05, 1.0)}},
                        {"the same", {test::torus(24, 12, 0.02)}}};
    }
    ~LodTest() override {
        std::error_code ignored;
        fs::remove_all(folder, ignored);
    }

    static Found sorted(std::vector<BuiltLevel> levels) {
        Found found;
        for (BuiltLevel& level : levels) {
            // In order, none left out
            if (level.level > 1) {
                EXPECT_TRUE(found.contains({level.mesh, level.primitive, level.level - 1}));
            }
            const std::tuple key{level.mesh, level.primitive, level.level};
            EXPECT_TRUE(found.emplace(key, std::move(level)).second);
        }
        return found;
    }
    Found build(const fs::path& cache, unsigned threads = 2) const {
        LodBuilder builder(scene, {cache, threads});
        builder.wait();
        EXPECT_TRUE(builder.finished());
        EXPECT_EQ(builder.progress(), 1.0);
        return sorted(builder.take());
    }
    static void expectEqual(const Found& a, const Found& b) {
        ASSERT_EQ(a.size(), b.size());
        for (auto i = a.begin(), k = b.begin(); i != a.end(); ++i, ++k) {
            ASSERT_EQ(i->first, k->first);
            EXPECT_EQ(i->second.data.indices, k->second.data.indices);
            EXPECT_EQ(i->second.data.error, k->second.data.error);
        }
    }
    static bool cached(const Found& found) {
        std::size_t count = 0;
        for (const auto& [key, level] : found) count += level.cached ? 1 : 0;
        EXPECT_TRUE(count == 0 || count == found.size());
        return count > 0;
    }
    std::vector<fs::path> files(const fs::path& in) const {
        std::vector<fs::path> names;
        for (const auto& entry : fs::directory_iterator(in)) names.push_back(entry.path());
        return names;
    }

    fs::path folder;
    Scene scene;
};

TEST_F(LodTest, IsTheSameAtAnyNumberOfThreads) {
    const Found one = build({}, 1);
    EXPECT_GE(one.size(), 8u);
    expectEqual(one, build({}, 4));
    // Equal primitives get equal levels
    EXPECT_EQ(one.at({0, 0, 2}).data.indices, one.at({2, 0, 2}).data.indices);
}

TEST_F(LodTest, BordersBetweenMaterialsAreEqualAtEveryLevel) {
    const Found found = build({});
    const auto border = [&](std::size_t primitive, const std::vector<std::uint32_t>& indices) {
        std::set<std::pair<float, float>> places;
        for (const std::uint32_t i : indices) {
            const glm::vec3& p = scene.meshes[1].primitives[primitive].vertices[i].position;
            if (p.x == 1.0f) places.insert({p.y, p.z});
        }
        return places;
    };
    const auto wanted = border(0, scene.meshes[1].primitives[0].indices);
    EXPECT_EQ(wanted.size(), 13u);
    int levels = 0;
    for (const auto& [key, level] : found) {
        if (level.mesh != 1) continue;
        EXPECT_EQ(border(level.primitive, level.data.indices), wanted) << level.primitive << ' ' << level.level;
        ++levels;
    }
    EXPECT_GE(levels, 2);
}

TEST_F(LodTest, WhatBendsHasNoLevels) {
    scene.meshes[0].primitives[0].deformation = std::make_shared<Deformation>();
    scene.meshes[2].primitives[0].topology = Topology::lines;
    for (const auto& [key, level] : build({})) EXPECT_EQ(level.mesh, 1u);
    scene.meshes.clear();
    EXPECT_TRUE(build({}).empty());
}

TEST_F(LodTest, AreHandedOutWhileOthersAreMade) {
    scene.meshes.push_back({"large", {test::torus(200, 100, 0.01)}});
    LodBuilder builder(scene, {{}, 1});
    std::vector<BuiltLevel> all;
    while (all.empty() && !builder.finished()) all = builder.take();
    ASSERT_FALSE(all.empty());
    EXPECT_EQ(all.front().mesh, scene.meshes.size() - 1) << "the largest first";
    EXPECT_EQ(all.front().level, 1);
    double progress = builder.progress();
    EXPECT_LT(progress, 1.0) << "while the rest is made";
    while (!builder.finished()) {
        for (BuiltLevel& level : builder.take()) all.push_back(std::move(level));
        EXPECT_GE(builder.progress(), progress);
        progress = builder.progress();
    }
    for (BuiltLevel& level : builder.take()) all.push_back(std::move(level));
    expectEqual(sorted(std::move(all)), build({}));
}

TEST_F(LodTest, StopsEarly) {
    scene.meshes = {{"large", {test::torus(400, 200, 0.01)}}};
    auto builder = std::make_unique<LodBuilder>(scene, LodOptions{folder, 1});
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    builder.reset();
    EXPECT_TRUE(files(folder).empty());
}

TEST_F(LodTest, CacheGivesTheSame) {
    const fs::path cache = folder / "deep" / "lods";
    const Found made = build(cache);
    EXPECT_FALSE(cached(made));
    EXPECT_EQ(files(cache).size(), 3u);
    const Found read = build(cache);
    EXPECT_TRUE(cached(read));
    expectEqual(made, read);
    // Another mesh is not taken for it
    scene.meshes[0].primitives[0].vertices[7].uv.x += 0.001f;
    scene.meshes.resize(1);
    EXPECT_FALSE(cached(build(cache)));
}

TEST_F(LodTest, BrokenCacheIsMadeAnew) {
    scene.meshes.resize(1);
    const Found made = build(folder);
    ASSERT_EQ(files(folder).size(), 1u);
    const fs::path file = files(folder)[0];
    std::ifstream in(file, std::ios::binary);
    const std::string whole{std::istreambuf_iterator<char>(in), {}};
    std::vector<std::string> broken = {"",
                                       "garbage",
                                       whole.substr(0, whole.size() / 2),
                                       whole.substr(0, 40),
                                       whole + "more",
                                       std::string(whole.size() * 20, 'x')};
    for (const std::size_t at : {std::size_t{0}, std::size_t{8}, std::size_t{12}, std::size_t{20}, std::size_t{32},
                                 whole.size() / 2, whole.size() - 1}) {
        broken.push_back(whole);
        broken.back()[at] = static_cast<char>(broken.back()[at] ^ 0x81);
    }
    for (const std::string& bytes : broken) {
        std::ofstream(file, std::ios::binary) << bytes;
        const Found again = build(folder);
        EXPECT_FALSE(cached(again)) << bytes.size();
        expectEqual(again, made);
        EXPECT_TRUE(cached(build(folder))) << "was not written";
    }
    // A pipe that nobody writes to
    fs::remove(file);
    ASSERT_EQ(::mkfifo(file.c_str(), 0600), 0);
    expectEqual(build(folder), made);
    EXPECT_TRUE(cached(build(folder)));
}

TEST_F(LodTest, ACacheBrokenAllOverIsSaidOnce) {
    const Found wanted = build(folder);
    for (const fs::path& file : files(folder)) std::ofstream(file, std::ios::binary) << "garbage";
    testing::internal::CaptureStderr();
    const Found made = build(folder);
    const std::string said = testing::internal::GetCapturedStderr();
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
    EXPECT_THAT(said, testing::StartsWith("warning: " + folder.string()));
    expectEqual(made, wanted);
    EXPECT_TRUE(cached(build(folder)));
}

TEST_F(LodTest, WorksWithoutACacheThatCanBeWritten) {
    const Found wanted = build({});
    std::ofstream(folder / "file") << "in the way";
    testing::internal::CaptureStderr();
    const Found made = build(folder / "file" / "lods");
    const std::string said = testing::internal::GetCapturedStderr();
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
    EXPECT_THAT(said, testing::StartsWith("warning: "));
    expectEqual(made, wanted);
    expectEqual(build("/proc/dioptre-test"), wanted);  // where even root cannot write
}

TEST_F(LodTest, AFullDiskLeavesNoTrace) {
    const Found wanted = build({});
    rlimit before{};
    ::getrlimit(RLIMIT_FSIZE, &before);
    const rlimit lower{1000, before.rlim_max};
    auto* const handler = std::signal(SIGXFSZ, SIG_IGN);
    ::setrlimit(RLIMIT_FSIZE, &lower);
    const Found made = build(folder);
    ::setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    expectEqual(made, wanted);
    EXPECT_TRUE(files(folder).empty());
}

TEST_F(LodTest, TwoProcessesAtOnceShareACache) {
    const Found wanted = build({});
    const pid_t child = ::fork();
    if (child == 0) {
        LodBuilder(scene, {folder, 2}).wait();
        ::_exit(0);
    }
    expectEqual(build(folder), wanted);
    int status = -1;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_EQ(status, 0);
    const Found read = build(folder);
    EXPECT_TRUE(cached(read));
    expectEqual(read, wanted);
    EXPECT_EQ(files(folder).size(), 3u);
}

}  // namespace
}  // namespace dioptre
