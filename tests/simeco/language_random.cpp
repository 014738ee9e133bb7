#include "simeco/language_random.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <string>

namespace axil::test {

namespace {

using namespace simeco;

class Maker {
 public:
  explicit Maker(Rng rng) : rng_(rng) {}

  Grammar grammar() {
    grammar_.version = chance(0.3) ? "1.0" : "1.1";
    grammar_.name = words();
    grammar_.comments = blockComments();
    for (int i = upTo(3); i > 0; --i) grammar_.attributes.push_back(attribute());
    for (int i = upTo(3); i > 0; --i) grammar_.plants.push_back(plant());
    for (int i = upTo(2); i > 0; --i) grammar_.closing.push_back(comment());
    return std::move(grammar_);
  }

 private:
  // ---- chance ----

  bool chance(double p) { return rng_.uniform() < p; }
  int upTo(int most) { return static_cast<int>(rng_.below(static_cast<std::uint64_t>(most) + 1)); }
  template <class T, std::size_t N>
  const T& oneOf(const std::array<T, N>& all) {
    return all[rng_.below(N)];
  }

  // ---- words ----

  std::string words() {
    static const std::array<std::string, 7> all{"Lantana",          "馬櫻丹", "", "a \"quoted\" name", "C:\\plants\\leaf.i",
                                                "// not a comment", "{;}"};
    return oneOf(all);
  }
  std::string name() {
    static const std::array<std::string, 7> all{"i", "x", "count", "GrowRate", "葉寬", "_a1", "Vigour"};
    return oneOf(all);
  }
  std::string letter() {
    static const std::array<std::string, 10> all{"A", "S", "L", "R", "F", "W", "rotr", "rotu", "?P", "%"};
    return oneOf(all);
  }
  std::string comment() {
    static const std::array<std::string, 6> all{"// one line", "/* short */", "/* two\n   lines */", "//", "// 註解 \"with\" {signs};",
                                                "/**/"};
    return oneOf(all);
  }
  std::string lineComment() { return chance(0.8) ? std::string{} : comment(); }
  Comments comments() {
    Comments made;
    for (int i = chance(0.2) ? 1 + upTo(1) : 0; i > 0; --i) made.before.push_back(comment());
    made.trailing = lineComment();
    return made;
  }
  Comments blockComments() {
    Comments made = comments();
    made.opening = lineComment();
    for (int i = chance(0.2) ? 1 + upTo(1) : 0; i > 0; --i) made.inside.push_back(comment());
    return made;
  }

  // ---- expressions ----

  Number number() {
    switch (rng_.below(5)) {
      case 0:
        return fixedNumber(rng_.uniform(-10, 10), upTo(9));
      case 1:
        return {static_cast<double>(upTo(2000)), 0};
      case 2:
        return {rng_.uniform(-1, 1), -1};
      case 3:
        return {rng_.uniform(-1, 1), upTo(6)};  // never rounded: must keep all digits
      default: {
        const double any = std::bit_cast<double>(rng_.bits());
        return {std::isnormal(any) ? any : -0.0, upTo(30) - 1};
      }
    }
  }
  ExprId expression(int depth = 0) {
    if (depth >= 5 || chance(0.35)) return leaf();
    switch (rng_.below(8)) {
      case 0:
        return grammar_.add(Unary{chance(0.5) ? UnaryOp::Minus : UnaryOp::Not, expression(depth + 1)});
      case 1:
        return chain(depth);
      case 2: {
        const ExprId condition = expression(depth + 1);
        const ExprId yes = expression(depth + 1);
        return grammar_.add(Conditional{condition, yes, expression(depth + 1)});
      }
      case 3:
        return grammar_.add(Call{chance(0.5) ? "random" : name(), list(depth + 1, 0)});
      case 4:
        return grammar_.add(Element{name(), list(depth + 1, 1)});
      default: {
        const auto op = static_cast<BinaryOp>(rng_.below(static_cast<std::uint64_t>(BinaryOp::Or) + 1));
        const ExprId left = expression(depth + 1);
        return grammar_.add(Binary{op, left, expression(depth + 1)});
      }
    }
  }
  ExprId leaf() {
    if (chance(0.6)) return grammar_.add(number());
    return chance(0.8) ? grammar_.add(Name{name()}) : grammar_.add(Text{words()});
  }
  ExprId chain(int depth) {
    Chain made;
    made.operands.push_back(expression(depth + 1));
    for (int i = 2 + upTo(1); i > 0; --i) {
      made.comparisons.push_back(static_cast<BinaryOp>(static_cast<std::uint64_t>(BinaryOp::Less) + rng_.below(6)));
      made.operands.push_back(expression(depth + 1));
    }
    return grammar_.add(std::move(made));
  }
  std::vector<ExprId> list(int depth, int fewest) {
    std::vector<ExprId> made;
    for (int i = fewest + upTo(2); i > 0; --i) made.push_back(expression(depth));
    return made;
  }

