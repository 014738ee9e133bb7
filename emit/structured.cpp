#include "emit/structured.hpp"

#include "base/text.hpp"
#include "emit/assembly.hpp"
#include "emit/builder.hpp"
#include "emit/exact.hpp"
#include "emit/plan.hpp"
#include "quantify/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace axil::emit {

namespace {

using quantify::Measurements;
using quantify::OrderStatistics;
using quantify::Spread;
using simeco::BinaryOp;
using simeco::ExprId;
using simeco::Module;
using simeco::OrganKind;

constexpr int kStageOfOrder = 10;  // stem stages 10, 20, ... of order 0, 1, ...; the stalk of its leaves is one more
constexpr double kEvenly = std::numbers::pi / 3;  // angles around a stem that spread further than this favour no side

std::string percent(double share) { return fixed(100 * share, 0) + " %"; }

std::string spreadText(const Spread& s, const std::string& unit) {
  return shortest(roundedTo(s.mean, 3)) + " +- " + shortest(roundedTo(s.deviation, 3)) + " " + unit;
}

std::string degreesText(const Spread& s) {
  const double d = 180 / std::numbers::pi;
  return fixed(s.mean * d, 1) + " +- " + fixed(s.deviation * d, 1) + " degrees";
}

/// The mean number of leaves on a segment, as a whole number.
std::size_t usualLeaves(const OrderStatistics& order) {
  double mean = 0;
  for (std::size_t k = 0; k < order.leafShares.size(); ++k) mean += order.leafShares[k] * static_cast<double>(k);
  return static_cast<std::size_t>(std::lround(mean));
}

std::map<int, std::string> leafShapes(const Measurements& m) {
  std::map<int, std::string> shapes;
  const std::vector<int> orders = quantify::ordersOf(m);
  for (std::size_t s = 0; s < m.segments.size(); ++s)
    for (const quantify::LeafMeasure& leaf : m.segments[s].leaves) shapes.emplace(orders[s], leaf.shape);
  return shapes;
}

/// The mean radius of each order, measured or made up.
std::map<int, double> meanRadii(const Measurements& m, const Plan& plan) {
  std::map<int, std::vector<double>> radii;
  const std::vector<int> orders = quantify::ordersOf(m);
  for (std::size_t s = 0; s < m.segments.size(); ++s) radii[orders[s]].push_back(plan.segments[s].radius);
  std::map<int, double> means;
  for (const auto& [order, values] : radii) means[order] = quantify::spreadOf(values).mean;
  return means;
}

class Structurer {
 public:
  Structurer(const Measurements& m, const Plan& plan, const EmitOptions& options, std::vector<OrderStatistics> orders)
      : m_(m), plan_(plan), options_(options), orders_(std::move(orders)),
        grammar_(emptyGrammar(options, plan.position.at, plan.direction, plan.digits)), builder_(grammar_), shapes_(leafShapes(m)), radii_(meanRadii(m, plan)) {}

  simeco::Grammar structured() {
    grammar_.version = "1.1";
    grammar_.comments.before = {"// Plants like a measured one of " + std::to_string(m_.segments.size()) + " segments; each seed grows another.",
                                "// A(order, n): an apex of that branching order that still makes n segments."};
    rules().axiom = axiom();
    for (const OrderStatistics& order : orders_) {
      addStages(order);
      addGoingOn(order);
      addEnding(order);
    }
    return std::move(grammar_);
  }

 private:
  simeco::RuleSet& rules() { return grammar_.plants.front().rules; }
  std::vector<simeco::Stage>& stages(OrganKind kind) { return blockOf(grammar_.plants.front(), kind).stages; }
  static int stemStageOf(const OrderStatistics& order) { return kStageOfOrder * (order.order + 1); }
  /// Of an axis; at least one to end it, and one before that where branches are to leave.
  static int segmentsOf(const OrderStatistics& order) {
    return std::max(order.insertion.count > 0 ? 2 : 1, static_cast<int>(std::lround(order.segmentsPerAxis.mean)));
  }
  [[nodiscard]] bool isLast(const OrderStatistics& order) const { return order.order == orders_.back().order; }

