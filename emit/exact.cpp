#include "emit/exact.hpp"

#include "base/text.hpp"
#include "emit/assembly.hpp"
#include "emit/exact_plan.hpp"
#include "emit/habit_words.hpp"
#include "emit/plan.hpp"
#include "quantify/structure.hpp"
#include "simeco/language.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <map>
#include <set>

namespace axil::emit {

namespace {

using quantify::Measurements;
using quantify::PlantStructure;

constexpr double kAccuracy = 0.001;  // of the height: how well a node is measured, which description length counts errors against
constexpr double kReadable = 0.03;   // of the description, that a divergence in the rules may cost

std::string number(double value) {
  const std::string text = shortest(value);
  if (text.find('e') == std::string::npos) return text;
  return fixed(value, std::clamp(2 - static_cast<int>(std::floor(std::log10(std::abs(value)))), 0, 17));
}
std::string percent(double share) { return shortest(roundedTo(100 * share, 1)) + " %"; }

/// A grammar's text while it is written: whether a table is needed is decided once, and rules only name what is.
class ExactText {
 public:
  ExactText(const Measurements& m, const ExactLayout& layout, const ExactPlan& plan, const EmitOptions& options)
      : m_(m), layout_(layout), plan_(plan), options_(options) {}

  std::string text() {
    heading();
    line("EcoSystem 1.1 \"" + options_.name + "\" {");
    line("Plant \"" + options_.name + "\" {");
    if (plan_.position != glm::dvec3{0, 0, 0}) line("Position = " + vector(plan_.position) + ";");
    if (plan_.direction != glm::dvec3{0, 1, 0}) line("Direction = " + vector(plan_.direction) + ";");
    line("DeriveTime = " + number(options_.deriveTime) + ";");
    line("Depth = " + std::to_string(layout_.orders) + "; // branching orders that grow");
    stages();
    line("Grow {");
    usualTables();
    rowTables();
    axiom();
    apexRule();
    if (hasBranches()) budRule();
    if (hasLeaves()) leafRules();
    line("}\n}\n}");
    return std::move(text_);
  }

 private:
  void line(const std::string& content) { text_ += content + "\n"; }
  static std::string vector(const glm::dvec3& v) { return "vector(" + number(v.x) + ", " + number(v.y) + ", " + number(v.z) + ")"; }
  [[nodiscard]] bool hasBranches() const { return layout_.orderOf.size() > 1; }
  [[nodiscard]] bool hasLeaves() const { return !layout_.leafOf.empty(); }
  [[nodiscard]] bool hasStalks() const {
    const auto some = [](int steps) { return steps != 0; };
    return plan_.petiole > 0 || std::any_of(plan_.stalked.begin(), plan_.stalked.end(), some) || std::any_of(plan_.leafRoll.begin(), plan_.leafRoll.end(), some);
  }

  // ---- what the plant is like, in words ----

  void heading() {
    line("// Regrows a measured plant of " + countOf(m_.segments.size(), "segment", "segments") + " and " + countOf(layout_.leafOf.size(), "leaf", "leaves") + ", " +
         shortest(roundedTo(plan_.height, 3)) + " " + m_.unit + " high; its nodes stand within " + percent(plan_.worst) + " of that (mean " + percent(plan_.mean) + ").");
    line("// Habit: " + habitWords(std::span(&m_, 1)) + ".");
  }
  // ---- organs ----

  void stages() {
    line("Stem {");
    if (options_.stemModel != EmitOptions{}.stemModel) line("Model = \"" + options_.stemModel + "\";");
    line("Stage 1(length, radius) {\nGrowRate = length;\nBroadenRate = 100*radius;\n}");
    if (hasStalks()) line("Stage 2(length) {\nGrowRate = length;\nBroadenRate = 8*length;\n}");
    line("}");
    if (!hasLeaves()) return;
    line("Leaf {");
    for (std::size_t s = 0; s < plan_.shapes.size(); ++s) {
      line("Stage " + std::to_string(s + 1) + "(length) {");
      if (!plan_.shapes[s].empty()) line("Model = \"" + plan_.shapes[s] + ".i\";");
      line("GrowRate = length;");
      if (plan_.leafWidth > 0) line("BroadenRate = " + number(roundedTo(50 * plan_.leafWidth, 6)) + "*length;");
      line("}");
    }
    line("}");
  }

