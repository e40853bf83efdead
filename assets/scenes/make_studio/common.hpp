// What every part of the studio generator shares: vector names, seeded random numbers, noise, colours, threads.
// Everything is a pure function of its seed, so the scene comes out the same at any thread count.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace studio {

using glm::mat4;
using glm::vec2;
using glm::vec3;
using glm::vec4;

inline constexpr float kPi = 3.14159265f;

/// O'Neill's PCG output permutation as a hash of 32 bits.
inline std::uint32_t hash(std::uint32_t x) {
    x = x * 747796405u + 2891336453u;
    const std::uint32_t word = ((x >> ((x >> 28u) + 4u)) ^ x) * 277803737u;
    return (word >> 22u) ^ word;
}
inline std::uint32_t hash(std::uint32_t a, std::uint32_t b) {
    return hash(a ^ hash(b + 0x9e3779b9u));
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
    /// An index in [0, count).
    int index(int count) { return static_cast<int>(next() * static_cast<float>(count)) % count; }

  private:
    std::uint32_t state_;
};

/// Linear colour of an sRGB hex triple such as 0xc0a080.
vec3 srgb(std::uint32_t hex);
/// sRGB transfer function, both ways, on [0, 1].
float encodeSrgb(float linear);
float decodeSrgb(float encoded);

inline float luminance(const vec3& c) {
    return glm::dot(c, vec3(0.2126f, 0.7152f, 0.0722f));
}
inline float fraction(float x) {
    return x - std::floor(x);
}

/// Value noise in [0, 1], period none; `fbm` sums octaves of halving amplitude and stays in [0, 1].
float noise(const vec3& p, std::uint32_t seed = 0);
float fbm(const vec3& p, int octaves, std::uint32_t seed = 0);

/// Cellular noise: distance to the nearest and the second nearest feature point, and the nearest cell's random id in
/// [0, 1].
struct Cell {
    float nearest, second, id;
};
Cell worley(const vec2& p, std::uint32_t seed = 0);

/// Calls body(i) for i in [0, count) from several threads; the bodies must not depend on each other's order.
void parallelFor(int count, const std::function<void(int)>& body);

/// An orthonormal frame with z = normal. Duff et al. 2017, "Building an Orthonormal Basis, Revisited".
glm::mat3 frameAround(const vec3& normal);

inline mat4 translation(const vec3& t) {
    return glm::translate(mat4(1.0f), t);
}
inline mat4 rotation(float degrees, const vec3& axis) {
    return glm::rotate(mat4(1.0f), glm::radians(degrees), axis);
}
inline mat4 scaling(const vec3& s) {
    return glm::scale(mat4(1.0f), s);
}
inline const vec3 kX{1, 0, 0}, kY{0, 1, 0}, kZ{0, 0, 1};

}  // namespace studio
