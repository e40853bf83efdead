// dioptre inspect --lods: the levels of detail of each mesh, made or read from the cache.
#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <map>
#include <string_view>
#include <utility>

#include "commands.hpp"
#include "core/text.hpp"
#include "scene/lod.hpp"

namespace dioptre {

namespace {

using Chains = std::map<std::pair<std::size_t, std::size_t>, std::vector<BuiltLevel>>;  // by mesh and primitive

Chains build(const Scene& scene) {
    Chains chains;
    for (BuiltLevel& built : buildLevels(scene, {lodFolder()}))
        chains[{built.mesh, built.primitive}].push_back(std::move(built));
    return chains;
}

/// Why a chain is as long as it is; empty where it came to its end.
std::string_view remark(const Primitive& primitive, const std::vector<BuiltLevel>& levels) {
    if (primitive.topology != Topology::triangles) return "points or lines have no levels";
    if (primitive.deformation) return "bends: no levels";
    const std::size_t last = levels.empty() ? primitive.triangleCount() : levels.back().data.indices.size() / 3;
    return last > kFewestTriangles ? "seams, hard edges, borders or small parts allow no more" : "";
}

std::string chainText(const Mesh& mesh, std::size_t index, const std::vector<BuiltLevel>& levels) {
    const Primitive& primitive = mesh.primitives[index];
    std::string text = fmt::format("{} primitive {}{}\n", quote(mesh.name), index,
                                   levels.empty() || !levels[0].cached ? "" : ", cached");
    text += fmt::format("  level  0 {:9} triangles\n", primitive.triangleCount());
    for (const BuiltLevel& level : levels)
        text +=
            fmt::format("  level {:2} {:9} triangles, error {:10.4g} mm, {:8.3f} s\n", level.level,
                        level.data.indices.size() / 3, static_cast<double>(level.data.error) * 1e3, level.data.seconds);
    if (const std::string_view why = remark(primitive, levels); !why.empty()) text += fmt::format("  {}\n", why);
    return text;
}

}  // namespace

void inspectLods(const Scene& scene) {
    const auto start = std::chrono::steady_clock::now();
    const Chains chains = build(scene);
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
    std::string text = fmt::format("scene      {}\n", scene.name);
    std::size_t levels = 0, indices = 0, primitives = 0, cached = 0;
    double seconds = 0.0;
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        for (std::size_t p = 0; p < scene.meshes[m].primitives.size(); ++p) {
            const auto found = chains.find({m, p});
            const std::vector<BuiltLevel> none;
            const std::vector<BuiltLevel>& chain = found == chains.end() ? none : found->second;
            text += chainText(scene.meshes[m], p, chain);
            ++primitives;
            for (const BuiltLevel& level : chain) {
                ++levels;
                indices += level.data.indices.size();
                seconds += static_cast<double>(level.data.seconds);
                cached += level.cached ? 1 : 0;
            }
        }
    }
    std::size_t source = 0;
    for (const Mesh& mesh : scene.meshes)
        for (const Primitive& p : mesh.primitives)
            source += p.vertices.size() * sizeof(Vertex) + p.extras.size() * sizeof(VertexExtra) +
                      p.indices.size() * sizeof(std::uint32_t);
    text += fmt::format("levels     {} of {} primitives, {} of them cached\n", levels, primitives, cached);
    text += fmt::format("memory     {:.1f} MB beside {:.1f} MB of meshes\n",
                        static_cast<double>(indices * sizeof(std::uint32_t)) / 1e6, static_cast<double>(source) / 1e6);
    text += fmt::format("time       {:.2f} s, of making them {:.2f} s of one core\n", wall.count(), seconds);
    std::fputs(text.c_str(), stdout);
}

}  // namespace dioptre
