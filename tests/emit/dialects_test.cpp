#include "emit/dialects.hpp"

#include "base/files.hpp"
#include "emit/predictive.hpp"
#include "emit/structured.hpp"
#include "grown.hpp"
#include "simeco/lsystem_language.hpp"
#include "simeco/lsystem_plant.hpp"
#include "simeco/lsystem_view.hpp"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>

namespace axil::emit {
namespace {

using skeleton3d::Skeleton;

/// What a program draws, or a grammar grows: pieces of stem, and blades from base to tip with their normals.
struct Drawing {
  struct Piece {
    glm::dvec3 from, to;
  };
  struct Blade {
    glm::dvec3 base, tip, normal;
  };
  std::vector<Piece> pieces;
  std::vector<Blade> blades;
};

Drawing drawingOf(const simeco::Plant& plant) {
  Drawing d;
  for (const simeco::Organ& organ : plant.organs) {
    if (organ.kind == simeco::OrganKind::Leaf) d.blades.push_back({organ.base.at, organ.tip().at, organ.adaxial.unit()});
    else d.pieces.push_back({organ.base.at, organ.tip().at});
  }
  return d;
}

void addPolygon(Drawing& d, const std::vector<glm::dvec3>& corners) {
  d.blades.push_back({corners.at(0), corners.at(2), glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[1]))});
}

std::string complaintsAbout(const simeco::Parsed& parsed, const std::string& text) {
  std::string all;
  for (const Diagnostic& d : parsed.diagnostics) all += formatDiagnostic(d, text, "plant.l") + "\n";
  for (const Diagnostic& d : simeco::checkLSystem(parsed.grammar)) all += formatDiagnostic(d, text, "plant.l") + "\n";
  return all;
}

/// By the classic language's own front end and turtle.
Drawing drawnByCpfg(const DialectText& text) {
  const simeco::Parsed parsed = simeco::parseLSystem(text.text);
  EXPECT_EQ(complaintsAbout(parsed, text.text), "");
  const simeco::ParsedView view = simeco::parseLSystemView(text.view);
  EXPECT_TRUE(view.diagnostics.empty());
  simeco::LSystemPlantOptions options;
  options.derive.view = view.view;
  const simeco::Plant plant = valueOf(simeco::plantOfLSystem(parsed.grammar, options));
  Drawing d;
  for (const simeco::Organ& organ : plant.organs) d.pieces.push_back({organ.base.at, organ.tip().at});
  for (const simeco::PlantFace& face : plant.faces) {
    std::vector<glm::dvec3> corners;
    for (const PlantPoint& corner : face.vertices) corners.push_back(corner.at);
    addPolygon(d, corners);
  }
  return d;
}

/// By tests/support/lpy_turtle.py, in the plant's axes.
std::vector<Drawing> drawnByLpy(const std::vector<std::string>& texts) {
  const auto folder = std::filesystem::temp_directory_path() / ("axil_lpy_" + std::to_string(::testing::UnitTest::GetInstance()->random_seed()) + "_" + std::to_string(texts.size()));
  std::filesystem::create_directories(folder);
  std::string command = std::string("'") + AXIL_PYTHON + "' '" + AXIL_LPY_TURTLE + "'";
  for (std::size_t i = 0; i < texts.size(); ++i) {
    const auto path = folder / (std::to_string(i) + ".lpy");
    if (!writeFile(path, texts[i])) throw std::runtime_error("cannot write " + path.string());
    command += " '" + path.string() + "'";
  }
  std::FILE* pipe = ::popen(command.c_str(), "r");
  std::string output;
  std::array<char, 65536> buffer{};
  for (std::size_t n = 0; (n = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) output.append(buffer.data(), n);
  const int status = ::pclose(pipe);
  std::filesystem::remove_all(folder);
  if (status != 0) throw std::runtime_error("the evaluator failed");
  std::vector<Drawing> drawings;
  std::stringstream lines(output);
  for (std::string line; std::getline(lines, line);) {
    std::stringstream words(line);
    std::string kind;
    words >> kind;
    if (kind == "file") {
      drawings.emplace_back();
      continue;
    }
    std::vector<glm::dvec3> points;
    for (glm::dvec3 p; words >> p.x >> p.y >> p.z;) points.emplace_back(p.y, p.z, p.x);
    if (kind == "F") drawings.back().pieces.push_back({points.at(0), points.at(1)});
    else addPolygon(drawings.back(), points);
  }
  return drawings;
}

double farthest(const Drawing& wanted, const Drawing& there) {
  double worst = 0;
  for (const auto& w : wanted.pieces) {
    double nearest = 1e9;
    for (const auto& t : there.pieces) nearest = std::min(nearest, glm::distance(w.from, t.from) + glm::distance(w.to, t.to));
    worst = std::max(worst, nearest);
  }
  for (const auto& w : wanted.blades) {
    double nearest = 1e9;
    for (const auto& t : there.blades)
      nearest = std::min(nearest, glm::distance(w.base, t.base) + glm::distance(w.tip, t.tip) + 0.01 * (1 - std::abs(glm::dot(w.normal, t.normal))));
    worst = std::max(worst, nearest);
  }
  return worst;
}

void expectSameDrawing(const Drawing& a, const Drawing& b, double height) {
  EXPECT_EQ(a.pieces.size(), b.pieces.size());
  EXPECT_EQ(a.blades.size(), b.blades.size());
  EXPECT_LT(farthest(a, b), 1e-5 * height);
  EXPECT_LT(farthest(b, a), 1e-5 * height);
}

TEST(Dialects, TurtleProgramsDrawWhatSimecoGrows) {
  const std::uint64_t seed = 71;
  std::cout << "seed " << seed << "\n";
  Rng rng(seed);
  std::vector<Drawing> grown;
  std::vector<double> heights;
  std::vector<std::string> programs;
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE(i);
    const Skeleton plant = test::randomTree(rng, {.segments = 25, .collarBranches = i % 3});
    const simeco::Grammar grammar = valueOf(initialGrammar(valueOf(quantify::measure(plant))));
    grown.push_back(drawingOf(grownUp(grammar)));
    heights.push_back(test::heightOf(plant));
    expectSameDrawing(grown.back(), drawnByCpfg(valueOf(inDialect(grammar, Dialect::Cpfg))), heights.back());
    programs.push_back(valueOf(inDialect(grammar, Dialect::LPy)).text);
  }
  const std::vector<Drawing> drawn = drawnByLpy(programs);
  ASSERT_EQ(drawn.size(), grown.size());
  for (std::size_t i = 0; i < grown.size(); ++i) expectSameDrawing(grown[i], drawn[i], heights[i]);
}

