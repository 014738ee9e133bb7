#include "base/rng.hpp"
#include "simeco/growth.hpp"
#include "simeco/growth_path.hpp"
#include "simeco/language.hpp"
#include "simeco/light_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace axil::simeco {
namespace {

/// A plant of 1.1 with stems 1, leaves 1, flowers 1, fruits 1.
struct PlantText {
  std::string attributes = {}, stem = "GrowRate = 1.0; GrowTime = 1.0;", leaf = "GrowRate = 0.3; GrowTime = 1.0;";
  std::string rules = "w = S(1);";
};
std::string plantBlock(const PlantText& text, const std::string& name) {
  return "Plant \"" + name + "\" { " + text.attributes + " Stem { Stage 1 { " + text.stem + " } } Leaf { Stage 1 { " + text.leaf +
         " } } Grow { " + text.rules + " } } ";
}
Grammar parsed(const std::string& text) {
  const Parsed result = parseSimeco(text);
  EXPECT_TRUE(result.ok()) << (result.diagnostics.empty() ? "" : result.diagnostics.front().message) << "\n" << text;
  for (const Diagnostic& finding : check(result.grammar)) EXPECT_NE(finding.message.find("never used"), std::string::npos) << finding.message << "\n" << text;
  return result.grammar;
}
Grammar grammarOf(const PlantText& text) { return parsed("EcoSystem 1.1 \"e\" { " + plantBlock(text, "p") + "}"); }

Growth grown(const Grammar& grammar, const GrowOptions& options = {}) {
  auto growth = prepareGrowth(grammar, options);
  if (!growth) throw std::runtime_error(growth.error().message);
  return *growth;
}
Plant at(const Growth& growth, double time) {
  auto plant = plantAt(growth, time);
  if (!plant) throw std::runtime_error(plant.error().message);
  return *plant;
}
Plant at(const PlantText& text, double time, const GrowOptions& options = {}) { return at(grown(grammarOf(text), options), time); }

GrowOptions in(Environment environment) {
  GrowOptions options;
  options.environment = std::move(environment);
  return options;
}

double arcLength(const Organ& organ) {
  double length = 0;
  for (std::size_t i = 1; i < organ.trail.size(); ++i) length += glm::distance(organ.trail[i - 1].at, organ.trail[i].at);
  return organ.trail.empty() ? glm::distance(organ.base.at, organ.tip().at) : length;
}

/// A branching plant whose organs overlap in time and draw their sizes.
PlantText bush(const std::string& attributes) {
  return {attributes, "GrowRate = random(0.6, 1.2); GrowTime = 1.7; BroadenRate = 0.4;", "GrowRate = 0.3; GrowTime = 1.5;",
          "w = A(0); A(i) : i < 6 -> S(1) [rotr(random(0.4, 1.1))rotu(random(-3, 3)) S(1) L(1)] rotr(normal(0, 0.2))rotu(2.4) A(i+1) ; A(i) -> L(1) ;"};
}

// ---- bending ---------------------------------------------------------------------------------------------------------

TEST(GrowthEnvironment, WithoutForceThePlantIsTheSameToTheLastBit) {
  const Growth plain = grown(grammarOf(bush("")));
  // Forces of strength 0, forces along the heading's own line, and an obstacle out of reach must not touch a single bit.
  const Growth idle = grown(grammarOf(bush("GravityTropism = 0.0; Tropism = vector(0, 0, 0); Elasticity = 3;")));
  GrowOptions far;
  far.environment.obstacles = {SphereObstacle{{{1e4, 0, 0}}, 1}, BoxObstacle{{{500, 0, 0}}, {{501, 1, 1}}}};
  const Growth besideFar = grown(grammarOf(bush("")), far);
  for (double time = 0; time < 10; time += 0.61) {
    EXPECT_EQ(at(plain, time), at(idle, time)) << time;
    EXPECT_EQ(at(plain, time), at(besideFar, time)) << time;
  }
  for (const Organ& organ : at(plain, 5).organs) EXPECT_TRUE(organ.trail.empty());
  const Plant upright = at({.attributes = "Tropism = vector(0, 2, 0);"}, 1);
  EXPECT_TRUE(upright.organs[0].trail.empty());
  EXPECT_EQ(upright.organs[0].tip().at, glm::dvec3(0, 1, 0));
}

TEST(GrowthEnvironment, GravityBendsDownWhatGrowsTowardsItAndUpWhatGrowsAwayFromIt) {
  const auto tipHeight = [](const std::string& attributes) { return at({.attributes = "Direction = vector(1, 0, 0); " + attributes}, 1).organs[0].tip().at.y; };
  EXPECT_EQ(tipHeight(""), 0);
  EXPECT_LT(tipHeight("GravityTropism = 0.8;"), -0.1);
  EXPECT_GT(tipHeight("GravityTropism = -0.8;"), 0.1);
  EXPECT_DOUBLE_EQ(tipHeight("GravityTropism = 0.8;"), -tipHeight("GravityTropism = -0.8;"));
  // The same pull said in other words; only the number of steps differs.
  EXPECT_NEAR(tipHeight("Tropism = vector(0, -0.4, 0); Elasticity = 2.0;"), tipHeight("GravityTropism = 0.8;"), 1e-3);
  EXPECT_NEAR(tipHeight("GravityTropism = 0.4; Gravity = vector(0, -2, 0);"), tipHeight("GravityTropism = 0.8;"), 1e-3);
}

TEST(GrowthEnvironment, TheHeadingFollowsTheExactSolution) {
  // tan(angle / 2) falls by exp(-pull) over a growth, whatever the steps: here from 90 degrees.
  const PlantText text{.attributes = "Direction = vector(1, 0, 0); GravityTropism = 0.7;", .rules = "w = S(1) S(1);"};
  const Plant plant = at(text, 1);
  const double angle = angleBetween(plant.organs[1].direction, PlantDirection::along({0, -1, 0})).radians();
  // The second organ starts with the frame at the tip of the first, and both grow at once.
  EXPECT_NEAR(std::tan(angle / 2), std::exp(-0.7), 1e-12);
  EXPECT_EQ(plant.organs[1].base, plant.organs[0].tip());
  EXPECT_NEAR(glm::dot(plant.organs[1].direction.unit(), plant.organs[1].rAxis.unit()), 0, 1e-12);
}

TEST(GrowthEnvironment, BendingKeepsLengths) {
  const Growth straight = grown(grammarOf(bush("")));
  const Growth bent = grown(grammarOf(bush("Tropism = vector(0.5, -1.3, 0.2); LightTropism = 0.4;")), in({.wind = glm::dvec3{0.4, 0, 0.3}}));
  std::size_t trails = 0;
  for (double time = 0.3; time < 10; time += 0.7) {
    const Plant a = at(straight, time), b = at(bent, time);
    ASSERT_EQ(a.organs.size(), b.organs.size());
    for (std::size_t i = 0; i < a.organs.size(); ++i) {
      EXPECT_EQ(a.organs[i].length, b.organs[i].length);
      EXPECT_NEAR(arcLength(b.organs[i]), b.organs[i].length, 1e-12);
      trails += b.organs[i].trail.empty() ? 0 : 1;
      EXPECT_TRUE(b.organs[i].kind == OrganKind::Stem || b.organs[i].trail.empty());
    }
  }
  EXPECT_GT(trails, 50u);
}

TEST(GrowthEnvironment, AnOrganThatGrowsOnKeepsTheTrailItHas) {
  // Once free, once against a wall that it has to slide along.
  const Obstacle wall = BoxObstacle{{{0.3, -5, -5}}, {{0.31, 5, 5}}};
  for (const std::vector<Obstacle>& obstacles : {std::vector<Obstacle>{}, std::vector<Obstacle>{wall}}) {
    const Growth growth = grown(grammarOf({.attributes = "Direction = vector(1, 0.3, 0); GravityTropism = -1.5; WindTropism = 40.0;", .stem = "GrowRate = 2.0; GrowTime = 1.0;"}),
                                in({.wind = glm::dvec3{0.8, 0, 0}, .obstacles = obstacles}));
    const std::vector<PlantPoint> full = at(growth, 1).organs[0].trail;
    ASSERT_GE(full.size(), 8u);
    for (double time = 0.02; time < 1; time += 0.013) {
      const std::vector<PlantPoint> young = at(growth, time).organs[0].trail;
      for (std::size_t i = 0; i + 1 < young.size(); ++i) EXPECT_EQ(young[i], full[i]) << time;
      if (young.empty()) continue;
      const glm::dvec3 tip = young.back().at, from = full[young.size() - 2].at, to = full[young.size() - 1].at;
      EXPECT_NEAR(glm::distance(from, tip) + glm::distance(tip, to), glm::distance(from, to), 1e-12) << "the tip is on the last piece at " << time;
    }
  }
}

TEST(GrowthEnvironment, LightAndWindPullWhatAnswersToThem) {
  const auto tip = [](const std::string& attributes, const Environment& environment) { return at({.attributes = attributes}, 1, in(environment)).organs[0].tip().at; };
  EXPECT_EQ(tip("", {.light = glm::dvec3{1, 0, 0}}).x, 0);
  EXPECT_GT(tip("LightTropism = 0.5;", {.light = glm::dvec3{3, 0, 0}}).x, 0.1);
  EXPECT_EQ(tip("LightTropism = 0.5;", {.light = glm::dvec3{3, 0, 0}}), tip("LightTropism = 0.5; Light = vector(1, 0, 0);", {}));
  EXPECT_GT(tip("", {.wind = glm::dvec3{0, 0, 0.5}}).z, 0.1);
  EXPECT_EQ(tip("WindTropism = 0.0;", {.wind = glm::dvec3{0, 0, 0.5}}).z, 0);
  EXPECT_EQ(tip("Wind = vector(0, 0, 9);", {.wind = glm::dvec3{0, 0, 0.5}}), tip("", {.wind = glm::dvec3{0, 0, 0.5}}));
}

// ---- obstacles -------------------------------------------------------------------------------------------------------

/// Whether two segments' crossing of the triangle a b c, straight from the definition.
bool crosses(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& from, const glm::dvec3& to) {
  const auto volume = [](const glm::dvec3& p, const glm::dvec3& q, const glm::dvec3& r, const glm::dvec3& s) { return glm::dot(glm::cross(q - p, r - p), s - p); };
  if (volume(a, b, c, from) * volume(a, b, c, to) > 0) return false;
  const double u = volume(from, to, a, b), v = volume(from, to, b, c), w = volume(from, to, c, a);
  return (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
}

MeshObstacle randomMesh(Rng& rng) {
  MeshObstacle mesh;
  const auto point = [&] { return PlantPoint{{rng.uniform(-3, 3), rng.uniform(0.4, 5), rng.uniform(-3, 3)}}; };
  for (std::uint32_t i = 0; i < 12; ++i) {
    for (int corner = 0; corner < 3; ++corner) mesh.points.push_back(point());
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return mesh;
}

std::vector<std::pair<glm::dvec3, glm::dvec3>> piecesOf(const Organ& organ) {
  std::vector<std::pair<glm::dvec3, glm::dvec3>> pieces;
  for (std::size_t i = 1; i < organ.trail.size(); ++i) pieces.emplace_back(organ.trail[i - 1].at, organ.trail[i].at);
  if (organ.trail.empty()) pieces.emplace_back(organ.base.at, organ.tip().at);
  return pieces;
}

TEST(GrowthEnvironment, NothingEverPassesThroughAnObstacle) {
  std::size_t met = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    Rng rng(seed);
    const MeshObstacle mesh = randomMesh(rng);
    const SphereObstacle sphere{{{rng.uniform(-1, 1), rng.uniform(1.2, 3), rng.uniform(-1, 1)}}, rng.uniform(0.2, 1)};
    const BoxObstacle box{{{-5, rng.uniform(3, 4), -5}}, {{5, 4.05, 5}}};
    GrowOptions options;
    options.seed = seed;
    options.environment.wind = glm::dvec3{rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)};
    const Growth free = grown(grammarOf(bush("GravityTropism = -0.3;")), options);
    options.environment.obstacles = {mesh, sphere, box};
    const auto prepared = prepareGrowth(grammarOf(bush("GravityTropism = -0.3;")), options);
    ASSERT_TRUE(prepared) << prepared.error().message;
    for (double time = 0.2; time < 10; time += 0.43) {
      const Plant plant = at(*prepared, time);
      met += plant == at(free, time) ? 0 : 1;
      for (const Organ& organ : plant.organs)
        for (const auto& [from, to] : piecesOf(organ)) {
          for (const auto& t : mesh.triangles)
            ASSERT_FALSE(crosses(mesh.points[t[0]].at, mesh.points[t[1]].at, mesh.points[t[2]].at, from, to)) << "seed " << seed << " time " << time;
          for (int i = 0; i <= 20; ++i) {
            const glm::dvec3 p = from + (to - from) * (i / 20.0);
            ASSERT_GT(glm::distance(p, sphere.centre.at), sphere.radius) << "seed " << seed << " time " << time;
            ASSERT_NE(glm::clamp(p, box.low.at, box.high.at), p) << "seed " << seed << " time " << time;
          }
        }
    }
  }
  EXPECT_GT(met, 300u);
}

TEST(GrowthEnvironment, AStemThatMeetsAWallGoesAroundItAndKeepsItsLength) {
  // A ceiling at 2.5; the stem of 5 must end beneath it, as long as it would have been.
  GrowOptions options;
  options.environment.obstacles = {BoxObstacle{{{-9, 2.5, -9}}, {{9, 3, 9}}}};
  const PlantText text{.stem = "GrowRate = 1.0; GrowTime = 5.0;"};
  const Organ stem = at(text, 5, options).organs[0];
  EXPECT_DOUBLE_EQ(stem.length, 5);
  EXPECT_NEAR(arcLength(stem), 5, 1e-12);
  EXPECT_LT(stem.tip().at.y, 2.5);
  EXPECT_GT(std::hypot(stem.tip().at.x, stem.tip().at.z), 1);
  // It follows the ceiling and is not thrown back from it.
  EXPECT_GT(stem.tip().at.y, 1.8);
}

TEST(GrowthEnvironment, AStemWithoutAWayOutEndsInsteadOfBreakingThrough) {
  GrowOptions options;
  MeshObstacle cage;
  const BoxObstacle walls{{{-0.2, -0.2, -0.2}}, {{0.2, 0.2, 0.2}}};
  for (int i = 0; i < 8; ++i) cage.points.push_back({{i & 1 ? 0.2 : -0.2, i & 2 ? 0.2 : -0.2, i & 4 ? 0.2 : -0.2}});
  cage.triangles = {{0, 2, 6}, {0, 6, 4}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4}, {2, 3, 7}, {2, 7, 6}, {0, 1, 3}, {0, 3, 2}, {4, 5, 7}, {4, 7, 6}};
  options.environment.obstacles = {cage};
  const Organ stem = at({.stem = "GrowRate = 5.0; GrowTime = 1.0;"}, 1, options).organs[0];
  EXPECT_LT(stem.length, 5);
  for (const auto& [from, to] : piecesOf(stem)) EXPECT_EQ(glm::clamp(to, walls.low.at, walls.high.at), to);
  EXPECT_NEAR(arcLength(stem), stem.length, 1e-12);
}

