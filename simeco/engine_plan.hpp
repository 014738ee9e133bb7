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
#include <memory>
#include <span>
#include <vector>

namespace axil::simeco {

/// A parameter that is a constant, or a parameter times `factor` plus `value`. Times 1 and plus -0 change no bit of any number.
struct QuickTerm {
  double factor = 1;
  double value = -0.0;
  std::uint32_t slot = 0;
  std::uint32_t constant = 0;
};

/// Modules of a successor up to the next that decomposition rules know, and that one.
struct Piece {
  std::uint32_t first = 0;                         ///< module
  std::uint32_t modules = 0;                       ///< that are written as they are
  std::uint32_t values = 0;                        ///< their parameters
  bool unfolds = false;                            ///< whether another follows, which is looked up:
  SymbolCode code = 0;
  std::uint8_t parameters = 0;
};

/// A successor ready to be written.
struct QuickSuccessor {
  alignas(16) std::array<SymbolCode, 32> codes{};  ///< its first modules
  std::uint32_t length = 0;                        ///< modules
  std::uint32_t values = 0;                        ///< parameters
  std::vector<QuickTerm> terms;                    ///< when `quick`
  const std::uint64_t* keys = nullptr;             ///< for the identities of its modules
  bool quick = true;                               ///< every parameter is a QuickTerm, and nothing is decomposed
  bool unfolds = false;                            ///< every parameter is a QuickTerm; `pieces` say what is decomposed
  std::vector<Piece> pieces;                       ///< where decomposition is quick
  bool decomposes = false;                         ///< one of its modules has decomposition rules
  bool random = false;
  const CompiledRule* rule = nullptr;
  const CompiledSuccessor* successor = nullptr;
};

/// Rules that may apply beside certain neighbours, in text order.
struct CandidateList {
  std::vector<const CompiledRule*> rules;
  const QuickSuccessor* outright = nullptr;        ///< the first of them, when it always applies
};

/// Which of `weights` is drawn when `left` of their sum is to be passed over.
[[nodiscard]] inline std::size_t chosen(std::span<const double> weights, double left) {
  std::size_t i = 0;
  while (i + 1 < weights.size() && left >= weights[i]) left -= weights[i++];
  return i;
}

struct Plan {
  enum class Kind : std::uint8_t {
    Copy,        ///< no rule
    Keep,        ///< no rule, but decomposition rules
    Direct,      ///< always the same successor
    Guarded,     ///< the first whose condition holds of its own parameters
    Lottery,     ///< one of several successors, by fixed weights
    Neighbours,  ///< by the codes of the nearest neighbours
    Rules        ///< whatever else
  };
  const RuleIndex* index = nullptr;
  const QuickSuccessor* direct = nullptr;
  std::vector<const QuickSuccessor*> choices;      ///< Guarded, Lottery
  std::vector<double> weights;                     ///< Lottery
  double sum = 0;
  std::vector<std::uint64_t> thresholds;           ///< Lottery: the 53 bits of a draw from which on the next choice is taken
  const std::uint16_t* table = nullptr;            ///< Neighbours: list of rules by (left code, right code)
};

/// What the inner loop asks of every module, in one place.
struct Hot {
  Plan::Kind kind = Plan::Kind::Copy;
  std::uint8_t role = 0;
  std::uint8_t parameters = 0;
  bool decomposes = false;
};

/// What a module without parameters becomes, where at most its neighbours' codes matter: copied in one piece.
struct alignas(32) ByteEntry {
  std::array<SymbolCode, 16> codes{};
  std::uint32_t length = 0;
  std::uint32_t fires = 0;                          ///< 1 when a rule makes it
  const QuickSuccessor* longer = nullptr;           ///< when it has more modules than fit here
};

/// What a module means for who is nearest to those behind it, as masks, so that no branch depends on it: the nearest becomes
/// (popped & pop) | (nearest & keep) | set, and `depth` is how many levels open (1) or close (-1).
struct NearestTurn {
  SymbolCode keep = 0;
  SymbolCode set = 0;
  SymbolCode pop = 0;
  std::int8_t depth = 0;
};

/// Where a symbol's entries are: one, or one for every pair of neighbours, or one for every ticket of a lottery.
struct ByteSymbol {
  std::uint32_t first = 0;
  std::uint16_t leftStep = 0;
  std::uint16_t rightStep = 0;
  bool drawn = false;
};

/// The decomposition rules of a symbol, where they ask for its own parameters alone; in text order.
struct Unfolding {
  std::vector<const QuickSuccessor*> choices;
};

struct Plans {
  enum Role : std::uint8_t { Considered, Ignored, Opens, Closes };

  std::array<Hot, 256> hot;
  std::array<NearestTurn, 256> leftTurns, rightTurns;  ///< read from the left, from the right
  std::array<Plan, 256> bySymbol;
  std::size_t codes = 0;                        ///< so many symbols; also the code of "nobody" in neighbour tables
  std::vector<std::unique_ptr<QuickSuccessor>> successors;
  std::vector<std::vector<std::uint16_t>> tables;
  std::vector<CandidateList> lists;
  bool leftCodes = false;                       ///< some table asks for the left neighbour
  bool rightCodes = false;
  SurroundingNeeds needs;                       ///< of the symbols with Kind::Rules
  bool decomposes = false;                      ///< there are decomposition rules
  bool decomposesByChance = false;              ///< one of them draws
  bool unfoldsQuickly = false;                  ///< all of them are quick: `unfoldings` say it all
  std::array<Unfolding, 256> unfoldings;
  std::size_t longestUnfolding = 1;             ///< modules and parameters of one successor, decomposition rules counted
  std::size_t mostUnfolding = 1;
  bool parameters = false;                      ///< some symbol has parameters
  bool bytes = false;                           ///< no parameters, nothing to compute: `entries` say it all
  std::array<ByteSymbol, 256> byteSymbols;
  std::vector<ByteEntry> entries;
  std::vector<std::array<std::uint64_t, 16>> entryKeys;  ///< of each entry the keys of its first modules, 0 behind them; of a module that stays who it is, 0
  /// At most 15 symbols, and both neighbours asked for: a module and its right neighbour are one byte (the module in the upper half),
  /// and `pairEntries` has the entry for that byte beside each left neighbour (times 256).
  bool pairs = false;
  std::vector<std::uint16_t> pairEntries;
  std::array<NearestTurn, 256> pairTurns;       ///< `leftTurns` by that byte
  bool leaps = true;                            ///< only Copy and constant Direct: many steps can be made at once
  bool calms = true;                            ///< only Copy, Direct, Guarded and Neighbours, nothing random, brackets stay
  std::size_t longest = 1;                      ///< modules that one module may become
  std::size_t most = 1;                         ///< parameters that one module may become
};

[[nodiscard]] std::unique_ptr<Plans> planFor(const Program& program);

}  // namespace axil::simeco
