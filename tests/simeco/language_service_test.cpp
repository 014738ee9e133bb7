// What an editor asks: tokens, outline, hover, definitions, references, completion, layout; both languages, whole and broken texts.

#include "simeco/language_service.hpp"

#include "base/files.hpp"
#include "base/rng.hpp"
#include "simeco/service_words.hpp"
#include "simeco/vocabulary.hpp"
#include "support/shared_data.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

namespace axil::simeco {
namespace {

namespace fs = std::filesystem;

const std::string kPlant = R"(EcoSystem 1.1 "wood" {
    Vigour = 2; // ours
    Plant "p" {
        Stem {
            Stage 1 {
                GrowRate = 0.2*Vigour;
            }
        }
        Grow {
            start { count = 0; }
            w = A(0);
            A(i) : i < 8 { count = count+1; } -> S(1) A(i+1) ;
            A(j) -> S(1) ;
        }
    }
}
)";

const std::string kClassic = R"(#define LEN 2 /* a length */
Lsystem: 1
derivation length: 3
define: { array a[2]={1,2}; }
Start: { n=0; }
Axiom: A(1)
A(x) : x<3 {n=n+a[0];} --> F(LEN)[+A(x+1)]
A(x) --> *
F(l) < A(x) --> F(ran(l))
endlsystem
)";

std::string wordAt(const std::string& text, SourceSpan span) { return text.substr(span.begin, span.end - span.begin); }

/// The byte of the n-th `word` of `text`.
std::size_t placeIn(const std::string& text, const std::string& word, int n = 1) {
  std::size_t at = text.find(word);
  for (; n > 1; --n) at = text.find(word, at + 1);
  return at;
}

std::vector<int> linesOf(const std::string& text, const std::vector<SourceSpan>& spans) {
  std::vector<int> lines;
  for (const SourceSpan span : spans) lines.push_back(placeOf(text, span.begin).line);
  return lines;
}

TokenRole roleOf(const std::string& text, Language language, const std::string& word, int n = 1) {
  const std::size_t at = placeIn(text, word, n);
  for (const ServiceToken& t : tokensOf(text, language))
    if (t.span.begin <= at && at < t.span.end) return t.role;
  return TokenRole::Unknown;
}

/// Tokens follow each other and leave only blanks (and joined lines) between them.
void expectTokensCover(const std::string& text, Language language, const std::string& name) {
  std::size_t done = 0;
  for (const ServiceToken& t : tokensOf(text, language)) {
    ASSERT_GE(t.span.begin, done) << name;
    ASSERT_GT(t.span.end, t.span.begin) << name;
    ASSERT_LE(t.span.end, text.size()) << name;
    const std::string between = text.substr(done, t.span.begin - done);
    if (language == Language::LSystem) {
      EXPECT_EQ(between.find_first_not_of(" \t\r\n\f\v\\"), std::string::npos) << name << ": '" << between << "'";
    }
    done = t.span.end;
  }
}

std::vector<fs::path> grammarFiles() {
  std::vector<fs::path> files;
  const auto add = [&](const fs::path& folder) {
    if (!fs::exists(folder)) return;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
      if (entry.path().extension() == ".l" || entry.path().extension() == ".simeco") files.push_back(entry.path());
  };
  add(fs::path(AXIL_TEST_DIR));
  add(fs::path(AXIL_TEST_DIR) / "../../samples");
  add(test::sharedPath("data/lsystems"));
  std::sort(files.begin(), files.end());
  return files;
}

LSystemOptions besides(const fs::path& path) { return {.include = includesBeside(path)}; }

// ---- tokens

