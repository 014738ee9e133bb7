#include "render/headless_window.hpp"

#include <vtk_glew.h>

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <vtkAutoInit.h>
#include <vtkCallbackCommand.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkRenderer.h>

#include <array>
#include <string>

VTK_MODULE_INIT(vtkRenderingOpenGL2)

namespace axil::render {
namespace {

/// GLEW's word for "no GLX display": every entry point is loaded all the same, since EGL shares them.
constexpr GLenum glewWithoutDisplay = 4;

/// VTK's window on a context that someone else made. Its own start refuses a context without a GLX display.
class ContextWindow : public vtkGenericOpenGLRenderWindow {
 public:
  static ContextWindow* New();
  vtkTypeMacro(ContextWindow, vtkGenericOpenGLRenderWindow)

  void OpenGLInitContext() override {
    if (this->Initialized) return;
    this->ContextCreationTime.Modified();
    const GLenum outcome = glewInit();
    this->GlewInitValid = outcome == GLEW_OK || outcome == glewWithoutDisplay;
    if (!this->GlewInitValid) return;
    this->Initialized = true;
    GLfloat widths[2] = {1, 1};
    glGetFloatv(GL_ALIASED_LINE_WIDTH_RANGE, widths);
    this->MaximumHardwareLineWidth = widths[1];
  }

  /// The end of a drawing: nothing is shown anywhere, so nothing is copied anywhere.
  void Frame() override {}

  /// What was drawn, RGBA, rows from the bottom.
  [[nodiscard]] std::vector<std::uint8_t> pixels() {
    const int* size = this->GetSize();
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) * 4);
    this->RenderFramebuffer->Bind(GL_READ_FRAMEBUFFER);
    this->RenderFramebuffer->ActivateReadBuffer(0);
    if (this->MultiSamples > 1) {  // the samples of a pixel become one on the way to another buffer
      this->DisplayFramebuffer->Bind(GL_DRAW_FRAMEBUFFER);
      this->DisplayFramebuffer->ActivateDrawBuffer(0);
      glBlitFramebuffer(0, 0, size[0], size[1], 0, 0, size[0], size[1], GL_COLOR_BUFFER_BIT, GL_NEAREST);
      this->DisplayFramebuffer->Bind(GL_READ_FRAMEBUFFER);
      this->DisplayFramebuffer->ActivateReadBuffer(0);
    }
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glReadPixels(0, 0, size[0], size[1], GL_RGBA, GL_UNSIGNED_BYTE, bytes.data());
    return bytes;
  }

  ContextWindow(const ContextWindow&) = delete;
  ContextWindow& operator=(const ContextWindow&) = delete;

 protected:
  ContextWindow() = default;
  ~ContextWindow() override = default;
};
vtkStandardNewMacro(ContextWindow)

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

class EglContext {
 public:
  EglContext() = default;
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;
  /// The display is the process's one and may serve another window, so it stays initialised.
  ~EglContext() {
    if (display_ == EGL_NO_DISPLAY) return;
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (surface_ != EGL_NO_SURFACE) eglDestroySurface(display_, surface_);
    if (context_ != EGL_NO_CONTEXT) eglDestroyContext(display_, context_);
  }

