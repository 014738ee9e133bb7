#include "simeco/engine_match.hpp"

namespace axil::simeco {

namespace {

/// A place that walks over the string; in a ring it goes round once, elsewhere it ends.
struct Walk {
  std::size_t size;
  std::size_t at;
  bool ring;
  std::size_t left;  ///< modules that may still be visited: one lap for each module of the context
  bool over = false;

  void forth(std::size_t to) { move(to >= at ? to - at : 0, to); }
  void back(std::size_t distance) {
    if (distance > at && !ring) over = true;
    spend(distance);
    if (!over) at = distance <= at ? at - distance : at + size - distance;
  }

 private:
  void move(std::size_t distance, std::size_t to) {
    spend(distance);
    if (to >= size && !ring) over = true;
    if (!over) at = to >= size ? to - size : to;
  }
  void spend(std::size_t distance) {
    if (distance > left) over = true;
    left -= std::min(left, distance);
  }
};

}  // namespace

bool Matcher::walkLeft(const CompiledRule& rule, std::size_t first, double* locals) const {
  Walk walk{old_.codes.size(), first, system_.ring, old_.codes.size() * rule.left.size() + 1};
  walk.back(1);
  for (const Pattern& pattern : rule.left) {
    for (;; walk.back(1)) {
      if (walk.over) return false;
      const SymbolCode code = old_.codes[walk.at];
      if (program_.closes[code]) {
        const std::uint32_t open = around_.partner(walk.at);
        if (open == nowhere) return false;
        walk.back(walk.at - open);
      } else if (!program_.opens[code] && !system_.ignored[code]) {
        break;
      }
    }
    if (!meets(pattern, walk.at, locals)) return false;
    walk.back(1);
  }
  return true;
}

bool Matcher::walkRight(const CompiledRule& rule, std::size_t last, double* locals) const {
  Walk walk{old_.codes.size(), last, system_.ring, old_.codes.size() * rule.right.size() + 1};
  walk.forth(last + 1);
  const auto skipBranch = [&] {
    const std::uint32_t close = around_.partner(walk.at);
    if (close == nowhere) walk.over = true;
    if (!walk.over) walk.forth(close + 1);
  };
  for (const Pattern& pattern : rule.right) {
    if (pattern.kind == Pattern::Kind::SkipRest) {
      while (!walk.over && !program_.closes[old_.codes[walk.at]]) program_.opens[old_.codes[walk.at]] ? skipBranch() : walk.forth(walk.at + 1);
      continue;
    }
    const bool wantsBranch = program_.opens[pattern.code];
    for (;;) {
      if (walk.over) return false;
      const SymbolCode code = old_.codes[walk.at];
      if (system_.ignored[code])
        walk.forth(walk.at + 1);
      else if (program_.opens[code] && !wantsBranch)
        skipBranch();
      else
        break;
    }
    if (!meets(pattern, walk.at, locals)) return false;
    walk.forth(walk.at + 1);
  }
  return true;
}

}  // namespace axil::simeco
