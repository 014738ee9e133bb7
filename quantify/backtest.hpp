#pragma once
/// \file
/// Back-test: how well the outlook foretells a stage that is known. Either the youngest stages of each plant are cut off (by schedule.hpp) and foretold
/// from what is left, or an earlier measurement foretells a later one of the same plant. Beside it stand two other forecasts: the last stage
/// repeated (each axis' last segment again, as many organs as last time), and the thesis' form (every tip goes on by the template of its
/// parent, each number the middle of its range). Lengths are compared on the first new segment of each axis; organs are counted over all stages.
///
/// The interval of a count comes from 400 plants grown from the outlook, in which the shares themselves are drawn as unsure as their samples
/// leave them. The draws are seeded: the same plants give the same numbers.

#include "quantify/outlook.hpp"

#include <span>
#include <string>
#include <vector>

namespace axil::quantify {

/// A first new segment of an axis.
struct ForetoldLength {
  int order = 0;
  bool first = false;     ///< of a new axis
  double foretold = 0;
  double low = 0;
  double high = 0;
  double truth = 0;
  double repeated = 0;    ///< the segment below again
  double thesis = 0;      ///< 0: the thesis' form foretells none there
};

struct ForetoldCount {
  double foretold = 0;    ///< the number of least mean percentage error, of all organs, against the grown plants
  double mean = 0;        ///< of the grown plants
  double low = 0;         ///< whole numbers that hold 90 % of the grown plants, as nearly as whole numbers can
  double high = 0;
  double truth = 0;
  double repeated = 0;
  double thesis = 0;
  double chance = 0;      ///< mean miss of the grown plants themselves: what no forecast of such plants can do better than
};

struct BacktestOfPlant {
  std::size_t plant = 0;
  std::size_t segments = 0;          ///< of the earlier plant
  ForetoldCount newSegments;
  ForetoldCount newLeaves;
  std::vector<ForetoldLength> lengths;
  std::size_t unforeseen = 0;        ///< new first segments on axes that were thought to have ended
};

/// Mean absolute percentage errors (1 = 100 %) and the share of truths within their 90 % intervals.
struct BacktestSkill {
  double lengthError = 0, lengthErrorRepeated = 0, lengthErrorThesis = 0;
  double countError = 0, countErrorRepeated = 0, countErrorThesis = 0;   ///< of all organs of a plant, earlier and new: mean over plants of |foretold - true| / true
  double newError = 0, newErrorRepeated = 0, newErrorThesis = 0;         ///< of the new organs alone
  double newErrorByChance = 0;       ///< of the new organs, of the grown plants themselves: no forecast of single plants can do much better
  double togetherError = 0, togetherErrorRepeated = 0, togetherErrorThesis = 0;  ///< of the new organs of all plants together
  double lengthCoverage = 0;
  double countCoverage = 0;
  std::size_t lengths = 0;
  std::size_t exact = 0;             ///< of the lengths, foretold within 1e-6 with an interval of no width
};

struct Backtest {
  std::vector<BacktestOfPlant> plants;
  BacktestSkill skill;
  std::vector<std::string> notes;    ///< plants that could not be tested, a sentence each
};

/// Cuts the youngest `stages` (from 1) off every plant, and foretells each from the cut ones. A plant that would lose its root segment, or that shows nothing
/// once cut, is noted and left out. Fails with BadInput for stages below 1 and with NoAnswer where no plant is left.
[[nodiscard]] Result<Backtest> backtest(std::span<const Measurements> plants, int stages = 1);

/// Foretells each of `later` from the plant of the same place in `earlier`, `stages` before; statistics are taken from all of `earlier`.
[[nodiscard]] Result<Backtest> backtest(std::span<const Measurements> earlier, std::span<const Measurements> later, int stages);

/// `plant` without what was made in its last `stages`; fails with NoAnswer where nothing would be left.
[[nodiscard]] Result<Measurements> withoutYoungest(const Measurements& plant, const PlantSchedule& schedule, int stages);

}  // namespace axil::quantify
