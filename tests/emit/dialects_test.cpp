#include "emit/dialects.hpp"

#include "base/text.hpp"
#include "grown.hpp"
#include "simeco/derive.hpp"
#include "simeco/lsystem_language.hpp"

#include <cmath>
#include <map>
#include <sstream>
#include <string>

namespace axil::emit {
namespace {

using skeleton3d::Skeleton;

// ---- a small turtle, written from the dialects' own documentation, not from emit ----------------------------------------

/// Heading, left and up as a program starts with, and whether its up is left x heading (cpfg) or heading x left (L-Py).
struct TurtleState {
  glm::dvec3 at{0, 0, 0};
  glm::dvec3 heading{0, 1, 0};
  glm::dvec3 left{-1, 0, 0};
  glm::dvec3 up{0, 0, -1};
};

glm::dvec3 rotatedAbout(const glm::dvec3& v, const glm::dvec3& axis, double degrees) {
  const double a = degrees * std::acos(-1.0) / 180;
  return v * std::cos(a) + glm::cross(axis, v) * std::sin(a) + axis * (glm::dot(axis, v) * (1 - std::cos(a)));
}

struct Drawn {
  std::vector<glm::dvec3> tips;  ///< end of every F
  struct Polygon {
    std::vector<glm::dvec3> corners;
  };
  std::vector<Polygon> polygons;
};

/// `letter(numbers)` or a bare letter.
struct Token {
  std::string letter;
  std::vector<double> numbers;
};

std::vector<Token> tokensOf(const std::string& text) {
  std::vector<Token> tokens;
  for (std::size_t i = 0; i < text.size();) {
    if (text[i] == ' ') { ++i; continue; }
    Token token{std::string(1, text[i++]), {}};
    if (token.letter == "@") token.letter += text[i++];
    if (i < text.size() && text[i] == '(') {
      const std::size_t close = text.find(')', i);
      std::stringstream inside(text.substr(i + 1, close - i - 1));
      for (std::string number; std::getline(inside, number, ',');) token.numbers.push_back(std::stod(number));
      i = close + 1;
    }
    tokens.push_back(token);
  }
  return tokens;
}

/// Expands A(k) by `rules` in place and lets a turtle read the result. Depth is on a stack, since chains may be long.
Drawn drawn(const std::string& axiom, const std::map<int, std::string>& rules, TurtleState turtle) {
  Drawn result;
  std::vector<TurtleState> saved;
  bool inPolygon = false;
  std::map<int, std::vector<Token>> parsed;
  for (const auto& [k, text] : rules) parsed[k] = tokensOf(text);
  const std::vector<Token> start = tokensOf(axiom);
  std::vector<std::pair<const std::vector<Token>*, std::size_t>> reading{{&start, 0}};
  while (!reading.empty()) {
    auto& [tokens, next] = reading.back();
    if (next == tokens->size()) { reading.pop_back(); continue; }
    const Token& t = (*tokens)[next++];
    const double x = t.numbers.empty() ? 0 : t.numbers[0];
    const auto turn = [&](const glm::dvec3& axis, double degrees) {
      for (glm::dvec3* v : {&turtle.heading, &turtle.left, &turtle.up}) *v = rotatedAbout(*v, axis, degrees);
    };
    const auto turnToward = [&](glm::dvec3& from, glm::dvec3& to, double degrees) {
      const double a = degrees * std::acos(-1.0) / 180;
      const glm::dvec3 f = from * std::cos(a) + to * std::sin(a);
      to = to * std::cos(a) - from * std::sin(a);
      from = f;
    };
    if (t.letter == "F" || t.letter == "f") {
      turtle.at += turtle.heading * x;
      if (inPolygon) result.polygons.back().corners.push_back(turtle.at);
      else result.tips.push_back(turtle.at);
    } else if (t.letter == "+") turnToward(turtle.heading, turtle.left, x);
    else if (t.letter == "-") turnToward(turtle.heading, turtle.left, -x);
    else if (t.letter == "&") turn(turtle.left, x);   // both: rotation about left
    else if (t.letter == "^") turn(turtle.left, -x);
    else if (t.letter == "/") turn(turtle.heading, -x);
    else if (t.letter == "\\") turn(turtle.heading, x);
    else if (t.letter == "[") saved.push_back(turtle);
    else if (t.letter == "]") { turtle = saved.back(); saved.pop_back(); }
    else if (t.letter == "{") { inPolygon = true; result.polygons.push_back({{turtle.at}}); }
    else if (t.letter == "}") inPolygon = false;
    else if (t.letter == "@M") turtle.at = {t.numbers.at(0), t.numbers.at(1), t.numbers.at(2)};
    else if (t.letter == "A") reading.push_back({&parsed.at(static_cast<int>(x)), 0});
    else if (t.letter != "!" && t.letter != "_" && t.letter != ";" && t.letter != ",") throw std::runtime_error("unknown letter " + t.letter);
  }
  return result;
}

std::string lineAfter(const std::string& text, const std::string& start) {
  const std::size_t at = text.find("\n" + start) + 1 + start.size();
  return text.substr(at, text.find('\n', at) - at);
}

Drawn drawnCpfg(const std::string& text) {
  std::map<int, std::string> rules;
  std::stringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("A(k) : k == ")) rules[std::stoi(line.substr(12))] = line.substr(line.find("--> ") + 4);
  return drawn(lineAfter(text, "Axiom: "), rules, {});
}

Drawn drawnLpy(const std::string& text) {
  std::map<int, std::string> rules;
  std::stringstream lines(text);
  int k = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("  if k == ")) k = std::stoi(line.substr(10));
    if (line.starts_with("    produce ")) rules[k] = line.substr(12);
  }
  Drawn result = drawn(lineAfter(text, "Axiom: "), rules, {{0, 0, 0}, {0, 0, 1}, {0, -1, 0}, {1, 0, 0}});
  // Back to the plant's axes.
  const auto back = [](glm::dvec3& v) { v = {v.y, v.z, v.x}; };
  for (glm::dvec3& v : result.tips) back(v);
  for (auto& polygon : result.polygons)
    for (glm::dvec3& v : polygon.corners) back(v);
  return result;
}

