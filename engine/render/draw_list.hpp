// What a view, or every point of a lens, sees of a scene: which items, where they are, and the commands that draw them.
// Filled by GpuScene::see and GpuScene::arrange.
#pragma once

#include <compare>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "gl/objects.hpp"
#include "optics/lens.hpp"
#include "optics/view.hpp"
#include "scene/scene.hpp"

namespace dioptre {

/// Axis-aligned, in a view's space.
struct ViewBox {
    glm::dvec3 centre{0.0}, half{0.0};

    double nearest() const { return -centre.z - half.z; }  // metres along the axis, < 0 behind the eye
    double farthest() const { return -centre.z + half.z; }
};

/// The box around a transformed box. Arvo 1990, "Transforming axis-aligned bounding boxes".
ViewBox boxInView(const glm::dmat4& viewFromMesh, const Bounds& bounds);

/// False only if no point of the box can be inside the frustum, seen from any point of the lens (none: from the eye).
bool mayBeSeen(const View& view, const Lens* lens, const ViewBox& box);

class DrawList {
  public:
    /// One primitive of one instance.
    struct Seen {
        std::uint32_t item = 0;  // GpuScene's number
        ViewBox box;
        bool blended = false;
        std::uint32_t triangles = 0;    // at level 0
        std::span<const float> errors;  // of each level of detail, level 0 (0) included, metres of the mesh; >= 1
        double scale = 1.0;             // the most that a metre of the mesh is stretched

        int levels() const { return static_cast<int>(errors.size()); }
    };
    /// By what one call can draw, the nearest first; blended ones last.
    std::span<const Seen> seen() const { return seen_; }

    /// In `levels`: the item is not drawn.
    static constexpr std::int8_t kHidden = -1;

  private:
    friend class GpuScene;

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
    enum class Faces { asMaterial, back, front };
    // Commands of equal state.
    struct Run {
        State state;
        Faces faces = Faces::asMaterial;
        std::size_t firstCommand = 0, commandCount = 0;
        std::uint64_t triangles = 0;  // of all matrices
    };
    struct Command {  // as glMultiDrawElementsIndirect reads it
        GLuint count, instanceCount, firstIndex;
        GLint baseVertex;
        GLuint baseInstance;
    };

    std::vector<Seen> seen_;
    std::vector<std::size_t> blended_;  // indices into seen_, the farthest centre first
    glm::vec3 up_{0.0f};                // the world's up in view space
    Buffer instances_, lights_, commands_;
    // As last arranged
    std::vector<Run> runs_;         // by state: blended ones last
    std::vector<Run> blendedRuns_;  // of blended ones, the farthest first
    std::vector<Command> arranged_;
};

/// What any of some eyes may see, found once for all of them (GpuScene::inSight).
struct Sight {
    struct Item {
        DrawList::Seen seen;
        glm::dmat4 viewFromMesh{1.0};
    };
    Pose pose;                // whose space boxes and matrices are in; the other eyes look the same way
    std::vector<Item> items;  // in the scene's order
};

/// The coarsest level with at most that error, and as much of the next as lies between their errors; these increase.
double levelOfError(std::span<const float> errors, double allowed);

/// The same of an item by what its error takes of the view where the item is nearest, pixels. 0 for 0: triangles of
/// levels without error, too, are rounded otherwise.
double levelWithin(const View& view, const DrawList::Seen& seen, double pixels);

}  // namespace dioptre
