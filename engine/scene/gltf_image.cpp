// The one place that names tinygltf. Its parser takes damaged files without a word (indices, cycles, overruns), so the
// loader reads the JSON itself, where every complaint can name its element; of tinygltf it takes the image decoding.
#include "scene/gltf_image.hpp"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cstring>
#include <limits>

namespace dioptre::gltf {
namespace {

struct ImageSize {
    std::uint64_t width = 0, height = 0;
};

std::uint32_t bigEndian(std::span<const std::uint8_t> bytes, std::size_t at, std::size_t count) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < count; ++i) value = value << 8 | bytes[at + i];
    return value;
}

bool startsWith(std::span<const std::uint8_t> bytes, std::string_view magic, std::size_t at = 0) {
    return bytes.size() >= at + magic.size() && std::memcmp(bytes.data() + at, magic.data(), magic.size()) == 0;
}

// ISO 15948, 11.2.2: the header chunk comes first. Compressed data longer than the picture would only serve to fill
// memory: the decoder unpacks all of it.
std::optional<ImageSize> pngSize(std::span<const std::uint8_t> bytes) {
    constexpr std::size_t kSignatureBytes = 8, kChunkFrameBytes = 12, kHeaderEnd = 33;
    if (bytes.size() < kHeaderEnd || !startsWith(bytes, "IHDR", 12)) return std::nullopt;
    const ImageSize size{bigEndian(bytes, 16, 4), bigEndian(bytes, 20, 4)};
    std::uint64_t compressed = 0;
    for (std::size_t at = kSignatureBytes; bytes.size() - at >= kChunkFrameBytes;) {
        const std::size_t length = bigEndian(bytes, at, 4);
        if (length > bytes.size() - at - kChunkFrameBytes) break;
        if (startsWith(bytes, "IDAT", at + 4)) compressed += length;
        at += length + kChunkFrameBytes;
    }
    constexpr std::uint64_t kSlack = 1 << 16, kLargestTexel = 8;  // 16-bit RGBA
    if (compressed > size.width * size.height * kLargestTexel + size.height + kSlack) return std::nullopt;
    return size;
}

// ITU T.81, B.2.2: the frame header SOFn; n = 4, 8, 12 are other markers.
std::optional<ImageSize> jpegSize(std::span<const std::uint8_t> bytes) {
    for (std::size_t at = 2; at + 9 < bytes.size();) {
        const std::uint8_t marker = bytes[at + 1];
        if (bytes[at] != 0xFF || marker == 0xFF) {  // padding, which the decoder skips too
            ++at;
            continue;
        }
        if (marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC)
            return ImageSize{bigEndian(bytes, at + 7, 2), bigEndian(bytes, at + 5, 2)};
        if (marker == 0xDA || marker == 0xD9) return std::nullopt;  // the scan or the end, and no frame before it
        at += 2 + bigEndian(bytes, at + 2, 2);
    }
    return std::nullopt;
}

ImageSize checkedSize(std::span<const std::uint8_t> bytes, const Element& image) {
    std::optional<ImageSize> size;
    if (startsWith(bytes, "\x89PNG\r\n\x1a\n"))
        size = pngSize(bytes);
    else if (startsWith(bytes, "\xFF\xD8\xFF"))
        size = jpegSize(bytes);
    else if (startsWith(bytes, "RIFF") || startsWith(bytes, "\xABKTX"))
        image.fail("is WebP or KTX2, which is not supported: re-export with PNG or JPEG textures");
    else
        image.fail("is neither PNG nor JPEG");
    if (!size || size->width == 0 || size->height == 0) image.fail("cannot be decoded: damaged header");
    const auto limit = static_cast<std::uint64_t>(image.context().limits.maxImageSide);
    if (size->width > limit || size->height > limit)
        image.fail(fmt::format("is {} x {} texels, the limit is {} a side", size->width, size->height, limit));
    return *size;
}

// While decoding: the decoder's copy and ours, with 16-bit channels at the worst.
constexpr std::uint64_t kDecodingFactor = 4;

