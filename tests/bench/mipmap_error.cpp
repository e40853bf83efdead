// How far the mipmap technique is from the reference as blur grows: three built-in scenes, focus near and far.
//
//   bench_mipmap_error [SAMPLES]     default 256: SSIM, PSNR and FLIP at 640x480 for mean CoC DIAMETERS of 2 ... 32 px,
//                                    and the diameter up to which SSIM is at least 0.95
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "core/image.hpp"
#include "frame/frame_maker.hpp"
#include "frame/measure_frames.hpp"
#include "frame/measure_lens.hpp"
#include "gl/context.hpp"
#include "metrics/metrics.hpp"
#include "scene/builtin.hpp"

namespace dioptre {
namespace {

constexpr double kEnough = 0.95;

Image draw(TechniqueChoice technique, const GpuScene& scene, const View& view, const Lens& lens, int samples) {
    PassLog log;
    const auto drawn = makeTechnique(technique);
    Image picture(view.width, view.height);
    picture.pixels = readTexture(drawn->draw({scene, view, lens, 1.0f, 4, {}, log, samples}), GL_RGB, 3);
    return picture;
}

void curve(const std::string& name, int samples) {
    const Scene scene = loadBuiltin(name, cacheFolder());
    const GpuScene gpu(scene);
    const View view = startView(scene, ViewSettings{});
    const VergenceStatistics seen = visibleVergences(gpu, view);
    for (const MeasuredFocus& focus : kMeasuredFocuses) {
        double before = 0.0, ssimBefore = 1.0, until = 0.0;
        for (const double diameter : {2.0, 4.0, 8.0, 12.0, 20.0, 32.0}) {
            const Lens lens =
                measuredLens(seen, focus, {"", diameter}, focalLengthPixels(view).x, static_cast<int>(kMeasuredWidth));
            const Image reference = draw(TechniqueChoice::reference, gpu, view, lens, samples);
            const Comparison error = compareImages(reference, draw(TechniqueChoice::mipmap, gpu, view, lens, 1));
            std::fputs(fmt::format("| {} | {} | {:g} | {:.1f} | {:.4f} | {:.2f} | {:.4f} |\n", name, focus.name,
                                   diameter, lens.apertureRadius.value * 2e3, error.ssim, error.psnr, error.flip)
                           .c_str(),
                       stdout);
            std::fflush(stdout);
            if (ssimBefore >= kEnough)
                until = error.ssim >= kEnough
                            ? diameter
                            : before + (diameter - before) * (ssimBefore - kEnough) / (ssimBefore - error.ssim);
            before = diameter;
            ssimBefore = error.ssim;
        }
        std::fputs(fmt::format("{}, {}: SSIM {} up to {:.1f} px\n", name, focus.name, kEnough, until).c_str(), stderr);
    }
}

}  // namespace
}  // namespace dioptre

int main(int argc, char** argv) {
    try {
        const auto context = dioptre::createHeadlessContext("auto");
        std::fputs(
            "| scene | focus | mean CoC diameter, px | aperture, mm | SSIM | PSNR, dB | FLIP |\n"
            "|---|---|---|---|---|---|---|\n",
            stdout);
        for (const char* name : {"studio", "toys", "fishes"}) dioptre::curve(name, argc > 1 ? std::atoi(argv[1]) : 256);
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
