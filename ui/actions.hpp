#pragma once
/// \file
/// Actions: everything that a key or the palette can start, as rows of one table. The sheet of shortcuts and the palette are drawn
/// from the same rows, so a shortcut that exists can be found.

#include "ui/panels.hpp"

#include <span>
#include <string>
#include <vector>

namespace axil::ui {

/// A key as the window numbers it, and what is held with it. Key 0: none.
struct Chord {
  int key = 0;
  enum class Held { Nothing, Control, ControlShift, Shift } held = Held::Nothing;
};

struct Action {
  const char* name;    ///< its words in texts.tsv, and what a replayed session calls it
  const char* keys;    ///< as a person reads them; empty: it has none
  Chord chord;
  bool (*possible)(const Panel&);
  Taken (*act)(const Panel&);
};

[[nodiscard]] std::span<const Action> actions();

/// What the keys pressed in this frame start; at most one action.
[[nodiscard]] Taken actOnKeys(const Panel& panel);

/// The actions whose words, in the language shown or in English, have the letters of `typed` in this order; the closest first. Those
/// that cannot be done now are left out.
[[nodiscard]] std::vector<const Action*> actionsFor(const Panel& panel, const std::string& typed);

/// How well `words` answers what was typed: lower is better; nothing where a letter is missing. Capitals do not matter.
[[nodiscard]] std::optional<int> likeness(std::string_view words, std::string_view typed);

}  // namespace axil::ui
