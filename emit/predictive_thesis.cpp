#include "emit/predictive_thesis.hpp"

#include "emit/assembly.hpp"
#include "emit/builder.hpp"
#include "emit/plan.hpp"
#include "quantify/statistics.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace axil::emit {

namespace {

using quantify::Measurements;
using quantify::RuleTemplate;
using quantify::Segment;
using quantify::Spread;
using simeco::BinaryOp;
using simeco::ExprId;
using simeco::Module;
using simeco::OrganKind;

/// The numbers that the prediction uses beside those of the initial grammar; the thesis' own unless the plant needs them.
struct Numbers {
  int firstCount = 1002;
  int lastCount = 1003;
  int firstApex = 1003;
  int firstMarker = 5003;
};

/// When counters start and how long they run, in derivation steps.
struct Clock {
  int firstTip = 0;  ///< the step in which the first counter appears
  int settled = 0;   ///< the step after which the initial plant is complete
};

bool isTip(const PlannedSegment& segment) { return segment.children.empty(); }

Clock clockOf(const Plan& plan, const Assembled& initial) {
  Clock clock{initial.bornAt.back() + 1, 0};
  for (std::size_t s = 0; s < plan.segments.size(); ++s) {
    if (!isTip(plan.segments[s])) continue;
    clock.firstTip = std::min(clock.firstTip, initial.bornAt[s] + 1);
    clock.settled = std::max(clock.settled, initial.bornAt[s] + 1);
  }
  return clock;
}

Numbers numbersFor(const Clock& clock, int firstFreeStage, int firstFreeApex) {
  const int thousand = 1000 * (1 + std::max(firstFreeStage, firstFreeApex) / 1000);
  Numbers numbers;
  numbers.firstCount = thousand + 2;
  numbers.firstApex = thousand + 3;
  numbers.lastCount = numbers.firstCount + clock.settled - clock.firstTip + 1;
  numbers.firstMarker = std::max(thousand + 4003, 1000 * (1 + numbers.lastCount / 1000) + 3);
  return numbers;
}

/// Adds what the prediction needs to the initial grammar.
class Predictor {
 public:
  Predictor(const Measurements& m, const Plan& plan, const EmitOptions& options, std::vector<RuleTemplate> templates, Assembled initial)
      : m_(m), plan_(plan), options_(options), templates_(std::move(templates)), out_(std::move(initial)), builder_(out_.grammar),
        nextStage_(plan.firstFreeStage()), nextLeaf_(static_cast<int>(plan.leafStages.size()) + 1) {}

  simeco::Grammar predicted() {
    std::map<std::size_t, std::vector<Module>> successors;  // by template, of those that a tip needs
    for (std::size_t s = 0; s < plan_.segments.size(); ++s)
      if (const std::size_t t = templateOf(s); isTip(plan_.segments[s]) && !successors.contains(t)) successors[t] = successorOf(templates_[t]);
    clock_ = clockOf(plan_, out_);
    numbers_ = numbersFor(clock_, nextStage_, out_.firstFreeApex);
    for (std::size_t s = 0; s < plan_.segments.size(); ++s)
      if (isTip(plan_.segments[s])) addCounter(s);
    addStepRule();
    for (auto& [t, successor] : successors) addTemplateRules(t, std::move(successor));
    out_.grammar.version = "1.1";
    out_.grammar.comments.before.push_back("// Then predicts one stage: every tip goes on like the part of the plant that it came from.");
    return std::move(out_.grammar);
  }

 private:
  simeco::RuleSet& rules() { return out_.grammar.plants.front().rules; }
  std::vector<simeco::Stage>& stages(OrganKind kind) { return blockOf(out_.grammar.plants.front(), kind).stages; }

  /// `random(low, high)`, or the number itself where it does not vary.
  ExprId drawn(const Spread& spread) { return drawn(spread, plan_.digits.angle); }
  ExprId drawn(const Spread& spread, int digits) {
    if (rounded(spread.low, digits) == rounded(spread.high, digits)) return builder_.number(spread.low, digits);
    return builder_.call("random", {builder_.number(spread.low, digits), builder_.number(spread.high, digits)});
  }
  void drawnTurn(std::vector<Module>& to, const Spread& rotr, const Spread& rotu) {
    to.push_back(Builder::module("rotr", {drawn(rotr)}));
    to.push_back(Builder::module("rotu", {drawn(rotu)}));
  }

  int newStem(const Spread& length, double radius) {
    stages(OrganKind::Stem).push_back(stemStage(out_.grammar, nextStage_, drawn(length, plan_.digits.length), radius, plan_.digits, options_));
    return nextStage_++;
  }
  int newLeaf(const quantify::LeafSpread& leaf, const std::string& shape) {
    stages(OrganKind::Leaf).push_back(leafStage(out_.grammar, nextLeaf_, {leaf.length.mean, leaf.width.mean, shape}, plan_.digits, options_));
    return nextLeaf_++;
  }

  [[nodiscard]] double thinnest() const {
    double radius = plan_.segments.front().radius;
    for (const PlannedSegment& s : plan_.segments) radius = std::min(radius, s.radius);
    return radius;
  }

