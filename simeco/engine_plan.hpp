#pragma once
/// \file
/// Plans: for every symbol the quickest way to rewrite it, worked out once from its rules. Private to the engine's plain way.
///
/// Most rules are far simpler than a rule can be. A symbol without rules is copied; one rule without condition or context is
/// written at once; rules that want one neighbour at each side and none of its parameters are found in a table by the two
/// neighbours' codes; the rest is tried rule by rule.

#include "simeco/engine_surroundings.hpp"
#include "simeco/program.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace axil::simeco {

struct Plan {
  enum class Kind : std::uint8_t {
    Copy,        ///< no rule
    Constant,    ///< always the same successor, all of whose parameters are constant
    Direct,      ///< always the same successor
    Lottery,     ///< one of several successors, by fixed weights
    Neighbours,  ///< by the codes of the nearest neighbours
    Rules        ///< whatever else
  } kind = Kind::Copy;
  std::uint8_t parameters = 0;                  ///< of the symbol
  std::uint32_t length = 1;                     ///< modules of the successor
  std::uint32_t values = 0;                     ///< parameters of the successor
  alignas(16) std::array<SymbolCode, 32> codes{};  ///< its first modules
  const CompiledRule* rule = nullptr;
  const CompiledSuccessor* successor = nullptr;
  const RuleIndex* index = nullptr;
  const std::uint16_t* table = nullptr;         ///< Neighbours: list of rules by (left code, right code)
  std::vector<const CompiledRule*> lottery;
  std::vector<double> weights;
  double sum = 0;
};

/// Rules that may apply beside certain neighbours, in text order. `outright`: the first of them always does.
struct CandidateList {
  std::vector<const CompiledRule*> rules;
  bool outright = false;
};

struct Plans {
  std::array<Plan, 256> bySymbol;
  std::size_t codes = 0;                        ///< so many symbols; also the code of "nobody" in neighbour tables
  std::vector<std::vector<std::uint16_t>> tables;
  std::vector<CandidateList> lists;
  bool leftCodes = false;                       ///< some table asks for the left neighbour
  bool rightCodes = false;
  SurroundingNeeds needs;                       ///< of the symbols with Kind::Rules
  bool parameters = false;                      ///< some symbol has parameters
  bool constant = true;                         ///< only Copy and Constant: many steps can be made at once
  std::size_t longest = 1;                      ///< modules that one module may become
  std::size_t most = 1;                         ///< parameters that one module may become
  std::array<std::uint8_t, 256> roles{};        ///< Role of each code for the neighbour codes

  enum Role : std::uint8_t { Considered, Ignored, Opens, Closes };
};

[[nodiscard]] Plans planFor(const Program& program);

}  // namespace axil::simeco
