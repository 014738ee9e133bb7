#include "emit/statistical.hpp"

#include "base/text.hpp"
#include "emit/assembly.hpp"
#include "emit/habit_words.hpp"
#include "emit/plan.hpp"
#include "quantify/family.hpp"
#include "simeco/growth.hpp"
#include "simeco/language.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace axil::emit {

namespace {

using quantify::Along;
using quantify::Distribution;
using quantify::Extent;
using quantify::Family;
using quantify::FamilyOrder;
using quantify::Measurements;

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kNever = 0.005;                         // shares below are left out
constexpr double kSome = 0.03, kAll = 0.97;              // of nodes with leaves
constexpr double kNoBend = 0.2 * std::numbers::pi / 180;
constexpr const char* kAnySide = "random(-3.142, 3.142)";

/// Four significant digits; what rounding leaves of nothing is nothing.
std::string number(double value) {
  if (std::abs(value) < 1e-12) return "0";
  const int digits = std::clamp(3 - static_cast<int>(std::floor(std::log10(std::abs(value)))), 0, 15);
  return shortest(std::stod(fixed(value, digits)));
}
std::string degrees(double radians) { return fixed(radians * 180 / std::numbers::pi, 0); }
std::string percent(double share) { return fixed(100 * share, 0) + " %"; }
std::string times(const std::string& a, const std::string& b) { return b == "1" ? a : a == "1" ? b : a + "*" + b; }

/// One alternative of a rule, its weight as text ("" where there is no other).
struct Alternative {
  std::string weight;
  double share = 1;   ///< on average
  std::string modules;
};

class FamilyText {
 public:
  FamilyText(std::span<const Measurements> plants, const Family& family, std::vector<double> radii, const EmitOptions& options, int depth)
      : plants_(plants), m_(plants.front()), family_(family), radii_(std::move(radii)), options_(options), depth_(depth) {
    for (const FamilyOrder& o : family.orders) {
      arranged_ = arranged_ || isArranged(o);
      turning_ = turning_ || bends(o);
      ranked_ = ranked_ || o.fates.byRank.size() > 1 || o.along == Along::Rank || taper(o) != 1;
    }
    turning_ = turning_ && arranged_;
  }

  std::string text() {
    std::string rules;
    for (const FamilyOrder& o : family_.orders)
      if (o.order < depth_) rules += rulesOf(o);
    const std::string axiom = axiomText();
    std::string text = heading();
    text += "EcoSystem 1.1 \"" + options_.name + "\" {\nPlant \"" + options_.name + "\" {\nDeriveTime = " + shortest(options_.deriveTime) + ";\n";
    text += "Depth = " + std::to_string(depth_) + "; // branching orders that grow\n";
    if (family_.stages.form == Distribution::Form::Constant) text += "Stages = " + number(family_.stages.centre) + "; // segments of the first axis, at most\n";
    return text + organs() + "Grow {\n" + arrays_ + axiom + rules + "}\n}\n}\n";
  }

 private:
  [[nodiscard]] static bool bends(const FamilyOrder& o) { return o.bend.samples > 0 && (o.bend.centre > kNoBend || o.bend.spread > kNoBend); }
  [[nodiscard]] static bool hasLeaves(const FamilyOrder& o) { return o.leafShare > kNever && o.outlook.perNode > 0; }
  /// Whether the organs of its nodes keep a divergence.
  [[nodiscard]] bool isArranged(const FamilyOrder& o) const {
    if (!bearsBranches(o) && !hasLeaves(o)) return false;
    return o.outlook.startsAlike || (o.outlook.divergence != 0 && o.outlook.divergenceDeviation < 1);
  }
  [[nodiscard]] bool bearsBranches(const FamilyOrder& o) const {
    if (o.order + 1 >= depth_) return false;
    return std::any_of(o.fates.fates.begin(), o.fates.fates.end(), [](const auto& f) { return f.branches > 0 && f.share > kNever; }) ||
           std::any_of(o.ends.begin(), o.ends.end(), [](const auto& e) { return e.arms > 0 && e.share > kNever; });
  }
  [[nodiscard]] const FamilyOrder& above(const FamilyOrder& o) const { return o.lastOrder > o.order || &o == &family_.orders.back() ? o : *(&o + 1); }
  [[nodiscard]] bool manyOrders(const FamilyOrder& o) const { return o.lastOrder > o.order; }
  [[nodiscard]] std::size_t indexOf(const FamilyOrder& o) const { return static_cast<std::size_t>(&o - family_.orders.data()); }
  [[nodiscard]] double radiusOf(const FamilyOrder& o) const { return o.radius > 0 ? o.radius : radii_[indexOf(o)]; }
  [[nodiscard]] static double taper(const FamilyOrder& o) { return o.radius > 0 ? o.radiusStep : 1; }

