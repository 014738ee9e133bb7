#include "render/headless_window.hpp"

#include "render/drawing_context.hpp"

#include <vtk_glew.h>

#include <vtkAutoInit.h>
#include <vtkCallbackCommand.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkRenderer.h>

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
  DrawingContext context;             // outlives the window, whose end still draws with it
  vtkNew<ContextWindow> window;

  explicit Inside(DrawingContext opened) : context(std::move(opened)) {}

  Inside(const Inside&) = delete;
  Inside& operator=(const Inside&) = delete;
  ~Inside() {
    if (context.makeCurrent()) window->Finalize();
  }
};

HeadlessWindow::HeadlessWindow(std::unique_ptr<Inside> inside) : inside_(std::move(inside)) {}
HeadlessWindow::HeadlessWindow(HeadlessWindow&&) noexcept = default;
HeadlessWindow& HeadlessWindow::operator=(HeadlessWindow&&) noexcept = default;
HeadlessWindow::~HeadlessWindow() = default;

Result<HeadlessWindow> HeadlessWindow::open() {
  auto context = DrawingContext::open();
  if (!context) return context.failure();
  auto inside = std::make_unique<Inside>(std::move(*context));
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
