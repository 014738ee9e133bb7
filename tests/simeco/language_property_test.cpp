// Properties over printed seeds, and texts that no author would write: cut, mutated, deeply nested, large.
#include <gtest/gtest.h>

#include <algorithm>

#include "base/files.hpp"
#include "base/rng.hpp"
#include "simeco/language.hpp"
#include "simeco/lsystem_language.hpp"
#include "simeco/language_random.hpp"
#include "support/shared_data.hpp"

namespace axil::simeco {
namespace {

std::string firstMessage(const Parsed& parsed, std::string_view text) {
  return parsed.diagnostics.empty() ? std::string{} : formatWithCaret(parsed.diagnostics.front(), text, "text");
}

/// Every diagnostic stands within the text, and there are no more than the stated number and its last line.
void expectSoundDiagnostics(const Parsed& parsed, std::string_view text) {
  ASSERT_LE(parsed.diagnostics.size(), 101u);
  for (const Diagnostic& d : parsed.diagnostics) {
    ASSERT_LE(d.span.begin, text.size()) << d.message;
    ASSERT_LE(d.span.begin, d.span.end) << d.message;
    ASSERT_LE(d.span.end, text.size()) << d.message;
    ASSERT_FALSE(d.message.empty());
  }
  ASSERT_TRUE(std::is_sorted(parsed.diagnostics.begin(), parsed.diagnostics.end() - (parsed.diagnostics.size() > 100 ? 1 : 0),
                             [](const Diagnostic& a, const Diagnostic& b) { return a.span.begin < b.span.begin; }));
}

/// Whatever was understood of a text prints as a text that says the same.
void expectPrintable(const Grammar& grammar) {
  const std::string once = print(grammar);
  const Parsed again = parseSimeco(once);
  ASSERT_TRUE(again.ok()) << firstMessage(again, once) << "\n" << once;
  ASSERT_EQ(print(again.grammar), once);
  ASSERT_TRUE(again.grammar == grammar) << once;
}

TEST(Property, WhatIsPrintedReadsBackAsTheSameGrammar) {
  for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    expectPrintable(test::randomGrammar(Rng(seed)));
    if (HasFatalFailure()) return;
  }
}

TEST(Property, CheckingAnyGrammarEnds) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const std::string text = print(test::randomGrammar(Rng(seed)));
    Parsed parsed = parseSimeco(text);
    parsed.diagnostics = check(parsed.grammar);
    expectSoundDiagnostics(parsed, text);
    if (HasFatalFailure()) FAIL() << "seed " << seed;
  }
}

TEST(Property, AnotherNumberIsAnotherGrammar) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const Grammar grammar = test::randomGrammar(Rng(seed));
    if (grammar.attributes.empty()) continue;
    Grammar changed = grammar;
    changed.attributes[0].value = changed.add(Number{123456.75, 2});
    EXPECT_FALSE(changed == grammar) << "seed " << seed;
  }
}

// ---- broken texts ----

TEST(Truncation, EveryCutOfTheLantanaIsReportedAtAPlaceInTheText) {
  AXIL_SKIP_WITHOUT_SHARED("data/lantana.simeco");
  const auto whole = readFile(test::sharedPath("data/lantana.simeco"));
  ASSERT_TRUE(whole);
  for (std::size_t length = 0; length + 2 < whole->size(); length += 97) {
    const std::string_view text = std::string_view(*whole).substr(0, length);
    const Parsed parsed = parseSimeco(text);
    ASSERT_FALSE(parsed.ok()) << "cut at byte " << length;
    expectSoundDiagnostics(parsed, text);
    expectPrintable(parsed.grammar);
    (void)check(parsed.grammar);
    if (HasFatalFailure()) FAIL() << "cut at byte " << length;
  }
}

std::string mutated(std::string text, Rng& rng) {
  static constexpr std::string_view signs = "{}[]();,:=<>|-+*/^%!?\"'@#&$ \n\t.0123456789eASLrotu";
  for (std::uint64_t i = 1 + rng.below(8); i > 0 && !text.empty(); --i) {
    const std::size_t at = rng.below(text.size());
    switch (rng.below(4)) {
      case 0:
        text[at] = signs[rng.below(signs.size())];
        break;
      case 1:
        text.erase(at, 1 + rng.below(20));
        break;
      case 2:
        text.insert(at, 1, signs[rng.below(signs.size())]);
        break;
      default:
        text.insert(at, text.substr(rng.below(text.size()), rng.below(60)));
        break;
    }
  }
  return text;
}

TEST(Mutation, ABrokenTextNeverStopsTheProgramAndWhatIsLeftPrints) {
  for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
    Rng rng(seed);
    const std::string text = mutated(print(test::randomGrammar(rng.split(1))), rng);
    const Parsed parsed = parseSimeco(text);
    expectSoundDiagnostics(parsed, text);
    if (parsed.diagnostics.empty()) expectPrintable(parsed.grammar);
    (void)check(parsed.grammar);
    if (HasFatalFailure()) FAIL() << "seed " << seed << "\n" << text;
  }
}