TEST(LanguageService, SimecoWordsHaveTheirRoles) {
  const auto role = [](const std::string& word, int n = 1) { return roleOf(kPlant, Language::SimEco, word, n); };
  EXPECT_EQ(role("EcoSystem"), TokenRole::Keyword);
  EXPECT_EQ(role("\"wood\""), TokenRole::Text);
  EXPECT_EQ(role("// ours"), TokenRole::Comment);
  EXPECT_EQ(role("GrowRate"), TokenRole::Attribute);
  EXPECT_EQ(role("Vigour", 2), TokenRole::Name);
  EXPECT_EQ(role("S(1)"), TokenRole::Module);
  EXPECT_EQ(role("->"), TokenRole::Sign);
  EXPECT_EQ(role("0.2"), TokenRole::Number);
  EXPECT_EQ(roleOf("Grow { w = A(sin(1)) @ ; }", Language::SimEco, "sin"), TokenRole::Function);
  EXPECT_EQ(roleOf("Grow { w = A(sin(1)) @ ; }", Language::SimEco, "@"), TokenRole::Unknown);
}

TEST(LanguageService, ClassicLettersAndNamesAreToldApart) {
  const auto role = [](const std::string& word, int n = 1) { return roleOf(kClassic, Language::LSystem, word, n); };
  EXPECT_EQ(role("#define"), TokenRole::Directive);
  EXPECT_EQ(role("LEN"), TokenRole::Macro);
  EXPECT_EQ(role("LEN", 2), TokenRole::Macro);
  EXPECT_EQ(role("derivation length:"), TokenRole::Keyword);
  EXPECT_EQ(role("array"), TokenRole::Keyword);
  EXPECT_EQ(role("A(1)"), TokenRole::Module);
  EXPECT_EQ(role("x<3"), TokenRole::Name);
  EXPECT_EQ(role("<3"), TokenRole::Operator);
  EXPECT_EQ(role("< A"), TokenRole::Sign);
  EXPECT_EQ(role("[+A"), TokenRole::Branch);
  EXPECT_EQ(role("[2]"), TokenRole::Separator);
  EXPECT_EQ(role("ran"), TokenRole::Function);
  EXPECT_EQ(role("-->"), TokenRole::Sign);
  EXPECT_EQ(role("endlsystem"), TokenRole::Keyword);
}

TEST(LanguageService, TokensCoverEveryTextWhateverItIs) {
  for (const fs::path& path : grammarFiles()) expectTokensCover(readFile(path).value(), languageOfFile(path.string()), path.string());
  Rng rng(11);
  for (int round = 0; round < 300; ++round) {
    std::string text = round % 2 == 0 ? kPlant : kClassic;
    for (int i = 0; i < 6; ++i) text.insert(rng.below(text.size()), 1, static_cast<char>(rng.below(128)));
    text.erase(rng.below(text.size()), rng.below(60));
    expectTokensCover(text, round % 2 == 0 ? Language::SimEco : Language::LSystem, "round " + std::to_string(round));
  }
}

// ---- meaning

TEST(LanguageService, TheOutlineNamesPlantsStagesAndRules) {
  const Analysis a = analyse(kPlant, Language::SimEco);
  std::string outline;
  for (const ServiceSymbol& s : a.symbols) outline += std::to_string(s.level) + s.name + " ";
  EXPECT_EQ(outline, "0wood 1Vigour 1p 2Stem 3Stage 1 4GrowRate 2w 2A(i) 2A(j) ");
  const Analysis classic = analyse(kClassic, Language::LSystem);
  outline.clear();
  for (const ServiceSymbol& s : classic.symbols) outline += std::to_string(s.level) + s.name + " ";
  EXPECT_EQ(outline, "0LEN 01 1Axiom 1A(x) 1A(x) 1A(x) ");
}

TEST(LanguageService, AModuleLeadsToItsRulesAndItsStage) {
  const Analysis a = analyse(kPlant, Language::SimEco);
  EXPECT_EQ(linesOf(kPlant, definitionsAt(a, placeIn(kPlant, "A(0)"))), (std::vector{12, 13}));
  EXPECT_EQ(linesOf(kPlant, definitionsAt(a, placeIn(kPlant, "S(1)"))), (std::vector{5}));
  const Analysis c = analyse(kClassic, Language::LSystem);
  EXPECT_EQ(linesOf(kClassic, definitionsAt(c, placeIn(kClassic, "A(1)"))), (std::vector{7, 8, 9}));
  EXPECT_EQ(linesOf(kClassic, definitionsAt(c, placeIn(kClassic, "LEN", 2))), (std::vector{1}));
}

