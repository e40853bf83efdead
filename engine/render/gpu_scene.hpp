// A scene in GPU memory, and the drawing of what a view can see of it.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "gl/program.hpp"
#include "optics/lens.hpp"
#include "optics/view.hpp"
#include "render/scene_upload.hpp"
#include "scene/scene.hpp"

namespace dioptre {

/// Vergences in dioptres; {0, 0, false} when nothing is seen.
struct VergenceRange {
    double nearest = 0.0, farthest = 0.0;
    bool anything = false;
};

class GpuScene {
  public:
    /// Matrices that one call can draw: 1 where the driver cannot choose a layer in the vertex stage.
    static int mostMatrices();

    /// Uploads geometry, materials and textures (mipmapped). Needs a current context.
    explicit GpuScene(const Scene& scene);

    /// Draws what `view` sees to the bound framebuffer: radiance × exposure and depth, or depth alone. The depth
    /// buffer must have been cleared to 0 (reversed depth).
    void drawRadiance(const View& view, float exposure) const;
    void drawDepth(const View& view) const;

    /// The same through points of a lens. Prepared once for all of them: what any point of `lens` can see, drawn by
    /// each call as often as it has matrices, matrix i to layer i of the bound layered framebuffer.
    void prepareThroughLens(const View& view, const Lens& lens, int matrices) const;
    /// Exactly as many matrices as prepared. `lodBias` is added to the level at which textures are read.
    void drawThroughLens(std::span<const glm::mat4> clipFromView, float exposure, float lodBias) const;

    /// Of what `view` sees: conservative, from bounding boxes, nearest bounded by the view's near plane.
    VergenceRange vergenceRange(const View& view) const;

    std::size_t bytes() const { return bytes_; }
    /// Triangles sent to the GL so far, counted once for each matrix.
    std::uint64_t trianglesDrawn() const { return trianglesDrawn_; }

  private:
    // One primitive of one instance.
    struct Item {
        std::uint32_t firstIndex = 0, indexCount = 0, baseVertex = 0;
        std::uint32_t material = 0;
        bool mirrored = false;  // negative determinant: front faces run clockwise
        glm::dmat4 worldFromMesh{1.0};
        Bounds bounds;
    };
    struct TextureBinding {
        const Texture* texture = nullptr;
        GLuint sampler = 0;
    };
    struct BoundMaterial {
        std::array<TextureBinding, 4> textures;  // base colour, metallic-roughness, normal, emissive
        bool lit = false, mask = false, doubleSided = false;
    };

    void uploadGeometry(const Scene& scene);
    void uploadMaterials(const Scene& scene);
    void prepare(const View& view, const Lens* lens, int matrices) const;
    void draw(std::span<const glm::mat4> clipFromView, float exposure, float lodBias, bool depthOnly) const;
    const Program& programFor(const BoundMaterial& material, bool depthOnly) const;

    std::vector<Item> items_;  // sorted by state
    std::vector<BoundMaterial> materials_;
    std::vector<Light> lights_;
    float skyRadiance_ = 0.0f;
    std::size_t bytes_ = 0;

    SceneTextures textures_;
    SceneSamplers samplers_;
    Buffer vertices_, indices_, drawIndices_, materialBuffer_;
    // What the last prepared view sees.
    struct Run {
        std::uint32_t material;
        bool mirrored;
        std::size_t firstCommand, commandCount;
    };
    mutable std::uint64_t triangles_ = 0, trianglesDrawn_ = 0;  // of one draw as prepared; of all draws
    mutable float lodBias_ = 0.0f;                              // that the samplers have
    mutable std::vector<Run> runs_;                             // commands of equal state
    mutable glm::vec3 up_{0.0f};                                // the world's up in view space
    mutable Buffer instances_, lightBuffer_, commands_;
    VertexArray vertexArray_;
    Program unlit_, unlitMask_, lit_, litMask_, depth_, depthMask_;
};

}  // namespace dioptre
