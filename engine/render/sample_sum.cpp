#include "render/sample_sum.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <utility>

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

void SampleSum::allocate(int width, int height, int count, int levels) {
    // Whole or not at all: what is thrown leaves the sum as it was.
    std::vector<Texture> parts;
    const int coarsest = 1 << (levels - 1);
    const auto padded = [&](int size) { return (size + coarsest - 1) / coarsest * coarsest; };
    for (int i = 0; i < count; ++i) {
        const int mipmaps = i > 0 ? levels : 1;
        parts.emplace_back(TextureSpec{GL_RGBA32F, padded(width), padded(height), mipmaps}, "sum of samples");
        parts.back().setLinear(mipmaps > 1);
    }
    std::vector<Framebuffer::Attachment> targets;
    targets.reserve(parts.size());
    for (const Texture& part : parts) targets.push_back({&part});
    Framebuffer target(targets, nullptr, "sum of samples");
    parts_ = std::move(parts);
    sumTarget_ = std::move(target);
    levels_ = levels;
}

void SampleSum::clear() {
    drawn_ = 0;
    weight_ = 0.0;
    const float zero[] = {0.0f, 0.0f, 0.0f, 0.0f};
    for (GLint i = 0; i < static_cast<GLint>(parts_.size()); ++i)
        glClearNamedFramebufferfv(sumTarget_.name(), GL_COLOR, i, zero);
}

void SampleSum::begin(const EyeFrame& frame) {
    const int width = frame.view.width, height = frame.view.height;
    const bool resized = !output_ || output_.width() != width || output_.height() != height;
    if (resized) {
        Texture output({GL_RGBA32F, width, height}, "mean of samples");
        output.setLinear(false);
        const Framebuffer::Attachment target[] = {{&output}};
        Framebuffer outputTarget(target, nullptr, "mean of samples");
        allocate(width, height, static_cast<int>(std::max<std::size_t>(1, parts_.size())), levels_);
        output_ = std::move(output);
        outputTarget_ = std::move(outputTarget);
        if (!add_.program()) {
            add_ = FullscreenPass("common/add_layers.frag.glsl");
            mean_ = FullscreenPass("common/mean.frag.glsl");
        }
    }
    const Key key{&frame.scene,      frame.view,       frame.lens, frame.exposure,       frame.samples,
                  frame.firstSample, frame.subsamples, frame.show, frame.scene.version()};
    if (frame.samplesNow > 0 && key == key_ && !resized) return;
    key_ = key;
    clear();
}

void SampleSum::divide(int parts, int levels) {
    assert(drawn_ == 0 && "a sum is divided before anything is added to it");
    if (parts_.size() == static_cast<std::size_t>(parts) && levels_ == levels) return;
    allocate(output_.width(), output_.height(), parts, levels);
    clear();
}

void SampleSum::refine(const EyeFrame& frame, int most, const std::function<void(int)>& draw) {
    const int left = frame.samples - drawn_;
    const int end = drawn_ + (frame.samplesNow > 0 ? std::min(left, frame.samplesNow) : left);
    while (drawn_ < end) {
        draw(std::min(most, end - drawn_));
        if (frame.onDrawn) {
            glFinish();  // or it would be told of what is but queued
            frame.onDrawn(progress());
        }
    }
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
    assert(parts_.size() == 1);
    return mean(mean_);
}

const Texture& SampleSum::mean(const FullscreenPass& pass) {
    for (GLuint i = 0; i < parts_.size(); ++i) {
        if (parts_[i].spec().levels > 1) glGenerateTextureMipmap(parts_[i].name());
        parts_[i].bind(i);
    }
    outputTarget_.bind();
    pass.program().set("scale", static_cast<float>(1.0 / weight_));
    pass.draw();
    return output_;
}

std::size_t SampleSum::bytes() const {
    if (!output_) return 0;
    return std::accumulate(parts_.begin(), parts_.end(), output_.bytes(),
                           [](std::size_t sum, const Texture& part) { return sum + part.bytes(); });
}

float textureLodBias(int samples) {
    return -0.5f * std::log2(static_cast<float>(samples));
}

}  // namespace dioptre
