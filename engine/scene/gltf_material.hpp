// Materials with their textures, samplers and images. Internal to the glTF loader.
#pragma once

#include "scene/gltf_accessor.hpp"
#include "scene/gltf_image.hpp"

namespace dioptre::gltf {

/// What a material asks of the vertices it is put on.
struct MaterialNeeds {
    bool tangent = false;               // has a normal map
    std::vector<std::uint64_t> uvSets;  // which TEXCOORD_n it reads: Vertex::uv, VertexExtra::uv
};

struct Materials {
    std::vector<Material> materials;        // as in the file; the default material is the last one
    std::vector<MaterialNeeds> needs;       // of each material
    std::unique_ptr<ImageDecoder> decoder;  // at work on the images that are drawn
    std::vector<std::string> imageNames;    // of those

    /// Waits for the images and fails if one is damaged.
    std::vector<TextureImage> finishImages();
};

Materials readMaterials(const Element& root, const Accessors& accessors);

}  // namespace dioptre::gltf
