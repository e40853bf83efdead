// What every part of the built-in scenes' generator shares: vector names, seeded random numbers, noise, colours, jobs.
// Everything is a pure function of its seed, so a scene comes out the same, to the byte, at any number of threads.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <vector>

namespace dioptre::builtin {

using glm::mat4;
using glm::vec2;
using glm::vec3;
using glm::vec4;

inline constexpr float kPi = 3.14159265f;
inline const vec3 kX{1, 0, 0}, kY{0, 1, 0}, kZ{0, 0, 1};

inline float toFloat(int i) {
    return static_cast<float>(i);
}

/// O'Neill's PCG output permutation as a hash of 32 bits.
inline std::uint32_t hash(std::uint32_t x) {
    x = x * 747796405u + 2891336453u;
    const std::uint32_t word = ((x >> ((x >> 28u) + 4u)) ^ x) * 277803737u;
    return (word >> 22u) ^ word;
}
inline float unitFloat(std::uint32_t h) {
    return static_cast<float>(h >> 8u) * (1.0f / 16777216.0f);
}

/// A stream of random numbers; equal seeds give equal streams.
class Rng {
  public:
    explicit Rng(std::uint32_t seed) : state_(hash(seed)) {}
    float next() {
        state_ = state_ * 747796405u + 2891336453u;
        return unitFloat(hash(state_));
    }
    float range(float low, float high) { return low + (high - low) * next(); }

  private:
    std::uint32_t state_;
};

/// Linear colour of an sRGB hex triple such as 0xc0a080.
vec3 srgb(std::uint32_t hex);

inline float fraction(float x) {
    return x - std::floor(x);
}
inline float saturate(float x) {
    return glm::clamp(x, 0.0f, 1.0f);
}
/// 1 inside, 0 outside of a stroke or spot, over a soft edge: `distance` below `radius`.
inline float spot(float distance, float radius, float softness) {
    return 1.0f - glm::smoothstep(radius - softness, radius + softness, distance);
}

/// Value noise in [0, 1]; `fbm` sums octaves of halving amplitude and stays in [0, 1].
float noise(const vec3& p, std::uint32_t seed = 0);
float fbm(const vec3& p, int octaves, std::uint32_t seed = 0);
/// Value noise on the unit square that repeats at its edges, `cells` along each side.
float tiledNoise(const vec2& p, int cells, std::uint32_t seed = 0);

/// Cellular noise: distances to the nearest and the second nearest feature point, the nearest one's random id in
/// [0, 1]. `period` > 0: repeats after so many cells.
struct Cell {
    float nearest, second, id;
};
Cell worley(const vec2& p, std::uint32_t seed = 0, int period = 0);

inline mat4 translation(const vec3& t) {
    return glm::translate(mat4(1.0f), t);
}
inline mat4 rotation(float degrees, const vec3& axis) {
    return glm::rotate(mat4(1.0f), glm::radians(degrees), axis);
}
inline mat4 scaling(const vec3& s) {
    return glm::scale(mat4(1.0f), s);
}
inline mat4 scaling(float s) {
    return scaling(vec3(s));
}
inline vec3 apply(const mat4& m, const vec3& p) {
    return vec3(m * vec4(p, 1.0f));
}

/// Runs every job once, on `threads` threads; none may depend on another. `done` is called with the number of finished
/// jobs, one call at a time.
void runJobs(const std::vector<std::function<void()>>& jobs, unsigned threads,
             const std::function<void(std::size_t)>& done);

}  // namespace dioptre::builtin
