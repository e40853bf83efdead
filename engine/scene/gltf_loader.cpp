#include "scene/gltf_loader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

#include "scene/deformation.hpp"
#include "scene/gltf_file.hpp"
#include "scene/gltf_mesh.hpp"
#include "scene/gltf_motion.hpp"
#include "scene/gltf_view.hpp"
#include "scene/placement.hpp"

namespace dioptre {
namespace {

using namespace gltf;

struct KnownExtension {
    std::string_view name;
    bool read;
    std::string_view advice = {};  // for those that are not
};

constexpr std::string_view kUncompressed = "re-export without compression",
                           kPlainImages = "re-export with PNG or JPEG textures";
constexpr std::array kExtensions{
    KnownExtension{"KHR_materials_unlit", true},
    KnownExtension{"KHR_materials_emissive_strength", true},
    KnownExtension{"KHR_lights_punctual", true},
    KnownExtension{"KHR_mesh_quantization", true},
    KnownExtension{"KHR_texture_transform", true},
    KnownExtension{"KHR_draco_mesh_compression", false, kUncompressed},
    KnownExtension{"EXT_meshopt_compression", false, kUncompressed},
    KnownExtension{"KHR_meshopt_compression", false, kUncompressed},
    KnownExtension{"KHR_texture_basisu", false, kPlainImages},
    KnownExtension{"EXT_texture_webp", false, kPlainImages},
    KnownExtension{"EXT_texture_avif", false, kPlainImages},
    KnownExtension{"MSFT_texture_dds", false, kPlainImages},
};

const KnownExtension* known(std::string_view name) {
    const auto found =
        std::find_if(kExtensions.begin(), kExtensions.end(), [&](const auto& e) { return e.name == name; });
    return found == kExtensions.end() ? nullptr : &*found;
}

struct Version {
    int major = 0, minor = 0;
};

Version readVersion(const Element& asset, std::string_view key) {
    const std::string text = asset.text(key).value_or("");
    Version version;
    const auto isDigit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
    // "<major>.<minor>", short enough not to overflow
    const auto dot = text.find('.');
    const bool digits = dot != std::string::npos && dot > 0 && dot < 4 && text.size() > dot + 1 &&
                        text.size() < dot + 5 &&
                        std::all_of(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(dot), isDigit) &&
                        std::all_of(text.begin() + static_cast<std::ptrdiff_t>(dot) + 1, text.end(), isDigit);
    if (!digits) asset.fail(key, fmt::format("is \"{}\", must be such as \"2.0\"", printable(text)));
    version.major = std::stoi(text.substr(0, dot));
    version.minor = std::stoi(text.substr(dot + 1));
    return version;
}

void checkAsset(const Element& root) {
    const Element asset = root.object("asset");
    if (const Version version = readVersion(asset, "version"); version.major != 2)
        asset.fail("version", fmt::format("is {}.{}, only 2.x is read", version.major, version.minor));
    if (!asset.has("minVersion")) return;
    if (const Version least = readVersion(asset, "minVersion"); least.major != 2 || least.minor > 0)
        asset.fail("minVersion", fmt::format("is {}.{}, only 2.0 is read", least.major, least.minor));
}

void checkExtensions(const Element& root) {
    const List required = root.list("extensionsRequired"), used = root.list("extensionsUsed");
    for (std::size_t i = 0; i < required.size(); ++i) {
        const std::string name = required.text(i);
        const KnownExtension* extension = known(name);
        if (extension && extension->read) continue;
        required.fail(i, fmt::format("{} is not supported: {}", printable(name),
                                     extension ? extension->advice : "re-export without it"));
    }
    std::set<std::string> warned;
    for (std::size_t i = 0; i < used.size(); ++i) {
        const std::string name = used.text(i);
        const KnownExtension* extension = known(name);
        if ((extension && extension->read) || !warned.insert(name).second) continue;
        root.context().warn(used.pathOf(i), fmt::format("{} is ignored", printable(name)));
    }
}

// What a node refers to; also of nodes that no scene shows.
struct NodeContent {
    std::optional<std::size_t> mesh, camera, light;
};

class Builder {
  public:
    Builder(const Element& root, const Document& document, Scene& scene)
        : root_(root),
          nodes_(root.list("nodes")),
          scene_(scene),
          accessors_(root, document.binaryChunk),
          materials_(readMaterials(root, accessors_)),
          meshes_(root, accessors_, materials_),
          cameras_(readCameras(root)),
          lights_(readLights(root)) {
        accessors_.checkAll();
        for (std::size_t i = 0; i < nodes_.size(); ++i) contents_.push_back(readContent(nodes_[i]));
    }

    void build(const std::function<void(double)>& progress) {
        // Images are decoded meanwhile; what is left of them then is taken for a third.
        constexpr double kNodesShare = 2.0 / 3.0;
        const std::vector<PlacedNode> placed = placeNodes(root_, scene_.name);
        MotionReader motion(root_, accessors_, placed);
        placeOf_.assign(meshes_.size(), -1);
        for (std::size_t i = 0; i < placed.size(); ++i) {
            add(placed[i], motion, i);
            if (progress) progress(kNodesShare * static_cast<double>(i + 1) / static_cast<double>(placed.size()));
        }
        if (motion.any()) motion.finish(scene_);
        finishMaterials();
        scene_.images = materials_.finishImages();
    }