TEST(ObstacleFile, ReadsPointsAndFacesOfObjText) {
  const auto mesh = obstacleFromObj("# a wall\nmtllib x.mtl\nv 0 0 0\r\nv 1 0 0 1.0\nv\t1 1e0 0\nvn 0 0 1\nv 0 1 0.5\nf 1/1/1 2//1 3 4\nf -4 -1 -2\n");
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh->points, (std::vector<PlantPoint>{{{0, 0, 0}}, {{1, 0, 0}}, {{1, 1, 0}}, {{0, 1, 0.5}}}));
  EXPECT_EQ(mesh->triangles, (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}, {0, 3, 2}}));
}

TEST(ObstacleFile, SaysWhichLineIsWrong) {
  const auto refusal = [](std::string_view text) {
    const auto mesh = obstacleFromObj(text);
    return mesh ? std::string() : mesh.error().message;
  };
  EXPECT_NE(refusal("v 0 0 0\nv 1 x 0\n").find("line 2: 'x' is not a number"), std::string::npos);
  EXPECT_NE(refusal("v 0 0\n").find("line 1: a point needs three"), std::string::npos);
  EXPECT_NE(refusal("v 0 0 0\nf 1 1 2\n").find("line 2: there is no point number 2"), std::string::npos);
  EXPECT_NE(refusal("v 0 0 0\nf 1 1 -2\n").find("line 2: there is no point number -2"), std::string::npos);
  EXPECT_NE(refusal("v 0 0 0\nf 1 1\n").find("line 2: a face needs three"), std::string::npos);
  EXPECT_NE(refusal("v 0 0 0\nf 1 1 1.5\n").find("line 2: a corner is the number"), std::string::npos);
  EXPECT_NE(refusal("").find("no face"), std::string::npos);
}

