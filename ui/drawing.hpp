#pragma once
/// \file
/// One frame into whatever the drawing context draws to, for the desktop window and the headless one alike. Between the two calls the
/// caller tells the window library its input, begins its frame, and lets the studio fill it.

#include "ui/studio.hpp"

namespace axil::ui {

/// Before the window library's frame begins: the fonts as they are wanted now.
void prepareDrawing(Studio& studio);

/// After the window library's frame has ended: everything, into `width` x `height` px.
void draw(const Studio& studio, int width, int height);

}  // namespace axil::ui
