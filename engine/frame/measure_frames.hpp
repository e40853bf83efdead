// One technique, one setting of its dials, one view: its picture, and what that costs.
#pragma once

#include <functional>
#include <optional>

#include "core/image.hpp"
#include "frame/measure_lens.hpp"
#include "frame/measure_rows.hpp"
#include "optics/view.hpp"
#include "render/technique.hpp"

namespace dioptre {

/// The vergences of all pixels where something is drawn.
VergenceStatistics visibleVergences(const GpuScene& scene, const View& view);

struct FrameRequest {
    const GpuScene& scene;
    const View& view;
    const Lens& lens;
    float exposure = 1.0f;
    int firstSample = 0;              // where a technique's samples of the lens begin: beyond those of the reference
    double rowMilliseconds = 6000.0;  // fewer than nine frames where nine take longer
};

struct MeasuredPicture {
    MeasuredRow row;  // all but view, error and pareto
    Image picture;
};

/// Draws with a technique of its own, made and freed here: two to nine warm frames, then three that are timed by stage;
/// slow frames serve for both. None where `stopped` said so between two frames.
std::optional<MeasuredPicture> measureFrames(const FrameRequest& request, const Plan& plan,
                                             const std::function<bool()>& stopped);

}  // namespace dioptre