  void addLeaf(std::vector<Module>& to, const quantify::LeafSpread& leaf, const std::string& shape) {
    to.push_back(Builder::module("["));
    drawnTurn(to, leaf.rotr, leaf.rotu);
    to.push_back(builder_.organ("S", leaf.petiole.mean > 0 ? newStem(leaf.petiole, thinnest()) : 0));
    const Spread none;
    drawnTurn(to, none, leaf.roll);
    to.push_back(builder_.organ("L", newLeaf(leaf, shape)));
    to.push_back(Builder::module("]"));
  }

  std::vector<Module> successorOf(const RuleTemplate& pattern) {
    std::vector<Module> next;
    const Segment& example = m_.at(pattern.members.front());
    for (std::size_t l = 0; l < pattern.leaves.size(); ++l) addLeaf(next, pattern.leaves[l], example.leaves[l].shape);
    for (std::size_t c = 0; c < pattern.children.size(); ++c) {
      const bool bracketed = c < pattern.structure.branches;
      if (bracketed) next.push_back(Builder::module("["));
      drawnTurn(next, pattern.children[c].rotr, pattern.children[c].rotu);
      next.push_back(builder_.organ("S", newStem(pattern.children[c].length, thinnest())));
      if (bracketed) next.push_back(Builder::module("]"));
    }
    return next;
  }

  /// The template of the rule that made this segment; for one that leaves the collar, the commonest.
  [[nodiscard]] std::size_t templateOf(std::size_t segment) const {
    const auto& parent = m_.segments[segment].parent;
    const auto fits = [&](const RuleTemplate& t) { return parent && t.structure == quantify::structureOf(m_.at(*parent)); };
    const auto commoner = [](const RuleTemplate& a, const RuleTemplate& b) { return a.members.size() < b.members.size(); };
    const auto found = std::find_if(templates_.begin(), templates_.end(), fits);
    const auto chosen = found != templates_.end() ? found : std::max_element(templates_.begin(), templates_.end(), commoner);
    return static_cast<std::size_t>(chosen - templates_.begin());
  }
  [[nodiscard]] int markerOf(std::size_t t) const { return numbers_.firstMarker + static_cast<int>(t); }
  [[nodiscard]] int apexOf(std::size_t t) const { return numbers_.firstApex + static_cast<int>(t); }

  void addCounter(std::size_t s) {
    const std::size_t t = templateOf(s);
    const int start = numbers_.firstCount + out_.bornAt[s] + 1 - clock_.firstTip;
    const std::vector<Module> counter{builder_.organ("S", start), builder_.organ("S", markerOf(t))};
    if (!out_.ruleOf[s]) {
      rules().productions.push_back(Builder::rule({builder_.organ("S", plan_.segments[s].stage)}, counter));
      return;
    }
    std::vector<Module>& successor = rules().productions[*out_.ruleOf[s]].successors.front().modules;
    successor.insert(successor.end(), counter.begin(), counter.end());
  }

  void addStepRule() {
    const ExprId next = builder_.binary(BinaryOp::Add, builder_.name("i"), builder_.whole(1));
    simeco::Production step = Builder::rule({Builder::module("S", {builder_.name("i")})}, {Builder::module("S", {next})});
    step.condition = out_.grammar.add(simeco::Chain{{builder_.whole(numbers_.firstCount - 1), builder_.name("i"), builder_.whole(numbers_.lastCount)},
                                                    {BinaryOp::Less, BinaryOp::Less}});
    step.conditionPlace = simeco::ConditionPlace::InSuccessor;
    step.comments.before = {"// The clock: all counters run out together, when the measured plant is complete."};
    rules().productions.push_back(std::move(step));
  }

  void addTemplateRules(std::size_t t, std::vector<Module> successor) {
    simeco::Production wake = Builder::rule({builder_.organ("S", numbers_.lastCount)}, {builder_.organ("A", apexOf(t))});
    wake.right = {builder_.organ("S", markerOf(t))};
    const RuleTemplate& pattern = templates_[t];
    wake.comments.before = {"// Template " + std::to_string(t + 1) + ", from " + countOf(pattern.members.size(), "measured place", "measured places") +
                            ": the stem goes on, " + countOf(pattern.structure.branches, "branch", "branches") + ", " +
                            countOf(pattern.structure.leaves, "leaf", "leaves") + "."};
    rules().productions.push_back(std::move(wake));
    rules().productions.push_back(Builder::rule({builder_.organ("A", apexOf(t))}, std::move(successor)));
  }

  const Measurements& m_;
  const Plan& plan_;
  const EmitOptions& options_;
  std::vector<RuleTemplate> templates_;
  Assembled out_;
  Builder builder_;
  int nextStage_;
  int nextLeaf_;
  Clock clock_;
  Numbers numbers_;
};

}  // namespace

Result<simeco::Grammar> thesisGrammar(const Measurements& measurements, const EmitOptions& options) {
  const Result<Plan> plan = planOf(measurements, options);
  if (!plan) return plan.failure();
  std::vector<RuleTemplate> templates = quantify::templatesOf(measurements);
  if (templates.empty())
    return fail(ErrorCode::NoAnswer, "nothing can be predicted: no segment of the plant has a child, so nothing shows how it goes on; measure it with more nodes");
  return Predictor(measurements, *plan, options, std::move(templates), assembled(*plan, options)).predicted();
}

}  // namespace axil::emit
