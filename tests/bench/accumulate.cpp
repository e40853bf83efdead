// What accumulation gains by levels of detail and sub-samples, against plain accumulation in the same run: figure 11 of
// Jeong et al. 2013, and the time that plain accumulation takes for the same SSIM.
//
//   bench_accumulate [SCENE...] [--diameter PX] [--reference N] [--size WxH] [--quick]
//
// default: toys, fishes, dragons at 1024x768, a mean CoC DIAMETER of 20 px, focus on the median of what is visible;
// errors against N = 1024 other points of the lens. --quick: one frame each, fewer N.
//
//   bench_accumulate pops [SCENE]
//
// Whether levels of detail or shared renderings pop: a focus pull and a dolly of 2 s at 60 Hz, 320x240, N = 128; the SSIM
// of each frame to the next, and the most that it is below that of the reference's frames. Default: the studio.
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>

#include "bench_common.hpp"
#include "core/image.hpp"
#include "core/log.hpp"
#include "frame/frame_maker.hpp"
#include "frame/measure_frames.hpp"
#include "frame/measure_lens.hpp"
#include "gl/context.hpp"
#include "metrics/metrics.hpp"
#include "scene/builtin.hpp"
#include "scene/lod.hpp"

namespace dioptre {
namespace {

struct Options {
    std::vector<std::string> scenes;
    double diameter = 20.0;
    int reference = 1024;
    int width = 1024, height = 768;
    bool quick = false;
};

struct Shot {
    const GpuScene& scene;
    View view;
    Lens lens;
};

struct Drawn {
    Image picture;
    double milliseconds = 0.0;  // median
    std::uint64_t triangles = 0;
    std::map<std::string_view, double> stages;  // of one more frame
};

Drawn draw(const Shot& shot, TechniqueChoice choice, int samples, int subsamples, int firstSample, int frames) {
    PassLog log;
    const auto technique = makeTechnique(choice);
    EyeFrame frame{shot.scene, shot.view, shot.lens, 1.0f, 0, {}, log, samples, subsamples, firstSample};
    Drawn drawn;
    if (frames > 0) {
        EyeFrame least = frame;
        least.samples = 4;
        technique->draw(least);
        glFinish();
    }
    std::vector<double> times;
    for (int i = 0; i < std::max(1, frames); ++i) {
        const std::uint64_t before = shot.scene.trianglesDrawn();
        const double start = nowMilliseconds();
        const Texture& picture = technique->draw(frame);
        glFinish();
        times.push_back(nowMilliseconds() - start);
        drawn.triangles = shot.scene.trianglesDrawn() - before;
        if (i > 0) continue;
        drawn.picture = Image(shot.view.width, shot.view.height);
        drawn.picture.pixels = readTexture(picture, GL_RGB, 3);
    }
    drawn.milliseconds = median(times);
    if (frames > 0) {
        log.clear();
        log.timed = true;
        technique->draw(frame);
        for (const PassLog::Entry& entry : log.entries) drawn.stages[entry.name] += entry.milliseconds;
    }
    return drawn;
}

/// How many times as long plain accumulation takes for an SSIM, interpolated in log N; a bound where it lies outside of
/// what was measured.
std::string timesFaster(const std::vector<std::pair<double, double>>& ssimTime, double ssim, double milliseconds) {
    for (std::size_t i = 1; i < ssimTime.size(); ++i) {
        const auto& [a, timeA] = ssimTime[i - 1];
        const auto& [b, timeB] = ssimTime[i];
        if (ssim < a || ssim > b) continue;
        const double time = std::exp(std::log(timeA) + (ssim - a) / (b - a) * (std::log(timeB) - std::log(timeA)));
        return fmt::format("{:.2f}", time / milliseconds);
    }
    const bool beyond = ssim > ssimTime.back().first;
    return fmt::format("{} {:.2f}", beyond ? '>' : '<',
                       (beyond ? ssimTime.back() : ssimTime.front()).second / milliseconds);
}

void compare(const std::string& name, const Options& options) {
    const Scene scene = loadBuiltin(name, cacheFolder());
    GpuScene gpu(scene);
    for (const BuiltLevel& built : buildLevels(scene, {lodFolder()}))
        gpu.addLevel(built.mesh, built.primitive, built.data);
    ViewSettings settings;
    settings.size = {options.width, options.height};
    const View view = startView(scene, settings);
    const VergenceStatistics seen = visibleVergences(gpu, view);
    const Lens lens = measuredLens(seen, {"middle", 0.5}, {"", options.diameter * kMeasuredWidth / options.width},
                                   focalLengthPixels(view).x, options.width);
    const Shot shot{gpu, view, lens};
    // The sequence goes on so far that no sample is one of those that are judged.
    constexpr int kOtherSamples = 100003;
    const Image reference = draw(shot, TechniqueChoice::reference, options.reference, 0, kOtherSamples, 0).picture;
    fmt::print("\n{}: {} triangles, aperture diameter {:.1f} mm, focus {:.3f} D\n\n", name, scene.triangleCount(),
               lens.apertureRadius.value * 2e3, lens.focus.value);

    fmt::print("| plain N | SSIM | PSNR, dB | ms |\n|---|---|---|---|\n");
    std::vector<std::pair<double, double>> plain;
    std::uint64_t trianglesOfSample = 1;
    const int most = options.quick ? 128 : 256;
    for (int n = 8; n <= most; n *= 2) {
        const Drawn drawn = draw(shot, TechniqueChoice::reference, n, 0, 0, options.quick || n > 32 ? 1 : 3);
        const Comparison error = compareImages(reference, drawn.picture);
        plain.emplace_back(error.ssim, drawn.milliseconds);
        trianglesOfSample = drawn.triangles / static_cast<std::uint64_t>(n);
        fmt::print("| {} | {:.4f} | {:.2f} | {:.0f} |\n", n, error.ssim, error.psnr, drawn.milliseconds);
        std::fflush(stdout);
    }
    fmt::print(
        "\n| N | S | SSIM | PSNR, dB | ms | triangles | faster | stages, ms |\n"
        "|---|---|---|---|---|---|---|---|\n");
    for (const int n : {8, 16, 32, 64})
        for (const int s : {0, 4, 8}) {
            if (options.quick && (n == 64 || s == 8)) continue;
            const Drawn drawn = draw(shot, TechniqueChoice::accumulate, n, s, 0, options.quick ? 1 : 2);
            const Comparison error = compareImages(reference, drawn.picture);
            std::string stages;
            for (const auto& [stage, time] : drawn.stages) stages += fmt::format("{} {:.0f} ", stage, time);
            fmt::print("| {} | {} | {:.4f} | {:.2f} | {:.0f} | {:.0f} % | {} | {}|\n", n, s, error.ssim, error.psnr,
                       drawn.milliseconds,
                       100.0 * static_cast<double>(drawn.triangles) / (static_cast<double>(trianglesOfSample) * n),
                       timesFaster(plain, error.ssim, drawn.milliseconds), stages);
            std::fflush(stdout);
        }
}

/// A focus pull from 0.4 m to 4 m, linear in dioptres, or a dolly of 0.6 m.
Shot movingShot(const GpuScene& scene, const View& start, bool dolly, double along) {
    View view = start;
    if (dolly) view.pose.position += view.pose.orientation * glm::dvec3(0.0, 0.0, -0.6 * along);
    return {scene, view, {Metres(0.004), Metres(0.017), Dioptres(dolly ? 1.0 : glm::mix(2.5, 0.25, along))}};
}

void pops(const std::string& name) {
    constexpr int kFrames = 120, kSamples = 128;
    const Scene scene = loadBuiltin(name, cacheFolder());
    GpuScene gpu(scene);
    for (const BuiltLevel& built : buildLevels(scene, {lodFolder()}))
        gpu.addLevel(built.mesh, built.primitive, built.data);
    ViewSettings settings;
    settings.size = {320, 240};
    const View start = startView(scene, settings);
    fmt::print("| {} | S | least SSIM to the next frame | of the reference | most below it |\n|---|---|---|---|---|\n",
               name);
    struct Row {
        int subsamples;
        Image before = {};
        double least = 1.0, below = 0.0;
    };
    for (const bool dolly : {false, true}) {
        Row rows[] = {{0}, {4}};
        Image referenceBefore;
        double referenceLeast = 1.0;
        for (int i = 0; i < kFrames; ++i) {
            const Shot shot = movingShot(gpu, start, dolly, i / double{kFrames});
            Image reference = draw(shot, TechniqueChoice::reference, kSamples, 0, 0, 0).picture;
            const double its = i > 0 ? ssim(referenceBefore, reference) : 1.0;
            referenceLeast = std::min(referenceLeast, its);
            referenceBefore = std::move(reference);
            for (Row& row : rows) {
                Image now = draw(shot, TechniqueChoice::accumulate, kSamples, row.subsamples, 0, 0).picture;
                if (i > 0) {
                    const double mine = ssim(row.before, now);
                    row.least = std::min(row.least, mine);
                    row.below = std::max(row.below, its - mine);
                }
                row.before = std::move(now);
            }
        }
        for (const Row& row : rows)
            fmt::print("| {} | {} | {:.4f} | {:.4f} | {:.4f} |\n", dolly ? "dolly" : "focus pull", row.subsamples,
                       row.least, referenceLeast, row.below);
        std::fflush(stdout);
    }
}

Options parse(int argc, char** argv) {
    Options options;
    for (int i = 1; i < argc; ++i) {
        const std::string argument = argv[i];
        const auto value = [&] { return i + 1 < argc ? std::string(argv[++i]) : std::string(); };
        if (argument == "--quick")
            options.quick = true;
        else if (argument == "--diameter")
            options.diameter = std::atof(value().c_str());
        else if (argument == "--reference")
            options.reference = std::atoi(value().c_str());
        else if (argument == "--size")
            std::sscanf(value().c_str(), "%dx%d", &options.width, &options.height);
        else
            options.scenes.push_back(argument);
    }
    if (options.scenes.empty()) options.scenes = {"toys", "fishes", "dragons"};
    return options;
}

}  // namespace
}  // namespace dioptre

int main(int argc, char** argv) {
    try {
        const dioptre::Options options = dioptre::parse(argc, argv);
        const auto context = dioptre::createHeadlessContext("auto");
        if (options.scenes.front() == "pops") {
            dioptre::pops(options.scenes.size() > 1 ? options.scenes[1] : "studio");
            return 0;
        }
        for (const std::string& scene : options.scenes) dioptre::compare(scene, options);
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
