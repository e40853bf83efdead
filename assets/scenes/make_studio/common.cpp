// Noise, colour transfer and the thread loop of the studio generator.
#include "common.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>
#include <vector>

namespace studio {

float encodeSrgb(float linear) {
    const float x = std::clamp(linear, 0.0f, 1.0f);
    return x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1.0f / 2.4f) - 0.055f;
}

float decodeSrgb(float encoded) {
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

vec3 srgb(std::uint32_t hex) {
    const auto channel = [hex](int shift) { return decodeSrgb(static_cast<float>((hex >> shift) & 255u) / 255.0f); };
    return {channel(16), channel(8), channel(0)};
}

namespace {

float lattice(int x, int y, int z, std::uint32_t seed) {
    const auto u = [](int i) { return static_cast<std::uint32_t>(i); };
    return unitFloat(hash(u(x) * 0x8da6b343u ^ u(y) * 0xd8163841u ^ u(z) * 0xcb1ab31fu ^ seed * 0x165667b1u));
}

}  // namespace

float noise(const vec3& p, std::uint32_t seed) {
    const vec3 floor = glm::floor(p);
    vec3 t = p - floor;
    t = t * t * (3.0f - 2.0f * t);
    const int x = static_cast<int>(floor.x), y = static_cast<int>(floor.y), z = static_cast<int>(floor.z);
    const auto row = [&](int dy, int dz) {
        return glm::mix(lattice(x, y + dy, z + dz, seed), lattice(x + 1, y + dy, z + dz, seed), t.x);
    };
    return glm::mix(glm::mix(row(0, 0), row(1, 0), t.y), glm::mix(row(0, 1), row(1, 1), t.y), t.z);
}

float fbm(const vec3& p, int octaves, std::uint32_t seed) {
    float sum = 0.0f, weight = 0.5f, total = 0.0f;
    vec3 q = p;
    for (int i = 0; i < octaves; ++i) {
        sum += weight * noise(q, seed + static_cast<std::uint32_t>(i));
        total += weight;
        weight *= 0.5f;
        q = q * 2.03f + vec3(17.1f, 9.2f, 5.7f);  // not quite 2: octaves' lattices never coincide
    }
    return sum / total;
}

Cell worley(const vec2& p, std::uint32_t seed) {
    Cell cell{9.0f, 9.0f, 0.0f};
    const vec2 base = glm::floor(p);
    for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
            const int x = static_cast<int>(base.x) + dx, y = static_cast<int>(base.y) + dy;
            const vec2 feature(static_cast<float>(x) + lattice(x, y, 1, seed),
                               static_cast<float>(y) + lattice(x, y, 2, seed));
            const float d = glm::distance(p, feature);
            if (d < cell.nearest) {
                cell.second = cell.nearest;
                cell.nearest = d;
                cell.id = lattice(x, y, 3, seed);
            } else {
                cell.second = std::min(cell.second, d);
            }
        }
    }
    return cell;
}

void parallelFor(int count, const std::function<void(int)>& body) {
    std::atomic<int> next{0};
    const auto work = [&] {
        for (int i = next++; i < count; i = next++) body(i);
    };
    std::vector<std::thread> threads;
    for (unsigned t = 1; t < std::max(1u, std::thread::hardware_concurrency()); ++t) threads.emplace_back(work);
    work();
    for (std::thread& thread : threads) thread.join();
}

glm::mat3 frameAround(const vec3& n) {
    const float sign = std::copysign(1.0f, n.z);
    const float a = -1.0f / (sign + n.z), b = n.x * n.y * a;
    return {vec3(1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x), vec3(b, sign + n.y * n.y * a, -n.y), n};
}

}  // namespace studio
