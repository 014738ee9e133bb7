#include "base/overloaded.hpp"
#include "base/text.hpp"
#include "simeco/lsystem_language.hpp"

namespace axil::simeco {

namespace {

constexpr std::size_t kBlockWidth = 100;  ///< a block that is longer than this stands on several lines

struct OperatorText {
  const char* text;
  int level;
};
constexpr int kUnaryLevel = 7;
constexpr int kConditionalLevel = -1;

OperatorText textOf(BinaryOp op) {
  switch (op) {
    case BinaryOp::Or: return {"||", 0};
    case BinaryOp::And: return {"&&", 1};
    case BinaryOp::Equal: return {"==", 2};
    case BinaryOp::NotEqual: return {"!=", 2};
    case BinaryOp::Less: return {"<", 3};
    case BinaryOp::LessEqual: return {"<=", 3};
    case BinaryOp::Greater: return {">", 3};
    case BinaryOp::GreaterEqual: return {">=", 3};
    case BinaryOp::Add: return {"+", 4};
    case BinaryOp::Subtract: return {"-", 4};
    case BinaryOp::Multiply: return {"*", 5};
    case BinaryOp::Divide: return {"/", 5};
    case BinaryOp::Remainder: return {"%", 5};
    case BinaryOp::Power: return {"^", 6};
  }
  return {"", 0};
}

/// An exponent needs a decimal point in this language.
std::string classicNumber(const Number& number) {
  std::string text = simeco::textOf(number);
  const std::size_t exponent = text.find('e');
  if (exponent != std::string::npos && text.find('.') == std::string::npos) text.insert(exponent, ".0");
  return text;
}

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '\n') result += "\\n";
    else if (c == '\t') result += "\\t";
    else if (c == '\r') result += "\\r";
    else if (c == '"' || c == '\\') result += std::string("\\") + c;
    else result += c;
  }
  return result + "\"";
}

class ExpressionPrinter {
 public:
  explicit ExpressionPrinter(const Grammar& grammar) : grammar_(grammar) {}

  /// `id` where an operator of `level` or tighter may stand bare.
  [[nodiscard]] std::string text(ExprId id, int level) const {
    return std::visit(overloaded{[&](const Number& n) { return number(n, level); }, [&](const Name& n) { return n.name; },
                                 [&](const Text& t) { return quoted(t.text); }, [&](const Unary& u) { return (u.op == UnaryOp::Minus ? "-" : "!") + text(u.operand, kUnaryLevel); },
                                 [&](const Binary& b) { return binary(b, level); }, [&](const Chain& c) { return chain(c, level); },
                                 [&](const Conditional& c) { return conditional(c, level); }, [&](const Call& c) { return call(c); },
                                 [&](const Element& e) { return e.array + indices(e.indices); }},
                      grammar_.at(id).node);
  }

  [[nodiscard]] std::string indices(const std::vector<ExprId>& list) const {
    std::string result;
    for (const ExprId id : list) result += "[" + text(id, kConditionalLevel) + "]";
    return result;
  }

 private:
  static std::string bracketed(std::string text, int own, int level) { return own < level ? "(" + std::move(text) + ")" : std::move(text); }
  static std::string number(const Number& n, int level) { return bracketed(classicNumber(n), n.value < 0 ? kUnaryLevel - 1 : kUnaryLevel, level); }

  [[nodiscard]] std::string binary(const Binary& b, int level) const {
    const OperatorText op = textOf(b.op);
    return bracketed(text(b.left, op.level) + op.text + text(b.right, op.level + 1), op.level, level);
  }

  /// A chain has no words of its own here: its pairs, joined by &&.
  [[nodiscard]] std::string chain(const Chain& c, int level) const {
    std::string result;
    for (std::size_t i = 0; i < c.comparisons.size(); ++i) {
      const OperatorText op = textOf(c.comparisons[i]);
      result += (i == 0 ? "" : "&&") + text(c.operands[i], op.level) + op.text + text(c.operands[i + 1], op.level + 1);
    }
    return bracketed(std::move(result), textOf(BinaryOp::And).level, level);
  }

