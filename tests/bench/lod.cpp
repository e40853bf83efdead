// What levels of detail cost: a closed, bumpy torus of a million triangles with seams, on one core, or the primitives of
// scenes.
//
//   bench_lod [--triangles N] [FILE.glb|builtin:NAME ...]
#include <fmt/format.h>
#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>

#include "core/text.hpp"
#include "scene/builtin.hpp"
#include "scene/gltf_loader.hpp"
#include "scene/lod.hpp"

namespace dioptre {
namespace {

/// Seams where either of the two angles begins.
Primitive bumpyTorus(std::size_t triangles) {
    const auto across = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(triangles) / 4.0));
    const std::uint32_t along = 2 * across;
    Primitive primitive;
    for (std::uint32_t i = 0; i <= along; ++i) {
        for (std::uint32_t k = 0; k <= across; ++k) {
            const double a = 2.0 * M_PI * (i % along) / along, b = 2.0 * M_PI * (k % across) / across;
            const double tube =
                0.3 + 0.02 * std::sin(17.0 * a) * std::cos(9.0 * b) + 0.002 * std::sin(90.0 * a + 40.0 * b);
            const double r = 1.0 + tube * std::cos(b);
            Vertex v;
            v.position = {r * std::cos(a), tube * std::sin(b), -r * std::sin(a)};
            v.normal = {std::cos(b) * std::cos(a), std::sin(b), -std::cos(b) * std::sin(a)};
            v.uv = {static_cast<float>(i) / static_cast<float>(along),
                    static_cast<float>(k) / static_cast<float>(across)};
            primitive.vertices.push_back(v);
            primitive.bounds.add(v.position);
        }
    }
    for (std::uint32_t i = 0; i < along; ++i) {
        for (std::uint32_t k = 0; k < across; ++k) {
            const std::uint32_t a = i * (across + 1) + k, b = a + across + 1;
            for (const std::uint32_t index : {a, b, b + 1, a, b + 1, a + 1}) primitive.indices.push_back(index);
        }
    }
    return primitive;
}

double userSeconds() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_utime.tv_sec) + static_cast<double>(usage.ru_utime.tv_usec) * 1e-6;
}
double peakMegabytes() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

void measure(const std::string& name, const Scene& scene, bool eachLevel) {
    const double userBefore = userSeconds(), memoryBefore = peakMegabytes();
    const auto start = std::chrono::steady_clock::now();
    LodBuilder builder(scene, {});
    builder.wait();
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
    const double user = userSeconds() - userBefore;
    std::size_t triangles = 0, chains = 0, toTheEnd = 0;
    for (const Mesh& mesh : scene.meshes) {
        for (const Primitive& primitive : mesh.primitives) {
            triangles += primitive.triangleCount();
            chains += primitive.triangleCount() > kFewestTriangles ? 1 : 0;
        }
    }
    for (const BuiltLevel& built : builder.take()) {
        const std::size_t left = built.data.indices.size() / 3;
        toTheEnd += left <= kFewestTriangles ? 1 : 0;
        if (eachLevel)
            fmt::print("level {:2}  {:8} triangles  error {:.3e} m  {:6.2f} s\n", built.level, left, built.data.error,
                       built.data.seconds);
    }
    fmt::print(
        "{}: {} triangles, {:.2f} s wall, {:.2f} s of processor time, {:.2f} s per million triangles; "
        "peak memory {:.0f} MB above the {:.0f} MB before; {} of {} chains end at {} triangles or fewer\n",
        name, triangles, wall.count(), user, user * 1e6 / static_cast<double>(triangles),
        peakMegabytes() - memoryBefore, memoryBefore, toTheEnd, chains, kFewestTriangles);
}

}  // namespace
}  // namespace dioptre

int main(int argc, char** argv) {
    using namespace dioptre;
    try {
        std::size_t triangles = 1'000'000;
        bool scenes = false;
        for (int i = 1; i < argc; ++i) {
            const std::string argument = argv[i];
            if (argument == "--triangles" && i + 1 < argc) {
                triangles = static_cast<std::size_t>(parseInteger(argv[++i]).value_or(1000));
                continue;
            }
            scenes = true;
            const auto builtin = builtinName(argument);
            const Scene scene = builtin ? loadBuiltin(*builtin, cacheFolder()) : loadGltf(argument);
            measure(argument, scene, false);
        }
        if (!scenes) {
            Scene scene;
            scene.meshes.push_back({"torus", {bumpyTorus(triangles)}});
            measure("torus", scene, true);
        }
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
