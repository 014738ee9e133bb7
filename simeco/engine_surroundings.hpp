#pragma once
/// \file
/// Surroundings: who stands beside whom in a string, worked out once a step so that a context costs the same however far
/// the neighbour stands or however deep the brackets are. Private to the engine.
///
/// Brackets are always considered; ignored letters are passed over. The left neighbour of a module is the last considered
/// module before it on its axis or on the axes that carry it; the right neighbour the next one on its own axis.

#include "simeco/engine_offsets.hpp"

#include <cstdint>
#include <vector>

namespace axil::simeco {

constexpr std::uint32_t nowhere = 0xFFFFFFFFu;

/// Which tables the contexts of a grammar need.
struct SurroundingNeeds {
  bool left = false;
  bool right = false;
  bool brackets = false;   ///< contexts that name brackets, rings, sub-L-systems, cuts
  bool offsets = false;    ///< parameters of neighbours
};
[[nodiscard]] SurroundingNeeds needsOf(const Program& program);

class Surroundings {
 public:
  /// Works out the tables for the whole string; `ignored` by symbol.
  void read(const Program& program, const std::array<bool, 256>& ignored, const SurroundingNeeds& needs, std::span<const SymbolCode> codes);
  void readLeft(const Program& program, const std::array<bool, 256>& ignored, std::span<const SymbolCode> codes);
  void readRight(const Program& program, const std::array<bool, 256>& ignored, std::span<const SymbolCode> codes);
  void readBrackets(const Program& program, std::span<const SymbolCode> codes);
  void readOffsets(const Program& program, std::span<const SymbolCode> codes);

  [[nodiscard]] std::uint32_t leftOf(std::size_t module) const { return left_[module]; }
  [[nodiscard]] std::uint32_t rightOf(std::size_t module) const { return right_[module]; }
  /// The bracket that belongs to this one, or `nowhere`.
  [[nodiscard]] std::uint32_t partner(std::size_t module) const { return partner_[module]; }
  /// Where the module's parameters start.
  [[nodiscard]] std::uint32_t offset(std::size_t module) const { return offsets_.of(module); }
  [[nodiscard]] std::size_t bytes() const {
    return left_.bytes() + right_.bytes() + partner_.bytes() + offsets_.bytes() + leftStack_.bytes() + rightStack_.bytes() + bracketStack_.bytes();
  }

 private:
  Buffer<std::uint32_t> left_, right_, partner_;
  Offsets offsets_;
  Buffer<std::uint32_t> leftStack_, rightStack_, bracketStack_;  // one each, so that the tables can be read at the same time
};

}  // namespace axil::simeco
