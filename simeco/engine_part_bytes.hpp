#pragma once
/// \file
/// PartPass where no module has parameters: every module is replaced by an entry of a table.
/// Behind engine_part_pass.hpp, private to engine_plain.cpp.

#include "simeco/engine_part_pass.hpp"

#include <cstddef>

namespace axil::simeco {

inline void PartPass::drawAhead(Draws& draws, std::size_t begin, std::size_t end) const {
  const SymbolCode* const codes = old_.codes.data();
  const ByteSymbol* const symbols = plans_.byteSymbols.data();
  std::size_t count = 0;
  for (std::size_t at = begin; at < end; ++at) {
    draws.places[count] = static_cast<std::uint16_t>(at - begin);
    count += symbols[codes[at]].drawn ? 1 : 0;
  }
  const Rng choices = choices_;
  const std::uint64_t step = step_;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = begin + draws.places[i];
    const std::uint64_t who = whoIs(old_.identities[at]);
    draws.families[i] = familyOf(who);
    draws.tickets[i] = ticket(plans_.bySymbol[codes[at]], choices.split(step, who).bits() >> 11);
  }
}

template <bool identified, bool withLeft, bool withRight>
SymbolCode PartPass::rewriteBytes(std::size_t begin, std::size_t end, SymbolCode last, LeftFringe& fringe) {
  if constexpr (!identified) {
    return rewriteEntries<false, withLeft, withRight>(begin, end, last, fringe, nullptr);
  } else {
    Draws draws;
    for (std::size_t at = begin; at < end; at += Draws::most) {
      const std::size_t to = std::min(end, at + Draws::most);
      drawAhead(draws, at, to);
      last = rewriteEntries<true, withLeft, withRight>(at, to, last, fringe, &draws);
    }
    return last;
  }
}

template <bool identified, bool withLeft, bool withRight>
SymbolCode PartPass::rewriteEntries(std::size_t begin, std::size_t end, SymbolCode last, LeftFringe& fringe, const Draws* draws) {
  const SymbolCode* const codes = old_.codes.data();
  const SymbolCode* const rights = s_.rightCodes.data();
  const ByteSymbol* const symbols = plans_.byteSymbols.data();
  const ByteEntry* const entries = plans_.entries.data();
  const std::array<std::uint64_t, 16>* const keys = plans_.entryKeys.data();
  const Identity* const who = old_.identities.data();
  Identity* born = identified ? lane_.out->identities.data() + lane_.out->codes.size() : nullptr;
  SymbolCode* to = lane_.out->codes.data() + lane_.out->codes.size();
  const NearestTurn* const turns = plans_.leftTurns.data();
  Levels levels(lane_.stack);
  SymbolCode* top = withLeft ? levels.roomFor(end - begin) : nullptr;
  const SymbolCode* const floor = levels.floor();
  std::size_t fired = 0, drawn = 0;
  const ByteEntry* fires = nullptr;
  for (std::size_t at = begin; at < end; ++at) {
    const SymbolCode code = codes[at];
    const ByteSymbol symbol = symbols[code];
    std::size_t entry = symbol.first;
    if constexpr (withLeft) entry += std::size_t{last} * symbol.leftStep;
    if constexpr (!withLeft && withRight) entry += plans_.codes * symbol.leftStep;
    if constexpr (withRight) entry += std::size_t{rights[at]} * symbol.rightStep;
    if constexpr (withLeft && !withRight) entry += plans_.codes * symbol.rightStep;
    if constexpr (identified) entry += symbol.drawn ? draws->tickets[drawn] : 0u;
    const ByteEntry& made = entries[entry];
    if constexpr (identified) {
      const std::uint64_t self = whoIs(who[at]);
      std::uint64_t family = symbol.drawn ? draws->families[drawn] : self;
      if (made.fires != 0 && !symbol.drawn) family = familyOf(self);
      drawn += symbol.drawn ? 1 : 0;
      writeFew(born, family, keys[entry], made);
      born += made.length;
    }
    std::memcpy(to, made.codes.data(), made.codes.size());
    if (made.longer != nullptr) [[unlikely]] {
      std::memcpy(to, made.longer->successor->codes.data(), made.length);
      fires = &made;
    }
    to += made.length;
    fired += made.fires;
    if constexpr (withLeft) last = nearestBehind(turns[code], last, top, floor, fringe);
  }
  if constexpr (withLeft) levels.keep(top);
  if (fires != nullptr) rule_ = fires->longer->rule;
  lane_.fired += fired;
  lane_.out->codes.setSize(static_cast<std::size_t>(to - lane_.out->codes.data()));
  if constexpr (identified) lane_.out->identities.setSize(lane_.out->codes.size());
  return last;
}

inline SymbolCode PartPass::rewritePairs(std::size_t begin, std::size_t end, SymbolCode last, LeftFringe& fringe) {
  const SymbolCode* const pairs = s_.rightCodes.data();
  const NearestTurn* const turns = plans_.pairTurns.data();
  const std::uint16_t* const numbers = plans_.pairEntries.data();
  const ByteEntry* const entries = plans_.entries.data();
  Levels levels(lane_.stack);
  SymbolCode* top = levels.roomFor(end - begin);
  const SymbolCode* const floor = levels.floor();
  SymbolCode* to = lane_.out->codes.data() + lane_.out->codes.size();
  std::uint64_t counts = 0;  // modules written in the lower half, rules that fired in the upper one
  for (std::size_t at = begin; at < end; ++at) {
    const SymbolCode pair = pairs[at];
    const ByteEntry& made = entries[numbers[std::size_t{last} << 8 | pair]];
    std::memcpy(to, made.codes.data(), made.codes.size());
    std::uint64_t count;
    static_assert(offsetof(ByteEntry, fires) == offsetof(ByteEntry, length) + 4 && std::endian::native == std::endian::little);
    std::memcpy(&count, &made.length, sizeof count);
    counts += count;
    to += made.length;
    last = nearestBehind(turns[pair], last, top, floor, fringe);
  }
  levels.keep(top);
  lane_.fired += counts >> 32;
  lane_.out->codes.setSize(static_cast<std::size_t>(to - lane_.out->codes.data()));
  return last;
}

inline void PartPass::writeFew(Identity* born, std::uint64_t family, const std::array<std::uint64_t, 16>& keys, const ByteEntry& made) {
  if (made.longer != nullptr) [[unlikely]] {
    for (std::uint32_t i = 0; i < made.length; ++i) writeIdentity(born + i, childOf(family, made.longer->keys[i]));
    return;
  }
  writeIdentity(born, childOf(family, keys[0]));
  for (std::uint32_t i = 1; i < made.length; i += 5)
    for (std::uint32_t k = i; k < i + 5; ++k) writeIdentity(born + k, childOf(family, keys[k]));
}

inline std::uint32_t PartPass::ticket(const Plan& plan, std::uint64_t draw) {
  std::uint32_t choice = 0;
  for (const std::uint64_t threshold : plan.thresholds) choice += draw >= threshold ? 1 : 0;
  return choice;
}

}  // namespace axil::simeco
