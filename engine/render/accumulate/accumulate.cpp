#include "render/accumulate/accumulate.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

#include "optics/lens_samples.hpp"
#include "render/accumulate/detail.hpp"
#include "shaders/shared/accumulate_types.h"

namespace dioptre {

namespace {

// Cells of half a pixel: the smoother of the two published, and edges of what is sharp are what is looked at.
constexpr int kGrid = 2;
// Below that share of the samples, renderings that they share are worth their copies.
constexpr double kWorthSharing = 0.65;
constexpr int kMostSprites = 40;  // 12 bytes a pixel each
// CoC radii, px. From 65 samples on more cells are taken beyond it than there are sprites.
constexpr double kMostSharedRadius = 2.0;
constexpr double kSharedRadiusStep = 0.125;  // in which the largest is looked for

std::vector<LensSample> samplesOf(const EyeFrame& frame) {
    std::vector<LensSample> samples;
    samples.reserve(static_cast<std::size_t>(frame.samples));
    for (int i = 0; i < frame.samples; ++i) samples.push_back(lensSample(frame.firstSample + i, frame.lens));
    return samples;
}

std::vector<glm::mat4> clipsOf(const EyeFrame& frame, std::span<const LensSample> samples) {
    std::vector<glm::mat4> clips;
    clips.reserve(samples.size());
    for (const LensSample& sample : samples) clips.emplace_back(clipFromView(frame.view, frame.lens, sample));
    return clips;
}

/// Of what is drawn for each sample. N samples filter a pixel; of what is blurred by a CoC radius c they lie
/// c sqrt(pi / (N (S + 1))) apart, sub-samples included, and texels of half that, between which textures are read, are
/// fine enough: finer ones would make noise of it.
TextureFilter textureFilter(const EyeFrame& frame) {
    const auto spread = static_cast<float>(0.5 * std::sqrt(std::numbers::pi / (frame.subsamples + 1)));
    const CocTransform coc = cocTransform(frame);
    return {textureLodBias(frame.samples), {coc.scale * spread, coc.bias * spread}};
}

/// White is the finest; then blue to green to red, from level 1 to 8 and coarser.
glm::vec3 levelColor(int level) {
    if (level == 0) return glm::vec3(1.0f);
    const float along = std::min(1.0f, static_cast<float>(level - 1) / 7.0f);
    const glm::vec3 blue(0.1f, 0.3f, 1.0f), green(0.2f, 1.0f, 0.2f), red(1.0f, 0.1f, 0.05f);
    return along < 0.5f ? glm::mix(blue, green, along * 2.0f) : glm::mix(green, red, along * 2.0f - 1.0f);
}

}  // namespace

void Accumulate::makePlan(const EyeFrame& frame) {
    plan_ = {};
    std::vector<double> blur;
    for (const DrawList::Seen& seen : list_.seen()) {
        plan_.levels.push_back(detailLevel(frame.view, frame.lens, seen));
        blur.push_back(cocExtent(frame.view, frame.lens, seen.box).largest);
    }
    if (frame.subsamples > 0)
        plan_.footprints =
            requiredFootprints(frame.view, frame.lens, frame.samples * (frame.subsamples + 1.0), list_.seen());
    bool any = false;
    for (std::size_t i = 0; i < blur.size(); ++i) {
        plan_.shared.push_back(!list_.seen()[i].blended && blur[i] <= sharing_.radius);
        any = any || plan_.shared.back();
    }
    if (any) plan_.sharing = sharing_.renderings;
}

void Accumulate::prepareSamples(const EyeFrame& frame) {
    const SampleKey key{frame.samples, frame.subsamples, frame.firstSample, frame.lens.blades,
                        frame.lens.bladeRotation};
    if (key == sampleKey_) return;
    sampleKey_ = {};
    subsamples_ = subsamples(frame.samples, frame.subsamples, frame.lens, frame.firstSample);
    sharing_ = sharingOf(frame);
    sampleKey_ = key;
}

/// Cells of the largest CoC that few enough renderings do for. With those of the most blurred item that shares them, all
/// edges in focus flickered whenever that became another one or its blur changed: of the 0.0094 that
/// `bench_accumulate pops` found in the focus pull, this left 0.0023.
Accumulate::Sharing Accumulate::sharingOf(const EyeFrame& frame) {
    const auto most = std::min(kWorthSharing * frame.samples, double{kMostSprites});
    // Without a choice of layers there is nothing to draw sprites to.
    if (most < kLeastJitters || GpuScene::mostMatrices() < gpu::kMostMatrices) return {};
    const std::vector<LensSample> samples = samplesOf(frame);
    for (double radius = kMostSharedRadius; radius >= 0.0; radius -= kSharedRadiusStep) {
        SharedRenderings renderings = shareRenderings(samples, radius, kGrid);
        const std::size_t count = renderings.parents.size();
        if (count >= kLeastJitters && static_cast<double>(count) <= most) return {radius, std::move(renderings)};
    }
    return {};
}

std::vector<std::int8_t> Accumulate::levelsFor(bool shared, int first, int count, int total) const {
    std::vector<std::int8_t> levels(plan_.levels.size(), DrawList::kHidden);
    for (std::size_t i = 0; i < levels.size(); ++i)
        if (plan_.shared[i] == shared)
            levels[i] = static_cast<std::int8_t>(levelOfSample(plan_.levels[i], first + count / 2, total));
    return levels;
}

void Accumulate::drawSprites(const EyeFrame& frame, int needed) {
    if (needed <= sprites_.drawn) return;
    PassScope scope(frame.log, "sprites");
    const std::span<const LensSample> parents(plan_.sharing.parents);
    // By steps, so that samples that become more or fewer do not need others in each frame.
    constexpr int kStep = 8;
    sprites_.layers.resize(frame.view.width, frame.view.height,
                           (static_cast<int>(parents.size()) + kStep - 1) / kStep * kStep);
    arrangedFor_ = 0;
    while (sprites_.drawn < needed) {
        const int first = sprites_.drawn, count = std::min(gpu::kMostMatrices, needed - first);
        sprites_.layers.clear(first, count);
        sprites_.layers.bind(false);
        frame.scene.arrange(list_, count, levelsFor(true, first, count, static_cast<int>(parents.size())));
        frame.scene.drawThroughLens(
            list_, clipsOf(frame, parents.subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(count))),
            frame.exposure, TextureFilter{textureLodBias(static_cast<int>(parents.size()))}, first);
        sprites_.drawn += count;
    }
}

