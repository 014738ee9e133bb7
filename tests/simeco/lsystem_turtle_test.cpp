// The turtle: every shared case against the geometry that the reference program wrote, and what those cases do not reach.

#include "simeco/lsystem_turtle.hpp"

#include "base/files.hpp"
#include "simeco/lsystem_derive.hpp"
#include "simeco/lsystem_language.hpp"
#include "simeco/lsystem_text.hpp"
#include "support/shared_data.hpp"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>

namespace axil::simeco {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Keeps everything.
struct Drawing : TurtleSink {
  std::vector<TurtleSegment> segments;
  std::vector<TurtlePolygon> polygons;
  std::vector<TurtleSphere> spheres;
  std::vector<TurtleDisc> discs;
  std::vector<TurtleSurface> surfaces;
  TurtleReport report;
  void segment(const TurtleSegment& s) override { segments.push_back(s); }
  void polygon(const TurtlePolygon& p) override { polygons.push_back(p); }
  void sphere(const TurtleSphere& s) override { spheres.push_back(s); }
  void disc(const TurtleDisc& d) override { discs.push_back(d); }
  void surface(const TurtleSurface& s) override { surfaces.push_back(s); }
};

Result<Drawing> drawingOf(const Grammar& grammar, const LSystemView& view) {
  auto derived = deriveLSystem(grammar, {.derive = {}, .view = view});
  if (!derived) return derived.failure();
  auto image = imageOf(*derived);
  if (!image) return image.failure();
  Drawing drawing;
  auto report = interpret(image->string, view, drawing);
  if (!report) return report.failure();
  drawing.report = *report;
  return drawing;
}

Result<Drawing> drawn(const std::string& axiom, const LSystemView& view = {}) {
  const Parsed parsed = parseLSystem("Lsystem: 1\nAxiom: " + axiom + "\nendlsystem\n");
  EXPECT_TRUE(parsed.ok()) << axiom;
  return drawingOf(parsed.grammar, view);
}

LSystemView viewOf(const std::string& text) {
  const ParsedView parsed = parseLSystemView(text);
  EXPECT_TRUE(parsed.diagnostics.empty()) << parsed.diagnostics.front().message;
  return parsed.view;
}

void expectNear(const glm::dvec3& ours, const json& theirs, double tolerance, const std::string& what) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(ours[i], theirs[static_cast<std::size_t>(i)].get<double>(), tolerance) << what << " [" << i << "]";
}

void expectDrawing(const Drawing& ours, const json& theirs, const std::string& name) {
  const double tolerance = theirs["tolerance"].get<double>();
  const json none = json::array();
  const json& segments = theirs["segments"];
  ASSERT_EQ(ours.segments.size(), segments.size()) << name;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const std::string what = name + " segment " + std::to_string(i);
    expectNear(ours.segments[i].start, segments[i]["start"], tolerance, what);
    expectNear(ours.segments[i].end, segments[i]["end"], tolerance, what);
    EXPECT_NEAR(ours.segments[i].startWidth, segments[i]["width_start"].get<double>(), tolerance) << what;
    EXPECT_NEAR(ours.segments[i].endWidth, segments[i]["width_end"].get<double>(), tolerance) << what;
  }
  const json& polygons = theirs.contains("polygons") ? theirs["polygons"] : none;
  ASSERT_EQ(ours.polygons.size(), polygons.size()) << name;
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    ASSERT_EQ(ours.polygons[i].vertices.size(), polygons[i].size()) << name;
    for (std::size_t j = 0; j < polygons[i].size(); ++j) expectNear(ours.polygons[i].vertices[j], polygons[i][j], tolerance, name + " polygon");
  }
  const json& spheres = theirs.contains("spheres") ? theirs["spheres"] : none;
  ASSERT_EQ(ours.spheres.size(), spheres.size()) << name;
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    expectNear(ours.spheres[i].centre, spheres[i]["center"], tolerance, name + " sphere");
    EXPECT_NEAR(ours.spheres[i].diameter, spheres[i]["diameter"].get<double>(), tolerance) << name;
  }
  const json& discs = theirs.contains("discs") ? theirs["discs"] : none;
  ASSERT_EQ(ours.discs.size(), discs.size()) << name;
  for (std::size_t i = 0; i < discs.size(); ++i) {
    expectNear(ours.discs[i].centre, discs[i]["center"], tolerance, name + " disc");
    expectNear(ours.discs[i].normal, discs[i]["normal"], tolerance, name + " disc");
    EXPECT_NEAR(ours.discs[i].diameter, discs[i]["diameter"].get<double>(), tolerance) << name;
  }
}

