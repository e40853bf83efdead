// PNG and JPEG images of a glTF scene; their size is known before anything is decoded. Internal to the glTF loader.
#pragma once

#include <atomic>
#include <span>
#include <thread>

#include "scene/gltf_json.hpp"

namespace dioptre::gltf {

/// Decodes images to 8-bit RGBA on threads of its own while the caller goes on. Only finish() and add() complain.
class ImageDecoder {
  public:
    explicit ImageDecoder(Context& context);
    ~ImageDecoder();  // waits
    ImageDecoder(const ImageDecoder&) = delete;
    ImageDecoder& operator=(const ImageDecoder&) = delete;

    /// Checks size and limits of the element `images[i]` and charges its memory; its place in finish()'s list.
    /// `own`, unless empty, holds the bytes, which are charged; `bytes` must outlive this otherwise.
    int add(std::span<const std::uint8_t> bytes, Bytes own, const Element& image);
    /// After the last add().
    void start();
    /// Waits for all. Fails, naming the first image that is damaged.
    std::vector<TextureImage> finish();

  private:
    struct Job {
        std::span<const std::uint8_t> bytes;
        Bytes own;
        std::string path;
        std::uint64_t needed = 0, width = 0;  // bytes decoded; texels
        TextureImage image;
        std::string problem;  // empty: none
    };
    static void decode(Job& job);

    Context& context_;
    std::vector<Job> jobs_;
    std::uint64_t decodedBytes_ = 0, charged_ = 0;
    std::atomic<std::size_t> next_{0};
    std::vector<std::thread> threads_;
};

}  // namespace dioptre::gltf
