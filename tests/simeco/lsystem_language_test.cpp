// The classic L-system language: what is read, what is refused and where, and that what is printed reads back.
// lsystem/*.l are its cases; each says in its first comments what is expected of it.

#include "simeco/lsystem_language.hpp"

#include "base/files.hpp"
#include "base/rng.hpp"
#include "support/shared_data.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>

namespace axil::simeco {
namespace {

namespace fs = std::filesystem;

struct Case {
  fs::path path;
  std::string text;
  Parsed parsed;
};

/// The file parsed and, if it has no error so far, checked.
Case readCase(const fs::path& path) {
  Case result{path, readFile(path).value(), {}};
  result.parsed = parseLSystem(result.text, {.include = includesBeside(path)});
  if (!result.parsed.ok()) return result;
  const auto more = checkLSystem(result.parsed.grammar);
  result.parsed.diagnostics.insert(result.parsed.diagnostics.end(), more.begin(), more.end());
  return result;
}

std::vector<fs::path> lFilesIn(const fs::path& folder) {
  std::vector<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".l") paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  return paths;
}

std::string printed(const Case& c) {
  std::string all;
  for (const Diagnostic& d : c.parsed.diagnostics) all += formatDiagnostic(d, c.text, c.path.filename().string()) + "\n";
  return all;
}

/// "error 3: words" of `// expect error 3: words`, with how often each is expected.
std::vector<std::string> expectations(const std::string& text) {
  std::vector<std::string> result;
  const std::string mark = "// expect ";
  for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at + 1)) {
    const std::size_t begin = at + mark.size();
    std::string line = text.substr(begin, text.find('\n', begin) - begin);
    std::erase(line, '\r');
    result.push_back(line);
  }
  return result;
}

bool meets(const Diagnostic& d, const std::string& text, const std::string& expectation) {
  const std::size_t colon = expectation.find(": ");
  const std::string place = std::string(d.severity == Severity::Error ? "error " : "warning ") + std::to_string(placeOf(text, d.span.begin).line);
  const std::string words = d.message + " (" + d.hint + ")";
  return place == expectation.substr(0, colon) && words.find(expectation.substr(colon + 2)) != std::string::npos;
}

TEST(LSystemLanguage, EachCaseHasTheDiagnosticsThatItAnnouncesAndNoOthers) {
  int cases = 0;
  for (const fs::path& path : lFilesIn(fs::path(AXIL_TEST_DIR) / "lsystem")) {
    const Case c = readCase(path);
    const std::vector<std::string> expected = expectations(c.text);
    for (const std::string& e : expected)
      EXPECT_TRUE(std::any_of(c.parsed.diagnostics.begin(), c.parsed.diagnostics.end(), [&](const Diagnostic& d) { return meets(d, c.text, e); }))
          << path.filename() << " expects " << e << " but has\n" << printed(c);
    for (const Diagnostic& d : c.parsed.diagnostics)
      EXPECT_TRUE(std::any_of(expected.begin(), expected.end(), [&](const std::string& e) { return meets(d, c.text, e); }))
          << "not announced: " << formatDiagnostic(d, c.text, path.filename().string());
    ++cases;
  }
  EXPECT_GE(cases, 27);
}

/// What is printed reads back as the same grammar, and printing that changes no byte.
void expectRoundTrip(const Grammar& grammar, const std::string& name) {
  const std::string text = print(grammar);
  const Parsed again = parseLSystem(text);
  EXPECT_TRUE(again.ok()) << name << "\n" << text << (again.diagnostics.empty() ? "" : formatDiagnostic(again.diagnostics[0], text, "printed"));
  EXPECT_TRUE(again.grammar == grammar) << name << "\n" << text;
  EXPECT_EQ(print(again.grammar), text) << name;
}

TEST(LSystemLanguage, EveryCaseIsPrintedSoThatItReadsBack) {
  for (const fs::path& path : lFilesIn(fs::path(AXIL_TEST_DIR) / "lsystem")) {
    const Case c = readCase(path);
    if (c.parsed.ok()) expectRoundTrip(c.parsed.grammar, path.filename().string());
  }
}