TEST(LSystemTurtle, EverySharedCaseDrawsWhatTheReferenceDraws) {
  AXIL_SKIP_WITHOUT_SHARED("data/lsystems/turtle");
  int cases = 0;
  for (const auto& entry : fs::directory_iterator(test::sharedPath("data/lsystems/turtle"))) {
    if (entry.path().extension() != ".l") continue;
    const std::string name = entry.path().stem().string();
    const json facts = json::parse(readFile(fs::path(entry.path()).replace_extension(".json")).value());
    const auto view = viewBeside(entry.path());
    ASSERT_TRUE(view) << name;
    const Grammar grammar = parseLSystem(readFile(entry.path()).value()).grammar;
    const auto derived = deriveLSystem(grammar, {.derive = {}, .view = *view});
    ASSERT_TRUE(derived) << name;
    EXPECT_EQ(toLSystemText(derived->string), facts["string"].get<std::string>()) << name;
    const auto drawing = drawingOf(grammar, *view);
    ASSERT_TRUE(drawing) << name << ": " << drawing.error().message;
    expectDrawing(*drawing, facts, name);
    ++cases;
  }
  EXPECT_GE(cases, 25);
}

TEST(LSystemTurtle, QuarterTurnsAreExact) {
  std::string circles;
  for (int i = 0; i < 1000; ++i) circles += "+(90)F&(90)F/(90)F";
  const auto drawing = drawn(circles);
  ASSERT_TRUE(drawing);
  for (const TurtleSegment& s : drawing->segments)
    for (int i = 0; i < 3; ++i) ASSERT_EQ(s.end[i], std::round(s.end[i]));
}

TEST(LSystemTurtle, ASegmentKnowsWhatItStandsOnAndWhoMadeIt) {
  const auto drawing = drawn("F[+FF][fF]F");
  ASSERT_TRUE(drawing);
  const auto& s = drawing->segments;
  ASSERT_EQ(s.size(), 5u);
  EXPECT_FALSE(s[0].parent);
  EXPECT_EQ(s[1].parent, 0u);
  EXPECT_TRUE(s[1].branch);
  EXPECT_EQ(s[2].parent, 1u);
  EXPECT_FALSE(s[2].branch);
  EXPECT_FALSE(s[3].parent) << "it does not start where another ends";
  EXPECT_EQ(s[4].parent, 0u);
  EXPECT_FALSE(s[4].branch);
  EXPECT_EQ(s[4].module, 10u);
}

TEST(LSystemTurtle, WhatStandsBehindACutIsLeftOutOnRequest) {
  EXPECT_EQ(drawn("F%F[F]")->segments.size(), 3u);
  EXPECT_EQ(drawn("F[F%F[F]F]F", viewOf("interpretation past %: off"))->segments.size(), 3u);
}

TEST(LSystemTurtle, BracketsThatDoNotPairAreToldAndPassedOver) {
  const auto drawing = drawn("F]F}[{F");
  ASSERT_TRUE(drawing);
  EXPECT_EQ(drawing->segments.size(), 3u);
  EXPECT_EQ(drawing->report.warnings.size(), 3u);
}

TEST(LSystemTurtle, PlacesThatAreNoNumbersAreRefused) {
  for (const char* axiom : {"F(log(0))", "+(sqrt(-1))F", "!(log(0))F", "@D(sqrt(-1))", "@M(0,log(0))", "@R(1,log(0))F", "F(1.0e300*1.0e300)", "@O(log(0))", "?(1,log(0))F"}) {
    const auto drawing = drawn(axiom);
    ASSERT_FALSE(drawing) << axiom;
    EXPECT_EQ(drawing.error().code, ErrorCode::NoAnswer) << axiom;
  }
}

TEST(LSystemTurtle, HalfATurnOfTheHeadingKeepsTheFrameSquare) {
  const auto drawing = drawn("@R(0,-1,0)F+(90)F");
  ASSERT_TRUE(drawing);
  const TurtleFrame& f = drawing->segments[1].frame;
  EXPECT_NEAR(glm::dot(f.heading, f.left), 0, 1e-12);
  EXPECT_NEAR(glm::length(glm::cross(f.left, f.heading) - f.up), 0, 1e-12);
  EXPECT_NEAR(drawing->segments[0].end.y, -1, 1e-12);
}

