#include "scene/gltf_material.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/gltf_uri.hpp"

namespace dioptre::gltf {
namespace {

Wrap readWrap(const Element& sampler, std::string_view key) {
    switch (const std::uint64_t code = sampler.whole(key, 10497)) {
        case 10497:
            return Wrap::repeat;
        case 33071:
            return Wrap::clampToEdge;
        case 33648:
            return Wrap::mirroredRepeat;
        default:
            sampler.fail(key, fmt::format("is {}, must be 10497, 33071 or 33648", code));
    }
}

Sampler readSampler(const Element& element) {
    Sampler sampler{readWrap(element, "wrapS"), readWrap(element, "wrapT")};
    switch (const std::uint64_t code = element.whole("magFilter", 9729)) {
        case 9728:
            sampler.magnification = Filter::nearest;
            break;
        case 9729:
            sampler.magnification = Filter::linear;
            break;
        default:
            element.fail("magFilter", fmt::format("is {}, must be 9728 or 9729", code));
    }
    switch (const std::uint64_t code = element.whole("minFilter", 9987)) {
        case 9728:
            sampler.minification = Filter::nearest;
            break;
        case 9729:
            sampler.minification = Filter::linear;
            break;
        case 9984:
            sampler.minification = Filter::nearestMipNearest;
            break;
        case 9985:
            sampler.minification = Filter::linearMipNearest;
            break;
        case 9986:
            sampler.minification = Filter::nearestMipLinear;
            break;
        case 9987:
            sampler.minification = Filter::linearMipLinear;
            break;
        default:
            element.fail("minFilter", fmt::format("is {}, must be 9728, 9729 or 9984 to 9987", code));
    }
    return sampler;
}

// KHR_texture_transform: scaled, turned, then moved.
glm::mat3x2 readTransform(const Element& transform) {
    const std::vector<float> offset = transform.numbers("offset", 2), scale = transform.numbers("scale", 2);
    const float rotation = transform.number("rotation", 0.0f);
    const float c = std::cos(rotation), s = std::sin(rotation);
    glm::mat3x2 m(1.0f);
    m[0] = glm::vec2(c, -s) * (scale.empty() ? 1.0f : scale[0]);
    m[1] = glm::vec2(s, c) * (scale.empty() ? 1.0f : scale[1]);
    if (!offset.empty()) m[2] = glm::vec2(offset[0], offset[1]);
    return m;
}

class Reader {
  public:
    Reader(const Element& root, const Accessors& accessors)
        : decoder(std::make_unique<ImageDecoder>(root.context())),
          images_(root.list("images")),
          accessors_(accessors),
          drawn_(images_.size(), -1) {
        const List samplers = root.list("samplers"), textures = root.list("textures");
        for (std::size_t i = 0; i < samplers.size(); ++i) samplers_.push_back(readSampler(samplers[i]));
        for (std::size_t i = 0; i < images_.size(); ++i) checkImage(images_[i]);
        for (std::size_t i = 0; i < textures.size(); ++i) readTexture(textures[i]);
    }

    Material readMaterial(const Element& element, MaterialNeeds& needs);

    std::unique_ptr<ImageDecoder> decoder;
    std::vector<std::string> imageNames;  // of those that are drawn

  private:
    struct Texture {
        std::optional<std::size_t> image;
        Sampler sampler;
    };
    void checkImage(const Element& image) const;
    void readTexture(const Element& texture);
    int drawnImage(std::size_t image);
    TextureSlot readSlot(const Element& info, MaterialNeeds& needs);
    TextureSlot readSlot(const std::optional<Element>& info, MaterialNeeds& needs) {
        return info ? readSlot(*info, needs) : TextureSlot{};
    }

