#include "emit/dialects.hpp"

#include "base/text.hpp"
#include "emit/assembly.hpp"
#include "emit/plan.hpp"
#include "simeco/language.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace axil::emit {

namespace {

using quantify::Measurements;

std::string degrees(double radians) { return shortest(radians * (180 / std::numbers::pi)); }

/// `name(value)`, the form of every turtle command that is used.
std::string command(const char* letter, const std::string& argument) { return std::string(letter) + "(" + argument + ")"; }

// ---- turtles: cpfg and L-Py ------------------------------------------------------------------------------------------

std::string roll(double radians) { return radians == 0 ? "" : command("/", degrees(-radians)); }
std::string pitch(double radians) { return radians == 0 ? "" : command("^", degrees(radians)); }

/// The turtle's r-axis after rolling and pitching into a child, before a branch's own roll.
PlantDirection carriedAxis(const StemFrame& parent, Turn turn) { return turned(parent.rAxis, parent.direction, turn.rotu); }

/// Turns the turtle from `parent` into `child`; the last roll sets its r-axis to the child's.
std::string turtleTurn(const StemFrame& parent, Turn turn, const StemFrame& child) {
  const Angle rest = signedAngleAbout(child.direction, carriedAxis(parent, turn), child.rAxis);
  const bool needed = std::abs(rest.radians()) > 1e-9;
  // It is a quarter turn but for rounding, and is written as one.
  const double quarter = std::numbers::pi / 2;
  const double written = std::abs(std::abs(rest.radians()) - quarter) < 1e-6 ? std::copysign(quarter, rest.radians()) : rest.radians();
  return roll(turn.rotu.radians()) + pitch(turn.rotr.radians()) + (needed ? roll(written) : "");
}

/// A blade as a filled diamond: two sides from the base to the widest place, two on to the tip. The turtle's plane of turning is the blade's.
std::string blade(double length, double width) {
  const double half = std::atan2(width / 2, length / 2);
  const std::string side = command("f", shortest(std::hypot(length / 2, width / 2)));
  return "{" + command("+", degrees(half)) + side + command("-", degrees(2 * half)) + side + command("-", degrees(std::numbers::pi - 2 * half)) + side + "}";
}

/// What two turtle languages write differently.
struct TurtleSyntax {
  const char* width;              ///< sets the width of what is drawn next
  double widthOfRadius;           ///< what it takes for a radius of 1
  const char* leafColour;
  const char* polygonStart;       ///< the first corner, at the turtle
};

class TurtleText {
 public:
  TurtleText(const Plan& plan, const TurtleSyntax& syntax) : plan_(plan), syntax_(syntax) {}

  /// From the turtle's own start (heading up, r-axis X) to the plant's frame, and the first apex.
  [[nodiscard]] std::string axiom() const {
    const StemFrame upright = firstFrame(PlantDirection::up());
    const Turn turn = measuredTurn(upright, plan_.frame.direction);
    std::string text = turtleTurn(upright, turn, plan_.frame);
    for (const PlannedLeaf& leaf : plan_.rootLeaves) text += leafText(plan_.frame, leaf);
    for (const std::size_t s : plan_.collarBranches) text += branchText(plan_.frame, s);
    return text + apex(0);
  }

  /// What the apex of segment `s` becomes.
  [[nodiscard]] std::string successor(std::size_t s) const {
    const PlannedSegment& own = plan_.segments[s];
    const double stub = own.children.empty() && own.leaves.empty() ? 0 : plan_.growingPoint;
    std::string text = widthText(own.radius) + command("F", shortest(own.length + stub));
    for (const PlannedLeaf& leaf : own.leaves) text += leafText(own.frame, leaf);
    for (const std::size_t child : own.children) {
      if (plan_.segments[child].kind == ChildKind::Branch) text += branchText(own.frame, child);
      else text += turtleTurn(own.frame, plan_.segments[child].turn, plan_.segments[child].frame) + apex(child);
    }
    return text;
  }

  /// Steps until every apex has become its segment.
  [[nodiscard]] int steps() const {
    std::vector<int> born(plan_.segments.size(), 1);
    int last = 1;
    for (std::size_t s = 0; s < plan_.segments.size(); ++s)
      for (const std::size_t child : plan_.segments[s].children) last = std::max(last, born[child] = born[s] + 1);
    return last;
  }

