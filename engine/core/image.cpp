// PFM, and the choice of format by extension. PNG and OpenEXR: image_png.cpp, image_exr.cpp.
#include "core/image.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <new>
#include <string>
#include <string_view>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/image_formats.hpp"
#include "core/text.hpp"

namespace dioptre {

namespace {

constexpr std::size_t kMaxFileBytes = kMaxImagePixels * 16 + 65536;

struct Format {
    std::string_view extension;
    std::string (*encode)(const Image&);
    Image (*decode)(std::string_view bytes);
};
constexpr Format kFormats[] = {
    {".png", encodePng, decodePng}, {".exr", encodeExr, decodeExr}, {".pfm", encodePfm, decodePfm}};

/// By its extension; null: none that is known.
const Format* findFormat(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    const auto* found = std::find_if(std::begin(kFormats), std::end(kFormats),
                                     [&](const Format& format) { return format.extension == extension; });
    return found == std::end(kFormats) ? nullptr : found;
}

const Format& formatOf(const std::filesystem::path& path) {
    if (const Format* format = findFormat(path)) return *format;
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored))
        throw InputError(path.string() + ": is a folder, a file is expected");
    throw InputError(path.string() + ": unknown picture format " + quote(path.extension().string()) +
                     ", known are .png, .exr, .pfm");
}

float swapBytes(float x) {
    const auto bits = std::bit_cast<std::uint32_t>(x);
    return std::bit_cast<float>((bits >> 24) | ((bits >> 8) & 0xFF00U) | ((bits << 8) & 0xFF0000U) | (bits << 24));
}

// The next word of a PFM header; leaves `bytes` right behind it.
std::string_view takeWord(std::string_view& bytes) {
    constexpr std::string_view kSpace = " \t\r\n";
    constexpr std::size_t kLongestWord = 40;
    bytes.remove_prefix(std::min(bytes.find_first_not_of(kSpace), bytes.size()));
    const std::size_t length = bytes.substr(0, kLongestWord + 1).find_first_of(kSpace);
    if (length == std::string_view::npos) throw InputError("header ends early");
    const std::string_view word = bytes.substr(0, length);
    bytes.remove_prefix(length);
    return word;
}

}  // namespace

void requireSize(long long width, long long height, std::size_t maxPixels) {
    const bool sides = width >= 1 && height >= 1 && width <= kMaxImageSide && height <= kMaxImageSide;
    if (sides && static_cast<std::size_t>(width) * static_cast<std::size_t>(height) <= maxPixels) return;
    throw InputError("size " + std::to_string(width) + "x" + std::to_string(height) + " is not within 1x1 and " +
                     std::to_string(kMaxImageSide) + " per side, " + std::to_string(maxPixels) + " pixels in all");
}

std::string encodePfm(const Image& image) {
    std::string bytes = (image.channels == 3 ? "PF\n" : "Pf\n") + std::to_string(image.width) + " " +
                        std::to_string(image.height) + "\n-1.0\n";
    const std::size_t row = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.channels);
    const std::size_t header = bytes.size();
    bytes.resize(header + image.pixels.size() * sizeof(float));
    char* to = bytes.data() + header;
    for (int y = image.height - 1; y >= 0; --y, to += row * sizeof(float)) {
        static_assert(std::endian::native == std::endian::little, "PFM is written little-endian");
        std::memcpy(to, &image.pixels[image.index(0, y)], row * sizeof(float));
    }
    return bytes;
}

Image decodePfm(std::string_view bytes) {
    const std::string_view magic = takeWord(bytes);
    if (magic != "PF" && magic != "Pf") throw InputError("not a PFM file: it starts with " + quote(magic));
    const std::string_view widthText = takeWord(bytes), heightText = takeWord(bytes), scaleText = takeWord(bytes);
    const auto width = parseInteger(widthText), height = parseInteger(heightText);
    if (!width || !height) throw InputError("size " + quote(widthText) + " by " + quote(heightText));
    requireSize(*width, *height, kMaxImagePixels);
    const auto scale = parseNumber(scaleText);
    if (!scale || !std::isfinite(*scale) || *scale == 0.0)
        throw InputError("scale " + quote(scaleText) + " is not a finite number other than 0");
    bytes.remove_prefix(1);  // exactly one white space ends the header

    const std::size_t channels = magic == "PF" ? 3 : 1;
    const std::size_t row = static_cast<std::size_t>(*width) * channels;
    const std::size_t expected = row * static_cast<std::size_t>(*height) * sizeof(float);
    if (bytes.size() != expected)
        throw InputError("holds " + std::to_string(bytes.size()) + " bytes of pixels, its size asks for " +
                         std::to_string(expected));
    Image image(*width, *height, static_cast<int>(channels));
    for (int y = *height - 1; y >= 0; --y, bytes.remove_prefix(row * sizeof(float)))
        std::memcpy(&image.pixels[image.index(0, y)], bytes.data(), row * sizeof(float));
    if (*scale > 0.0)  // big-endian
        for (float& x : image.pixels) x = swapBytes(x);
    return image;
}

bool isImageName(const std::filesystem::path& path) {
    return findFormat(path) != nullptr;
}

void requireImageName(const std::filesystem::path& path) {
    formatOf(path);
    requireWritableName(path);
}

void writeImage(const std::filesystem::path& path, const Image& image) {
    assert(image.width > 0 && image.height > 0 && (image.channels == 1 || image.channels == 3));
    assert(image.pixels.size() == image.index(0, image.height));
    requireImageName(path);
    const Format& format = formatOf(path);
    std::string bytes;
    try {
        bytes = format.encode(image);
    } catch (const RunError& e) {
        throw RunError(path.string() + ": " + e.what());
    } catch (const std::bad_alloc&) {
        throw RunError(path.string() + ": not enough memory to encode it");
    }
    writeFileAtomically(path, bytes);
}

Image readImage(const std::filesystem::path& path) {
    const Format& format = formatOf(path);
    try {
        const std::string bytes = readFile(path, kMaxFileBytes);
        Image image;
        try {
            image = format.decode(bytes);
        } catch (const InputError& e) {
            throw InputError(path.string() + ": " + e.what());
        }
        if (const std::size_t bad = countNotFinite(image); bad > 0)
            throw InputError(path.string() + ": " + std::to_string(bad) + " of " + std::to_string(image.pixels.size()) +
                             " values are not finite");
        if (image.channels == 3) return image;
        Image colour(image.width, image.height);
        for (std::size_t i = 0; i < colour.pixels.size(); ++i) colour.pixels[i] = image.pixels[i / 3];
        return colour;
    } catch (const std::bad_alloc&) {
        throw RunError(path.string() + ": not enough memory to read it");
    }
}

std::size_t countNotFinite(const Image& image) {
    return static_cast<std::size_t>(
        std::count_if(image.pixels.begin(), image.pixels.end(), [](float x) { return !std::isfinite(x); }));
}

}  // namespace dioptre
