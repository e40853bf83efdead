// A scene in GPU memory, and the drawing of what a view can see of it.
//
// Triangles, lines of 1 px and points of 1 px (glTF 2.0, 3.9.5): their energy is that of a pixel however far they are,
// so they neither vanish with distance nor outshine in a blur; without normals they are not lit.
//
// What is alpha-blended (Material::alphaMode) comes last, over what is opaque and without writing depth: primitive by
// primitive, the farthest centre first by depth along the view, equal ones as in the scene; of a double-sided one its
// back before its front. Within a primitive triangles keep the scene's order. Texels that are opaque all the same
// (scene/base_color.glsl) are drawn with what is opaque, so that surfaces of blended material hide each other
// wherever they can. Every point of the lens sees the same depths along the view, so one order serves them all.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "gl/pass.hpp"
#include "gl/program.hpp"
#include "optics/lens.hpp"
#include "optics/view.hpp"
#include "render/deformer.hpp"
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

    /// Uploads geometry, materials and textures (mipmapped). Needs a current context. A scene that moves is posed as at
    /// time 0.
    explicit GpuScene(const Scene& scene);

    /// Moves what hangs from nodes, bends what is skinned or morphed: once for all drawings that follow. `pose` is one
    /// of the scene's motion. Nothing is done where it is the pose before.
    void pose(const MotionPose& pose, PassLog& log);
    /// Another number with each other pose.
    std::uint64_t poseNumber() const { return poseNumber_; }

    /// Draws what `view` sees to the bound framebuffer: radiance × exposure and depth, or depth alone. The depth
    /// buffer must have been cleared to 0 (reversed depth). The depth left is that of the surface which gives the pixel
    /// most of its light: of a blended one where its alpha is 0.5 or more.
    void drawRadiance(const View& view, float exposure) const;
    void drawDepth(const View& view) const;

    /// The same through points of a lens. Prepared once for all of them: what any point of `lens` can see, drawn by
    /// each call as often as it has matrices, matrix i to layer i of the bound layered framebuffer.
    void prepareThroughLens(const View& view, const Lens& lens, int matrices) const;
    /// Exactly as many matrices as prepared. `lodBias` is added to the level at which textures are read. Depth is left
    /// by opaque surfaces only.
    void drawThroughLens(std::span<const glm::mat4> clipFromView, float exposure, float lodBias) const;

    /// Of what `view` sees: conservative, from the pose's bounding boxes, nearest bounded by the view's near plane.
    VergenceRange vergenceRange(const View& view) const;

    std::size_t bytes() const { return bytes_; }
    /// Triangles sent to the GL so far, counted once for each matrix.
    std::uint64_t trianglesDrawn() const { return trianglesDrawn_; }

  private:
    // What one call can draw with; in the order that changes least.
    struct State {
        bool blended = false;
        std::uint32_t material = 0;
        bool mirrored = false;  // negative determinant: front faces run clockwise
        bool extras = false;
        bool lit = true;
        Topology topology = Topology::triangles;

        auto operator<=>(const State&) const = default;
    };
    // One primitive of one instance.
    struct Item {
        State state;
        PrimitiveRange range;
        glm::dmat4 worldFromMesh{1.0};
        Bounds bounds;
        int node = -1;  // of the motion; -1: stands still
        int bent = -1;  // the deformer's number; -1: rigid
    };
    struct TextureBinding {
        const Texture* texture = nullptr;
        GLuint sampler = 0;
    };
    struct BoundMaterial {
        std::array<TextureBinding, gpu::kMaterialTextures> textures;
        AlphaMode alphaMode = AlphaMode::opaque;
        bool lit = false, doubleSided = false;
        bool mapped = false;  // a texture is not read at the vertex's first coordinates
        bool occluded = false;
    };
    // What is drawn of a surface; `blended`: what the others see through it.
    enum class Phase { surface, blended, depth };
    enum class Faces { asMaterial, back, front };
    // Commands of equal state.
    struct Run {
        State state;
        Faces faces = Faces::asMaterial;
        std::size_t firstCommand = 0, commandCount = 0;
        std::uint64_t triangles = 0;
    };
    struct Through {
        std::span<const glm::mat4> clipFromView;
        float exposure = 1.0f;
    };
    struct Preparation;

    void uploadGeometry(const Scene& scene);
    void uploadMaterials(const Scene& scene);
    void applyPose();
    void makePrograms();
    unsigned featuresOf(const State& state, Phase phase) const;
    void prepare(const View& view, const Lens* lens, int matrices) const;
    void append(Preparation& preparation, std::vector<Run>& runs, std::size_t item, Faces faces) const;
    void setLodBias(float bias) const;
    void drawBlended(const Through& through) const;
    void drawRuns(std::span<const Run> runs, Phase phase, const Through& through) const;
    void bind(const Run& run) const;

    std::vector<Item> items_;  // sorted by state
    std::size_t blendedItems_ = 0;
    std::vector<BoundMaterial> materials_;
    std::vector<Light> lights_;
    float skyRadiance_ = 0.0f;
    std::size_t bytes_ = 0;
    MotionPose pose_;
    std::uint64_t poseNumber_ = 0;
    std::optional<Deformer> deformer_;  // none where nothing bends

    SceneTextures textures_;
    SceneSamplers samplers_;
    Buffer vertices_, extras_, indices_, drawIndices_, materialBuffer_;
    // What the last prepared view sees.
    mutable std::uint64_t trianglesDrawn_ = 0;
    mutable float lodBias_ = 0.0f;          // that the samplers have
    mutable std::vector<Run> runs_;         // all, by state: blended ones last
    mutable std::vector<Run> blendedRuns_;  // of blended ones, the farthest first
    mutable glm::vec3 up_{0.0f};            // the world's up in view space
    mutable Buffer instances_, lightBuffer_, commands_;
    VertexArray vertexArray_, extrasVertexArray_;
    std::map<unsigned, Program> programs_;  // by features
};

}  // namespace dioptre