 private:
  static std::string apex(std::size_t s) { return "A(" + std::to_string(kFirstSegmentStage + static_cast<int>(s)) + ")"; }
  [[nodiscard]] std::string widthText(double radius) const { return command(syntax_.width, shortest(radius * syntax_.widthOfRadius)); }
  [[nodiscard]] std::string branchText(const StemFrame& from, std::size_t s) const {
    return "[" + turtleTurn(from, plan_.segments[s].turn, plan_.segments[s].frame) + apex(s) + "]";
  }
  [[nodiscard]] std::string leafText(const StemFrame& from, const PlannedLeaf& leaf) const {
    const LeafStage& size = plan_.leafStages[static_cast<std::size_t>(leaf.leafStage) - 1];
    // Turning lies in the plane of heading and left; its normal is heading x r-axis, which the blade's upper side is to be.
    const PlantDirection normal = PlantDirection::along(glm::cross(leaf.frame.direction.unit(), carriedAxis(from, leaf.turn).unit()));
    const Angle rest = signedAngleAbout(leaf.frame.direction, normal, leaf.frame.adaxial);
    std::string text = "[" + roll(leaf.turn.rotu.radians()) + pitch(leaf.turn.rotr.radians());
    if (std::abs(rest.radians()) > 1e-9) text += roll(rest.radians());
    if (leaf.petioleStage >= 0) text += widthText(petioleOf(leaf) * 0.04) + command("F", shortest(petioleOf(leaf)));
    return text + syntax_.leafColour + blade(size.length, size.width > 0 ? size.width : size.length / 2) + "]";
  }
  [[nodiscard]] double petioleOf(const PlannedLeaf& leaf) const { return rounded(leaf.measure->petiole, plan_.digits.length); }

  const Plan& plan_;
  const TurtleSyntax& syntax_;
};

std::string cpfgText(const Plan& plan) {
  static const TurtleSyntax kSyntax{"!", 2, ";(2)", ""};
  const TurtleText turtle(plan, kSyntax);
  const glm::dvec3& at = plan.position.at;
  std::string text =
      "/* Regrows a measured plant. A(k) is the apex of segment k - 2. Angles in degrees; widths are diameters.\n"
      "   This language has no continuous growth and no leaf shapes: leaves are diamonds of the measured length and width.\n"
      "   Draw it with line style: cylinder and angle factor, scale and tropisms at their defaults. */\n"
      "Lsystem: 1\nderivation length: " + std::to_string(turtle.steps()) + "\nAxiom: ";
  if (at != glm::dvec3{0, 0, 0}) text += "@M(" + shortest(at.x) + "," + shortest(at.y) + "," + shortest(at.z) + ")";
  text += turtle.axiom() + "\n";
  for (std::size_t s = 0; s < plan.segments.size(); ++s)
    text += "A(k) : k == " + std::to_string(plan.segments[s].stage) + " --> " + turtle.successor(s) + "\n";
  return text + "endlsystem\n";
}

std::string lpyText(const Plan& plan) {
  static const TurtleSyntax kSyntax{"_", 1, ",(2)", ""};
  const TurtleText turtle(plan, kSyntax);
  const glm::dvec3& at = plan.position.at;
  std::string text =
      "# Regrows a measured plant. A(k) is the apex of segment k - 2. Angles in degrees; widths are radii.\n"
      "# Plants stand along Z here: the plant's axes (x, y, z) are this program's (y, z, x).\n"
      "# This export has no continuous growth and no leaf shapes: leaves are diamonds of the measured length and width.\n"
      "Axiom: ";
  if (at != glm::dvec3{0, 0, 0}) text += "@M(" + shortest(at.z) + "," + shortest(at.x) + "," + shortest(at.y) + ")";
  text += turtle.axiom() + "\n\nderivation length: " + std::to_string(turtle.steps()) + "\nproduction:\n\nA(k) :\n";
  for (std::size_t s = 0; s < plan.segments.size(); ++s)
    text += "  if k == " + std::to_string(plan.segments[s].stage) + " :\n    produce " + turtle.successor(s) + "\n";
  return text + "\nendlsystem\n";
}

// ---- MTG --------------------------------------------------------------------------------------------------------------

/// The table's rows: an axis stays in its column, what leaves it stands one further right, before the axis goes on.
class MtgText {
 public:
  explicit MtgText(const Plan& plan) : plan_(plan) { setOrders(); }

  std::string text() {
    std::string all =
        "# A measured plant. P plant, S stem segment, L leaf; XX YY ZZ the upper end of a segment or the base of a blade; lengths in the plant's unit,\n"
        "# angles in radians: rotr from the bearer, rotu around it. This format has no growth and no rules.\n"
        "CODE:\tFORM-A\n\n"
        "CLASSES:\nSYMBOL\tSCALE\tDECOMPOSITION\tINDEXATION\tDEFINITION\n$\t0\tFREE\tFREE\tIMPLICIT\nP\t1\tFREE\tFREE\tEXPLICIT\n"
        "S\t2\tFREE\tFREE\tEXPLICIT\nL\t2\tFREE\tFREE\tEXPLICIT\n\n"
        "DESCRIPTION:\nLEFT\tRIGHT\tRELTYPE\tMAX\nS\tS\t<\t?\nS\tS\t+\t?\nS\tL\t+\t?\n\nFEATURES:\nNAME\tTYPE\n";
    for (const char* name : kFeatures) all += std::string(name) + "\tREAL\n";
    all += "\nMTG:\nENTITY-CODE" + std::string(static_cast<std::size_t>(columns_), '\t');
    for (std::size_t f = 0; f < kFeatures.size(); ++f) all += (f == 0 ? "" : "\t") + std::string(kFeatures[f]);
    all += "\n/P1" + std::string(static_cast<std::size_t>(columns_), '\t') + featureText(plan_.position.at, {}) + "\n";
    rows_ = std::move(all);
    writeSegments();
    return std::move(rows_);
  }

