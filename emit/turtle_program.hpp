#pragma once
/// \file
/// A SimEco grammar as a program for a turtle: the classic language (cpfg) or L-Py. Private to this room.
///
/// Rules stay rules. An organ that a rule makes is drawn at once and for good, `F(length)`, since in SimEco a body stays where it is when its
/// module is rewritten; where rules go on from the organ, its module stands behind it and draws nothing itself.
///
/// A turtle with heading H = d and left L = -r turns like SimEco when it rolls about H by rotu and pitches about L by -rotr. A branch then
/// rolls a quarter turn more, to the side that the sign of sin(rotr) says, for its r-axis is its parent's direction made perpendicular to
/// its own; where the two are parallel it does not.

#include "base/result.hpp"
#include "simeco/grammar.hpp"

#include <cstdint>
#include <string>

namespace axil::emit {

/// How many steps the first plant of `grammar` needs until nothing changes any more, for any of a few seeds.
[[nodiscard]] Result<std::int64_t> stepsUntilComplete(const simeco::Grammar& grammar);

[[nodiscard]] Result<std::string> cpfgProgram(const simeco::Grammar& grammar, std::int64_t steps);
[[nodiscard]] Result<std::string> lpyProgram(const simeco::Grammar& grammar, std::int64_t steps, std::uint64_t seed);

}  // namespace axil::emit
