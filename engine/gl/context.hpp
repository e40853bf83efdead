// A current OpenGL 4.5 core context. Contexts come and go (Mesa dropped OSMesa in 25.1): the renderer sees only a
// loaded GL. The window's context lives with the window, in app/.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "gl/api.hpp"

namespace dioptre {

/// Makes itself current on construction; one at a time per process, since the loaded GL functions are global.
class Context {
  public:
    Context() = default;
    virtual ~Context() = default;
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;
};

/// Off-screen context of a kind: "osmesa" (CPU, in process), "egl" (surfaceless: GPU or llvmpipe), "auto" (osmesa if
/// the build has it, else egl). Throws RunError naming the kind and the reason.
std::unique_ptr<Context> createHeadlessContext(std::string_view kind);

/// Loads GL's functions and sets the state that the whole program relies on: zero-to-one reversed depth, bytes
/// packed tightly, GL errors said on stderr. For contexts only; throws RunError below OpenGL 4.5.
void loadGl(GLADapiproc (*getProcAddress)(const char*));

struct RendererInfo {
    std::string vendor, renderer, version;
    bool software = false;  // a CPU rasteriser: no anisotropic filtering, no timer queries
};
RendererInfo rendererInfo();

}  // namespace dioptre
