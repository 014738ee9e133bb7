#include "ui/drawing.hpp"

#include <GL/gl.h>
#include <imgui.h>
#include <imgui_impl_opengl3.h>

namespace axil::ui {
namespace {

/// Letters stand on whole pixels and plain areas are one pixel of the fonts' texture: nothing of it has to be smoothed, which in software
/// is most of the cost of a frame.
void sendFonts() {
  ImGui_ImplOpenGL3_CreateFontsTexture();
  glBindTexture(GL_TEXTURE_2D, static_cast<GLuint>(reinterpret_cast<std::intptr_t>(ImGui::GetIO().Fonts->TexID)));
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

}  // namespace

void prepareDrawing(Studio& studio) {
  if (studio.prepareFonts()) ImGui_ImplOpenGL3_DestroyFontsTexture();
  ImGui_ImplOpenGL3_NewFrame();
  if (ImGui::GetIO().Fonts->TexID == nullptr) sendFonts();
}

void draw(const Studio& studio, int width, int height) {
  const ImVec4 ground = ImGui::ColorConvertU32ToFloat4(studio.ground());
  glViewport(0, 0, width, height);
  glClearColor(ground.x, ground.y, ground.z, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

}  // namespace axil::ui
