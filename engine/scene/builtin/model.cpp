// Jobs of model.hpp, and the floor's shadows.
#include "scene/builtin/model.hpp"

#include <algorithm>

namespace dioptre::builtin {

namespace {

std::uint8_t encoded(float linear) {
    const float x = saturate(linear);
    const float s = x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1.0f / 2.4f) - 0.055f;
    return static_cast<std::uint8_t>(std::lround(255.0f * s));
}

void fill(TextureImage& image, const Paint& paint) {
    image.rgba.resize(static_cast<std::size_t>(image.width * image.height) * 4);
    std::size_t at = 0;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const vec3 c =
                paint((toFloat(x) + 0.5f) / toFloat(image.width), (toFloat(y) + 0.5f) / toFloat(image.height));
            for (int k = 0; k < 3; ++k) image.rgba[at++] = encoded(c[k]);
            image.rgba[at++] = 255;
        }
    }
}

/// A box filter of (2 radius + 1)^2, twice: near enough to a Gauss function.
void blur(std::vector<float>& values, int width, int height, int radius) {
    std::vector<float> line;
    const auto pass = [&](int count, int length, std::size_t step, std::size_t next) {
        line.resize(static_cast<std::size_t>(length));
        for (int k = 0; k < count; ++k) {
            float* first = values.data() + static_cast<std::size_t>(k) * next;
            float sum = 0.0f;
            const auto at = [&](int i) { return first[static_cast<std::size_t>(std::clamp(i, 0, length - 1)) * step]; };
            for (int i = -radius; i <= radius; ++i) sum += at(i);
            for (int i = 0; i < length; ++i) {
                line[static_cast<std::size_t>(i)] = sum / toFloat(2 * radius + 1);
                sum += at(i + radius + 1) - at(i - radius);
            }
            for (int i = 0; i < length; ++i)
                first[static_cast<std::size_t>(i) * step] = line[static_cast<std::size_t>(i)];
        }
    };
    const auto w = static_cast<std::size_t>(width);
    for (int twice = 0; twice < 2; ++twice) {
        pass(height, width, 1, w);
        pass(width, height, w, 1);
    }
}

}  // namespace