  // ---- numbers that vary -------------------------------------------------------------------------------------------------

  /// "length" + "0", for arrays of an order.
  static std::string named(const std::string& what, const FamilyOrder& o) { return what + std::to_string(o.order); }
  std::string arrayOf(const std::string& name, const std::vector<double>& values) {
    std::string text = "array " + name + "[" + std::to_string(values.size()) + "] = {";
    for (std::size_t i = 0; i < values.size(); ++i) text += (i == 0 ? "" : ", ") + number(values[i]);
    if (!declared_.contains(name)) arrays_ += text + "};\n";
    declared_[name] = true;
    return name;
  }
  /// A draw of `d`; a table gets the name.
  std::string drawn(const Distribution& d, const std::string& name) {
    switch (d.form) {
      case Distribution::Form::Constant: return number(d.centre);
      case Distribution::Form::Normal: return "normal(" + number(d.centre) + ", " + number(d.spread) + ")";
      case Distribution::Form::Even: return "random(" + number(d.centre - d.spread) + ", " + number(d.centre + d.spread) + ")";
      case Distribution::Form::Table: return arrayOf(name, d.values) + "[floor(random(0, " + std::to_string(d.values.size()) + "))]";
    }
    return "0";
  }
  /// Lengths and angles stay positive.
  std::string positive(const Distribution& d, const std::string& name) {
    if (d.form == Distribution::Form::Normal && d.centre < 4.5 * d.spread) return "max(0, " + drawn(d, name) + ")";
    return drawn(d, name);
  }
  static std::string described(const Distribution& d, const std::string& unit, double factor) {
    const std::string centre = number(std::stod(fixed(d.centre * factor, d.centre * factor < 10 ? 3 : 1)));
    if (d.form == Distribution::Form::Constant) return centre + unit;
    const double deviation = d.form == Distribution::Form::Even ? d.spread / std::sqrt(3) : d.spread;
    return centre + " +- " + number(std::stod(fixed(deviation * factor, d.centre * factor < 10 ? 3 : 1))) + unit;
  }
  static std::string inDegrees(const Distribution& d) {
    const double factor = 180 / std::numbers::pi;
    if (d.form == Distribution::Form::Constant) return fixed(d.centre * factor, 1) + " degrees";
    return fixed(d.centre * factor, 1) + " +- " + fixed((d.form == Distribution::Form::Even ? d.spread / std::sqrt(3) : d.spread) * factor, 1) + " degrees";
  }

  // ---- apices ------------------------------------------------------------------------------------------------------------

