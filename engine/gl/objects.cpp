#include "gl/objects.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <string>

#include "core/error.hpp"

namespace dioptre {

namespace {

void label(GLenum kind, GLuint name, std::string_view text) {
    glObjectLabel(kind, name, static_cast<GLsizei>(text.size()), text.data());
}

std::size_t texelBytes(GLenum format) {
    switch (format) {
        case GL_R8:
            return 1;
        case GL_R16F:
            return 2;
        case GL_RGBA8:
        case GL_SRGB8_ALPHA8:
        case GL_RG16F:
        case GL_R32F:
        case GL_R11F_G11F_B10F:
        case GL_DEPTH_COMPONENT32F:
            return 4;
        case GL_RGBA16F:
        case GL_RG32F:
            return 8;
        case GL_RGBA32F:
            return 16;
        default:
            assert(false && "texture format without a known size");
            return 16;
    }
}

/// Runs what allocates in GL; a failure is thrown as one line, where the debug output would print one of its own.
template <class Allocate>
void allocating(std::string_view text, std::size_t bytes, const Allocate& allocate) {
    glDisable(GL_DEBUG_OUTPUT);
    allocate();
    const GLenum error = glGetError();
    glEnable(GL_DEBUG_OUTPUT);
    const double megabytes = static_cast<double>(bytes) / 1e6;
    if (error == GL_OUT_OF_MEMORY)
        throw RunError(fmt::format(
            "{}: {:.1f} MB are more than this OpenGL gives; a smaller --size or --msaa 0 takes less", text, megabytes));
    if (error != GL_NO_ERROR)
        throw RunError(fmt::format("{}: {:.1f} MB cannot be had (OpenGL error 0x{:x})", text, megabytes, error));
}

}  // namespace

Texture::Texture(const TextureSpec& spec, std::string_view text) : spec_(spec) {
    GLint limit = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
    if (spec.width > limit || spec.height > limit)
        throw RunError(fmt::format("{}: {}x{} texels, this GL allows {}", text, spec.width, spec.height, limit));
    GLuint name = 0;
    glCreateTextures(spec.samples > 0  ? GL_TEXTURE_2D_MULTISAMPLE
                     : spec.layers > 0 ? GL_TEXTURE_2D_ARRAY
                                       : GL_TEXTURE_2D,
                     1, &name);
    Handle::operator=(Handle(name));
    allocating(text, bytes(), [&] {
        if (spec.samples > 0)
            glTextureStorage2DMultisample(name, spec.samples, spec.format, spec.width, spec.height, GL_TRUE);
        else if (spec.layers > 0)
            glTextureStorage3D(name, spec.levels, spec.format, spec.width, spec.height, spec.layers);
        else
            glTextureStorage2D(name, spec.levels, spec.format, spec.width, spec.height);
    });
    if (spec.samples == 0) {
        glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        glTextureParameteri(name, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        glTextureParameteri(name, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    }
    label(GL_TEXTURE, name, text);
}

std::size_t Texture::bytes() const {
    std::size_t texels = 0;
    for (int level = 0; level < spec_.levels; ++level)
        texels += static_cast<std::size_t>(std::max(1, spec_.width >> level)) *
                  static_cast<std::size_t>(std::max(1, spec_.height >> level));
    return texels * texelBytes(spec_.format) *
           static_cast<std::size_t>(std::max(1, spec_.samples) * std::max(1, spec_.layers));
}

void Texture::setLinear(bool levels) {
    glTextureParameteri(name(), GL_TEXTURE_MIN_FILTER, levels ? GL_LINEAR_MIPMAP_NEAREST : GL_LINEAR);
    glTextureParameteri(name(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
}

Buffer::Buffer(std::size_t bytes, const void* data, bool dynamic, std::string_view text) : bytes_(bytes) {
    GLuint name = 0;
    glCreateBuffers(1, &name);
    Handle::operator=(Handle(name));
    // GL has no empty buffers: an empty scene still binds one.
    const std::size_t storage = std::max<std::size_t>(bytes, 16);
    allocating(text, storage, [&] {
        glNamedBufferStorage(name, static_cast<GLsizeiptr>(storage), bytes >= 16 ? data : nullptr,
                             dynamic || bytes < 16 ? GL_DYNAMIC_STORAGE_BIT : 0u);
    });
    if (data && bytes > 0 && bytes < 16) glNamedBufferSubData(name, 0, static_cast<GLsizeiptr>(bytes), data);
    label(GL_BUFFER, name, text);
}

void Buffer::update(const void* data, std::size_t bytes, std::size_t offset) {
    assert(offset + bytes <= bytes_);
    if (bytes > 0) glNamedBufferSubData(name(), static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes), data);
}

Framebuffer::Framebuffer(std::span<const Attachment> colors, const Texture* depth, std::string_view text) {
    GLuint name = 0;
    glCreateFramebuffers(1, &name);
    Handle::operator=(Handle(name));
    std::vector<GLenum> buffers;
    for (const Attachment& color : colors) {
        const auto slot = static_cast<GLenum>(GL_COLOR_ATTACHMENT0 + buffers.size());
        if (color.texture->spec().layers > 0 && color.layer != kAllLayers)
            glNamedFramebufferTextureLayer(name, slot, color.texture->name(), color.level, color.layer);
        else
            glNamedFramebufferTexture(name, slot, color.texture->name(), color.level);
        buffers.push_back(slot);
        width_ = std::max(1, color.texture->width() >> color.level);
        height_ = std::max(1, color.texture->height() >> color.level);
    }
    if (depth) {
        glNamedFramebufferTexture(name, GL_DEPTH_ATTACHMENT, depth->name(), 0);
        width_ = depth->width();
        height_ = depth->height();
    }
    glNamedFramebufferDrawBuffers(name, static_cast<GLsizei>(buffers.size()), buffers.data());
    label(GL_FRAMEBUFFER, name, text);
    if (const GLenum status = glCheckNamedFramebufferStatus(name, GL_DRAW_FRAMEBUFFER);
        status != GL_FRAMEBUFFER_COMPLETE)
        throw RunError(fmt::format("{}: framebuffer incomplete (0x{:x})", text, status));
}

void Framebuffer::bind() const {
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, name());
    glViewport(0, 0, width_, height_);
}

Fence Fence::insert() {
    Fence fence;
    fence.sync_ = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    return fence;
}

Fence::~Fence() {
    if (sync_) glDeleteSync(sync_);
}

bool Fence::reached(bool wait) const {
    if (!sync_) return true;
    for (;;) {
        constexpr GLuint64 kNanoseconds = 1'000'000'000;
        const GLenum state = glClientWaitSync(sync_, GL_SYNC_FLUSH_COMMANDS_BIT, wait ? kNanoseconds : 0);
        if (state != GL_TIMEOUT_EXPIRED) return true;
        if (!wait) return false;
    }
}

VertexArray makeVertexArray(std::string_view text) {
    GLuint name = 0;
    glCreateVertexArrays(1, &name);
    label(GL_VERTEX_ARRAY, name, text);
    return VertexArray(name);
}

std::vector<float> readTexture(const Texture& texture, GLenum format, int channels, int level) {
    const auto width = static_cast<std::size_t>(std::max(1, texture.width() >> level));
    const auto height = static_cast<std::size_t>(std::max(1, texture.height() >> level));
    const std::size_t row = width * static_cast<std::size_t>(channels);
    std::vector<float> pixels(row * height);
    glGetTextureImage(texture.name(), level, format, GL_FLOAT, static_cast<GLsizei>(pixels.size() * sizeof(float)),
                      pixels.data());
    for (std::size_t y = 0; y < height / 2; ++y)
        std::swap_ranges(pixels.begin() + static_cast<std::ptrdiff_t>(y * row),
                         pixels.begin() + static_cast<std::ptrdiff_t>((y + 1) * row),
                         pixels.begin() + static_cast<std::ptrdiff_t>((height - 1 - y) * row));
    return pixels;
}

}  // namespace dioptre
