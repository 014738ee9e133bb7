#include "document/plots.hpp"

#include "base/text.hpp"
#include "document/json_lines.hpp"
#include "render/picture.hpp"
#include "render/plot.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace axil::document {

namespace {

using quantify::ForetoldCount;
using quantify::Quantity;
using quantify::QuantityName;
using render::Plot;
using render::PlotPoint;
using render::PlotSeries;
using Json = nlohmann::ordered_json;

constexpr Quantity kShown[] = {Quantity::Length, Quantity::Radius, Quantity::Bend, Quantity::Insertion, Quantity::Branching, Quantity::LeafLength, Quantity::LeafAngle, Quantity::Ending};
constexpr std::size_t kMostOrders = 8;
constexpr double kNoAngle = 1e-3;   // degrees; less is rounding, and would stretch an axis over nothing

Plot plotOf(const quantify::LayeredStatistics& s, const QuantityName& name) {
  const double factor = name.kind == QuantityName::Kind::Angle ? 180 / std::numbers::pi : 1;
  Plot plot;
  plot.title = name.words;
  plot.xLabel = "rank along the axis";
  plot.yLabel = name.kind == QuantityName::Kind::Angle ? "degrees" : name.kind == QuantityName::Kind::Size ? s.unit : "share";
  plot.fromZero = name.kind != QuantityName::Kind::Angle;
  plot.counted = true;
  // Nothing shown is below 0, and no share above 1, whatever two standard errors say.
  const double most = name.kind == QuantityName::Kind::Share ? 1 : std::numeric_limits<double>::infinity();
  const auto shown = [&](double value) { return name.kind == QuantityName::Kind::Angle ? kNoAngle * std::round(value * factor / kNoAngle) + 0.0 : value * factor; };
  for (const auto& layer : s.of(name.quantity).orders) {
    if (plot.series.size() == kMostOrders) break;
    PlotSeries series;
    series.name = "order " + std::to_string(layer.order);
    series.line = true;
    for (const auto& rank : layer.ranks) {
      const double y = shown(rank.estimate.value);
      const double bar = 2 * shown(rank.estimate.error);
      series.points.push_back({static_cast<double>(rank.rank), y, std::min(y, std::max(0.0, y - bar)), std::min(most, y + bar)});
    }
    plot.series.push_back(std::move(series));
  }
  return plot;
}

Plot lengthPlot(const quantify::Backtest& test, const std::string& unit) {
  Plot plot{"Lengths one stage ahead, with 90 % intervals", "true length, " + unit, "foretold, " + unit, {}, true, false};
  PlotSeries goesOn{"goes on", {}, false, true};
  PlotSeries starts{"first of a branch", {}, false, true};
  double most = 0;
  for (const auto& plant : test.plants)
    for (const auto& l : plant.lengths) {
      (l.first ? starts : goesOn).points.push_back({l.truth, l.foretold, l.low, l.high});
      most = std::max({most, l.truth, l.foretold});
    }
  plot.series = {std::move(goesOn), std::move(starts), {"foretold = true", {{0, 0}, {most, most}}, true, false}};
  return plot;
}

Plot countPlot(const quantify::Backtest& test) {
  Plot plot{"New segments of each plant", "plant", "segments", {}, true, true};
  PlotSeries foretold{"foretold, 90 %", {}, false, true};
  PlotSeries repeated{"last stage again", {}, false, true};
  PlotSeries thesis{"thesis' form", {}, false, true};
  PlotSeries truth{"true", {}, false, true};
  for (const auto& plant : test.plants) {
    const double x = static_cast<double>(plant.plant + 1);
    foretold.points.push_back({x, plant.newSegments.foretold, plant.newSegments.low, plant.newSegments.high});
    repeated.points.push_back({x + 0.15, plant.newSegments.repeated});
    thesis.points.push_back({x + 0.25, plant.newSegments.thesis});
    truth.points.push_back({x - 0.15, plant.newSegments.truth});
  }
  plot.series = {std::move(foretold), std::move(truth), std::move(repeated), std::move(thesis)};
  return plot;
}

Result<std::string> pngOf(std::span<const Plot> plots) {
  const auto image = render::drawPlots(plots);
  if (!image) return image.failure();
  return render::pngBytes(*image);
}

std::string percent(double share) { return fixed(100 * share, 1) + " %"; }

std::string row(const std::string& label, double a, double b, double c) {
  const auto cell = [](double v) {
    const std::string text = percent(v);
    return std::string(text.size() < 14 ? 14 - text.size() : 1, ' ') + text;
  };
  return label + std::string(label.size() < 40 ? 40 - label.size() : 1, ' ') + cell(a) + cell(b) + cell(c) + "\n";
}

Json countJson(const ForetoldCount& c) {
  return {{"foretold", c.foretold}, {"mean", c.mean}, {"low", c.low}, {"high", c.high}, {"true", c.truth}, {"repeated", c.repeated}, {"thesis", c.thesis}};
}

}  // namespace

