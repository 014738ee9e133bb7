#pragma once
/// \file
/// Grammars that are written from a pattern: SimEco text put together piece by piece, then read by simeco like any other, so that what
/// is said here is what a person would write. Private to this room.

#include "base/result.hpp"
#include "simeco/grammar.hpp"

#include <glm/vec3.hpp>

#include <optional>
#include <string>

namespace axil::emit {

struct PlantText {
  std::string name;
  std::string heading;  ///< comment lines before the ecosystem, each with its "// "
  std::string attributes;
  std::string stems, leaves, fruits, flowers;  ///< stages
  std::string axiom, rules, decomposition;
  int steps = 0;        ///< derivation steps; 0: until nothing changes
};

/// At most six significant decimals, without an exponent.
[[nodiscard]] std::string num(double value);
/// "rotr(0.9)rotu(0)".
[[nodiscard]] std::string turn(double rotr_rad, double rotu_rad = 0);
/// One line a stage. `arguments` are its further arguments, "(length)"; `length` may be an expression; `more` are further attributes.
[[nodiscard]] std::string stemStage(int number, const std::string& arguments, const std::string& length, double radius, double growTime, const std::string& more,
                                    const glm::dvec3& colour = {0.36, 0.45, 0.22});
[[nodiscard]] std::string leafStage(int number, const std::string& model, double length, double growTime, const std::optional<glm::dvec3>& colour, const std::string& more = {});
[[nodiscard]] std::string flowerStage(int number, const std::string& model, double length, double growTime, const std::optional<glm::dvec3>& colour, const std::string& more = {});

/// Reads and checks the text. Never fails but by a fault in a pattern of ours; then the message is the checker's.
[[nodiscard]] Result<simeco::Grammar> grammarOf(const PlantText& plant);

}  // namespace axil::emit