  /// What leaves the collar leaves it as measured.
  std::vector<Module> axiom() {
    std::vector<Module> modules;
    for (const std::size_t s : plan_.collarBranches) {
      if (orders_.size() < 2) break;
      modules.push_back(Builder::module("["));
      builder_.turn(modules, plan_.segments[s].turn, plan_.digits.angle);
      modules.push_back(apex(1, builder_.whole(segmentsOf(orders_[1]))));
      modules.push_back(Builder::module("]"));
    }
    modules.push_back(apex(0, builder_.whole(segmentsOf(orders_.front()))));
    return modules;
  }

  Module apex(int order, ExprId left) { return Builder::module("A", {builder_.whole(order), left}); }

  ExprId around(const Spread& spread) {
    const int digits = plan_.digits.angle;
    if (spread.deviation < kEvenly) return drawn(spread);
    return builder_.call("random", {builder_.number(-std::numbers::pi, digits), builder_.number(std::numbers::pi, digits)});
  }
  ExprId drawn(const Spread& spread) {
    const int digits = plan_.digits.angle;
    if (rounded(spread.deviation, digits) == 0) return builder_.number(spread.mean, digits);
    return builder_.call("normal", {builder_.number(spread.mean, digits), builder_.number(spread.deviation, digits)});
  }
  void turn(std::vector<Module>& to, ExprId rotr, ExprId rotu) {
    to.push_back(Builder::module("rotr", {rotr}));
    to.push_back(Builder::module("rotu", {rotu}));
  }

  /// Drawn for each segment; never shorter than a tenth of the mean, which a normal distribution would allow.
  ExprId drawnLength(const Spread& spread) {
    const int digits = plan_.digits.length;
    const ExprId mean = builder_.number(spread.mean, digits);
    if (rounded(spread.deviation, digits) == 0) return mean;
    const ExprId normal = builder_.call("normal", {mean, builder_.number(spread.deviation, digits)});
    return builder_.call("max", {builder_.number(spread.mean / 10, digits), normal});
  }

  void addStages(const OrderStatistics& order) {
    stages(OrganKind::Stem).push_back(stemStage(grammar_, stemStageOf(order), drawnLength(order.length), radii_.at(order.order), plan_.digits, options_));
    if (usualLeaves(order) == 0) return;
    if (order.leaf.petiole.mean > 0)
      stages(OrganKind::Stem).push_back(stemStage(grammar_, stemStageOf(order) + 1, order.leaf.petiole.mean, radii_.at(order.order) / 3, plan_.digits, options_));
    const LeafStage leaf{order.leaf.length.mean, order.leaf.width.mean, shapes_.at(order.order)};
    stages(OrganKind::Leaf).push_back(leafStage(grammar_, order.order + 1, leaf, plan_.digits, options_));
  }

  void addLeaves(std::vector<Module>& to, const OrderStatistics& order) {
    const std::size_t count = usualLeaves(order);
    for (std::size_t l = 0; l < count; ++l) {
      to.push_back(Builder::module("["));
      // Leaves of one segment stand evenly around it.
      const double turnShare = 2 * std::numbers::pi * static_cast<double>(l) / static_cast<double>(count);
      const ExprId base = around(order.leaf.rotu);
      turn(to, drawn(order.leaf.rotr), l == 0 ? base : builder_.binary(BinaryOp::Add, base, builder_.number(turnShare, plan_.digits.angle)));
      if (order.leaf.petiole.mean > 0) to.push_back(builder_.organ("S", stemStageOf(order) + 1));
      to.push_back(builder_.organ("L", order.order + 1));
      to.push_back(Builder::module("]"));
    }
  }

  void addBranches(std::vector<Module>& to, const OrderStatistics& order, std::size_t count) {
    for (std::size_t b = 0; b < count; ++b) {
      to.push_back(Builder::module("["));
      turn(to, drawn(order.insertion), around(order.divergence));
      to.push_back(apex(order.order + 1, builder_.whole(segmentsOf(orders_[static_cast<std::size_t>(order.order) + 1]))));
      to.push_back(Builder::module("]"));
    }
  }

