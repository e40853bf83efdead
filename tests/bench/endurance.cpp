// Twenty thousand random frames: no GL error, nothing left behind, memory flat. Exit code 1 where that does not hold.
//
//   bench_endurance [FRAMES [SEED]]
#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <vector>

#include "bench_common.hpp"
#include "gl/context.hpp"
#include "moving_scenes.hpp"
#include "random_frames.hpp"
#include "scene/builtin.hpp"
#include "test_scenes.hpp"

namespace {

double residentMegabytes() {
    std::ifstream statm("/proc/self/statm");
    double all = 0.0, resident = 0.0;
    statm >> all >> resident;
    return resident * static_cast<double>(::sysconf(_SC_PAGESIZE)) / 1e6;
}

}  // namespace

int main(int argc, char** argv) try {
    using namespace dioptre;
    const int frames = argc > 1 ? std::atoi(argv[1]) : 20000;
    const auto seed = static_cast<unsigned>(argc > 2 ? std::atoi(argv[2]) : 1);
    const auto context = createHeadlessContext("auto");
    std::vector<Scene> scenes;
    scenes.push_back(loadBuiltin("studio", {}));
    test::SceneBuilder b;
    b.wall(4.0, b.unlit({0.5f, 0.5f, 0.5f})).sphere({0.0, 0.0, -0.6}, 0.1, b.unlit({5.0f, 0.2f, 0.1f}));
    scenes.push_back(b.camera().scene());
    scenes.push_back({});
    scenes.push_back(test::load(test::bendingBarGltf()));
    test::RandomFrames random(scenes, seed);
    constexpr int kSteps = 20, kWarmUp = 5;
    std::vector<double> before, after;  // the first half of what follows the warm-up, and the second
    for (int step = 0; step < kSteps; ++step) {
        random.run(frames / kSteps);
        const double resident = residentMegabytes();
        if (step >= kWarmUp) (step < (kSteps + kWarmUp) / 2 ? before : after).push_back(resident);
        fmt::print("{:6} frames  {:.0f} MB resident\n", (step + 1) * (frames / kSteps), resident);
        std::fflush(stdout);
    }
    // What is freed comes back late, under a sanitizer by hundreds of megabytes more or less.
    constexpr double kFlat = 1.1;
    if (median(after) > kFlat * median(before)) {
        fmt::print("memory grew from {:.0f} to {:.0f} MB\n", median(before), median(after));
        return 1;
    }
    return 0;
} catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
}