TEST(ObstacleField, FindsTheNearestPointThatABruteForceSearchFinds) {
  Rng rng(5);
  const MeshObstacle mesh = randomMesh(rng);
  const std::vector<Obstacle> obstacles = {mesh};
  const ObstacleField field(obstacles);
  for (int round = 0; round < 200; ++round) {
    const auto point = [&] { return glm::dvec3{rng.uniform(-4, 4), rng.uniform(-1, 6), rng.uniform(-4, 4)}; };
    const glm::dvec3 from = point(), to = round % 4 == 0 ? from : point();
    double sampled = 1e9;
    for (const auto& t : mesh.triangles)
      for (int i = 0; i <= 24; ++i)
        for (int j = 0; i + j <= 24; ++j) {
          const glm::dvec3 p = (mesh.points[t[0]].at * double(i) + mesh.points[t[1]].at * double(j) + mesh.points[t[2]].at * double(24 - i - j)) / 24.0;
          const glm::dvec3 along = to - from;
          const double s = glm::dot(along, along) > 0 ? std::clamp(glm::dot(p - from, along) / glm::dot(along, along), 0.0, 1.0) : 0;
          sampled = std::min(sampled, glm::distance(from + along * s, p));
        }
    const auto nearest = field.nearest(from, to, 100);
    ASSERT_TRUE(nearest);
    EXPECT_LE(nearest->distance, sampled + 1e-12);
    EXPECT_GT(nearest->distance, sampled - 0.25);
    EXPECT_FALSE(field.nearest(from, to, nearest->distance));
    EXPECT_TRUE(field.nearest(from, to, nearest->distance + 1e-9));
  }
}

