// The one place that names tinygltf. Its parser takes damaged files without a word (indices, cycles, overruns), so the
// loader reads the JSON itself, where every complaint can name its element; of tinygltf it takes the image decoding.
#include "scene/gltf_image.hpp"

#include <fmt/format.h>
#include <tiny_gltf.h>
#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <new>

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

// ISO 15948, 5.3: length, type, data, checksum; up to the end chunk or the first that is cut, which gives false.
template <class Visit>  // (type and data)
bool forEachPngChunk(std::span<const std::uint8_t> bytes, const Visit& visit) {
    constexpr std::size_t kSignatureBytes = 8, kFrameBytes = 12;
    for (std::size_t at = kSignatureBytes; bytes.size() - at >= kFrameBytes;) {
        const std::size_t length = bigEndian(bytes, at, 4);
        if (startsWith(bytes, "IEND", at + 4)) return true;
        if (length > bytes.size() - at - kFrameBytes) return false;
        visit(bytes.subspan(at + 4, length + 4));
        at += length + kFrameBytes;
    }
    return true;
}

// The header chunk comes first (11.2.2).
std::optional<ImageSize> pngSize(std::span<const std::uint8_t> bytes) {
    constexpr std::size_t kHeaderEnd = 33;
    if (bytes.size() < kHeaderEnd || !startsWith(bytes, "IHDR", 12)) return std::nullopt;
    return ImageSize{bigEndian(bytes, 16, 4), bigEndian(bytes, 20, 4)};
}

// What its data unpacks to: rows of samples with a filter byte each (9.2), of each of the seven pictures of an
// interlaced one (8.2).
std::uint64_t pngUnpackedBytes(std::span<const std::uint8_t> bytes, const ImageSize& size) {
    const std::uint64_t depth = bytes[24], type = bytes[25];
    const std::uint64_t texelBits = depth * (type == 2 ? 3 : type == 4 ? 2 : type == 6 ? 4 : 1);
    const auto picture = [&](std::uint64_t left, std::uint64_t top, std::uint64_t stepX, std::uint64_t stepY) {
        const std::uint64_t width = (size.width + stepX - 1 - left) / stepX;
        const std::uint64_t height = (size.height + stepY - 1 - top) / stepY;
        return width == 0 ? 0 : height * (1 + (width * texelBits + 7) / 8);
    };
    if (bytes[28] == 0) return picture(0, 0, 1, 1);
    return picture(0, 0, 8, 8) + picture(4, 0, 8, 8) + picture(0, 4, 4, 8) + picture(2, 0, 4, 4) + picture(0, 2, 2, 4) +
           picture(1, 0, 2, 2) + picture(0, 1, 1, 2);
}

std::uint64_t pngPackedBytes(std::span<const std::uint8_t> bytes) {
    std::uint64_t sum = 0;
    forEachPngChunk(bytes, [&](std::span<const std::uint8_t> chunk) {
        if (startsWith(chunk, "IDAT")) sum += chunk.size() - 4;
    });
    return sum;
}

constexpr std::uint64_t kDeflateLimit = 1032;  // to 1 at most: 258 bytes from 2 bits

// The decoder unpacks all there is, however small the picture: a file of a few MB would fill memory. Unpacked once
// before, thrown away, where it could come to much.
bool pngUnpacksToMore(std::span<const std::uint8_t> bytes, std::uint64_t expected) {
    constexpr std::uint64_t kHarmless = 64 << 20, kSlack = 1 << 16;
    if (pngPackedBytes(bytes) * kDeflateLimit <= kHarmless) return false;
    z_stream stream{};
    if (inflateInit2(&stream, -MAX_WBITS) != Z_OK) throw std::bad_alloc();
    std::vector<std::uint8_t> out(1 << 16);
    std::size_t header = 2;  // of zlib, before the deflated data
    std::uint64_t unpacked = 0;
    int state = Z_OK;
    forEachPngChunk(bytes, [&](std::span<const std::uint8_t> chunk) {
        if (!startsWith(chunk, "IDAT")) return;
        std::span<const std::uint8_t> data = chunk.subspan(4);
        const std::size_t skipped = std::min(header, data.size());
        header -= skipped;
        data = data.subspan(skipped);
        stream.next_in = const_cast<Bytef*>(data.data());
        stream.avail_in = static_cast<uInt>(data.size());
        while (state == Z_OK && unpacked <= expected + kSlack) {
            stream.next_out = out.data();
            stream.avail_out = static_cast<uInt>(out.size());
            state = inflate(&stream, Z_NO_FLUSH);
            unpacked += out.size() - stream.avail_out;
        }
        if (state == Z_BUF_ERROR) state = Z_OK;  // the chunk is used up
    });
    inflateEnd(&stream);
    // What one unpacker stumbles on, the other may not: damaged.
    return unpacked > expected + kSlack || (state != Z_OK && state != Z_STREAM_END);
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

bool isPng(std::span<const std::uint8_t> bytes) {
    return startsWith(bytes, "\x89PNG\r\n\x1a\n");
}

// The decoder takes memory for as long a chunk as the file says.
bool hasCutPngChunk(std::span<const std::uint8_t> bytes) {
    return isPng(bytes) && !forEachPngChunk(bytes, [](std::span<const std::uint8_t>) {});
}

// Whether that little data can be a picture that large: one that is not must not be allocated first.
bool holds(std::span<const std::uint8_t> bytes, const ImageSize& size) {
    if (isPng(bytes)) return pngUnpackedBytes(bytes, size) <= (pngPackedBytes(bytes) + 1) * kDeflateLimit;
    constexpr std::uint64_t kMostTexelsAByte = 8 * 64;  // ITU T.81, F.1.2.1: a block of 8 x 8 takes at least a bit
    return size.width * size.height <= bytes.size() * kMostTexelsAByte;
}

ImageSize checkedSize(std::span<const std::uint8_t> bytes, const Element& image) {
    std::optional<ImageSize> size;
    if (isPng(bytes))
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
    if (hasCutPngChunk(bytes)) image.fail("cannot be decoded: a PNG chunk is longer than the file");
    if (!holds(bytes, *size))
        image.fail(fmt::format("cannot be decoded: its {} bytes cannot hold {} x {} texels", bytes.size(), size->width,
                               size->height));
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
        if (isPng(job.bytes)) {
            const ImageSize size{job.width, job.needed / 4 / job.width};
            if (pngUnpacksToMore(job.bytes, pngUnpackedBytes(job.bytes, size))) {
                job.problem = fmt::format("cannot be decoded: damaged data, or more than {} x {} texels", size.width,
                                          size.height);
                return;
            }
        }
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