FloorShadow::FloorShadow(const Scene& scene, const std::vector<bool>& casts, const vec3& toLight, const vec2& low,
                         const vec2& high, float texel)
    : low_(low),
      texel_(texel),
      width_(static_cast<int>((high.x - low.x) / texel) + 1),
      height_(static_cast<int>((high.y - low.y) / texel) + 1) {
    const std::size_t count = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
    light_.assign(count, 1.0f);
    touch_.assign(count, 0.0f);
    const auto mark = [&](std::vector<float>& values, const vec2& xz, float value) {
        const vec2 t = (xz - low_) / texel_;
        if (t.x < 0.0f || t.y < 0.0f || t.x >= toFloat(width_) || t.y >= toFloat(height_)) return;
        values[static_cast<std::size_t>(t.y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(t.x)] =
            value;
    };
    // Enough points on every triangle that no texel is missed
    constexpr float kTouchHeight = 0.06f;
    for (std::size_t number = 0; number < scene.instances.size(); ++number) {
        if (!casts[number]) continue;
        const Instance& instance = scene.instances[number];
        for (const Primitive& primitive : scene.meshes[static_cast<std::size_t>(instance.mesh)].primitives) {
            std::vector<vec3> world;
            for (const Vertex& v : primitive.vertices) world.push_back(apply(instance.worldFromMesh, v.position));
            for (std::size_t i = 0; i < primitive.indices.size(); i += 3) {
                const vec3 a = world[primitive.indices[i]], b = world[primitive.indices[i + 1]],
                           c = world[primitive.indices[i + 2]];
                const float longest = std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
                const int steps = std::min(64, static_cast<int>(longest / texel) + 1);
                for (int s = 0; s <= steps; ++s) {
                    for (int t = 0; s + t <= steps; ++t) {
                        const vec3 p =
                            a + (b - a) * (toFloat(s) / toFloat(steps)) + (c - a) * (toFloat(t) / toFloat(steps));
                        if (p.y < 0.0f) continue;
                        const float far = p.y / toLight.y;
                        mark(light_, {p.x - far * toLight.x, p.z - far * toLight.z}, 0.0f);
                        if (p.y < kTouchHeight) mark(touch_, {p.x, p.z}, 1.0f);
                    }
                }
            }
        }
    }
    blur(light_, width_, height_, std::max(1, static_cast<int>(0.008f / texel)));
    blur(touch_, width_, height_, std::max(1, static_cast<int>(0.02f / texel)));
}

vec2 FloorShadow::at(const vec2& xz) const {
    const vec2 t = glm::clamp((xz - low_) / texel_ - 0.5f, vec2(0.0f), vec2(toFloat(width_ - 2), toFloat(height_ - 2)));
    const vec2 floor = glm::floor(t), f = t - floor;
    const auto first =
        static_cast<std::size_t>(floor.y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(floor.x);
    const auto read = [&](const std::vector<float>& values) {
        const float* p = values.data() + first;
        return glm::mix(glm::mix(p[0], p[1], f.x), glm::mix(p[width_], p[width_ + 1], f.x), f.y);
    };
    return {read(light_), read(touch_)};
}

int Model::picture(const std::string& name, int width, int height, Paint paint) {
    return latePicture(name, width, height, [paint = std::move(paint)](const Scene&) { return paint; });
}

int Model::latePicture(const std::string& name, int width, int height, std::function<Paint(const Scene&)> paint) {
    const auto number = scene_.images.size();
    const auto side = [&](int full) { return std::max(16, static_cast<int>(toFloat(full) * pictureScale_)); };
    scene_.images.push_back({name, side(width), side(height), {}});
    lateJobs_.push_back([this, number, paint = std::move(paint)] { fill(scene_.images[number], paint(scene_)); });
    return static_cast<int>(number);
}

int Model::material(const std::string& name, const vec3& color, float roughness, float metallic, int image) {
    Material material;
    material.name = name;
    material.baseColor = vec4(color, 1.0f);
    material.roughness = roughness;
    material.metallic = metallic;
    material.baseColorTexture.image = image;
    scene_.materials.push_back(std::move(material));
    return static_cast<int>(scene_.materials.size()) - 1;
}

int Model::glowing(const std::string& name, const vec3& radiance, int image) {
    const int number = material(name, vec3(0.0f), 0.5f);
    materialAt(number).emissive = radiance;
    materialAt(number).emissiveTexture.image = image;
    return number;
}

int Model::mesh(const std::string& name, std::vector<Part> parts) {
    const auto number = scene_.meshes.size();
    scene_.meshes.push_back({name, std::vector<Primitive>(parts.size())});
    for (std::size_t i = 0; i < parts.size(); ++i) {
        jobs_.push_back([this, number, i, part = std::move(parts[i])] {
            scene_.meshes[number].primitives[i] = toPrimitive(part.shape(), part.material);
        });
    }
    return static_cast<int>(number);
}

void Model::place(const std::string& name, int mesh, const mat4& worldFromMesh, bool castsShadow) {
    casts_.push_back(castsShadow);
    scene_.instances.push_back({name, mesh, worldFromMesh});
}

void Model::camera(const vec3& position, const vec3& target, float yfovDegrees) {
    scene_.cameras.push_back(
        {"main", glm::inverse(glm::lookAt(position, target, kY)), glm::radians(yfovDegrees), 0.05f});
}

Scene Model::make(const std::string& name, unsigned threads,
                  const std::function<void(std::size_t, std::size_t)>& done) {
    const std::size_t total = jobs_.size() + lateJobs_.size();
    const auto progress = [&](std::size_t before) {
        return [&done, before, total](std::size_t finished) {
            if (done) done(before + finished, total);
        };
    };
    runJobs(jobs_, threads, progress(0));
    runJobs(lateJobs_, threads, progress(jobs_.size()));
    scene_.name = name;
    for (const Instance& instance : scene_.instances)
        for (const Primitive& primitive : scene_.meshes[static_cast<std::size_t>(instance.mesh)].primitives)
            for (int corner = 0; corner < 8; ++corner)
                scene_.bounds.add(
                    apply(instance.worldFromMesh, {(corner & 1 ? primitive.bounds.max : primitive.bounds.min).x,
                                                   (corner & 2 ? primitive.bounds.max : primitive.bounds.min).y,
                                                   (corner & 4 ? primitive.bounds.max : primitive.bounds.min).z}));
    return std::move(scene_);
}

Light directional(const std::string& name, const vec3& toLight, const vec3& color) {
    Light light;
    light.name = name;
    light.kind = LightKind::directional;
    light.direction = -glm::normalize(toLight);
    light.color = color;
    return light;
}

Light pointLight(const std::string& name, const vec3& position, const vec3& color) {
    Light light;
    light.name = name;
    light.position = position;
    light.color = color;
    return light;
}

}  // namespace dioptre::builtin
