// Shape x apex x base x margin: what a description can say about a blade, in every combination.
#include "base/rng.hpp"
#include "organs/leaf.hpp"

#include "mesh_checks.hpp"
#include "polygon_checks.hpp"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <set>

namespace axil::organs {
namespace {

using test::areaOf;
using test::cross;
using test::crossingsOf;
using test::expectSound;
using test::trianglesOf;

LeafShape shaped(const LeafShape& shape, const std::string& apex, const std::string& base, const std::string& margin) {
  return *withFeature(*withFeature(*withFeature(shape, LeafFeature::Apex, apex), LeafFeature::Base, base), LeafFeature::Margin, margin);
}

struct Features {
  std::vector<std::string> apexes = leafFeatureNames(LeafFeature::Apex);
  std::vector<std::string> bases = leafFeatureNames(LeafFeature::Base);
  std::vector<std::string> margins = leafFeatureNames(LeafFeature::Margin);
};

// A third of all triples of shape, apex and base, each with one of the margins in turn, so that every pair comes up.
TEST(LeafFeatures, EveryCombinationGivesASimpleOutline) {
  const auto& [apexes, bases, margins] = Features();
  std::size_t turn = 0;
  for (const LeafShape& shape : leafShapes())
    for (const std::string& apex : apexes)
      for (const std::string& base : bases) {
        if (++turn % 3 != 0) continue;
        const std::string& margin = margins[turn / 3 % margins.size()];
        const LeafShape leaf = shaped(shape, apex, base, margin);
        const std::vector<glm::vec2> outline = leafOutline(leaf);
        ASSERT_GT(outline.size(), 8u);
        ASSERT_EQ(crossingsOf(outline), 0) << shape.name << ", apex " << apex << ", base " << base << ", margin " << margin;
        ASSERT_GT(areaOf(outline), 0.2 * leaf.widthToLength * 0.3) << shape.name << ", apex " << apex << ", base " << base << ", margin " << margin;
      }
}

// With every triangle facing up and areas that add up to the outline's, triangles cannot overlap.
TEST(LeafFeatures, EveryCombinationGivesACleanBlade) {
  const std::uint64_t seed = std::getenv("AXIL_SEED") != nullptr ? std::strtoull(std::getenv("AXIL_SEED"), nullptr, 10) : 6;
  Rng rng(seed);
  const auto& [apexes, bases, margins] = Features();
  for (int i = 0; i < 700; ++i) {
    const LeafShape& shape = leafShapes()[rng.below(leafShapes().size())];
    const std::string apex = apexes[rng.below(apexes.size())], base = bases[rng.below(bases.size())], margin = margins[rng.below(margins.size())];
    const Detail detail = std::array{Detail::Close, Detail::Medium, Detail::Far}[rng.below(3)];
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + shape.name + ", apex " + apex + ", base " + base + ", margin " + margin + ", detail " + std::to_string(static_cast<int>(detail)));
    const LeafShape leaf = shaped(shape, apex, base, margin);
    const std::vector<Part> parts = leafParts(leaf, std::nullopt, detail);
    const Mesh& blade = parts.front().mesh;
    double area = 0;
    for (std::size_t t = 0; t < blade.triangles.size(); t += 3) {
      const glm::dvec2 a = glm::vec2(blade.positions[blade.triangles[t]]), b = glm::vec2(blade.positions[blade.triangles[t + 1]]), c = glm::vec2(blade.positions[blade.triangles[t + 2]]);
      const double one = 0.5 * cross(b - a, c - a);
      ASSERT_GT(one, 0);
      area += one;
    }
    if (detail == Detail::Close) {
      ASSERT_NEAR(area / areaOf(leafOutline(leaf)), 1, 0.06);
    }
    for (const Part& part : parts) expectSound(part, "");
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(LeafFeatures, AreAllDifferentFromEachOther) {
  const LeafShape ovate = *leafShapeNamed("ovate");
  for (const LeafFeature feature : {LeafFeature::Apex, LeafFeature::Base, LeafFeature::Margin}) {
    std::set<std::vector<float>> outlines;
    for (const std::string& name : leafFeatureNames(feature)) {
      if (name == "ciliate" || name == "revolute") continue;  // hairs stand on an entire margin, a rolled edge keeps its outline
      std::vector<float> numbers;
      for (const glm::vec2& p : leafOutline(*withFeature(ovate, feature, name))) numbers.insert(numbers.end(), {p.x, p.y});
      EXPECT_TRUE(outlines.insert(numbers).second) << name;
    }
  }
  EXPECT_FALSE(withFeature(ovate, LeafFeature::Apex, "no such apex"));
}

/// Width of an outline at the height `y`.
double widthOf(const std::vector<glm::vec2>& outline, double y) {
  double low = 0, high = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const glm::dvec2 a = outline[i], b = outline[(i + 1) % outline.size()];
    if ((a.y > y) == (b.y > y)) continue;
    const double x = a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y);
    low = std::min(low, x);
    high = std::max(high, x);
  }
  return high - low;
}

TEST(LeafFeatures, MeanWhatTheirWordsMean) {
  const LeafShape elliptic = *leafShapeNamed("elliptic");
  const auto apex = [&](const char* name) { return leafOutline(*withFeature(elliptic, LeafFeature::Apex, name)); };
  const auto base = [&](const char* name) { return leafOutline(*withFeature(elliptic, LeafFeature::Base, name)); };
  const auto lowest = [](const std::vector<glm::vec2>& o) { return std::min_element(o.begin(), o.end(), [](auto a, auto b) { return a.y < b.y; })->y; };
  const auto highest = [](const std::vector<glm::vec2>& o) { return std::max_element(o.begin(), o.end(), [](auto a, auto b) { return a.y < b.y; })->y; };
  // Near the tip: a tail is narrowest, then drawn out, straight-sided, blunt, round, cut off.
  const std::vector<const char*> widening{"caudate", "acuminate", "acute", "obtuse", "rounded", "truncate"};
  for (std::size_t i = 1; i < widening.size(); ++i) EXPECT_LT(widthOf(apex(widening[i - 1]), 0.9), widthOf(apex(widening[i]), 0.9)) << widening[i];
  const std::vector<const char*> opening{"attenuate", "cuneate", "obtuse", "rounded", "truncate"};
  for (std::size_t i = 1; i < opening.size(); ++i) EXPECT_LT(widthOf(base(opening[i - 1]), 0.08), widthOf(base(opening[i]), 0.08)) << opening[i];
  EXPECT_GT(highest(apex("emarginate")), highest(apex("retuse")));
  EXPECT_GT(highest(apex("retuse")), 1.005);
  for (const char* name : {"cordate", "sagittate", "auriculate", "peltate"}) EXPECT_LT(lowest(base(name)), -0.03) << name;
  EXPECT_GT(lowest(base("cuneate")), -1e-6);
  // A mucro is a bristle on a round end.
  EXPECT_LT(widthOf(apex("mucronate"), 0.985), 0.1 * widthOf(apex("mucronate"), 0.8));
}

TEST(LeafFeatures, HaveTheTeethThatAreAskedFor) {
  const LeafShape ovate = *leafShapeNamed("ovate");
  for (const char* name : {"serrate", "dentate", "crenate", "serrulate"}) {
    const LeafShape leaf = *withFeature(ovate, LeafFeature::Margin, name);
    const std::vector<glm::vec2> outline = leafOutline(leaf);
    // A tip is a corner where a counter-clockwise outline turns sharply left.
    int tips = 0;
    for (std::size_t i = 1; i < outline.size() / 2; ++i) {
      const glm::dvec2 a = outline[i - 1], b = outline[i], c = outline[i + 1];
      if (cross(b - a, c - b) > 0.15 * glm::length(b - a) * glm::length(c - b)) ++tips;
    }
    EXPECT_GE(tips, leaf.teeth * 8 / 10) << name;
    EXPECT_GT(outline.size(), 4u * static_cast<unsigned>(leaf.teeth)) << name;
  }
}

TEST(LeafVeins, StayInsideTheOutline) {
  for (const LeafShape& shape : leafShapes())
    for (const std::string& name : leafFeatureNames(LeafFeature::Veins)) {
      const LeafShape leaf = *withFeature(shape, LeafFeature::Veins, name);
      const std::vector<glm::vec2> outline = leafOutline(leaf);
      const auto inside = [&](glm::vec2 p) {
        bool in = false;
        for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++)
          if ((outline[i].y > p.y) != (outline[j].y > p.y) && p.x < (outline[j].x - outline[i].x) * (p.y - outline[i].y) / (outline[j].y - outline[i].y) + outline[i].x) in = !in;
        return in;
      };
      std::size_t sides = 0;
      for (const LeafVein& vein : leafVeins(leaf)) {
        ++sides;
        for (std::size_t i = 1; i < vein.points.size(); ++i) ASSERT_TRUE(inside(vein.points[i])) << shape.name << " " << name;
      }
      if (name != "one-veined" && shape.widthToLength > 0.1) {
        EXPECT_GE(sides, 3u) << shape.name << " " << name;
      }
    }
}

}  // namespace
}  // namespace axil::organs
