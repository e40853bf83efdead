// The pictures that `dioptre measure` compares with: two independent halves of the reference's samples, kept in the
// cache folder under a hash of all that they depend on.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "core/image.hpp"
#include "optics/lens.hpp"
#include "optics/view.hpp"
#include "render/gpu_scene.hpp"

namespace dioptre {

struct ReferenceRequest {
    const GpuScene& scene;
    std::string content;  // contentOf the scene
    View view;
    Lens lens;
    float exposure = 1.0f;
    int samplesPerHalf = 256;
    std::string renderer;  // name and version of the GL
};

struct ReferencePictures {
    Image first, second;        // samples 0..N-1 and N..2N-1 of the sequence
    double milliseconds = 0.0;  // of drawing both; 0: from the cache

    Image mean() const;
};

/// Hexadecimal: of the request, of the shaders that draw it and of the sequence of lens samples.
std::string referenceKey(const ReferenceRequest& request);

/// From `cache` (none where it is empty) if it is there and whole, else drawn and put there; a cache that cannot be
/// written, or is broken, costs a warning. None where `stopped` said so.
std::optional<ReferencePictures> referencePictures(const ReferenceRequest& request, const std::filesystem::path& cache,
                                                   const std::function<bool()>& stopped);

}  // namespace dioptre
