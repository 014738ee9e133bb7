#include "document/lookup.hpp"
#include "ui/export_file.hpp"
#include "ui/widgets_interop.hpp"

#include <algorithm>
#include <cstdlib>
#include <imgui_stdlib.h>

namespace axil::ui {
namespace {

namespace fs = std::filesystem;

struct Entry {
  fs::path path;
  bool folder = false;
};

std::string lowerExtension(const fs::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return extension;
}

bool isWanted(const fs::path& path, DialogKind kind) {
  const std::string extension = lowerExtension(path);
  if (kind == DialogKind::Photo) return extension == ".jpg" || extension == ".jpeg" || extension == ".png" || extension == ".webp" || extension == ".bmp";
  if (kind == DialogKind::ExportFile) return canExport(path);
  return extension == ".axil";
}

/// Folders first, each by name; hidden ones left out. A folder that cannot be read is empty.
std::vector<Entry> entriesOf(const fs::path& folder, DialogKind kind) {
  std::vector<Entry> entries;
  std::error_code none;
  for (fs::directory_iterator it(folder, fs::directory_options::skip_permission_denied, none), end; !none && it != end; it.increment(none)) {
    std::error_code ignored;
    const bool isFolder = it->is_directory(ignored);
    if (it->path().filename().string().starts_with(".") || (!isFolder && !isWanted(it->path(), kind))) continue;
    entries.push_back({it->path(), isFolder});
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return std::pair(!a.folder, a.path) < std::pair(!b.folder, b.path); });
  return entries;
}

/// The photo as the project should name it: inside the project's folder relative to it.
std::string photoName(const Panel& panel, const fs::path& photo) {
  if (panel.session.path().empty()) return photo.string();
  const fs::path relative = photo.lexically_relative(panel.session.openProject().folder);
  return relative.empty() || *relative.begin() == ".." ? photo.string() : relative.generic_string();
}

Taken chosen(const Panel& panel, const fs::path& path) {
  FileDialogState& dialog = panel.state.dialog;
  const DialogKind kind = std::exchange(dialog.kind, DialogKind::None);
  if (kind == DialogKind::Open) panel.state.wishes.push_back(WishOpen{path});
  if (kind == DialogKind::SaveAs) panel.state.wishes.push_back(WishSaveAs{path.extension() == ".axil" ? path : fs::path(path.string() + ".axil")});
  if (kind == DialogKind::ExportFile) panel.state.wishes.push_back(WishExportFile{path});
  if (kind != DialogKind::Photo) return std::nullopt;
  const std::string photo = photoName(panel, path);
  if (document::viewNamed(panel.project, dialog.view)) return document::Step{document::RelinkPhoto{dialog.view, photo}};
  return document::Step{document::AddView{dialog.view, photo}};
}

Taken listing(const Panel& panel) {
  Taken taken;
  FileDialogState& dialog = panel.state.dialog;
  std::optional<fs::path> enter;
  int row = 0;
  for (const Entry& entry : entriesOf(dialog.folder, dialog.kind)) {
    ImGui::PushID(row++);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float height = panel.px(28);
    const std::string name = entry.path.filename().string();
    if (ImGui::Selectable("##entry", !entry.folder && dialog.name == name, ImGuiSelectableFlags_AllowDoubleClick, {0, height})) {
      if (entry.folder) enter = entry.path;
      else dialog.name = name;
      if (!entry.folder && ImGui::IsMouseDoubleClicked(0)) taken = chosen(panel, entry.path);
    }
    landmark(panel, "file_" + name);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    drawIcon(list, entry.folder ? Icon::Folder : Icon::File, {at.x + panel.px(14), at.y + height / 2}, panel.px(16), entry.folder ? panel.palette.accent : panel.palette.quiet);
    list.AddText({at.x + panel.px(32), at.y + (height - ImGui::GetFontSize()) / 2}, panel.palette.text, name.c_str());
    ImGui::PopID();
  }
  if (enter) dialog.folder = *enter;
  return taken;
}

}  // namespace

Taken fileDialog(const Panel& panel) {
  FileDialogState& dialog = panel.state.dialog;
  if (dialog.kind == DialogKind::None) return std::nullopt;
  if (dialog.folder.empty()) dialog.folder = fs::current_path();
  Taken taken;
  const ImVec2 screen = ImGui::GetIO().DisplaySize, size{std::min(panel.px(640), screen.x * 0.9f), std::min(panel.px(520), screen.y * 0.9f)};
  ImGui::SetNextWindowPos({(screen.x - size.x) / 2, (screen.y - size.y) / 2});
  ImGui::SetNextWindowSize(size);
  ImGui::SetNextWindowFocus();
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {panel.px(20), panel.px(16)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, panel.px(10));
  ImGui::Begin("##dialog", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings);
  ImGui::PopStyleVar(2);
  ImGui::PushFont(font(Face::Heading));
  const char* title = dialog.kind == DialogKind::Open ? "open_project" : dialog.kind == DialogKind::SaveAs ? "save_as" : dialog.kind == DialogKind::ExportFile ? "export_as" : "photo_for";
  ImGui::TextUnformatted(filled(panel.t(title), {{"view", nameOfView(panel, dialog.view)}}).c_str());
  ImGui::PopFont();
  if (button(panel, "folder_up")) dialog.folder = dialog.folder.has_parent_path() ? dialog.folder.parent_path() : dialog.folder;
  ImGui::SameLine(0, panel.px(6));
  if (const char* home = std::getenv("HOME"); home != nullptr && button(panel, "folder_home")) dialog.folder = home;
  ImGui::SameLine(0, panel.px(6));
  std::string folder = dialog.folder.string();
  ImGui::SetNextItemWidth(-1);
  std::error_code ignored;
  if (ImGui::InputText("##path", &folder, ImGuiInputTextFlags_EnterReturnsTrue) && fs::is_directory(folder, ignored)) dialog.folder = folder;
  gap(panel, 2);
  ImGui::BeginChild("##files", {0, -panel.px(48)}, false);
  taken = listing(panel);
  ImGui::EndChild();
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - panel.px(210));
  const bool entered = ImGui::InputText("##name", &dialog.name, ImGuiInputTextFlags_EnterReturnsTrue);
  landmark(panel, "dialog_name");
  ImGui::SameLine(0, panel.px(8));
  const bool pressed = button(panel, dialog.kind == DialogKind::SaveAs || dialog.kind == DialogKind::ExportFile ? "save" : "open", Emphasis::Primary, panel.px(95));
  if ((entered || pressed) && !dialog.name.empty()) taken = chosen(panel, dialog.folder / dialog.name);
  ImGui::SameLine(0, panel.px(8));
  if (button(panel, "cancel", Emphasis::Plain, panel.px(95))) dialog.kind = DialogKind::None;
  ImGui::End();
  return taken;
}

}  // namespace axil::ui
