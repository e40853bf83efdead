// Where the bytes of buffers and images come from: `data:` URIs and files inside the scene's folder, nothing else.
// Internal to the glTF loader.
#pragma once

#include "scene/gltf_json.hpp"

namespace dioptre::gltf {

/// The bytes behind the element's `uri`, which must be there; charged to the context.
Bytes readUri(const Element& owner);

}  // namespace dioptre::gltf