  [[nodiscard]] std::string conditional(const Conditional& c, int level) const {
    return bracketed(text(c.condition, 0) + "?" + text(c.yes, kConditionalLevel) + ":" + text(c.no, kConditionalLevel), kConditionalLevel, level);
  }

  [[nodiscard]] std::string call(const Call& c) const {
    std::string result = c.function + "(";
    for (std::size_t i = 0; i < c.arguments.size(); ++i) {
      if (i > 0) result += ",";
      if (c.function == "fscanf" && i >= 2) result += "&";
      result += text(c.arguments[i], kConditionalLevel);
    }
    return result + ")";
  }

  const Grammar& grammar_;
};

class LSystemPrinter {
 public:
  explicit LSystemPrinter(const Grammar& grammar) : grammar_(grammar), expressions_(grammar) {}

  std::string run() {
    lines(grammar_.comments.before);
    for (const PlantGrammar& plant : grammar_.plants) {
      lsystem(plant.rules);
      for (const RuleSet& rules : plant.subRules) lsystem(rules);
    }
    lines(grammar_.closing);
    return std::move(out_);
  }

  [[nodiscard]] std::string expression(ExprId id) const { return expressions_.text(id, kConditionalLevel); }

  [[nodiscard]] std::string module(const Module& module) const {
    std::string result = module.letter;
    for (std::size_t i = 0; i < module.arguments.size(); ++i) result += (i == 0 ? "(" : ",") + expression(module.arguments[i]);
    return module.arguments.empty() ? result : result + ")";
  }

 private:
  void line(const std::string& text) { out_ += text + "\n"; }
  void lines(const std::vector<std::string>& all) {
    for (const std::string& text : all) line(text);
  }

  void lsystem(const RuleSet& rules) {
    line("Lsystem: " + rules.label);
    if (rules.seed) line("seed: " + std::to_string(*rules.seed));
    if (rules.derivationLength) line("derivation length: " + expression(*rules.derivationLength));
    if (rules.ring) line("ring Lsystem");
    filter(rules.filter);
    define(rules);
    headerBlock("Start: ", rules.start);
    headerBlock("StartEach: ", rules.startEach);
    headerBlock("EndEach: ", rules.endEach);
    headerBlock("End: ", rules.end);
    lines(rules.axiomComments.before);
    line("Axiom: " + guarded(string(rules.axiom)) + trailing(rules.axiomComments.trailing));
    if (rules.productions.empty()) line("");
    productions(rules.productions);
    subRules("decomposition", rules.decomposition);
    subRules("homomorphism", rules.homomorphism);
    if (!rules.interaction.empty()) line("Interaction");
    productions(rules.interaction);
    line("endlsystem");
  }

  void filter(const ContextFilter& filter) {
    if (filter.mode == ContextFilter::Mode::None) return;
    std::string letters;
    for (const std::string& letter : filter.letters) append(letters, letter);
    line((filter.mode == ContextFilter::Mode::Ignore ? "ignore: " : "consider: ") + guarded(letters));
  }

  void define(const RuleSet& rules) {
    if (rules.arrays.empty() && rules.externals.empty()) return;
    std::string text = "define: {";
    for (const ArrayDeclaration& array : rules.arrays) {
      text += " array " + array.name;
      for (const int size : array.sizes) text += "[" + std::to_string(size) + "]";
      for (std::size_t i = 0; i < array.initial.size(); ++i) text += (i == 0 ? "={" : ",") + expression(array.initial[i]);
      text += array.initial.empty() ? ";" : "};";
    }
    for (const std::string& name : rules.externals) text += " external " + name + ";";
    line(text + " }");
  }

  void headerBlock(const std::string& keyword, const Block& block) {
    if (block.empty()) return;
    const std::string flat = inlineBlock(block);
    if (keyword.size() + flat.size() <= kBlockWidth) return line(keyword + flat);
    line(keyword + "{");
    for (const Statement& s : block) line("  " + statement(s));
    line("}");
  }