// ---- time ------------------------------------------------------------------------------------------------------------

/// One of each kind where the bush grows: a ball, a shelf, a slanting pane.
std::vector<Obstacle> obstaclesOfAllKinds() {
  const MeshObstacle pane{.points = {{{-2, 2.5, -2}}, {{2, 3.5, -2}}, {{0, 3, 2}}}, .triangles = {{0, 1, 2}}};
  return {SphereObstacle{{{0.5, 2, 0.5}}, 0.4}, BoxObstacle{{{-1.5, 1.4, -0.8}}, {{-0.3, 1.5, 0.8}}}, pane};
}
GrowOptions weather() {
  GrowOptions options;
  options.seed = 3;
  options.environment = {.wind = glm::dvec3{0.5, 0, 0}, .obstacles = obstaclesOfAllKinds()};
  options.changes = {{2.3, {.soilPH = 6.0, .gravity = glm::dvec3{0.3, -1, 0}, .wind = glm::dvec3{-0.5, 0, 0.2}, .obstacles = obstaclesOfAllKinds()}},
                     {5.1, {.rainRate = 0.4, .light = glm::dvec3{1, 1, 0}}}};
  return options;
}
PlantText answering() { return bush("GravityTropism = -0.2; LightTropism = 0.3; LightResponse = 0.8;"); }

