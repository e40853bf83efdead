#include "gl/context.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "core/error.hpp"
#include "gl/headless.hpp"

namespace dioptre {

namespace {

void GLAPIENTRY onDebugMessage(GLenum, GLenum type, GLuint, GLenum severity, GLsizei, const GLchar* text, const void*) {
    if (type == GL_DEBUG_TYPE_ERROR || severity == GL_DEBUG_SEVERITY_HIGH) std::fprintf(stderr, "OpenGL: %s\n", text);
}

std::string glString(GLenum name) {
    const auto* text = reinterpret_cast<const char*>(glGetString(name));
    return text ? text : "";
}

}  // namespace

std::unique_ptr<Context> createHeadlessContext(std::string_view kind) {
#ifdef DIOPTRE_OSMESA
    if (kind == "osmesa" || kind == "auto") return createOsmesaContext();
#else
    if (kind == "osmesa") throw RunError("--context osmesa: this build has no OSMesa; use --context egl");
    if (kind == "auto") return createEglContext();
#endif
    if (kind == "egl") return createEglContext();
    throw RunError(fmt::format("--context {}: not a headless context; one of auto, osmesa, egl", kind));
}

void loadGl(GLADapiproc (*getProcAddress)(const char*)) {
    const int version = gladLoadGL(getProcAddress);
    if (version < GLAD_MAKE_VERSION(4, 5))
        throw RunError(fmt::format("OpenGL {}.{} found, 4.5 core needed", GLAD_VERSION_MAJOR(version),
                                   GLAD_VERSION_MINOR(version)));
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glDepthFunc(GL_GREATER);
    glClearDepth(0.0);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(onDebugMessage, nullptr);
}

RendererInfo rendererInfo() {
    RendererInfo info{glString(GL_VENDOR), glString(GL_RENDERER), glString(GL_VERSION), false};
    for (const char* name : {"llvmpipe", "softpipe", "swrast", "SWR"})
        if (info.renderer.find(name) != std::string::npos) info.software = true;
    return info;
}

}  // namespace dioptre