  struct ApexText {
    std::string order, rank, length, around, side, left;
  };
  [[nodiscard]] std::string apex(const ApexText& a) const {
    return "A(" + a.order + (ranked_ ? ", " + a.rank : "") + ", " + a.length + (arranged_ ? ", " + a.around : "") + (turning_ ? ", " + a.side : "") + ", " + a.left + ")";
  }
  static std::string azimuth(double radians) { return number(roundedTo(radians, 4) + 0.0); }
  std::string newSide(const FamilyOrder& o) const {
    if (!bends(o)) return "0";
    if (!o.bendsToOneSide) return kAnySide;
    return o.sideDeviation < 1e-3 ? azimuth(o.side) : "normal(" + azimuth(o.side) + ", " + number(o.sideDeviation) + ")";
  }
  std::string firstAround(const FamilyOrder& o) const {
    if (!isArranged(o)) return "0";
    return o.outlook.startsAlike ? azimuth(o.outlook.firstAzimuth) : kAnySide;
  }
  /// What an axis may make, before it starts. `left` of its bearer after the node.
  std::string leftOf(const FamilyOrder& o) {
    if (o.extent == Extent::Stages) {
      const std::string left = "left-" + std::to_string(1 + o.delay);
      return o.most ? "min(" + std::to_string(*o.most) + ", " + left + ")" : left;
    }
    if (o.along == Along::Nothing) return drawn(o.own, named("segments", o));
    const std::string along = o.along == Along::Left ? "(left-1)" : "rank";
    return "max(1, round(" + (o.own.form == Distribution::Form::Constant ? number(o.own.centre) : drawn(o.own, named("segments", o))) + "+" + number(o.slope) + "*" + along + "))";
  }
  /// The first apex of an axis that `bearer` carries.
  std::string lateral(const FamilyOrder& bearer, const FamilyOrder& o, const std::string& start) {
    const std::string length = o.startsFromBearer ? times("length", start) : times(number(o.usual), start);
    const std::string order = manyOrders(bearer) ? "order+1" : std::to_string(bearer.order + 1);
    return apex({order, "0", length, firstAround(o), newSide(o), leftOf(o)});
  }

  std::string axiomText() {
    const FamilyOrder& first = family_.orders.front();
    std::string text = "// A(order" + std::string(ranked_ ? ", rank" : "") + ", length" + (arranged_ ? ", around" : "") + (turning_ ? ", side" : "") + ", left): an apex of that branching order; " +
                       (ranked_ ? "its next segment's rank and length" : "its next segment's length") + (arranged_ ? ", where that node's organs stand" : "") + (turning_ ? ", where the axis then bends to" : "") +
                       ", how many segments it may still make.\nw = ";
    for (int c = 0; c < family_.collarAxes && depth_ > 1; ++c) {
      const FamilyOrder& o = above(first);
      const std::string left = o.extent == Extent::Own && o.along == Along::Nothing ? leftOf(o) : stages();
      text += "[rotr(" + positive(first.insertion, named("insertion", first)) + ")rotu(" + kAnySide + ")" + apex({"1", "0", number(o.usual), firstAround(o), newSide(o), left}) + "] ";
    }
    return text + apex({"0", "0", firstLength(first), firstAround(first), newSide(first), stages()}) + ";\n";
  }
  /// Of the first axis of a plant; where axes of all orders are alike, theirs start from their bearers.
  std::string firstLength(const FamilyOrder& first) {
    return first.lastOrder > 0 ? number(family_.firstLength) : times(number(first.usual), positive(first.start, named("start", first)));
  }
  std::string stages() { return family_.stages.form == Distribution::Form::Constant ? "Stages" : drawn(family_.stages, "stages"); }

  // ---- organs ------------------------------------------------------------------------------------------------------------