TEST(GrowthEnvironment, AskingInAnyOrderGivesTheSamePlant) {
  const Growth growth = grown(grammarOf(answering()), weather());
  std::vector<Plant> inOrder;
  for (int i = 0; i <= 64; ++i) inOrder.push_back(at(growth, 0.15 * i));
  for (int i = 0; i <= 64; ++i) {
    const int shuffled = (i * 37) % 65;
    EXPECT_EQ(at(growth, 0.15 * shuffled), inOrder[static_cast<std::size_t>(shuffled)]);
  }
  EXPECT_EQ(at(grown(grammarOf(answering()), weather()), 6), at(growth, 6));
}

TEST(GrowthEnvironment, LaterStepsAndLaterChangesChangeNothingEarlier) {
  GrowOptions few = weather(), many = weather(), calm = weather();
  few.steps = 4;
  many.steps = 7;
  calm.changes.pop_back();
  const Growth a = grown(grammarOf(answering()), few), b = grown(grammarOf(answering()), many), c = grown(grammarOf(answering()), calm);
  for (double time = 0; time < 4.99; time += 0.23) EXPECT_EQ(at(a, time), at(b, time)) << time;
  for (double time = 0; time < 5.1; time += 0.23) EXPECT_EQ(at(c, time), at(b, time)) << time;
  EXPECT_NE(at(a, 6.5), at(b, 6.5));
  EXPECT_NE(at(c, 7), at(b, 7));
  GrowOptions upTo = weather();
  upTo.upToTime = 3.5;
  EXPECT_EQ(at(grown(grammarOf(answering()), upTo), 3.5), at(b, 3.5));
}

TEST(GrowthEnvironment, TheFirstChangeTouchesNoBitOfWhatCameBeforeIt) {
  GrowOptions calm, changed;
  calm.seed = changed.seed = 3;
  changed.changes = {{4.3, {.soilPH = 6.0, .wind = glm::dvec3{-0.5, 0, 0.2}}}};
  for (const char* attributes : {"", "SoilPH = 6.4; GravityTropism = -0.2;", "LightResponse = 0.8;"}) {
    const Growth a = grown(grammarOf(bush(attributes)), calm), b = grown(grammarOf(bush(attributes)), changed);
    for (double time = 0; time < 4.3; time += 0.13) EXPECT_EQ(at(a, time), at(b, time)) << attributes << " " << time;
    EXPECT_NE(at(a, 6), at(b, 6)) << attributes;
  }
}

TEST(GrowthEnvironment, AHostAnswersWhatThePlantHasBecome) {
  // A gardener who turns the heating off as soon as the plant is 2 high, and writes down when he looked.
  const Grammar grammar = grammarOf({.attributes = "TemperatureBest = 20; TemperatureWidth = 5;", .rules = "w = A(0); A(i) : i < 8 -> S(1) A(i+1) ;"});
  std::vector<double> asked;
  const auto heightOf = [](const Plant& plant) {
    double height = 0;
    for (const Organ& organ : plant.organs) height = std::max(height, organ.tip().at.y);
    return height;
  };
  GrowOptions options = in({.temperature = 20});
  options.betweenSteps = [&](const Plant& plant, const Environment& now) -> Result<Environment> {
    asked.push_back(plant.time);
    return heightOf(plant) >= 2 ? Environment{.temperature = 10} : now;
  };
  const Growth tended = grown(grammar, options);
  EXPECT_EQ(asked, (std::vector<double>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}));
  // The same growth told beforehand: the first organ is born at 1, so 2 are grown out at 3.
  GrowOptions told = in({.temperature = 20});
  told.changes = {{3, {.temperature = 10}}};
  const Growth planned = grown(grammar, told);
  for (double time = 0; time < 12; time += 0.37) EXPECT_EQ(at(tended, time), at(planned, time)) << time;
  EXPECT_NEAR(heightOf(at(tended, 20)), 2 + 6 * std::exp(-2), 1e-12);
}

