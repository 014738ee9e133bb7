#pragma once
/// \file
/// PartPass: its part in blocks, and who stands to the right of each module. Private to engine_plain.cpp.

#include "simeco/engine_part_pass.hpp"

namespace axil::simeco {

/// Who is to the right of each module; `pairs`: beside the module itself, in one byte.
template <bool pairs>
void PartPass::readRightCodes(std::size_t begin, std::size_t end) {
  RightFringe fringe(plans_, old_.codes, end);
  SymbolCode* const right = s_.rightCodes.data();
  const SymbolCode* const codes = old_.codes.data();
  const NearestTurn* const turns = plans_.rightTurns.data();
  lane_.stack.clear();
  Levels levels(lane_.stack);
  SymbolCode next = fringe.nearest();
  constexpr std::size_t atOnce = 4096;
  for (std::size_t to = end; to > begin;) {
    const std::size_t from = to - std::min(to - begin, atOnce);
    SymbolCode* top = levels.roomFor(to - from);
    const SymbolCode* const floor = levels.floor();
    for (std::size_t i = to; i-- > from;) {
      const SymbolCode code = codes[i];
      right[i] = pairs ? static_cast<SymbolCode>(code << 4 | next) : next;
      next = nearestBehind(turns[code], next, top, floor, fringe);
    }
    levels.keep(top);
    to = from;
  }
}

/// Block by block: room for the longest that a block can become is made before it, so that nothing inside has to ask.
template <class Rewrite>
void PartPass::eachBlock(std::size_t begin, std::size_t end, Rewrite rewriteBlock) {
  constexpr std::size_t blockModules = 1 << 14;
  // Short strings in short blocks: the room for the longest a block can become shall stay small beside the string.
  const std::size_t most = std::clamp<std::size_t>((end - begin) / 16, 16, 2048);
  const std::size_t block = std::clamp<std::size_t>(blockModules / std::max(plans_.longest, plans_.most), 1, most);
  room_ = block;
  const std::size_t bytesLeft = s_.bytesLeft();
  LeftFringe fringe(plans_, old_.codes, begin);
  lane_.stack.clear();
  SymbolCode last = plans_.leftCodes ? fringe.nearest() : SymbolCode{0};
  std::size_t looks = 0;
  std::size_t before = 0;
  for (std::size_t at = begin; at < end && !lane_.ended(); at += block) {
    const std::size_t to = std::min(end, at + block);
    Arrays& out = *lane_.out;
    const std::size_t modules = to - at;
    out.codes.reserveMore(out.codes.size() + modules * plans_.longest);
    out.parameters.reserveMore(out.parameters.size() + (plans_.parameters ? modules * plans_.most : 0));
    if (identified_) out.identities.reserve(out.codes.capacity());
    endsOfRoom();
    last = rewriteBlock(at, to, last, fringe);
    if (lane_.ended()) return;
    if (out.codes.size() > s_.options.limits.modules) lane_.limit = Lane::Limit::Modules;
    const std::size_t now = out.used();
    if (s_.written.fetch_add(now - before, std::memory_order_relaxed) + (now - before) > bytesLeft) lane_.limit = Lane::Limit::Bytes;
    before = now;
    constexpr std::size_t betweenLooks = 64;
    if (++looks % betweenLooks == 0) look();
  }
}

/// Whether to go on at all.
inline void PartPass::look() {
  if (s_.options.watch.cancelled() || s_.shared.late()) lane_.limit = Lane::Limit::Time;
}

inline SymbolCode PartPass::leftAfter(std::uint8_t role, SymbolCode code, SymbolCode last, LeftFringe& fringe) {
  switch (role) {
    case Plans::Considered: return code;
    case Plans::Ignored: return last;
    case Plans::Opens: lane_.stack.push(last); return last;
    default: break;
  }
  if (lane_.stack.size() == 0) {
    fringe.leave();
    return fringe.nearest();
  }
  const SymbolCode before = lane_.stack[lane_.stack.size() - 1];
  lane_.stack.setSize(lane_.stack.size() - 1);
  return before;
}

}  // namespace axil::simeco
