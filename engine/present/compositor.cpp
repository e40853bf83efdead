#include "present/compositor.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace dioptre {

PictureSize composedSize(DisplayChoice display, PictureSize eye) {
    if (display == DisplayChoice::sideBySide) return {eye.width * 2, eye.height};
    if (display == DisplayChoice::topBottom) return {eye.width, eye.height * 2};
    return eye;
}

Placement fitted(PictureSize picture, PictureSize window) {
    const double scale = std::min(static_cast<double>(window.width) / picture.width,
                                  static_cast<double>(window.height) / picture.height);
    Placement place;
    place.width = std::max(1, static_cast<int>(std::lround(picture.width * scale)));
    place.height = std::max(1, static_cast<int>(std::lround(picture.height * scale)));
    place.x = (window.width - place.width) / 2;
    place.y = (window.height - place.height) / 2;
    return place;
}

namespace {

std::string defineOf(DisplayChoice display) {
    switch (display) {
        case DisplayChoice::mono:
            return "MONO";
        case DisplayChoice::sideBySide:
            return "SIDE_BY_SIDE";
        case DisplayChoice::sideBySideHalf:
            return "SIDE_BY_SIDE_HALF";
        case DisplayChoice::topBottom:
            return "TOP_BOTTOM";
        case DisplayChoice::anaglyph:
            return "ANAGLYPH";
    }
    return "MONO";
}

bool sameSize(const Composition& c) {
    return c.left.width() == c.eye.width && c.left.height() == c.eye.height;
}

}  // namespace

const FullscreenPass& Compositor::passFor(const Composition& composition, bool encode) {
    const bool smaller = !sameSize(composition);
    FullscreenPass& pass = passes_[{composition.display, composition.tonemap, encode, smaller}];
    if (pass.program()) return pass;
    std::vector<std::string> defines = {defineOf(composition.display)};
    if (composition.tonemap == ToneMapChoice::neutral) defines.emplace_back("NEUTRAL");
    if (encode) defines.emplace_back("ENCODE");
    if (smaller) defines.emplace_back("SMALLER");
    pass = FullscreenPass("present/compose.frag.glsl", defines);
    return pass;
}

void Compositor::draw(const Composition& composition, const Placement& place, bool encode) {
    const bool swapped = composition.swapEyes && composition.display != DisplayChoice::mono;
    (swapped ? composition.right : composition.left).bind(0);
    (swapped ? composition.left : composition.right).bind(1);
    const FullscreenPass& pass = passFor(composition, encode);
    const Program& program = pass.program();
    program.set("origin", glm::vec2(place.x, place.y));
    program.set("size", glm::vec2(place.width, place.height));
    program.set("eyeSize", glm::vec2(composition.eye.width, composition.eye.height));
    pass.draw();
}

const Texture& Compositor::compose(const Composition& composition, PassLog& log) {
    PassScope scope(log, "compose");
    const PictureSize size = composedSize(composition.display, composition.eye);
    if (!output_ || output_.width() != size.width || output_.height() != size.height) {
        output_ = Texture({GL_RGBA32F, size.width, size.height, 1, 0}, "composed picture");
        output_.setLinear(false);
        const Framebuffer::Attachment color[] = {{&output_, 0}};
        target_ = Framebuffer(color, nullptr, "composed picture");
    }
    target_.bind();
    draw(composition, {0, 0, size.width, size.height}, false);
    return output_;
}

void Compositor::present(const Placement& area, PassLog& log) {
    PassScope scope(log, "present");
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    glClearColor(0.0f, 0.0f, 0.0f, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT);
    Placement place = fitted({output_.width(), output_.height()}, {area.width, area.height});
    place.x += area.x;
    place.y += area.y;
    glViewport(place.x, place.y, place.width, place.height);
    draw({output_, output_, {output_.width(), output_.height()}}, place, true);
}

}  // namespace dioptre
