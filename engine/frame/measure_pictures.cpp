#include "frame/measure_pictures.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/error.hpp"
#include "core/file.hpp"
#include "metrics/metrics.hpp"

namespace dioptre {

namespace {

// Pictures are looked at beside one another, so that a blur's edge must survive; error maps and thumbnails less so.
constexpr int kPictureQuality = 85, kErrorQuality = 75, kThumbQuality = 75;
constexpr int kThumbWidth = 144;
constexpr std::size_t kLargestPicture = 16u << 20;

}  // namespace

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

std::string jpegDataUri(std::string_view jpeg) {
    return "data:image/jpeg;base64," + base64(jpeg);
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
    return jpegDataUri(readFile(file, kLargestPicture));
}

}  // namespace dioptre
