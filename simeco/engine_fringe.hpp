#pragma once
/// \file
/// Where a part of the string begins and ends: who stands beside its first and last module, outside. Private to the plain way.

#include "simeco/engine_plan.hpp"

#include <span>

namespace axil::simeco {

/// Who stands to the left of a part's first module, found by walking from there, further with every bracket that closes.
class LeftFringe {
 public:
  LeftFringe(const Plans& plans, std::span<const SymbolCode> codes, std::size_t begin) : plans_(plans), codes_(codes), at_(begin) {}

  /// The nearest considered module of this level or of those that carry it.
  SymbolCode nearest() {
    for (std::size_t i = at_; i-- > 0;) {
      const std::uint8_t role = plans_.hot[codes_[i]].role;
      if (role == Plans::Considered) return codes_[i];
      // Over a whole branch at once, without a branch of ours for each of its brackets.
      if (role == Plans::Closes)
        for (int depth = -1; depth < 0 && i > 0;) depth += plans_.leftTurns[codes_[--i]].depth;
    }
    return nobody();
  }
  /// Leaves the branch: to before the bracket that opened it.
  void leave() {
    int depth = 0;
    while (at_ > 0 && depth <= 0) depth += plans_.leftTurns[codes_[--at_]].depth;
  }
  [[nodiscard]] SymbolCode nobody() const { return static_cast<SymbolCode>(plans_.codes); }

 private:
  const Plans& plans_;
  std::span<const SymbolCode> codes_;
  std::size_t at_;
};

/// Who stands to the right of a part's last module.
class RightFringe {
 public:
  RightFringe(const Plans& plans, std::span<const SymbolCode> codes, std::size_t end) : plans_(plans), codes_(codes), at_(end) {}

  SymbolCode nearest() const {
    for (std::size_t i = at_; i < codes_.size(); ++i) {
      const std::uint8_t role = plans_.hot[codes_[i]].role;
      if (role == Plans::Considered) return codes_[i];
      if (role == Plans::Closes) break;
      if (role == Plans::Opens)
        for (int depth = -1; depth < 0 && i + 1 < codes_.size();) depth += plans_.rightTurns[codes_[++i]].depth;
    }
    return nobody();
  }
  void leave() {
    int depth = 0;
    while (at_ < codes_.size() && depth <= 0) depth += plans_.rightTurns[codes_[at_++]].depth;
  }
  [[nodiscard]] SymbolCode nobody() const { return static_cast<SymbolCode>(plans_.codes); }

 private:
  const Plans& plans_;
  std::span<const SymbolCode> codes_;
  std::size_t at_;
};

/// Who was nearest where each open level began. The lowest place stays free, so that nothing is asked before a level is left; one that
/// was not opened within the part is left with the fringe.
class Levels {
 public:
  /// Goes on with the levels that are open in `places`; none are where it is empty.
  explicit Levels(Buffer<SymbolCode>& places) : places_(places) {
    if (places_.size() == 0) places_.setSize(1);
  }

  /// Room for so many modules; the free place above the levels.
  [[nodiscard]] SymbolCode* roomFor(std::size_t modules) {
    places_.reserveMore(places_.size() + modules + 1);
    return places_.data() + places_.size();
  }
  void keep(const SymbolCode* top) { places_.setSize(static_cast<std::size_t>(top - places_.data())); }

  /// The place below all levels; it does not move until room is made again.
  [[nodiscard]] const SymbolCode* floor() const { return places_.data(); }

 private:
  Buffer<SymbolCode>& places_;
};

/// Who is nearest behind a module that means `turn`; `top` is the free place above the levels.
template <class Fringe>
[[nodiscard]] inline SymbolCode nearestBehind(const NearestTurn& turn, SymbolCode nearest, SymbolCode*& top, const SymbolCode* floor, Fringe& fringe) {
  const SymbolCode popped = top[-1];
  *top = nearest;
  const unsigned instead = (popped & turn.pop) | turn.set;  // apart, so that only two operations wait for the module before
  nearest = static_cast<SymbolCode>((nearest & turn.keep) | instead);
  top += turn.depth;
  if (top == floor) [[unlikely]] {
    ++top;
    fringe.leave();
    return fringe.nearest();
  }
  return nearest;
}

}  // namespace axil::simeco