Result<std::string> statisticsPlot(const quantify::LayeredStatistics& statistics) {
  std::vector<Plot> plots;
  for (const Quantity q : kShown)
    if (statistics.of(q).all.samples > 0) plots.push_back(plotOf(statistics, quantify::quantityNames()[static_cast<std::size_t>(q)]));
  if (plots.empty()) return fail(ErrorCode::NoAnswer, "nothing was measured that could be plotted");
  return pngOf(plots);
}

Result<std::string> backtestPlot(const quantify::Backtest& backtest, const std::string& unit) {
  return pngOf(std::vector<Plot>{lengthPlot(backtest, unit), countPlot(backtest)});
}

std::string backtestText(const quantify::Backtest& test) {
  const auto& s = test.skill;
  std::string text = std::to_string(test.plants.size()) + (test.plants.size() == 1 ? " plant, " : " plants, ") + std::to_string(s.lengths) + " lengths of new segments\n\n";
  text += "mean absolute error                           layered    last again        thesis\n";
  text += row("length of a new segment", s.lengthError, s.lengthErrorRepeated, s.lengthErrorThesis);
  text += row("organs of the plant, all", s.countError, s.countErrorRepeated, s.countErrorThesis);
  text += row("new organs of a plant", s.newError, s.newErrorRepeated, s.newErrorThesis);
  if (test.plants.size() > 1) text += row("new organs of all plants together", s.togetherError, s.togetherErrorRepeated, s.togetherErrorThesis);
  text += "\nBy the outlook itself chance moves the new organs of a plant by " + percent(s.newErrorByChance) + "; no forecast of single plants can do much better.";
  text += "\n90 % intervals hold " + percent(s.lengthCoverage) + " of the lengths and the new segments of " + percent(s.countCoverage) + " of the plants.\n";
  if (s.exact > 0) text += percent(static_cast<double>(s.exact) / static_cast<double>(s.lengths)) + " of the lengths vary in no way and were foretold exactly; they count as held.\n";
  for (const auto& p : test.plants)
    if (p.unforeseen > 0) text += "plant " + std::to_string(p.plant + 1) + ": " + std::to_string(p.unforeseen) + " axes went on that were thought to have ended\n";
  return text;
}

std::string backtestJson(const quantify::Backtest& test) {
  const auto& s = test.skill;
  Json json = {{"axil_backtest", 1},
               {"length_error", {{"layered", s.lengthError}, {"repeated", s.lengthErrorRepeated}, {"thesis", s.lengthErrorThesis}}},
               {"count_error", {{"layered", s.countError}, {"repeated", s.countErrorRepeated}, {"thesis", s.countErrorThesis}}},
               {"new_count_error", {{"layered", s.newError}, {"repeated", s.newErrorRepeated}, {"thesis", s.newErrorThesis}, {"chance", s.newErrorByChance}}},
               {"new_count_error_together", {{"layered", s.togetherError}, {"repeated", s.togetherErrorRepeated}, {"thesis", s.togetherErrorThesis}}},
               {"length_coverage", s.lengthCoverage}, {"count_coverage", s.countCoverage}, {"lengths", s.lengths}, {"exact", s.exact}, {"plants", Json::array()}, {"notes", test.notes}};
  for (const auto& p : test.plants) {
    Json plant = {{"plant", p.plant + 1}, {"segments", p.segments}, {"new_segments", countJson(p.newSegments)}, {"new_leaves", countJson(p.newLeaves)}, {"unforeseen", p.unforeseen}, {"lengths", Json::array()}};
    for (const auto& l : p.lengths)
      plant["lengths"].push_back({{"order", l.order}, {"first", l.first}, {"foretold", l.foretold}, {"low", l.low}, {"high", l.high}, {"true", l.truth}, {"repeated", l.repeated}, {"thesis", l.thesis}});
    json["plants"].push_back(std::move(plant));
  }
  return jsonLines(json);
}

}  // namespace axil::document
