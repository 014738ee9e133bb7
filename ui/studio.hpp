#pragma once
/// \file
/// Studio: one window's worth of Axil, without the window: the session, the work in the background, and one frame of drawing. A desktop
/// window (window.hpp) and a headless one (headless.hpp) call `frame` between the window library's begin and end of a frame, on the one
/// thread that has the drawing context.

#include "base/result.hpp"
#include "document/session.hpp"
#include "ui/state.hpp"

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

namespace axil::ui {

struct StudioOptions {
  std::filesystem::path stateFolder;  ///< for journals, locks and preferences; empty: none are kept
  std::optional<Theme> theme;         ///< left out: as last time
  std::optional<Language> language;
  std::optional<float> scale;
  float screenScale = 1;              ///< what the screen asks for where nobody else does
  std::function<void()> wake;         ///< called from other threads when there is something new to draw
};

class Studio {
 public:
  [[nodiscard]] static Result<Studio> create(StudioOptions options);
  Studio(Studio&&) noexcept;
  Studio& operator=(Studio&&) noexcept;
  ~Studio();

  [[nodiscard]] Result<void> open(const std::filesystem::path& project);
  /// In the line at the bottom, in the person's language.
  void tell(const Error& error);
  /// One line of a saved session: a step, undo or redo.
  [[nodiscard]] Result<void> runLine(std::string_view line);
  /// Files dropped on the window: a project is opened, photos get a view.
  void drop(const std::vector<std::filesystem::path>& files);

  /// Before each frame; true when the fonts' texture must be sent again.
  [[nodiscard]] bool prepareFonts();
  /// What the whole window is cleared to before a frame is drawn.
  [[nodiscard]] Colour ground() const;
  void frame();

  /// Something in the background has still to come, or the plant is growing: draw again soon.
  [[nodiscard]] bool isBusy() const;
  [[nodiscard]] bool hasEnded() const;
  void askToEnd();  ///< unsaved work is asked about first

  [[nodiscard]] const document::Session& session() const;
  [[nodiscard]] UiState& state();

 private:
  struct Inside;
  explicit Studio(std::unique_ptr<Inside> inside);
  std::unique_ptr<Inside> inside_;
};

}  // namespace axil::ui
