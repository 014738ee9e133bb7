#include "emit/predictive.hpp"

#include "base/text.hpp"
#include "emit/assembly.hpp"
#include "emit/plan.hpp"
#include "emit/predictive_expressions.hpp"
#include "emit/predictive_thesis.hpp"
#include "emit/predictive_words.hpp"
#include "emit/unmade.hpp"
#include "quantify/outlook.hpp"
#include "quantify/statistics.hpp"
#include "simeco/growth.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

namespace axil::emit {

namespace {

using quantify::Fate;
using quantify::Measurements;
using quantify::OrderOutlook;
using quantify::Outlook;
using simeco::BinaryOp;
using simeco::ExprId;
using simeco::Module;
using simeco::OrganKind;

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kNoBend = 0.2 * std::numbers::pi / 180;
constexpr double kLongest = 2;          // a trend that grows stops at this many times the longest measured
constexpr const char* kNames[] = {"rank", "length", "around", "side", "wait", "left"};

/// One alternative of a rule; its share, by rank where a table says so.
struct Choice {
  double share = 1;
  std::optional<ExprId> byRank = {};
  std::vector<Module> modules = {};
};

/// What an apex starts with. Expressions, so that rules can hand them on.
struct ApexStart {
  ExprId rank;
  ExprId length;
  ExprId around;
  ExprId wait;
  ExprId left;
};

class Predictor : PredictiveExpressions {
 public:
  Predictor(const Measurements& m, const Plan& plan, const EmitOptions& options, const PredictiveOptions& predictive, Outlook outlook, Assembled initial)
      : PredictiveExpressions(std::move(initial), plan.digits, outlook.now() + predictive.stages), m_(m), plan_(plan), options_(options), predictive_(predictive), outlook_(std::move(outlook)),
        firstStem_(plan.firstFreeStage()), nextLeaf_(static_cast<int>(plan.leafStages.size()) + 1) {
    firstApex_ = 1000 * (1 + std::max(firstStem_, out_.firstFreeApex) / 1000);
    firstBud_ = firstApex_ + 1000 * (1 + topOrder() / 1000);
    firstStart_ = firstBud_ + 1000 * (1 + topOrder() / 1000);
    for (const quantify::Segment& s : m.segments) longest_ = std::max(longest_, s.length);
    thinnest_ = plan.segments.front().radius;
    for (const PlannedSegment& s : plan.segments) thinnest_ = std::min(thinnest_, s.radius);
    setTimes();
  }

  simeco::Grammar predicted() {
    ageLeaves();
    for (const auto& bud : outlook_.buds) addBud(bud);
    for (const auto& tip : outlook_.tips) addTip(tip);
    if (!outlook_.tips.empty() || !outlook_.buds.empty()) {
      addStages();
      addClock();
      for (int order = 0; order <= topOrder(); ++order) addBudRule(order);
      for (int order = 0; order <= topOrder(); ++order) addStartRule(order);
      for (int order = 0; order <= topOrder(); ++order) addOrderRules(outlook_.of(order));
    }
    dropUnmade(out_.grammar, firstApex_);
    out_.grammar.version = "1.1";
    addHeading();
    return std::move(out_.grammar);
  }

 private:
  [[nodiscard]] int topOrder() const { return static_cast<int>(outlook_.orders.size()) - 1; }
  [[nodiscard]] int capped(int order) const { return std::min(order, topOrder()); }
  [[nodiscard]] int apexOf(int order) const { return firstApex_ + capped(order); }
  [[nodiscard]] int budOf(int order) const { return firstBud_ + capped(order); }
  [[nodiscard]] int startOf(int order) const { return firstStart_ + capped(order); }
  [[nodiscard]] int stemOf(int order) const { return firstStem_ + 2 * capped(order); }
  [[nodiscard]] int petioleOf(int order) const { return firstStem_ + 2 * capped(order) + 1; }
  [[nodiscard]] int leafOf(int order) const { return firstLeaf_ + capped(order); }
  simeco::RuleSet& rules() { return out_.grammar.plants.front().rules; }
  std::vector<simeco::Stage>& stages(OrganKind kind) { return blockOf(out_.grammar.plants.front(), kind).stages; }

