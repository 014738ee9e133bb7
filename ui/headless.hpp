#pragma once
/// \file
/// The studio without a window: drawn into memory, driven by lines of text. Sessions for tests, bug reports and pictures are such lines.
///
/// A line is a step of a saved session (document/replay.hpp), or a hand's doing:
///   ui click VIEW X Y        at a place of a photo, px; also `ui shift_click`
///   ui move VIEW X Y         the mouse stands there
///   ui drag VIEW X Y X2 Y2   with the left button
///   ui menu VIEW X Y         with the right button; then `ui press menu_...`
///   ui pull NAME DX DY      what has a name, with the left button: a border between parts, the selected node in space (selected_in_space); px of the screen
///   ui click_in NAME X Y     in what has a name (pane_plant), px of the screen from its upper left corner
///   ui wheel VIEW X Y N      N notches over that place
///   ui pan VIEW DX DY        drag with the middle button, px of the screen
///   ui press NAME            a button by its name (a key of data/texts.tsv, or play, track, stem_2, photo_front, file_NAME ...)
///   ui key NAME              escape, delete, f1, a letter or digit; with ctrl+ and shift+ before it
///   ui type TEXT             into the field that is being written
///   ui wait                  until nothing is left to do in the background
///   ui frames N              N frames
///   ui way NAME, ui theme dark|light, ui language en|zh_hant|zh_hans, ui scale N, ui time T, ui orbit AZIMUTH ELEVATION ZOOM
///   ui screenshot FILE.png
/// Empty lines and lines that begin with # do not count.

#include "base/result.hpp"
#include "render/types.hpp"
#include "ui/studio.hpp"

#include <memory>
#include <string_view>

namespace axil::ui {

class HeadlessStudio {
 public:
  /// Fails with NoAnswer where nothing can be drawn at all.
  [[nodiscard]] static Result<HeadlessStudio> open(StudioOptions options, int width_px, int height_px);
  HeadlessStudio(HeadlessStudio&&) noexcept;
  HeadlessStudio& operator=(HeadlessStudio&&) noexcept;
  ~HeadlessStudio();

  [[nodiscard]] Studio& studio();
  /// Fails at the first line that cannot be done: `line 12: ...`.
  [[nodiscard]] Result<void> run(std::string_view lines);
  /// One frame, drawn to its last pixel: what the window does sixty times a second.
  void drawFrame();
  /// What the window shows, when all in the background is done.
  [[nodiscard]] Result<render::Image> picture();

 private:
  struct Inside;
  explicit HeadlessStudio(std::unique_ptr<Inside> inside);
  std::unique_ptr<Inside> inside_;
};

}  // namespace axil::ui