TEST(LSystemLanguage, SharedModelsParseAndReadBack) {
  AXIL_SKIP_WITHOUT_SHARED("data/lsystems");
  const std::map<std::string, int> warned{{"condition_constant.l", 1}, {"rule_order_first_match.l", 1}, {"strict_predecessor_order.l", 1}};
  int files = 0;
  for (const char* folder : {"data/lsystems/models", "data/lsystems/turtle", "data/lsystems/bench"}) {
    for (const fs::path& path : lFilesIn(test::sharedPath(folder))) {
      const Case c = readCase(path);
      const auto found = warned.find(path.filename().string());
      EXPECT_EQ(c.parsed.diagnostics.size(), static_cast<std::size_t>(found == warned.end() ? 0 : found->second)) << printed(c);
      expectRoundTrip(c.parsed.grammar, path.filename().string());
      ++files;
    }
  }
  EXPECT_GT(files, 140);
}

TEST(LSystemLanguage, SharedWrongFilesAreRefusedAtTheLineOfTheMistake) {
  AXIL_SKIP_WITHOUT_SHARED("data/lsystems/models/wrong");
  for (const fs::path& path : lFilesIn(test::sharedPath("data/lsystems/models/wrong"))) {
    const Case c = readCase(path);
    const std::string json = readFile(fs::path(path).replace_extension(".json")).value();
    const std::string key = "\"error_line\": ";
    const int line = std::stoi(json.substr(json.find(key) + key.size()));
    ASSERT_FALSE(c.parsed.ok()) << path.filename();
    for (const Diagnostic& d : c.parsed.diagnostics) {
      if (d.severity != Severity::Error) continue;
      EXPECT_EQ(placeOf(c.text, d.span.begin).line, line) << printed(c);
    }
  }
}

TEST(LSystemLanguage, PlacesAreThoseOfTheTextBeforeMacros) {
  const std::string text = "#define LONG a very long replacement\n/* two\nlines */ Lsystem: 1\nAxiom: A\nLONG B \\\n C --> D(no(1))\nendlsystem\n";
  const Parsed parsed = parseLSystem(text);
  ASSERT_EQ(parsed.diagnostics.size(), 1u);
  EXPECT_EQ(text.substr(parsed.diagnostics[0].span.begin, parsed.diagnostics[0].span.end - parsed.diagnostics[0].span.begin), "no");
  EXPECT_EQ(placeOf(text, parsed.diagnostics[0].span.begin).line, 6);
  const std::string good = "#define L A\nLsystem: 1\nAxiom: B\nL --> L(1)\n  C  -->  B /* c */ D \nendlsystem\n";
  const RuleSet rules = parseLSystem(good).grammar.plants[0].rules;
  const auto words = [&](SourceSpan s) { return good.substr(s.begin, s.end - s.begin); };
  EXPECT_EQ(words(rules.productions[0].where), "L --> L(1)");
  EXPECT_EQ(words(rules.productions[1].where), "C  -->  B /* c */ D");
  EXPECT_EQ(words(rules.productions[1].successors[0].modules[1].where), "D");
}

TEST(LSystemLanguage, WithoutADerivationLengthNothingIsDerived) {
  const Grammar grammar = parseLSystem("Lsystem: 1\nAxiom: A\nA --> AB\nendlsystem\n").grammar;
  ASSERT_TRUE(grammar.plants[0].rules.derivationLength);
  EXPECT_EQ(print(grammar), "Lsystem: 1\nderivation length: 0\nAxiom: A\nA --> AB\nendlsystem\n");
}

TEST(LSystemLanguage, DeepNestingIsRefusedNotFollowed) {
  const auto deep = [](const std::string& expression) { return "Lsystem: 1\nAxiom: A(" + expression + ")\nA --> A\nendlsystem\n"; };
  const auto repeated = [](const std::string& part, int times) {
    std::string all;
    for (int i = 0; i < times; ++i) all += part;
    return all;
  };
  EXPECT_TRUE(parseLSystem(deep(repeated("(", 100) + "1" + repeated(")", 100))).ok());
  EXPECT_FALSE(parseLSystem(deep(repeated("(", 100000) + "1" + repeated(")", 100000))).ok());
  EXPECT_FALSE(parseLSystem(deep(repeated("-", 100000) + "1")).ok());
  EXPECT_FALSE(parseLSystem(deep(repeated("1+", 100000) + "1")).ok());
  EXPECT_FALSE(parseLSystem(deep(repeated("1?1:", 100000) + "1")).ok());
  EXPECT_FALSE(parseLSystem("Lsystem: 1\nStart: " + repeated("{ if (1) ", 100000) + "{x=1;}" + repeated("}", 100000) + "\nAxiom: A\nendlsystem\n").ok());
}