  // ---- tables ----

  template <class Values>
  void table(const std::string& name, const Values& values) {
    std::string text = "array " + name + "[" + std::to_string(values.size()) + "] = {";
    for (std::size_t i = 0; i < values.size(); ++i) text += (i == 0 ? "" : ", ") + number(static_cast<double>(values[i]));
    line(text + "};");
    tables_.insert(name);
  }
  /// Only where something is not 0.
  template <class Values>
  void tableIfNeeded(const std::string& name, const Values& values) {
    if (std::any_of(values.begin(), values.end(), [](auto value) { return value != 0; })) table(name, values);
  }
  [[nodiscard]] bool has(const std::string& name) const { return tables_.contains(name); }
  /// " + step*name[index]", where there is such a table.
  [[nodiscard]] std::string plus(double step, const std::string& name, const std::string& index) const {
    return has(name) ? "+" + number(step) + "*" + name + "[" + index + "]" : "";
  }
  [[nodiscard]] std::string usual(const std::string& name) const {
    const auto alike = alike_.find(name);
    return alike != alike_.end() ? alike->second : has(name) ? name + "[order]" : "0";
  }
  [[nodiscard]] std::string plusUsual(const std::string& name, const std::string& factor = "") const { return usual(name) == "0" ? "" : "+" + usual(name) + factor; }

  /// What is usual by order: a table; a number where all orders that have any are alike.
  template <class Get>
  void usualTable(const std::string& name, Get get, std::size_t OrderUsual::*samples) {
    std::set<std::string> values;
    for (const OrderUsual& u : plan_.usual)
      if (u.*samples > 0) values.insert(number(get(u)));
    if (values.size() > 1) table(name, byOrder(get));
    else if (!values.empty()) alike_[name] = *values.begin();
  }

  template <class Get>
  std::vector<double> byOrder(Get get) const {
    std::vector<double> values;
    for (const OrderUsual& u : plan_.usual) values.push_back(get(u));
    return values;
  }
  void usualTables() {
    table("internode", byOrder([](const OrderUsual& u) { return u.length; }));
    const auto shrink = byOrder([](const OrderUsual& u) { return u.shrink; });
    if (std::any_of(shrink.begin(), shrink.end(), [](double s) { return s != 1; })) table("shrink", shrink);
    if (!plan_.radiusMeasured) table("thickness", plan_.radii);
    usualTable("bend", [](const OrderUsual& u) { return u.bend; }, &OrderUsual::segments);
    if (hasBranches()) {
      usualTable("insertion", [](const OrderUsual& u) { return u.insertion; }, &OrderUsual::branches);
      usualTable("divergence", [](const OrderUsual& u) { return u.divergence; }, &OrderUsual::branches);
      usualTable("azimuth", [](const OrderUsual& u) { return u.azimuth; }, &OrderUsual::branches);
      usualTable("apart", [](const OrderUsual& u) { return u.apart; }, &OrderUsual::branches);
    }
    if (!hasLeaves()) return;
    usualTable("leafAngle", [](const OrderUsual& u) { return u.leafAngle; }, &OrderUsual::leaves);
    usualTable("leafDivergence", [](const OrderUsual& u) { return u.leafDivergence; }, &OrderUsual::leaves);
    usualTable("leafAzimuth", [](const OrderUsual& u) { return u.leafAzimuth; }, &OrderUsual::leaves);
    usualTable("leafApart", [](const OrderUsual& u) { return u.leafApart; }, &OrderUsual::leaves);
  }
  template <class T>
  static std::vector<T> withEnd(std::vector<T> values) {
    values.push_back(0);  // read by the last apex, which makes nothing more
    return values;
  }
  void rowTables() {
    table("start", layout_.start);
    if (hasBranches()) table("side", layout_.side);
    tableIfNeeded("longer", plan_.length);
    tableIfNeeded("bent", withEnd(plan_.bend));
    tableIfNeeded("turned", withEnd(plan_.around));
    if (plan_.radiusMeasured) tableIfNeeded("thinner", plan_.thin);
    if (!hasLeaves()) return;
    table("leaves", layout_.leaves);
    tableIfNeeded("leafBent", plan_.leafBend);
    tableIfNeeded("leafTurned", plan_.leafAround);
    tableIfNeeded("leafRoll", plan_.leafRoll);
    tableIfNeeded("small", plan_.small);
    tableIfNeeded("stalked", plan_.stalked);
    if (plan_.shapes.size() > 1) table("shape", plan_.shape);
  }

