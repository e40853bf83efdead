// Conformance models, drawn and asked for what their README says. They stand in the plane z = 0, mostly the square from
// -0.5 to 0.5, and are seen from the front.
#pragma once

#include <cmath>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "gl/gl_fixture.hpp"
#include "gl/pictures.hpp"
#include "scene/gltf_loader.hpp"

namespace dioptre::test {

/// The folder given on the command line.
inline std::filesystem::path& modelsFolder() {
    static std::filesystem::path folder;
    return folder;
}
inline std::filesystem::path assetGenerator() {
    return modelsFolder() / "gltf-asset-generator";
}

/// "Material_03" as it is.
inline Scene loadModel(const std::string& name) {
    return loadGltf(assetGenerator() / name.substr(0, name.rfind('_')) / (name + ".gltf"));
}

/// Without light and shade: what is seen is base colour × vertex colour.
inline Scene unlit(Scene scene) {
    for (Material& material : scene.materials) material.unlit = true;
    return scene;
}

/// Under the sky alone, or with a lamp of so many lux besides that shines along `direction`.
inline Scene underSky(Scene scene, float lux = 0.0f, glm::vec3 direction = {0.0f, 0.0f, -1.0f}) {
    Light light;
    light.kind = LightKind::directional;
    light.color = glm::vec3(lux);
    light.direction = glm::normalize(direction);
    scene.lights = {light};
    return scene;
}

/// A white wall behind everything.
inline Scene onWhite(Scene scene) {
    SceneBuilder b;
    b.quad(glm::dvec3(0.0, 0.0, -3.0), glm::dvec2(20.0), b.unlit(glm::vec3(1.0f)));
    const Scene wall = b.scene();
    Mesh mesh = wall.meshes[0];
    mesh.primitives[0].material = static_cast<int>(scene.materials.size());
    scene.materials.push_back(wall.materials[0]);
    scene.instances.push_back({"wall", static_cast<int>(scene.meshes.size()), glm::mat4(1.0f)});
    scene.meshes.push_back(std::move(mesh));
    return scene;
}

inline constexpr int kSide = 300;

/// From so far before the plane; the picture is `width` metres wide there.
inline View frontView(double width = 1.5, double distance = 2.0) {
    View view;
    const double tangent = 0.5 * width / distance;
    view.frustum = {-tangent, tangent, -tangent, tangent};
    view.pose.position = {0.0, 0.0, distance};
    view.near = Metres(0.05);
    view.width = view.height = kSide;
    return view;
}

inline Image drawModel(const Scene& scene, const View& view = frontView()) {
    Shot shot;
    shot.view = view;
    return draw(TechniqueChoice::pinhole, GpuScene(scene), shot);
}

/// A place in the plane as frontView() shows it: kPatch × kPatch pixels around it are what is compared.
inline constexpr double kPixelsPerMetre = kSide / 1.5;
inline constexpr int kPatch = 7;
inline constexpr double kPatchSize = kPatch / kPixelsPerMetre;

inline int pixelOf(double metres) {
    return static_cast<int>(std::floor(kSide / 2.0 + metres * kPixelsPerMetre));
}

inline glm::dvec3 seenAt(const Image& image, glm::dvec2 at) {
    const int x = pixelOf(at.x), y = pixelOf(-at.y), reach = kPatch / 2;
    return meanColor(image, x - reach, y - reach, x + reach + 1, y + reach + 1);
}

/// Texture coordinates of the models' planes: 0,0 is the upper left corner.
inline glm::dvec2 uvAt(glm::dvec2 at) {
    return {0.5 + at.x, 0.5 - at.y};
}

/// Mean of the texels in a square around uv, `size` of the image wide; colour decoded from sRGB, opacity as it is.
inline glm::dvec4 texels(const TextureImage& image, glm::dvec2 uv, double size = kPatchSize, bool srgb = true) {
    glm::dvec4 sum(0.0);
    const int reach = std::max(0, static_cast<int>(size * image.width / 2.0));
    const int cx = static_cast<int>(std::floor(uv.x * image.width)),
              cy = static_cast<int>(std::floor(uv.y * image.height));
    for (int y = cy - reach; y <= cy + reach; ++y)
        for (int x = cx - reach; x <= cx + reach; ++x) {
            const auto wrap = [](int i, int n) { return ((i % n) + n) % n; };
            const auto at = static_cast<std::size_t>(wrap(y, image.height) * image.width + wrap(x, image.width)) * 4;
            for (int c = 0; c < 4; ++c) {
                const double value = image.rgba[at + static_cast<std::size_t>(c)] / 255.0;
                sum[c] += srgb && c < 3 ? linearFromSrgb(value) : value;
            }
        }
    return sum / std::pow(2.0 * reach + 1.0, 2.0);
}

/// Asks at points all over the square; `wanted` may have no opinion about a point.
inline void expectPlane(const std::function<glm::dvec3(glm::dvec2)>& seen,
                        const std::function<std::optional<glm::dvec3>(glm::dvec2)>& wanted, double tolerance) {
    int asked = 0;
    constexpr int kStep = 15;
    for (int py = pixelOf(-0.5) + 8; py < pixelOf(0.5) - 7; py += kStep)
        for (int px = pixelOf(-0.5) + 8; px < pixelOf(0.5) - 7; px += kStep) {
            const glm::dvec2 at = glm::dvec2(px + 0.5 - kSide / 2.0, kSide / 2.0 - py - 0.5) / kPixelsPerMetre;
            const auto color = wanted(at);
            if (!color) continue;
            ++asked;
            const glm::dvec3 found = seen(at);
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(found[c], (*color)[c], tolerance) << "at " << at.x << ", " << at.y << ", channel " << c;
        }
    EXPECT_GE(asked, 20);
}
inline void expectPlane(const Image& picture, const std::function<std::optional<glm::dvec3>(glm::dvec2)>& wanted,
                        double tolerance) {
    expectPlane([&](glm::dvec2 at) { return seenAt(picture, at); }, wanted, tolerance);
}

inline void expectSame(const Image& a, const Image& b, const std::string& what) {
    const Worst worst = worstDifference(a, b);
    EXPECT_EQ(worst.linear, 0.0) << what << ": " << worst;
}

inline int pixelsDrawn(const Image& image) {
    int count = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) count += pixelAt(image, x, y) != glm::dvec3(0.0);
    return count;
}

inline int pixelsDiffering(const Image& a, const Image& b) {
    int count = 0;
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x) count += pixelAt(a, x, y) != pixelAt(b, x, y);
    return count;
}

/// A model's number in its folder: 7 of "Material_07".
inline int numberOf(const std::string& name) {
    return std::stoi(name.substr(name.size() - 2));
}

}  // namespace dioptre::test
