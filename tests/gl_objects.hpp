// The GL objects that are alive: to see what is left behind.
#pragma once

#include <algorithm>
#include <array>

#include "gl/api.hpp"

namespace dioptre::test {

/// Textures, buffers, framebuffers, vertex arrays, programs, samplers.
using GlObjects = std::array<int, 6>;
inline constexpr const char* kGlObjectNames[] = {"textures",      "buffers",  "framebuffers",
                                                 "vertex arrays", "programs", "samplers"};

/// Drivers may give each new object a name beyond all before it.
inline GLuint greatestGlName() {
    std::array<GLuint, 6> next{};
    glGenTextures(1, &next[0]);
    glGenBuffers(1, &next[1]);
    glGenFramebuffers(1, &next[2]);
    glGenVertexArrays(1, &next[3]);
    next[4] = glCreateProgram();
    glGenSamplers(1, &next[5]);
    glDeleteTextures(1, &next[0]);
    glDeleteBuffers(1, &next[1]);
    glDeleteFramebuffers(1, &next[2]);
    glDeleteVertexArrays(1, &next[3]);
    glDeleteProgram(next[4]);
    glDeleteSamplers(1, &next[5]);
    return *std::max_element(next.begin(), next.end());
}

/// A program in use outlives its deletion, as long as the driver likes.
inline bool programIsKept(GLuint name) {
    GLint deleted = GL_FALSE;
    if (glIsProgram(name)) glGetProgramiv(name, GL_DELETE_STATUS, &deleted);
    return glIsProgram(name) && !deleted;
}

inline GlObjects glObjectsAlive() {
    GlObjects count{};
    const GLuint last = greatestGlName();
    for (GLuint name = 1; name <= last; ++name) {
        count[0] += glIsTexture(name);
        count[1] += glIsBuffer(name);
        count[2] += glIsFramebuffer(name);
        count[3] += glIsVertexArray(name);
        count[4] += programIsKept(name);
        count[5] += glIsSampler(name);
    }
    return count;
}

}  // namespace dioptre::test
