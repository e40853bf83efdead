#include "frame/vergence_sampler.hpp"

namespace dioptre {

namespace {

// Places along and across: a share of the picture is known to 1 %.
constexpr int kWidth = 64, kHeight = 48;
constexpr std::size_t kPlaces = std::size_t{kWidth} * kHeight;

}  // namespace

void VergenceSampler::start(const Texture& depth, Metres near, PassLog& log) {
    if (started_) return;
    PassScope scope(log, "depth statistics");
    if (!places_) {
        places_ = Texture({GL_R32F, kWidth, kHeight}, "depths for statistics");
        const Framebuffer::Attachment color[] = {{&places_}};
        target_ = Framebuffer(color, nullptr, "depths for statistics");
        pixels_ = Buffer(kPlaces * sizeof(float), nullptr, true, "depths for statistics");
    }
    const bool array = depth.spec().layers > 0;
    FullscreenPass& pass = array ? layered_ : plain_;
    if (!pass.program())
        pass = FullscreenPass("common/sample_depth.frag.glsl",
                              array ? std::vector<std::string>{"ARRAY"} : std::vector<std::string>{});
    target_.bind();
    depth.bind(0);
    pass.program().set("places", glm::vec2(kWidth, kHeight));
    pass.draw();
    glBindBuffer(GL_PIXEL_PACK_BUFFER, pixels_.name());
    glGetTextureImage(places_.name(), 0, GL_RED, GL_FLOAT, static_cast<GLsizei>(pixels_.bytes()), nullptr);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    fence_ = Fence::insert();
    near_ = near;
    started_ = true;
}

std::span<const double> VergenceSampler::vergences() {
    if (started_ && fence_.reached(false)) {
        started_ = false;
        std::vector<float> stored(kPlaces);
        glGetNamedBufferSubData(pixels_.name(), 0, static_cast<GLsizeiptr>(pixels_.bytes()), stored.data());
        vergences_.clear();
        for (const float depth : stored)
            if (depth > 0.0f) vergences_.push_back(static_cast<double>(depth) / near_.value);
    }
    return vergences_;
}

}  // namespace dioptre
