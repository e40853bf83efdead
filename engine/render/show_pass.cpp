#include "render/show_pass.hpp"

#include "core/error.hpp"

namespace dioptre {

void ShowPass::bindTarget(int width, int height) {
    if (!output_ || output_.width() != width || output_.height() != height) {
        output_ = Texture({GL_RGBA16F, width, height, 1, 0}, "shown stage");
        output_.setLinear(false);
        const Framebuffer::Attachment color[] = {{&output_, 0}};
        target_ = Framebuffer(color, nullptr, "shown stage");
    }
    target_.bind();
}

const Texture& ShowPass::draw(const EyeFrame& frame, const Texture& depth) {
    int mode = 0;
    switch (frame.show.stage) {
        case ShowChoice::vergence:
            mode = 0;
            break;
        case ShowChoice::coc:
            mode = 1;
            break;
        case ShowChoice::dob:
            mode = 2;
            break;
        default:
            throw InputError(
                "--show: don, level and pyramid are stages of --technique mipmap, lod is one of accumulate; all have "
                "vergence, coc, dob");
    }
    PassScope scope(frame.log, "show");
    if (!fromDepth_.program()) fromDepth_ = FullscreenPass("common/show_depth.frag.glsl");
    bindTarget(frame.view.width, frame.view.height);
    const CocTransform coc = cocTransform(frame);
    depth.bind(0);
    const Program& program = fromDepth_.program();
    program.set("mode", mode);
    program.set("coc", glm::vec2(coc.scale, coc.bias));
    program.set("near", static_cast<float>(frame.view.near.value));
    fromDepth_.draw();
    return output_;
}

}  // namespace dioptre