TEST(LSystemLanguage, MacrosThatGrowWithoutEndAreStopped) {
  std::string text = "#define M0 AAAAAAAAAA\n";
  for (int i = 1; i < 12; ++i) {
    const std::string last = "M" + std::to_string(i - 1);
    text += "#define M" + std::to_string(i) + " " + last + " " + last + " " + last + " " + last + " " + last + " " + last + " " + last + " " + last + "\n";
  }
  text += "#define SELF SELF\nLsystem: 1\nAxiom: SELF\nA --> M11\nendlsystem\n";
  const Parsed parsed = parseLSystem(text, {.macroTextLimit = 1 << 20});
  ASSERT_FALSE(parsed.ok());
  EXPECT_NE(parsed.diagnostics[0].message.find("macros make more than"), std::string::npos) << parsed.diagnostics[0].message;
}

TEST(LSystemLanguage, AnIncludeThatIncludesItselfIsStopped) {
  const IncludeReader itself = [](const std::string&) -> Result<std::string> { return std::string("#include \"me\"\n"); };
  const Parsed parsed = parseLSystem("#include \"me\"\nLsystem: 1\nAxiom: A\nA --> B\nendlsystem\n", {.include = itself});
  ASSERT_EQ(parsed.diagnostics.size(), 1u);
  EXPECT_NE(parsed.diagnostics[0].message.find("nested more than"), std::string::npos);
  EXPECT_FALSE(parseLSystem("#include \"me\"\nLsystem: 1\nAxiom: A\nA --> B\nendlsystem\n").ok()) << "without a reader";
}

TEST(LSystemLanguage, AnyBytesEndInDiagnosticsNotInTrouble) {
  const std::string whole = readFile(fs::path(AXIL_TEST_DIR) / "lsystem" / "statements.l").value() + readFile(fs::path(AXIL_TEST_DIR) / "lsystem" / "macros.l").value();
  Rng rng(7);
  for (int round = 0; round < 400; ++round) {
    std::string text = whole;
    for (int i = 0; i < 4; ++i) {
      const std::size_t at = rng.below(text.size());
      const std::size_t kind = rng.below(3);
      if (kind == 0) text.erase(at, 1 + rng.below(20));
      if (kind == 1) text.insert(at, 1, static_cast<char>(rng.below(256)));
      if (kind == 2) text.insert(at, text.substr(rng.below(text.size()), rng.below(30)));
    }
    const Parsed parsed = parseLSystem(text);
    for (const Diagnostic& d : parsed.diagnostics) EXPECT_LE(d.span.begin, text.size());
    if (parsed.ok()) static_cast<void>(checkLSystem(parsed.grammar));
  }
}

/// Grammars by chance, to try the printer on what nobody thought of.
class Chance {
 public:
  explicit Chance(std::uint64_t seed) : rng_(seed) {}

  Grammar grammar() {
    g_ = Grammar{};
    g_.language = Language::LSystem;
    g_.version.clear();
    PlantGrammar plant;
    plant.rules = rules("1");
    plant.name = g_.name = "1";
    for (int i = 0; one(3); ++i) plant.subRules.push_back(rules(std::to_string(i + 2)));
    g_.plants.push_back(std::move(plant));
    return g_;
  }

 private:
  bool one(std::uint64_t in) { return rng_.below(in) == 0; }
  std::string pick(std::string_view letters) { return std::string(1, letters[rng_.below(letters.size())]); }
  std::string name() { return pick("abxyzABn") + (one(3) ? pick("_019z") : ""); }

  ExprId expression(int depth) {
    if (depth == 0 || one(3)) return one(2) ? g_.add(Name{name()}) : g_.add(Number{number()});
    switch (rng_.below(6)) {
      case 0: return g_.add(Unary{one(2) ? UnaryOp::Minus : UnaryOp::Not, expression(depth - 1)});
      case 1: {
        const ExprId condition = expression(depth - 1);
        const ExprId yes = expression(depth - 1);
        return g_.add(Conditional{condition, yes, expression(depth - 1)});
      }
      case 2: return g_.add(Call{"atan2", {expression(depth - 1), expression(depth - 1)}});
      case 3: return g_.add(Element{name(), {expression(depth - 1)}});
      default: {
        const ExprId left = expression(depth - 1);
        return g_.add(Binary{static_cast<BinaryOp>(rng_.below(14)), left, expression(depth - 1)});
      }
    }
  }
  double number() { return one(4) ? rng_.uniform(0, 1e-9) : one(3) ? rng_.uniform(0, 1e30) : static_cast<double>(rng_.below(1000)) / 8; }