TEST(LanguageService, ANameIsFoundWhereItMeansTheSame) {
  const Analysis a = analyse(kPlant, Language::SimEco);
  EXPECT_EQ(linesOf(kPlant, referencesAt(a, placeIn(kPlant, "count = 0"))), (std::vector{10, 12, 12}));
  EXPECT_EQ(linesOf(kPlant, referencesAt(a, placeIn(kPlant, "i < 8"))), (std::vector{12, 12, 12})) << "not the names of other rules";
  EXPECT_EQ(linesOf(kPlant, referencesAt(a, placeIn(kPlant, "Vigour"))), (std::vector{2, 6}));
  EXPECT_EQ(linesOf(kPlant, definitionsAt(a, placeIn(kPlant, "Vigour", 2))), (std::vector{2}));
  const Analysis c = analyse(kClassic, Language::LSystem);
  EXPECT_EQ(linesOf(kClassic, referencesAt(c, placeIn(kClassic, "n=0"))), (std::vector{5, 7, 7}));
  EXPECT_EQ(linesOf(kClassic, referencesAt(c, placeIn(kClassic, "x<3"))), (std::vector{7, 7, 7}));
}

TEST(LanguageService, HoverSaysWhatStandsThere) {
  const Analysis a = analyse(kPlant, Language::SimEco);
  EXPECT_EQ(hoverAt(a, placeIn(kPlant, "A(0)"))->text,
            "A(n): apex number n\nline 12: A(i) : i < 8 { count = count+1; } -> S(1) A(i+1) ;\nline 13: A(j) -> S(1) ;");
  EXPECT_EQ(hoverAt(a, placeIn(kPlant, "GrowRate"))->text, "GrowRate: length gained in one unit of time\nline 6: GrowRate = 0.2*Vigour;");
  EXPECT_FALSE(hoverAt(a, placeIn(kPlant, "0.2")));
  const Analysis c = analyse(kClassic, Language::LSystem);
  EXPECT_EQ(hoverAt(c, placeIn(kClassic, "LEN", 2))->text, "#define LEN 2 /* a length */");
  EXPECT_EQ(hoverAt(c, placeIn(kClassic, "ran"))->text, "ran(x): drawn evenly from 0 to below x");
  EXPECT_EQ(wordAt(kClassic, hoverAt(c, placeIn(kClassic, "ran"))->where), "ran");
  EXPECT_EQ(hoverAt(c, placeIn(kClassic, "derivation"))->text, "derivation length: n: how many steps; 0 when missing");
}

std::vector<std::string> offered(const std::string& text, Language language, std::size_t offset) {
  std::vector<std::string> words;
  for (const Completion& c : completionsAt(analyse(text, language), offset).entries) words.push_back(c.text);
  return words;
}

TEST(LanguageService, CompletionOffersWhatFitsThere) {
  const auto after = [](const std::string& text, Language language) { return offered(text, language, text.size()); };
  EXPECT_EQ(after("EcoSystem 1.1 \"e\" { Plant \"p\" { Stem { Stage 1 { Broa", Language::SimEco), (std::vector<std::string>{"BroadenRate", "BroadenTime"}));
  EXPECT_EQ(after("EcoSystem 1.1 \"e\" { Pl", Language::SimEco), (std::vector<std::string>{"Plant"}));
  EXPECT_EQ(after("EcoSystem 1.1 \"e\" { Plant \"p\" { Grow { w = ro", Language::SimEco), (std::vector<std::string>{"rotr", "rotu", "round"}));
  EXPECT_EQ(after("Lsystem: 1\nder", Language::LSystem), (std::vector<std::string>{"derivation length:"}));
  EXPECT_EQ(after("#define LENGTH 3\nLsystem: 1\nAxiom: A\nA --> F(LE", Language::LSystem), (std::vector<std::string>{"LENGTH"}));
  EXPECT_TRUE(after("// der", Language::LSystem).empty()) << "not in a comment that is being written";
}

