// The reference technique: what N samples cost against N × (1.1 pinhole frames + 1 copy pass), and how fast its error
// falls with N.
//
//   bench_reference cost [SCENE.glb ...]     default: studio, toys, 2,000 small objects; one interleaved run each. Beside
//                                            it accumulate without levels of detail and sub-samples: what is left is what
//                                            it takes to plan, share and batch
//   bench_reference error [SCENE.glb]        RMSE of N = 16 ... 1024 against 4096 other samples, 640x480, pupil 4 mm: of
//                                            linear radiance, and of what a display shows of it (cut at 1)
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>

#include "bench_common.hpp"
#include "core/resources.hpp"
#include "frame/frame_maker.hpp"
#include "gl/context.hpp"
#include "render/technique.hpp"
#include "scene/builtin.hpp"
#include "scene/gltf_loader.hpp"

namespace dioptre {
namespace {

/// Cubes of 12 triangles all over the view, each an object of its own.
Scene manyObjects() {
    Scene scene;
    Material material;
    material.baseColor = glm::vec4(0.6f, 0.5f, 0.4f, 1.0f);
    scene.materials.push_back(material);
    Primitive cube;
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {-1.0f, 1.0f}) {
            const auto first = static_cast<std::uint32_t>(cube.vertices.size());
            for (const glm::vec2 c : {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)}) {
                Vertex v;
                v.position[axis] = side;
                v.position[(axis + 1) % 3] = c.x * side;
                v.position[(axis + 2) % 3] = c.y;
                v.normal = glm::vec3(0.0f);
                v.normal[axis] = side;
                cube.bounds.add(v.position);
                cube.vertices.push_back(v);
            }
            for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) cube.indices.push_back(first + i);
        }
    scene.meshes.push_back({"cube", {cube}});
    for (int i = 0; i < 2000; ++i) {
        const auto x = static_cast<float>(i % 50) - 24.5f, y = static_cast<float>(i / 50) - 19.5f;
        const float d = 3.0f + 0.1f * static_cast<float>((i * 37) % 90);
        glm::mat4 place(1.0f);
        place[3] = glm::vec4(x * 0.022f * d, y * 0.02f * d, -d, 1.0f);
        place[0] *= 0.006f * d, place[1] *= 0.006f * d, place[2] *= 0.006f * d;
        scene.instances.push_back({"cube", 0, place});
        for (const glm::vec3 corner : {cube.bounds.min, cube.bounds.max})
            scene.bounds.add(glm::vec3(place * glm::vec4(corner, 1.0f)));
    }
    Camera camera;
    scene.cameras.push_back(camera);
    return scene;
}

View viewOf(const Scene& scene, PictureSize size) {
    ViewSettings settings;
    settings.size = size;
    return startView(scene, settings);
}

void cost(const std::string& name, const Scene& scene) {
    const View view = viewOf(scene, {1024, 768});
    const GpuScene gpu(scene);
    const auto pinhole = makeTechnique(TechniqueChoice::pinhole);
    const auto reference = makeTechnique(TechniqueChoice::reference);
    const auto accumulate = makeTechnique(TechniqueChoice::accumulate);
    const CopyPass copy(view.width, view.height);
    const Lens lens{Metres(0.01), Metres(0.017), Dioptres(0.7)};
    PassLog log;
    EyeFrame frame{gpu, view, lens, 1.0f, 0, {}, log};
    frame.samples = 16;
    const auto timed = [&](Technique& technique) {
        glFinish();
        const double start = nowMilliseconds();
        technique.draw(frame);
        glFinish();
        return nowMilliseconds() - start;
    };
    for (Technique* technique : {pinhole.get(), reference.get(), accumulate.get()}) technique->draw(frame);
    std::vector<double> ratios, accumulates, perSample, pinholes, copies;
    for (int i = 0; i < 11; ++i) {
        const double before = timed(*pinhole), copied = copy.run(), sampled = timed(*reference) / frame.samples;
        const double without = 0.5 * (before + timed(*pinhole));
        ratios.push_back(sampled / (1.1 * without + copied));
        accumulates.push_back(timed(*accumulate) / frame.samples / (1.1 * without + copied));
        perSample.push_back(sampled);
        pinholes.push_back(without);
        copies.push_back(copied);
    }
    std::fputs(
        fmt::format("| {} | {} | {:.1f} | {:.1f} | {:.1f} | **{:.2f}** | {:.2f} |\n", name, scene.triangleCount(),
                    median(perSample), median(pinholes), median(copies), median(ratios), median(accumulates))
            .c_str(),
        stdout);
    std::fflush(stdout);
}