 private:
  static constexpr std::array<const char*, 8> kFeatures{"XX", "YY", "ZZ", "Length", "Radius", "Width", "rotr", "rotu"};

  struct Values {
    std::optional<double> length, radius, width, rotr, rotu;
  };

  void setOrders() {
    orders_.assign(plan_.segments.size(), 0);
    for (const std::size_t s : plan_.collarBranches) orders_[s] = 1;
    int deepest = plan_.rootLeaves.empty() && plan_.collarBranches.empty() ? 0 : 1;
    for (std::size_t s = 0; s < plan_.segments.size(); ++s) {
      for (const std::size_t child : plan_.segments[s].children) orders_[child] = orders_[s] + (plan_.segments[child].kind == ChildKind::Branch ? 1 : 0);
      deepest = std::max(deepest, orders_[s] + (plan_.segments[s].leaves.empty() ? 0 : 1));
    }
    columns_ = deepest + 1;
  }

  static std::string featureText(const glm::dvec3& at, const Values& v) {
    std::string text = shortest(at.x) + "\t" + shortest(at.y) + "\t" + shortest(at.z);
    for (const auto& value : {v.length, v.radius, v.width, v.rotr, v.rotu}) text += "\t" + (value ? shortest(*value) : "");
    return text;
  }
  void row(int column, const std::string& code, const glm::dvec3& at, const Values& values) {
    rows_ += std::string(static_cast<std::size_t>(column), '\t') + code + std::string(static_cast<std::size_t>(columns_ - column), '\t') + featureText(at, values) + "\n";
  }

  void leafRow(const PlannedLeaf& leaf, const glm::dvec3& node, int column) {
    const LeafStage& size = plan_.leafStages[static_cast<std::size_t>(leaf.leafStage) - 1];
    const glm::dvec3 base = node + leaf.frame.direction.unit() * (leaf.petioleStage >= 0 ? rounded(leaf.measure->petiole, plan_.digits.length) : 0.0);
    Values values{size.length, std::nullopt, std::nullopt, leaf.turn.rotr.radians(), leaf.turn.rotu.radians()};
    if (size.width > 0) values.width = size.width;
    row(column, "+L" + std::to_string(++leavesWritten_), base, values);
  }
  void segmentRow(std::size_t s, const char* link) {
    const PlannedSegment& own = plan_.segments[s];
    row(orders_[s], link + std::to_string(s + 1), own.tip.at, {own.length, own.radius, std::nullopt, own.turn.rotr.radians(), own.turn.rotu.radians()});
    for (const PlannedLeaf& leaf : own.leaves) leafRow(leaf, own.tip.at, orders_[s] + 1);
  }

  /// Depth first, branches before the main child; on a stack, since chains may be deep.
  void writeSegments() {
    struct Next {
      std::size_t segment;
      const char* link;
    };
    std::vector<Next> open{{0, "^/S"}};
    bool atCollar = true;
    while (!open.empty()) {
      const Next next = open.back();
      open.pop_back();
      segmentRow(next.segment, next.link);
      const PlannedSegment& own = plan_.segments[next.segment];
      for (auto child = own.children.rbegin(); child != own.children.rend(); ++child)
        open.push_back({*child, plan_.segments[*child].kind == ChildKind::Branch ? "+S" : "^<S"});
      // What leaves the collar beside the first segment hangs on that segment: the format knows no nodes.
      if (!std::exchange(atCollar, false)) continue;
      for (const PlannedLeaf& leaf : plan_.rootLeaves) leafRow(leaf, plan_.position.at, 1);
      for (auto s = plan_.collarBranches.rbegin(); s != plan_.collarBranches.rend(); ++s) open.push_back({*s, "+S"});
    }
  }

  const Plan& plan_;
  std::vector<int> orders_;
  int columns_ = 1;
  int leavesWritten_ = 0;
  std::string rows_;
};

}  // namespace

std::optional<Dialect> dialectNamed(std::string_view name) {
  if (name == "simeco") return Dialect::SimEco;
  if (name == "cpfg") return Dialect::Cpfg;
  if (name == "lpy") return Dialect::LPy;
  if (name == "mtg") return Dialect::Mtg;
  return std::nullopt;
}

Result<std::string> inDialect(const Measurements& measurements, Dialect dialect, const EmitOptions& options) {
  if (dialect != Dialect::SimEco && options.turning == TurningRule::Literal)
    return fail(ErrorCode::BadInput, "only SimEco text can follow the literal turning rule; use the exact rule for other dialects");
  const Result<Plan> plan = planOf(measurements, options);
  if (!plan) return plan.failure();
  switch (dialect) {
    case Dialect::SimEco: return simeco::print(assembled(*plan, options).grammar);
    case Dialect::Cpfg: return cpfgText(*plan);
    case Dialect::LPy: return lpyText(*plan);
    case Dialect::Mtg: return MtgText(*plan).text();
  }
  return fail(ErrorCode::BadInput, "unknown dialect");
}

}  // namespace axil::emit
