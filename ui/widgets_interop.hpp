#pragma once
/// \file
/// Private to ui: the small parts that panels are made of, in the project's look. The one header with the window library's types.

#include "ui/panels.hpp"

#define IMGUI_DEFINE_MATH_OPERATORS
#include <imgui.h>

namespace axil::ui {

/// The fonts of the running window, in the order they were added.
enum class Face { Body, Small, Heading, Mono };
[[nodiscard]] ImFont* font(Face face);

enum class Icon { Describe, Photos, Stems, Leaves, Grammar, Grow, Play, Pause, Start, End, Check, Cross, Folder, File, Eye, Expand, Pencil };
void drawIcon(ImDrawList& list, Icon icon, ImVec2 centre, float size, Colour colour);

/// Remembers where the last item is, under its key, so that a replayed session can press it.
void landmark(const Panel& panel, std::string_view key);

enum class Emphasis { Plain, Primary, Quiet };
bool button(const Panel& panel, std::string_view key, Emphasis emphasis = Emphasis::Plain, float width = 0);
bool iconButton(const Panel& panel, const char* id, Icon icon, const char* tip, float size);
/// One of several; true when it was pressed.
bool choice(const Panel& panel, std::string_view key, bool chosen, float width);
void heading(const Panel& panel, std::string_view key);
/// Wrapped text.
void words(const Panel& panel, std::string_view text, Colour colour);
void quiet(const Panel& panel, std::string_view text);
/// A message with a mark of its kind; those of other rooms in the language of the window.
void say(const Panel& panel, NoticeKind kind, std::string_view text);
void fact(const Panel& panel, const char* name, const std::string& value);
void gap(const Panel& panel, float height);
/// A view's name in the language of the window; a name of the user's own stays.
std::string nameOfView(const Panel& panel, const std::string& view);
/// "3 stems": a number in the words of `key`.
std::string countOf(const Panel& panel, std::size_t n, const char* key);
/// One of some names, or none; true when another was chosen.
bool combo(const char* id, const std::vector<std::string>& names, std::string& chosen, const char* none);
/// The outline of a leaf of that shape, on a plate across the panel; nothing for an unknown shape.
void leafPreview(const Panel& panel, const std::string& shape);
[[nodiscard]] std::vector<std::string> leafShapeNames();
/// A text on a rounded plate, from its upper left corner; gives its width.
float chip(ImDrawList& list, ImVec2 at, std::string_view text, Colour ground, Colour ink, float pad);
void drawMark(ImDrawList& list, Mark mark, ImVec2 at, float radius, Colour colour);
void dashed(ImDrawList& list, ImVec2 from, ImVec2 to, Colour colour, float width, float dash);

}  // namespace axil::ui
