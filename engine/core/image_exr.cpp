// OpenEXR through its C++ interface, from and to memory, so that writing stays atomic.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <exception>
#include <new>
#include <span>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "core/image_formats.hpp"

namespace dioptre {

namespace {

constexpr const char* kColour[] = {"R", "G", "B"};
constexpr const char* kGrey[] = {"Y"};

class MemoryWriter : public Imf::OStream {
  public:
    MemoryWriter() : OStream("memory") {}
    void write(const char data[], int size) override {
        const auto count = static_cast<std::size_t>(size);
        if (position_ + count > bytes.size()) bytes.resize(position_ + count);
        std::memcpy(bytes.data() + position_, data, count);
        position_ += count;
    }
    std::uint64_t tellp() override { return position_; }
    void seekp(std::uint64_t position) override { position_ = position; }

    std::string bytes;

  private:
    std::size_t position_ = 0;
};

class MemoryReader : public Imf::IStream {
  public:
    explicit MemoryReader(std::string_view bytes) : IStream("memory"), bytes_(bytes) {}
    bool read(char data[], int size) override {
        const auto count = static_cast<std::size_t>(size);
        if (size < 0 || position_ > bytes_.size() || count > bytes_.size() - position_)
            throw InputError("broken OpenEXR file: it ends early");
        std::memcpy(data, bytes_.data() + position_, count);
        position_ += count;
        return position_ < bytes_.size();
    }
    std::uint64_t tellg() override { return position_; }
    void seekg(std::uint64_t position) override { position_ = position; }

  private:
    std::string_view bytes_;
    std::size_t position_ = 0;
};

std::span<const char* const> channelNames(int channels) {
    if (channels == 1) return kGrey;
    return kColour;
}

// `corner` is the data window's: OpenEXR counts pixels from there, not from the start of the memory.
Imf::FrameBuffer frameBufferOf(const Image& image, const Imath::V2i& corner) {
    Imf::FrameBuffer buffer;
    const std::size_t xStride = sizeof(float) * static_cast<std::size_t>(image.channels);
    const std::size_t yStride = xStride * static_cast<std::size_t>(image.width);
    // The library takes one mutable pointer for reading and writing.
    auto* base = reinterpret_cast<char*>(const_cast<float*>(image.pixels.data()));
    int c = 0;
    for (const char* name : channelNames(image.channels)) {
        buffer.insert(name, Imf::Slice::Make(Imf::FLOAT, base + sizeof(float) * static_cast<std::size_t>(c), corner,
                                             image.width, image.height, xStride, yStride));
        ++c;
    }
    return buffer;
}

// 3 or 1; sub-sampled and luminance-chroma pictures are not read.
int channelsOf(const Imf::ChannelList& list) {
    const auto has = [&](const char* name) {
        const Imf::Channel* channel = list.findChannel(name);
        return channel && channel->xSampling == 1 && channel->ySampling == 1;
    };
    if (has("R") && has("G") && has("B")) return 3;
    if (has("Y") && !list.findChannel("RY") && !list.findChannel("BY")) return 1;
    throw InputError("no full-size channels R, G, B or Y in this OpenEXR file");
}

}  // namespace

std::string encodeExr(const Image& image) {
    try {
        Imf::Header header(image.width, image.height);
        header.compression() = Imf::ZIP_COMPRESSION;
        for (const char* name : channelNames(image.channels)) header.channels().insert(name, Imf::Channel(Imf::FLOAT));
        MemoryWriter stream;
        {
            Imf::OutputFile file(stream, header);
            file.setFrameBuffer(frameBufferOf(image, {0, 0}));
            file.writePixels(image.height);
        }  // the table of lines is written here
        return std::move(stream.bytes);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& e) {
        throw RunError(std::string("cannot be encoded as OpenEXR: ") + e.what());
    }
}

Image decodeExr(std::string_view bytes) {
    try {
        MemoryReader stream(bytes);
        Imf::InputFile file(stream);
        const Imath::Box2i window = file.header().dataWindow();
        requireSize(static_cast<long long>(window.max.x) - window.min.x + 1,
                    static_cast<long long>(window.max.y) - window.min.y + 1, kMaxImagePixels);
        Image image(window.max.x - window.min.x + 1, window.max.y - window.min.y + 1,
                    channelsOf(file.header().channels()));
        file.setFrameBuffer(frameBufferOf(image, window.min));
        file.readPixels(window.min.y, window.max.y);
        return image;
    } catch (const InputError&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& e) {
        std::string what = e.what();
        std::replace(what.begin(), what.end(), '\n', ' ');
        throw InputError("broken OpenEXR file: " + what);
    }
}

}  // namespace dioptre
