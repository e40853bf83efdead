#include "render/accumulate/subsample_blur.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "shaders/shared/accumulate_types.h"
#include "shaders/shared/scene_types.h"

namespace dioptre {

namespace {

int dividedUp(int value, int by) {
    return (value + by - 1) / by;
}

}  // namespace

void SubsampleBlur::resize(const Texture& depths) {
    if (width_ == depths.width() && height_ == depths.height() && layers_ == depths.spec().layers) return;
    width_ = depths.width();
    height_ = depths.height();
    layers_ = depths.spec().layers;
    const auto target = [&](int width, int height, std::string_view label) {
        Target made;
        made.texture = Texture({GL_RG32F, width, height, 1, 0, layers_}, label);
        const Framebuffer::Attachment all[] = {{&made.texture, 0, Framebuffer::kAllLayers}};
        made.framebuffer = Framebuffer(all, nullptr, label);
        return made;
    };
    int width = dividedUp(width_, gpu::kTileSide), height = dividedUp(height_, gpu::kTileSide);
    bounds_ = target(width, height, "bounds of lookups");
    squares_.clear();
    for (int side = 1, i = 0; i < gpu::kNBufferLevels && side <= std::max(width, height); ++i, side *= 2)
        squares_.push_back(target(width, height, "n-buffer"));
    reduction_.clear();
    do {
        width = dividedUp(width, gpu::kReduction);
        height = dividedUp(height, gpu::kReduction);
        reduction_.push_back(target(width, height, "bounds of all"));
    } while (width > 1 || height > 1);
    if (tilePass_.program()) return;
    tilePass_ = FullscreenPass::layered("accumulate/tiles.frag.glsl");
    reducePass_ = FullscreenPass::layered("accumulate/reduce.frag.glsl");
    nBufferPass_ = FullscreenPass::layered("accumulate/nbuffer.frag.glsl");
    boundPass_ = FullscreenPass::layered("accumulate/bounds.frag.glsl");
}

void SubsampleBlur::bound(const Group& group, double farthest) {
    squares_.front().framebuffer.bind();
    group.layers.depths().bind(0);
    tilePass_.draw(group.count);
    const Texture* finer = &squares_.front().texture;
    for (const Target& step : reduction_) {
        step.framebuffer.bind();
        finer->bind(0);
        reducePass_.draw(group.count);
        finer = &step.texture;
    }
    for (std::size_t i = 1; i < squares_.size(); ++i) {
        squares_[i].framebuffer.bind();
        squares_[i - 1].texture.bind(0);
        nBufferPass_.program().set("side", 1 << (i - 1));
        nBufferPass_.draw(group.count);
    }
    bounds_.framebuffer.bind();
    reduction_.back().texture.bind(0);
    for (int i = 0; i < gpu::kNBufferLevels; ++i)
        squares_[std::min(static_cast<std::size_t>(i), squares_.size() - 1)].texture.bind(static_cast<GLuint>(1 + i));
    const Program& program = boundPass_.program();
    program.set("levels", static_cast<int>(squares_.size()));
    program.set("coc", glm::vec2(group.coc.scale, group.coc.bias));
    program.set("farthest", static_cast<float>(farthest));
    program.set("stretch", static_cast<float>(group.stretch));
    boundPass_.draw(group.count);
}

void SubsampleBlur::add(const Group& group, const Subsamples& subsamples, SampleSum& sum) {
    resize(group.layers.depths());
    bound(group, subsamples.farthest);

    const auto first = subsamples.first.begin() + group.first;
    std::array<int, gpu::kMostMatrices + 1> firstOffset{};
    std::vector<glm::vec2> offsets;
    for (int i = 0; i <= group.count; ++i)
        firstOffset[static_cast<std::size_t>(i)] = std::min(first[i] - first[0], gpu::kMostOffsets);
    const int count = firstOffset[static_cast<std::size_t>(group.count)];
    offsets.reserve(static_cast<std::size_t>(std::max(1, count)));
    for (int i = 0; i < count; ++i)
        offsets.push_back(subsamples.offsets[static_cast<std::size_t>(first[0] + i)] *
                          glm::vec2(1.0f, static_cast<float>(group.stretch)));
    if (offsets.empty()) offsets.emplace_back(0.0f);

    group.layers.colors().bind(0);
    group.layers.depths().bind(1);
    bounds_.texture.bind(2);
    FullscreenPass& lookupPass = lookupPasses_[group.footprints.parts()];
    if (!lookupPass.program())
        lookupPass = FullscreenPass("accumulate/subsamples.frag.glsl", group.footprints.defines());
    const Program& program = lookupPass.program();
    program.set("count", group.count);
    program.set("firstOffset", std::span<const int>(firstOffset));
    program.set("offsets", std::span<const glm::vec2>(offsets));
    program.set("farthest", static_cast<float>(subsamples.farthest * std::max(1.0, group.stretch)));
    program.set("coc", glm::vec2(group.coc.scale, group.coc.bias));
    program.set("variances", glm::vec4(group.footprints.variance, kLeastVariance, splineVariance(gpu::kFineLevel),
                                       splineVariance(gpu::kCoarseLevel)));
    sum.addDrawn(lookupPass, group.count, group.count + count);
}

std::size_t SubsampleBlur::bytes() const {
    std::size_t sum = bounds_.texture ? bounds_.texture.bytes() : 0;
    for (const std::vector<Target>* targets : {&squares_, &reduction_})
        for (const Target& target : *targets) sum += target.texture.bytes();
    return sum;
}

}  // namespace dioptre
