#include "frame/gaze_probe.hpp"

namespace dioptre {

namespace {

/// The part of a view that falls on a region of its pixels (from the top left), as a view of its own.
View cropped(const View& view, const PixelRegion& region) {
    View part = view;
    const Frustum& f = view.frustum;
    const double perX = (f.right - f.left) / view.width, perY = (f.top - f.bottom) / view.height;
    part.frustum.left = f.left + perX * region.x;
    part.frustum.right = part.frustum.left + perX * region.width;
    part.frustum.top = f.top - perY * region.y;
    part.frustum.bottom = part.frustum.top - perY * region.height;
    part.width = region.width;
    part.height = region.height;
    return part;
}

}  // namespace

std::vector<float> GazeProbe::readRegion(const GpuScene& scene, const View& eye, const PixelRegion& region) {
    if (!depth_ || depth_.width() != region.width || depth_.height() != region.height) {
        depth_ = Texture({GL_DEPTH_COMPONENT32F, region.width, region.height, 1, 0}, "depth under the gaze");
        target_ = Framebuffer({}, &depth_, "depth under the gaze");
    }
    target_.bind();
    const float infinitelyFar = 0.0f;
    glClearNamedFramebufferfv(target_.name(), GL_DEPTH, 0, &infinitelyFar);
    scene.drawDepth(cropped(eye, region));
    std::vector<float> vergence = readTexture(depth_, GL_DEPTH_COMPONENT, 1);
    for (float& z : vergence) z /= static_cast<float>(eye.near.value);
    return vergence;
}

std::optional<Dioptres> GazeProbe::vergence(const GpuScene& scene, std::span<const View> eyes, const View& centre,
                                            glm::dvec2 gaze, Radians error, PassLog& log) {
    PassScope scope(log, "gaze depth");
    const glm::dvec2 pixel = gaze * glm::dvec2(centre.width, centre.height);
    const glm::dvec2 sigma = coneSigmaPixels(centre, error);
    std::vector<std::vector<float>> depths;
    std::vector<EyeVergence> samples;
    for (const View& eye : eyes) {
        const MidpointShift shift = midpointShift(eye, centre);
        const PixelRegion region = gazeRegion(eye, shift, pixel, sigma);
        if (region.empty()) continue;
        depths.push_back(readRegion(scene, eye, region));
        samples.push_back({depths.back(), region, shift});
    }
    return gazeVergence(samples, pixel, sigma);
}

}  // namespace dioptre