/// Least squares: how the logarithm of the error falls with that of N.
class Slope {
  public:
    void add(double n, double error) {
        const double x = std::log(n), y = std::log(error);
        sx_ += x, sy_ += y, sxx_ += x * x, sxy_ += x * y, count_ += 1.0;
    }
    double value() const { return (count_ * sxy_ - sx_ * sy_) / (count_ * sxx_ - sx_ * sx_); }

  private:
    double sx_ = 0.0, sy_ = 0.0, sxx_ = 0.0, sxy_ = 0.0, count_ = 0.0;
};

void error(const Scene& scene) {
    const View view = viewOf(scene, {640, 480});
    const GpuScene gpu(scene);
    const Lens lens{Metres(0.002), Metres(0.017), Dioptres(1.0)};
    PassLog log;
    EyeFrame frame{gpu, view, lens, 1.0f, 0, {}, log};
    const auto draw = [&](int first, int samples) {
        frame.firstSample = first;
        frame.samples = samples;
        return readTexture(makeTechnique(TechniqueChoice::reference)->draw(frame), GL_RGB, 3);
    };
    const std::vector<float> truth = draw(2048, 4096);
    std::fputs("| N | RMSE of radiance | RMSE cut at 1 |\n|---|---|---|\n", stdout);
    Slope ofRadiance, ofShown;
    for (int n = 16; n <= 1024; n *= 2) {
        const std::vector<float> picture = draw(0, n);
        double radiance = 0.0, shown = 0.0;
        for (std::size_t i = 0; i < truth.size(); ++i) {
            const auto a = static_cast<double>(picture[i]), b = static_cast<double>(truth[i]);
            radiance += (a - b) * (a - b);
            shown += std::pow(std::min(1.0, a) - std::min(1.0, b), 2.0);
        }
        radiance = std::sqrt(radiance / static_cast<double>(truth.size()));
        shown = std::sqrt(shown / static_cast<double>(truth.size()));
        ofRadiance.add(n, radiance);
        ofShown.add(n, shown);
        std::fputs(fmt::format("| {} | {:.5f} | {:.5f} |\n", n, radiance, shown).c_str(), stdout);
        std::fflush(stdout);
    }
    std::fputs(
        fmt::format("fitted: radiance N^{:.2f}, cut at 1 N^{:.2f}\n", ofRadiance.value(), ofShown.value()).c_str(),
        stdout);
}

void run(int argc, char** argv) {
    const auto context = createHeadlessContext("auto");
    std::fputs(fmt::format("{}, {}\n\n", rendererInfo().renderer, rendererInfo().version).c_str(), stdout);
    const auto studio = resource("assets/scenes/studio.glb");
    if (argc > 1 && std::strcmp(argv[1], "error") == 0) {
        error(loadGltf(argc > 2 ? std::filesystem::path(argv[2]) : studio));
        return;
    }
    std::fputs(
        "| scene | triangles | ms a sample | pinhole ms | copy ms | sample / (1.1 pinhole + copy) | of accumulate |\n"
        "|---|---|---|---|---|---|---|\n",
        stdout);
    if (argc <= 2) cost("studio", loadGltf(studio));
    if (argc <= 2) cost("2,000 objects", manyObjects());
    if (argc <= 2) cost("builtin:toys", loadBuiltin("toys", cacheFolder()));
    for (int i = 2; i < argc; ++i) cost(argv[i], loadGltf(argv[i]));
}

}  // namespace
}  // namespace dioptre

int main(int argc, char** argv) {
    try {
        dioptre::run(argc, argv);
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
