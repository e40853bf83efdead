// Levels of detail of a scene's meshes, made in the background and kept in a cache.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "scene/scene.hpp"
#include "scene/simplify.hpp"

namespace dioptre {

/// A level that became ready.
struct BuiltLevel {
    std::size_t mesh = 0, primitive = 0;
    int level = 1;  // 1 or more; level 0 is the primitive itself
    LodLevel data;
    bool cached = false;  // read, not made
};

struct LodOptions {
    std::filesystem::path folder = {};  // of the cache, made if it is missing; empty: none
    unsigned threads = 0;               // 0: as many as there are
    bool background = false;            // they let whatever else runs go first
};

/// Whether a primitive may have levels: enough triangles, no deformation. What bends is level 0 alone.
bool hasLods(const Primitive& primitive);

/// Where the program keeps them: lods/ in its cache folder; empty where there is none.
std::filesystem::path lodFolder();

/// Threads work on one primitive each, the largest first; equal primitives are made once. Files of the cache that are
/// broken are made anew, a cache that cannot be written is done without, each with one warning. Files of meshes that are
/// no longer there stay.
class LodBuilder {
  public:
    /// Starts at once. The scene must keep its vertices and indices until finished(), or longer than the builder.
    LodBuilder(const Scene& scene, const LodOptions& options);
    ~LodBuilder();  // gives up what is unfinished, soon: it asks itself every few thousand triangles
    LodBuilder(const LodBuilder&) = delete;
    LodBuilder& operator=(const LodBuilder&) = delete;

    /// What is ready since the last call, each primitive's levels in order, the finest first; does not wait.
    std::vector<BuiltLevel> take();
    /// Nothing more comes after the next take().
    bool finished() const;
    void wait() const;        // until finished()
    double progress() const;  // 0..1, by triangles

  private:
    class State;
    std::unique_ptr<State> state_;
};

/// All of them at once, or those there are once `stopped`; shows progress where it takes a while.
std::vector<BuiltLevel> buildLevels(
    const Scene& scene, const LodOptions& options, const std::function<bool()>& stopped = [] { return false; });

}  // namespace dioptre
