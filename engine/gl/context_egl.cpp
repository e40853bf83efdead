#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <string>
#include <vector>

#include "core/error.hpp"
#include "gl/headless.hpp"

namespace dioptre {

namespace {

/// Surfaceless: the first device EGL offers (a GPU where there is one) that gives such a context, else Mesa's
/// surfaceless platform.
class EglContext final : public Context {
  public:
    EglContext() {
        std::string problem = "no EGL display, surfaceless or device";
        for (const EGLDisplay display : displays()) {
            try {
                open(display);
                return;
            } catch (const RunError& error) {
                problem = error.what();
                close();
            }
        }
        throw RunError("--context egl: " + problem);
    }
    ~EglContext() override { close(); }

  private:
    static std::vector<EGLDisplay> displays() {
        const auto getPlatformDisplay =
            reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
        const auto queryDevices = reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(eglGetProcAddress("eglQueryDevicesEXT"));
        if (!getPlatformDisplay) return {};
        EGLDeviceEXT devices[16];
        EGLint count = 0;
        if (queryDevices) queryDevices(16, devices, &count);
        std::vector<EGLDisplay> found;
        found.reserve(static_cast<std::size_t>(count) + 1);
        for (EGLint i = 0; i < count; ++i)
            found.push_back(getPlatformDisplay(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr));
        found.push_back(getPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
        std::erase(found, EGL_NO_DISPLAY);
        return found;
    }

    void open(EGLDisplay display) {
        if (!eglInitialize(display, nullptr, nullptr)) throw RunError("no EGL display, surfaceless or device");
        display_ = display;
        eglBindAPI(EGL_OPENGL_API);
        const EGLint configAttributes[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                                           EGL_NONE};
        EGLConfig config = nullptr;
        EGLint count = 0;
        eglChooseConfig(display_, configAttributes, &config, 1, &count);
        const EGLint attributes[] = {
            EGL_CONTEXT_MAJOR_VERSION,           4,       EGL_CONTEXT_MINOR_VERSION, 5, EGL_CONTEXT_OPENGL_PROFILE_MASK,
            EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
        context_ = eglCreateContext(display_, count > 0 ? config : EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
        if (context_ == EGL_NO_CONTEXT) throw RunError("no OpenGL 4.5 core context");
        if (!eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
            throw RunError("the context could not be made current without a surface");
        loadGl(eglGetProcAddress);
    }

    void close() {
        if (display_ == EGL_NO_DISPLAY) return;
        eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        if (context_ != EGL_NO_CONTEXT) eglDestroyContext(display_, context_);
        eglTerminate(display_);
        context_ = EGL_NO_CONTEXT;
        display_ = EGL_NO_DISPLAY;
    }

    EGLDisplay display_ = EGL_NO_DISPLAY;
    EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace

std::unique_ptr<Context> createEglContext() {
    return std::make_unique<EglContext>();
}

}  // namespace dioptre