  std::string organs() {
    std::string text = "Stem {\n";
    if (options_.stemModel != EmitOptions{}.stemModel) text += "Model = \"" + options_.stemModel + "\";\n";
    text += "Stage 1(length, radius) {\nGrowRate = length;\nBroadenRate = " + number(1 / simeco::modelRadius) + "*radius;\n}\n";
    std::string leaves;
    bool stalks = false;
    for (const FamilyOrder& o : family_.orders) {
      if (!hasLeaves(o) || o.order >= depth_) continue;
      stalks = stalks || o.outlook.petiole > 0;
      leaves += "Stage " + std::to_string(o.order + 1) + "(length) {\n";
      if (const std::string shape = leafShape(o); !shape.empty()) leaves += "Model = \"" + shape + ".i\";\n";
      leaves += "GrowRate = length;\n";
      if (o.outlook.leafWidth > 0) leaves += "BroadenRate = " + number(o.outlook.leafWidth / o.outlook.leafLength / 2 / simeco::modelRadius) + "*length;\n";
      if (o.outlook.leafLasts) leaves += "FallAge = " + number((*o.outlook.leafLasts + 0.5) * options_.deriveTime) + ";\n";
      leaves += "}\n";
    }
    if (stalks) text += "Stage 2(length) {\nGrowRate = length;\nBroadenRate = 8*length;\n}\n";
    text += "}\n";
    return leaves.empty() ? text : text + "Leaf {\n" + leaves + "}\n";
  }
  std::string leafShape(const FamilyOrder& o) const {
    const quantify::PlantStructure structure = quantify::plantStructure(m_, family_.statistics.stemEnds);
    std::string shape;
    for (std::size_t s = 0; s < m_.segments.size(); ++s)
      for (const auto& leaf : m_.segments[s].leaves)
        if (shape.empty() || structure.places[s].order == o.order) shape = leaf.shape;
    return shape;
  }

  std::string leavesOf(const FamilyOrder& o) {
    std::string text;
    const std::string around = isArranged(o) ? "around" : "";
    for (int l = 0; l < o.outlook.perNode; ++l) {
      const std::string turn = l == 0 ? "" : number(kTurn * l / o.outlook.perNode);
      const std::string azimuth = around.empty() ? kAnySide : turn.empty() ? around : around + "+" + turn;
      text += "[rotr(" + angle(o.outlook.leafAngle, o.outlook.leafAngleDeviation) + ")rotu(" + azimuth + ")";
      if (o.outlook.petiole > 0) text += "S(2, " + number(o.outlook.petiole) + ")";
      text += "L(" + std::to_string(o.order + 1) + ", " + positive(o.leafLength, named("leaf", o)) + ")] ";
    }
    return text;
  }
  static std::string angle(double mean, double deviation) {
    if (deviation < 1e-4) return number(mean);
    const std::string draw = "normal(" + number(mean) + ", " + number(deviation) + ")";
    return mean < 4.5 * deviation ? "max(0, " + draw + ")" : draw;
  }

  // ---- what a node bears ---------------------------------------------------------------------------------------------------

  std::string axesAt(const FamilyOrder& o, int count) {
    if (o.order + 1 >= depth_) return {};
    const FamilyOrder& next = above(o);
    const auto arms = o.arms.find(count);
    std::string text;
    const bool arranged = isArranged(o);
    for (int b = 0; b < count; ++b) {
      const double beside = std::remainder((hasLeaves(o) ? o.outlook.branchBesideLeaf : 0) + kTurn * b / count, kTurn);
      const std::string turn = std::abs(beside) < 1e-3 ? "" : (beside > 0 ? "+" : "") + number(beside);
      const quantify::FamilyArm arm = arms == o.arms.end() ? quantify::FamilyArm{o.insertion, next.start} : arms->second[static_cast<std::size_t>(b)];
      const std::string which = arms == o.arms.end() ? "" : "OfArm" + std::to_string(b + 1);
      // One after the other: each may need a table, and tables stand in the order in which they were needed first.
      const std::string axis = lateral(o, next, positive(arm.start, named("start" + which, which.empty() ? next : o)));
      const std::string insertion = positive(arm.insertion, named("insertion" + which, o));
      text += "[rotr(" + insertion + ")rotu(" + (arranged ? "around" + turn : kAnySide) + ")" + axis + "] ";
    }
    return text;
  }