  // ---- apices --------------------------------------------------------------------------------------------------------

  Module apex(int number, const ApexStart& start, bool turns) {
    return Builder::module("A", {builder_.whole(number), start.rank, start.length, start.around, turns ? anySide() : builder_.whole(0), start.wait, start.left});
  }
  std::vector<ExprId> named(int number) {
    std::vector<ExprId> arguments{builder_.whole(number)};
    for (const char* word : kNames) arguments.push_back(name(word));
    return arguments;
  }
  static bool bends(const OrderOutlook& o) { return o.bend.value > kNoBend; }

  // ---- time ----------------------------------------------------------------------------------------------------------

  void setTimes() {
    int lastBorn = 0;
    for (std::size_t s = 0; s < plan_.segments.size(); ++s) {
      lastBorn = std::max(lastBorn, out_.bornAt[s]);
      lastOrgan_ = std::max(lastOrgan_, out_.bornAt[s] + (plan_.segments[s].leaves.empty() ? 0 : 1));
    }
    // Nothing new is born before the last measured organ, which takes a unit of time, is complete.
    wake_ = std::max(lastBorn + 2, lastOrgan_ + static_cast<int>(std::ceil(1 / options_.deriveTime)));
  }
  [[nodiscard]] double ageAtMeasuring(std::size_t segment) const { return (lastOrgan_ - out_.bornAt[segment] - 1) * options_.deriveTime + 1; }

  // ---- the measured plant's own leaves ---------------------------------------------------------------------------------

  /// Gives leaves that will still grow or fall a stage of their own.
  void ageLeaves() {
    const quantify::PlantStructure structure = quantify::plantStructure(m_, outlook_.statistics.stemEnds);
    for (std::size_t s = 0; s < plan_.segments.size(); ++s) {
      if (plan_.segments[s].leaves.empty() || !out_.ruleOf[s]) continue;
      std::size_t leaf = 0;
      for (Module& module : rules().productions[*out_.ruleOf[s]].successors.front().modules) {
        if (module.letter != "L") continue;
        const quantify::LeafMeasure& measured = *plan_.segments[s].leaves[leaf].measure;
        if (const auto stage = agedStage(s, structure.places[s], measured, plan_.segments[s].leaves[leaf].leafStage)) module.arguments = {builder_.whole(*stage)};
        if (++leaf == plan_.segments[s].leaves.size()) break;
      }
    }
    firstLeaf_ = nextLeaf_;
  }

  std::optional<int> agedStage(std::size_t segment, const quantify::SegmentPlace& place, const quantify::LeafMeasure& leaf, int like) {
    const OrderOutlook& o = outlook_.of(place.order);
    const bool onGrowingAxis = outlook_.statistics.schedule.plants.front().grows[static_cast<std::size_t>(place.axis.value)];
    const double stagesOld = place.fromTip + (o.leafAtOwnTip ? 1 : 0);
    const double more = o.leafStages - stagesOld;
    const double final = more > 0 ? std::max(leaf.length, o.leafLength) : leaf.length;
    const bool grows = onGrowingAxis && more > 0 && final > 1.02 * leaf.length;
    const bool falls = onGrowingAxis && o.leafLasts.has_value();
    if (!grows && !falls) return std::nullopt;
    const double age = ageAtMeasuring(segment);
    // The stage a measured leaf has, copied and given its future.
    const auto& existing = stages(OrganKind::Leaf);
    simeco::Stage stage = *std::find_if(existing.begin(), existing.end(), [like](const simeco::Stage& st) { return st.number == like; });
    stage.number = nextLeaf_++;
    if (grows) {
      setNumber(stage, "GrowRate", valueOf(stage, "GrowRate") / age);
      setNumber(stage, "GrowTime", age * final / leaf.length);
      if (const double broaden = valueOf(stage, "BroadenRate"); broaden > 0) setNumber(stage, "BroadenRate", broaden / age);
    }
    if (falls) {
      const double left = std::max(0.5, *o.leafLasts - place.fromTip);
      stage.attributes.push_back(builder_.attribute("FallAge", builder_.number(age + (left - 0.5) * options_.deriveTime + (wake_ - lastOrgan_) * options_.deriveTime - 1, 4)));
    }
    stages(OrganKind::Leaf).push_back(std::move(stage));
    return nextLeaf_ - 1;
  }

