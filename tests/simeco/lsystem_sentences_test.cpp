// lsystem/sentences.txt: one small model for each sentence about the classic language, with the string that it must derive.

#include "base/files.hpp"
#include "base/text.hpp"
#include "lsystem_compare.hpp"
#include "simeco/lsystem_derive.hpp"
#include "simeco/lsystem_language.hpp"
#include "simeco/lsystem_text.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace axil::simeco {
namespace {

struct Sentence {
  std::string name;
  std::string expected;
  std::string image;  ///< after the homomorphism; empty: not asked for
  std::string model;
};

/// Takes the line `key: value` from the front of `text`, if it stands there.
std::string taken(std::string& text, const std::string& key) {
  if (!text.starts_with(key + ":")) return {};
  const std::size_t end = text.find('\n');
  const std::string value = text.substr(key.size() + 1, end - key.size() - 1);
  text.erase(0, end + 1);
  return value;
}

std::string withoutBlanks(std::string text) {
  std::erase(text, ' ');
  return text;
}

std::vector<Sentence> sentences() {
  const std::string text = readFile(std::filesystem::path(AXIL_TEST_DIR) / "lsystem/sentences.txt").value();
  const std::string mark = "\n=== ";
  std::vector<Sentence> all;
  for (std::size_t at = text.find(mark); at != std::string::npos;) {
    const std::size_t begin = at + mark.size();
    at = text.find(mark, begin);
    const std::size_t line = text.find('\n', begin);
    Sentence sentence{text.substr(begin, line - begin), {}, {}, text.substr(line + 1, at == std::string::npos ? at : at - line)};
    sentence.expected = withoutBlanks(taken(sentence.model, "expect"));
    sentence.image = withoutBlanks(taken(sentence.model, "image"));
    if (!taken(sentence.model, "line ends").empty())
      for (std::size_t i = sentence.model.find('\n'); i != std::string::npos; i = sentence.model.find('\n', i + 2)) sentence.model.insert(i, "\r");
    all.push_back(std::move(sentence));
  }
  return all;
}

std::string firstError(const std::vector<Diagnostic>& diagnostics) {
  for (const Diagnostic& d : diagnostics)
    if (d.severity == Severity::Error) return d.message;
  return {};
}

TEST(LSystemSentences, EachModelDerivesItsString) {
  std::size_t models = 0;
  for (const Sentence& sentence : sentences()) {
    SCOPED_TRACE(sentence.name);
    ++models;
    const Parsed parsed = parseLSystem(sentence.model);
    EXPECT_EQ(firstError(parsed.diagnostics), "");
    EXPECT_EQ(firstError(checkLSystem(parsed.grammar)), "");
    if (!parsed.ok()) continue;
    const auto derived = deriveLSystem(parsed.grammar);
    EXPECT_TRUE(derived) << derived.error().message;
    if (!derived) continue;
    constexpr double rounding = 1e-9;  // of queries
    EXPECT_EQ(test::difference(toLSystemText(derived->string), sentence.expected, rounding), "");
    if (sentence.image.empty()) continue;
    const auto image = imageOf(*derived);
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_EQ(test::difference(toLSystemText(image->string), sentence.image, rounding), "");
  }
  EXPECT_GE(models, 210u);
}

TEST(LSystemSentences, EachModelPrintsAsATextThatDerivesTheSame) {
  for (const Sentence& sentence : sentences()) {
    SCOPED_TRACE(sentence.name);
    const Parsed parsed = parseLSystem(sentence.model);
    if (!parsed.ok()) continue;
    const Parsed again = parseLSystem(print(parsed.grammar));
    EXPECT_TRUE(again.ok() && again.grammar == parsed.grammar) << print(parsed.grammar);
  }
}

}  // namespace
}  // namespace axil::simeco