TEST(GrowthEnvironment, WhatAHostAnswersLaterChangesNothingEarlierAndAnyTimeMayBeAskedFor) {
  // Every step another wind and one obstacle more; two gardeners who agree up to time 4.
  const auto gardener = [](double until) {
    GrowOptions options = weather();
    options.changes.clear();
    options.betweenSteps = [until](const Plant& plant, const Environment& now) -> Result<Environment> {
      if (plant.time > until) return Environment{.temperature = 5};
      Environment next = now;
      next.wind = glm::dvec3{0.4 - 0.2 * plant.time, 0, 0.1 * plant.time};
      next.obstacles.push_back(SphereObstacle{{{1.5 - plant.time, 1.5 + 0.5 * plant.time, 0}}, 0.2});
      return next;
    };
    return options;
  };
  const Grammar grammar = grammarOf(answering());
  const Growth a = grown(grammar, gardener(4)), b = grown(grammar, gardener(100));
  GrowOptions fewSteps = gardener(100);
  fewSteps.steps = 4;
  const Growth c = grown(grammar, fewSteps);
  for (int i = 0; i < 20; ++i) {
    const double time = 0.25 * ((i * 7) % 20);
    EXPECT_EQ(at(a, time), at(b, time)) << time;
    EXPECT_EQ(at(c, time), at(b, time)) << time;
  }
  EXPECT_NE(at(a, 7), at(b, 7));
  EXPECT_EQ(at(b, 7), at(grown(grammar, gardener(100)), 7));
}

TEST(GrowthEnvironment, AHostsLightActsFromTheStepAtWhichItAnswers) {
  GrowOptions hosted = in({}), told = in({});
  hosted.betweenSteps = [](const Plant& plant, const Environment& now) -> Result<Environment> {
    return plant.time >= 2 ? Environment{.light = glm::dvec3{1, 0.3, 0}} : now;
  };
  told.changes = {{2, {.light = glm::dvec3{1, 0.3, 0}}}};
  const Grammar grammar = grammarOf(answering());
  const Growth a = grown(grammar, hosted), b = grown(grammar, told);
  for (double time = 0; time < 9; time += 0.31) EXPECT_EQ(at(a, time), at(b, time)) << time;
}

TEST(GrowthEnvironment, AHostThatFailsOrSaysNonsenseEndsGrowth) {
  const auto endOf = [](GrowOptions options) {
    const auto growth = prepareGrowth(grammarOf({}), options);
    return growth ? std::string{} : growth.error().message;
  };
  GrowOptions failing, senseless, both;
  failing.betweenSteps = [](const Plant&, const Environment&) -> Result<Environment> { return fail(ErrorCode::NoAnswer, "the greenhouse is on fire"); };
  senseless.betweenSteps = [](const Plant&, const Environment&) -> Result<Environment> { return Environment{.temperature = std::nan("")}; };
  both = failing;
  both.changes = {{1, {}}};
  EXPECT_EQ(endOf(failing), "the greenhouse is on fire");
  EXPECT_NE(endOf(senseless), "");
  EXPECT_NE(endOf(both).find("give one of them"), std::string::npos);
}

TEST(GrowthEnvironment, AChangeActsFromItsTimeOn) {
  // Half of the growth at full response, half at exp(-1/2).
  const PlantText text{.attributes = "SoilPH = 7.0;"};
  GrowOptions options;
  options.changes = {{0.5, {.soilPH = 8.5}}};
  const Growth growth = grown(grammarOf(text), options);
  EXPECT_DOUBLE_EQ(at(growth, 0.25).organs[0].length, 0.25);
  EXPECT_DOUBLE_EQ(at(growth, 0.5).organs[0].length, 0.5);
  EXPECT_DOUBLE_EQ(at(growth, 1).organs[0].length, 0.5 + 0.5 * std::exp(-0.5));
}

// ---- responses -------------------------------------------------------------------------------------------------------

TEST(GrowthEnvironment, ResponsesAreOneAtTheirOptimumAndFallOffAtTheirWidth) {
  const auto length = [](const std::string& attributes, const Environment& environment) { return at({.attributes = attributes}, 1, in(environment)).organs[0].length; };
  EXPECT_EQ(length("", {}), 1);
  EXPECT_EQ(length("", {.soilPH = 7.0, .rainRate = 0.9, .dayLight = 12.0, .temperature = 22.0}), 1);
  EXPECT_DOUBLE_EQ(length("", {.temperature = 30.0}), std::exp(-0.5));
  EXPECT_DOUBLE_EQ(length("Temperature = 16.0; TemperatureWidth = 6.0;", {}), std::exp(-0.5));
  EXPECT_EQ(length("TemperatureBest = 12.0; SoilPHBest = 5.0; RainRateBest = 2.0; DayLightBest = 9.0;",
                   {.soilPH = 5.0, .rainRate = 2.0, .dayLight = 9.0, .temperature = 12.0}), 1);
  EXPECT_EQ(length("SoilPH = 3.0;", {.soilPH = 7.0}), 1) << "the host's word counts";
}

// ---- ageing ----------------------------------------------------------------------------------------------------------

TEST(GrowthEnvironment, StemsGoOnThickeningForTheirBroadenTime) {
  const PlantText text{.stem = "GrowRate = 1.0; GrowTime = 1.0; BroadenRate = 0.5; BroadenTime = 4.0;"};
  const Growth growth = grown(grammarOf(text));
  EXPECT_DOUBLE_EQ(at(growth, 1).organs[0].radius, 0.5 * modelRadius);
  EXPECT_DOUBLE_EQ(at(growth, 2).organs[0].radius, 1.0 * modelRadius);
  EXPECT_DOUBLE_EQ(at(growth, 9).organs[0].radius, 2.0 * modelRadius);
  EXPECT_DOUBLE_EQ(at(growth, 9).organs[0].length, 1);
  EXPECT_DOUBLE_EQ(completeTime(growth), 4);
}