  // ---- statements ----

  Block block(int depth = 0) {
    Block made;
    for (int i = upTo(2); i > 0; --i) made.push_back(statement(depth));
    return made;
  }
  Statement statement(int depth) {
    switch (depth >= 3 ? rng_.below(3) : rng_.below(5)) {
      case 0:
        return {Assign{name(), expression(2)}, {}};
      case 1:
        return {AssignElement{name(), list(3, 1), expression(2)}, {}};
      case 2:
        return {Evaluate{expression(2)}, {}};
      case 3: {
        If made;
        made.condition = expression(3);
        made.yes = block(depth + 1);
        made.no = block(depth + 1);
        return {std::move(made), {}};
      }
      default: {
        While made;
        made.condition = expression(3);
        made.body = block(depth + 1);
        made.testFirst = chance(0.5);
        return {std::move(made), {}};
      }
    }
  }

  // ---- rules ----

  Module module() {
    Module made;
    made.letter = letter();
    for (int i = upTo(2); i > 0; --i) made.arguments.push_back(expression(2));
    return made;
  }
  std::vector<Module> modules(int fewest) {
    std::vector<Module> made;
    for (int i = fewest + upTo(4); i > 0; --i) {
      if (chance(0.15)) made.push_back({"[", {}, {}});
      made.push_back(module());
      if (chance(0.15)) made.push_back({"]", {}, {}});
    }
    return made;
  }
  Production production() {
    Production made;
    made.comments = comments();
    if (chance(0.2)) made.left = modules(1);
    made.predecessor = modules(1);
    if (chance(0.2)) made.right = modules(1);
    if (chance(0.2)) made.before = block();
    if (chance(0.5)) made.condition = expression();
    made.conditionPlace = static_cast<ConditionPlace>(rng_.below(3));
    if (chance(0.2)) made.after = block();
    for (int i = chance(0.3) ? 1 + upTo(2) : 1; i > 0; --i)
      made.successors.push_back({modules(0), chance(0.3) ? std::optional(expression(2)) : std::nullopt});
    return made;
  }
  std::vector<Production> productions() {
    std::vector<Production> made;
    for (int i = upTo(5); i > 0; --i) made.push_back(production());
    return made;
  }
  std::optional<SubRules> subRules() {
    if (chance(0.7)) return std::nullopt;
    SubRules made;
    made.maximumDepth = upTo(9);
    if (chance(0.5)) made.seed = rng_.bits();
    made.warnAtMaximumDepth = chance(0.5);
    made.productions = productions();
    return made;
  }
  RuleSet rules() {
    RuleSet made;
    made.label = chance(0.7) ? "w" : name();
    made.axiom = modules(0);
    made.axiomComments = comments();
    made.comments = blockComments();
    made.productions = productions();
    made.decomposition = subRules();
    made.homomorphism = subRules();
    if (chance(0.2)) made.interaction = productions();
    if (chance(0.3)) {
      made.filter.mode = chance(0.5) ? ContextFilter::Mode::Ignore : ContextFilter::Mode::Consider;
      for (int i = upTo(3); i > 0; --i) made.filter.letters.push_back(letter());
      made.filter.comments = comments();
    }
    made.ring = chance(0.1);
    if (chance(0.2)) made.seed = rng_.bits();
    if (chance(0.2)) made.derivationLength = expression(3);
    if (chance(0.2)) made.arrays.push_back({"table", {1 + upTo(3), 1 + upTo(3)}, list(3, 0)});
    if (chance(0.2)) made.externals = {"x", "y"};
    if (chance(0.2)) made.start = block();
    if (chance(0.2)) made.startEach = block();
    if (chance(0.2)) made.endEach = block();
    if (chance(0.2)) made.end = block();
    return made;
  }

  // ---- plants ----

  Attribute attribute() { return {name(), expression(), comments(), {}}; }
  std::vector<Attribute> attributes() {
    std::vector<Attribute> made;
    for (int i = upTo(2); i > 0; --i) made.push_back(attribute());
    return made;
  }
  OrganBlock organ() {
    OrganBlock made{static_cast<OrganKind>(rng_.below(6)), attributes(), {}, blockComments(), {}};
    for (int i = upTo(2); i > 0; --i) made.stages.push_back({upTo(100), chance(0.25) ? std::vector<std::string>{"width", "late"} : std::vector<std::string>{}, attributes(), blockComments(), {}});
    return made;
  }
  PlantGrammar plant() {
    PlantGrammar made;
    made.name = words();
    made.comments = blockComments();
    made.attributes = attributes();
    for (int i = upTo(3); i > 0; --i) made.organs.push_back(organ());
    made.rules = rules();
    if (chance(0.1)) made.subRules.push_back(rules());
    return made;
  }

  Rng rng_;
  Grammar grammar_;
};

}  // namespace

simeco::Grammar randomGrammar(Rng rng) { return Maker(rng).grammar(); }

}  // namespace axil::test
