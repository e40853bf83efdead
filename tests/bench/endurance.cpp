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
    double warm = 0.0, last = 0.0;
    for (int step = 0; step < kSteps; ++step) {
        random.run(frames / kSteps);
        last = residentMegabytes();
        if (step == kWarmUp) warm = last;
        fmt::print("{:6} frames  {:.0f} MB resident\n", (step + 1) * (frames / kSteps), last);
        std::fflush(stdout);
    }
    constexpr double kFlat = 1.1;
    if (last > kFlat * warm) {
        fmt::print("memory grew from {:.0f} to {:.0f} MB\n", warm, last);
        return 1;
    }
    return 0;
} catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
}