    List images_;
    const Accessors& accessors_;
    std::vector<Sampler> samplers_;
    std::vector<Texture> textures_;
    std::vector<int> drawn_;  // of each image in the file, its place in `images`, or -1
};

void Reader::checkImage(const Element& image) const {
    const auto view = image.index("bufferView", accessors_.viewCount(), "bufferViews");
    if (!view && !image.has("uri")) image.fail("has neither uri nor bufferView");
}

void Reader::readTexture(const Element& element) {
    Texture texture;
    if (const auto sampler = element.index("sampler", samplers_.size(), "samplers"))
        texture.sampler = samplers_[*sampler];
    texture.image = element.index("source", images_.size(), "images");
    if (!texture.image) element.warn("has no PNG or JPEG image: not drawn");
    textures_.push_back(texture);
}

int Reader::drawnImage(std::size_t number) {
    if (drawn_[number] >= 0) return drawn_[number];
    const Element image = images_[number];
    const auto view = image.index("bufferView", accessors_.viewCount(), "bufferViews");
    Bytes own;
    if (!view) own = readUri(image);
    imageNames.push_back(image.text("name").value_or(""));
    return drawn_[number] = decoder->add(view ? accessors_.viewBytes(*view) : std::span<const std::uint8_t>(),
                                         std::move(own), image);
}

TextureSlot Reader::readSlot(const Element& info, MaterialNeeds& needs) {
    const Texture& texture = textures_[info.requiredIndex("index", textures_.size(), "textures")];
    std::uint64_t uvSet = info.whole("texCoord", 0);
    TextureSlot slot;
    if (const auto transform = info.extension("KHR_texture_transform")) {
        slot.imageFromVertex = readTransform(*transform);
        uvSet = transform->whole("texCoord", uvSet);
    }
    if (!texture.image) return {};
    auto place = std::find(needs.uvSets.begin(), needs.uvSets.end(), uvSet);
    if (place == needs.uvSets.end() && needs.uvSets.size() == 2) {
        info.warn("texCoord", "is a third set of texture coordinates in one material: ignored, not drawn");
        return {};
    }
    if (place == needs.uvSets.end()) place = needs.uvSets.insert(place, uvSet);
    slot.uvSet = static_cast<int>(place - needs.uvSets.begin());
    slot.image = drawnImage(*texture.image);
    slot.sampler = texture.sampler;
    return slot;
}

// Factors beyond their range are drawn at its end.
float clampedFactor(const Element& owner, std::string_view key, float value, float limit = 1.0f) {
    if (value >= 0.0f && value <= limit) return value;
    owner.warn(key, fmt::format("a factor outside 0..{} is clamped", limit));
    return std::clamp(value, 0.0f, limit);
}

Material Reader::readMaterial(const Element& element, MaterialNeeds& needs) {
    Material material;
    material.name = element.text("name").value_or("");
    if (const auto pbr = element.find("pbrMetallicRoughness")) {
        const std::vector<float> factor = pbr->numbers("baseColorFactor", 4);
        for (std::size_t i = 0; i < factor.size(); ++i)
            material.baseColor[static_cast<int>(i)] = clampedFactor(*pbr, "baseColorFactor", factor[i]);
        material.metallic = clampedFactor(*pbr, "metallicFactor", pbr->number("metallicFactor", 1.0f));
        material.roughness = clampedFactor(*pbr, "roughnessFactor", pbr->number("roughnessFactor", 1.0f));
        material.baseColorTexture = readSlot(pbr->find("baseColorTexture"), needs);
        material.metallicRoughnessTexture = readSlot(pbr->find("metallicRoughnessTexture"), needs);
    }
    if (const auto info = element.find("normalTexture")) {
        material.normalTexture = readSlot(*info, needs);
        material.normalScale = info->number("scale", 1.0f);
    }
    material.emissiveTexture = readSlot(element.find("emissiveTexture"), needs);
    if (const auto info = element.find("occlusionTexture")) {
        material.occlusionTexture = readSlot(*info, needs);
        material.occlusionStrength = clampedFactor(*info, "strength", info->number("strength", 1.0f));
    }

    const std::vector<float> emissive = element.numbers("emissiveFactor", 3);
    float strength = 1.0f;
    if (const auto extension = element.extension("KHR_materials_emissive_strength")) {
        strength = extension->number("emissiveStrength", 1.0f);
        if (strength < 0.0f) extension->fail("emissiveStrength", fmt::format("is {}, must not be negative", strength));
    }
    for (std::size_t i = 0; i < emissive.size(); ++i) {
        const float radiance = clampedFactor(element, "emissiveFactor", emissive[i]) * strength;
        material.emissive[static_cast<int>(i)] = radiance;
    }
    material.unlit = element.extension("KHR_materials_unlit").has_value();
    material.doubleSided = element.flag("doubleSided", false);

    const std::string mode = element.text("alphaMode").value_or("OPAQUE");
    if (mode == "MASK") {
        material.alphaMode = AlphaMode::mask;
        material.alphaCutoff = element.number("alphaCutoff", 0.5f);
        if (material.alphaCutoff < 0.0f)
            element.fail("alphaCutoff", fmt::format("is {}, must not be negative", material.alphaCutoff));
    } else if (mode == "BLEND") {
        material.alphaMode = AlphaMode::blend;
    } else if (mode != "OPAQUE") {
        element.fail("alphaMode", fmt::format("is \"{}\", must be OPAQUE, MASK or BLEND", printable(mode)));
    }
    needs.tangent = material.normalTexture.used();
    return material;
}

}  // namespace

Materials readMaterials(const Element& root, const Accessors& accessors) {
    Materials result;
    Reader reader(root, accessors);
    const List list = root.list("materials");
    for (std::size_t i = 0; i < list.size(); ++i) {
        MaterialNeeds needs;
        result.materials.push_back(reader.readMaterial(list[i], needs));
        result.needs.push_back(needs);
    }
    result.materials.emplace_back();
    result.needs.emplace_back();
    reader.decoder->start();
    result.decoder = std::move(reader.decoder);
    result.imageNames = std::move(reader.imageNames);
    return result;
}

std::vector<TextureImage> Materials::finishImages() {
    std::vector<TextureImage> images = decoder->finish();
    for (std::size_t i = 0; i < images.size(); ++i) images[i].name = imageNames[i];
    return images;
}

}  // namespace dioptre::gltf
