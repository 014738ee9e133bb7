#pragma once
/// \file
/// Charts: points with bars and lines on two axes, drawn without a display. For statistics and back-tests, not for plants.
/// Letters are ASCII; other characters in titles and labels are drawn as '?'.

#include "base/result.hpp"
#include "render/types.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace axil::render {

struct PlotPoint {
  double x = 0;
  double y = 0;
  std::optional<double> low = std::nullopt;   ///< a bar from low to high
  std::optional<double> high = std::nullopt;
};

struct PlotSeries {
  std::string name;               ///< in the legend; empty: not there
  std::vector<PlotPoint> points;
  bool line = false;              ///< joined, in the order given
  bool dots = true;
};

struct Plot {
  std::string title;
  std::string xLabel;
  std::string yLabel;
  std::vector<PlotSeries> series;
  bool fromZero = false;          ///< the y axis shows 0
  bool counted = false;           ///< x counts things: ticks are whole
};

/// Plots in a grid of `columns`, each `width_px` x `height_px`. Fails with BadInput for none, for values that are not finite and for sizes below 200 or above 4000 px.
[[nodiscard]] Result<Image> drawPlots(std::span<const Plot> plots, int columns = 2, int width_px = 640, int height_px = 420);

}  // namespace axil::render