TEST(GrowthEnvironment, LeavesUnfoldFromTheirParentsDirectionToTheirOwn) {
  const PlantText text{.leaf = "GrowRate = 0.3; GrowTime = 1.0; UnfoldTime = 2.0;", .rules = "w = S(1) [rotr(1.0)rotu(0)L(1)];"};
  const Growth growth = grown(grammarOf(text));
  const auto leaf = [&](double time) { return at(growth, time).organs[1]; };
  const auto angle = [&](double time) { return angleBetween(leaf(time).direction, PlantDirection::up()).radians(); };
  EXPECT_EQ(leaf(0).opening, 0);
  EXPECT_NEAR(angle(0), 0, 1e-12);
  EXPECT_EQ(leaf(1).opening, 0.5);
  EXPECT_NEAR(angle(1), 0.5, 1e-12);
  EXPECT_EQ(leaf(2).opening, 1);
  EXPECT_NEAR(angle(2), 1, 1e-12);
  EXPECT_DOUBLE_EQ(completeTime(growth), 2);
}

TEST(GrowthEnvironment, FlowersOpenAndFruitsSwell) {
  const Growth growth = grown(parsed("EcoSystem 1.1 \"e\" { Plant \"p\" { Stem { Stage 1 { GrowRate = 1.0; } } "
                                     "Flower { Stage 1 { GrowRate = 0.2; UnfoldTime = 4.0; FallAge = 6; } } "
                                     "Fruit { Stage 1 { GrowRate = 0.1; BroadenRate = 2.0; BroadenTime = 8.0; } } "
                                     "Grow { w = S(1) [rotr(1)rotu(0)W(1)] F(1); } } }"));
  const auto organ = [&](double time, OrganKind kind) {
    for (const Organ& o : at(growth, time).organs)
      if (o.kind == kind) return std::optional<Organ>(o);
    return std::optional<Organ>();
  };
  double opening = -1, radius = -1;
  for (const double time : {0.5, 1.0, 2.0, 3.0, 3.9}) {
    EXPECT_GT(organ(time, OrganKind::Flower)->opening, opening) << time;
    EXPECT_GT(organ(time, OrganKind::Fruit)->radius, radius) << time;
    opening = organ(time, OrganKind::Flower)->opening;
    radius = organ(time, OrganKind::Fruit)->radius;
  }
  EXPECT_EQ(organ(4, OrganKind::Flower)->opening, 1);
  EXPECT_FALSE(organ(6, OrganKind::Flower));
  EXPECT_DOUBLE_EQ(organ(8, OrganKind::Fruit)->radius, 2 * 8 * modelRadius);
  EXPECT_EQ(organ(8, OrganKind::Fruit)->radius, organ(80, OrganKind::Fruit)->radius);
}

TEST(GrowthEnvironment, LeavesWitherHangAndFallWithWhatStandsOnThem) {
  const std::string leaf = "GrowRate = 0.3; GrowTime = 1.0; ColorFront = RGBA(0, 1, 0, 1); WitherAge = 3.0; WitherTime = 2.0; WitherColor = RGBA(1, 0, 0, 1); FallAge = 6.0;";
  const PlantText text{.leaf = leaf, .rules = "w = S(1) [rotr(1.2)rotu(0)L(1)S(1)];"};
  const Growth growth = grown(grammarOf(text));
  const Plant fresh = at(growth, 3), half = at(growth, 4), dry = at(growth, 5);
  EXPECT_EQ(fresh.organs[1].withered, 0);
  EXPECT_EQ(half.organs[1].withered, 0.5);
  EXPECT_EQ(dry.organs[1].withered, 1);
  EXPECT_EQ(fresh.styleOf(fresh.organs[1]).colour, glm::dvec4(0, 1, 0, 1));
  EXPECT_EQ(dry.styleOf(dry.organs[1]).colour, glm::dvec4(1, 0, 0, 1));
  EXPECT_NE(half.styleOf(half.organs[1]).colour, dry.styleOf(dry.organs[1]).colour);
  EXPECT_LT(half.organs[1].tip().at.y, fresh.organs[1].tip().at.y);
  EXPECT_LT(dry.organs[1].tip().at.y, half.organs[1].tip().at.y);
  EXPECT_EQ(at(growth, 5.99).organs.size(), 3u);
  EXPECT_EQ(at(growth, 6).organs.size(), 1u);
}

// ---- light -----------------------------------------------------------------------------------------------------------

