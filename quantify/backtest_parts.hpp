#pragma once
/// \file
/// The parts of a back-test that are worked out apart. Private to this room.

#include "quantify/backtest.hpp"

namespace axil::quantify {

/// New organs of a plant.
struct Organs {
  double segments = 0;
  double leaves = 0;
};

/// Sets how many new segments and leaves the outlook foretells, with their intervals, from plants grown by it.
void countOrgans(BacktestOfPlant& result, const Outlook& outlook, int stages);

}  // namespace axil::quantify
