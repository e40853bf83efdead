// Move-only OpenGL objects, made by direct state access and labelled, so that a frame capture reads well.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "gl/api.hpp"

namespace dioptre {

/// Owns one GL name; `Traits` says how it is freed.
template <class Traits>
class Handle {
  public:
    Handle() = default;
    explicit Handle(GLuint name) : name_(name) {}
    ~Handle() { reset(); }
    Handle(Handle&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
    Handle& operator=(Handle&& other) noexcept {
        if (this != &other) {
            reset();
            name_ = std::exchange(other.name_, 0);
        }
        return *this;
    }
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;

    GLuint name() const { return name_; }
    explicit operator bool() const { return name_ != 0; }

  private:
    void reset() {
        if (name_) Traits::free(name_);
        name_ = 0;
    }
    GLuint name_ = 0;
};

struct TextureTraits {
    static void free(GLuint n) { glDeleteTextures(1, &n); }
};
struct BufferTraits {
    static void free(GLuint n) { glDeleteBuffers(1, &n); }
};
struct FramebufferTraits {
    static void free(GLuint n) { glDeleteFramebuffers(1, &n); }
};
struct VertexArrayTraits {
    static void free(GLuint n) { glDeleteVertexArrays(1, &n); }
};
struct SamplerTraits {
    static void free(GLuint n) { glDeleteSamplers(1, &n); }
};
using VertexArray = Handle<VertexArrayTraits>;
using GlSampler = Handle<SamplerTraits>;

/// Immutable 2D texture; a multisample surface when samples > 0, an array when layers > 0.
struct TextureSpec {
    GLenum format = GL_RGBA16F;
    int width = 1, height = 1, levels = 1, samples = 0, layers = 0;
    bool operator==(const TextureSpec&) const = default;
};
class Texture : public Handle<TextureTraits> {
  public:
    Texture() = default;
    /// Throws RunError when a size is beyond the driver's limit. Filters: nearest, clamped; see setLinear.
    Texture(const TextureSpec& spec, std::string_view label);

    const TextureSpec& spec() const { return spec_; }
    int width() const { return spec_.width; }
    int height() const { return spec_.height; }
    std::size_t bytes() const;
    /// Linear within a level; with `levels`, of the level nearest to the one asked for.
    void setLinear(bool levels);
    void bind(GLuint unit) const { glBindTextureUnit(unit, name()); }

  private:
    TextureSpec spec_{};
};

class Buffer : public Handle<BufferTraits> {
  public:
    Buffer() = default;
    /// Immutable storage; `dynamic` allows update().
    Buffer(std::size_t bytes, const void* data, bool dynamic, std::string_view label);
    template <class T>
    Buffer(std::span<const T> data, std::string_view label) : Buffer(data.size_bytes(), data.data(), false, label) {}

    std::size_t bytes() const { return bytes_; }
    /// offset + bytes <= bytes().
    void update(const void* data, std::size_t bytes, std::size_t offset = 0);

  private:
    std::size_t bytes_ = 0;
};

/// A framebuffer over levels of textures that it does not own (they must outlive it).
class Framebuffer : public Handle<FramebufferTraits> {
  public:
    struct Attachment {
        const Texture* texture = nullptr;
        int level = 0;
        int layer = 0;  // of an array; kAllLayers: a layered target
    };
    static constexpr int kAllLayers = -1;
    Framebuffer() = default;
    Framebuffer(std::span<const Attachment> colors, const Texture* depth, std::string_view label);

    /// Makes it the draw target with a viewport over all of it.
    void bind() const;
    int width() const { return width_; }
    int height() const { return height_; }

  private:
    int width_ = 0, height_ = 0;
};

/// A point in the GL's work that can be waited for.
class Fence {
  public:
    Fence() = default;
    static Fence insert();
    ~Fence();
    Fence(Fence&& other) noexcept : sync_(std::exchange(other.sync_, nullptr)) {}
    Fence& operator=(Fence&& other) noexcept {
        std::swap(sync_, other.sync_);
        return *this;
    }
    Fence(const Fence&) = delete;
    Fence& operator=(const Fence&) = delete;

    /// True once everything before it is done; with `wait`, always.
    bool reached(bool wait) const;

  private:
    GLsync sync_ = nullptr;
};

VertexArray makeVertexArray(std::string_view label);

/// Reads a level as floats, row 0 on top (GL stores it at the bottom). Stalls.
std::vector<float> readTexture(const Texture& texture, GLenum format, int channels, int level = 0);

}  // namespace dioptre
