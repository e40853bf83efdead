#include "render/sample_sum.hpp"

#include <algorithm>
#include <cmath>

namespace dioptre {

void SampleLayers::resize(int width, int height, int layers) {
    if (colors_ && colors_.width() == width && colors_.height() == height && colors_.spec().layers == layers) return;
    colors_ = Texture({GL_RGBA16F, width, height, 1, 0, layers}, label_);
    colors_.setLinear(false);
    depths_ = Texture({GL_DEPTH_COMPONENT32F, width, height, 1, 0, layers}, label_);
    const Framebuffer::Attachment colors[] = {{&colors_, 0, Framebuffer::kAllLayers}};
    target_ = Framebuffer(colors, &depths_, label_);
}

void SampleLayers::bind(bool clear) const {
    target_.bind();
    if (!clear) return;
    const float black[] = {0.0f, 0.0f, 0.0f, 1.0f};
    const float infinitelyFar = 0.0f;
    glClearNamedFramebufferfv(target_.name(), GL_COLOR, 0, black);
    glClearNamedFramebufferfv(target_.name(), GL_DEPTH, 0, &infinitelyFar);
}

void SampleLayers::clear(int first, int count) const {
    const float black[] = {0.0f, 0.0f, 0.0f, 1.0f};
    const float infinitelyFar = 0.0f;
    const int width = colors_.width(), height = colors_.height();
    glClearTexSubImage(colors_.name(), 0, 0, 0, first, width, height, count, GL_RGBA, GL_FLOAT, black);
    glClearTexSubImage(depths_.name(), 0, 0, 0, first, width, height, count, GL_DEPTH_COMPONENT, GL_FLOAT,
                       &infinitelyFar);
}

void SampleSum::begin(const EyeFrame& frame) {
    const auto& [width, height] = std::pair(frame.view.width, frame.view.height);
    const bool resized = !sum_ || sum_.width() != width || sum_.height() != height;
    if (resized) {
        sum_ = Texture({GL_RGBA32F, width, height}, "sum of samples");
        output_ = Texture({GL_RGBA32F, width, height}, "mean of samples");
        output_.setLinear(false);
        const Framebuffer::Attachment sum[] = {{&sum_}}, output[] = {{&output_}};
        sumTarget_ = Framebuffer(sum, nullptr, "sum of samples");
        outputTarget_ = Framebuffer(output, nullptr, "mean of samples");
        if (!add_.program()) {
            add_ = FullscreenPass("common/add_layers.frag.glsl");
            mean_ = FullscreenPass("common/mean.frag.glsl");
        }
    }
    const Key key{&frame.scene,      frame.view,       frame.lens, frame.exposure,       frame.samples,
                  frame.firstSample, frame.subsamples, frame.show, frame.scene.version()};
    if (frame.samplesNow > 0 && key == key_ && !resized) return;
    key_ = key;
    drawn_ = 0;
    weight_ = 0.0;
    const float zero[] = {0.0f, 0.0f, 0.0f, 0.0f};
    glClearNamedFramebufferfv(sumTarget_.name(), GL_COLOR, 0, zero);
}

void SampleSum::refine(const EyeFrame& frame, int most, const std::function<void(int)>& draw) {
    const int left = frame.samples - drawn_;
    const int end = drawn_ + (frame.samplesNow > 0 ? std::min(left, frame.samplesNow) : left);
    while (drawn_ < end) draw(std::min(most, end - drawn_));
}

void SampleSum::add(const SampleLayers& layers, int count) {
    layers.colors().bind(0);
    add_.program().set("count", count);
    addDrawn(add_, count, count);
}

void SampleSum::addDrawn(const FullscreenPass& pass, int count, int weight) {
    sumTarget_.bind();
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    pass.draw();
    glDisable(GL_BLEND);
    drawn_ += count;
    weight_ += weight;
}

const Texture& SampleSum::mean() {
    outputTarget_.bind();
    sum_.bind(0);
    mean_.program().set("scale", static_cast<float>(1.0 / weight_));
    mean_.draw();
    return output_;
}

float textureLodBias(int samples) {
    return -0.5f * std::log2(static_cast<float>(samples));
}

}  // namespace dioptre