TEST(Dialects, TurtleProgramsTurnStraightAndReversedSegmentsLikeSimeco) {
  const std::vector<glm::dvec3> points{{0, 0, 0}, {0, 0.5, 0}, {0, 1, 0}, {0, 0.4, 0}, {0.3, 0.4, 0}};
  Skeleton plant = test::chainThrough(points);
  const std::vector<glm::dvec3> back{{0, 0.2, 0}, {0.1, 0.2, 0}};
  test::addStem(plant, skeleton3d::StemId{1}, skeleton3d::NodeId{2}, back);
  const simeco::Grammar grammar = valueOf(initialGrammar(valueOf(quantify::measure(plant))));
  const Drawing grown = drawingOf(grownUp(grammar));
  expectSameDrawing(grown, drawnByCpfg(valueOf(inDialect(grammar, Dialect::Cpfg))), 1);
  expectSameDrawing(grown, drawnByLpy({valueOf(inDialect(grammar, Dialect::LPy)).text}).at(0), 1);
}

simeco::Grammar parsed(const std::string& text) {
  const simeco::Parsed p = simeco::parseSimeco(text);
  if (!p.ok()) throw std::runtime_error(formatDiagnostic(p.diagnostics.front(), text, "grammar"));
  return p.grammar;
}

TEST(Dialects, RulesWithTablesConditionsAndArgumentsMeanTheSame) {
  const simeco::Grammar grammar = parsed(R"(EcoSystem 1.1 "tables" {
    Plant "p" {
        Direction = vector(0.2, 1, 0.1);
        Position = vector(0.1, 0, -0.2);
        Shrink = 0.8;
        Stem {
            Stage 1(length, radius) {
                GrowRate = length*2;
                GrowTime = 0.5;
                BroadenRate = radius/0.01;
            }
            Stage 2 {
                GrowRate = 0.02;
            }
        }
        Leaf {
            Stage 1(size) {
                GrowRate = size;
                BroadenRate = 20*size;
            }
        }
        Grow {
            array bend[4] = {0.1, -0.2, 0, 0.3};
            array around[4] = {0, 1, 2, -1};
            w = A(0, 0, 0.3);
            A(order, k, length) : order < 2 && k < 5 -> S(1, length, length/50) A(9, order, 2) [rotr(1.1)rotu(2.4*k)S(2)L(1, length/3)] rotr(bend[k%4])rotu(around[k%4])A(order, k+1, length*Shrink) ;
            A(9, order, left) : left > 0 -> [rotr(-0.6)rotu(left*3.1)A(order+1, left, 0.2)] A(9, order, left-1) ;
        }
    }
})");
  ASSERT_EQ(complaints(grammar), "");
  const Drawing grown = drawingOf(grownUp(grammar));
  ASSERT_GT(grown.pieces.size(), 40u);
  expectSameDrawing(grown, drawnByCpfg(valueOf(inDialect(grammar, Dialect::Cpfg))), 1);
  expectSameDrawing(grown, drawnByLpy({valueOf(inDialect(grammar, Dialect::LPy)).text}).at(0), 1);
}

