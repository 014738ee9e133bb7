#include "render/drawing_context.hpp"

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>

namespace axil::render {
namespace {

EGLDisplay openDisplay() {
  const auto platformDisplay = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
  EGLint major = 0, minor = 0;
  if (platformDisplay != nullptr) {
    const EGLDisplay surfaceless = platformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (surfaceless != EGL_NO_DISPLAY && eglInitialize(surfaceless, &major, &minor)) return surfaceless;
  }
  const EGLDisplay usual = eglGetDisplay(EGL_DEFAULT_DISPLAY);
  return usual != EGL_NO_DISPLAY && eglInitialize(usual, &major, &minor) ? usual : EGL_NO_DISPLAY;
}

}  // namespace

struct DrawingContext::Inside {
  Inside() = default;
  Inside(const Inside&) = delete;
  Inside& operator=(const Inside&) = delete;
  /// The display is the process's one and may serve another window, so it stays initialised.
  ~Inside() {
    if (display == EGL_NO_DISPLAY) return;
    eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (surface != EGL_NO_SURFACE) eglDestroySurface(display, surface);
    if (context != EGL_NO_CONTEXT) eglDestroyContext(display, context);
  }

  [[nodiscard]] bool open() {
    display = openDisplay();
    if (display == EGL_NO_DISPLAY || !eglBindAPI(EGL_OPENGL_API)) return false;
    constexpr std::array<EGLint, 15> wanted{EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_RED_SIZE, 8, EGL_GREEN_SIZE, 8,
                                            EGL_BLUE_SIZE, 8, EGL_ALPHA_SIZE, 8, EGL_DEPTH_SIZE, 24, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint found = 0;
    if (!eglChooseConfig(display, wanted.data(), &config, 1, &found) || found < 1) return false;
    constexpr std::array<EGLint, 7> version{EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 2, EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                            EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    context = eglCreateContext(display, config, EGL_NO_CONTEXT, version.data());
    // VTK asks the default framebuffer for its depth, so there must be one, however small.
    constexpr std::array<EGLint, 5> size{EGL_WIDTH, 16, EGL_HEIGHT, 16, EGL_NONE};
    surface = eglCreatePbufferSurface(display, config, size.data());
    return context != EGL_NO_CONTEXT && surface != EGL_NO_SURFACE && makeCurrent();
  }

  [[nodiscard]] bool makeCurrent() const { return eglMakeCurrent(display, surface, surface, context) == EGL_TRUE; }

  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;
  EGLSurface surface = EGL_NO_SURFACE;
};

DrawingContext::DrawingContext(std::unique_ptr<Inside> inside) : inside_(std::move(inside)) {}
DrawingContext::DrawingContext(DrawingContext&&) noexcept = default;
DrawingContext& DrawingContext::operator=(DrawingContext&&) noexcept = default;
DrawingContext::~DrawingContext() = default;

Result<DrawingContext> DrawingContext::open() {
  auto inside = std::make_unique<Inside>();
  if (!inside->open())
    return fail(ErrorCode::NoAnswer, "no picture can be drawn: this machine has no EGL with OpenGL 3.2 (on Debian: apt-get install libegl1 libgl1-mesa-dri)");
  return DrawingContext(std::move(inside));
}

bool DrawingContext::makeCurrent() const { return inside_->makeCurrent(); }

}  // namespace axil::render