  [[nodiscard]] double valueOf(const simeco::Stage& stage, const std::string& attribute) const {
    for (const simeco::Attribute& a : stage.attributes)
      if (const auto* number = a.name == attribute ? std::get_if<simeco::Number>(&out_.grammar.at(a.value).node) : nullptr) return number->value;
    return 0;
  }
  void setNumber(simeco::Stage& stage, const std::string& attribute, double value) {
    for (simeco::Attribute& a : stage.attributes)
      if (a.name == attribute) a.value = builder_.number(value, -1);
  }

  // ---- where the prediction is tied to the plant -----------------------------------------------------------------------

  int stagesLeft(int order, double stagesOld) const {
    const auto& lasting = outlook_.of(order).schedule.lasting;
    return lasting ? std::clamp(static_cast<int>(std::lround(*lasting - stagesOld)), 0, predictive_.stages) : predictive_.stages;
  }

  void addTip(const quantify::TipOutlook& tip) {
    const auto s = static_cast<std::size_t>(tip.tip.value);
    const OrderOutlook& o = outlook_.of(tip.order);
    const auto& own = outlook_.statistics.schedule.plants.front();
    const double stagesOld = own.now - own.birth[s] + tip.nextRank;
    const ApexStart start{builder_.whole(tip.nextRank), size(tip.length), angle(std::remainder(tip.azimuth, kTurn)), builder_.whole(wake_ - out_.bornAt[s] - 2),
                          builder_.whole(stagesLeft(tip.order, stagesOld))};
    const Module module = apex(apexOf(tip.order), start, bends(o));
    if (!out_.ruleOf[s]) {
      rules().productions.push_back(Builder::rule({builder_.organ("S", plan_.segments[s].stage)}, {module}));
      return;
    }
    rules().productions[*out_.ruleOf[s]].successors.front().modules.push_back(module);
  }

  void addBud(const quantify::BudOutlook& bud) {
    const auto s = static_cast<std::size_t>(bud.at.value);
    const OrderOutlook& o = outlook_.of(bud.order);
    const int wait = std::max(0, wake_ - out_.bornAt[s] - 3) + bud.waits;
    const ApexStart start{builder_.whole(0), size(bud.length), angle(0), builder_.whole(wait), builder_.whole(std::max(0, predictive_.stages - bud.waits))};
    std::vector<Module> modules{Builder::module("[")};
    turn(modules, drawnAngle(o.insertion.value, 0), angle(std::remainder(bud.rotu, kTurn)));
    modules.push_back(apex(budOf(bud.order), start, false));
    modules.push_back(Builder::module("]"));
    auto& successor = rules().productions[*out_.ruleOf[s]].successors.front().modules;
    successor.insert(successor.begin() + 1, modules.begin(), modules.end());
    budShares_[capped(bud.order)] = bud.share;
  }

  // ---- new organs ------------------------------------------------------------------------------------------------------

  void addStages() {
    for (int order = 0; order <= topOrder(); ++order) {
      const OrderOutlook& o = outlook_.of(order);
      simeco::Stage stage = stemStage(out_.grammar, stemOf(order), name("length"), o.radius > 0 ? o.radius : thinnest_, plan_.digits, options_);
      stage.parameters = {"length"};
      stages(OrganKind::Stem).push_back(std::move(stage));
      if (o.perNode > 0 && o.petiole > 0) stages(OrganKind::Stem).push_back(stemStage(out_.grammar, petioleOf(order), o.petiole, thinnest_, plan_.digits, options_));
      if (o.perNode > 0) stages(OrganKind::Leaf).push_back(newLeafStage(o));
    }
  }

