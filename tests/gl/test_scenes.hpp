// Small scenes built in memory for the GL tests. The viewer stands at the origin and looks along -z.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <utility>
#include <vector>

#include "optics/lens.hpp"
#include "optics/view.hpp"
#include "scene/scene.hpp"

namespace dioptre::test {

/// yfov 0.6 rad: 144 rows have 233 px per unit tangent.
inline View testView(int width = 192, int height = 144, double near = 0.05) {
    View view;
    view.frustum = symmetricFrustum(Radians(0.6), static_cast<double>(width) / height);
    view.near = Metres(near);
    view.width = width;
    view.height = height;
    return view;
}

/// The world point `distance` ahead that the view draws at a place in pixels from the top left.
inline glm::dvec3 worldAt(const View& view, glm::dvec2 pixel, double distance) {
    const Frustum& f = view.frustum;
    const glm::dvec3 ray(f.left + (f.right - f.left) * pixel.x / view.width,
                         f.top - (f.top - f.bottom) * pixel.y / view.height, -1.0);
    return view.pose.position + view.pose.orientation * (ray * distance);
}

/// A lens focused at `focus` that blurs `object` to a CoC of that RADIUS in the view's pixels.
inline Lens lensFor(const View& view, double radiusPixels, double focus, double object) {
    const double perMetre = focalLengthPixels(view).x * std::abs(focus - object);
    return {Metres(radiusPixels / perMetre), Metres(0.01667), Dioptres(focus)};
}

/// A rectangle of pixels, from the top left.
struct PixelRect {
    double x0 = 0.0, y0 = 0.0, x1 = 0.0, y1 = 0.0;

    /// How far outside a pixel's centre lies, 0 inside.
    double distance(int x, int y) const {
        const double dx = std::max({x0 - (x + 0.5), x + 0.5 - x1, 0.0});
        const double dy = std::max({y0 - (y + 0.5), y + 0.5 - y1, 0.0});
        return std::hypot(dx, dy);
    }
};

class SceneBuilder {
  public:
    int material(const Material& material) {
        scene_.materials.push_back(material);
        return static_cast<int>(scene_.materials.size()) - 1;
    }
    /// The radiance as it is, beyond 1 too; seen from both sides.
    int unlit(glm::vec3 radiance) {
        Material m;
        m.unlit = true;
        m.doubleSided = true;
        m.baseColor = glm::vec4(radiance, 1.0f);
        return material(m);
    }
    int textured(TextureImage image, Sampler sampler = {}) {
        scene_.images.push_back(std::move(image));
        Material m;
        m.unlit = true;
        m.doubleSided = true;
        m.baseColorTexture = {static_cast<int>(scene_.images.size()) - 1, sampler};
        return material(m);
    }

