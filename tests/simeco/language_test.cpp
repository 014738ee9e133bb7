// Golden texts: each file of language/ says in its comments what must be said about it, and nothing else may be.
//   // expect error LINE:COLUMN: the message's beginning
//   // expect warning LINE:COLUMN: ...
//   // expect nothing
#include "simeco/language.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>

#include "base/files.hpp"
#include "simeco/growth.hpp"
#include "support/shared_data.hpp"

namespace axil::simeco {
namespace {

std::string textOfFile(const std::filesystem::path& path) {
  auto text = readFile(path);
  return text ? *text : std::string{};
}

std::vector<std::filesystem::path> languageFiles() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(AXIL_TEST_DIR) / "language"))
    if (entry.path().extension() == ".simeco") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<std::string> expectations(const std::string& text) {
  std::vector<std::string> found;
  constexpr std::string_view mark = "// expect ";
  for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at + 1)) {
    const std::size_t begin = at + mark.size();
    found.push_back(text.substr(begin, text.find('\n', begin) - begin));
  }
  return found;
}

/// `error 3:12: message`, as an expectation is written.
std::string said(const Diagnostic& d, const std::string& text) {
  const SourcePlace place = placeOf(text, d.span.begin);
  return std::string(d.severity == Severity::Error ? "error " : "warning ") + std::to_string(place.line) + ':' +
         std::to_string(place.column) + ": " + d.message;
}

std::string allOf(const std::vector<Diagnostic>& diagnostics, const std::string& text) {
  std::string lines;
  for (const Diagnostic& d : diagnostics) lines += said(d, text) + '\n';
  return lines;
}

class LanguageFile : public testing::TestWithParam<std::filesystem::path> {};

TEST_P(LanguageFile, SaysExactlyWhatItsCommentsExpect) {
  const auto file = readGrammarFile(GetParam());
  ASSERT_TRUE(file) << file.error().message;
  std::vector<std::string> expected = expectations(file->text);
  ASSERT_FALSE(expected.empty()) << "the file expects neither something nor `nothing`";
  if (expected == std::vector<std::string>{"nothing"}) expected.clear();

  const std::string all = allOf(file->parsed.diagnostics, file->text);
  ASSERT_EQ(file->parsed.diagnostics.size(), expected.size()) << all;
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_TRUE(said(file->parsed.diagnostics[i], file->text).starts_with(expected[i])) << "expected " << expected[i] << "\nof\n" << all;
}

TEST_P(LanguageFile, PrintsAsTheSameGrammarAndOnceMoreTheSame) {
  const auto file = readGrammarFile(GetParam());
  ASSERT_TRUE(file) << file.error().message;
  const std::string once = print(file->parsed.grammar);
  const Parsed again = parseSimeco(once);
  EXPECT_EQ(allOf(again.diagnostics, once), "");
  EXPECT_EQ(print(again.grammar), once);
  EXPECT_TRUE(again.grammar == file->parsed.grammar);
}

INSTANTIATE_TEST_SUITE_P(Language, LanguageFile, testing::ValuesIn(languageFiles()),
                         [](const auto& file) { return file.param.stem().string(); });

// ---- the thesis' own grammar ----

TEST(Lantana, IsReadWithoutADiagnostic) {
  AXIL_SKIP_WITHOUT_SHARED("data/lantana.simeco");
  const auto file = readGrammarFile(test::sharedPath("data/lantana.simeco"));
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_EQ(allOf(file->parsed.diagnostics, file->text), "");
}

