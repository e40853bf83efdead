#include "present/compositor.hpp"

namespace dioptre {

PictureSize composedSize(DisplayChoice display, PictureSize eye) {
    if (display == DisplayChoice::sideBySide) return {eye.width * 2, eye.height};
    if (display == DisplayChoice::topBottom) return {eye.width, eye.height * 2};
    return eye;
}

void Compositor::draw(const Composition& composition, int width, int height, bool encode) {
    if (!pass_.program()) pass_ = FullscreenPass("present/compose.frag.glsl");
    const bool swapped = composition.swapEyes && composition.display != DisplayChoice::mono;
    (swapped ? composition.right : composition.left).bind(0);
    (swapped ? composition.left : composition.right).bind(1);
    const int mode = [&] {
        switch (composition.display) {
            case DisplayChoice::mono:
                return 0;
            case DisplayChoice::sideBySide:
                return 1;
            case DisplayChoice::sideBySideHalf:
                return 2;
            case DisplayChoice::topBottom:
                return 3;
            case DisplayChoice::anaglyph:
                return 4;
        }
        return 0;
    }();
    const Program& program = pass_.program();
    program.set("mode", mode);
    program.set("size", glm::vec2(width, height));
    program.set("neutral", composition.tonemap == ToneMapChoice::neutral ? 1 : 0);
    program.set("encode", encode ? 1 : 0);
    pass_.draw();
}

const Texture& Compositor::compose(const Composition& composition, PassLog& log) {
    PassScope scope(log, "compose");
    const PictureSize size = composedSize(composition.display, {composition.left.width(), composition.left.height()});
    if (!output_ || output_.width() != size.width || output_.height() != size.height) {
        output_ = Texture({GL_RGBA32F, size.width, size.height, 1, 0}, "composed picture");
        output_.setLinear(false);
        const Framebuffer::Attachment color[] = {{&output_, 0}};
        target_ = Framebuffer(color, nullptr, "composed picture");
    }
    target_.bind();
    draw(composition, size.width, size.height, false);
    return output_;
}

void Compositor::present(int width, int height, PassLog& log) {
    PassScope scope(log, "present");
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    glViewport(0, 0, width, height);
    draw({output_, output_, DisplayChoice::mono, false, ToneMapChoice::none}, width, height, true);
}

}  // namespace dioptre