    /// Corners counter-clockwise as seen from the front, from the lower left; uv runs from 0,0 at the UPPER left to
    /// `repeat` at the lower right.
    SceneBuilder& quad(const std::array<glm::dvec3, 4>& corners, int material, double repeat = 1.0) {
        const glm::dvec3 right = glm::normalize(corners[1] - corners[0]);
        const glm::dvec3 up = glm::normalize(corners[3] - corners[0]);
        const double u[] = {0.0, repeat, repeat, 0.0}, v[] = {repeat, repeat, 0.0, 0.0};
        Primitive p;
        for (std::size_t i = 0; i < 4; ++i) {
            Vertex vertex;
            vertex.position = glm::vec3(corners[i]);
            vertex.normal = glm::vec3(glm::normalize(glm::cross(right, up)));
            vertex.tangent = glm::vec4(glm::vec3(right), 1.0f);  // glTF: the bitangent is the image's up, -v
            vertex.uv = glm::vec2(u[i], v[i]);
            p.vertices.push_back(vertex);
        }
        p.indices = {0, 1, 2, 0, 2, 3};
        return add(std::move(p), material);
    }
    /// Square to the viewer; size in metres.
    SceneBuilder& quad(glm::dvec3 centre, glm::dvec2 size, int material, double repeat = 1.0) {
        const glm::dvec3 x(0.5 * size.x, 0.0, 0.0), y(0.0, 0.5 * size.y, 0.0);
        return quad({centre - x - y, centre + x - y, centre + x + y, centre - x + y}, material, repeat);
    }
    /// What covers these pixels of the view at that distance.
    SceneBuilder& quad(const View& view, const PixelRect& r, double distance, int material, double repeat = 1.0) {
        return quad({worldAt(view, {r.x0, r.y1}, distance), worldAt(view, {r.x1, r.y1}, distance),
                     worldAt(view, {r.x1, r.y0}, distance), worldAt(view, {r.x0, r.y0}, distance)},
                    material, repeat);
    }
    /// Fills every view up to a field of 150 degrees.
    SceneBuilder& wall(double distance, int material, double repeat = 1.0) {
        return quad(glm::dvec3(0.0, 0.0, -distance), glm::dvec2(8.0 * distance), material, repeat);
    }
    SceneBuilder& box(glm::dvec3 low, glm::dvec3 high, int material) {
        for (int axis = 0; axis < 3; ++axis)
            for (const bool far : {false, true}) {
                const int a = (axis + 1) % 3, b = (axis + 2) % 3;
                glm::dvec3 o = low, x(0.0), y(0.0);
                x[a] = high[a] - low[a];
                y[b] = high[b] - low[b];
                if (far) o[axis] = high[axis];
                if (!far) std::swap(x, y);  // faces look outwards
                quad({o, o + x, o + x + y, o + y}, material);
            }
        return *this;
    }
    SceneBuilder& sphere(glm::dvec3 centre, double radius, int material) {
        constexpr int kRows = 16, kColumns = 32;
        Primitive p;
        for (int row = 0; row <= kRows; ++row)
            for (int column = 0; column <= kColumns; ++column) {
                const double a = std::numbers::pi * row / kRows, b = 2.0 * std::numbers::pi * column / kColumns;
                const glm::dvec3 n(std::sin(a) * std::sin(b), std::cos(a), std::sin(a) * std::cos(b));
                Vertex vertex;
                vertex.position = glm::vec3(centre + n * radius);
                vertex.normal = glm::vec3(n);
                vertex.uv = glm::vec2(static_cast<float>(column) / kColumns, static_cast<float>(row) / kRows);
                p.vertices.push_back(vertex);
            }
        for (std::uint32_t row = 0; row < kRows; ++row)
            for (std::uint32_t column = 0; column < kColumns; ++column) {
                const std::uint32_t i = row * (kColumns + 1) + column, below = i + kColumns + 1;
                p.indices.insert(p.indices.end(), {i, below, i + 1, i + 1, below, below + 1});
            }
        return add(std::move(p), material);
    }
    /// Everything so far, `scale` times as large, around the viewer.
    SceneBuilder& scaled(double scale) {
        for (Instance& instance : scene_.instances)
            instance.worldFromMesh = glm::scale(glm::mat4(1.0f), glm::vec3(static_cast<float>(scale)));
        return *this;
    }
    /// The last thing added, placed by a matrix.
    SceneBuilder& placed(const glm::dmat4& worldFromMesh) {
        scene_.instances.back().worldFromMesh = glm::mat4(worldFromMesh);
        return *this;
    }
    SceneBuilder& light(const Light& light) {
        scene_.lights.push_back(light);
        return *this;
    }
    /// A camera where testView() stands.
    SceneBuilder& camera() {
        Camera camera;
        camera.yfovRadians = 0.6f;
        camera.nearMetres = 0.05f;
        scene_.cameras.push_back(camera);
        return *this;
    }

    Scene scene() const {
        Scene scene = scene_;
        for (const Instance& instance : scene.instances)
            for (const Primitive& p : scene.meshes[static_cast<std::size_t>(instance.mesh)].primitives)
                for (const Vertex& v : p.vertices)
                    scene.bounds.add(glm::vec3(instance.worldFromMesh * glm::vec4(v.position, 1.0f)));
        return scene;
    }

  private:
    SceneBuilder& add(Primitive p, int material) {
        p.material = material;
        for (const Vertex& v : p.vertices) p.bounds.add(v.position);
        scene_.meshes.push_back({"", {std::move(p)}});
        scene_.instances.push_back({"", static_cast<int>(scene_.meshes.size()) - 1, glm::mat4(1.0f)});
        return *this;
    }

    Scene scene_;
};

using Texel = std::array<std::uint8_t, 4>;

/// `cells` squares in each direction, the upper left one of colour `a`.
inline TextureImage checkerImage(int cells, Texel a = {255, 255, 255, 255}, Texel b = {0, 0, 0, 255},
                                 int texelsPerCell = 8) {
    TextureImage image{"checker", cells * texelsPerCell, cells * texelsPerCell, {}};
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const Texel& t = (x / texelsPerCell + y / texelsPerCell) % 2 == 0 ? a : b;
            image.rgba.insert(image.rgba.end(), t.begin(), t.end());
        }
    return image;
}

}  // namespace dioptre::test