TEST(LSystemTurtle, ACylinderInBracesFollowsItsPoints) {
  const auto hermite = drawn("{(1)f(1)f(1)}");
  ASSERT_TRUE(hermite);
  ASSERT_EQ(hermite->segments.size(), 8u);
  EXPECT_NEAR(hermite->segments.back().end.y, 2, 1e-12);
  const auto spline = drawn("{(3).(2)+(90)f(1)-(90)f(1)}");
  ASSERT_TRUE(spline);
  EXPECT_NEAR(spline->segments.front().start.x, 0, 1e-12);
  EXPECT_NEAR(spline->segments.back().end.x, -1, 1e-12);
  EXPECT_NEAR(spline->segments.back().end.y, 1, 1e-12);
}

TEST(LSystemTurtle, APatchPassesThroughItsCorners) {
  std::string axiom = "@PS(1)";
  for (int r = 1; r <= 4; ++r)
    for (int c = 1; c <= 4; ++c) axiom += "@M(" + std::to_string(c) + "," + std::to_string(r) + ",0)@PC(1," + std::to_string(r) + "," + std::to_string(c) + ")";
  const auto drawing = drawn(axiom + "@PD(1,2,3)");
  ASSERT_TRUE(drawing);
  ASSERT_EQ(drawing->polygons.size(), 6u);
  EXPECT_NEAR(glm::length(drawing->polygons.front().vertices[0] - glm::dvec3(1, 1, 0)), 0, 1e-12);
  EXPECT_NEAR(glm::length(drawing->polygons.back().vertices[2] - glm::dvec3(4, 4, 0)), 0, 1e-12);
}

TEST(LSystemTurtle, ASurfaceIsNamedByItsLetter) {
  const auto drawing = drawn("@D(2)F~l(3)~k~s(1,2,3)");
  ASSERT_TRUE(drawing);
  ASSERT_EQ(drawing->surfaces.size(), 3u);
  EXPECT_EQ(drawing->surfaces[0].name, 'l');
  EXPECT_EQ(drawing->surfaces[0].size, glm::dvec3(6, 6, 6));
  EXPECT_EQ(drawing->surfaces[1].size, glm::dvec3(2, 2, 2));
  EXPECT_EQ(drawing->surfaces[2].size, glm::dvec3(2, 4, 6));
  EXPECT_EQ(drawing->surfaces[2].frame.position, glm::dvec3(0, 2, 0));
}

TEST(LSystemTurtle, ATropismDrawsTheHeadingToItsAngleAndStaysThere) {
  std::string steps = "+(80)";
  for (int i = 0; i < 200; ++i) steps += "F";
  const auto drawing = drawn(steps, viewOf("tropism: T: 0 1 0 A: 30 E: 0.5"));
  ASSERT_TRUE(drawing);
  EXPECT_NEAR(drawing->segments.back().frame.heading.y, std::cos(Angle::fromDegrees(30).radians()), 1e-6);
}

TEST(LSystemTurtle, TheLogSaysWhatIsDrawn) {
  const Parsed parsed = parseLSystem("Lsystem: 1\nAxiom: F@O(2){.+.}\nendlsystem\n");
  const auto derived = deriveLSystem(parsed.grammar);
  ASSERT_TRUE(derived);
  TurtleLog log;
  ASSERT_TRUE(interpret(derived->string, {}, log));
  EXPECT_EQ(log.text(),
            "segment  0.000000 0.000000 0.000000  0.000000 1.000000 0.000000  width 1.000000 1.000000\n"
            "sphere  0.000000 1.000000 0.000000  diameter 2.000000\n"
            "polygon  0.000000 1.000000 0.000000  0.000000 1.000000 0.000000\n");
}

TEST(LSystemView, MistakesAreShownWithTheirLines) {
  const std::string text = "angle increment: x\nline style: polygon /* not\nused */\n// nothing\ntropism: E: 0.2\nangle incremnt: 3\nangle factor: 0\njust words\ntapered lines: maybe\n";
  const ParsedView parsed = parseLSystemView(text);
  std::vector<int> lines;
  for (const Diagnostic& d : parsed.diagnostics) lines.push_back(placeOf(text, d.span.begin).line);
  EXPECT_EQ(lines, (std::vector<int>{1, 5, 6, 7, 8, 9}));
  EXPECT_EQ(parsed.diagnostics[2].severity, Severity::Warning);
  EXPECT_EQ(parsed.diagnostics[2].hint, "did you mean 'angle increment'?");
}

TEST(LSystemView, AFileWithMistakesIsRefused) {
  const fs::path path = fs::path(testing::TempDir()) / "axil_lsystem_view_test.v";
  ASSERT_TRUE(writeFile(path, "initial scale: -1\n"));
  const auto view = readLSystemView(path);
  ASSERT_FALSE(view);
  EXPECT_EQ(view.error().details.size(), 1u);
  fs::remove(path);
}

}  // namespace
}  // namespace axil::simeco