  std::string segment(const FamilyOrder& o) {
    const std::string length = o.followsBelow ? "length" : times("length", positive(o.factor, named("length", o)));
    std::string radius = number(radiusOf(o));
    if (taper(o) != 1) radius += "*" + number(taper(o)) + "^rank";
    return "S(1, " + length + ", " + radius + ") ";
  }
  std::string goingOn(const FamilyOrder& o) {
    const std::string length = o.followsBelow ? times("length", positive(o.factor, named("length", o))) : times("length", std::abs(o.step - 1) < 5e-5 ? "1" : number(o.step));
    const bool turns = bends(o);
    std::string around = "0";
    if (isArranged(o)) {
      around = "around";
      const double by = o.outlook.divergence;
      if (o.outlook.divergenceDeviation > 1e-4) around += "+normal(" + number(by) + ", " + number(o.outlook.divergenceDeviation) + ")";
      else if (std::abs(by) > 1e-6) around += (by > 0 ? "+" : "") + number(by);
      if (turns) around += "-side";
    }
    const std::string order = manyOrders(o) ? "order" : std::to_string(o.order);
    const std::string next = apex({order, "rank+1", length, around, newSide(o), "left-1"});
    if (!turns) return next;
    return "rotr(" + positive(o.bend, named("bend", o)) + ")rotu(" + (turning_ ? "side" : newSide(o)) + ")" + next;
  }

  // ---- rules -------------------------------------------------------------------------------------------------------------

  /// Each alternative once with leaves and once without, where only some nodes have them.
  std::string joined(const FamilyOrder& o, const std::vector<Alternative>& alternatives) {
    std::vector<Alternative> all;
    const std::string leaves = hasLeaves(o) && o.leafShare >= kSome ? leavesOf(o) : "";
    const std::string stem = alternatives.empty() ? "" : segment(o);
    for (const Alternative& a : alternatives) {
      if (!hasLeaves(o) || o.leafShare > kAll || o.leafShare < kSome) {
        all.push_back({a.weight, a.share, stem + leaves + a.modules});
        continue;
      }
      all.push_back({times(a.weight.empty() ? "1" : a.weight, number(o.leafShare)), a.share * o.leafShare, stem + leaves + a.modules});
      all.push_back({times(a.weight.empty() ? "1" : a.weight, number(1 - o.leafShare)), a.share * (1 - o.leafShare), stem + a.modules});
    }
    std::string text;
    for (const Alternative& a : all) {
      const bool plain = a.weight.find_first_not_of("0123456789.") == std::string::npos;
      text += text.empty() ? "" : "| ";
      if (all.size() > 1) text += (plain ? a.weight : "(" + a.weight + ")") + ": ";
      text += a.modules + " ";
    }
    return text;
  }

  /// What becomes of a node with more to come. Orders that may bear nothing go on instead.
  std::vector<Alternative> midway(const FamilyOrder& o) {
    const bool bears = bearsBranches(o);
    std::vector<std::size_t> fates;
    for (std::size_t f = 0; f < o.fates.fates.size(); ++f)
      if (o.fates.fates[f].share >= kNever) fates.push_back(f);
    std::vector<Alternative> all;
    for (const std::size_t f : fates) {
      const quantify::Fate& fate = o.fates.fates[f];
      const std::string on = fate.goesOn ? goingOn(o) : "";
      const std::string modules = axesAt(o, bears ? fate.branches : 0) + on;
      const auto same = std::find_if(all.begin(), all.end(), [&](const Alternative& a) { return a.modules == modules; });
      const std::string weight = o.fates.byRank.size() < 2 ? number(fate.share) : fates.size() == 2 && f == fates.front() ? "(1-" + byRank(o, fates.back()) + ")" : byRank(o, f);
      if (same == all.end()) all.push_back({weight, fate.share, modules});
      else *same = {"(" + same->weight + "+" + weight + ")", same->share + fate.share, modules};
    }
    if (all.size() == 1) all.front().weight = "1";
    return all;
  }
  /// "branching0[min(rank, 8)]"
  std::string byRank(const FamilyOrder& o, std::size_t f) {
    const quantify::Fate& fate = o.fates.fates[f];
    std::vector<double> shares;
    for (const auto& row : o.fates.byRank) shares.push_back(row[f]);
    const std::string what = fate.goesOn ? (fate.branches > 0 ? "branching" : "goingOn") : (fate.branches > 0 ? "forking" : "ending");
    const std::string name = arrayOf(named(what + (fate.branches > 1 ? std::to_string(fate.branches) + "Of" : ""), o), shares);
    const std::string size = std::to_string(shares.size());
    return name + (o.fates.shape == quantify::FateTable::Shape::Periodic ? "[rank%" + size + "]" : "[min(rank, " + std::to_string(shares.size() - 1) + ")]");
  }
  std::vector<Alternative> atTheEnd(const FamilyOrder& o) {
    std::vector<Alternative> all;
    if (o.extent == Extent::Stages || !bearsBranches(o)) return {{"", 1, ""}};
    for (const auto& end : o.ends)
      if (end.share >= kNever) all.push_back({number(end.share), end.share, axesAt(o, end.arms)});
    return all;
  }