void Accumulate::beginWithSprites(int first, int count) {
    if (!spritePass_.program()) spritePass_ = FullscreenPass::layered("accumulate/sprites.frag.glsl");
    sprites_.layers.colors().bind(0);
    sprites_.layers.depths().bind(1);
    const auto parentOf = plan_.sharing.parentOf.begin() + first;
    spritePass_.program().set("spriteOf", std::vector<int>(parentOf, parentOf + count));
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_ALWAYS);
    spritePass_.draw(count);
    glDepthFunc(GL_GREATER);
    glDisable(GL_DEPTH_TEST);
}

void Accumulate::drawGroup(const EyeFrame& frame, int count) {
    const int first = sum_.drawn();
    const bool shares = !plan_.sharing.parents.empty();
    if (shares) {
        const auto parentOf = plan_.sharing.parentOf.begin() + first;
        drawSprites(frame, *std::max_element(parentOf, parentOf + count) + 1);
    }
    std::vector<std::int8_t> levels = levelsFor(false, first, count, frame.samples);
    if (levels != arranged_ || count != arrangedFor_) {
        frame.scene.arrange(list_, count, levels);
        arranged_ = std::move(levels);
        arrangedFor_ = count;
    }
    {
        PassScope scope(frame.log, "samples");
        layers_.bind(!shares);
        if (shares) beginWithSprites(first, count);
        std::vector<LensSample> samples;
        samples.reserve(static_cast<std::size_t>(count));
        for (int i = 0; i < count; ++i) samples.push_back(lensSample(frame.firstSample + first + i, frame.lens));
        frame.scene.drawThroughLens(list_, clipsOf(frame, samples), frame.exposure, textureFilter(frame));
    }
    if (frame.subsamples == 0) {
        PassScope scope(frame.log, "sum");
        sum_.add(layers_, count);
        return;
    }
    PassScope scope(frame.log, "sub-samples");
    const glm::dvec2 f = focalLengthPixels(frame.view);
    blur_.add({layers_, first, count, cocTransform(frame), f.y / f.x, plan_.footprints}, subsamples_, sum_);
}

