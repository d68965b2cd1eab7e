#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>
#include <mutex>
#include <string_view>
#include <vector>

#include "render/gl/context.h"

namespace erbs::render {
namespace {

class EglContext : public Context {
 public:
  EglContext(EGLDisplay display, EGLContext context) : display_(display), context_(context) {}
  ~EglContext() override {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display_, context_);
  }
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;
  void* function(const char* name) const override { return reinterpret_cast<void*>(eglGetProcAddress(name)); }

 private:
  EGLDisplay display_;
  EGLContext context_;
};

// All displays, software device first: it gives the same pixels on every machine. Others that work without a window follow.
std::vector<EGLDisplay> displays() {
  std::vector<EGLDisplay> all;
  const auto query = reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(eglGetProcAddress("eglQueryDevicesEXT"));
  const auto describe = reinterpret_cast<PFNEGLQUERYDEVICESTRINGEXTPROC>(eglGetProcAddress("eglQueryDeviceStringEXT"));
  const auto platform = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
  if (!platform) return all;
  std::array<EGLDeviceEXT, 16> devices{};
  EGLint n = 0;
  if (query && describe && query(static_cast<EGLint>(devices.size()), devices.data(), &n)) {
    for (EGLint i = 0; i < n; ++i) {
      const char* extensions = describe(devices[static_cast<std::size_t>(i)], EGL_EXTENSIONS);
      if (extensions && std::string_view(extensions).find("EGL_MESA_device_software") != std::string_view::npos)
        all.push_back(platform(EGL_PLATFORM_DEVICE_EXT, devices[static_cast<std::size_t>(i)], nullptr));
    }
  }
  all.push_back(platform(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
  return all;
}

std::unique_ptr<Context> context_on(EGLDisplay display) {
  EGLint major = 0, minor = 0;
  if (display == EGL_NO_DISPLAY || !eglInitialize(display, &major, &minor) || !eglBindAPI(EGL_OPENGL_API)) return nullptr;
  constexpr std::array<EGLint, 3> any{EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint n = 0;
  if (!eglChooseConfig(display, any.data(), &config, 1, &n) || n == 0) config = EGL_NO_CONFIG_KHR;
  constexpr std::array<EGLint, 7> wish{
      EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
  EGLContext raw = eglCreateContext(display, config, EGL_NO_CONTEXT, wish.data());
  if (raw == EGL_NO_CONTEXT) return nullptr;
  auto context = std::make_unique<EglContext>(display, raw);
  if (!eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, raw)) return nullptr;
  return context;
}

}  // namespace

std::unique_ptr<Context> make_egl_context() {
  static std::mutex one_at_a_time;  // all threads share the displays
  const std::lock_guard lock(one_at_a_time);
  for (EGLDisplay display : displays())
    if (auto context = context_on(display)) return context;
  return nullptr;
}

}  // namespace erbs::render
