#pragma once
/// \file
/// The parts of a back-test that are worked out apart. Private to this room.

#include "quantify/backtest.hpp"

namespace axil::quantify {

/// Organs of a plant, or those new on it.
struct Organs {
  double segments = 0;
  double leaves = 0;
};

/// Sets how many new segments and leaves the outlook foretells, with their intervals, from plants grown by it; `earlier` are those it has.
void countOrgans(BacktestOfPlant& result, const Organs& earlier, const Outlook& outlook, int stages);

}  // namespace axil::quantify
