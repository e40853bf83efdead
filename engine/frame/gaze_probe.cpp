#include "frame/gaze_probe.hpp"

namespace dioptre {

namespace {

// The median over a cone tells no finer.
constexpr double kDetailPx = 1.0;

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

void GazeProbe::drawRegion(const GpuScene& scene, const View& eye, EyeReading& reading) {
    const PixelRegion& region = reading.region;
    if (!depth_ || depth_.width() != region.width || depth_.height() != region.height) {
        depth_ = Texture({GL_DEPTH_COMPONENT32F, region.width, region.height, 1, 0}, "depth under the gaze");
        target_ = Framebuffer({}, &depth_, "depth under the gaze");
    }
    target_.bind();
    const float infinitelyFar = 0.0f;
    glClearNamedFramebufferfv(target_.name(), GL_DEPTH, 0, &infinitelyFar);
    scene.drawDepth(cropped(eye, region), kDetailPx);
    const std::size_t bytes = static_cast<std::size_t>(region.width) * static_cast<std::size_t>(region.height) * 4;
    reading.pixels = Buffer(bytes, nullptr, true, "depth under the gaze");
    glBindBuffer(GL_PIXEL_PACK_BUFFER, reading.pixels.name());
    glGetTextureImage(depth_.name(), 0, GL_DEPTH_COMPONENT, GL_FLOAT, static_cast<GLsizei>(bytes), nullptr);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
}

void GazeProbe::start(const GpuScene& scene, std::span<const View> eyes, const View& centre, glm::dvec2 gaze,
                      Radians error, PassLog& log) {
    PassScope scope(log, "gaze depth");
    pixel_ = gaze * glm::dvec2(centre.width, centre.height);
    sigma_ = coneSigmaPixels(centre, error);
    eyes_.clear();
    for (const View& eye : eyes) {
        EyeReading reading;
        reading.shift = midpointShift(eye, centre);
        reading.region = gazeRegion(eye, reading.shift, pixel_, sigma_);
        reading.near = eye.near.value;
        if (reading.region.empty()) continue;
        drawRegion(scene, eye, reading);
        eyes_.push_back(std::move(reading));
    }
    fence_ = Fence::insert();
    started_ = true;
}

std::optional<GazeProbe::Reading> GazeProbe::finish(bool wait) {
    if (!started_ || !fence_.reached(wait)) return std::nullopt;
    started_ = false;
    std::vector<std::vector<float>> depths;
    std::vector<EyeVergence> samples;
    for (const EyeReading& eye : eyes_) {
        const auto width = static_cast<std::size_t>(eye.region.width),
                   height = static_cast<std::size_t>(eye.region.height);
        std::vector<float> stored(width * height), vergence(width * height);
        glGetNamedBufferSubData(eye.pixels.name(), 0, static_cast<GLsizeiptr>(stored.size() * sizeof(float)),
                                stored.data());
        // Stored depth is near × vergence; the top row comes first from here on.
        for (std::size_t y = 0; y < height; ++y)
            for (std::size_t x = 0; x < width; ++x)
                vergence[y * width + x] =
                    static_cast<float>(static_cast<double>(stored[(height - 1 - y) * width + x]) / eye.near);
        depths.push_back(std::move(vergence));
        samples.push_back({depths.back(), eye.region, eye.shift});
    }
    return Reading{gazeVergence(samples, pixel_, sigma_)};
}

std::optional<Dioptres> GazeProbe::vergence(const GpuScene& scene, std::span<const View> eyes, const View& centre,
                                            glm::dvec2 gaze, Radians error, PassLog& log) {
    start(scene, eyes, centre, gaze, error, log);
    return finish(true)->vergence;
}

}  // namespace dioptre