  simeco::Successor goingOn(const OrderStatistics& order, std::size_t branches) {
    simeco::Successor successor;
    successor.modules.push_back(builder_.organ("S", stemStageOf(order)));
    addLeaves(successor.modules, order);
    addBranches(successor.modules, order, branches);
    turn(successor.modules, drawn(order.bend), around(order.bendAround));
    successor.modules.push_back(apex(order.order, builder_.binary(BinaryOp::Subtract, builder_.name("n"), builder_.whole(1))));
    return successor;
  }

  /// While segments are left: a segment, what leaves its tip with the frequencies measured, and the axis goes on.
  void addGoingOn(const OrderStatistics& order) {
    if (segmentsOf(order) < 2) return;
    simeco::Production rule;
    rule.predecessor = {apex(order.order, builder_.name("n"))};
    rule.condition = builder_.binary(BinaryOp::Greater, builder_.name("n"), builder_.whole(1));
    rule.conditionPlace = simeco::ConditionPlace::InPredecessor;
    std::vector<double> shares = isLast(order) || order.branchShares.empty() ? std::vector<double>{1} : order.branchShares;
    for (std::size_t k = 0; k < shares.size(); ++k) {
      if (shares[k] <= 0) continue;
      rule.successors.push_back(goingOn(order, k));
      if (shares[k] < 1) rule.successors.back().weight = builder_.number(shares[k], plan_.digits.angle);
    }
    rule.comments.before = commentsFor(order, shares);
    rules().productions.push_back(std::move(rule));
  }

  /// The last segment of an axis, and what leaves its tip.
  void addEnding(const OrderStatistics& order) {
    std::vector<Module> successor{builder_.organ("S", stemStageOf(order))};
    addLeaves(successor, order);
    simeco::Production rule = Builder::rule({apex(order.order, builder_.whole(1))}, std::move(successor));
    if (segmentsOf(order) < 2) rule.comments.before = commentsFor(order, {});
    rules().productions.push_back(std::move(rule));
  }

  std::vector<std::string> commentsFor(const OrderStatistics& order, const std::vector<double>& shares) const {
    std::vector<std::string> lines{"// Order " + std::to_string(order.order) + ": " + std::to_string(order.segmentsPerAxis.count) + " axes of " +
                                   fixed(order.segmentsPerAxis.mean, 1) + " segments, each " + spreadText(order.length, m_.unit) + " long; from one to the next " +
                                   degreesText(order.bend) + "."};
    if (isLast(order) || order.insertion.count == 0) return lines;
    std::string counts;
    for (std::size_t k = 0; k < shares.size(); ++k)
      if (shares[k] > 0) counts += (counts.empty() ? "" : ", ") + std::to_string(k) + " (" + percent(shares[k]) + ")";
    lines.push_back("// Branches at a node: " + counts + "; they leave at " + degreesText(order.insertion) + ", measured on " + std::to_string(order.insertion.count) + ".");
    return lines;
  }

  const Measurements& m_;
  const Plan& plan_;
  const EmitOptions& options_;
  std::vector<OrderStatistics> orders_;
  simeco::Grammar grammar_;
  Builder builder_;
  std::map<int, std::string> shapes_;
  std::map<int, double> radii_;
};

}  // namespace

Result<simeco::Grammar> structuredGrammar(const Measurements& measurements, const EmitOptions& options, const StructureOptions& structure) {
  if (structure.orders && *structure.orders < 1) return fail(ErrorCode::BadInput, std::to_string(*structure.orders) + " branching orders are not possible; keep at least 1");
  if (!(structure.maximumError > 0 && structure.maximumError <= 0.5) || !(structure.detail > 0 && std::isfinite(structure.detail)))
    return fail(ErrorCode::BadInput, "an error of " + shortest(structure.maximumError) + " of the height or a detail of " + shortest(structure.detail) +
                                         " is not possible; give an error above 0 up to 0.5 and a detail above 0");
  const Result<Plan> plan = planOf(measurements, options);
  if (!plan) return plan.failure();
  if (structure.form == StructuredForm::Exact) return exactGrammar(measurements, options, structure);
  std::vector<OrderStatistics> orders = quantify::orderStatistics(measurements);
  if (structure.orders && static_cast<std::size_t>(*structure.orders) < orders.size()) orders.resize(static_cast<std::size_t>(*structure.orders));
  return Structurer(measurements, *plan, options, std::move(orders)).structured();
}

}  // namespace axil::emit
