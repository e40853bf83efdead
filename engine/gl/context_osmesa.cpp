#ifdef DIOPTRE_OSMESA
#include <array>
#include <cstdint>
#include <memory>
#include <type_traits>

#include "core/error.hpp"
#include "gl/headless.hpp"
// After glad, which must come first.
#include <GL/osmesa.h>

namespace dioptre {

namespace {

class OsmesaContext final : public Context {
  public:
    OsmesaContext() {
        const int attributes[] = {OSMESA_FORMAT,
                                  OSMESA_RGBA,
                                  OSMESA_PROFILE,
                                  OSMESA_CORE_PROFILE,
                                  OSMESA_CONTEXT_MAJOR_VERSION,
                                  4,
                                  OSMESA_CONTEXT_MINOR_VERSION,
                                  5,
                                  0};
        context_.reset(OSMesaCreateContextAttribs(attributes, nullptr));
        if (!context_) throw RunError("--context osmesa: no OpenGL 4.5 core context from this OSMesa");
        if (!OSMesaMakeCurrent(context_.get(), surface_.data(), GL_UNSIGNED_BYTE, 1, 1))
            throw RunError("--context osmesa: the context could not be made current");
        loadGl(OSMesaGetProcAddress);
    }

  private:
    struct Destroy {
        void operator()(OSMesaContext context) const { OSMesaDestroyContext(context); }
    };
    std::unique_ptr<std::remove_pointer_t<OSMesaContext>, Destroy> context_;
    std::array<std::uint8_t, 4> surface_{};  // the default framebuffer, never drawn to
};

}  // namespace

std::unique_ptr<Context> createOsmesaContext() {
    return std::make_unique<OsmesaContext>();
}

}  // namespace dioptre
#endif
