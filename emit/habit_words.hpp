#pragma once
/// \file
/// A plant's habit in a line of words, for the heading of a structured grammar. Private to this room.

#include "quantify/types.hpp"

#include <span>
#include <string>

namespace axil::emit {

/// "monopodial, 2 branching orders, acrotonic; branches spiral (137 degrees on); leaves opposite", of one plant or many.
[[nodiscard]] std::string habitWords(std::span<const quantify::Measurements> plants);

}  // namespace axil::emit
