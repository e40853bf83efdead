// Drawing and judging pictures in the GL tests, with a reference drawn in the same run.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/color.hpp"
#include "core/image.hpp"
#include "optics/lens_samples.hpp"
#include "render/technique.hpp"
#include "test_scenes.hpp"

namespace dioptre::test {

struct Shot {
    View view = testView();
    Lens lens;
    int msaa = 0;
    float exposure = 1.0f;
    ShowStage show;
    int samples = 16, subsamples = 2;  // of techniques that have them
};

inline Image readPicture(const Texture& texture) {
    Image image(texture.width(), texture.height());
    image.pixels = readTexture(texture, GL_RGB, 3);
    return image;
}

inline Image draw(Technique& technique, const GpuScene& scene, const Shot& shot) {
    PassLog log;
    return readPicture(technique.draw(
        {scene, shot.view, shot.lens, shot.exposure, shot.msaa, shot.show, log, shot.samples, shot.subsamples}));
}

inline Image draw(TechniqueChoice choice, const GpuScene& scene, const Shot& shot) {
    return draw(*makeTechnique(choice), scene, shot);
}

/// The view through one point of the lens: moved by E v, the plane in focus kept where it is in the picture
/// (Haeberli, Akeley 1990), and the picture moved by part of a pixel.
inline View throughLens(const View& view, const Lens& lens, glm::dvec2 v, glm::dvec2 pixelShift) {
    View moved = view;
    const glm::dvec2 offset = v * lens.apertureRadius.value;
    moved.pose.position += view.pose.orientation * glm::dvec3(offset, 0.0);
    const glm::dvec2 tangents = -pixelShift / focalLengthPixels(view) - offset * lens.focus.value;
    moved.frustum.left += tangents.x;
    moved.frustum.right += tangents.x;
    moved.frustum.bottom += tangents.y;
    moved.frustum.top += tangents.y;
    return moved;
}

/// Plain accumulation over the lens's samples with a camera that moves, summed in double: what the reference technique
/// does with matrices, done another way.
inline Image accumulated(const GpuScene& scene, const Shot& shot, int samples = 64) {
    const auto pinhole = makeTechnique(TechniqueChoice::pinhole);
    Image image(shot.view.width, shot.view.height);
    std::vector<double> sum(image.pixels.size());
    for (int i = 0; i < samples; ++i) {
        Shot one = shot;
        const LensSample sample = lensSample(i, shot.lens);
        one.view = throughLens(shot.view, shot.lens, sample.lens, sample.pixel);
        const Image picture = draw(*pinhole, scene, one);
        for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += static_cast<double>(picture.pixels[k]);
    }
    for (std::size_t k = 0; k < sum.size(); ++k) image.pixels[k] = static_cast<float>(sum[k] / samples);
    return image;
}

inline double encoded(float linear) {
    return srgbFromLinear(static_cast<double>(clampUnit(linear)));
}

/// The largest differences of two pictures and where they are.
struct Worst {
    double linear = 0.0, encoded = 0.0;
    int x = -1, y = -1;  // of the linear one
    double mean = 0.0;   // of the linear differences
};

inline std::ostream& operator<<(std::ostream& out, const Worst& w) {
    return out << "worst at (" << w.x << ", " << w.y << "): linear " << w.linear * 255.0 << "/255, encoded "
               << w.encoded * 255.0 << "/255, mean " << w.mean * 255.0 << "/255";
}

/// Over the pixels where wanted(x, y).
template <class Wanted>
Worst worstDifference(const Image& a, const Image& b, Wanted wanted) {
    Worst worst;
    std::size_t count = 0;
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x) {
            if (!wanted(x, y)) continue;
            for (int c = 0; c < 3; ++c) {
                const double d = std::abs(static_cast<double>(a.at(x, y, c)) - static_cast<double>(b.at(x, y, c)));
                if (!(d <= worst.linear)) worst.linear = d, worst.x = x, worst.y = y;  // NaN too
                worst.encoded = std::max(worst.encoded, std::abs(encoded(a.at(x, y, c)) - encoded(b.at(x, y, c))));
                worst.mean += d;
                ++count;
            }
        }
    worst.mean /= static_cast<double>(std::max<std::size_t>(count, 1));
    return worst;
}

inline Worst worstDifference(const Image& a, const Image& b) {
    return worstDifference(a, b, [](int, int) { return true; });
}

inline Image constantImage(int width, int height, glm::vec3 color) {
    Image image(width, height);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = color[static_cast<glm::length_t>(i % 3)];
    return image;
}

inline glm::dvec3 pixelAt(const Image& image, int x, int y) {
    return {image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2)};
}

inline glm::dvec3 meanColor(const Image& image, int x0, int y0, int x1, int y1) {
    glm::dvec3 sum(0.0);
    for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x) sum += pixelAt(image, x, y);
    return sum / static_cast<double>((x1 - x0) * (y1 - y0));
}

}  // namespace dioptre::test
