#include "frame/eye_picture.hpp"

#include <algorithm>
#include <cmath>

namespace dioptre {

const Texture& EyePicture::draw(const Plan& plan, const EyeFrame& frame) {
    std::unique_ptr<Technique>& technique = techniques_[static_cast<std::size_t>(plan.technique)];
    if (!technique) technique = makeTechnique(plan.technique);
    drawnBy_ = technique.get();
    View view = frame.view;
    const auto sized = [&](int side) { return std::max(1, static_cast<int>(std::lround(side * plan.eighths / 8.0))); };
    view.width = sized(view.width);
    view.height = sized(view.height);
    EyeFrame sizedFrame{frame.scene, view, frame.lens, frame.exposure, 0, frame.show, frame.log};
    apply(plan, sizedFrame);
    sizedFrame.firstSample = frame.firstSample;
    sizedFrame.samplesNow = frame.samplesNow;
    sizedFrame.sight = frame.sight;
    sizedFrame.onDrawn = frame.onDrawn;
    return technique->draw(sizedFrame);
}

/// To the frame's size, over what is there with that weight.
void EyePicture::stretch(const Texture& picture, double weight, Canvas& onto, const EyeFrame& frame) {
    PassScope scope(frame.log, weight < 1.0 ? "fade" : "stretch");
    const int width = frame.view.width, height = frame.view.height;
    if (!onto.picture || onto.picture.width() != width || onto.picture.height() != height) {
        onto.picture = Texture({GL_RGBA16F, width, height}, "stretched picture");
        onto.picture.setLinear(false);
        const Framebuffer::Attachment color[] = {{&onto.picture}};
        onto.target = Framebuffer(color, nullptr, "stretched picture");
    }
    if (!stretchPass_.program()) stretchPass_ = FullscreenPass("common/stretch.frag.glsl");
    onto.target.bind();
    picture.bind(0);
    stretchPass_.program().set("size", glm::vec2(width, height));
    if (weight < 1.0) {
        glEnable(GL_BLEND);
        glBlendColor(0.0f, 0.0f, 0.0f, static_cast<float>(weight));
        glBlendFunc(GL_CONSTANT_ALPHA, GL_ONE_MINUS_CONSTANT_ALPHA);
    }
    stretchPass_.draw();
    glDisable(GL_BLEND);
}

const Texture& EyePicture::fade(const Plan& from, const Plan& to, double weight, const EyeFrame& frame) {
    stretch(draw(from, frame), 1.0, stretched_, frame);
    stretch(draw(to, frame), weight, stretched_, frame);
    return stretched_.picture;
}

const Texture& EyePicture::refine(const Plan& plan, int samplesNow, const EyeFrame& frame) {
    if (!refining_) refining_ = makeTechnique(plan.technique);
    EyeFrame more{frame.scene, frame.view, frame.lens, frame.exposure, 0, frame.show, frame.log};
    apply(plan, more);
    more.samplesNow = samplesNow;
    more.sight = frame.sight;
    const Texture& picture = refining_->draw(more);
    refinedSamples_ = static_cast<int>(std::lround(refining_->progress() * more.samples));
    return picture;
}

std::size_t EyePicture::bytes() const {
    std::size_t sum = 0;
    for (const Canvas* canvas : {&stretched_, &remembered_})
        if (canvas->picture) sum += canvas->picture.bytes();
    for (const auto& technique : techniques_)
        if (technique) sum += technique->bytes();
    return refining_ ? sum + refining_->bytes() : sum;
}

}  // namespace dioptre
