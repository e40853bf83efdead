#include "frame/measure_pictures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "core/color.hpp"
#include "core/error.hpp"
#include "core/file.hpp"

namespace dioptre {

namespace {

// Pictures are looked at beside one another, so that a blur's edge must survive; error maps and thumbnails less so.
constexpr int kPictureQuality = 85, kErrorQuality = 75, kThumbQuality = 75;
constexpr int kThumbWidth = 144;
constexpr std::size_t kLargestPicture = 16u << 20;

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

Image smaller(const Image& image, int width) {
    if (image.width <= width) return image;
    const int height =
        std::max(1, static_cast<int>(std::lround(static_cast<double>(image.height) * width / image.width)));
    Image out(width, height, image.channels);
    for (int y = 0; y < height; ++y) {
        const int top = y * image.height / height, bottom = std::max(top + 1, (y + 1) * image.height / height);
        for (int x = 0; x < width; ++x) {
            const int left = x * image.width / width, right = std::max(left + 1, (x + 1) * image.width / width);
            for (int c = 0; c < image.channels; ++c) {
                float sum = 0.0f;
                for (int v = top; v < bottom; ++v)
                    for (int u = left; u < right; ++u) sum += image.at(u, v, c);
                out.at(x, y, c) = sum / static_cast<float>((right - left) * (bottom - top));
            }
        }
    }
    return out;
}

std::string base64(std::string_view bytes) {
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t word = 0;
        for (std::size_t j = 0; j < 3; ++j)
            word = word << 8 | (i + j < bytes.size() ? static_cast<unsigned char>(bytes[i + j]) : 0u);
        for (std::size_t j = 0; j < 4; ++j) text += i + j <= bytes.size() ? kDigits[(word >> (18 - 6 * j)) & 63u] : '=';
    }
    return text;
}

PictureFolder::PictureFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

void PictureFolder::writePicture(const std::string& key, const Image& picture) const {
    std::error_code ignored;  // the write tells
    std::filesystem::create_directories(folder_, ignored);
    writeFileAtomically(folder_ / (key + ".jpg"), encodeJpeg(picture, kPictureQuality));
    writeFileAtomically(folder_ / (key + ".thumb.jpg"), encodeJpeg(smaller(picture, kThumbWidth), kThumbQuality));
}

void PictureFolder::writeErrors(const std::string& key, const Image& errors) const {
    std::error_code ignored;
    std::filesystem::create_directories(folder_, ignored);
    writeFileAtomically(folder_ / (key + ".flip.jpg"), encodeJpeg(errorColours(errors), kErrorQuality));
}

std::string PictureFolder::dataUri(const std::string& key, std::string_view kind) const {
    const auto file = folder_ / (key + std::string(kind) + ".jpg");
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored)) return {};
    return "data:image/jpeg;base64," + base64(readFile(file, kLargestPicture));
}

}  // namespace dioptre
