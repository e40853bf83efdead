#include "render/reference/reference.hpp"

#include <vector>

#include "optics/lens_samples.hpp"

namespace dioptre {

void Reference::addBatch(const EyeFrame& frame, int count) {
    if (arranged_ != count) {
        frame.scene.arrange(list_, count);
        arranged_ = count;
    }
    std::vector<glm::mat4> clips;
    clips.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i)
        clips.emplace_back(
            clipFromView(frame.view, frame.lens, lensSample(frame.firstSample + sum_.drawn() + i, frame.lens)));
    layers_.bind(true);
    frame.scene.drawThroughLens(list_, clips, frame.exposure, TextureFilter{textureLodBias(frame.samples)});
    sum_.add(layers_, count);
}

const Texture& Reference::draw(const EyeFrame& frame) {
    showsStage_ = frame.show.stage != ShowChoice::none;
    if (showsStage_) {
        geometry_.draw(frame);
        return show_.draw(frame, geometry_.depth());
    }
    const int layers = GpuScene::mostMatrices();
    layers_.resize(frame.view.width, frame.view.height, layers);
    sum_.begin(frame);
    if (sum_.drawn() < frame.samples) {
        frame.scene.see(list_, frame.view, &frame.lens, frame.sight);
        arranged_ = 0;
    }
    {
        PassScope scope(frame.log, "samples");
        sum_.refine(frame, layers, [&](int count) { addBatch(frame, count); });
    }
    PassScope scope(frame.log, "average");
    return sum_.mean();
}

}  // namespace dioptre