  private:
    NodeContent readContent(const Element& node) const {
        NodeContent content;
        content.mesh = node.index("mesh", meshes_.size(), "meshes");
        content.camera = node.index("camera", cameras_.size(), "cameras");
        if (const auto light = node.extension("KHR_lights_punctual"))
            content.light = light->requiredIndex("light", lights_.size(), "lights");
        node.index("skin", root_.list("skins").size(), "skins");
        return content;
    }

    // The place is that of its node in Motion::nodes.
    void add(const PlacedNode& placed, const MotionReader& motion, std::size_t place) {
        const Element node = nodes_[placed.node];
        const NodeContent& content = contents_[placed.node];
        const std::string name = node.text("name").value_or("");
        const int moving = motion.any() ? static_cast<int>(place) : -1;
        if (content.mesh) {
            addInstance(node, *content.mesh, {name, 0, placed.worldFromNode, moving, motion.skinOf(place)},
                        motion.needs(*content.mesh));
        }
        if (content.camera && cameras_[*content.camera]) {
            Camera camera = *cameras_[*content.camera];
            if (!name.empty()) camera.name = name;
            camera.node = moving;
            if (dioptre::place(camera, placed.worldFromNode))
                scene_.cameras.push_back(std::move(camera));
            else
                node.warn("camera", "is ignored: a singular transform gives it no direction");
        }
        if (content.light) {
            Light light = lights_[*content.light];
            if (!name.empty()) light.name = name;
            light.node = moving;
            if (dioptre::place(light, placed.worldFromNode))
                scene_.lights.push_back(std::move(light));
            else
                node.warn("extensions.KHR_lights_punctual", "is ignored: a singular transform gives it no direction");
        }
    }

    void addInstance(const Element& node, std::size_t mesh, Instance instance, const DeformationNeeds& needs) {
        if (placeOf_[mesh] < 0) {
            scene_.meshes.push_back(meshes_.read(mesh, needs));
            placeOf_[mesh] = static_cast<int>(scene_.meshes.size() - 1);
        }
        const Mesh& drawn = scene_.meshes[static_cast<std::size_t>(placeOf_[mesh])];
        draws_ += drawn.primitives.size();
        if (const std::uint64_t limit = node.context().limits.maxDraws; draws_ > limit)
            node.fail("mesh", fmt::format("is primitive {} to draw, the limit is {}", draws_, limit));
        for (const Primitive& primitive : drawn.primitives) {
            if (bends(instance, primitive)) chargePosed(node, primitive);
            for (int corner = 0; corner < 8; ++corner) {
                const glm::vec3 inWorld(instance.worldFromMesh * glm::vec4(primitive.bounds.corner(corner), 1.0f));
                if (!std::isfinite(inWorld.x) || !std::isfinite(inWorld.y) || !std::isfinite(inWorld.z))
                    node.fail("mesh", "lies at infinity: the transform times the positions is too much for a float");
                scene_.bounds.add(inWorld);
            }
        }
        if (instance.name.empty()) instance.name = drawn.name;
        instance.mesh = placeOf_[mesh];
        scene_.instances.push_back(std::move(instance));
    }

    /// What an instance has of its own of a mesh that it bends: vertices, and how far they can reach.
    static void chargePosed(const Element& node, const Primitive& primitive) {
        const DeformedExtent& extent = primitive.deformation->extent;
        node.context().charge(
            primitive.vertices.size() * sizeof(Vertex) + primitive.extras.size() * sizeof(VertexExtra) +
                2 * (extent.joints.size() * sizeof(DeformedExtent::Joint) + extent.targets.size() * sizeof(Bounds)),
            node.pathOf("mesh"));
    }

    // The default material stays if it is used or the only one.
    void finishMaterials() {
        const int last = static_cast<int>(materials_.materials.size()) - 1;
        bool used = last == 0;
        for (const Mesh& mesh : scene_.meshes)
            for (const Primitive& primitive : mesh.primitives) used = used || primitive.material == last;
        if (!used) materials_.materials.pop_back();
        scene_.materials = std::move(materials_.materials);
    }

    const Element& root_;
    List nodes_;
    Scene& scene_;
    Accessors accessors_;
    Materials materials_;
    MeshReader meshes_;
    std::vector<std::optional<Camera>> cameras_;
    std::vector<Light> lights_;
    std::vector<NodeContent> contents_;
    std::uint64_t draws_ = 0;
    std::vector<int> placeOf_;  // of each mesh in the file, its place in Scene::meshes, or -1
};

}  // namespace

Scene loadGltf(const std::filesystem::path& path, const LoadLimits& limits,
               const std::function<void(double)>& progress) {
    Context context(path, limits);
    const Document document = openDocument(path, context);
    const Element root(document.json, "", context);
    checkAsset(root);
    checkExtensions(root);
    Scene scene;
    scene.name = printable(path.stem().string());
    Builder(root, document, scene).build(progress);
    scene.warnings = context.warnings();
    return scene;
}

}  // namespace dioptre