  [[nodiscard]] std::string inlineBlock(const Block& block) const {
    std::string text = "{";
    for (const Statement& s : block) text += " " + statement(s);
    return text + " }";
  }

  [[nodiscard]] std::string statement(const Statement& s) const {
    return std::visit(overloaded{[&](const Assign& a) { return a.name + "=" + expression(a.value) + ";"; },
                                 [&](const AssignElement& a) { return a.array + expressions_.indices(a.indices) + "=" + expression(a.value) + ";"; },
                                 [&](const Evaluate& e) { return expression(e.value) + ";"; },
                                 [&](const If& i) {
                                   const std::string text = "if (" + expression(i.condition) + ") " + inlineBlock(i.yes);
                                   return i.no.empty() ? text : text + " else " + inlineBlock(i.no);
                                 },
                                 [&](const While& w) {
                                   const std::string condition = "while (" + expression(w.condition) + ")";
                                   return w.testFirst ? condition + " " + inlineBlock(w.body) : "do " + inlineBlock(w.body) + " " + condition + ";";
                                 }},
                      s.node);
  }

  void subRules(const std::string& keyword, const std::optional<SubRules>& sub) {
    if (!sub) return;
    line(keyword + (sub->warnAtMaximumDepth ? "" : ": no warnings"));
    if (sub->seed) line("seed: " + std::to_string(*sub->seed));
    if (sub->maximumDepth != 1) line("maximum depth: " + std::to_string(sub->maximumDepth));
    productions(sub->productions);
  }

  void productions(const std::vector<Production>& all) {
    for (const Production& rule : all) {
      lines(rule.comments.before);
      std::string text = sides(rule) + condition(rule) + " --> ";
      for (const Successor& successor : rule.successors) {
        text += successor.modules.empty() ? "*" : string(successor.modules);
        if (successor.weight) text += " : " + expression(*successor.weight);
      }
      line(guarded(text) + trailing(rule.comments.trailing));
    }
  }

  [[nodiscard]] std::string sides(const Production& rule) const {
    std::string text = rule.left.empty() ? "" : string(rule.left) + " < ";
    text += string(rule.predecessor);
    if (!rule.right.empty()) text += " > " + string(rule.right);
    // A # may not start a line; * stands for no left context.
    if (text.starts_with('#')) text = rule.left.empty() ? "* < " + text : " " + text;
    return text;
  }

  [[nodiscard]] std::string condition(const Production& rule) const {
    if (!rule.condition && rule.before.empty() && rule.after.empty()) return {};
    std::string text = " : ";
    if (!rule.before.empty()) text += inlineBlock(rule.before) + " ";
    text += rule.condition ? expression(*rule.condition) : "*";
    if (!rule.after.empty()) text += " " + inlineBlock(rule.after);
    return text;
  }

  [[nodiscard]] std::string string(const std::vector<Module>& modules) const {
    std::string text;
    for (const Module& m : modules) append(text, module(m));
    return text;
  }

  /// Two rolls // would be a comment.
  static void append(std::string& text, const std::string& module) {
    if (!text.empty() && text.back() == '/' && module.starts_with('/')) text += ' ';
    text += module;
  }
  /// A line must not end with a backslash, which would join it with the next.
  static std::string guarded(std::string text) {
    if (!text.empty() && text.back() == '\\') text += ' ';
    return text;
  }
  static std::string trailing(const std::string& comment) { return comment.empty() ? "" : "  " + comment; }

  const Grammar& grammar_;
  ExpressionPrinter expressions_;
  std::string out_;
};

}  // namespace

std::string printLSystem(const Grammar& grammar) { return LSystemPrinter(grammar).run(); }

std::string printLSystemExpression(const Grammar& grammar, ExprId id) { return LSystemPrinter(grammar).expression(id); }

std::string printLSystemModule(const Grammar& grammar, const Module& module) { return LSystemPrinter(grammar).module(module); }

}  // namespace axil::simeco
