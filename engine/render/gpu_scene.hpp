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
#include "render/draw_list.hpp"
#include "render/scene_upload.hpp"
#include "scene/scene.hpp"
#include "scene/simplify.hpp"

namespace dioptre {

/// What a view sees by the bounding boxes; where there is nothing, `anything` is false and all is 0.
struct ViewContents {
    double nearest = 0.0, farthest = 0.0;  // vergences, D
    bool anything = false;
    bool blended = false;  // some of it is seen through
};

/// How finely textures are read.
struct TextureFilter {
    float levelBias = 0.0f;  // added to the level that one sample a pixel asks for
    // How many times as coarsely what is blurred is read, by its depth; nothing where that is less than 1, and nothing
    // where texels are holes: their shape would change.
    CocTransform spacing = {};
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

    /// A primitive's next level of detail (scene/lod.hpp), level 1 first: for all instances that do not bend it. Lists
    /// of what is seen are to be made anew.
    void addLevel(std::size_t mesh, std::size_t primitive, const LodLevel& level);

    /// Another number with each other pose or further level of detail.
    std::uint64_t version() const { return version_; }

    /// Draws what `view` sees to the bound framebuffer (programs are compiled when first needed, in a frame): radiance
    /// × exposure and depth, or depth alone. The depth buffer must have been cleared to 0 (reversed depth). The depth
    /// left is that of the surface which gives the pixel most of its light: of a blended one where its alpha is 0.5 or
    /// more.
    /// Levels of detail may be off by `detailPx` pixels of the view; 0: all at level 0.
    /// `sight`: as see() takes it.
    void drawRadiance(const View& view, float exposure, double detailPx, const Sight* sight = nullptr) const;
    void drawDepth(const View& view, double detailPx) const;

    /// What any point of the lens sees, from any of these eyes, one or more that look the same way.
    Sight inSight(std::span<const View> eyes, const Lens& lens) const;
    /// What `view` sees or, with a lens, what any of its points does; with the sight of this eye and others, of what is
    /// in it. Draws nothing before it is arranged.
    void see(DrawList& list, const View& view, const Lens* lens, const Sight* sight = nullptr) const;
    /// Each seen item at a level of detail (in the order of list.seen(); DrawList::kHidden: not at all; none given:
    /// all at level 0), as often as a call will have matrices.
    void arrange(DrawList& list, int matrices, std::span<const std::int8_t> levels = {}) const;
    /// Exactly as many matrices as arranged for, matrix i to layer `firstLayer` + i of the bound layered framebuffer.
    /// Depth is left by opaque surfaces only.
    void drawThroughLens(const DrawList& list, std::span<const glm::mat4> clipFromView, float exposure,
                         const TextureFilter& filter, int firstLayer = 0) const;

    /// Conservative: from the pose's bounding boxes, nearest bounded by the view's near plane.
    ViewContents contents(const View& view) const;
    /// Of what `view` may see, for each of these allowances as drawRadiance has them.
    std::vector<std::uint64_t> triangles(const View& view, std::span<const double> detailPx) const;

    std::size_t bytes() const;
    /// Triangles sent to the GL so far, counted once for each matrix.
    std::uint64_t trianglesDrawn() const { return trianglesDrawn_; }

  private:
    using State = DrawList::State;
    using Run = DrawList::Run;
    using Faces = DrawList::Faces;
    // One primitive of one instance.
    struct Item {
        State state;
        std::uint32_t primitive = 0;  // its indices: levels_
        std::uint32_t baseVertex = 0;
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
        bool textured = false;
        bool mapped = false;  // a texture is not read at the vertex's first coordinates
        bool occluded = false, emits = false, surfaceMapped = false, bumped = false;  // has such a texture, or emits
    };
    // What is drawn of a surface; `blended`: what the others see through it.
    enum class Phase { surface, blended, depth };
    struct Through {
        std::span<const glm::mat4> clipFromView;
        float exposure = 1.0f;
        int firstLayer = 0;
        TextureFilter filter = {};
    };

    void uploadGeometry(const Scene& scene);
    void uploadMaterials(const Scene& scene);
    void applyPose();
    unsigned featuresOf(const State& state, Phase phase, bool spaced) const;
    void sortFrontToBack(DrawList& list) const;
    void append(DrawList& list, std::vector<Run>& runs, const DrawList::Seen& seen, int matrices, int level,
                Faces faces) const;
    void setLodBias(float bias) const;
    const Program& programFor(unsigned features) const;
    void drawBlended(const DrawList& list, const Through& through) const;
    void drawRuns(const DrawList& list, std::span<const Run> runs, Phase phase, const Through& through) const;
    void bind(const Run& run) const;
    DrawList::Seen seenItem(std::size_t index, const ViewBox& box, const glm::dmat4& viewFromMesh) const;
    void seeWhole(const View& view, double detailPx, const Sight* sight) const;

    std::vector<Item> items_;  // sorted by state
    struct Levels {            // level 0 first
        std::vector<IndexRange> indices;
        std::vector<float> errors;
    };
    std::vector<Levels> levels_;               // of each primitive
    std::vector<std::size_t> firstPrimitive_;  // of each mesh, in levels_
    std::uint32_t indexCount_ = 0;             // of all levels
    std::vector<BoundMaterial> materials_;
    std::vector<Light> lights_;
    float skyRadiance_ = 0.0f;
    MotionPose pose_;
    std::uint64_t version_ = 0;
    std::optional<Deformer> deformer_;  // none where nothing bends

    SceneTextures textures_;
    SceneSamplers samplers_;
    Buffer vertices_, extras_, indices_, materialBuffer_;
    mutable std::uint64_t trianglesDrawn_ = 0;
    mutable float lodBias_ = 0.0f;  // that the samplers have
    mutable DrawList whole_;        // of drawRadiance and drawDepth
    VertexArray vertexArray_, extrasVertexArray_;
    mutable std::map<unsigned, Program> programs_;  // by features; made when first needed
};

}  // namespace dioptre