double farthestFrom(const std::vector<glm::dvec3>& wanted, const std::vector<glm::dvec3>& there) {
  double worst = 0;
  for (const glm::dvec3& w : wanted) {
    double nearest = 1e9;
    for (const glm::dvec3& t : there) nearest = std::min(nearest, glm::distance(w, t));
    worst = std::max(worst, nearest);
  }
  return worst;
}

void expectSameGeometry(const Skeleton& skeleton, const Drawn& drawing) {
  const auto m = valueOf(quantify::measure(skeleton));
  const simeco::Plant plant = grownUp(valueOf(initialGrammar(m)));
  const double tolerance = 1e-5 * test::heightOf(skeleton);
  std::vector<glm::dvec3> tips;
  for (const simeco::Organ* organ : segmentOrgans(plant, m.segments.size())) tips.push_back(organ->tip().at);
  EXPECT_LT(farthestFrom(tips, drawing.tips), tolerance);
  ASSERT_EQ(drawing.polygons.size(), skeleton.leaves.size());
  for (const simeco::Organ& organ : plant.organs) {
    if (organ.kind != simeco::OrganKind::Leaf) continue;
    double best = 1e9;
    for (const auto& polygon : drawing.polygons) {
      const glm::dvec3 normal = glm::normalize(glm::cross(polygon.corners[1] - polygon.corners[0], polygon.corners[2] - polygon.corners[1]));
      const double across = 1 - std::abs(glm::dot(normal, organ.adaxial.unit()));
      best = std::min(best, glm::distance(polygon.corners[0], organ.base.at) + glm::distance(polygon.corners[2], organ.tip().at) + across);
    }
    EXPECT_LT(best, 3 * tolerance);
  }
}

TEST(Dialects, TurtleProgramsDrawWhatSimecoGrows) {
  const std::uint64_t seed = 71;
  std::cout << "seed " << seed << "\n";
  Rng rng(seed);
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE(i);
    const Skeleton plant = test::randomTree(rng, {.segments = 25, .collarBranches = i % 3});
    const auto m = valueOf(quantify::measure(plant));
    expectSameGeometry(plant, drawnCpfg(valueOf(inDialect(m, Dialect::Cpfg))));
    expectSameGeometry(plant, drawnLpy(valueOf(inDialect(m, Dialect::LPy))));
  }
}

TEST(Dialects, TurtleProgramsTurnStraightAndReversedSegmentsLikeSimeco) {
  const std::vector<glm::dvec3> points{{0, 0, 0}, {0, 0.5, 0}, {0, 1, 0}, {0, 0.4, 0}, {0.3, 0.4, 0}};
  Skeleton plant = test::chainThrough(points);
  const std::vector<glm::dvec3> back{{0, 0.2, 0}, {0.1, 0.2, 0}};
  test::addStem(plant, skeleton3d::StemId{1}, skeleton3d::NodeId{2}, back);
  const auto m = valueOf(quantify::measure(plant));
  expectSameGeometry(plant, drawnCpfg(valueOf(inDialect(m, Dialect::Cpfg))));
  expectSameGeometry(plant, drawnLpy(valueOf(inDialect(m, Dialect::LPy))));
}

