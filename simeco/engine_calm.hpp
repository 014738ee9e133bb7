#pragma once
/// \file
/// Calm: steps that cost what moves, not what there is. When only a few modules of a long string are rewritten, each by one
/// module (a signal that runs up a plant), the string is changed in place, and only those modules are looked at again whose own
/// parameters or whose neighbours changed in the step before. All others would be copied again: their rules see what they saw.
/// Private to the engine's plain way.

#include "simeco/engine_machine.hpp"
#include "simeco/engine_offsets.hpp"
#include "simeco/engine_plan.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace axil::simeco {

class Calm {
 public:
  /// Strings of fewer than `fewest` modules are scanned as a whole: that costs less than the bookkeeping.
  Calm(const Program& program, const Plans& plans, std::size_t fewest) : program_(program), plans_(plans), fewest_(fewest) {}

  /// Whether the next step should be tried this way: the step before fired little, and trying has not failed lately.
  [[nodiscard]] bool worthTrying(std::size_t modules) const;
  /// One step in place; how many modules changed. Nothing when a rule that fires does not fit in place, or when too much
  /// moves: then the string is as it was.
  [[nodiscard]] std::optional<std::size_t> step(ModuleString& string, Machine& machine, bool singlePrecision);
  /// The string was rewritten another way, by `fired` rules.
  void disturbed(std::size_t fired);

  /// Whether the tables describe the string: the next step needs nothing else.
  [[nodiscard]] bool known() const { return known_; }
  [[nodiscard]] std::size_t bytes() const { return left_.bytes() + right_.bytes() + offsets_.bytes() + stack_.bytes(); }
  [[nodiscard]] const CompiledRule* lastRule() const { return lastRule_; }

 private:
  struct Change {
    std::uint32_t module;
    const QuickSuccessor* successor;
    const CompiledRule* rule;
  };

  void readTables(const ModuleString& string);
  [[nodiscard]] bool collect(const ModuleString& string, Machine& machine);
  [[nodiscard]] bool decide(const ModuleString& string, std::uint32_t at, std::uint32_t offset, Machine& machine);
  [[nodiscard]] std::uint32_t offsetOf(std::uint32_t at) const { return withOffsets_ ? offsets_.of(at) : 0; }
  [[nodiscard]] bool fits(SymbolCode code, const CompiledSuccessor& successor) const;
  void apply(ModuleString& string, Machine& machine, bool singlePrecision);
  void lookAgain(const ModuleString& string);
  void addLeftDependents(std::span<const SymbolCode> codes, std::uint32_t at);
  void addRightDependents(std::span<const SymbolCode> codes, std::uint32_t at);
  [[nodiscard]] std::uint8_t role(SymbolCode code) const { return plans_.hot[code].role; }

  const Program& program_;
  const Plans& plans_;
  std::size_t fewest_;
  // Neighbours of every module that is no bracket; for brackets left_ holds the partner.
  Buffer<std::uint32_t> left_, right_;
  Offsets offsets_;
  Buffer<std::uint32_t> stack_;
  bool withOffsets_ = false;         ///< there are parameters
  bool known_ = false;               ///< tables and candidates describe the string
  std::vector<std::uint32_t> candidates_;
  std::vector<Change> changes_;
  std::vector<std::uint32_t> changed_;
  std::vector<std::uint32_t> branches_;  ///< closing brackets of the branches that a walk is in
  std::vector<double> computed_;
  std::size_t lastFired_ = ~std::size_t{0};
  int patience_ = 0;                 ///< steps to wait before the next try
  int failures_ = 0;
  const CompiledRule* lastRule_ = nullptr;
};

}  // namespace axil::simeco
