#pragma once
/// \file
/// Shell: where everything stands in the window. Left the way of work and its panel, in the middle the panes, right the inspector, below
/// the timeline and the line that says what a click would do.

#include "ui/panels.hpp"

#include <vector>

namespace axil::ui {

/// One frame of the whole window; gives the steps that the user took.
[[nodiscard]] std::vector<document::Step> shell(const Panel& panel);
/// Colours and measures of the window library, for this theme and scale.
void applyLook(const Palette& palette, float scale);

}  // namespace axil::ui
