#include "skeleton3d/tree.hpp"

#include "random_cameras.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace axil::skeleton3d {
namespace {

struct Sketch {
  std::vector<View> views;
  std::vector<ClickedNode> nodes;
  std::vector<ClickedStem> stems;
};

ClickedStem stem(int id, std::initializer_list<int> nodes) {
  ClickedStem made{StemId(id), {}};
  for (const int n : nodes) made.nodes.emplace_back(n);
  return made;
}

/// Nodes 1 to `count` on a rising spiral, and the given stems.
Sketch sketch(int count, std::vector<ClickedStem> stems) {
  Sketch made{{}, {}, std::move(stems)};
  for (const char* name : {"front", "right"})
    made.views.push_back({name, *nominalCamera(name, {.model = CameraModel::Orthographic, .target = {{0, 0.5, 0}}, .scale_px_per_unit = 1000}), {1200, 1600}});
  for (int i = 1; i <= count; ++i)
    made.nodes.push_back(test::clicked(made.views, i, {{0.2 * std::cos(i), 0.1 * (i - 1), 0.2 * std::sin(i)}}));
  return made;
}

Result<Skeleton> build(const Sketch& s) { return buildSkeleton(s.views, s.nodes, s.stems); }

std::vector<int> stemOrder(const Skeleton& skeleton) {
  std::vector<int> ids;
  for (const Stem& s : skeleton.stems) ids.push_back(s.id.value);
  return ids;
}

std::optional<int> parentOf(const Skeleton& skeleton, int id) {
  const auto found = std::find_if(skeleton.stems.begin(), skeleton.stems.end(), [&](const Stem& s) { return s.id.value == id; });
  return found->parent ? std::optional(found->parent->value) : std::nullopt;
}

TEST(BuildSkeleton, FindsParentsAndKeepsTheOrderOfATreeThatHasOne) {
  const auto tree = build(sketch(8, {stem(5, {1, 2, 3}), stem(2, {2, 4, 5}), stem(9, {1, 6}), stem(1, {5, 7}), stem(4, {2, 8})}));
  ASSERT_TRUE(tree) << tree.error().message;
  EXPECT_EQ(tree->root, NodeId(1));
  EXPECT_EQ(tree->unit, "m");
  EXPECT_EQ(stemOrder(*tree), (std::vector{5, 2, 9, 1, 4}));
  EXPECT_EQ(parentOf(*tree, 5), std::nullopt);
  EXPECT_EQ(parentOf(*tree, 2), 5);
  EXPECT_EQ(parentOf(*tree, 9), 5);  // begins with the root, so does the first stem
  EXPECT_EQ(parentOf(*tree, 1), 2);  // continues the tip of stem 2
  EXPECT_EQ(parentOf(*tree, 4), 5);
}

TEST(BuildSkeleton, PutsParentsBeforeChildrenWhateverTheOrder) {
  const auto tree = build(sketch(7, {stem(1, {5, 7}), stem(2, {2, 4, 5}), stem(3, {1, 2, 3}), stem(4, {7, 6})}));
  ASSERT_TRUE(tree) << tree.error().message;
  EXPECT_EQ(stemOrder(*tree), (std::vector{3, 2, 1, 4}));
}

/// All troubles of a sketch, whether one or many.
std::vector<std::string> troublesOf(const Sketch& s) {
  const auto tree = build(s);
  if (tree) return {};
  return tree.error().details.empty() ? std::vector{tree.error().message} : tree.error().details;
}

void expectTrouble(const Sketch& s, const std::string& part) {
  const auto troubles = troublesOf(s);
  EXPECT_TRUE(std::any_of(troubles.begin(), troubles.end(), [&](const std::string& t) { return t.find(part) != std::string::npos; }))
      << "no trouble says '" << part << "'" << (troubles.empty() ? "" : "; first: " + troubles.front());
}

TEST(BuildSkeleton, RefusesWhatIsNoTree) {
  expectTrouble(sketch(2, {}), "no stem");
  expectTrouble(sketch(2, {stem(1, {1, 2}), stem(2, {2, 9})}), "stem 2 lists node 9, which does not exist");
  expectTrouble(sketch(2, {stem(1, {1, 2}), stem(2, {2})}), "stem 2 has fewer than two nodes");
  expectTrouble(sketch(2, {stem(1, {1, 2}), stem(2, {})}), "stem 2 has fewer than two nodes");
  expectTrouble(sketch(3, {stem(1, {1, 2}), stem(1, {2, 3})}), "stem 1 is listed twice");
  expectTrouble(sketch(3, {stem(1, {1, 2, 3, 2})}), "stem 1 lists node 2 twice");
  expectTrouble(sketch(3, {stem(1, {1, 2, 3, 1})}), "stem 1 lists node 1 twice");
  expectTrouble(sketch(4, {stem(1, {1, 2, 3}), stem(2, {1, 4, 3})}), "node 3 belongs to both stem 1 and stem 2");
  expectTrouble(sketch(4, {stem(1, {1, 2}), stem(2, {3, 4})}), "two roots, node 1 and node 3");
  expectTrouble(sketch(5, {stem(1, {1, 2}), stem(2, {3, 4}), stem(3, {4, 5, 3})}), "circle: stems 2, 3 hang");
  expectTrouble(sketch(3, {stem(1, {1, 2, 3}), stem(2, {3, 1})}), "circle");
  expectTrouble(sketch(3, {stem(1, {1, 2})}), "node 3 belongs to no stem");
  expectTrouble(sketch(3, {stem(1, {1, 2, 3}), stem(-1, {1, 2})}), "negative id");
}

TEST(BuildSkeleton, RefusesASegmentWithoutLength) {
  Sketch s = sketch(3, {stem(1, {1, 2, 3})});
  s.nodes[2].clicks = s.nodes[1].clicks;
  expectTrouble(s, "no length: node 2 and node 3");
}

TEST(BuildSkeleton, ReportsGeometryAndStructureInOneGo) {
  Sketch s = sketch(5, {stem(1, {1, 2, 8}), stem(2, {3, 4}), stem(3, {4, 5, 5})});
  s.nodes[0].clicks["front"].px.y = -300;
  s.nodes[1].clicks["right"].px.y += 300;
  EXPECT_EQ(troublesOf(s).size(), 5u);
}

TEST(BuildSkeleton, KeepsNodesOfOneViewUntilAnotherSeesThem) {
  Sketch s = sketch(8, {stem(1, {1, 2, 3, 4}), stem(2, {2, 5, 6}), stem(3, {3, 7, 8})});
  const Sketch whole = s;
  s.nodes[2].clicks.erase("front");  // node 3: stem 1 runs on without it, stem 3 has nothing to begin at
  s.nodes[5].clicks.erase("right");  // node 6, the tip of stem 2
  const auto tree = build(s);
  ASSERT_TRUE(tree) << tree.error().message;
  EXPECT_EQ(tree->incomplete, (std::vector<IncompleteNode>{{NodeId(3), {"right"}}, {NodeId(6), {"front"}}}));
  EXPECT_EQ(tree->waiting, (std::vector<StemId>{StemId(3)}));
  EXPECT_EQ(stemOrder(*tree), (std::vector{1, 2}));
  EXPECT_EQ(tree->stems[0].nodes, (std::vector{NodeId(1), NodeId(2), NodeId(4)}));
  EXPECT_EQ(tree->stems[1].nodes, (std::vector{NodeId(2), NodeId(5)}));
  EXPECT_EQ(tree->nodes.size(), 4u);
  s.nodes[2].clicks = whole.nodes[2].clicks;
  s.nodes[5].clicks = whole.nodes[5].clicks;
  EXPECT_EQ(*build(s), *build(whole));
  EXPECT_TRUE(build(s)->incomplete.empty());
  s.nodes[5].clicks.clear();  // nowhere is one less than one
  EXPECT_EQ(build(s)->incomplete.size(), 1u);
  s.nodes[0].clicks.erase("front");
  expectTrouble(s, "node 1 is clicked in one view only (right) and no stem can be placed without it");
}

TEST(BuildSkeleton, CarriesRadiiOverAndFillsGapsAlongAStem) {
  Sketch s = sketch(8, {stem(1, {1, 2, 3, 4}), stem(2, {2, 5, 6}), stem(3, {3, 7, 8})});
  s.nodes[1].radius = 0.010;
  s.nodes[3].radius = 0.004;
  s.nodes[5].radius = 0.002;
  const auto tree = build(s);
  ASSERT_TRUE(tree) << tree.error().message;
  const auto at = [&](int id) { return tree->nodes[static_cast<std::size_t>(id - 1)]; };
  EXPECT_EQ(at(1).radius, 0.010);  // nothing known before it
  EXPECT_EQ(at(2).radius, 0.010);
  const double before = glm::length(at(3).position.at - at(2).position.at), after = glm::length(at(4).position.at - at(3).position.at);
  EXPECT_NEAR(*at(3).radius, 0.010 - 0.006 * before / (before + after), 1e-15);
  EXPECT_EQ(at(5).radius, 0.002);  // the parent's thickness at node 2 is not the branch's
  EXPECT_EQ(at(7).radius, std::nullopt);
  EXPECT_EQ(at(8).radius, std::nullopt);
  s.nodes[0].radius = -1;
  expectTrouble(s, "node 1 has a radius");
}

TEST(BuildSkeleton, FourThousandStemsInAChainBackwardsAreNoTrouble) {
  Sketch s = sketch(1, {});
  const int count = 4000;
  for (int i = 2; i <= count; ++i) {
    s.nodes.push_back(test::clicked(s.views, i, {{0.2 * std::cos(i), 0.5 + 0.0001 * i, 0.2 * std::sin(i)}}));
    s.stems.push_back(stem(i, {i - 1, i}));
  }
  std::reverse(s.stems.begin(), s.stems.end());
  const auto tree = build(s);
  ASSERT_TRUE(tree) << tree.error().message;
  EXPECT_EQ(tree->stems.front().id, StemId(2));
  EXPECT_EQ(tree->stems.back().parent, StemId(count - 1));
}

}  // namespace
}  // namespace axil::skeleton3d
