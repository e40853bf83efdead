// The light solver of bake.hpp.
#include "bake.hpp"

#include <algorithm>
#include <cmath>

#include "atlas.hpp"
#include "bvh.hpp"
#include "light_sources.hpp"

namespace studio {

namespace {

constexpr float kThroughLeaf = 0.5f;  // share of light that thin things show from either side

float maxComponent(const vec3& v) {
    return std::max({v.x, v.y, v.z});
}

/// One grid point and all that is known of it before light.
struct Probe {
    vec3 position, normal, albedo;
    float roughness = 0.5f;
    vec3 mirror{0.0f};  // reflectance at normal incidence
    bool thin = false, lit = false, valid = true;
};

class Solver {
  public:
    Solver(const Model& model, const BakeQuality& quality)
        : model_(model),
          quality_(quality),
          bvh_(model, [](const Object& o) { return o.indoors(); }),
          sources_{model, bvh_, quality} {
        prepare();
    }
    BakedLight run();

  private:
    struct Row {
        int object, patch, row;
    };
    void prepare();
    void direct(const Row& row);
    void gather(const Row& row);
    void reflect(const Row& row);
    void smooth(std::vector<vec3>& values, const LightGrid& grid, const std::vector<Probe>& probes, int passes) const;
    vec3 radiosity(const Hit& hit) const;
    vec3 highlights(const Probe& probe, const vec3& toEye, Rng& rng) const;
    std::vector<Probe>& probes(const Row& r) { return probes_[size(r.object)][size(r.patch)]; }
    LightGrid& grid(const Row& r) { return light_.grids[size(r.object)][size(r.patch)]; }
    static std::size_t size(int i) { return static_cast<std::size_t>(i); }
    std::uint32_t seedOf(const Row& r, int column, std::uint32_t salt) const {
        return hash(hash(static_cast<std::uint32_t>(r.object * 4096 + r.patch),
                         static_cast<std::uint32_t>(r.row * 8192 + column)),
                    salt);
    }