/// A tall plant with a roof of leaves and a small one below; `small` are the small one's attributes.
Grammar tallAndSmall(const std::string& small, double distance) {
  const PlantText tall{.attributes = "Position = vector(" + std::to_string(distance) + ", 0, 0);", .leaf = "GrowRate = 2.0; GrowTime = 1.0; BroadenRate = 80.0;",
                       .rules = "w = S(1) S(1) S(1) [rotr(1.57)rotu(0)L(1)] [rotr(1.57)rotu(1.57)L(1)] [rotr(1.57)rotu(3.14)L(1)] [rotr(1.57)rotu(-1.57)L(1)];"};
  const PlantText low{.attributes = small, .stem = "GrowRate = 0.2; GrowTime = 4.0;", .rules = "w = S(1) [rotr(0.8)rotu(0)L(1)];"};
  return parsed("EcoSystem 1.1 \"e\" { " + plantBlock(tall, "tall") + plantBlock(low, "low") + "}");
}

TEST(GrowthEnvironment, ATallerPlantShadesAShorterOne) {
  const auto lengthOfLow = [](const std::string& attributes, double distance) {
    const Plant plant = at(grown(tallAndSmall(attributes, distance)), 10);
    return plant.organs[plant.organs.size() - 2].length;
  };
  EXPECT_DOUBLE_EQ(lengthOfLow("", 0.3), 0.8) << "off by default";
  EXPECT_LT(lengthOfLow("LightResponse = 1.0;", 0.3), 0.6);
  EXPECT_GT(lengthOfLow("LightResponse = 1.0;", 0.3), 0.2) << "the first step is in full light";
  EXPECT_DOUBLE_EQ(lengthOfLow("LightResponse = 1.0;", 30), 0.8);
  EXPECT_GT(lengthOfLow("LightResponse = 0.5;", 0.3), lengthOfLow("LightResponse = 1.0;", 0.3));
}

TEST(LightGrid, LightFallsByTheAreaAboveAndFromWhereItComes) {
  std::vector<ShadePatch> roof;
  for (int x = -8; x <= 8; ++x)
    for (int z = -8; z <= 8; ++z) roof.push_back({{{x * 0.1, 2, z * 0.1}}, 0.01});
  const LightGrid noon(roof, PlantDirection::up());
  EXPECT_NEAR(noon.lightAt({{0.03, 0, 0.02}}), std::exp(-0.5), 1e-9) << "a closed roof of one layer";
  EXPECT_EQ(noon.lightAt({{0, 3, 0}}), 1);
  EXPECT_EQ(noon.lightAt({{5, 0, 0}}), 1);
  const LightGrid evening(roof, PlantDirection::along({1, 0.2, 0}));
  EXPECT_EQ(evening.lightAt({{0, 0, 0}}), 1);
  EXPECT_LT(evening.lightAt({{-10, 0, 0}}), 1);
}

// ---- bad input -------------------------------------------------------------------------------------------------------

TEST(GrowthEnvironment, ASenselessEnvironmentIsRefusedInOneSentence) {
  const Grammar grammar = grammarOf({});
  const auto changing = [](std::vector<EnvironmentChange> changes) {
    GrowOptions options;
    options.changes = std::move(changes);
    return options;
  };
  const auto refusal = [&](const GrowOptions& options) {
    const auto growth = prepareGrowth(grammar, options);
    return growth ? std::string("it grew") : growth.error().message;
  };
  EXPECT_NE(refusal(in({.temperature = std::nan("")})).find("temperature"), std::string::npos);
  EXPECT_NE(refusal(in({.light = glm::dvec3{0, 0, 0}})).find("light"), std::string::npos);
  EXPECT_NE(refusal(in({.obstacles = {SphereObstacle{{{3, 0, 0}}, -1}}})).find("radius above 0"), std::string::npos);
  EXPECT_NE(refusal(in({.obstacles = {BoxObstacle{{{1, 1, 1}}, {{0, 2, 2}}}}})).find("corners"), std::string::npos);
  EXPECT_NE(refusal(in({.obstacles = {MeshObstacle{{{{1, 1, 1}}}, {{0, 0, 7}}}}})).find("point 7"), std::string::npos);
  EXPECT_NE(refusal(in({.obstacles = {SphereObstacle{{{0, 0.5, 0}}, 1}}})).find("stands in an obstacle"), std::string::npos);
  EXPECT_NE(refusal(in({.obstacles = {BoxObstacle{{{-1, -1, -1}}, {{1, 0, 1}}}}})).find("touches"), std::string::npos);
  EXPECT_NE(refusal(changing({{3, {}}, {2, {}}})).find("ascending"), std::string::npos);
  EXPECT_NE(refusal(changing({{-1, {}}})).find("at least 0"), std::string::npos);
  const auto tooEager = prepareGrowth(grammarOf({.attributes = "LightResponse = 1.5;"}));
  ASSERT_FALSE(tooEager);
  EXPECT_NE(tooEager.error().message.find("LightResponse"), std::string::npos);
  const auto endless = prepareGrowth(grammarOf({.attributes = "LightResponse = 1.0; DeriveTime = 0.000001;"}));
  ASSERT_FALSE(endless);
  EXPECT_EQ(endless.error().code, ErrorCode::LimitReached);
}

}  // namespace
}  // namespace axil::simeco