  std::string rulesOf(const FamilyOrder& o) {
    const std::string order = manyOrders(o) ? "order" : std::to_string(o.order);
    const std::string head = apex({order, "rank", "length", "around", "side", "left"}) + " : ";
    const std::string when = manyOrders(o) ? "order < Depth && " : o.order > 0 ? "Depth > " + std::to_string(o.order) + " && " : "";
    std::string text = commentOf(o) + head + when + "left > 1 -> " + joined(o, midway(o)) + ";\n";
    return text + "// The last segment of such an axis.\n" + head + when + "left > 0 -> " + joined(o, atTheEnd(o)) + ";\n";
  }

  std::string commentOf(const FamilyOrder& o) const {
    std::string text = "// " + std::string(manyOrders(o) ? "Orders " + std::to_string(o.order) + " and above" : "Order " + std::to_string(o.order)) + ", from " +
                       countOf(o.segments, "segment", "segments") + " of " + countOf(o.axes, "axis", "axes") + ": " + lengthWords(o) + "; " + extentWords(o) + ".\n";
    std::string more;
    if (bends(o)) more += "bends by " + inDegrees(o.bend);
    if (bearsBranches(o)) more += (more.empty() ? "" : "; ") + branchWords(o);
    if (hasLeaves(o)) more += (more.empty() ? "" : "; ") + countOf(static_cast<std::size_t>(o.outlook.perNode), "leaf", "leaves") + " at " + percent(o.leafShare) + " of the nodes (" + std::to_string(o.leafLength.samples) + " measured)";
    if (isArranged(o) && std::abs(o.outlook.divergence) > 1e-6) more += (more.empty() ? "" : "; ") + std::string("from node to node ") + degrees(o.outlook.divergence) + " degrees around";
    if (!more.empty()) text += "// It " + more + ".\n";
    return text;
  }
  std::string lengthWords(const FamilyOrder& o) const {
    std::string words = "a segment is " + (o.followsBelow ? described(o.factor, "", 1) + " times the one below" : std::string(o.step == 1 ? "about as long as the others" : number(o.step) + " times the one below, with chance"));
    words += ", the first " + (o.startsFromBearer ? described(o.start, "", 1) + " times its bearer" : "about " + number(o.usual) + " " + m_.unit);
    return words;
  }
  static double endingShare(const FamilyOrder& o) {
    double share = 0;
    for (const quantify::Fate& f : o.fates.fates) share += f.goesOn ? 0 : f.share;
    return share;
  }
  std::string extentWords(const FamilyOrder& o) const {
    if (o.extent == Extent::Stages)
      return "it grows as long as its bearer" + std::string(o.delay > 0 ? ", " + std::to_string(o.delay) + " later" : "") + (o.most ? ", to " + std::to_string(*o.most) + " segments" : "") +
             (endingShare(o) >= kNever ? ", each node ending it with " + percent(endingShare(o)) : "");
    const double usual = static_cast<double>(o.segments) / static_cast<double>(std::max<std::size_t>(1, o.axes));
    return "it makes " + number(std::stod(fixed(usual, 1))) + " segments" + (o.along == Along::Left ? ", more where its bearer has more to go" : o.along == Along::Rank ? (o.slope > 0 ? ", more the higher it stands" : ", fewer the higher it stands") : "");
  }
  std::string branchWords(const FamilyOrder& o) const {
    std::string words = "bears";
    std::string list;
    for (const quantify::Fate& f : o.fates.fates)
      if (f.share >= kNever && f.branches > 0)
        list += (list.empty() ? " " : ", ") + countOf(static_cast<std::size_t>(f.branches), f.goesOn ? "branch" : "arm", f.goesOn ? "branches" : "arms") + " at " + percent(f.share);
    words += o.nodes > 0 ? list + " of " + countOf(o.nodes, "node", "nodes") : "";
    for (const auto& end : o.ends)
      if (end.arms > 0 && end.share >= kNever) words += (o.nodes > 0 ? ", " : " ") + countOf(static_cast<std::size_t>(end.arms), "axis", "axes") + " at " + percent(end.share) + " of its ends";
    return words + ", leaving at " + inDegrees(o.insertion) + " (" + std::to_string(o.insertion.samples) + " measured)";
  }

