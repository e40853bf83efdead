// What the mipmap technique adds to a pinhole frame, in full-screen copy passes (one bilinear RGBA16F fetch a pixel) of
// the same size, all interleaved in one run: the unit makes the figure hold on a machine that is shared and noisy.
//
//   bench_mipmap_cost [--quick]      prints a Markdown table; ratios are medians of pairs
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <vector>

#include "bench_common.hpp"
#include "core/resources.hpp"
#include "frame/frame_maker.hpp"
#include "gl/context.hpp"
#include "render/technique.hpp"
#include "scene/gltf_loader.hpp"

namespace dioptre {
namespace {

constexpr Metres kNear{0.02};

/// A textured wall over the whole view at one distance.
Scene wallScene(double metres) {
    Scene scene;
    TextureImage checker{"checker", 256, 256, {}};
    for (int y = 0; y < 256; ++y)
        for (int x = 0; x < 256; ++x) {
            const auto v = static_cast<std::uint8_t>(((x / 16 + y / 16) & 1) != 0 ? 230 : 40);
            checker.rgba.insert(checker.rgba.end(), {v, static_cast<std::uint8_t>(255 - v), 90, 255});
        }
    scene.images.push_back(checker);
    Material material;
    material.unlit = material.doubleSided = true;
    material.baseColorTexture.image = 0;
    scene.materials.push_back(material);
    Primitive quad;
    const auto size = static_cast<float>(4.0 * metres), z = static_cast<float>(-metres);
    for (const glm::vec2 corner : {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)})
        quad.vertices.push_back({glm::vec3(corner * size, z), {0, 0, 1}, {1, 0, 0, 1}, corner * 8.0f});
    quad.indices = {0, 1, 2, 0, 2, 3};
    for (const Vertex& v : quad.vertices) quad.bounds.add(v.position);
    scene.bounds = quad.bounds;
    scene.meshes.push_back({"wall", {quad}});
    scene.instances.push_back({"wall", 0, glm::mat4(1.0f)});
    return scene;
}

struct Cost {
    double copies = 0.0, copyMilliseconds = 0.0, pinholeMilliseconds = 0.0, bytesPerPixel = 0.0;
    std::vector<std::pair<std::string_view, double>> stages;  // name, copies
};

double timed(Technique& technique, const EyeFrame& frame) {
    glFinish();
    const double start = nowMilliseconds();
    technique.draw(frame);
    glFinish();
    return nowMilliseconds() - start;
}

Cost measure(const GpuScene& scene, const View& view, const Lens& lens, int pairs) {
    const auto pinhole = makeTechnique(TechniqueChoice::pinhole);
    const auto mipmap = makeTechnique(TechniqueChoice::mipmap);
    const CopyPass copy(view.width, view.height);
    PassLog log;
    const EyeFrame frame{scene, view, lens, 1.0f, 0, {}, log};
    for (int i = 0; i < 2; ++i) {
        pinhole->draw(frame);
        mipmap->draw(frame);
        copy.run();
    }
    std::vector<double> ratios, copies, pinholes;
    for (int i = 0; i < pairs; ++i) {
        const double unit = copy.run();
        const double without = timed(*pinhole, frame);
        const double with = timed(*mipmap, frame);
        ratios.push_back((with - without) / (0.5 * (unit + copy.run())));
        copies.push_back(unit);
        pinholes.push_back(without);
        log.entries.clear();
    }
    Cost cost{median(ratios), median(copies), median(pinholes), 0.0, {}};
    cost.bytesPerPixel =
        static_cast<double>(mipmap->bytes() - pinhole->bytes()) / (static_cast<double>(view.width) * view.height);
    // By stage, in frames of their own since the waits between stages cost time.
    log.timed = true;
    std::vector<std::vector<double>> stages;
    for (int i = 0; i < 9; ++i) {
        log.entries.clear();
        const double unit = copy.run();
        mipmap->draw(frame);
        stages.resize(log.entries.size());
        for (std::size_t s = 0; s < log.entries.size(); ++s) stages[s].push_back(log.entries[s].milliseconds / unit);
    }
    for (std::size_t s = 0; s < stages.size(); ++s) cost.stages.emplace_back(log.entries[s].name, median(stages[s]));
    return cost;
}

void print(const std::string& what, const View& view, const Cost& cost) {
    std::string stages;
    for (const auto& [name, copies] : cost.stages)
        if (name != "geometry") stages += fmt::format("{}{} {:.1f}", stages.empty() ? "" : ", ", name, copies);
    std::fputs(
        fmt::format("| {} | {}x{} | **{:.1f}** | {} | {:.2f} | {:.1f} | {:.0f} |\n", what, view.width, view.height,
                    cost.copies, stages, cost.copyMilliseconds, cost.pinholeMilliseconds, cost.bytesPerPixel)
            .c_str(),
        stdout);
    std::fflush(stdout);
}

void run(bool quick) {
    const auto context = createHeadlessContext("auto");
    std::fputs(fmt::format("{}, {}\n\n", rendererInfo().renderer, rendererInfo().version).c_str(), stdout);
    std::fputs(
        "| view | size | DOF, copies | by stage | copy ms | pinhole ms | bytes/px |\n|---|---|---|---|---|---|---|\n",
        stdout);
    const int pairs = quick ? 7 : 21;
    for (const PictureSize size : {PictureSize{1024, 768}, PictureSize{1832, 1920}}) {
        if (const auto file = resource("assets/scenes") / "studio.glb"; std::filesystem::exists(file)) {
            const Scene scene = loadGltf(file);
            ViewSettings settings;
            settings.size = size;
            const View view = startView(scene, settings);
            const GpuScene gpu(scene);
            for (const double apertureMm : {5.0, 20.0}) {
                const Lens lens{Metres(apertureMm * 0.5e-3), Metres(0.017), Dioptres(1.0)};
                print(fmt::format("studio, {:g} mm at 1 m", apertureMm), view, measure(gpu, view, lens, pairs));
            }
        }
        View view;
        view.width = size.width;
        view.height = size.height;
        view.near = kNear;
        view.frustum = symmetricFrustum(Radians(0.8), static_cast<double>(size.width) / size.height);
        const GpuScene wall(wallScene(2.0));
        for (const bool behind : {true, false}) {
            double least = 1e9, most = 0.0;
            for (const double diameterPx : {4.0, 16.0, 64.0, 128.0}) {
                // A wall at 0.5 D seen with focus at 1.5 D (wall behind) or infinity (wall in front)
                const Dioptres focus(behind ? 1.5 : 0.0);
                const double perMetre = focalLengthPixels(view).x * std::abs(focus.value - 0.5);
                const Lens lens{Metres(0.5 * diameterPx / perMetre), Metres(0.017), focus};
                const Cost cost = measure(wall, view, lens, pairs);
                least = std::min(least, cost.copies);
                most = std::max(most, cost.copies);
                print(fmt::format("wall {} focus, CoC diameter {:g} px", behind ? "behind" : "in front of", diameterPx),
                      view, cost);
            }
            std::fputs(fmt::format("| largest / smallest | | {:.2f} | | | | |\n", most / least).c_str(), stdout);
        }
        if (quick) break;
    }
}

}  // namespace
}  // namespace dioptre

int main(int argc, char** argv) {
    try {
        dioptre::run(argc > 1 && std::strcmp(argv[1], "--quick") == 0);
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