// Native 16-bit channels to 8 bits, rounded; in place, the result being the shorter.
void reduceTo8Bits(std::vector<unsigned char>& channels) {
    for (std::size_t i = 0; i < channels.size() / 2; ++i) {
        std::uint16_t value;
        std::memcpy(&value, channels.data() + 2 * i, sizeof value);
        channels[i] = static_cast<unsigned char>((value * 255u + 32767u) / 65535u);
    }
    channels.resize(channels.size() / 2);
    channels.shrink_to_fit();
}

}  // namespace

ImageDecoder::ImageDecoder(Context& context) : context_(context) {}

ImageDecoder::~ImageDecoder() {
    next_ = jobs_.size();
    for (std::thread& thread : threads_) thread.join();
}

int ImageDecoder::add(std::span<const std::uint8_t> bytes, Bytes own, const Element& image) {
    const std::span<const std::uint8_t> all = own.empty() ? bytes : std::span<const std::uint8_t>(own);
    if (all.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
        image.fail(fmt::format("has {} bytes, the limit is {}", all.size(), std::numeric_limits<int>::max()));
    const ImageSize size = checkedSize(all, image);
    const std::uint64_t needed = size.width * size.height * 4, limit = context_.limits.maxImageBytes;
    if (needed > limit - decodedBytes_)
        image.fail(fmt::format("decodes to {} bytes, {} of at most {} bytes of images are in use", needed,
                               decodedBytes_, limit));
    decodedBytes_ += needed;
    // What one image takes, decoded after those before it; start() sees to it that several at a time do not take more.
    context_.charge(needed * kDecodingFactor, image.path());
    context_.release(needed * (kDecodingFactor - 1));
    jobs_.push_back({all, std::move(own), image.path(), needed, size.width, {}, {}});
    // Here and not on the decoding thread, whose heap would keep the memory when the picture is freed
    jobs_.back().image.rgba.reserve(static_cast<std::size_t>(needed));
    return static_cast<int>(jobs_.size()) - 1;
}

void ImageDecoder::start() {
    std::uint64_t largest = 0;
    for (const Job& job : jobs_) largest = std::max(largest, job.needed);
    std::size_t count = std::min<std::size_t>(std::max(1u, std::thread::hardware_concurrency()), jobs_.size());
    const auto passing = [&] { return count * largest * (kDecodingFactor - 1); };
    while (count > 1 && passing() > context_.chargeable()) --count;
    // One at a time has been charged for by add(), image by image.
    charged_ = count > 1 ? passing() : 0;
    context_.charge(charged_, "images");
    for (std::size_t t = 0; t < count; ++t) {
        threads_.emplace_back([this] {
            for (std::size_t i = next_++; i < jobs_.size(); i = next_++) decode(jobs_[i]);
        });
    }
}

std::vector<TextureImage> ImageDecoder::finish() {
    for (std::thread& thread : threads_) thread.join();
    threads_.clear();
    context_.release(charged_);
    std::vector<TextureImage> images;
    for (Job& job : jobs_) {
        if (!job.problem.empty()) context_.fail(job.path, job.problem);
        context_.release(job.own.size());
        images.push_back(std::move(job.image));
    }
    jobs_.clear();
    return images;
}

void ImageDecoder::decode(Job& job) {
    try {
        tinygltf::Image decoded;
        std::string error, warning;
        const bool done = tinygltf::LoadImageData(&decoded, 0, &error, &warning, 0, 0, job.bytes.data(),
                                                  static_cast<int>(job.bytes.size()), nullptr);
        if (!done) {
            job.problem = "cannot be decoded: damaged data";
            return;
        }
        if (decoded.bits == 16) reduceTo8Bits(decoded.image);
        if (decoded.component != 4 || decoded.image.size() != job.needed ||
            static_cast<std::uint64_t>(decoded.width) != job.width) {
            job.problem = fmt::format("cannot be decoded: {} bytes for {} x {} texels", decoded.image.size(), job.width,
                                      job.needed / 4 / job.width);
            return;
        }
        job.image.width = decoded.width;
        job.image.height = decoded.height;
        job.image.rgba.assign(decoded.image.begin(), decoded.image.end());
    } catch (const std::bad_alloc&) {
        job.problem = "cannot be decoded: out of memory";
    }
}

}  // namespace dioptre::gltf