  // ---- rules ----

  void axiom() {
    line("// By [order] what is usual (radians); by [row], axis after axis, how many steps one is longer, bent, turned. start: an axis' first row;");
    line("// side" + std::string(hasLeaves() ? ", leaves: first axis, leaf there." : ": first axis there."));
    std::string text = "w = ";
    if (layout_.collarLeaves > 0) text += "L(0, 0, 0, " + std::to_string(layout_.collarLeaves) + ", " + number(plan_.usual.front().leafAzimuth) + ") ";
    if (layout_.collarAxes > 0) text += "A(0, 0, 1, " + std::to_string(1 + layout_.collarAxes) + ", 0) ";
    line(text + "A(0, 0, 0, 0);");
  }
  std::string samples(std::size_t OrderUsual::*count) const {
    std::string words;
    for (const OrderUsual& u : plan_.usual) words += (words.empty() ? "" : ", ") + std::to_string(u.*count);
    return words;
  }

  void apexRule() {
    line("// Apex of an axis: segment after segment. By order from " + samples(&OrderUsual::segments) + " segments of " + samples(&OrderUsual::axes) + " axes.");
    const std::string rank = "(row-start[axis])";
    std::string length = "internode[order]" + std::string(has("shrink") ? "*shrink[order]^" + rank : "") + plus(plan_.lengthStep, "longer", "row");
    const std::string radius = !plan_.radiusMeasured ? "thickness[order]" : number(plan_.radius) + (has("thinner") ? "*" + number(plan_.taper) + "^thinner[row]" : "");
    std::string rule = "A(order, axis, row, twist) : row < start[axis+1] -> S(1, " + length + ", " + radius + ") ";
    if (hasLeaves())
      rule += "L(0, order, leaves[row], leaves[row+1], " + around("leafAzimuth", "leafDivergence", "(leaves[row]-leaves[start[axis]])") + ") ";
    if (hasBranches()) rule += "A(0, order, side[row], side[row+1], " + around("azimuth", "divergence", "(side[row]-side[start[axis]])") + ") ";
    const std::string lean = has("turned") ? number(plan_.leanStep) + "*turned[row+1]" : "0";
    rule += "rotr(max(0, " + usual("bend") + plus(plan_.angleStep, "bent", "row+1") + "))rotu(" + lean + "-twist)A(order, axis, row+1, " + lean + ") ;";
    line(rule);
  }
  [[nodiscard]] std::string around(const std::string& first, const std::string& step, const std::string& rank) const {
    const std::string all = plusUsual(first) + plusUsual(step, "*" + rank) + "-twist";
    return all.starts_with("+") ? all.substr(1) : all;
  }

  void budRule() {
    line("// Axillary buds: axes of the next order. From " + samples(&OrderUsual::branches) + " insertions.");
    line("A(0, order, axis, end, around) : axis < end && order+1 < Depth -> [rotr(max(0, " + usual("insertion") + plus(plan_.angleStep, "bent", "start[axis]") + "))rotu(around" +
         plus(plan_.angleStep, "turned", "start[axis]") + ")A(order+1, axis, start[axis], 0)] A(0, order, axis+1, end, around" + plusUsual("apart") + ") ;");
  }