TEST(Dialects, TheExactStructuredGrammarMeansTheSame) {
  const std::uint64_t seed = 76;
  std::cout << "seed " << seed << "\n";
  Rng rng(seed);
  std::vector<Drawing> grown;
  std::vector<double> heights;
  std::vector<std::string> programs;
  for (int i = 0; i < 8; ++i) {
    SCOPED_TRACE(i);
    const Skeleton plant = test::randomTree(rng, {.segments = 40, .leaves = 5 * i, .collarBranches = i % 3});
    const simeco::Grammar grammar = valueOf(structuredGrammar(valueOf(quantify::measure(plant)), {}, {.form = StructuredForm::Exact}));
    grown.push_back(drawingOf(grownUp(grammar)));
    heights.push_back(test::heightOf(plant));
    expectSameDrawing(grown.back(), drawnByCpfg(valueOf(inDialect(grammar, Dialect::Cpfg))), heights.back());
    programs.push_back(valueOf(inDialect(grammar, Dialect::LPy)).text);
    EXPECT_TRUE(inDialect(grammar, Dialect::Mtg));
  }
  const std::vector<Drawing> drawn = drawnByLpy(programs);
  ASSERT_EQ(drawn.size(), grown.size());
  for (std::size_t i = 0; i < grown.size(); ++i) expectSameDrawing(grown[i], drawn[i], heights[i]);
}

TEST(Dialects, AStochasticGrammarBecomesOneOfTheSameFamily) {
  const simeco::Grammar grammar = parsed(R"(EcoSystem 1.1 "chance" {
    Plant "p" {
        Stem {
            Stage 1 {
                GrowRate = normal(0.2, 0.02);
            }
        }
        Grow {
            w = A(0);
            A(n) : n < 200 -> 0.25: S(1) [rotr(normal(0.7, 0.1))rotu(random(0, 6))S(1)] rotr(0)rotu(0)A(n+1) | 0.75: S(1) A(n+1) ;
        }
    }
})");
  const auto branchesOf = [](const Drawing& d) { return static_cast<double>(d.pieces.size()) - 200; };
  for (const Drawing& d : {drawnByCpfg(valueOf(inDialect(grammar, Dialect::Cpfg))), drawnByLpy({valueOf(inDialect(grammar, Dialect::LPy)).text}).at(0)}) {
    EXPECT_NEAR(branchesOf(d), 50, 25);
    double length = 0;
    for (const auto& piece : d.pieces) length += glm::distance(piece.from, piece.to) / static_cast<double>(d.pieces.size());
    EXPECT_NEAR(length, 0.2, 0.008);
  }
}

TEST(Dialects, ThePredictiveProgramsHoldTheMeasuredPlant) {
  Rng rng(75);
  int further = 0;
  for (int i = 0; i < 5; ++i) {
    // No leaves: those that are still small go on growing, so in the end they are longer than measured.
    const Skeleton plant = test::randomTree(rng, {.segments = 15, .leaves = 0});
    const auto m = valueOf(quantify::measure(plant));
    const Drawing measured = drawingOf(grownUp(valueOf(initialGrammar(m))));
    const simeco::Grammar grammar = valueOf(predictiveGrammar(m));
    const std::size_t predicted = drawingOf(grownUp(grammar)).pieces.size();
    const Drawing cpfg = drawnByCpfg(valueOf(inDialect(grammar, Dialect::Cpfg)));
    const Drawing lpy = drawnByLpy({valueOf(inDialect(grammar, Dialect::LPy)).text}).at(0);
    for (const Drawing* d : {&cpfg, &lpy}) {
      EXPECT_LT(farthest(measured, *d), 1e-5 * test::heightOf(plant));
      // Which of the tips go on is chance, for each program its own; that they can is what the step count shows.
      EXPECT_GE(d->pieces.size(), measured.pieces.size());
      further += d->pieces.size() > measured.pieces.size() ? 1 : 0;
    }
    EXPECT_GE(predicted, measured.pieces.size());
  }
  EXPECT_GT(further, 4);
}

