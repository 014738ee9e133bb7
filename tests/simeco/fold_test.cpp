// What an expression is worth beforehand is what running it gives, to the last bit.

#include "base/rng.hpp"
#include "simeco/derive.hpp"
#include "simeco/lsystem_language.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>

namespace axil::simeco {
namespace {

/// One expression twice: with numbers, which is folded, and with the parameters that have their values, which is run.
struct Twice {
  std::string folded;
  std::string run;
};

class Expressions {
 public:
  explicit Expressions(std::uint64_t seed) : rng_(seed) {}

  Twice next(int depth) {
    if (depth == 0 || rng_.uniform() < 0.15) return leaf();
    static constexpr std::array kOperators{"+", "-", "*", "/", "%", "^", "<", "<=", ">", ">=", "==", "!=", "&&", "||"};
    static constexpr std::array kFunctions{"sin", "cos", "floor", "ceil", "fabs", "sign", "sqrt", "trunc", "exp"};
    const double kind = rng_.uniform();
    const Twice a = next(depth - 1), b = next(depth - 1);
    if (kind < 0.1) return each(a, a, [](const std::string& x, const std::string&) { return "(-" + x + ")"; });
    if (kind < 0.15) return each(a, a, [](const std::string& x, const std::string&) { return "(!" + x + ")"; });
    if (kind < 0.3) {
      const std::string function = kFunctions[static_cast<std::size_t>(rng_.uniform() * kFunctions.size())];
      return each(a, a, [&](const std::string& x, const std::string&) { return function + "(" + x + ")"; });
    }
    if (kind < 0.4) {
      const Twice c = next(depth - 1);
      return {"(" + a.folded + "?" + b.folded + ":" + c.folded + ")", "(" + a.run + "?" + b.run + ":" + c.run + ")"};
    }
    const std::string op = kOperators[static_cast<std::size_t>(rng_.uniform() * kOperators.size())];
    return each(a, b, [&](const std::string& x, const std::string& y) { return "(" + x + op + y + ")"; });
  }

 private:
  template <class Join>
  static Twice each(const Twice& a, const Twice& b, const Join& join) {
    return {join(a.folded, b.folded), join(a.run, b.run)};
  }
  Twice leaf() {
    static constexpr std::array<Twice (*)(), 5> kLeaves{[] { return Twice{"0", "p"}; }, [] { return Twice{"1", "q"}; }, [] { return Twice{"-7.9", "r"}; },
                                                       [] { return Twice{"0.1", "s"}; }, [] { return Twice{"30", "t"}; }};
    return kLeaves[static_cast<std::size_t>(rng_.uniform() * kLeaves.size())]();
  }
  Rng rng_;
};

std::string derived(const std::string& expression) {
  const Parsed parsed = parseLSystem("Lsystem: 1\nderivation length: 1\nAxiom: A(0,1,-7.9,0.1,30)\nA(p,q,r,s,t) --> B(" + expression + ")\nendlsystem\n");
  if (!parsed.ok()) return parsed.diagnostics.front().message;
  const auto derivation = derive(parsed.grammar);
  return derivation ? toText(derivation->string) : derivation.error().message;
}

TEST(Fold, WhatIsFoldedIsWhatIsRun) {
  constexpr std::uint64_t seed = 20261;
  Expressions expressions(seed);
  int values = 0, failures = 0;
  for (int i = 0; i < 600; ++i) {
    const Twice twice = expressions.next(4);
    const std::string folded = derived(twice.folded), run = derived(twice.run);
    EXPECT_EQ(folded, run) << "seed " << seed << ", expression " << i << ": " << twice.folded;
    (folded.starts_with("B(") ? values : failures) += 1;
  }
  EXPECT_GT(values, 300);
  EXPECT_GT(failures, 20) << "divisions by zero, which fail alike";
}

}  // namespace
}  // namespace axil::simeco
