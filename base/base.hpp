#pragma once
/// \file
/// The words every room speaks. Plain values, no plants. Read in this order.

#include "base/result.hpp"      // a value, or the Error that says why there is none
#include "base/angle.hpp"       // an angle that knows its unit
#include "base/frames.hpp"      // pixels, camera and plant coordinates, each its own type
#include "base/turning.hpp"     // how a child stem leaves its parent: rotr, rotu, r-axis
#include "base/ids.hpp"         // typed numbers that name things
#include "base/source.hpp"      // places in a text, and what is wrong there
#include "base/text.hpp"        // numbers and encodings, without a locale
#include "base/table.hpp"       // tables of data that people edit
#include "base/files.hpp"       // whole files; write aside, then rename
#include "base/rng.hpp"         // chance as an argument
#include "base/progress.hpp"    // how far, and stop
#include "base/overloaded.hpp"  // visiting a variant
#include "base/units.hpp"       // units of length
#include "base/large_array.hpp"  // memory for large arrays