  [[nodiscard]] bool open() {
    display_ = openDisplay();
    if (display_ == EGL_NO_DISPLAY || !eglBindAPI(EGL_OPENGL_API)) return false;
    constexpr std::array<EGLint, 15> wanted{EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_RED_SIZE, 8, EGL_GREEN_SIZE, 8,
                                            EGL_BLUE_SIZE, 8, EGL_ALPHA_SIZE, 8, EGL_DEPTH_SIZE, 24, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint found = 0;
    if (!eglChooseConfig(display_, wanted.data(), &config, 1, &found) || found < 1) return false;
    constexpr std::array<EGLint, 7> version{EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 2, EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                            EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, version.data());
    // VTK asks the default framebuffer for its depth, so there must be one, however small.
    constexpr std::array<EGLint, 5> size{EGL_WIDTH, 16, EGL_HEIGHT, 16, EGL_NONE};
    surface_ = eglCreatePbufferSurface(display_, config, size.data());
    return context_ != EGL_NO_CONTEXT && surface_ != EGL_NO_SURFACE && makeCurrent();
  }

  [[nodiscard]] bool makeCurrent() const { return eglMakeCurrent(display_, surface_, surface_, context_) == EGL_TRUE; }

 private:
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
  EGLSurface surface_ = EGL_NO_SURFACE;
};

/// Collects what VTK would print on the terminal.
class Complaints {
 public:
  explicit Complaints(vtkObject& speaker) : speaker_(speaker) {
    listener_->SetClientData(&text_);
    listener_->SetCallback([](vtkObject*, unsigned long, void* text, void* words) {
      if (words != nullptr) *static_cast<std::string*>(text) += static_cast<const char*>(words);
    });
    tag_ = speaker_.AddObserver(vtkCommand::ErrorEvent, listener_);
  }
  Complaints(const Complaints&) = delete;
  Complaints& operator=(const Complaints&) = delete;
  ~Complaints() { speaker_.RemoveObserver(tag_); }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  vtkObject& speaker_;
  vtkNew<vtkCallbackCommand> listener_;
  std::string text_;
  unsigned long tag_ = 0;
};

}  // namespace

struct HeadlessWindow::Inside {
  EglContext context;                 // outlives the window, whose end still draws with it
  vtkNew<ContextWindow> window;

  ~Inside() {
    if (context.makeCurrent()) window->Finalize();
  }
};

HeadlessWindow::HeadlessWindow(std::unique_ptr<Inside> inside) : inside_(std::move(inside)) {}
HeadlessWindow::HeadlessWindow(HeadlessWindow&&) noexcept = default;
HeadlessWindow& HeadlessWindow::operator=(HeadlessWindow&&) noexcept = default;
HeadlessWindow::~HeadlessWindow() = default;

Result<HeadlessWindow> HeadlessWindow::open() {
  auto inside = std::make_unique<Inside>();
  if (!inside->context.open())
    return fail(ErrorCode::NoAnswer, "no picture can be drawn: this machine has no EGL with OpenGL 3.2 (on Debian: apt-get install libegl1 libgl1-mesa-dri)");
  inside->window->SetSupportsOpenGL(1);
  inside->window->SetIsDirect(1);
  inside->window->SetIsCurrent(true);
  inside->window->SetReadyForRendering(true);
  inside->window->SetMultiSamples(0);
  inside->window->SetAlphaBitPlanes(1);
  inside->window->SetFrameBlitModeToNoBlit();
  return HeadlessWindow(std::move(inside));
}

Result<std::vector<std::uint8_t>> HeadlessWindow::draw(vtkRenderer& renderer, const DrawSize& size) {
  const auto [width_px, height_px, edgeSamples] = size;
  ContextWindow& window = *inside_->window;
  if (!inside_->context.makeCurrent())
    return fail(ErrorCode::NoAnswer, "no picture can be drawn on this thread: it has another window's drawing context");
  const Complaints complaints(window);
  window.SetMultiSamples(edgeSamples);
  window.SetSize(width_px, height_px);
  if (!window.HasRenderer(&renderer)) window.AddRenderer(&renderer);
  window.Render();
  if (complaints.text().empty() && window.GetSize()[0] == width_px && window.GetSize()[1] == height_px) return window.pixels();
  return fail(ErrorCode::NoAnswer, "the picture could not be drawn, " + std::to_string(width_px) + " x " + std::to_string(height_px) +
                                       " samples at once: " + complaints.text());
}

void HeadlessWindow::forget(vtkRenderer& renderer) {
  if (inside_->context.makeCurrent()) inside_->window->RemoveRenderer(&renderer);
}

}  // namespace axil::render
