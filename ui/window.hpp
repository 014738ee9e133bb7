#pragma once
/// \file
/// The desktop window.

#include "base/result.hpp"
#include "ui/studio.hpp"

#include <filesystem>

namespace axil::ui {

struct WindowOptions {
  std::filesystem::path project;   ///< empty: the window begins with what can be opened
  StudioOptions studio;            ///< `screenScale` is filled in
};

/// Opens the window and returns when it is closed. Fails with NoAnswer where no window can be opened (no display, no OpenGL 3.2), and as
/// opening the project does.
[[nodiscard]] Result<void> runWindow(WindowOptions options);

}  // namespace axil::ui