  simeco::Stage newLeafStage(const OrderOutlook& o) {
    simeco::Stage stage = leafStage(out_.grammar, leafOf(o.order), {o.leafLength, o.leafWidth, leafShape(o.order)}, plan_.digits, options_);
    const double time = o.leafStages > 1 ? o.leafStages * options_.deriveTime : 1;
    for (simeco::Attribute& a : stage.attributes) {
      if (a.name == "GrowTime") a.value = builder_.number(time, 6);
      if (a.name == "GrowRate") a.value = varied(size(o.leafLength / time), o.leafDeviation);
      if (a.name == "BroadenRate") a.value = builder_.number(o.leafWidth / 2 / simeco::modelRadius / time, plan_.digits.length);
    }
    if (o.leafLasts) stage.attributes.push_back(builder_.attribute("FallAge", builder_.number((*o.leafLasts + 0.5) * options_.deriveTime, 4)));
    return stage;
  }

  std::string leafShape(int order) const {
    const std::vector<int> orders = quantify::ordersOf(m_);
    std::string shape;
    for (std::size_t s = 0; s < m_.segments.size(); ++s)
      for (const auto& leaf : m_.segments[s].leaves)
        if (shape.empty() || orders[s] == order) shape = leaf.shape;
    return shape;
  }

  void addLeaves(std::vector<Module>& to, const OrderOutlook& o, ExprId around) {
    for (int l = 0; l < o.perNode; ++l) {
      to.push_back(Builder::module("["));
      turn(to, drawnAngle(o.leafAngle, o.leafAngleDeviation), l == 0 ? around : plus(around, angle(kTurn * l / o.perNode)));
      if (o.petiole > 0) to.push_back(builder_.organ("S", petioleOf(o.order)));
      to.push_back(builder_.organ("L", leafOf(o.order)));
      to.push_back(Builder::module("]"));
    }
  }

  ExprId leftAfter(int order, int stagesLater) {
    const ExprId left = minus(name("left"), builder_.whole(stagesLater));
    const auto& lasting = outlook_.of(order).schedule.lasting;
    return lasting ? builder_.call("min", {left, builder_.whole(std::max(0, static_cast<int>(std::lround(*lasting)) - 1))}) : left;
  }

  /// A new axis' first segment and its apex. `length` is foretold; leaves at its own tip where leaves come so.
  void startAxis(std::vector<Module>& to, const OrderOutlook& o, ExprId length, ExprId left, double leafShare) {
    to.push_back(Builder::module("S", {builder_.whole(stemOf(o.order)), varied(length, o.startMiss)}));
    const ExprId around = o.startsAlike ? angle(o.firstAzimuth) : angle(0);
    if (o.leafAtOwnTip && leafShare > 0.5) addLeaves(to, o, around);
    const bool byStage = o.length.along == quantify::LengthsAlong::Stage;
    const ExprId second = byStage ? carriedOn(o, length, stageNow()) : scaled(length, std::exp(o.length.at(1) - o.length.at(0)));
    const ApexStart next{builder_.whole(1), second, around, builder_.whole(0), left};
    to.push_back(apex(apexOf(o.order), next, bends(o)));
  }

  /// The foretold length of an axis that branches off. The bearer is the segment below the one whose length an apex knows.
  ExprId branchLength(const OrderOutlook& bearer, const OrderOutlook& o, double armRatio) {
    if (o.start == quantify::StartRule::Usual) return size(o.usualLength);
    if (o.start == quantify::StartRule::Stage) return usualAt(o, bearer.delay == 0 ? stageNow() : plus(stageNow(), builder_.whole(bearer.delay)));
    return carriedBack(bearer, name("length"), armRatio, courseAt(bearer, name("rank"), 1));
  }