TEST(LanguageService, EveryWordOfTheLanguagesIsExplained) {
  for (const AttributeWord& w : attributeWords()) EXPECT_NE(wordNote(Language::SimEco, CompletionKind::Attribute, w.name), nullptr) << w.name;
  for (const FunctionWord& w : functionWords()) EXPECT_NE(wordNote(Language::SimEco, CompletionKind::Function, w.name), nullptr) << w.name;
  for (const LetterWord& w : letterWords()) EXPECT_NE(wordNote(Language::SimEco, CompletionKind::Module, w.letter), nullptr) << w.letter;
}

TEST(LanguageService, BrokenTextsAreAnswered) {
  Rng rng(5);
  for (int round = 0; round < 40; ++round) {
    const Language language = round % 2 == 0 ? Language::SimEco : Language::LSystem;
    std::string text = language == Language::SimEco ? kPlant : kClassic;
    text.erase(rng.below(text.size()), rng.below(80));
    text.insert(rng.below(text.size()), 1, static_cast<char>(1 + rng.below(126)));
    const Analysis a = analyse(text, language);
    for (std::size_t at = 0; at <= text.size(); at += 13) {
      const auto hover = hoverAt(a, at);
      EXPECT_TRUE(!hover || hover->where.end <= text.size());
      for (const SourceSpan span : referencesAt(a, at)) EXPECT_LE(span.end, text.size());
      static_cast<void>(completionsAt(a, at));
    }
  }
}

// ---- layout

TEST(Layout, EveryGrammarWithoutErrorsIsLaidOutOnceAndForAll) {
  int files = 0;
  for (const fs::path& path : grammarFiles()) {
    const std::string text = decodeGrammarText(readFile(path).value(), languageOfFile(path.string())).value();
    const Language language = languageOfFile(path.string());
    const LSystemOptions options = besides(path);
    const auto once = formatted(text, language, options);
    const Parsed parsed = language == Language::LSystem ? parseLSystem(text, options) : parseSimeco(text);
    EXPECT_EQ(static_cast<bool>(once), parsed.ok()) << path << (once ? "" : once.error().message);
    if (!once) continue;
    const auto twice = formatted(*once, language, options);
    ASSERT_TRUE(twice) << path << twice.error().message;
    EXPECT_EQ(*twice, *once) << path;
    ++files;
  }
  EXPECT_GE(files, 40);
}

TEST(Layout, AClassicTextKeepsMacrosCommentsAndLineBreaks) {
  const std::string text = "#define  N   3\r\n  lsystem:1\n\n\n\nDerivation   Length :N\nStart:{\nx=1;if (x) {\ny=2;\n}\n}\nAxiom:A   B /* c */\n"
                           "A<B>C:x>1{y=1;}-->A ( x , 2 )  [+B]:2  // end  \nB -->\\ \n* < # --> #\n\tB\nendlsystem\n\n\n";
  const auto laidOut = formatted(text, Language::LSystem);
  ASSERT_TRUE(laidOut) << laidOut.error().message << laidOut.error().details.front();
  EXPECT_EQ(*laidOut, "#define  N   3\nlsystem: 1\n\nDerivation Length: N\nStart: {\n  x=1;if (x) {\n    y=2;\n  }\n}\nAxiom: A B  /* c */\n"
                      "A < B > C : x>1{y=1;} --> A (x, 2) [+B] : 2  // end\nB --> \\ \n* < # --> #\n\tB\nendlsystem\n");
}

TEST(Layout, ATextWithErrorsIsRefusedWithItsErrors) {
  const auto refused = formatted("Lsystem: 1\nAxiom: A\nA -> B\nendlsystem\n", Language::LSystem);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::BadGrammar);
  ASSERT_EQ(refused.error().details.size(), 1u);
  EXPECT_FALSE(formatted("EcoSystem 1.0 {", Language::SimEco));
}

}  // namespace
}  // namespace axil::simeco
