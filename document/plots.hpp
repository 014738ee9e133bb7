#pragma once
/// \file
/// Layered statistics and back-tests as charts, PNG bytes.

#include "base/result.hpp"
#include "quantify/backtest.hpp"
#include "quantify/layers.hpp"

#include <string>

namespace axil::document {

/// Each quantity along the rank, a line an order with bars of two standard errors: lengths, radii, insertion, bend, branching, leaves. Only what was measured; fails
/// with NoAnswer where nothing was.
[[nodiscard]] Result<std::string> statisticsPlot(const quantify::LayeredStatistics& statistics);

/// Foretold lengths with their 90 % intervals against the true ones, and organ counts of each plant, foretold, true, and by the two other forecasts.
[[nodiscard]] Result<std::string> backtestPlot(const quantify::Backtest& backtest, const std::string& unit);

/// The back-test for people, and as JSON.
[[nodiscard]] std::string backtestText(const quantify::Backtest& backtest);
[[nodiscard]] std::string backtestJson(const quantify::Backtest& backtest);

}  // namespace axil::document
