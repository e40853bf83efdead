// Skins and morph targets, on the GPU: once a pose, into vertices of their own, which every technique then draws as any
// others, however often.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "gl/program.hpp"
#include "scene/animation.hpp"
#include "scene/deformation.hpp"

namespace dioptre {

class Deformer {
  public:
    // Vertices of a deformed primitive, and of each posed copy, begin at a multiple of it: then their bytes do at a
    // multiple of 256, as no driver asks for more of a buffer that a shader reads.
    static constexpr std::uint32_t kVertexAlignment = 64;

    explicit Deformer(std::shared_ptr<const Motion> motion);

    /// One primitive of one instance: its vertices at rest, and where the posed ones go (those are there already, for
    /// what is not bent). Returns its number. Throws RunError for one too large for a shader's buffer.
    std::size_t add(const Instance& instance, const Primitive& primitive, std::uint32_t firstRest,
                    std::uint32_t firstPosed);
    /// After the last one.
    void upload();

    /// Where a posed primitive is drawn: around the first joint of its skin, or where its node is.
    struct Placed {
        glm::dmat4 worldFromMesh{1.0};
        bool mirrored = false;  // front faces run clockwise
        Bounds bounds;          // of the posed vertices, conservative (scene/deformation.hpp)
    };
    /// Bends all of them, in the buffer that holds all vertices of the scene. Number i's place is the result's i.
    std::vector<Placed> pose(const MotionPose& pose, const Buffer& vertices);

    std::size_t bytes() const { return influences_.bytes() + deltas_.bytes() + joints_.bytes(); }

  private:
    struct Bent {
        std::uint32_t firstRest = 0, firstPosed = 0, vertexCount = 0;
        std::uint32_t perVertex = 0, deltaWidth = 3, targetCount = 0;
        bool flat = false;
        std::size_t node = 0;
        int skin = -1;                               // -1: morphed alone
        std::size_t influencesAt = 0, deltasAt = 0;  // bytes from the buffers' starts
        DeformedExtent extent;
        std::shared_ptr<const Deformation> deformation;  // until uploaded
    };
    void bend(const Bent& bent, const Buffer& vertices, std::size_t firstActive, std::size_t activeCount) const;

    std::shared_ptr<const Motion> motion_;
    std::vector<Bent> bent_;
    std::vector<std::size_t> firstJoint_;  // of each skin, in joints_
    std::size_t influenceBytes_ = 0, deltaBytes_ = 0, targets_ = 0;
    Buffer influences_, deltas_, joints_, active_;
    Program program_;
};

}  // namespace dioptre