  void leafRules() {
    line("// Leaf buds. From " + samples(&OrderUsual::leaves) + " leaves.");
    const std::string blade = number(plan_.leafLength) + (has("small") ? "*" + number(plan_.leafTaper) + "^small[leaf]" : "");
    const std::string stalk = has("stalked") ? "max(0.00000001, " + number(plan_.petiole) + plus(plan_.lengthStep, "stalked", "leaf") + ")" : number(std::max(1e-8, plan_.petiole));
    for (std::size_t s = 0; s < plan_.shapes.size(); ++s) {
      const std::string only = plan_.shapes.size() > 1 ? " && shape[leaf] == " + std::to_string(s) : "";
      std::string leaf = "[rotr(max(0, " + usual("leafAngle") + plus(plan_.leafStep, "leafBent", "leaf") + "))rotu(around" + plus(plan_.leafStep, "leafTurned", "leaf") + ")";
      if (hasStalks()) leaf += "S(2, " + stalk + ")";
      if (has("leafRoll")) leaf += "rotr(0)rotu(" + plus(plan_.leafStep, "leafRoll", "leaf").substr(1) + ")";
      leaf += "L(" + std::to_string(s + 1) + ", " + blade + ")]";
      line("L(0, order, leaf, end, around) : leaf < end" + only + " -> " + leaf + " L(0, order, leaf+1, end, around" + plusUsual("leafApart") + ") ;");
    }
  }

  const Measurements& m_;
  const ExactLayout& layout_;
  const ExactPlan& plan_;
  const EmitOptions& options_;
  std::string text_;
  std::set<std::string> tables_;
  std::map<std::string, std::string> alike_;   ///< usual numbers that need no table
};

/// Bits of the text, and of what its errors leave unsaid.
double descriptionLength(std::size_t bytes, const ExactPlan& plan, std::size_t nodes, double detail) {
  return 8 * static_cast<double>(bytes) + detail * 3 * static_cast<double>(nodes) * std::log2(1 + plan.mean / kAccuracy);
}

}  // namespace

Result<simeco::Grammar> exactGrammar(const Measurements& m, const EmitOptions& options, const StructureOptions& wanted) {
  const PlantStructure structure = quantify::plantStructure(m);
  const ExactLayout layout = exactLayout(m, structure);
  std::string best;
  double least = 0;
  double nearest = 0;
  for (const double share : {0.8, 0.5, 0.3, 0.2, 0.1, 0.05, 0.02, 0.01}) {
    for (const bool trend : {false, true})
      for (const bool divergence : {true, false}) {
        const ExactPlan plan = exactPlan(m, structure, layout, {wanted.maximumError * share, trend, divergence});
        nearest = nearest == 0 ? plan.worst : std::min(nearest, plan.worst);
        if (plan.worst > wanted.maximumError) continue;
        std::string text = ExactText(m, layout, plan, options).text();
        // An arrangement that is regular is said in the rule, though a table could hide it in slightly fewer bytes.
        const double bits = descriptionLength(text.size(), plan, m.segments.size(), wanted.detail) * (divergence ? 1 - kReadable : 1);
        if (!best.empty() && bits >= least) continue;
        least = bits;
        best = std::move(text);
      }
    // Finer steps only pay while errors cost more than digits do.
    if (!best.empty() && 3 * wanted.detail < 8 && share < 0.2) break;
  }
  if (best.empty())
    return fail(ErrorCode::NoAnswer, "no table is fine enough to keep nodes within " + percent(wanted.maximumError) + " of the height (" + percent(nearest) + " is reached); allow more");
  simeco::Parsed parsed = simeco::parseSimeco(best);
  AXIL_ASSERT(parsed.ok(), "an exact grammar must parse");
  return std::move(parsed.grammar);
}

}  // namespace axil::emit
