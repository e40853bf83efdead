#include "render/geometry_pass.hpp"

#include "render/technique.hpp"

namespace dioptre {

void GeometryPass::resize(int width, int height, int msaa) {
    if (color_ && color_.width() == width && color_.height() == height && samplesColor_.spec().samples == msaa) return;
    color_ = Texture({GL_RGBA16F, width, height, 1, 0}, "geometry colour");
    depth_ = Texture({GL_DEPTH_COMPONENT32F, width, height, 1, 0}, "geometry depth");
    color_.setLinear(false);
    const Framebuffer::Attachment color[] = {{&color_, 0}};
    target_ = Framebuffer(color, &depth_, "geometry");
    samplesTarget_ = {};
    samplesColor_ = {};
    samplesDepth_ = {};
    if (msaa > 0) {
        samplesColor_ = Texture({GL_RGBA16F, width, height, 1, msaa}, "geometry colour, samples");
        samplesDepth_ = Texture({GL_DEPTH_COMPONENT32F, width, height, 1, msaa}, "geometry depth, samples");
        const Framebuffer::Attachment samples[] = {{&samplesColor_, 0}};
        samplesTarget_ = Framebuffer(samples, &samplesDepth_, "geometry, samples");
        if (!resolve_.program()) resolve_ = FullscreenPass("scene/resolve.frag.glsl");
    }
}

void GeometryPass::draw(const EyeFrame& frame) {
    const int msaa = frame.msaa;
    resize(frame.view.width, frame.view.height, msaa);
    {
        PassScope scope(frame.log, "geometry");
        const Framebuffer& drawn = msaa > 0 ? samplesTarget_ : target_;
        drawn.bind();
        const float black[] = {0.0f, 0.0f, 0.0f, 1.0f};
        const float infinitelyFar = 0.0f;
        glClearNamedFramebufferfv(drawn.name(), GL_COLOR, 0, black);
        glClearNamedFramebufferfv(drawn.name(), GL_DEPTH, 0, &infinitelyFar);
        frame.scene.drawRadiance(frame.view, frame.exposure, frame.detailPx, frame.sight);
    }
    if (msaa > 0) {
        PassScope scope(frame.log, "resolve");
        target_.bind();
        samplesColor_.bind(0);
        samplesDepth_.bind(1);
        resolve_.program().set("samples", msaa);
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_ALWAYS);
        resolve_.draw();
        glDepthFunc(GL_GREATER);
        glDisable(GL_DEPTH_TEST);
    } else {
        frame.log.skip("resolve", "one sample a pixel");
    }
}

std::size_t GeometryPass::bytes() const {
    std::size_t sum = 0;
    for (const Texture* texture : {&color_, &depth_, &samplesColor_, &samplesDepth_})
        if (*texture) sum += texture->bytes();
    return sum;
}

}  // namespace dioptre
