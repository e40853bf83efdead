// Pictures in memory (linear light, float) and in files: PNG (8-bit sRGB), OpenEXR and PFM (linear, 32-bit float).
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace dioptre {

/// Linear light, row 0 on top, channels interleaved: pixels[(y * width + x) * channels + c].
struct Image {
    int width = 0;
    int height = 0;
    int channels = 3;  // 3 (RGB) or 1 (grey)
    std::vector<float> pixels;

    Image() = default;
    Image(int width_, int height_, int channels_ = 3)
        : width(width_),
          height(height_),
          channels(channels_),
          pixels(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) *
                 static_cast<std::size_t>(channels_)) {}

    std::size_t index(int x, int y, int c = 0) const {
        return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) *
                   static_cast<std::size_t>(channels) +
               static_cast<std::size_t>(c);
    }
    float& at(int x, int y, int c = 0) { return pixels[index(x, y, c)]; }
    float at(int x, int y, int c = 0) const { return pixels[index(x, y, c)]; }
};

/// Largest width or height (two eyes of 16384 side by side) and number of pixels that readImage takes.
inline constexpr int kMaxImageSide = 32768;
inline constexpr std::size_t kMaxImagePixels = std::size_t{1} << 27;

/// By extension: .png (clamped to 0..1, encoded to sRGB once, rounded to 8 bits; NaN becomes 0), .exr (32-bit float,
/// ZIP), .pfm (little-endian, rows bottom to top). One channel gives a grey file. Atomic, see writeFileAtomically.
/// InputError: unknown extension, folder missing. RunError: the write failed; no partial file stays.
void writeImage(const std::filesystem::path& path, const Image& image);

/// By extension as above; always 3 channels (grey is repeated, alpha dropped), PNG (8 or 16 bits) decoded from sRGB.
/// InputError naming the file: missing, malformed, truncated, too large, or holding values that are not finite.
Image readImage(const std::filesystem::path& path);

/// A JPEG file's bytes for a page to look at: sRGB, lossy; quality 1..100. RunError where it cannot be encoded.
std::string encodeJpeg(const Image& image, int quality);

/// Whether it ends as one of the formats does.
bool isImageName(const std::filesystem::path& path);
/// InputError where writeImage could not work: unknown extension, folder missing. Asked before a long run.
void requireImageName(const std::filesystem::path& path);

/// How many values are NaN or infinite.
std::size_t countNotFinite(const Image& image);

}  // namespace dioptre
