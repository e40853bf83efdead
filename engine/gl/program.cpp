#include "gl/program.hpp"

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <sstream>

#include "core/error.hpp"
#include "core/resources.hpp"

namespace dioptre {

namespace {

/// The file with its #include lines replaced by their files, each once; #line keeps the compiler's messages true.
void appendSource(const std::string& file, std::vector<std::string>& seen, std::string& out) {
    for (const std::string& s : seen)
        if (s == file) return;
    seen.push_back(file);
    const auto path = resource(std::filesystem::path("shaders") / file);
    std::ifstream in(path);
    if (!in) throw RunError(path.string() + ": cannot be read");
    const std::size_t id = seen.size() - 1;
    out += fmt::format("#line 1 {}\n", id);
    std::string line;
    for (int number = 1; std::getline(in, line); ++number) {
        if (const auto at = line.find("#include \""); at == 0) {
            const auto end = line.find('"', 10);
            appendSource(line.substr(10, end - 10), seen, out);
            out += fmt::format("#line {} {}\n", number + 1, id);
        } else if (line.rfind("#pragma once", 0) == 0) {
            out += "\n";
        } else {
            out += line + "\n";
        }
    }
}

GLuint compile(GLenum stage, std::string_view file, const std::vector<std::string>& defines) {
    std::string source = "#version 450 core\n";
    for (const std::string& define : defines) source += "#define " + define + " 1\n";
    std::vector<std::string> files;
    appendSource(std::string(file), files, source);
    const GLuint shader = glCreateShader(stage);
    const char* text = source.c_str();
    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    GLint ok = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
    if (!ok) {
        std::string log(4096, '\0');
        GLsizei length = 0;
        glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), &length, log.data());
        log.resize(static_cast<std::size_t>(length));
        glDeleteShader(shader);
        throw RunError(fmt::format("shaders/{}: {}", file, log));
    }
    return shader;
}

}  // namespace

Program::Program(std::string_view vertex, std::string_view fragment, const std::vector<std::string>& defines)
    : Program(std::array{Stage(GL_VERTEX_SHADER, vertex), Stage(GL_FRAGMENT_SHADER, fragment)}, defines) {}

Program Program::compute(std::string_view file, const std::vector<std::string>& defines) {
    return {std::array{Stage(GL_COMPUTE_SHADER, file)}, defines};
}

Program::Program(std::span<const Stage> stages, const std::vector<std::string>& defines) {
    const GLuint program = glCreateProgram();
    Handle::operator=(Handle(program));
    const std::string_view name = stages.back().second;
    // A shader marked for deletion goes with its program, whatever fails.
    for (const auto& [stage, file] : stages) {
        const GLuint shader = compile(stage, file, defines);
        glAttachShader(program, shader);
        glDeleteShader(shader);
    }
    glLinkProgram(program);
    GLint ok = 0;
    glGetProgramiv(program, GL_LINK_STATUS, &ok);
    if (!ok) {
        std::string log(4096, '\0');
        GLsizei length = 0;
        glGetProgramInfoLog(program, static_cast<GLsizei>(log.size()), &length, log.data());
        log.resize(static_cast<std::size_t>(length));
        throw RunError(fmt::format("shaders/{}: {}", name, log));
    }
    glObjectLabel(GL_PROGRAM, program, static_cast<GLsizei>(name.size()), name.data());
}

FullscreenPass::FullscreenPass(std::string_view fragment, const std::vector<std::string>& defines)
    : program_("common/fullscreen.vert.glsl", fragment, defines), vertexArray_(makeVertexArray("full screen")) {}

FullscreenPass FullscreenPass::layered(std::string_view fragment) {
    if (GLAD_GL_ARB_shader_viewport_layer_array) return FullscreenPass(fragment, {"LAYERED"});
    return FullscreenPass(fragment);
}

void FullscreenPass::draw(int layers) const {
    program_.use();
    glBindVertexArray(vertexArray_.name());
    glDrawArraysInstanced(GL_TRIANGLES, 0, 3, layers);
}

}  // namespace dioptre
