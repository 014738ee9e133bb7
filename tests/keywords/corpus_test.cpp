// The corpus: sentences with all that they say. Precision and recall by property are printed; a reader who gets worse fails.
#include "base/files.hpp"
#include "base/table.hpp"
#include "base/text.hpp"
#include "keywords/keywords.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace axil::keywords {
namespace {

std::string rangeOf(const Trait& trait) {
  std::string text;
  if (trait.minimum) text += "(" + shortest(*trait.minimum) + "-)";
  if (trait.low) text += shortest(*trait.low);
  if (trait.high && trait.low != trait.high) text += (trait.low ? "-" : "..") + shortest(*trait.high);
  if (trait.maximum) text += "(-" + shortest(*trait.maximum) + ")";
  return trait.unit.empty() ? text : text + " " + trait.unit;
}

std::string inShort(const Trait& trait) {
  const bool isPiece = !trait.part.empty() && trait.part != "blade" && trait.part != "surface";
  const std::string piece = trait.part == "lip part" ? "lip" : trait.part;
  return trait.organ + (isPiece ? "." + piece : "") + "|" + trait.property + "|" + (trait.value.empty() ? rangeOf(trait) : trait.value);
}

// "leaf|shape|ovate; |length|3 cm": a trait without an organ is about the organ before it.
std::vector<std::string> expectedIn(const std::string& cell) {
  std::vector<std::string> traits;
  std::string organ;
  if (cell == "-") return traits;
  for (std::string& trait : splitList(cell, ';')) {
    if (trait.front() == '|') trait = organ + trait;
    organ = trait.substr(0, trait.find('|'));
    traits.push_back(std::move(trait));
  }
  return traits;
}

std::string withLineEnds(std::string sentence) {
  for (std::size_t at = sentence.find("\\n"); at != std::string::npos; at = sentence.find("\\n")) sentence.replace(at, 2, "\n");
  return sentence;
}

std::string propertyOf(const std::string& inShort) {
  const std::size_t from = inShort.find('|') + 1;
  return inShort.substr(from, inShort.find('|', from) - from);
}

struct Score {
  int right = 0;
  int missed = 0;
  int invented = 0;
  [[nodiscard]] double f1() const { return right == 0 ? 0 : 2.0 * right / (2.0 * right + missed + invented); }
};

void compare(std::vector<std::string> expected, const std::vector<std::string>& read, const std::string& sentence, std::map<std::string, Score>& scores) {
  for (const std::string& trait : read) {
    const auto found = std::find(expected.begin(), expected.end(), trait);
    if (found == expected.end()) {
      ++scores[propertyOf(trait)].invented;
      std::printf("  invented %s in: %s\n", trait.c_str(), sentence.c_str());
    } else {
      ++scores[propertyOf(trait)].right;
      expected.erase(found);
    }
  }
  for (const std::string& trait : expected) {
    ++scores[propertyOf(trait)].missed;
    std::printf("  missed %s in: %s\n", trait.c_str(), sentence.c_str());
  }
}

// Properties that a corpus answers; another's statements are not looked at.
using Properties = std::set<std::string>;

bool isAnswered(const Properties& answered, const std::string& trait) { return answered.empty() || answered.contains(propertyOf(trait)); }

std::map<std::string, Score> scoresOf(const std::string& name, const Properties& answered = {}) {
  const Result<std::string> text = readFile(std::string(AXIL_TEST_DIR) + "/corpus/" + name);
  EXPECT_TRUE(text) << text.error().message;
  const Result<Table> table = readTable(*text, name);
  EXPECT_TRUE(table) << table.error().message;
  std::map<std::string, Score> scores;
  for (const Table::Row& row : table->rows) {
    const std::string sentence = withLineEnds(table->cell(row, "sentence"));
    const Result<Traits> traits = readTraits(sentence);
    EXPECT_TRUE(traits) << sentence;
    std::vector<std::string> read;
    for (const Trait& trait : *traits)
      if (isAnswered(answered, inShort(trait))) read.push_back(inShort(trait));
    compare(expectedIn(table->cell(row, "traits")), read, sentence, scores);
  }
  return scores;
}

// What must be reached, by property; the rest is printed. Sizes and counts are exact numbers of the right organ.
const std::map<std::string, double>& goals() {
  static const std::map<std::string, double> all{{"arrangement", 0.95}, {"type", 0.95},   {"shape", 0.95}, {"margin", 0.95},   {"habit", 0.95},    {"life form", 0.95}, {"length", 0.9},
                                                 {"width", 0.9},        {"height", 0.9},  {"count", 0.9},  {"diameter", 0.9}, {"merosity", 0.9}};
  return all;
}

void printScores(const char* name, const std::map<std::string, Score>& scores) {
  std::printf("%-24s right missed invented  precision recall    F1\n", name);
  for (const auto& [property, score] : scores)
    std::printf("  %-22s %5d %6d %8d %10.3f %6.3f %5.3f\n", property.c_str(), score.right, score.missed, score.invented,
                static_cast<double>(score.right) / std::max(1, score.right + score.invented), static_cast<double>(score.right) / std::max(1, score.right + score.missed), score.f1());
}

class Corpus : public testing::TestWithParam<const char*> {};

TEST_P(Corpus, IsReadNearlyWithoutFault) {
  const std::map<std::string, Score> scores = scoresOf(std::string(GetParam()) + ".tsv");
  printScores(GetParam(), scores);
  for (const auto& [property, goal] : goals())
    if (scores.contains(property)) {
      EXPECT_GE(scores.at(property).f1(), goal) << property;
    }
  EXPECT_GE(scores.size(), 10u);
}

INSTANTIATE_TEST_SUITE_P(Scripts, Corpus, testing::Values("english", "traditional", "simplified"), [](const auto& script) { return std::string(script.param); });

// Sentences that nothing was tuned on, the three scripts together.
TEST(HeldOutCorpus, ReachesTheGoals) {
  std::map<std::string, Score> all;
  for (const char* script : {"english_held", "traditional_held", "simplified_held"}) {
    const std::map<std::string, Score> scores = scoresOf(std::string(script) + ".tsv");
    printScores(script, scores);
    for (const auto& [property, score] : scores) {
      all[property].right += score.right;
      all[property].missed += score.missed;
      all[property].invented += score.invented;
    }
  }
  printScores("held out", all);
  for (const auto& [property, goal] : goals()) EXPECT_GE(all[property].f1(), goal) << property;
}

// Whole paragraphs as floras write them, of many families.
class Floras : public testing::TestWithParam<const char*> {};

TEST_P(Floras, ReachTheGoals) {
  const Properties answered{"arrangement", "type", "shape", "margin", "habit", "branching", "life form", "length", "width", "height", "diameter", "count", "merosity"};
  const std::map<std::string, Score> scores = scoresOf(std::string(GetParam()) + ".tsv", answered);
  printScores(GetParam(), scores);
  for (const auto& [property, goal] : goals())
    if (scores.contains(property)) {
      EXPECT_GE(scores.at(property).f1(), goal) << property;
    }
}

INSTANTIATE_TEST_SUITE_P(Scripts, Floras, testing::Values("english_floras", "traditional_floras", "simplified_floras", "english_fresh", "traditional_fresh", "simplified_fresh", "english_fourth", "traditional_fourth", "simplified_fourth", "english_fifth", "traditional_fifth", "simplified_fifth", "english_sixth", "traditional_sixth", "simplified_sixth", "english_seventh", "traditional_seventh", "simplified_seventh",
                         "english_eighth", "traditional_eighth", "simplified_eighth", "ninth", "turns", "tenth", "eleventh", "twelfth", "thirteenth"), [](const auto& script) { return std::string(script.param); });

}  // namespace
}  // namespace axil::keywords
