#include "scene/scene.hpp"

#include <algorithm>

#include "scene/deformation.hpp"

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace dioptre {

std::size_t Scene::triangleCount() const {
    std::size_t count = 0;
    for (const Instance& instance : instances)
        for (const Primitive& primitive : meshes[static_cast<std::size_t>(instance.mesh)].primitives)
            count += primitive.triangleCount();
    return count;
}

float Scene::brightestEmission() const {
    float most = 0.0f;
    for (const Material& material : materials) {
        most = std::max({most, material.emissive.r, material.emissive.g, material.emissive.b});
        if (material.unlit) most = std::max({most, material.baseColor.r, material.baseColor.g, material.baseColor.b});
    }
    return most;
}

std::size_t Scene::bytes() const {
    std::size_t sum = 0;
    for (const TextureImage& image : images) sum += image.rgba.size();
    for (const Mesh& mesh : meshes)
        for (const Primitive& primitive : mesh.primitives)
            sum += primitive.vertices.size() * sizeof(Vertex) + primitive.extras.size() * sizeof(VertexExtra) +
                   primitive.indices.size() * sizeof(std::uint32_t) +
                   (primitive.deformation ? primitive.deformation->bytes() : 0);
    return sum;
}

void Scene::releaseBulk() {
    // Not = {}, which would keep the memory
    for (TextureImage& image : images) image.rgba = std::vector<std::uint8_t>();
    for (Mesh& mesh : meshes) {
        for (Primitive& primitive : mesh.primitives) {
            primitive.vertices = std::vector<Vertex>();
            primitive.extras = std::vector<VertexExtra>();
            primitive.indices = std::vector<std::uint32_t>();
            primitive.deformation = nullptr;
        }
    }
#ifdef __GLIBC__
    // Otherwise the heap keeps it for what may come.
    malloc_trim(0);
#endif
}

}  // namespace dioptre