  std::vector<Module> formal(bool brackets) {
    std::vector<Module> result;
    do {
      Module m{pick(brackets ? "AB+-/\\#^&!,;.%?${}[]=|\"" : "AB+-/\\#^&!,;.%?${}|\""), {}, {}};
      while (one(3)) m.arguments.push_back(g_.add(Name{name()}));
      result.push_back(std::move(m));
    } while (one(2));
    return result;
  }
  std::vector<Module> string() {
    std::vector<Module> result;
    while (!one(4)) {
      Module m{pick("AB+-/\\#^&!,;.%?${}[]=|\"'@~_9"), {}, {}};
      while (one(3)) m.arguments.push_back(expression(3));
      result.push_back(std::move(m));
    }
    return result;
  }
  Block block(int depth) {
    Block result;
    do {
      switch (depth == 0 ? rng_.below(3) : rng_.below(6)) {
        case 0: result.push_back({Assign{name(), expression(3)}, {}}); break;
        case 1: result.push_back({AssignElement{name(), {expression(1), expression(1)}, expression(2)}, {}}); break;
        case 2: result.push_back({Evaluate{g_.add(Call{"printf", {g_.add(Text{"a \"b\"\n\\"}), expression(1)}})}, {}}); break;
        case 3: result.push_back({If{expression(2), block(depth - 1), one(2) ? block(depth - 1) : Block{}}, {}}); break;
        default: result.push_back({While{expression(2), block(depth - 1), one(2)}, {}});
      }
    } while (one(2));
    return result;
  }
  Production production() {
    Production p;
    if (one(3)) p.left = formal(true);
    p.predecessor = formal(true);
    if (one(3)) p.right = formal(true);
    if (one(3)) p.before = block(2);
    if (one(2)) p.condition = expression(4);
    if (one(3)) p.after = block(2);
    Successor s{string(), {}};
    if (one(4)) s.weight = expression(2);
    p.successors.push_back(std::move(s));
    if (one(4)) p.comments.before = {"// before", "/* two\nlines */"};
    if (one(4)) p.comments.trailing = "// behind";
    return p;
  }
  RuleSet rules(const std::string& label) {
    RuleSet r;
    r.label = label;
    do r.axiom = string();
    while (r.axiom.empty());
    for (int i = 0; i < 3; ++i) r.productions.push_back(production());
    if (one(2)) r.decomposition = sub();
    if (one(2)) r.homomorphism = sub();
    if (one(3)) r.interaction.push_back(production());
    if (one(3)) r.filter = {one(2) ? ContextFilter::Mode::Ignore : ContextFilter::Mode::Consider, {"+", "/", "/", "\\"}};
    r.ring = one(3);
    if (one(3)) r.seed = rng_.below(1000);
    if (label == "1" || one(2)) r.derivationLength = expression(2);
    if (one(3)) r.arrays.push_back({"arr", {2, 3}, {expression(2), expression(1), expression(1), expression(1), expression(1), expression(1)}});
    if (one(3)) r.externals = {"x", "y"};
    if (one(3)) r.start = block(3);
    if (one(3)) r.end = block(1);
    return r;
  }
  SubRules sub() {
    SubRules s;
    s.maximumDepth = static_cast<int>(rng_.below(5));
    if (one(2)) s.seed = 5;
    s.warnAtMaximumDepth = one(2);
    s.productions.push_back(production());
    return s;
  }

  Rng rng_;
  Grammar g_;
};

TEST(LSystemLanguage, AnyGrammarIsPrintedSoThatItReadsBack) {
  for (std::uint64_t seed = 1; seed <= 300 && !HasFailure(); ++seed) expectRoundTrip(Chance(seed).grammar(), "seed " + std::to_string(seed));
}

TEST(LSystemLanguage, ALabelEndsBeforeCarriageReturns) {
  const Parsed parsed = parseLSystem("Lsystem: one\r\r\r\nAxiom: A\nA --> B\nendlsystem\n");
  ASSERT_TRUE(parsed.ok());
  EXPECT_EQ(parsed.grammar.name, "one");
  EXPECT_EQ(parseLSystem(print(parsed.grammar)).grammar, parsed.grammar);
}

}  // namespace
}  // namespace axil::simeco