TEST(Dialects, CpfgTextIsReadByTheClassicLanguagesOwnParser) {
  Rng rng(72);
  const auto m = valueOf(quantify::measure(test::randomTree(rng)));
  const std::string text = valueOf(inDialect(m, Dialect::Cpfg));
  const simeco::Parsed parsed = simeco::parseLSystem(text);
  std::string complaints;
  for (const Diagnostic& d : parsed.diagnostics) complaints += formatDiagnostic(d, text, "plant.l") + "\n";
  for (const Diagnostic& d : simeco::checkLSystem(parsed.grammar)) complaints += formatDiagnostic(d, text, "plant.l") + "\n";
  ASSERT_EQ(complaints, "");
  // Its own derivation length is enough: every apex has become its segment.
  const auto derived = valueOf(simeco::derive(parsed.grammar));
  std::size_t segments = 0;
  for (const simeco::ModuleView module : derived.string) {
    EXPECT_NE(module.letter, "A");
    segments += module.letter == "F";
  }
  EXPECT_GE(segments, m.segments.size());
}

TEST(Dialects, MtgRowsStandInTheColumnOfTheirOrderAndHoldTheNodes) {
  Rng rng(73);
  const Skeleton plant = test::randomTree(rng, {.segments = 40, .collarBranches = 1});
  const auto m = valueOf(quantify::measure(plant));
  const std::string text = valueOf(inDialect(m, Dialect::Mtg));
  std::stringstream lines(text.substr(text.find("ENTITY-CODE")));
  std::string line;
  std::getline(lines, line);
  const auto columnsOf = [](const std::string& row) { return std::count(row.begin(), row.end(), '\t'); };
  const auto columns = columnsOf(line);
  const std::size_t topology = line.find_first_not_of('\t', 11) - 11;

  // Reads the topology as the format defines it: a row without ^ hangs on the last row one column to the left.
  std::vector<std::string> last(topology + 1);
  std::map<std::string, std::string> parentOf;
  std::map<std::string, glm::dvec3> at;
  std::size_t segments = 0;
  std::size_t leaves = 0;
  while (std::getline(lines, line)) {
    EXPECT_EQ(columnsOf(line), columns) << line;
    const std::size_t column = line.find_first_not_of('\t');
    const std::size_t end = line.find('\t', column);
    std::string code = line.substr(column, end - column);
    std::stringstream values(line.substr(line.find_first_not_of('\t', end)));
    glm::dvec3 place;
    values >> place.x >> place.y >> place.z;
    const bool sameColumn = code.starts_with("^");
    if (sameColumn) code.erase(0, 1);
    const std::string name = code.substr(1);
    if (code[0] != '/' || name != "P1") parentOf[name] = sameColumn ? last[column] : last[column - 1];
    at[name] = place;
    last[column] = name;
    segments += name[0] == 'S';
    leaves += name[0] == 'L';
  }
  EXPECT_EQ(segments, m.segments.size());
  EXPECT_EQ(leaves, plant.leaves.size());
  for (std::size_t s = 0; s < m.segments.size(); ++s) {
    const std::string name = "S" + std::to_string(s + 1);
    const std::string parent = m.segments[s].parent ? "S" + std::to_string(m.segments[s].parent->value + 1) : s == 0 ? "P1" : "S1";
    EXPECT_EQ(parentOf.at(name), parent);
    const glm::dvec3 from = m.segments[s].parent ? at.at(parent) : at.at("P1");
    EXPECT_LT(glm::distance(at.at(name), from + m.segments[s].direction.unit() * m.segments[s].length), 1e-5 * test::heightOf(plant));
  }
}

TEST(Dialects, AreKnownByName) {
  EXPECT_EQ(dialectNamed("lpy"), Dialect::LPy);
  EXPECT_EQ(dialectNamed("LPY"), std::nullopt);
  Rng rng(74);
  const auto m = valueOf(quantify::measure(test::randomTree(rng)));
  EXPECT_EQ(valueOf(inDialect(m, Dialect::SimEco)), simeco::print(valueOf(initialGrammar(m))));
  EXPECT_FALSE(inDialect(m, Dialect::Cpfg, {.turning = TurningRule::Literal}));
}

}  // namespace
}  // namespace axil::emit
