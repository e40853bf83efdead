// Noise, colour and the thread loop of the built-in scenes' generator.
#include "scene/builtin/common.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>

namespace dioptre::builtin {

namespace {

float decodeSrgb(float encoded) {
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

float lattice(int x, int y, int z, std::uint32_t seed) {
    const auto u = [](int i) { return static_cast<std::uint32_t>(i); };
    return unitFloat(hash(u(x) * 0x8da6b343u ^ u(y) * 0xd8163841u ^ u(z) * 0xcb1ab31fu ^ seed * 0x165667b1u));
}

int wrapped(int i, int period) {
    return period > 0 ? ((i % period) + period) % period : i;
}

}  // namespace

vec3 srgb(std::uint32_t hex) {
    const auto channel = [hex](int shift) { return decodeSrgb(static_cast<float>((hex >> shift) & 255u) / 255.0f); };
    return {channel(16), channel(8), channel(0)};
}

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

float tiledNoise(const vec2& p, int cells, std::uint32_t seed) {
    const vec2 scaled = p * toFloat(cells), floor = glm::floor(scaled);
    vec2 t = scaled - floor;
    t = t * t * (3.0f - 2.0f * t);
    const int x = static_cast<int>(floor.x), y = static_cast<int>(floor.y);
    const auto at = [&](int i, int j) { return lattice(wrapped(i, cells), wrapped(j, cells), 0, seed); };
    return glm::mix(glm::mix(at(x, y), at(x + 1, y), t.x), glm::mix(at(x, y + 1), at(x + 1, y + 1), t.x), t.y);
}

Cell worley(const vec2& p, std::uint32_t seed, int period) {
    Cell cell{9.0f, 9.0f, 0.0f};
    const vec2 base = glm::floor(p);
    for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
            const int x = static_cast<int>(base.x) + dx, y = static_cast<int>(base.y) + dy;
            const int i = wrapped(x, period), j = wrapped(y, period);
            const vec2 feature(toFloat(x) + lattice(i, j, 1, seed), toFloat(y) + lattice(i, j, 2, seed));
            const float d = glm::distance(p, feature);
            if (d < cell.nearest) {
                cell.second = cell.nearest;
                cell.nearest = d;
                cell.id = lattice(i, j, 3, seed);
            } else {
                cell.second = std::min(cell.second, d);
            }
        }
    }
    return cell;
}

void runJobs(const std::vector<std::function<void()>>& jobs, unsigned threads,
             const std::function<void(std::size_t)>& done) {
    std::atomic<std::size_t> next{0};
    std::mutex mutex;
    std::size_t finished = 0;
    std::exception_ptr failure;
    const auto work = [&] {
        for (std::size_t i = next++; i < jobs.size(); i = next++) {
            try {
                jobs[i]();
                const std::lock_guard lock(mutex);
                if (++finished, done) done(finished);
            } catch (...) {
                const std::lock_guard lock(mutex);
                failure = std::current_exception();
                next = jobs.size();
            }
        }
    };
    std::vector<std::thread> others;
    for (unsigned t = 1; t < threads; ++t) others.emplace_back(work);
    work();
    for (std::thread& thread : others) thread.join();
    if (failure) std::rethrow_exception(failure);
}

}  // namespace dioptre::builtin
