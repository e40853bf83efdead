#include "render/reference/reference.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "optics/lens_samples.hpp"

namespace dioptre {

void Reference::resize(int width, int height, int layers) {
    if (sum_ && sum_.width() == width && sum_.height() == height) return;
    colors_ = Texture({GL_RGBA16F, width, height, 1, 0, layers}, "reference samples");
    depths_ = Texture({GL_DEPTH_COMPONENT32F, width, height, 1, 0, layers}, "reference samples' depth");
    sum_ = Texture({GL_RGBA32F, width, height}, "reference sum");
    output_ = Texture({GL_RGBA32F, width, height}, "reference picture");
    output_.setLinear(false);
    const Framebuffer::Attachment batch[] = {{&colors_, 0, Framebuffer::kAllLayers}}, sum[] = {{&sum_}},
                                  output[] = {{&output_}};
    batchTarget_ = Framebuffer(batch, &depths_, "reference samples");
    sumTarget_ = Framebuffer(sum, nullptr, "reference sum");
    outputTarget_ = Framebuffer(output, nullptr, "reference picture");
    if (!accumulate_.program()) {
        accumulate_ = FullscreenPass("reference/accumulate.frag.glsl");
        average_ = FullscreenPass("reference/average.frag.glsl");
    }
}

void Reference::addBatch(const EyeFrame& frame, int count) {
    if (prepared_ != count) {
        frame.scene.prepareThroughLens(frame.view, frame.lens, count);
        prepared_ = count;
    }
    std::vector<glm::mat4> clips;
    clips.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i)
        clips.emplace_back(
            clipFromView(frame.view, frame.lens, lensSample(frame.firstSample + drawn_ + i, frame.lens)));
    batchTarget_.bind();
    const float black[] = {0.0f, 0.0f, 0.0f, 1.0f};
    const float infinitelyFar = 0.0f;
    glClearNamedFramebufferfv(batchTarget_.name(), GL_COLOR, 0, black);
    glClearNamedFramebufferfv(batchTarget_.name(), GL_DEPTH, 0, &infinitelyFar);
    const float lodBias = -0.5f * std::log2(static_cast<float>(frame.samples));
    frame.scene.drawThroughLens(clips, frame.exposure, lodBias);

    sumTarget_.bind();
    colors_.bind(0);
    accumulate_.program().set("count", count);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    accumulate_.draw();
    glDisable(GL_BLEND);
    drawn_ += count;
}

const Texture& Reference::draw(const EyeFrame& frame) {
    if (frame.show.stage != ShowChoice::none) {
        geometry_.draw(frame.scene, frame.view, frame.exposure, 0, frame.log);
        return show_.draw(frame, geometry_.depth());
    }
    const double start = nowMilliseconds();
    const int layers = GpuScene::mostMatrices();
    resize(frame.view.width, frame.view.height, layers);
    const Key key{&frame.scene,
                  frame.view,
                  frame.lens,
                  frame.exposure,
                  frame.samples,
                  frame.firstSample,
                  frame.scene.poseNumber()};
    if (frame.budgetMilliseconds <= 0.0 || key != key_) {
        key_ = key;
        drawn_ = 0;
        const float zero[] = {0.0f, 0.0f, 0.0f, 0.0f};
        glClearNamedFramebufferfv(sumTarget_.name(), GL_COLOR, 0, zero);
    }
    // Others may have prepared the scene for another view since.
    prepared_ = 0;
    {
        PassScope scope(frame.log, "samples");
        while (drawn_ < frame.samples) {
            addBatch(frame, std::min(layers, frame.samples - drawn_));
            if (frame.budgetMilliseconds <= 0.0) continue;
            glFinish();
            if (nowMilliseconds() - start >= frame.budgetMilliseconds) break;
        }
    }
    PassScope scope(frame.log, "average");
    outputTarget_.bind();
    sum_.bind(0);
    average_.program().set("scale", 1.0f / static_cast<float>(drawn_));
    average_.draw();
    return output_;
}

std::size_t Reference::bytes() const {
    std::size_t sum = geometry_.bytes();
    for (const Texture* texture : {&colors_, &depths_, &sum_, &output_})
        if (*texture) sum += texture->bytes();
    return sum;
}

}  // namespace dioptre
