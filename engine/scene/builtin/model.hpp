// A built-in scene while it is being made: pictures, materials and meshes as jobs, and where things stand.
#pragma once

#include <string>
#include <utility>

#include "scene/builtin/shape.hpp"

namespace dioptre::builtin {

/// A linear colour for a place in a picture, u right and v down in [0, 1].
using Paint = std::function<vec3(float u, float v)>;

/// How much light from the key light reaches each place of the floor y = 0; made once everything stands.
class FloorShadow {
  public:
    /// `toLight` need not be unit; texels of `texel` metres between `low` and `high` (x, z).
    /// `casts` says it of each instance.
    FloorShadow(const Scene& scene, const std::vector<bool>& casts, const vec3& toLight, const vec2& low,
                const vec2& high, float texel);
    /// 1 in full light, 0 in full shadow; then the nearness of something above, 1: touching.
    vec2 at(const vec2& xz) const;

  private:
    vec2 low_;
    float texel_;
    int width_, height_;
    std::vector<float> light_, touch_;
};

class Model {
  public:
    /// `pictureScale` in (0, 1]: of the sides of all pictures.
    Model(const Detail& detail, float pictureScale) : detail(detail), pictureScale_(pictureScale) {}

    const Detail detail;
    float pictureScale() const { return pictureScale_; }

    /// A picture to be painted; the number of the image.
    int picture(const std::string& name, int width, int height, Paint paint);
    /// A picture that waits for everything to stand: the floor with its shadows.
    int latePicture(const std::string& name, int width, int height, std::function<Paint(const Scene&)> paint);
    /// `image` -1: colour alone, otherwise colour times picture.
    int material(const std::string& name, const vec3& color, float roughness, float metallic = 0.0f, int image = -1);
    /// Emits `radiance`, times the picture if there is one.
    int glowing(const std::string& name, const vec3& radiance, int image = -1);
    Material& materialAt(int material) { return scene_.materials[static_cast<std::size_t>(material)]; }

    struct Part {
        int material;
        std::function<Shape()> shape;
    };
    int mesh(const std::string& name, std::vector<Part> parts);
    void place(const std::string& name, int mesh, const mat4& worldFromMesh, bool castsShadow = true);
    const std::vector<bool>& casts() const { return casts_; }

    void camera(const vec3& position, const vec3& target, float yfovDegrees = 45.0f);
    void light(Light light) { scene_.lights.push_back(std::move(light)); }

    /// Does all jobs.
    Scene make(const std::string& name, unsigned threads, const std::function<void(std::size_t, std::size_t)>& done);

  private:
    float pictureScale_;
    Scene scene_;
    std::vector<bool> casts_;  // of each instance
    std::vector<std::function<void()>> jobs_, lateJobs_;
};

Light directional(const std::string& name, const vec3& toLight, const vec3& color);
Light pointLight(const std::string& name, const vec3& position, const vec3& color);

/// The scenes; each in files of its name.
void makeToys(Model& model);
void makeFishes(Model& model);
void makeDragons(Model& model);

}  // namespace dioptre::builtin
