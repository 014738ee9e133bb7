#pragma once
/// \file
/// Preferences: what the window remembers from one day to the next: looks, the sizes of its parts, projects opened lately. A small text
/// file in the state folder, one `key<TAB>value` a line; lines that are not understood are left out, so an old or damaged file does no harm.

#include "base/result.hpp"
#include "ui/texts.hpp"
#include "ui/theme.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace axil::ui {

/// Where the parts of the window meet. Widths in px at scale 1; shares of the panes' area from its left and top.
struct Layout {
  float left = 296;
  float right = 268;
  float across = 0.5f;
  float down = 0.5f;
  friend bool operator==(const Layout&, const Layout&) = default;
};
/// No part so small or large that nothing can be read or done.
[[nodiscard]] Layout withinReason(Layout layout);

struct Preferences {
  std::optional<Theme> theme;
  std::optional<Language> language;
  std::optional<float> scale;
  Layout layout;
  std::vector<std::filesystem::path> recent;  ///< projects, the latest first; at most kMostRecent
  friend bool operator==(const Preferences&, const Preferences&) = default;
};
inline constexpr std::size_t kMostRecent = 8;

[[nodiscard]] std::string print(const Preferences& preferences);
[[nodiscard]] Preferences parsePreferences(std::string_view text);

/// As they are in the folder; the first ones where there are none.
[[nodiscard]] Preferences readPreferences(const std::filesystem::path& stateFolder);
/// Fails with Unwritable.
[[nodiscard]] Result<void> writePreferences(const std::filesystem::path& stateFolder, const Preferences& preferences);

/// `project` first, each once.
void rememberProject(Preferences& preferences, const std::filesystem::path& project);

}  // namespace axil::ui