TEST(Dialects, SayWhatTheyCannotSay) {
  const auto refusal = [](const char* rules) {
    const auto result = inDialect(parsed(std::string("EcoSystem 1.1 \"g\" {\n Plant \"p\" {\n GravityTropism = 0.1;\n Stem {\n Stage 1 {\n GrowRate = 1;\n }\n }\n Grow {\n") + rules + "}\n}\n}\n"),
                                  Dialect::Cpfg);
    return result ? std::string{} : result.error().message;
  };
  EXPECT_NE(refusal("w = S(1);").find("GravityTropism"), std::string::npos);
  const simeco::Grammar split = parsed("EcoSystem 1.1 \"g\" {\n Plant \"p\" {\n Stem {\n Stage 1 {\n GrowRate = 1;\n }\n }\n Grow {\n w = S(1) [rotr(0.5)A(1)]; A(1) -> rotr(0.2)S(1) ; }\n}\n}\n");
  const auto result = inDialect(split, Dialect::LPy);
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().message.find("turn"), std::string::npos);
  EXPECT_TRUE(inDialect(split, Dialect::Mtg));
}

/// The table as the format defines it: a row without ^ hangs on the last row one column to the left.
struct MtgRow {
  std::string parent;
  std::map<std::string, double> values;
};
std::map<std::string, MtgRow> readMtg(const std::string& text) {
  std::stringstream lines(text.substr(text.find("ENTITY-CODE")));
  std::string line;
  std::getline(lines, line);
  const std::size_t columns = line.find_first_not_of('\t', 11) - 11;
  std::vector<std::string> names;
  std::stringstream header(line.substr(11));
  for (std::string name; header >> name;) names.push_back(name);
  std::vector<std::string> last(columns + 1);
  std::map<std::string, MtgRow> rows;
  while (std::getline(lines, line)) {
    std::vector<std::string> cells(1);
    for (const char c : line)
      if (c == '\t') cells.emplace_back();
      else cells.back() += c;
    EXPECT_EQ(cells.size(), columns + names.size()) << line;
    EXPECT_EQ(line.find('+', line.find_first_not_of("\t+")), std::string::npos) << line;
    const std::size_t column = line.find_first_not_of('\t');
    std::string code = cells[column];
    const bool same = code.starts_with("^");
    if (same) code.erase(0, 1);
    const std::string name = code.substr(1);
    MtgRow& row = rows[name];
    if (name != "P1") row.parent = same ? last[column] : last[column - 1];
    last[column] = name;
    for (std::size_t n = 0; n < names.size(); ++n)
      if (!cells[columns + n].empty()) row.values[names[n]] = std::stod(cells[columns + n]);
  }
  return rows;
}

TEST(Dialects, MtgRowsHangWhereTheOrgansGrowAndHoldTheirNodes) {
  Rng rng(73);
  const Skeleton plant = test::randomTree(rng, {.segments = 40, .collarBranches = 1});
  const auto m = valueOf(quantify::measure(plant));
  const auto rows = readMtg(valueOf(inDialect(valueOf(initialGrammar(m)), Dialect::Mtg)).text);
  const double tolerance = 1e-5 * test::heightOf(plant);
  const auto placeOf = [](const MtgRow& row) { return glm::dvec3{row.values.at("XX"), row.values.at("YY"), row.values.at("ZZ")}; };
  std::vector<glm::dvec3> tips;
  for (const auto& s : m.segments)
    tips.push_back((s.parent ? tips[static_cast<std::size_t>(s.parent->value)] : m.origin.at) + s.direction.unit() * s.length);
  std::size_t segments = 0;
  std::size_t leaves = 0;
  std::size_t atCollar = 0;
  for (const auto& [name, row] : rows) {
    leaves += name[0] == 'L';
    if (name[0] != 'S' || row.values.at("Length") < 1e-4) continue;
    const auto found = std::find_if(tips.begin(), tips.end(), [&](const glm::dvec3& tip) { return glm::distance(tip, placeOf(row)) < tolerance; });
    const bool petiole = found == tips.end();
    if (petiole) continue;
    ++segments;
    const auto& segment = m.segments[static_cast<std::size_t>(found - tips.begin())];
    const glm::dvec3 base = segment.parent ? tips[static_cast<std::size_t>(segment.parent->value)] : m.origin.at;
    EXPECT_NEAR(row.values.at("Length"), segment.length, tolerance);
    if (!segment.parent && segment.kind == quantify::SegmentKind::Branch) ++atCollar;
    else EXPECT_LT(glm::distance(placeOf(rows.at(row.parent)), base), tolerance);
  }
  EXPECT_EQ(segments, m.segments.size());
  EXPECT_EQ(leaves, plant.leaves.size());
  EXPECT_EQ(atCollar, 1u);
}

TEST(Dialects, AreKnownByName) {
  EXPECT_EQ(dialectNamed("lpy"), Dialect::LPy);
  EXPECT_EQ(dialectNamed("LPY"), std::nullopt);
  Rng rng(74);
  const simeco::Grammar grammar = valueOf(initialGrammar(valueOf(quantify::measure(test::randomTree(rng)))));
  EXPECT_EQ(valueOf(inDialect(grammar, Dialect::SimEco)).text, simeco::print(grammar));
}

}  // namespace
}  // namespace axil::emit
