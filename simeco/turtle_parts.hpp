#pragma once
/// \file
/// Cutting a string for several turtles. What a branch does ends with its ], so where a turtle stands in the middle of a string is decided by
/// the modules before it whose branches are still open there: its *path*, most often a few of millions. Internal to the turtle.

#include "simeco/module_string.hpp"

#include <cstddef>
#include <vector>

namespace axil::simeco::turtle {

/// Modules [begin, end) of a string; the parameters of the first are those from number `parameter` on.
struct Stretch {
  std::size_t begin = 0;
  std::size_t end = 0;
  std::size_t parameter = 0;
};

struct StringPart {
  Stretch own;
  std::vector<Stretch> path;  ///< from the start of the string to `own.begin`, without the branches that are closed by then
};

/// `string` in `count` parts of about the same length, each but the first starting with a [ outside of all braces; in fewer where it has no such places, in one
/// where its brackets or braces close what was not opened.
[[nodiscard]] std::vector<StringPart> partsOf(const ModuleString& string, std::size_t count);

}  // namespace axil::simeco::turtle
