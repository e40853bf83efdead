// Files of a glTF scene: reading them whole, the GLB container, JSON that may be broken. Internal to the glTF loader.
#pragma once

#include <span>

#include "scene/gltf_json.hpp"

namespace dioptre::gltf {

/// The whole of a regular file; its size is charged to the context. `where` names the element that asks for it.
Bytes readFile(const std::filesystem::path& path, Context& context, std::string_view where);

/// The scene file taken apart.
struct Document {
    Json json;
    Bytes file;  // of a GLB, for the chunk lies in it; else empty
    std::optional<std::span<const std::uint8_t>> binaryChunk;
};

Document openDocument(const std::filesystem::path& path, Context& context);

}  // namespace dioptre::gltf
