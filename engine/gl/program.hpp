// Shader programs from files under shaders/, with #include "..." relative to that folder, so that constants and structs
// shared with C++ are written once in shaders/shared/.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gl/objects.hpp"

namespace dioptre {

struct ProgramTraits {
    static void free(GLuint n) { glDeleteProgram(n); }
};

class Program : public Handle<ProgramTraits> {
  public:
    Program() = default;
    /// `vertex` and `fragment` are paths below shaders/; `defines` are names set to 1. Throws RunError with the
    /// compiler's log.
    Program(std::string_view vertex, std::string_view fragment, const std::vector<std::string>& defines = {});

    /// A compute shader, likewise.
    static Program compute(std::string_view file, const std::vector<std::string>& defines = {});

    void use() const { glUseProgram(name()); }
    // Uniforms by name, for the program made current or not; a name the compiler removed is ignored.
    void set(const char* uniform, int v) const { glProgramUniform1i(name(), location(uniform), v); }
    void set(const char* uniform, float v) const { glProgramUniform1f(name(), location(uniform), v); }
    void set(const char* uniform, const glm::vec2& v) const { glProgramUniform2f(name(), location(uniform), v.x, v.y); }
    void set(const char* uniform, const glm::ivec2& v) const {
        glProgramUniform2i(name(), location(uniform), v.x, v.y);
    }
    void set(const char* uniform, const glm::vec4& v) const {
        glProgramUniform4f(name(), location(uniform), v.x, v.y, v.z, v.w);
    }
    void set(const char* uniform, std::span<const int> v) const {
        glProgramUniform1iv(name(), location(uniform), static_cast<GLsizei>(v.size()), v.data());
    }
    void set(const char* uniform, std::span<const glm::vec2> v) const {
        glProgramUniform2fv(name(), location(uniform), static_cast<GLsizei>(v.size()), &v[0].x);
    }
    void set(const char* uniform, std::span<const glm::mat4> m) const {
        glProgramUniformMatrix4fv(name(), location(uniform), static_cast<GLsizei>(m.size()), GL_FALSE, &m[0][0][0]);
    }

  private:
    using Stage = std::pair<GLenum, std::string_view>;  // and its file
    Program(std::span<const Stage> stages, const std::vector<std::string>& defines);
    GLint location(const char* uniform) const { return glGetUniformLocation(name(), uniform); }
};

/// A program that shades every pixel of the bound framebuffer from one triangle; draw() needs no vertex data.
class FullscreenPass {
  public:
    FullscreenPass() = default;
    explicit FullscreenPass(std::string_view fragment, const std::vector<std::string>& defines = {});
    /// To every layer of a layered framebuffer: gl_Layer is the layer. More than one only where the vertex stage can
    /// choose it (GL_ARB_shader_viewport_layer_array).
    static FullscreenPass layered(std::string_view fragment);
    const Program& program() const { return program_; }
    void draw(int layers = 1) const;

  private:
    Program program_;
    VertexArray vertexArray_;
};

}  // namespace dioptre
