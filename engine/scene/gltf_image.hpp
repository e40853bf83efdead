// PNG and JPEG images of a glTF scene; their size is known before anything is decoded. Internal to the glTF loader.
#pragma once

#include <span>

#include "scene/gltf_json.hpp"

namespace dioptre::gltf {

/// Decodes to 8-bit RGBA. `image` is the element `images[i]`, for messages and the limits.
/// `decodedBytes` is the sum so far over the file's images.
TextureImage decodeImage(std::span<const std::uint8_t> bytes, const Element& image, std::uint64_t& decodedBytes);

}  // namespace dioptre::gltf
