// PNG and JPEG by stb: its compiled code lies in libstb, which tinygltf shares.
#include <stb_image.h>
#include <stb_image_write.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/color.hpp"
#include "core/error.hpp"
#include "core/image_formats.hpp"

namespace dioptre {

namespace {

constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";

struct StbFree {
    void operator()(void* pixels) const { stbi_image_free(pixels); }
};

// Deflate packs at most 1032 to 1: a file that claims more pixels than that is broken, and asks for no memory.
constexpr std::size_t kDeflateLimit = 1032;

long long bigEndian(std::string_view bytes) {
    long long value = 0;
    for (const char byte : bytes) value = value * 256 + static_cast<unsigned char>(byte);
    return value;
}

std::vector<std::uint8_t> eightBits(const Image& image) {
    std::vector<std::uint8_t> encoded(image.pixels.size());
    std::transform(image.pixels.begin(), image.pixels.end(), encoded.begin(), [](float linear) {
        return static_cast<std::uint8_t>(std::lround(255.0F * srgbFromLinear(clampUnit(linear))));
    });
    return encoded;
}

void append(void* to, void* data, int size) {
    static_cast<std::string*>(to)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
}

}  // namespace

std::string encodeJpeg(const Image& image, int quality) {
    const std::vector<std::uint8_t> encoded = eightBits(image);
    std::string bytes;
    if (!stbi_write_jpg_to_func(append, &bytes, image.width, image.height, image.channels, encoded.data(), quality))
        throw RunError("cannot be encoded as JPEG, " + std::to_string(image.width) + "x" +
                       std::to_string(image.height));
    return bytes;
}

std::string encodePng(const Image& image) {
    // stb counts bytes in int, and doubles its buffers.
    constexpr std::size_t kMostBytes = std::size_t{1} << 30;
    if (image.pixels.size() > kMostBytes)
        throw RunError(std::to_string(image.width) + "x" + std::to_string(image.height) +
                       " is too large for a PNG file of at most 1 GiB, .exr and .pfm take it");
    const std::vector<std::uint8_t> encoded = eightBits(image);
    std::string bytes;
    if (!stbi_write_png_to_func(append, &bytes, image.width, image.height, image.channels, encoded.data(),
                                image.width * image.channels))
        throw RunError("cannot be encoded as PNG, " + std::to_string(image.width) + "x" + std::to_string(image.height));
    return bytes;
}

Image decodePng(std::string_view bytes) {
    if (!bytes.starts_with(kSignature)) throw InputError("not a PNG file");
    if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
        throw InputError("longer than 2 GiB, the limit of a PNG file");
    const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
    const int size = static_cast<int>(bytes.size());
    constexpr std::size_t kWidthAt = 16, kHeightAt = 20;  // in the first chunk, big-endian
    if (bytes.size() < kHeightAt + 4) throw InputError("broken PNG file: header ends early");
    const long long claimedWidth = bigEndian(bytes.substr(kWidthAt, 4));
    const long long claimedHeight = bigEndian(bytes.substr(kHeightAt, 4));
    requireSize(claimedWidth, claimedHeight, kMaxImagePixels);
    // A pixel takes at least one bit.
    if (static_cast<std::size_t>(claimedWidth * claimedHeight) / 8 > bytes.size() * kDeflateLimit)
        throw InputError("broken PNG file: " + std::to_string(bytes.size()) + " bytes cannot hold " +
                         std::to_string(claimedWidth) + "x" + std::to_string(claimedHeight) + " pixels");

    Image image(static_cast<int>(claimedWidth), static_cast<int>(claimedHeight));
    int width = 0, height = 0, channels = 0;
    const auto decode = [&](const auto* encoded, double peak) {
        if (!encoded) throw InputError(std::string("broken PNG file: ") + stbi_failure_reason());
        if (width != image.width || height != image.height) throw InputError("broken PNG file: two sizes");
        std::vector<float> table(static_cast<std::size_t>(peak) + 1);
        for (std::size_t i = 0; i < table.size(); ++i)
            table[i] = static_cast<float>(linearFromSrgb(static_cast<double>(i) / peak));
        for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = table[encoded[i]];
    };
    if (stbi_is_16_bit_from_memory(data, size)) {
        const std::unique_ptr<stbi_us, StbFree> words(
            stbi_load_16_from_memory(data, size, &width, &height, &channels, 3));
        decode(words.get(), 65535.0);
    } else {
        const std::unique_ptr<stbi_uc, StbFree> words(stbi_load_from_memory(data, size, &width, &height, &channels, 3));
        decode(words.get(), 255.0);
    }
    return image;
}

}  // namespace dioptre