    const Model& model_;
    BakeQuality quality_;
    Bvh bvh_;
    LightSources sources_;
    BakedLight light_;
    std::vector<std::vector<std::vector<Probe>>> probes_;
    std::vector<std::vector<std::vector<vec3>>> next_;  // the bounce being gathered
    std::vector<Row> rows_;
};

void Solver::prepare() {
    light_.grids.resize(model_.objects.size());
    probes_.resize(model_.objects.size());
    next_.resize(model_.objects.size());
    for (std::size_t o = 0; o < model_.objects.size(); ++o) {
        const Object& object = model_.objects[o];
        light_.grids[o].resize(object.patches.size());
        probes_[o].resize(object.patches.size());
        next_[o].resize(object.patches.size());
        if (!object.indoors()) continue;
        for (std::size_t p = 0; p < object.patches.size(); ++p) {
            const Patch& patch = object.patches[p];
            if (patch.sharedChart >= 0) continue;
            LightGrid& g = light_.grids[o][p];
            const auto points = [&](int texels) {
                return std::max(2, static_cast<int>(std::lround(static_cast<float>(texels) / object.lightStep)) + 1);
            };
            g.width = points(patch.chartWidth);
            g.height = points(patch.chartHeight);
            const std::size_t count = size(g.width * g.height);
            g.irradiance.assign(count, vec3(0.0f));
            g.gloss.assign(count, vec3(0.0f));
            g.unexported.assign(object.finish == Finish::lit ? count : 0, vec3(0.0f));
            probes_[o][p].resize(count);
            next_[o][p].assign(count, vec3(0.0f));
            for (int j = 0; j < g.height; ++j) rows_.push_back({static_cast<int>(o), static_cast<int>(p), j});
        }
    }
    parallelFor(static_cast<int>(rows_.size()), [&](int r) {
        const Row row = rows_[size(r)];
        const Object& object = model_.objects[size(row.object)];
        const Patch& patch = object.patches[size(row.patch)];
        const LightGrid& g = grid(row);
        for (int i = 0; i < g.width; ++i) {
            // Points on the very edge would lie inside what the patch stands on.
            const auto inset = [](int k, int n) {
                const float x = static_cast<float>(k) / static_cast<float>(n - 1), e = 0.25f / static_cast<float>(n);
                return std::clamp(x, e, 1.0f - e);
            };
            const SurfacePoint s = surfacePoint(patch, {inset(i, g.width), inset(row.row, g.height)});
            const Coat coat = patch.paint(s);
            Probe& probe = probes(row)[size(row.row * g.width + i)];
            probe.position = s.position;
            probe.normal = s.normal;
            probe.thin = object.thin;
            probe.lit = object.finish == Finish::lit;
            probe.albedo = coat.albedo * (1.0f - 0.7f * coat.metallic);
            probe.roughness = probe.lit ? std::max(0.04f, coat.roughness * coat.roughness) : object.gloss.roughness;
            probe.mirror = probe.lit ? glm::mix(vec3(0.04f), coat.albedo, coat.metallic) : object.gloss.reflectance;
        }
    });
}

void Solver::direct(const Row& row) {
    LightGrid& g = grid(row);
    for (int i = 0; i < g.width; ++i) {
        const std::size_t k = size(row.row * g.width + i);
        const Probe& probe = probes(row)[k];
        Rng rng(seedOf(row, i, 1u));
        for (int side = 0; side < (probe.thin ? 2 : 1); ++side) {
            const vec3 n = side == 0 ? probe.normal : -probe.normal;
            const vec3 p = probe.position + n * kOffset;
            const float share = probe.thin ? kThroughLeaf : 1.0f;
            const vec3 sky = sources_.skyThroughWindows(p, n, rng);
            const vec3 sun = sources_.sunlight(p, n, rng), lamps = sources_.lamplight(p, n, rng, false);
            g.irradiance[k] += share * (sky + sun + lamps);
            if (probe.lit) g.unexported[k] += share * (sky + sources_.lamplight(p, n, rng, true));
        }
    }
}

vec3 Solver::radiosity(const Hit& hit) const {
    const Model& model = model_;
    const LightGrid& g = light_.of(model, hit.object, hit.patch);
    const Object& object = model.objects[size(hit.object)];
    if (hit.back && !object.thin) return vec3(0.0f);
    const Patch& patch = object.patches[size(hit.patch)];
    const int owner = patch.sharedChart >= 0 ? patch.sharedChart : hit.patch;
    const int i = std::min(static_cast<int>(hit.unit.x * static_cast<float>(g.width)), g.width - 1);
    const int j = std::min(static_cast<int>(hit.unit.y * static_cast<float>(g.height)), g.height - 1);
    const vec3 albedo = probes_[size(hit.object)][size(owner)][size(j * g.width + i)].albedo;
    return albedo * lookUp(g, g.irradiance, hit.unit) / kPi;
}

void Solver::gather(const Row& row) {
    const LightGrid& g = grid(row);
    const int across = std::max(2, static_cast<int>(std::sqrt(static_cast<float>(quality_.gatherRays)))),
              count = across * across;
    for (int i = 0; i < g.width; ++i) {
        const std::size_t k = size(row.row * g.width + i);
        Probe& probe = probes(row)[k];
        Rng rng(seedOf(row, i, 2u));
        vec3 sum(0.0f);
        int behind = 0;
        for (int side = 0; side < (probe.thin ? 2 : 1); ++side) {
            const vec3 n = side == 0 ? probe.normal : -probe.normal;
            const glm::mat3 frame = frameAround(n);
            for (int s = 0; s < count; ++s) {
                const float u = (static_cast<float>(s % across) + rng.next()) / static_cast<float>(across);
                const float v = (static_cast<float>(s / across) + rng.next()) / static_cast<float>(across);
                const float r = std::sqrt(u), a = 2.0f * kPi * v;
                const vec3 direction =
                    frame * vec3(r * std::cos(a), r * std::sin(a), std::sqrt(std::max(1e-4f, 1.0f - u)));
                const Hit hit = bvh_.nearest({probe.position + n * kOffset, direction});
                if (!hit.found()) continue;
                if (hit.back && !model_.objects[size(hit.object)].thin && hit.distance < 0.3f) ++behind;
                sum += (probe.thin ? kThroughLeaf : 1.0f) * radiosity(hit);
            }
        }
        // Points inside other things see their back faces; their light is taken from valid neighbours.
        probe.valid = behind * 3 < count;
        next_[size(row.object)][size(row.patch)][k] = sum * (kPi / static_cast<float>(count));
    }
}

vec3 Solver::highlights(const Probe& probe, const vec3& toEye, Rng& rng) const {
    // Walter et al. 2007: GGX with the Smith shadowing folded into an approximate visibility term.
    vec3 sum(0.0f);
    const auto add = [&](const vec3& toLight, const vec3& light) {
        const float nl = glm::dot(probe.normal, toLight), nv = std::max(0.05f, glm::dot(probe.normal, toEye));
        if (nl <= 0.0f) return;
        const vec3 h = glm::normalize(toLight + toEye);
        const float nh = glm::dot(probe.normal, h), a2 = probe.roughness * probe.roughness;
        const float q = nh * nh * (a2 - 1.0f) + 1.0f;
        const float d = a2 / (kPi * q * q);
        const float visibility = 0.5f / glm::mix(2.0f * nl * nv, nl + nv, probe.roughness);
        const vec3 fresnel = probe.mirror + (1.0f - probe.mirror) * std::pow(1.0f - glm::dot(h, toEye), 5.0f);
        sum += fresnel * light * (d * visibility * nl);
    };
    const vec3 p = probe.position + probe.normal * kOffset;
    for (const Lamp& lamp : model_.lamps) {
        const vec3 to = lamp.position - p;
        const float d2 = glm::dot(to, to);
        if (luminance(lamp.intensity) / d2 < 0.02f || bvh_.blocked({p, to, 0.98f})) continue;
        add(to / std::sqrt(d2), lamp.intensity / d2);
    }
    const vec3 sun =
        sources_.sunlight(p, probe.normal, rng) / std::max(0.05f, glm::dot(probe.normal, model_.daylight.toSun));
    if (maxComponent(sun) > 0.0f) add(model_.daylight.toSun, sun);
    return sum;
}

void Solver::reflect(const Row& row) {
    LightGrid& g = grid(row);
    const vec3 eye = model_.cameras.front().position;
    for (int i = 0; i < g.width; ++i) {
        const std::size_t k = size(row.row * g.width + i);
        const Probe& probe = probes(row)[k];
        const vec3 toEye = glm::normalize(eye - probe.position);
        if (maxComponent(probe.mirror) <= 0.0f || glm::dot(toEye, probe.normal) <= 0.02f) continue;
        Rng rng(seedOf(row, i, 3u));
        const glm::mat3 frame = frameAround(probe.normal);
        const vec3 p = probe.position + probe.normal * kOffset;
        vec3 sum(0.0f);
        for (int s = 0; s < quality_.glossRays; ++s) {
            // Sample the half vector by the GGX distribution of normals.
            const float u = (static_cast<float>(s) + rng.next()) / static_cast<float>(quality_.glossRays),
                        a = 2.0f * kPi * rng.next();
            const float cosine = std::sqrt((1.0f - u) / (1.0f + (probe.roughness * probe.roughness - 1.0f) * u));
            const float sine = std::sqrt(std::max(0.0f, 1.0f - cosine * cosine));
            const vec3 h = frame * vec3(sine * std::cos(a), sine * std::sin(a), cosine);
            const float vh = glm::dot(toEye, h);
            const vec3 direction = 2.0f * vh * h - toEye;
            if (vh <= 0.0f || glm::dot(direction, probe.normal) <= 0.0f) continue;
            const vec3 fresnel = probe.mirror + (1.0f - probe.mirror) * std::pow(1.0f - vh, 5.0f);
            const Hit hit = bvh_.nearest({p, direction});
            if (hit.found())
                sum += fresnel * radiosity(hit);
            else if (sources_.leavesByWindow(p, direction))
                sum += fresnel * model_.daylight.sky(direction);
        }
        g.gloss[k] = sum / static_cast<float>(quality_.glossRays);
        if (!probe.lit) g.gloss[k] += highlights(probe, toEye, rng);
    }
}

void Solver::smooth(std::vector<vec3>& values, const LightGrid& g, const std::vector<Probe>& probes, int passes) const {
    std::vector<float> weights(values.size(), 1.0f);
    for (std::size_t k = 0; k < values.size(); ++k) weights[k] = probes[k].valid ? 1.0f : 1e-3f;
    for (int pass = 0; pass < passes; ++pass) {
        for (int axis = 0; axis < 2; ++axis) {
            const std::vector<vec3> source = values;
            const std::vector<float> sourceWeights = weights;
            for (int j = 0; j < g.height; ++j) {
                for (int i = 0; i < g.width; ++i) {
                    vec3 sum(0.0f);
                    float total = 0.0f;
                    for (int d = -1; d <= 1; ++d) {
                        const int x = std::clamp(axis == 0 ? i + d : i, 0, g.width - 1),
                                  y = std::clamp(axis == 0 ? j : j + d, 0, g.height - 1);
                        const float w = (d == 0 ? 2.0f : 1.0f) * sourceWeights[size(y * g.width + x)];
                        sum += w * source[size(y * g.width + x)];
                        total += w;
                    }
                    values[size(j * g.width + i)] = sum / total;
                    weights[size(j * g.width + i)] = total / 4.0f;
                }
            }
        }
    }
}

BakedLight Solver::run() {
    const int count = static_cast<int>(rows_.size());
    parallelFor(count, [&](int r) { direct(rows_[size(r)]); });
    const std::vector<std::vector<LightGrid>> first = light_.grids;
    for (int bounce = 0; bounce < quality_.bounces; ++bounce) {
        parallelFor(count, [&](int r) { gather(rows_[size(r)]); });
        for (std::size_t o = 0; o < first.size(); ++o) {
            for (std::size_t p = 0; p < first[o].size(); ++p) {
                LightGrid& g = light_.grids[o][p];
                if (g.width == 0) continue;
                smooth(next_[o][p], g, probes_[o][p], 3);
                g.irradiance = first[o][p].irradiance;
                smooth(g.irradiance, g, probes_[o][p], 1);
                g.unexported = first[o][p].unexported;
                if (!g.unexported.empty()) smooth(g.unexported, g, probes_[o][p], 1);
                for (std::size_t k = 0; k < g.irradiance.size(); ++k) {
                    g.irradiance[k] += next_[o][p][k];
                    if (!g.unexported.empty()) g.unexported[k] += next_[o][p][k];
                }
            }
        }
    }
    parallelFor(count, [&](int r) { reflect(rows_[size(r)]); });
    for (std::size_t o = 0; o < first.size(); ++o) {
        for (std::size_t p = 0; p < first[o].size(); ++p) {
            LightGrid& g = light_.grids[o][p];
            if (g.width > 0) smooth(g.gloss, g, probes_[o][p], 1);
        }
    }
    return std::move(light_);
}

}  // namespace

vec3 lookUp(const LightGrid& g, const std::vector<vec3>& values, const vec2& unit) {
    if (values.empty()) return vec3(0.0f);
    const float x = std::clamp(unit.x, 0.0f, 1.0f) * static_cast<float>(g.width - 1);
    const float y = std::clamp(unit.y, 0.0f, 1.0f) * static_cast<float>(g.height - 1);
    const int i = std::min(static_cast<int>(x), g.width - 2), j = std::min(static_cast<int>(y), g.height - 2);
    const auto at = [&](int a, int b) { return values[static_cast<std::size_t>(b * g.width + a)]; };
    const float fx = x - static_cast<float>(i), fy = y - static_cast<float>(j);
    return glm::mix(glm::mix(at(i, j), at(i + 1, j), fx), glm::mix(at(i, j + 1), at(i + 1, j + 1), fx), fy);
}

const LightGrid& BakedLight::of(const Model& model, int object, int patch) const {
    const int owner =
        model.objects[static_cast<std::size_t>(object)].patches[static_cast<std::size_t>(patch)].sharedChart;
    return grids[static_cast<std::size_t>(object)][static_cast<std::size_t>(owner >= 0 ? owner : patch)];
}

BakedLight bakeLight(const Model& model, const BakeQuality& quality) {
    return Solver(model, quality).run();
}

}  // namespace studio
