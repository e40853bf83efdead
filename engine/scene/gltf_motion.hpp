// What moves or bends in the drawn scene, put together from its nodes, animations, skins and morph targets. Internal to
// the glTF loader.
#pragma once

#include <span>

#include "scene/gltf_deformation.hpp"
#include "scene/gltf_node.hpp"

namespace dioptre::gltf {

class MotionReader {
  public:
    /// Checks all animations, skins and weights of the file. `placed` is the drawn scene.
    MotionReader(const Element& root, const Accessors& accessors, std::span<const PlacedNode> placed);

    /// Whether anything of the drawn scene moves or bends; if not, the scene has no Motion.
    bool any() const;
    /// What is to be read of a mesh of the file.
    const DeformationNeeds& needs(std::size_t mesh) const { return needs_[mesh]; }
    /// Of a placed node, in Motion::skins; -1: none.
    int skinOf(std::size_t place) const { return skinOf_[place]; }

    /// Gives the scene its motion, places everything at time 0, finds its bounds. `placed` i is Motion::nodes[i].
    /// Fails where something could get to infinity at any time.
    void finish(Scene& scene);

  private:
    void readNodeTargets();
    void readNodes();
    void readMotionSkins(const Accessors& accessors);
    void useSkin(const Element& node, std::size_t place, const std::vector<Skin>& fileSkins);
    void readMotionAnimations(const Accessors& accessors);
    void checkReach(const Scene& scene) const;

    Element root_;
    List nodes_, meshes_;
    std::span<const PlacedNode> placed_;
    std::vector<int> placeOf_;                // of each node of the file, -1: not drawn
    std::vector<std::size_t> meshTargets_;    // of each mesh of the file, how many
    std::vector<std::size_t> nodeTargets_;    // of each node's mesh
    std::vector<DeformationNeeds> needs_;     // of each mesh of the file
    std::vector<int> skinOf_, motionSkinOf_;  // of each placed node; of each skin of the file, in motion_.skins
    Motion motion_;
};

}  // namespace dioptre::gltf