  /// What branches off at an apex' node.
  void addBranches(std::vector<Module>& to, const OrderOutlook& bearer, int count) {
    const OrderOutlook& o = outlook_.of(bearer.order + 1);
    const auto arms = bearer.arms.find(count);
    for (int b = 0; b < count; ++b) {
      const quantify::ArmOutlook arm = arms == bearer.arms.end() ? quantify::ArmOutlook{o.insertion, o.bearerRatio} : arms->second[static_cast<std::size_t>(b)];
      const ExprId length = branchLength(bearer, o, arm.ratio);
      const double beside = std::remainder(bearer.branchBesideLeaf + kTurn * b / count, kTurn);
      to.push_back(Builder::module("["));
      turn(to, drawnAngle(arm.insertion.value, arm.insertion.deviation), std::abs(beside) < 1e-4 ? name("around") : plus(name("around"), angle(beside)));
      if (bearer.delay == 0) {
        startAxis(to, o, length, leftAfter(o.order, 1), o.leafShare);
      } else {
        const ApexStart later{builder_.whole(0), length, angle(0), builder_.whole(bearer.delay - 1), leftAfter(o.order, bearer.delay)};
        to.push_back(apex(startOf(o.order), later, false));
        needsStart_[capped(o.order)] = true;
      }
      to.push_back(Builder::module("]"));
    }
  }

  /// What an apex makes of a fate, with or without the leaves of this stage.
  std::vector<Module> successorOf(const OrderOutlook& o, const Fate& fate, bool leaves) {
    std::vector<Module> to;
    if (leaves && !o.leafAtOwnTip) addLeaves(to, o, name("around"));
    addBranches(to, o, fate.branches);
    if (!fate.goesOn) return to;
    const bool bent = bends(o);
    if (bent) turn(to, drawnAngle(o.bend.value, o.bend.deviation), name("side"));
    to.push_back(Builder::module("S", {builder_.whole(stemOf(o.order)), varied(name("length"), o.length.miss)}));
    // The next node's organs stand further round; a bend has rolled the frame by `side`.
    const double divergence = std::abs(o.divergence) < 1e-6 ? 0 : o.divergence;
    ExprId around = name("around");
    if (divergence != 0) around = plus(around, drawnAngle(divergence, o.divergenceDeviation));
    if (bent) around = minus(around, name("side"));
    if (leaves && o.leafAtOwnTip) addLeaves(to, o, around);
    ExprId length = carriedOn(o, name("length"), courseAt(o, name("rank"), 0));
    if (growsOn(o.length)) length = builder_.call("min", {length, size(kLongest * longest_)});
    to.push_back(apex(apexOf(o.order), {plus(name("rank"), builder_.whole(1)), length, around, builder_.whole(0), minus(name("left"), builder_.whole(1))}, bent));
    return to;
  }

  /// "branch2Of1": nodes of order 1 that go on with two branches.
  static std::string fateName(const Fate& fate, int order) {
    const std::string what = fate.goesOn ? (fate.branches > 0 ? "branch" : "goOn") : (fate.branches > 0 ? "fork" : "end");
    return what + (fate.branches > 1 ? std::to_string(fate.branches) : "") + "Of" + std::to_string(order);
  }
  /// The share of a fate, from a table by the rank of the node that an apex stands at: that of the segment below it.
  ExprId shareByRank(const OrderOutlook& o, std::size_t fate) {
    const quantify::FateTable& table = o.fates;
    const std::string array = fateName(table.fates[fate], o.order);
    simeco::ArrayDeclaration declaration{array, {static_cast<int>(table.byRank.size())}, {}};
    for (const auto& row : table.byRank) declaration.initial.push_back(ratio(row[fate]));
    auto& arrays = rules().arrays;
    if (std::none_of(arrays.begin(), arrays.end(), [&](const auto& a) { return a.name == array; })) arrays.push_back(std::move(declaration));
    const int rows = static_cast<int>(table.byRank.size());
    const bool periodic = table.shape == quantify::FateTable::Shape::Periodic;
    const ExprId row = periodic ? builder_.binary(BinaryOp::Remainder, plus(name("rank"), builder_.whole(rows - 1)), builder_.whole(rows))
                                : builder_.call("min", {minus(name("rank"), builder_.whole(1)), builder_.whole(rows - 1)});
    return out_.grammar.add(simeco::Element{array, {row}});
  }