TEST(Lantana, HasTheRulesStagesAndModulesOfTheAppendix) {
  AXIL_SKIP_WITHOUT_SHARED("data/lantana.simeco");
  const auto grammar = loadGrammar(test::sharedPath("data/lantana.simeco"));
  ASSERT_TRUE(grammar) << grammar.error().message;
  EXPECT_EQ(grammar->version, "1.0");
  ASSERT_EQ(grammar->plants.size(), 1u);
  const PlantGrammar& plant = grammar->plants[0];
  EXPECT_EQ(plant.rules.productions.size(), 19u);
  ASSERT_EQ(plant.organs.size(), 6u);
  EXPECT_EQ(plant.organs[1].stages.size(), 18u);
  EXPECT_EQ(plant.organs[2].stages.size(), 24u);
  std::map<std::string, int> letters;
  for (const Production& p : plant.rules.productions)
    for (const Module& m : p.successors.at(0).modules) ++letters[m.letter];
  EXPECT_EQ(letters["L"], 24);
  EXPECT_EQ(letters["["], 23);
  EXPECT_EQ(letters["]"], 23);
  EXPECT_EQ(letters["rotr"], 39);
  EXPECT_EQ(letters["rotu"], 39);
}

TEST(Lantana, PrintsByteForByteAsItStands) {
  AXIL_SKIP_WITHOUT_SHARED("data/lantana.simeco");
  const std::string text = textOfFile(test::sharedPath("data/lantana.simeco"));
  EXPECT_EQ(print(parseSimeco(text).grammar), text);
}

// ---- layout ----

std::string ruleText(const std::string& rule) {
  const Parsed parsed = parseSimeco("EcoSystem 1.1 \"e\" { Plant \"p\" { Grow { w = A(0); " + rule + " } } }");
  EXPECT_TRUE(parsed.ok()) << rule;
  const std::string text = print(parsed.grammar);
  const std::size_t begin = text.find("A(0);\n") + 6;
  return text.substr(begin + 12, text.find('\n', begin) - begin - 12);
}

TEST(Layout, TurnsStandTightAgainstWhatTheyTurn) {
  EXPECT_EQ(ruleText("S(1)->rotr(1)  rotu(2) S(3) L(4);"), "S(1) -> rotr(1)rotu(2)S(3)L(4) ;");
  EXPECT_EQ(ruleText("S(1)->S(0)A(10);"), "S(1) -> S(0) A(10) ;");
  EXPECT_EQ(ruleText("S(1)->S(0)[rotr(1)S(2)L(3)][S(4)S(5)]rotr(2)S(6)[S(7)];"),
            "S(1) -> S(0) [rotr(1)S(2)L(3)] [S(4) S(5)] rotr(2)S(6) [S(7)] ;");
  EXPECT_EQ(ruleText("S(1)->;"), "S(1) -> ;");
}

TEST(Layout, ConditionsStayWhereTheyWereWritten) {
  EXPECT_EQ(ruleText("S(i)->S(i+1,1002<i<1006);"), "S(i) -> S(i+1, 1002 < i < 1006) ;");
  EXPECT_EQ(ruleText("S(i,i>3)->S(i+1);"), "S(i, i > 3) -> S(i+1) ;");
  EXPECT_EQ(ruleText("S(i):i>3->S(i+1);"), "S(i) : i > 3 -> S(i+1) ;");
  EXPECT_EQ(ruleText("S(1)<A(i)>[S(2)]->;"), "S(1) < A(i) > [S(2)] -> ;");
}

TEST(Layout, ParenthesesStandWhereTheMeaningNeedsThem) {
  const auto value = [](const std::string& text) {
    const std::string rule = ruleText("A(i) -> S(" + text + ");");
    return rule.substr(10, rule.size() - 13);
  };
  EXPECT_EQ(value("((1+2))*(3)"), "(1+2)*3");
  EXPECT_EQ(value("1-(2-3)-4"), "1-(2-3)-4");
  EXPECT_EQ(value("(i^2)^3 + i^(2^3)"), "(i^2)^3+i^2^3");
  EXPECT_EQ(value("-2^2 + (-2)^2 + 2^-1"), "-2^2+(-2)^2+2^-1");
  EXPECT_EQ(value("-(5) - -5 - -i"), "-(5)-(-5)--i");
  EXPECT_EQ(value("!(i<3) + (i < 3)"), "!(i < 3)+(i < 3)");
  EXPECT_EQ(value("(i < 3)"), "(i < 3)");
  EXPECT_EQ(value("i ? 1 : 0 ? 2 : 3"), "i ? 1 : 0 ? 2 : 3");
}

