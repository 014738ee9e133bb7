#include "emit/assembly.hpp"

#include "emit/builder.hpp"
#include "simeco/growth.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace axil::emit {

namespace {

using simeco::Grammar;
using simeco::Module;
using simeco::OrganKind;
using simeco::Production;
using simeco::Stage;

constexpr int kPlain = 6;  // decimals of attributes that are no measurement, as the thesis prints them
constexpr int kFirstAuxiliaryApex = 10;
constexpr double kPetioleRadius = 0.08;  // of its length, as thin as a stalk looks
const glm::dvec4 kStemColour{0.36, 0.42, 0.22, 1};
const glm::dvec4 kLeafColour{0.22, 0.50, 0.16, 1};

simeco::Attribute colour(Grammar& grammar, const glm::dvec4& c) {
  Builder b(grammar);
  return b.attribute("ColorFront", b.call("RGBA", {b.printed(c.x, kPlain), b.printed(c.y, kPlain), b.printed(c.z, kPlain), b.printed(c.w, kPlain)}));
}

bool isRolled(const PlannedLeaf& leaf, const Digits& digits) { return rounded(leaf.roll.radians(), digits.angle) != 0; }
/// Whether the leaf has an S(0) as joint between its turn and its roll; a stalk is joint enough.
bool needsJoint(const PlannedLeaf& leaf, const Digits& digits) { return leaf.petioleStage < 0 && isRolled(leaf, digits); }

void addLeaf(Builder& b, std::vector<Module>& to, const PlannedLeaf& leaf, const Digits& digits) {
  to.push_back(Builder::module("["));
  b.turn(to, leaf.turn, digits.angle);
  if (leaf.petioleStage >= 0) to.push_back(b.organ("S", leaf.petioleStage));
  if (needsJoint(leaf, digits)) to.push_back(b.organ("S", 0));
  if (isRolled(leaf, digits)) b.turn(to, {Angle{}, leaf.roll}, digits.angle);
  to.push_back(b.organ("L", leaf.leafStage));
  to.push_back(Builder::module("]"));
}

void addBranch(Builder& b, std::vector<Module>& to, const PlannedSegment& child, const Digits& digits) {
  to.push_back(Builder::module("["));
  b.turn(to, child.turn, digits.angle);
  to.push_back(b.organ("S", child.stage));
  to.push_back(Builder::module("]"));
}

/// Writes the rules, root first, and notes when each segment is born.
class RuleWriter {
 public:
  RuleWriter(const Plan& plan, Assembled& out) : plan_(plan), out_(out), builder_(out.grammar), rules_(out.grammar.plants.front().rules) {
    out_.ruleOf.resize(plan.segments.size());
    out_.bornAt.assign(plan.segments.size(), 1);
    out_.firstFreeApex = kFirstAuxiliaryApex;
  }

  void write() {
    rules_.label = "w";
    rules_.productions.reserve(2 * plan_.segments.size() + 1);
    rules_.axiom = {builder_.organ("A", 0)};
    std::vector<Module> start;
    for (const PlannedLeaf& l : plan_.rootLeaves) addLeaf(builder_, start, l, plan_.digits);
    for (const std::size_t s : plan_.collarBranches) addBranch(builder_, start, plan_.segments[s], plan_.digits);
    start.push_back(builder_.organ("S", plan_.segments.front().stage));
    rules_.productions.push_back(Builder::rule({builder_.organ("A", 0)}, std::move(start)));
    for (std::size_t s = 0; s < plan_.segments.size(); ++s) segment(s);
  }

 private:
  void segment(std::size_t s) {
    const PlannedSegment& own = plan_.segments[s];
    if (own.children.empty() && own.leaves.empty()) return;
    out_.ruleOf[s] = rules_.productions.size();
    if (own.children.size() == 1 && own.leaves.empty()) onlyChild(s, own.children.front());
    else family(s);
  }

  void onlyChild(std::size_t s, std::size_t child) {
    const int apex = out_.firstFreeApex++;
    rules_.productions.push_back(Builder::rule({builder_.organ("S", plan_.segments[s].stage)}, {builder_.organ("S", 0), builder_.organ("A", apex)}));
    std::vector<Module> next;
    mainChild(next, child);
    rules_.productions.push_back(Builder::rule({builder_.organ("A", apex)}, std::move(next)));
    out_.bornAt[child] = out_.bornAt[s] + 2;
  }