  std::vector<Choice> choicesOf(const OrderOutlook& o) {
    std::vector<Choice> choices;
    const double rate = o.schedule.steady ? 1 : o.schedule.rate;
    const double leafShare = o.perNode > 0 ? o.leafShare : 0;
    const bool chance = leafShare > 0.1 && leafShare < 0.9;
    const bool table = o.fates.byRank.size() > 1;
    const auto add = [&](std::size_t f, double share, bool leaves) {
      const Fate& fate = o.fates.fates[f];
      choices.push_back({share * (table ? 1 : fate.share), {}, successorOf(o, fate, leaves)});
      if (table) choices.back().byRank = shareByRank(o, f);
    };
    for (std::size_t f = 0; f < o.fates.fates.size(); ++f) {
      if (o.fates.fates[f].share < kRare) continue;
      add(f, rate * (chance ? leafShare : 1), chance || leafShare >= 0.9);
      if (chance) add(f, rate * (1 - leafShare), false);
    }
    if (rate < 1 - kRare) {
      auto same = named(apexOf(o.order));
      same.back() = minus(name("left"), builder_.whole(1));
      choices.push_back({1 - rate, {}, {Builder::module("A", std::move(same))}});
    }
    return choices;
  }

  // ---- rules -----------------------------------------------------------------------------------------------------------

  void addRule(int number, ExprId condition, std::vector<Choice> choices, std::vector<std::string> comments) {
    double sum = 0;
    for (const Choice& c : choices) sum += c.share;
    if (sum <= 0) return;
    // Shares from tables add up to one by themselves.
    if (std::any_of(choices.begin(), choices.end(), [](const Choice& c) { return c.byRank.has_value(); })) sum = 1;
    simeco::Production rule;
    rule.predecessor = {Builder::module("A", named(number))};
    rule.condition = condition;
    rule.conditionPlace = simeco::ConditionPlace::AfterColon;
    for (Choice& c : choices) {
      rule.successors.push_back({std::move(c.modules), std::nullopt});
      if (choices.size() < 2) continue;
      const double share = std::max(1e-4, c.share / sum);
      rule.successors.back().weight = !c.byRank ? ratio(share) : share > 1 - 1e-9 ? *c.byRank : times(ratio(share), *c.byRank);
    }
    rule.comments.before = std::move(comments);
    rules().productions.push_back(std::move(rule));
  }

  /// One clock a kind of apex: all wait until the measured plant is complete.
  void addClock() {
    bool first = true;
    for (int order = 0; order <= topOrder(); ++order)
      for (const int number : {apexOf(order), budOf(order), startOf(order)}) {
        auto next = named(number);
        next[next.size() - 2] = minus(name("wait"), builder_.whole(1));
        simeco::Production rule = Builder::rule({Builder::module("A", named(number))}, {});
        rule.successors.front().modules = {Builder::module("A", std::move(next))};
        rule.condition = builder_.binary(BinaryOp::Greater, name("wait"), builder_.whole(0));
        if (first) rule.comments.before = {"// The clock: apices wait until the measured plant is complete."};
        first = false;
        rules().productions.push_back(std::move(rule));
      }
  }

  ExprId alive() { return builder_.binary(BinaryOp::Greater, name("left"), builder_.whole(0)); }

  void addBudRule(int order) {
    if (!budShares_.contains(order)) return;
    needsStart_[order] = true;
    const double share = std::clamp(budShares_.at(order), 0.0, 1.0);
    std::vector<Choice> choices{{share, {}, {Builder::module("A", named(startOf(order)))}}};
    if (share < 1 - kRare) choices.push_back({1 - share});
    addRule(budOf(order), alive(), std::move(choices), {"// Nodes that were too young to branch: " + fixed(100 * share, 0) + " % of them will."});
  }

