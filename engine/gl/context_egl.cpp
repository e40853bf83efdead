#include <EGL/egl.h>
#include <EGL/eglext.h>

#include "core/error.hpp"
#include "gl/headless.hpp"

namespace dioptre {

namespace {

/// Surfaceless: the first device EGL offers (a GPU where there is one), else Mesa's surfaceless platform.
class EglContext final : public Context {
  public:
    EglContext() {
        display_ = openDisplay();
        if (display_ == EGL_NO_DISPLAY) throw RunError("--context egl: no EGL display, surfaceless or device");
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
        if (context_ == EGL_NO_CONTEXT) {
            eglTerminate(display_);
            throw RunError("--context egl: no OpenGL 4.5 core context");
        }
        if (!eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_)) {
            eglDestroyContext(display_, context_);
            eglTerminate(display_);
            throw RunError("--context egl: the context could not be made current without a surface");
        }
        loadGl(eglGetProcAddress);
    }
    ~EglContext() override {
        eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        eglDestroyContext(display_, context_);
        eglTerminate(display_);
    }

  private:
    static EGLDisplay openDisplay() {
        const auto getPlatformDisplay =
            reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
        const auto queryDevices = reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(eglGetProcAddress("eglQueryDevicesEXT"));
        if (!getPlatformDisplay) return EGL_NO_DISPLAY;
        EGLDeviceEXT devices[16];
        EGLint count = 0;
        if (queryDevices) queryDevices(16, devices, &count);
        for (EGLint i = 0; i < count; ++i) {
            const EGLDisplay display = getPlatformDisplay(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr);
            if (display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr)) return display;
        }
        const EGLDisplay display = getPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
        return display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr) ? display : EGL_NO_DISPLAY;
    }

    EGLDisplay display_ = EGL_NO_DISPLAY;
    EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace

std::unique_ptr<Context> createEglContext() {
    return std::make_unique<EglContext>();
}

}  // namespace dioptre