  void family(std::size_t s) {
    const PlannedSegment& own = plan_.segments[s];
    std::vector<Module> next{builder_.organ("S", 0)};
    for (const PlannedLeaf& l : own.leaves) addLeaf(builder_, next, l, plan_.digits);
    for (const std::size_t child : own.children) {
      if (plan_.segments[child].kind == ChildKind::Branch) addBranch(builder_, next, plan_.segments[child], plan_.digits);
      else mainChild(next, child);
      out_.bornAt[child] = out_.bornAt[s] + 1;
    }
    rules_.productions.push_back(Builder::rule({builder_.organ("S", own.stage)}, std::move(next)));
  }

  void mainChild(std::vector<Module>& to, std::size_t child) {
    builder_.turn(to, plan_.segments[child].turn, plan_.digits.angle);
    to.push_back(builder_.organ("S", plan_.segments[child].stage));
  }

  const Plan& plan_;
  Assembled& out_;
  Builder builder_;
  simeco::RuleSet& rules_;
};

std::vector<std::string> heading(const Plan& plan) {
  std::size_t leaves = plan.rootLeaves.size();
  for (const PlannedSegment& s : plan.segments) leaves += s.leaves.size();
  std::vector<std::string> lines{"// Regrows a measured plant: " + countOf(plan.segments.size(), "stem segment", "stem segments") + ", " +
                                 countOf(leaves, "leaf", "leaves") + "."};
  if (!plan.radiusMeasured) lines.push_back("// No radius was measured; stems are as thick as what they carry suggests.");
  return lines;
}

/// Whether any rule makes an S(0): a segment that something stands on, or a joint of a leaf at the collar.
bool hasGrowingPoints(const Plan& plan) {
  const auto carries = [](const PlannedSegment& s) { return !s.children.empty() || !s.leaves.empty(); };
  return std::any_of(plan.segments.begin(), plan.segments.end(), carries) || std::any_of(plan.rootLeaves.begin(), plan.rootLeaves.end(), [&](const PlannedLeaf& l) { return needsJoint(l, plan.digits); });
}

void addStages(const Plan& plan, Grammar& grammar, const EmitOptions& options) {
  std::vector<Stage> stems;
  stems.reserve(plan.segments.size() + plan.petioles.size() + 1);
  if (hasGrowingPoints(plan)) stems.push_back(growingPointStage(grammar, plan.growingPoint, options));
  const auto petiole = [&](std::size_t p) {
    return stemStage(grammar, plan.petioleStageOf(p), plan.petioles[p], plan.petioles[p] * kPetioleRadius, plan.digits, options);
  };
  if (!plan.petioles.empty()) stems.push_back(petiole(0));
  for (const PlannedSegment& s : plan.segments) stems.push_back(stemStage(grammar, s.stage, s.length, s.radius, plan.digits, options));
  for (std::size_t p = 1; p < plan.petioles.size(); ++p) stems.push_back(petiole(p));
  blockOf(grammar.plants.front(), OrganKind::Stem).stages = std::move(stems);

  std::vector<Stage> leaves;
  for (std::size_t l = 0; l < plan.leafStages.size(); ++l)
    leaves.push_back(leafStage(grammar, static_cast<int>(l) + 1, plan.leafStages[l], plan.digits, options));
  blockOf(grammar.plants.front(), OrganKind::Leaf).stages = std::move(leaves);
}

}  // namespace

std::string countOf(std::size_t count, const std::string& thing, const std::string& things) {
  return std::to_string(count) + " " + (count == 1 ? thing : things);
}

simeco::OrganBlock& blockOf(simeco::PlantGrammar& plant, OrganKind kind) {
  return *std::find_if(plant.organs.begin(), plant.organs.end(), [kind](const simeco::OrganBlock& block) { return block.kind == kind; });
}

Stage stemStage(Grammar& grammar, int number, double length, double radius, const Digits& digits, const EmitOptions& options) {
  return stemStage(grammar, number, Builder(grammar).number(length, digits.length), radius, digits, options);
}

