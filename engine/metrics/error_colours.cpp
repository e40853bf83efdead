#include <algorithm>
#include <cstdint>
#include <iterator>

#include "core/color.hpp"
#include "metrics/metrics.hpp"

namespace dioptre {

namespace {

// Magma of matplotlib (Smith, van der Walt 2015, CC0) at sixteen even steps, sRGB: the map that FLIP is shown with.
constexpr std::uint32_t kMagma[] = {0x000004, 0x0c0926, 0x221150, 0x400f74, 0x5f187f, 0x7b2382, 0x982d80, 0xb73779,
                                    0xd3436e, 0xeb5760, 0xf8765c, 0xfd9a6a, 0xfebb81, 0xfddc9e, 0xfcf0b2, 0xfcfdbf};
constexpr std::size_t kMagmaLast = std::size(kMagma) - 1;

float channelOf(std::uint32_t colour, int channel) {
    return static_cast<float>((colour >> (16 - 8 * channel)) & 0xFFu) / 255.0f;
}

}  // namespace

Image errorColours(const Image& errors) {
    Image image(errors.width, errors.height);
    for (std::size_t i = 0; i < errors.pixels.size(); ++i) {
        const float at = clampUnit(errors.pixels[i]) * static_cast<float>(kMagmaLast);
        const auto below = std::min(static_cast<std::size_t>(at), kMagmaLast - 1);
        const float t = at - static_cast<float>(below);
        for (int c = 0; c < 3; ++c)
            image.pixels[3 * i + static_cast<std::size_t>(c)] =
                linearFromSrgb(channelOf(kMagma[below], c) * (1.0f - t) + channelOf(kMagma[below + 1], c) * t);
    }
    return image;
}

}  // namespace dioptre
