#pragma once
/// \file
/// A grown plant as a multiscale tree graph: the table that plant-architecture tools read (MTG, FORM-A). Private to this room.

#include "base/result.hpp"
#include "simeco/plant.hpp"

#include <string>
#include <vector>

namespace axil::emit {

/// One row an organ: stems S, leaves L, other organs O, on one plant P. `notes` head the file. Fails with NoAnswer for a plant without a stem.
[[nodiscard]] Result<std::string> mtgText(const simeco::Plant& plant, const std::vector<std::string>& notes);

}  // namespace axil::emit
