// glTF 2.0 files (.gltf with its buffers and images beside it or inside it, and .glb) as a Scene.
// Source: Khronos glTF 2.0 specification. Files are taken as hostile: each number is checked before it is used.
//
// Read: the node tree of the default scene (the first if none is named; all roots if there are no scenes), points,
// lines and triangles in all seven modes with or without indices, vertex colours (COLOR_0, clamped to 0..1), base
// colour, metallic-roughness, normal, occlusion and emissive textures (PNG, JPEG) with any sampler, alpha masks and
// blending, perspective cameras, sparse, interleaved and normalised accessors, animations of translation, rotation,
// scale and weights (step, linear, cubic spline), skins of any number of joints and influences, morph targets of
// positions, normals and tangents, KHR_lights_punctual, KHR_materials_unlit, KHR_materials_emissive_strength,
// KHR_mesh_quantization, KHR_texture_transform. A material may read any two of the TEXCOORD_n.
// Made up: missing normals are flat ones (vertices unshared, given tangents dropped), but points and lines without
// normals are not lit; a zero normal becomes that of its faces; missing tangents come from the texture coordinates when
// the material has a normal map, which points and lines without tangents go without. A mesh no node of the scene uses,
// and an image no drawn texture uses, is not kept.
// Named in Scene::warnings and left out: orthographic cameras, other scenes, a third set of texture coordinates in one
// material, vertex colours after the first, animation of anything but nodes, optional extensions not known here.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>

#include "scene/scene.hpp"

namespace dioptre {

/// How much a file may ask for; beyond it, loading stops with an InputError that names the element and the limit.
struct LoadLimits {
    std::uint64_t maxFileBytes = 2ull << 30;   // any one file: the scene, a buffer, an image
    std::uint64_t maxImageBytes = 2ull << 30;  // all images together, decoded to 4 bytes a texel
    std::uint64_t maxTotalBytes = 6ull << 30;  // at any time: files read, images decoded, vertices and indices
    int maxImageSide = 16384;                  // texels
    int maxNodeDepth = 512;                    // a root has depth 1
    std::uint64_t maxJsonValues = 16'000'000;  // about 100 bytes of memory each
    std::uint64_t maxDraws = 1'000'000;        // primitives of all instances, some 400 bytes each where they are drawn
    int maxJsonDepth = 128;                    // arrays and objects inside one another
    std::size_t maxWarnings = 100;             // the rest is counted in one last line
};

/// Loads the file; peak memory is about that of the file plus that of the scene.
/// Throws InputError, one line that starts with the file's name and names the element, the value and the limit:
/// `scene.glb: meshes[3].primitives[0].indices: accessor 12 reads 4096 bytes past bufferView 5 (800 bytes)`.
/// Buffers and images must lie inside the scene's folder, links resolved; of all schemes only `data:` is followed.
/// Names are UTF-8: an instance, camera or light has that of its node, or else its own; a scene its own or the file's.
/// An instance keeps a matrix that mirrors (negative determinant): who draws it flips the winding.
/// `progress` is told, now and then, the share that is done, 0..1.
Scene loadGltf(const std::filesystem::path& path, const LoadLimits& limits = {},
               const std::function<void(double)>& progress = {});

}  // namespace dioptre
