#include "base/source.hpp"
#include "base/text.hpp"

#include <gtest/gtest.h>

namespace axil {
namespace {

TEST(Source, ColumnsCountCharactersNotBytes) {
  const std::string text = "a\n馬櫻x\n";
  EXPECT_EQ(placeOf(text, 8), (SourcePlace{2, 3}));
  EXPECT_EQ(placeOf(text, 0), (SourcePlace{1, 1}));
  EXPECT_EQ(placeOf(text, 999), (SourcePlace{3, 1}));
}

TEST(Source, ADiagnosticPrintsItsPlaceItsHintAndACaret) {
  const std::string text = "one\n  two three\n";
  const Diagnostic d{Severity::Error, {6, 9}, "unknown word 'two'", "did you mean 'too'?"};
  EXPECT_EQ(formatDiagnostic(d, text, "g.simeco"), "g.simeco:2:3: error: unknown word 'two' (did you mean 'too'?)");
  EXPECT_EQ(formatWithCaret(d, text, "g.simeco"), "g.simeco:2:3: error: unknown word 'two' (did you mean 'too'?)\n    two three\n    ^^^");
}

TEST(Source, TheCaretStandsUnderWideCharacters) {
  const Diagnostic d{Severity::Warning, {6, 7}, "m", ""};
  EXPECT_EQ(formatWithCaret(d, "馬櫻x", "f"), "f:1:3: warning: m\n  馬櫻x\n      ^");
}

TEST(Source, OfALongLineOnlyWhatIsNearTheSpanIsShown) {
  std::string text;
  for (int i = 0; i < 1000; ++i) text += "櫻";
  const Diagnostic d{Severity::Error, {1500, 2997}, "m", ""};
  const std::string shown = formatWithCaret(d, text, "f");
  EXPECT_LT(shown.size(), 500u);
  EXPECT_TRUE(isUtf8(shown));
  const std::size_t lines[] = {shown.find('\n'), shown.rfind('\n')};
  EXPECT_EQ(shown.substr(lines[0] + 1, 8), "  ...櫻");
  EXPECT_EQ(shown.substr(lines[1] - 3, 3), "...");
  EXPECT_EQ(shown.find('^') - lines[1] - 1, 2u + 3u + 2u * 34u);  // two blanks, the dots, 34 wide characters
}

}  // namespace
}  // namespace axil
