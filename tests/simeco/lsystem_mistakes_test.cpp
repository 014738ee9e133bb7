// One mistake in a classic text is one error, on its own line, in words that help.

#include "simeco/lsystem_language.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace axil::simeco {
namespace {

const std::string kRight =
    "Lsystem: t\n"
    "derivation length: 2\n"
    "ignore: +-\n"
    "define: { array a[3]={1,2,3}; }\n"
    "Start: { n=1; }\n"
    "Axiom: A(1)B\n"
    "A(x) : x<5 --> F(x)[+A(x+1)]A(x*2)\n"
    "A(x) : x>=5 --> F(x)\n"
    "B --> C\n"
    "C --> B\n"
    "endlsystem\n";

struct Mistake {
  const char* right;
  const char* wrong;   ///< stands in its place
  std::uint32_t line;  ///< where the error belongs
  const char* words;   ///< of its message or hint
};
constexpr Mistake kMistakes[] = {
    {"Lsystem: t", "Lsytem: t", 1, "Lsystem:"},
    {"Lsystem: t", "Lsystem:", 1, "label"},
    {"derivation length: 2", "derivation lenght: 2", 2, "did you mean derivation length:?"},
    {"derivation length: 2", "derivation length 2", 2, "the colon is missing"},
    {"derivation length: 2", "derivation length: -2", 2, "negative"},
    {"ignore: +-", "ignor: +-", 3, "did you mean ignore:?"},
    {"ignore: +-", "ring", 3, "ring Lsystem"},
    {"array a[3]", "aray a[3]", 4, "array or external"},
    {"array a[3]={1,2,3};", "array a[3]={1,2,3}", 4, "expected ;"},
    {"array a[3]", "array a[]", 4, "expected a value"},
    {"n=1; }", "n=1 }", 5, "expected ;"},
    {"n=1; }", "n+=1; }", 5, "+="},
    {"n=1; }", "if (n==1) n=2; }", 5, "braces"},
    {"n=1; }", "n=1; ", 5, "never closed"},
    {"Start: {", "Strt: {", 5, "did you mean Start:?"},
    {"Axiom: A(1)B", "Axoim: A(1)B", 6, "did you mean Axiom:?"},
    {"Axiom: A(1)B", "Axiom:", 6, "empty"},
    {"Axiom: A(1)B", "Axiom: A(1B", 6, "operator is missing"},
    {"x<5 -->", "x<5 ->", 7, "-->"},
    {"x<5", "x<", 7, "expected a value"},
    {"x<5", "x=<5", 7, "=="},
    {"x<5", "x<5 and x>0", 7, "&&"},
    {"x<5", "{n=2; x<5", 7, "never closed"},
    {"x<5", "{n=2;}", 7, "a condition"},
    {"A(x) :", "A(x,x) :", 7, "twice"},
    {"A(x+1)", "A(foo(x))", 7, "no function foo"},
    {"A(x+1)", "A(sin(x,2))", 7, "1 argument"},
    {"A(x+1)", "A(b[1])", 7, "array"},
    {"A(x*2)", "A((x*2)", 7, "expected )"},
    {"A(x*2)", "A(x**2)", 7, "^"},
    {"x>=5 -->", "x=5 -->", 8, "=="},
    {"B --> C", "B = C", 9, "no -->"},
    {"B --> C", "B -->", 9, "successor is missing"},
    {"B --> C", " --> C", 9, "at least one module"},
    {"B --> C", "B --> C --> D", 9, "second -->"},
    {"B --> C", "/* B --> C", 9, "comment is never closed"},
    {"B --> C", "B : * {printf(\"x);} --> C", 9, "not closed"},
    {"B --> C", "#if 0\nB --> C", 9, "#endif"},
    {"B --> C", "#include \"nofile.h\"\nB --> C", 9, "nofile.h"},
    {"endlsystem", "endlsytem", 11, "endlsystem"},
    {"endlsystem", "decompositon\nB --> CC\nendlsystem", 11, "decomposition"},
    {"endlsystem", "homomorphism\nmaximum dept: 3\nendlsystem", 12, "maximum depth:"},
    {"endlsystem", "ignore: A\nendlsystem", 11, "before Axiom:"},
    {"endlsystem\n", "endlsystem\nfoo\n", 12, "text after endlsystem"},
    {"endlsystem\n", "", 11, "without endlsystem"}};

TEST(LSystemMistakes, EachIsOneErrorOnItsOwnLine) {
  ASSERT_TRUE(parseLSystem(kRight).diagnostics.empty());
  for (const Mistake& mistake : kMistakes) {
    const std::size_t at = kRight.find(mistake.right);
    ASSERT_NE(at, std::string::npos) << mistake.right;
    std::string text = kRight;
    text.replace(at, std::string(mistake.right).size(), mistake.wrong);
    Parsed parsed = parseLSystem(text);
    for (Diagnostic& found : checkLSystem(parsed.grammar)) parsed.diagnostics.push_back(std::move(found));
    int errors = 0;
    for (const Diagnostic& found : parsed.diagnostics) {
      if (found.severity != Severity::Error) continue;
      ++errors;
      const std::string said = found.message + " (" + found.hint + ")";
      EXPECT_EQ(placeOf(text, found.span.begin).line, mistake.line) << mistake.wrong << ": " << said;
      EXPECT_NE(said.find(mistake.words), std::string::npos) << mistake.wrong << ": " << said;
    }
    EXPECT_EQ(errors, 1) << mistake.wrong;
  }
}

}  // namespace
}  // namespace axil::simeco
