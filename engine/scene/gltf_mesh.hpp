// Meshes: attributes and indices to points, lines or triangles with complete vertices. Internal to the glTF loader.
#pragma once

#include "scene/gltf_deformation.hpp"
#include "scene/gltf_material.hpp"

namespace dioptre::gltf {

class MeshReader {
  public:
    /// Checks all primitives' accessors, types and counts; reads no vertex yet.
    MeshReader(const Element& root, const Accessors& accessors, const Materials& materials);

    std::size_t size() const { return meshes_.size(); }
    /// Reads mesh `i`, which takes memory; checks every index and vertex.
    Mesh read(std::size_t i, const DeformationNeeds& needs) const;

  private:
    struct Plan;
    Plan plan(const Element& primitive) const;
    void planAttributes(const Element& attributes, Plan& plan) const;
    void planIndices(const Element& primitive, Plan& plan) const;
    void warnOfOmissions(const Element& primitive, const Plan& plan) const;
    void checkAttribute(const Element& attributes, const std::string& semantic, const Accessor& accessor) const;
    std::optional<Primitive> readPrimitive(const Element& primitive, const DeformationNeeds& needs) const;
    void readIndices(const Plan& plan, const Element& primitive, Primitive& out) const;
    /// An accessor's numbers into each vertex (or extra), `offset` bytes from its start.
    template <typename Holder>
    void readAttribute(std::size_t accessor, const Element& attributes, std::string_view key,
                       std::vector<Holder>& vertices, std::size_t offset) const;
    void readVertices(const Plan& plan, const Element& attributes, Primitive& out) const;
    void readExtras(const Plan& plan, const Element& attributes, Primitive& out) const;
    void readNormals(const Plan& plan, const Element& attributes, Primitive& out) const;
    void readTangents(const Plan& plan, const Element& attributes, Primitive& out) const;

    List meshes_;
    const Accessors& accessors_;
    const Materials& materials_;
    bool quantized_ = false;  // KHR_mesh_quantization is declared
};

}  // namespace dioptre::gltf