  void addStartRule(int order) {
    const OrderOutlook& o = outlook_.of(order);
    std::vector<Module> modules;
    startAxis(modules, o, name("length"), leftAfter(order, 1), o.leafShare);
    pendingStart_[order] = std::move(modules);
  }

  void addOrderRules(const OrderOutlook& o) {
    ExprId condition = alive();
    if (o.most) condition = builder_.binary(BinaryOp::And, condition, builder_.binary(BinaryOp::Less, name("rank"), builder_.whole(*o.most)));
    addRule(apexOf(o.order), condition, choicesOf(o), commentsFor(o));
    for (auto& [order, modules] : pendingStart_)
      if (needsStart_[order] && !modules.empty()) {
        addRule(startOf(order), alive(), {{1, {}, std::move(modules)}}, {"// A branch of order " + std::to_string(order) + " begins."});
        modules.clear();
      }
  }

  void addHeading() {
    int depth = 0;
    for (const auto& s : m_.segments) depth = std::max(depth, s.level + 1);
    auto& lines = out_.grammar.comments.before;
    lines.push_back("// Then predicts " + countOf(static_cast<std::size_t>(predictive_.stages), "stage", "stages") + ", by the statistics of " +
                    countOf(outlook_.statistics.plants, "plant", "plants") + ", from step " + std::to_string(wake_) + " on; no path gets longer than " + std::to_string(depth + predictive_.stages) +
                    " segments.");
    if (outlook_.tips.empty() && outlook_.buds.empty()) lines.push_back("// All axes have ended: there is nothing to predict.");
    else lines.push_back("// A(n, rank, length, around, side, wait, left): an apex; its next segment's rank and foretold length, where the node's organs stand, where it bends to, steps to wait, stages left.");
    for (const std::string& warning : outlook_.statistics.warnings) lines.push_back("// Warning: " + warning + ".");
  }

  const Measurements& m_;
  const Plan& plan_;
  const EmitOptions& options_;
  const PredictiveOptions& predictive_;
  Outlook outlook_;
  int firstStem_;
  int nextLeaf_;
  int firstLeaf_ = 0;
  int firstApex_ = 0;
  int firstBud_ = 0;
  int firstStart_ = 0;
  int lastOrgan_ = 0;  ///< the step in which the last measured organ is born
  int wake_ = 0;       ///< the step in which the first predicted organs are born
  double longest_ = 0;
  double thinnest_ = 0;
  std::map<int, double> budShares_;
  std::map<int, bool> needsStart_;
  std::map<int, std::vector<Module>> pendingStart_;
};

Result<simeco::Grammar> layeredGrammar(const Measurements& measurements, const EmitOptions& options, const PredictiveOptions& predictive) {
  const Result<Plan> plan = planOf(measurements, options);
  if (!plan) return plan.failure();
  std::vector<Measurements> plants{measurements};
  plants.insert(plants.end(), predictive.also.begin(), predictive.also.end());
  auto outlook = quantify::outlookOf(plants);
  if (!outlook) return outlook.failure();
  return Predictor(measurements, *plan, options, predictive, std::move(*outlook), assembled(*plan, options)).predicted();
}

}  // namespace

Result<simeco::Grammar> predictiveGrammar(const Measurements& measurements, const EmitOptions& options, const PredictiveOptions& predictive) {
  if (predictive.stages < 1 || predictive.stages > kMostStages)
    return fail(ErrorCode::BadInput, std::to_string(predictive.stages) + " stages ahead are not possible; give 1 to " + std::to_string(kMostStages));
  if (predictive.style == PredictiveStyle::Layered) return layeredGrammar(measurements, options, predictive);
  if (predictive.stages != 1 || !predictive.also.empty())
    return fail(ErrorCode::BadInput, "the thesis' style predicts one stage from one plant; leave its style out for more");
  return thesisGrammar(measurements, options);
}

}  // namespace axil::emit
