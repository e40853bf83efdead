#include "scene/scene.hpp"

namespace dioptre {

std::size_t Scene::triangleCount() const {
    std::size_t count = 0;
    for (const Instance& instance : instances)
        for (const Primitive& primitive : meshes[static_cast<std::size_t>(instance.mesh)].primitives)
            count += primitive.indices.size() / 3;
    return count;
}

}  // namespace dioptre