const Texture& Accumulate::showLevels(const EyeFrame& frame) {
    layers_.resize(frame.view.width, frame.view.height, GpuScene::mostMatrices());
    EyeFrame anew = frame;
    anew.samplesNow = 0;
    sum_.begin(anew);
    frame.scene.see(list_, frame.view, nullptr);
    makePlan(frame);
    sum_.divide(1, 1);
    const int levels = list_.seen().empty() ? 0 : std::ranges::max(list_.seen(), {}, &DrawList::Seen::levels).levels();
    const glm::mat4 clip(clipFromView(frame.view));
    PassScope scope(frame.log, "show");
    // Blended surfaces keep their own colours.
    // The mean of the picture in the levels' colours and of these alone: what outshines all that half floats hold is
    // cut to one value.
    constexpr float kMostRadiance = 65504.0f, kOutshining = 1e30f;
    for (const auto& [exposure, scale] : {std::pair(frame.exposure, 1.0f), {kOutshining, 1.0f / kMostRadiance}}) {
        layers_.bind(true);
        for (int level = 0; level < levels; ++level) {
            std::vector<std::int8_t> only(plan_.levels.size(), DrawList::kHidden);
            for (std::size_t i = 0; i < only.size(); ++i)
                if (static_cast<int>(std::lround(plan_.levels[i])) == level) only[i] = static_cast<std::int8_t>(level);
            frame.scene.arrange(list_, 1, only);
            const glm::vec3 color = levelColor(level) * scale;
            glEnable(GL_BLEND);
            glBlendColor(color.r, color.g, color.b, 1.0f);
            glBlendFunc(GL_CONSTANT_COLOR, GL_ZERO);
            frame.scene.drawThroughLens(list_, {&clip, 1}, exposure, {});
            glDisable(GL_BLEND);
        }
        sum_.add(layers_, 1);
    }
    arrangedFor_ = 0;
    return sum_.mean();
}

const Texture& Accumulate::draw(const EyeFrame& frame) {
    showsStage_ = frame.show.stage != ShowChoice::none;
    if (frame.show.stage == ShowChoice::lod) return showLevels(frame);
    if (showsStage_) {
        geometry_.draw(frame);
        return show_.draw(frame, geometry_.depth());
    }
    const int layers = GpuScene::mostMatrices();
    layers_.resize(frame.view.width, frame.view.height, layers);
    sum_.begin(frame);
    if (sum_.drawn() < frame.samples) {
        frame.scene.see(list_, frame.view, &frame.lens, frame.sight);
        arrangedFor_ = 0;
    }
    assert(sum_.drawn() == 0 || plan_.levels.size() == list_.seen().size());
    if (sum_.drawn() == 0) {
        prepareSamples(frame);
        makePlan(frame);
        sum_.divide(plan_.footprints.parts(), plan_.footprints.wide ? gpu::kCoarseLevel + 1 : 1);
        if (frame.subsamples == 0)
            frame.log.skip("footprints", "without sub-samples it is the plain mean");
        else if (!plan_.footprints.wide)
            frame.log.skip("footprints", "points of the lens see all within a pixel of one another");
        sprites_.drawn = 0;
        if (sharing_.radius < 0.0)
            frame.log.skip("sprites", "too few points of the lens to share renderings, or no choice of layers");
        else if (plan_.sharing.parents.empty())
            frame.log.skip("sprites", "nothing is sharp enough for samples to share it");
    }
    sum_.refine(frame, layers, [&](int count) { drawGroup(frame, count); });
    if (plan_.footprints.wide) {
        PassScope scope(frame.log, "footprints");
        return footprintPass_.draw(sum_, plan_.footprints);
    }
    PassScope scope(frame.log, "average");
    return sum_.mean();
}

std::size_t Accumulate::bytes() const {
    return geometry_.bytes() + layers_.bytes() + sprites_.layers.bytes() + sum_.bytes() + blur_.bytes();
}

}  // namespace dioptre