  std::string heading() const {
    std::string text = "// Plants like " + (family_.plants == 1 ? std::string("a measured one") : std::to_string(family_.plants) + " measured ones") + "; each seed grows another.\n// Habit: " + habitWords(plants_) + ".\n";
    for (const std::string& warning : family_.statistics.warnings) text += "// Warning: " + warning + ".\n";
    return text;
  }
  std::span<const Measurements> plants_;
  const Measurements& m_;
  const Family& family_;
  std::vector<double> radii_;   ///< of each of the family's orders, where none was measured
  const EmitOptions& options_;
  int depth_;
  bool arranged_ = false;
  bool turning_ = false;
  bool ranked_ = false;
  std::string arrays_;
  std::map<std::string, bool> declared_;
};

/// Radii by the pipe model, the median of each order's.
std::vector<double> usualRadii(const Measurements& m, const Plan& plan, const Family& family) {
  const quantify::PlantStructure structure = quantify::plantStructure(m, family.statistics.stemEnds);
  std::vector<double> all;
  for (const PlannedSegment& s : plan.segments) all.push_back(s.radius);
  std::vector<double> radii;
  for (const FamilyOrder& o : family.orders) {
    std::vector<double> own;
    for (std::size_t s = 0; s < structure.places.size(); ++s)
      if (structure.places[s].order >= o.order && structure.places[s].order <= o.lastOrder) own.push_back(plan.segments[s].radius);
    if (own.empty()) own = all;
    std::sort(own.begin(), own.end());
    radii.push_back(own[own.size() / 2]);
  }
  return radii;
}

}  // namespace

Result<simeco::Grammar> statisticalGrammar(const Measurements& m, const EmitOptions& options, const StructureOptions& wanted) {
  const Result<Plan> plan = planOf(m, options);
  if (!plan) return plan.failure();
  std::vector<Measurements> plants{m};
  plants.insert(plants.end(), wanted.also.begin(), wanted.also.end());
  const auto family = quantify::familyOf(plants);
  if (!family) return family.failure();
  const int depth = std::min(wanted.orders.value_or(family->deepest), family->deepest);
  const std::string text = FamilyText(plants, *family, usualRadii(m, *plan, *family), options, depth).text();
  simeco::Parsed parsed = simeco::parseSimeco(text);
  AXIL_ASSERT(parsed.ok(), "a statistical grammar must parse");
  return std::move(parsed.grammar);
}

}  // namespace axil::emit
