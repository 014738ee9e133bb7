#include "ui/window.hpp"

#include "ui/drawing.hpp"

#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_impl_glfw.h>
#include <imgui_impl_opengl3.h>

#include <cmath>
#include <string>

namespace axil::ui {
namespace {

std::string& lastWords() {
  static std::string words;  // GLFW's callback takes no argument of ours
  return words;
}

/// GLFW, its window, and the window library on it; ends them in order.
class Desktop {
 public:
  Desktop() = default;
  Desktop(const Desktop&) = delete;
  Desktop& operator=(const Desktop&) = delete;
  ~Desktop() {
    if (ready_) {
      ImGui_ImplOpenGL3_Shutdown();
      ImGui_ImplGlfw_Shutdown();
      ImGui::DestroyContext();
    }
    if (window_ != nullptr) glfwDestroyWindow(window_);
    glfwTerminate();
  }

  Result<void> open() {
    glfwSetErrorCallback([](int, const char* words) { lastWords() = words; });
    if (glfwInit() != GLFW_TRUE) return fail(ErrorCode::NoAnswer, "no window can be opened: " + lastWords() + "; without a display use --replay with --screenshot");
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 2);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    window_ = glfwCreateWindow(1440, 900, "Axil Studio", nullptr, nullptr);
    if (window_ == nullptr) return fail(ErrorCode::NoAnswer, "no window can be opened: " + lastWords() + " (OpenGL 3.2 is needed)");
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(1);
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    ready_ = ImGui_ImplGlfw_InitForOpenGL(window_, true) && ImGui_ImplOpenGL3_Init("#version 150");
    if (!ready_) return fail(ErrorCode::NoAnswer, "no window can be opened: the drawing library does not start");
    return {};
  }

  [[nodiscard]] GLFWwindow* window() const { return window_; }
  [[nodiscard]] float scale() const {
    float x = 1, y = 1;
    glfwGetWindowContentScale(window_, &x, &y);
    return x;
  }

 private:
  GLFWwindow* window_ = nullptr;
  bool ready_ = false;
};

void drawFrame(Studio& studio, GLFWwindow* window) {
  prepareDrawing(studio);
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
  studio.frame();
  ImGui::Render();
  int width = 0, height = 0;
  glfwGetFramebufferSize(window, &width, &height);
  draw(studio, width, height);
  glfwSwapBuffers(window);
}

std::string titleOf(const document::Session& session) {
  return session.project().name + (session.isDirty() ? " •" : "") + " – Axil Studio";
}

void loop(Studio& studio, GLFWwindow* window) {
  std::string title;
  int settling = 3;  // frames after an event, until everything stands
  while (!studio.hasEnded()) {
    if (studio.isBusy()) settling = 3;
    if (settling > 0) glfwWaitEventsTimeout(studio.state().playing ? 0.002 : 0.02);
    else glfwWaitEventsTimeout(0.5);
    settling = std::max(settling - 1, 0);
    const ImGuiIO& io = ImGui::GetIO();
    if (io.MouseDelta.x != 0 || io.MouseDelta.y != 0 || ImGui::IsAnyMouseDown() || io.WantTextInput) settling = 3;
    drawFrame(studio, window);
    if (const std::string now = titleOf(studio.session()); now != title) glfwSetWindowTitle(window, (title = now).c_str());
    if (glfwWindowShouldClose(window) == GLFW_TRUE) {
      glfwSetWindowShouldClose(window, GLFW_FALSE);
      studio.askToEnd();
      settling = 3;
    }
  }
}

}  // namespace

Result<void> runWindow(WindowOptions options) {
  Desktop desktop;
  if (auto opened = desktop.open(); !opened) return opened;
  options.studio.screenScale = desktop.scale();
  options.studio.wake = [] { glfwPostEmptyEvent(); };
  auto studio = Studio::create(std::move(options.studio));
  if (!studio) return studio.failure();
  if (!options.project.empty())
    if (auto opened = studio->open(options.project); !opened) studio->tell(opened.error());
  glfwSetWindowUserPointer(desktop.window(), &*studio);
  glfwSetDropCallback(desktop.window(), [](GLFWwindow* window, int count, const char** paths) {
    static_cast<Studio*>(glfwGetWindowUserPointer(window))->drop({paths, paths + count});
  });
  loop(*studio, desktop.window());
  return {};
}

}  // namespace axil::ui