TEST(Mutation, BytesThatAreNotUtf8AreOneErrorAtTheFirstOfThem) {
  const std::string text = "EcoSystem 1.0 \"\xB0\xA8\" {}";
  const Parsed parsed = parseSimeco(text);
  ASSERT_EQ(parsed.diagnostics.size(), 1u);
  EXPECT_EQ(parsed.diagnostics[0].span.begin, 15u);
}

// ---- limits ----

std::string inAxiom(const std::string& argument) { return "EcoSystem 1.1 \"e\" { Plant \"p\" { Grow { w = A(" + argument + "); } } }"; }

std::string repeated(std::string_view piece, std::size_t times) {
  std::string text;
  text.reserve(piece.size() * times);
  for (std::size_t i = 0; i < times; ++i) text += piece;
  return text;
}

TEST(Limit, AMillionOpenSignsAreOneErrorNotADeepStack) {
  for (const std::string_view sign :
       {"(", "-", "!", "2^", "1+(", "f(", "a[", "1?", "1?1:", "[", "A(", "{", "// \n", "/* */", "\"", "Stage 1 {", "i < ", "->", "@ a"}) {
    SCOPED_TRACE(sign);
    for (const std::string& text : {inAxiom(repeated(sign, 1'000'000)), repeated(sign, 1'000'000),
                                    "EcoSystem 1.1 \"e\" { Plant \"p\" { Grow { w = A(0); A(0) : " + repeated(sign, 1'000'000)}) {
      const Parsed parsed = parseSimeco(text);
      const bool closesItself = sign.starts_with('/') || sign == "\"";
      EXPECT_TRUE(closesItself || !parsed.ok());
      expectSoundDiagnostics(parsed, text);
      (void)check(parsed.grammar);
    }
  }
}

TEST(Limit, ExpressionsMayNestTwoHundredDeepAndNoDeeper) {
  const auto nested = [](std::size_t depth) { return inAxiom(repeated("(", depth) + "1" + repeated(")", depth)); };
  EXPECT_TRUE(parseSimeco(nested(190)).ok());
  const Parsed parsed = parseSimeco(nested(210));
  ASSERT_EQ(parsed.diagnostics.size(), 1u);
  EXPECT_NE(parsed.diagnostics[0].message.find("nested deeper than 200"), std::string::npos);
  EXPECT_TRUE(parseSimeco(inAxiom(repeated("1+", 190) + "1")).ok());
  EXPECT_FALSE(parseSimeco(inAxiom(repeated("1+", 300) + "1")).ok());
}

TEST(Limit, BranchesMayNestAThousandDeepAndNoDeeper) {
  const auto nested = [](std::size_t depth) {
    return "EcoSystem 1.0 \"e\" { Plant \"p\" { Grow { w = " + repeated("[", depth) + "A(0)" + repeated("]", depth) + "; } } }";
  };
  EXPECT_TRUE(parseSimeco(nested(1000)).ok());
  EXPECT_FALSE(parseSimeco(nested(1001)).ok());
}

TEST(Limit, OnlyAHundredDiagnosticsAreShownAndTheRestIsCounted) {
  const std::string text = "EcoSystem 1.0 \"e\" {\n" + repeated("a = ;\n", 250) + "}";
  const Parsed parsed = parseSimeco(text);
  ASSERT_EQ(parsed.diagnostics.size(), 101u);
  EXPECT_EQ(parsed.diagnostics.back().message, "150 more errors not shown");
}

TEST(Limit, WarningsGiveWayToErrors) {
  std::string stages;
  for (int i = 0; i < 150; ++i) stages += "Stage " + std::to_string(i) + " {}\n";
  const Parsed parsed = parseSimeco("EcoSystem 1.0 \"e\" { Plant \"p\" { Stem {\n" + stages + "}\nGrow { w = L(1); } } }");
  ASSERT_TRUE(parsed.ok());
  const std::vector<Diagnostic> found = check(parsed.grammar);
  ASSERT_EQ(found.size(), 101u);
  EXPECT_TRUE(hasErrors(found));
}

TEST(Limit, ATextOfMoreThanThirtyTwoMegabytesIsRefusedInBothLanguages) {
  const std::string text(32'000'001, 'F');
  for (const Parsed& parsed : {parseSimeco(text), parseLSystem(text)}) {
    ASSERT_EQ(parsed.diagnostics.size(), 1u);
    EXPECT_NE(parsed.diagnostics[0].message.find("32 MB"), std::string::npos);
  }
}

}  // namespace
}  // namespace axil::simeco
