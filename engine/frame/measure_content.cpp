#include "frame/measure_content.hpp"

#include "core/content_hash.hpp"
#include "scene/animation.hpp"
#include "scene/deformation.hpp"

namespace dioptre {

namespace {

/// What bends the meshes at time 0, which is what is measured; where things are then is in the scene's lists.
void addDeformations(ContentHash& hash, const Scene& scene) {
    const auto addVector = [&](const auto& v) { hash.addBytes(v.data(), v.size() * sizeof v[0]); };
    const MotionPose pose = poseAt(*scene.motion, 0.0);
    for (const Skin& skin : scene.motion->skins) {
        const SkinPose joints = poseOf(skin, pose);
        hash.addBytes(&joints.origin, sizeof joints.origin);
        addVector(joints.originFromMesh);
    }
    for (const Instance& instance : scene.instances) {
        hash.add(static_cast<std::uint64_t>(instance.skin + 1));
        addVector(pose.weights[static_cast<std::size_t>(instance.node)]);
    }
    for (const Mesh& mesh : scene.meshes) {
        for (const Primitive& primitive : mesh.primitives) {
            if (!primitive.deformation) continue;
            addVector(primitive.deformation->influences);
            for (const MorphTarget& target : primitive.deformation->targets)
                for (const auto* part : {&target.positions, &target.normals, &target.tangents}) addVector(*part);
        }
    }
}

}  // namespace

std::string contentOf(const Scene& scene) {
    ContentHash hash;
    const auto addFloats = [&](const auto& v) { hash.addBytes(&v, sizeof v); };  // glm types have no gaps
    const auto addVector = [&](const auto& v) { hash.addBytes(v.data(), v.size() * sizeof v[0]); };
    for (const TextureImage& image : scene.images) {
        hash.add(static_cast<std::uint64_t>(image.width));
        addVector(image.rgba);
    }
    for (const Material& m : scene.materials) {
        addFloats(m.baseColor);
        addFloats(m.emissive);
        for (const float value : {m.metallic, m.roughness, m.normalScale, m.occlusionStrength, m.alphaCutoff})
            hash.add(static_cast<double>(value));
        const int kind[] = {static_cast<int>(m.alphaMode), m.doubleSided, m.unlit};
        hash.addBytes(kind, sizeof kind);
        for (const TextureSlot* slot : {&m.baseColorTexture, &m.metallicRoughnessTexture, &m.normalTexture,
                                        &m.emissiveTexture, &m.occlusionTexture}) {
            const Sampler& s = slot->sampler;
            const int fields[] = {slot->image,
                                  static_cast<int>(s.wrapS),
                                  static_cast<int>(s.wrapT),
                                  static_cast<int>(s.magnification),
                                  static_cast<int>(s.minification),
                                  slot->uvSet};
            hash.addBytes(fields, sizeof fields);
            addFloats(slot->imageFromVertex);
        }
    }
    static_assert(sizeof(Vertex) == 12 * sizeof(float) && sizeof(VertexExtra) == 16);  // no gaps
    for (const Mesh& mesh : scene.meshes) {
        hash.add(static_cast<std::uint64_t>(mesh.primitives.size()));
        for (const Primitive& primitive : mesh.primitives) {
            addVector(primitive.vertices);
            addVector(primitive.extras);
            addVector(primitive.indices);
            const int fields[] = {static_cast<int>(primitive.topology), primitive.lit, primitive.material};
            hash.addBytes(fields, sizeof fields);
        }
    }
    for (const Instance& instance : scene.instances) {
        hash.add(static_cast<std::uint64_t>(instance.mesh));
        addFloats(instance.worldFromMesh);
    }
    for (const Light& light : scene.lights) {
        hash.add(static_cast<std::uint64_t>(light.kind));
        for (const glm::vec3& v : {light.color, light.position, light.direction}) addFloats(v);
        for (const float value : {light.range, light.innerConeCos, light.outerConeCos})
            hash.add(static_cast<double>(value));
    }
    if (scene.motion) addDeformations(hash, scene);
    return hash.hex();
}

}  // namespace dioptre
