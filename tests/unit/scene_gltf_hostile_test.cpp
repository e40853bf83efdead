// Some thousands of damaged files, and those on which the loader once failed: it reads or refuses each, in little time
// and memory.
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <ctime>
#include <new>

#include "hostile_scenes.hpp"

namespace dioptre {
namespace {

using namespace test;
namespace fs = std::filesystem;

constexpr int kParts = 4;  // run side by side
constexpr double kMostSeconds = 2.0;
[[maybe_unused]] constexpr long kMostKilobytes = 512 * 1024;

// What a child process has to say, also when it crashes: lies in memory that both see.
struct Progress {
    std::size_t file, loaded, refused;
    double longestSeconds;
    std::size_t longest;  // its file
    char problem[300];
};

/// Of the processor, in all threads: the machine may be busy.
double secondsUsed() {
    timespec time{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9;
}

void readAll(std::span<const NamedFile> files, Progress& progress) {
    const TemporaryFolder folder;
    for (; progress.file < files.size(); ++progress.file) {
        const fs::path path = folder.write("scene.gltf", files[progress.file].bytes);
        const double start = secondsUsed();
        try {
            loadGltf(path);
            ++progress.loaded;
        } catch (const InputError& error) {
            ++progress.refused;
            const std::string what = error.what();
            if (!what.starts_with("scene.gltf: ") || what.find('\n') != std::string::npos)
                what.copy(progress.problem, sizeof progress.problem - 1);
        }
        const double seconds = secondsUsed() - start;
        if (seconds <= progress.longestSeconds) continue;
        progress.longestSeconds = seconds;
        progress.longest = progress.file;
    }
}

/// Reads them in a process of its own, so that a crash names its file and memory is told apart.
Progress readApart(std::span<const NamedFile> files) {
    void* shared = ::mmap(nullptr, sizeof(Progress), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (shared == MAP_FAILED) throw std::bad_alloc();
    auto* progress = new (shared) Progress{};
    const pid_t child = ::fork();
    if (child == 0) {
        readAll(files, *progress);
        ::_exit(0);
    }
    int status = -1;
    rusage usage{};
    EXPECT_EQ(::wait4(child, &status, 0, &usage), child);
    EXPECT_EQ(status, 0) << "at " << (progress->file < files.size() ? files[progress->file].name : "the end");
    EXPECT_LT(progress->longestSeconds, kMostSeconds) << files[progress->longest].name;
#ifndef DIOPTRE_SANITIZED  // which take memory of their own
    EXPECT_LT(usage.ru_maxrss, kMostKilobytes) << "from " << files.front().name << " on";
#endif
    EXPECT_STREQ(progress->problem, "");
    const Progress result = *progress;
    ::munmap(shared, sizeof(Progress));
    return result;
}

TEST(GltfHostileTest, TheWholeModelIsValid) {
    const Scene scene = load(everythingGltf());
    // The square, a triangle, a strip and a fan of two each
    EXPECT_EQ(scene.triangleCount(), 7u);
    EXPECT_EQ(scene.cameras.size(), 1u);
    const TemporaryFolder folder;
    EXPECT_EQ(loadGltf(folder.write("scene.glb", asGlb(everythingGltf()))).triangleCount(), 7u);
}

class GltfHostilePartTest : public testing::TestWithParam<std::size_t> {};

TEST_P(GltfHostilePartTest, DamagedFilesAreReadOrRefused) {
    const std::vector<NamedFile> all = damagedFiles();
    ASSERT_GT(all.size(), 2000u);
    std::vector<NamedFile> files;
    for (std::size_t i = GetParam(); i < all.size(); i += kParts) files.push_back(all[i]);
    constexpr std::size_t kBatch = 200;
    std::size_t refused = 0;
    for (std::size_t i = 0; i < files.size(); i += kBatch)
        refused += readApart({files.data() + i, std::min(kBatch, files.size() - i)}).refused;
    // Names and factors may be anything; most of the rest may not.
    EXPECT_GT(refused, files.size() / 2);
}

INSTANTIATE_TEST_SUITE_P(Parts, GltfHostilePartTest, testing::Range<std::size_t>(0, kParts));

TEST(GltfHostileTest, WhatOnceFailedIsReadOrRefused) {
    std::vector<NamedFile> files;
    for (const auto& entry : fs::directory_iterator(fs::path(DIOPTRE_TEST_DATA) / "hostile")) {
        std::ifstream in(entry.path(), std::ios::binary);
        files.push_back({entry.path().filename(), {std::istreambuf_iterator<char>(in), {}}});
    }
    ASSERT_FALSE(files.empty());
    readApart(files);
}

}  // namespace
}  // namespace dioptre
