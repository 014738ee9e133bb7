#pragma once
/// \file
/// Axil Studio: the project as a window. Photos, clicks and leaves come in by hand; every change is a command on the document, and what
/// follows from it (skeleton, grammars, pictures) is worked out in the background, so that the window never waits.
///
/// The room decides nothing about plants: it shows what document gives and says what a click would do. GLFW, Dear ImGui and OpenGL are
/// used inside and appear in no header but the private *_interop.hpp.

#include "ui/texts.hpp"          // every word, in three languages
#include "ui/theme.hpp"          // colours, and how stems are told apart
#include "ui/clicking.hpp"       // what a click means, before it is done
#include "ui/epipolar.hpp"       // where a click in one photo may be in another
#include "ui/state.hpp"          // what a person is looking at
#include "ui/worker.hpp"         // long work on its own thread
#include "ui/following.hpp"      // what follows from the project
#include "ui/plant_picture.hpp"  // the plant's picture from any side
#include "ui/panels.hpp"         // the parts of the window
#include "ui/studio.hpp"         // one window's worth of it
#include "ui/window.hpp"         // on a desktop
#include "ui/headless.hpp"       // in memory, driven by lines of text