TEST(Layout, NumbersKeepTheirDecimals) {
  EXPECT_EQ(ruleText("S(1) -> rotr(0.500000)rotu(-0.10)S(3) ;"), "S(1) -> rotr(0.500000)rotu(-0.10)S(3) ;");
  EXPECT_EQ(ruleText("S(1) -> rotr(1.50e2)rotu(.5)S(007) ;"), "S(1) -> rotr(150)rotu(0.5)S(7) ;");
  EXPECT_EQ(textOf(fixedNumber(0.1937516, 6)), "0.193752");
  EXPECT_EQ(textOf(Number{0.1234567, 3}), "0.1234567");
}

// ---- meaning ----

TEST(ParseSimeco, ANumberInAPredecessorIsMetAndANameIsBound) {
  const Parsed parsed = parseSimeco("EcoSystem 1.0 \"e\" { Plant \"p\" { Grow { w = S(1); S(2) -> S(1); S(i) -> S(i+1, 1 < i < 3); } } }");
  ASSERT_TRUE(parsed.ok());
  const auto& rules = parsed.grammar.plants[0].rules.productions;
  const auto& node = [&](std::size_t rule) -> const ExprNode& { return parsed.grammar.at(rules[rule].predecessor[0].arguments[0]).node; };
  EXPECT_TRUE(std::holds_alternative<Number>(node(0)));
  EXPECT_TRUE(std::holds_alternative<Name>(node(1)));
  ASSERT_TRUE(rules[1].condition);
  EXPECT_TRUE(std::holds_alternative<Chain>(parsed.grammar.at(*rules[1].condition).node));
  EXPECT_EQ(rules[1].successors[0].modules[0].arguments.size(), 1u);
}

TEST(ParseSimeco, EqualityLooksAtWhatIsSaidAndAtComments) {
  const auto grammar = [](const std::string& body) { return parseSimeco("EcoSystem 1.0 \"e\" {" + body + "}").grammar; };
  EXPECT_TRUE(grammar("a = 1+2*3; b = 4;") == grammar("\n a=1 + (2*3);\n\n b  =  4 ;"));
  EXPECT_FALSE(grammar("a = 1+2*3;") == grammar("a = (1+2)*3;"));
  EXPECT_FALSE(grammar("a = 1;") == grammar("a = 1; // one"));
  EXPECT_FALSE(grammar("a = 1;") == grammar("a = 1.0;"));
  EXPECT_FALSE(grammar("a = 1;") == grammar("a = \"1\";"));
}

// ---- files ----

