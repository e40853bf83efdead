#include "render/mipmap/mipmap.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "quality/requirements.hpp"
#include "shaders/shared/mipmap.h"

namespace dioptre {

namespace {

void setLayers(const Program& program, const CocTransform& coc, float baseLargest) {
    program.set("coc", glm::vec2(coc.scale, coc.bias));
    program.set("baseLargest", baseLargest);
}

}  // namespace

Mipmap::Blur Mipmap::requiredBlur(const EyeFrame& frame) {
    Blur blur;
    blur.coc = cocTransform(frame);
    const ViewContents seen = frame.scene.contents(frame.view);
    const auto nearest = static_cast<float>(seen.nearest * frame.view.near.value);
    // The background, infinitely far, counts too: it is seen wherever nothing is. No less than the radius below which
    // a foreground belongs to the base layer.
    blur.base = std::clamp(blur.coc.bias, mipmap::kFrontComplete, mipmap::kMostBaseRadius);
    blur.front = blur.coc.radius(nearest) < -mipmap::kFrontBegins;
    blur.any = std::max(std::abs(blur.coc.radius(nearest)), std::abs(blur.coc.bias)) > mipmap::kSharpRadius;
    return blur;
}

void Mipmap::makeTargets(Passes& passes, bool front) {
    passes.levels.clear();
    for (int level = 0; level < levelCount_; ++level) {
        std::vector<Framebuffer::Attachment> attachments{{&layers_, level, 0}};
        if (front)
            attachments.insert(attachments.end(), {{&layers_, level, 1}, {&layers_, level, 2}, {&spread_, level}});
        passes.levels.emplace_back(attachments, nullptr, "mipmap pyramid");
    }
    std::vector<Framebuffer::Attachment> blurred{{&behind_}};
    if (front) blurred.push_back({&front_});
    passes.blurred = Framebuffer(blurred, nullptr, "mipmap blur");
    if (passes.split.program()) return;
    const std::vector<std::string> defines = front ? std::vector<std::string>{"FRONT"} : std::vector<std::string>{};
    passes.split = FullscreenPass("mipmap/split.frag.glsl", defines);
    passes.down = FullscreenPass("mipmap/down.frag.glsl", defines);
    passes.blur = FullscreenPass("mipmap/blur.frag.glsl", defines);
    passes.composite = FullscreenPass("mipmap/composite.frag.glsl", defines);
}

void Mipmap::resize(int width, int height) {
    if (output_ && output_.width() == width && output_.height() == height) return;
    const int w = (width + 1) / 2, h = (height + 1) / 2;
    levelCount_ = static_cast<int>(std::bit_width(static_cast<unsigned>(std::max(w, h))));
    layers_ = Texture({GL_RGBA16F, w, h, levelCount_, 0, 3}, "mipmap layers");
    layers_.setLinear(true);
    spread_ = Texture({GL_RG16F, w, h, levelCount_}, "mipmap foreground radii");
    spread_.setLinear(true);
    reach_ = Texture(
        {GL_R16F, (w + mipmap::kReachTile - 1) / mipmap::kReachTile, (h + mipmap::kReachTile - 1) / mipmap::kReachTile},
        "mipmap foreground reach");
    behind_ = Texture({GL_RGBA16F, w, h}, "mipmap blur behind");
    behind_.setLinear(false);
    front_ = Texture({GL_RGBA16F, w, h}, "mipmap blur in front");
    front_.setLinear(false);
    output_ = Texture({GL_RGBA16F, width, height}, "mipmap picture");
    output_.setLinear(false);
    const Framebuffer::Attachment reach[] = {{&reach_}}, output[] = {{&output_}};
    reachTarget_ = Framebuffer(reach, nullptr, "mipmap foreground reach");
    outputTarget_ = Framebuffer(output, nullptr, "mipmap picture");
    makeTargets(behindOnly_, false);
    makeTargets(withFront_, true);
    if (!reachPass_.program()) reachPass_ = FullscreenPass("mipmap/reach.frag.glsl");
}

void Mipmap::buildPyramid(const Blur& blur, PassLog& log) {
    const Passes& passes = passesFor(blur);
    {
        PassScope scope(log, "split");
        passes.levels[0].bind();
        geometry_.color().bind(0);
        geometry_.depth().bind(1);
        setLayers(passes.split.program(), blur.coc, blur.base);
        passes.split.draw();
    }
    const int levels = pyramidLevels(blur.coc.bias, blur.front, levelCount_);
    if (levels < levelCount_) log.skip("pyramid's coarsest levels", "the largest blur does not read them");
    PassScope scope(log, "pyramid");
    const auto readLevels = [&](int first, int last) {
        for (const Texture* texture : {&layers_, &spread_}) {
            glTextureParameteri(texture->name(), GL_TEXTURE_BASE_LEVEL, first);
            glTextureParameteri(texture->name(), GL_TEXTURE_MAX_LEVEL, last);
        }
    };
    layers_.bind(0);
    spread_.bind(1);
    for (int level = 1; level < levels; ++level) {
        // Only the level above may be read while this one is written.
        readLevels(level - 1, level - 1);
        const Framebuffer& target = passes.levels[static_cast<std::size_t>(level)];
        target.bind();
        passes.down.program().set("targetSize", glm::vec2(target.width(), target.height()));
        passes.down.draw();
    }
    readLevels(0, levels - 1);
    builtLevels_ = levels;
}

void Mipmap::blurHalfSize(const Blur& blur, PassLog& log) {
    const Passes& passes = passesFor(blur);
    if (blur.front) {
        PassScope scope(log, "reach");
        reachTarget_.bind();
        spread_.bind(0);
        reachPass_.program().set("top", levelCount_ - 1);
        reachPass_.program().set("tiles", glm::vec2(reach_.width(), reach_.height()));
        reachPass_.draw();
    } else {
        log.skip("reach", "nothing lies so far in front of focus that it blurs");
        log.skip("foreground layers", "nothing lies so far in front of focus that it blurs");
    }
    PassScope scope(log, "blur");
    passes.blurred.bind();
    layers_.bind(0);
    geometry_.depth().bind(1);
    spread_.bind(2);
    reach_.bind(3);
    const Program& program = passes.blur.program();
    setLayers(program, blur.coc, blur.base);
    program.set("reachScale", glm::vec2(1.0f / mipmap::kReachTile));
    passes.blur.draw();
}

void Mipmap::composite(const Blur& blur, PassLog& log) {
    const Passes& passes = passesFor(blur);
    PassScope scope(log, "composite");
    outputTarget_.bind();
    geometry_.color().bind(0);
    geometry_.depth().bind(1);
    behind_.bind(2);
    front_.bind(3);
    setLayers(passes.composite.program(), blur.coc, blur.base);
    passes.composite.draw();
}

const Texture& Mipmap::draw(const EyeFrame& frame) {
    geometry_.draw(frame);
    resize(frame.view.width, frame.view.height);
    drawnMsaa_ = frame.msaa;
    const Blur blur = requiredBlur(frame);
    drawnFront_ = blur.front;
    drawnBlur_ = blur.any || frame.show.stage != ShowChoice::none;
    // Nothing out of focus anywhere: the pinhole picture is the picture.
    if (!drawnBlur_) {
        frame.log.skip("blur", "nothing is out of focus");
        return geometry_.color();
    }
    buildPyramid(blur, frame.log);
    blurHalfSize(blur, frame.log);
    if (frame.show.stage != ShowChoice::none) return show(frame, blur);
    composite(blur, frame.log);
    return output_;
}

const Texture& Mipmap::show(const EyeFrame& frame, const Blur& blur) {
    const ShowChoice stage = frame.show.stage;
    if (stage != ShowChoice::don && stage != ShowChoice::level && stage != ShowChoice::pyramid)
        return show_.draw(frame, geometry_.depth());
    PassScope scope(frame.log, "show");
    if (!showPass_.program()) showPass_ = FullscreenPass("mipmap/show.frag.glsl");
    show_.bindTarget(frame.view.width, frame.view.height);
    geometry_.depth().bind(0);
    reach_.bind(1);
    layers_.bind(2);
    const Program& program = showPass_.program();
    setLayers(program, blur.coc, blur.base);
    program.set("mode", stage == ShowChoice::don ? 0 : stage == ShowChoice::level ? 1 : 2);
    program.set("front", blur.front ? 1 : 0);
    program.set("level", std::min(frame.show.level, builtLevels_ - 1));
    program.set("size", glm::vec2(frame.view.width, frame.view.height));
    showPass_.draw();
    return show_.picture();
}

std::optional<double> Mipmap::fetchesPerPixel() const {
    if (!drawnBlur_) return GeometryPass::fetchesPerPixel(drawnMsaa_);
    // As the shaders read: split (colour, depth of 2×2), down (four taps a layer, of the radii a tap and a gather),
    // reach (7×7 and the top), blur (depth; its own taps; with a foreground what it hides, the reach, the nearer taps).
    constexpr double kHalf = 0.25, kTaps = 16.0, kLayers = 3.0;
    const double down = drawnFront_ ? 4.0 * (kLayers + 2.0) : 4.0;
    const double blur = 1.0 + kTaps + (drawnFront_ ? 2.0 + 4.0 + 1.0 + 2.0 * kTaps : 0.0);
    double sum = GeometryPass::fetchesPerPixel(drawnMsaa_) + kHalf * (8.0 + blur) + (drawnFront_ ? 4.0 : 3.0);
    if (drawnFront_) sum += kHalf * 50.0 / (mipmap::kReachTile * mipmap::kReachTile);
    for (int level = 1; level < builtLevels_; ++level) sum += kHalf * down * std::exp2(-2.0 * level);
    return sum;
}

std::size_t Mipmap::bytes() const {
    std::size_t sum = geometry_.bytes();
    for (const Texture* texture : {&layers_, &spread_, &reach_, &behind_, &front_, &output_})
        if (*texture) sum += texture->bytes();
    return sum;
}

}  // namespace dioptre