Stage stemStage(Grammar& grammar, int number, simeco::ExprId length, double radius, const Digits& digits, const EmitOptions& options) {
  Builder b(grammar);
  Stage stage;
  stage.number = number;
  stage.attributes.reserve(5);
  stage.attributes.push_back(b.text("Model", options.stemModel));
  if (!options.stemTexture.empty()) stage.attributes.push_back(b.text("TextureFront", options.stemTexture));
  stage.attributes.push_back(b.attribute("GrowRate", length));
  stage.attributes.push_back(b.attribute("GrowTime", b.printed(1, kPlain)));
  stage.attributes.push_back(b.attribute("BroadenRate", b.number(radius / simeco::modelRadius, digits.length)));
  stage.attributes.push_back(colour(grammar, kStemColour));
  return stage;
}

Stage leafStage(Grammar& grammar, int number, const LeafStage& leaf, const Digits& digits, const EmitOptions& options) {
  Builder b(grammar);
  Stage stage;
  stage.number = number;
  stage.attributes.push_back(b.text("Model", leaf.shape.empty() ? "DefaultLeaf.i" : leaf.shape + ".i"));
  if (!options.leafTexture.empty()) stage.attributes.push_back(b.text("TextureFront", options.leafTexture));
  stage.attributes.push_back(b.attribute("GrowRate", b.number(leaf.length, digits.length)));
  stage.attributes.push_back(b.attribute("GrowTime", b.printed(1, kPlain)));
  if (leaf.width > 0) stage.attributes.push_back(b.attribute("BroadenRate", b.number(leaf.width / 2 / simeco::modelRadius, digits.length)));
  stage.attributes.push_back(colour(grammar, options.leafColour ? glm::dvec4(*options.leafColour, 1) : kLeafColour));
  return stage;
}

Stage growingPointStage(Grammar& grammar, double length, const EmitOptions& options) {
  Builder b(grammar);
  Stage stage;
  stage.number = 0;
  stage.attributes.push_back(b.text("Model", options.stemModel));
  if (!options.stemTexture.empty()) stage.attributes.push_back(b.text("TextureFront", options.stemTexture));
  // Always a power of ten, so that this many decimals hold it exactly.
  const int digits = std::max(kPlain, static_cast<int>(std::lround(-std::log10(length / kGrowingPointTime))));
  stage.attributes.push_back(b.attribute("GrowRate", b.number(length / kGrowingPointTime, digits)));
  stage.attributes.push_back(b.attribute("GrowTime", b.number(kGrowingPointTime, kPlain)));
  return stage;
}

Grammar emptyGrammar(const EmitOptions& options, const glm::dvec3& position, const glm::dvec3& direction, const Digits& digits) {
  Grammar grammar;
  Builder b(grammar);
  grammar.name = options.name;
  grammar.attributes = {b.attribute("SoilPH", b.number(7, kPlain)), b.attribute("RainRate", b.number(0.9, kPlain)), b.attribute("DayLight", b.number(12, kPlain))};
  simeco::PlantGrammar plant;
  plant.name = options.name;
  plant.attributes = {b.vector("Position", position, digits.length), b.vector("Direction", direction, digits.angle),
                      b.attribute("DeriveTime", b.number(options.deriveTime, kPlain))};
  for (const OrganKind kind : {OrganKind::Apex, OrganKind::Stem, OrganKind::Leaf, OrganKind::Root, OrganKind::Fruit, OrganKind::Flower}) {
    simeco::OrganBlock block;
    block.kind = kind;
    plant.organs.push_back(std::move(block));
  }
  plant.rules.label = "w";
  grammar.plants.push_back(std::move(plant));
  return grammar;
}

Assembled assembled(const Plan& plan, const EmitOptions& options) {
  Assembled out;
  out.grammar = emptyGrammar(options, plan.position.at, plan.direction, plan.digits);
  out.grammar.comments.before = heading(plan);
  constexpr std::size_t kExpressionsOfASegment = 16;
  out.grammar.expressions.reserve(kExpressionsOfASegment * (plan.segments.size() + 10));
  addStages(plan, out.grammar, options);
  RuleWriter(plan, out).write();
  return out;
}

}  // namespace axil::emit