class GrammarFiles : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& name, std::string_view bytes) {
    const auto path = folder_ / name;
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
  }
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

 private:
  std::filesystem::path folder_ = std::filesystem::path(testing::TempDir()) /
                                  (std::string("axil_language_") + testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(GrammarFiles, Big5IsRecognisedAndConverted) {
  const auto path =
      write("big5.simeco", "EcoSystem 1.0 \"\xB0\xA8\xC4\xE5\xA4\xA6\" { Plant \"p\" { Stem { Stage 1 {} } Grow { w = S(1); } } }");
  const auto file = readGrammarFile(path);
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_EQ(allOf(file->parsed.diagnostics, file->text), "");
  EXPECT_EQ(file->parsed.grammar.name, "馬櫻丹");
}

TEST_F(GrammarFiles, BinaryDataIsOneClearError) {
  const auto file = readGrammarFile(write("binary.simeco", std::string_view("\x00\x01\xFF\xFE\x00", 5)));
  ASSERT_FALSE(file);
  EXPECT_EQ(file.error().code, ErrorCode::Unreadable);
}

TEST_F(GrammarFiles, AMissingFileAndAFolderAreRefused) {
  EXPECT_FALSE(readGrammarFile("/does/not/exist.simeco"));
  EXPECT_FALSE(readGrammarFile(testing::TempDir()));
}

TEST_F(GrammarFiles, ErrorsInTheTextAreTheDetailsOfTheFailure) {
  const auto grammar = loadGrammar(write("wrong.simeco", "EcoSystem 1.0 \"e\" {\n  SoilPH = ;\n  DayLight = ;\n}\n"));
  ASSERT_FALSE(grammar);
  EXPECT_EQ(grammar.error().code, ErrorCode::BadGrammar);
  ASSERT_EQ(grammar.error().details.size(), 2u);
  EXPECT_NE(grammar.error().details[0].find("wrong.simeco:2:12: error: "), std::string::npos) << grammar.error().details[0];
  EXPECT_NE(grammar.error().details[1].find(":3:14: error: "), std::string::npos) << grammar.error().details[1];
}

// ---- examples of the reference ----

/// The ```simeco blocks of docs/simeco.md, each a complete file.
std::vector<std::string> documentedExamples() {
  const std::string page = textOfFile(std::filesystem::path(AXIL_TEST_DIR) / "../../docs/simeco.md");
  std::vector<std::string> examples;
  constexpr std::string_view fence = "```simeco\n";
  for (std::size_t at = page.find(fence); at != std::string::npos; at = page.find(fence, at + 1)) {
    const std::size_t begin = at + fence.size();
    examples.push_back(page.substr(begin, page.find("```", begin) - begin));
  }
  return examples;
}

TEST(Reference, EveryExampleParsesChecksGrowsAndPrintsAsItStands) {
  const std::vector<std::string> examples = documentedExamples();
  ASSERT_GE(examples.size(), 8u);
  for (const std::string& example : examples) {
    const Parsed parsed = parseSimeco(example);
    EXPECT_EQ(allOf(parsed.diagnostics, example), "") << example;
    EXPECT_EQ(allOf(check(parsed.grammar), example), "") << example;
    EXPECT_EQ(print(parsed.grammar), example);
    const auto growth = prepareGrowth(parsed.grammar);
    EXPECT_TRUE(growth) << growth.error().message << "\n" << example;
  }
}

/// The hints of everything wrong with a plant that has these rules.
std::string hintsFor(const std::string& rules, const std::string& stem = "GrowRate = 0.2;") {
  Parsed parsed = parseSimeco("EcoSystem 1.1 \"e\" { Plant \"p\" { Stem { Stage 1 { " + stem + " } } Grow { " + rules + " } } }");
  addChecked(parsed);
  std::string hints;
  for (const Diagnostic& d : parsed.diagnostics) hints += d.hint + "\n";
  return hints;
}

TEST(Language, WhatNewcomersWriteIsMetWithWhatTheyMeant) {
  const auto expects = [](const std::string& hints, const std::string& words) { EXPECT_NE(hints.find(words), std::string::npos) << "expected " << words << " in\n" << hints; };
  expects(hintsFor("w = A(0); A(i) : i > 3 and i < 5 -> S(1) ;"), "write && for and");
  expects(hintsFor("w = A(0); A(i) : i > 3 & i < 5 -> S(1) ;"), "write && for and");
  expects(hintsFor("w = A(0); A(i) : i < 3 --> S(1) ;"), "the arrow is ->");
  expects(hintsFor("w = S(1); # a comment"), "a comment starts with //");
  expects(hintsFor("w = A(0); A(0) -> 50%: S(1) | 50%: S(1) S(1) ;"), "0.7: S(1) | 0.3: L(1)");
  expects(hintsFor("w = A(0); A(0) -> rotr(rand(1))S(1) ;"), "random(low, high)");
  expects(hintsFor("w = A(0); A(0) -> rotr(pi/2)S(1) ;"), "write 3.141593");
  expects(hintsFor("start { x = 0; x++; } w = S(1);"), "x = x+1");
  expects(hintsFor("w = S(1);", "GrowRate = 0,2;"), "decimals stand behind a point");
  expects(hintsFor("w = S(1);", "GrowRate = 0.2; ColorFront = RGBA(120, 200, 80, 255);"), "divide by 255");
}

}  // namespace
}  // namespace axil::simeco
