#pragma once
/// \file
/// The initial grammar: SimEco text that grows exactly the plant that was measured. One stage and at most two rules a
/// segment, laid out as the thesis does it: stage 0 is the growing point, stage 1 the leaf stalk, stage k + 2 segment k;
/// `S(4) -> S(0) [rotr(..)rotu(..)S(9)] rotr(..)rotu(..)S(5) ;` has the main child last and without brackets, and a child
/// without siblings goes through an auxiliary apex, `S(2) -> S(0) A(10) ;`.
///
/// Numbers are rounded once. While writing, the plant that the rounded numbers grow is walked along, and every turn is taken
/// against that plant, so rounding never adds up: directions stay within 3e-4 degrees and nodes within 2e-5 of the plant's height at
/// six decimals, on any depth. Lengths get more decimals than angles where the plant, or its shortest segment, is small.
/// Source: L-Grammar Generator 2005, section 3.4.1 and appendix.

#include "base/result.hpp"
#include "base/turning.hpp"
#include "quantify/types.hpp"
#include "simeco/grammar.hpp"

#include <glm/vec3.hpp>

#include <optional>
#include <string>

namespace axil::emit {

struct EmitOptions {
  std::string name = "plant";   ///< of the plant and its ecosystem
  int decimals = 6;             ///< of angles; -1: all digits of every number
  TurningRule turning = TurningRule::Exact;  ///< Literal writes the measured angles as they are (see docs/decisions/turning.md)
  double deriveTime = 3;        ///< time of one derivation step; organs take 1 to grow
  std::string stemModel = "DefaultStem.i";
  std::string stemTexture = {};  ///< empty: none is named
  std::string leafTexture = {};
  std::optional<glm::dvec3> leafColour = {};  ///< sRGB, of all leaves; nothing: a middle green
};

/// The grammar that regrows `measurements`. Where no radius was measured, one is made up and said so in the grammar's comment: a
/// pipe model in which the cross section of a segment is as the length of stem it carries, 1.2 % of the plant's size at the base.
/// Fails with BadInput for options out of range and NoAnswer for measurements without a segment.
[[nodiscard]] Result<simeco::Grammar> initialGrammar(const quantify::Measurements& measurements, const EmitOptions& options = {});

}  // namespace axil::emit
