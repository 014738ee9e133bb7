// A Grammar as SimEco text, in the layout that the thesis' program writes.
#include "simeco/language.hpp"
#include "simeco/lsystem_language.hpp"
#include "simeco/print_expressions.hpp"

#include <utility>

namespace axil::simeco {

namespace printing {
namespace {

bool isTurn(const std::string& letter) { return letter == "rotr" || letter == "rotu"; }

class Printer : private ExpressionPrinter {
 public:
  using ExpressionPrinter::ExpressionPrinter;

  std::string file() {
    out_.reserve(grammar_.expressions.size() * 20 + 256);
    lines(grammar_.comments.before);
    out_ += "EcoSystem " + grammar_.version + ' ';
    quoted(grammar_.name);
    open(grammar_.comments);
    attributes(grammar_.attributes);
    for (const PlantGrammar& p : grammar_.plants) plant(p);
    close(grammar_.comments);
    lines(grammar_.closing);
    return std::move(out_);
  }
  std::string alone(ExprId id) {
    expression(id, kChoice);
    return std::move(out_);
  }
  std::string alone(const Module& m) {
    module(m);
    return std::move(out_);
  }

 private:
  // ---- plants ----

  void attributes(const std::vector<Attribute>& list) {
    for (const Attribute& a : list) {
      lines(a.comments.before);
      indent();
      out_ += a.name;
      out_ += " = ";
      expression(a.value, kChoice);
      out_ += ';';
      endLine(a.comments.trailing);
    }
  }
  void plant(const PlantGrammar& p) {
    lines(p.comments.before);
    indent();
    out_ += "Plant ";
    quoted(p.name);
    open(p.comments);
    attributes(p.attributes);
    for (const OrganBlock& o : p.organs) organ(o);
    grow(p.rules);
    for (const RuleSet& rules : p.subRules) grow(rules);
    close(p.comments);
  }
  void organ(const OrganBlock& o) {
    lines(o.comments.before);
    indent();
    out_ += keywordOf(o.kind);
    if (o.attributes.empty() && o.stages.empty() && isBare(o.comments)) return closeEmpty(o.comments);
    open(o.comments);
    attributes(o.attributes);
    for (const Stage& s : o.stages) stage(s);
    close(o.comments);
  }
  void stage(const Stage& s) {
    lines(s.comments.before);
    indent();
    out_ += "Stage " + std::to_string(s.number);
    for (std::size_t i = 0; i < s.parameters.size(); ++i) out_ += (i == 0 ? "(" : ", ") + s.parameters[i];
    if (!s.parameters.empty()) out_ += ")";
    if (s.attributes.empty() && isBare(s.comments)) return closeEmpty(s.comments);
    open(s.comments);
    attributes(s.attributes);
    close(s.comments);
  }

  // ---- rules ----

  void grow(const RuleSet& rules) {
    lines(rules.comments.before);
    indent();
    out_ += "Grow";
    open(rules.comments);
    settings(rules);
    if (!rules.axiom.empty() || !rules.label.empty() || !rules.productions.empty()) axiom(rules);
    for (const Production& p : rules.productions) production(p);
    subRules("decomposition", rules.decomposition);
    subRules("homomorphism", rules.homomorphism);
    interaction(rules.interaction);
    close(rules.comments);
  }
  void settings(const RuleSet& rules) {
    if (rules.seed) setting("seed = " + std::to_string(*rules.seed));
    if (rules.derivationLength) {
      indent();
      out_ += "steps = ";
      expression(*rules.derivationLength, kChoice);
      out_ += ";\n";
    }
    if (rules.ring) setting("ring");
    for (const std::string& name : rules.externals) setting("external " + name);
    for (const ArrayDeclaration& a : rules.arrays) array(a);
    namedBlock("start", rules.start);
    namedBlock("startEach", rules.startEach);
    namedBlock("endEach", rules.endEach);
    namedBlock("end", rules.end);
    filter(rules.filter);
  }
  void setting(const std::string& text) {
    indent();
    out_ += text + ";\n";
  }
  void array(const ArrayDeclaration& a) {
    indent();
    out_ += "array " + a.name;
    for (const int size : a.sizes) out_ += '[' + std::to_string(size) + ']';
    if (!a.initial.empty()) {
      out_ += " = {";
      list(a.initial);
      out_ += '}';
    }
    out_ += ";\n";
  }
  void namedBlock(std::string_view name, const Block& statements) {
    if (statements.empty()) return;
    indent();
    out_ += name;
    out_ += ' ';
    block(statements);
    out_ += '\n';
  }
  void filter(const ContextFilter& f) {
    if (f.mode == ContextFilter::Mode::None) return;
    lines(f.comments.before);
    indent();
    out_ += f.mode == ContextFilter::Mode::Ignore ? "ignore" : "consider";
    for (const std::string& letter : f.letters) out_ += ' ' + letter;
    out_ += ';';
    endLine(f.comments.trailing);
  }
  void axiom(const RuleSet& rules) {
    lines(rules.axiomComments.before);
    indent();
    out_ += rules.label.empty() ? "w" : rules.label;
    out_ += " = ";
    modules(rules.axiom);
    out_ += ';';
    endLine(rules.axiomComments.trailing);
  }
  void subRules(std::string_view name, const std::optional<SubRules>& rules) {
    if (!rules) return;
    indent();
    out_ += name;
    out_ += " {\n";
    ++depth_;
    setting("depth = " + std::to_string(rules->maximumDepth));
    if (rules->seed) setting("seed = " + std::to_string(*rules->seed));
    if (!rules->warnAtMaximumDepth) setting("quiet");
    for (const Production& p : rules->productions) production(p);
    --depth_;
    indent();
    out_ += "}\n";
  }
  void interaction(const std::vector<Production>& productions) {
    if (productions.empty()) return;
    indent();
    out_ += "interaction {\n";
    ++depth_;
    for (const Production& p : productions) production(p);
    --depth_;
    indent();
    out_ += "}\n";
  }
  void production(const Production& p) {
    const ConditionPlace place = placeOfCondition(grammar_, p);
    lines(p.comments.before);
    indent();
    if (!p.left.empty()) {
      modules(p.left);
      out_ += " < ";
    }
    modules(p.predecessor, place == ConditionPlace::InPredecessor ? carrierIn(p.predecessor, place) : nullptr, p.condition);
    if (!p.right.empty()) {
      out_ += " > ";
      modules(p.right);
    }
    afterColon(p, place);
    out_ += " ->";
    successors(p, place);
    out_ += " ;";
    endLine(p.comments.trailing);
  }
  /// One beside its predecessor, several below it, each on a line.
  void successors(const Production& p, ConditionPlace place) {
    if (p.successors.size() == 1) return successor(p, p.successors.front(), place);
    ++depth_;
    for (std::size_t i = 0; i < p.successors.size(); ++i) {
      out_ += '\n';
      indent();
      out_ += i == 0 ? " " : "|";
      successor(p, p.successors[i], place);
    }
    --depth_;
  }
  void afterColon(const Production& p, ConditionPlace place) {
    const bool condition = p.condition && place == ConditionPlace::AfterColon;
    if (!condition && p.before.empty() && p.after.empty()) return;
    out_ += " :";
    // Without a condition between them, a first empty block says that the second one comes after.
    if (!p.before.empty() || (!condition && !p.after.empty())) {
      out_ += ' ';
      block(p.before);
    }
    if (condition) {
      out_ += ' ';
      expression(*p.condition, kChoice);
    }
    if (!p.after.empty()) {
      out_ += ' ';
      block(p.after);
    }
  }
  void successor(const Production& p, const Successor& s, ConditionPlace place) {
    if (s.weight) {
      out_ += ' ';
      weight(*s.weight);
      out_ += ':';
    }
    if (!s.modules.empty()) out_ += ' ';
    modules(s.modules, place == ConditionPlace::InSuccessor ? carrierIn(s.modules, place) : nullptr, p.condition);
  }
  void weight(ExprId id) {
    const auto* number = std::get_if<Number>(&grammar_.at(id).node);
    if (number && !isNegative(*number)) return expression(id, kChoice);
    out_ += '(';
    expression(id, kChoice);
    out_ += ')';
  }
  /// The module that carries the condition: in a predecessor the last, in a successor the first that is not a turn.
  static const Module* carrierIn(const std::vector<Module>& list, ConditionPlace place) {
    if (place == ConditionPlace::InPredecessor) return &list.back();
    const auto holds = [](const Module& m) { return m.letter != "[" && m.letter != "]"; };
    const auto organ = std::find_if(list.begin(), list.end(), [&](const Module& m) { return holds(m) && !isTurn(m.letter); });
    return organ != list.end() ? &*organ : &*std::find_if(list.begin(), list.end(), holds);
  }
  /// The thesis' blanks: none behind a turn and in what the turn moves, one elsewhere, one before [ and after ].
  void modules(const std::vector<Module>& list, const Module* carrier = nullptr, const std::optional<ExprId>& condition = {}) {
    bool turned = false;
    for (std::size_t i = 0; i < list.size(); ++i) {
      const Module& m = list[i];
      const bool opens = m.letter == "[";
      const bool closes = m.letter == "]";
      const bool apart = out_.ends_with(')') || out_.ends_with(']');  // else two letters would read as one word
      const bool tight = i == 0 || closes || list[i - 1].letter == "[" || (turned && !opens && apart);
      if (!tight) out_ += ' ';
      turned = !opens && !closes && (turned || isTurn(m.letter));
      module(m, &m == carrier ? condition : std::nullopt);
    }
  }
  void module(const Module& m, const std::optional<ExprId>& condition = {}) {
    out_ += m.letter;
    if (m.arguments.empty() && !condition) return;
    out_ += '(';
    bool first = true;
    for (const ExprId argument : m.arguments) {
      if (!std::exchange(first, false)) out_ += ", ";
      // Bare, a comparison would be the rule's condition.
      expression(argument, isCondition(grammar_, argument) ? kPrimary : kChoice);
    }
    if (condition) {
      if (!first) out_ += ", ";
      expression(*condition, kChoice);
    }
    out_ += ')';
  }

  // ---- statements ----

  void block(const Block& statements) {
    out_ += '{';
    for (const Statement& s : statements) {
      out_ += ' ';
      std::visit([this](const auto& node) { statement(node); }, s.node);
    }
    out_ += " }";
  }
  void statement(const Assign& s) {
    out_ += s.name + " = ";
    expression(s.value, kChoice);
    out_ += ';';
  }
  void statement(const AssignElement& s) {
    element(s.array, s.indices);
    out_ += " = ";
    expression(s.value, kChoice);
    out_ += ';';
  }
  void statement(const Evaluate& s) {
    expression(s.value, kChoice);
    out_ += ';';
  }
  void statement(const If& s) {
    out_ += "if (";
    expression(s.condition, kChoice);
    out_ += ") ";
    block(s.yes);
    if (s.no.empty()) return;
    out_ += " else ";
    block(s.no);
  }
  void statement(const While& s) {
    out_ += s.testFirst ? "while (" : "do ";
    if (!s.testFirst) {
      block(s.body);
      out_ += " while (";
    }
    expression(s.condition, kChoice);
    out_ += s.testFirst ? ") " : ");";
    if (s.testFirst) block(s.body);
  }
};

}  // namespace
}  // namespace printing

std::string print(const Grammar& grammar) {
  return grammar.language == Language::LSystem ? printLSystem(grammar) : printing::Printer(grammar).file();
}

std::string printExpression(const Grammar& grammar, ExprId id) {
  return grammar.language == Language::LSystem ? printLSystemExpression(grammar, id) : printing::Printer(grammar).alone(id);
}

std::string printModule(const Grammar& grammar, const Module& module) {
  return grammar.language == Language::LSystem ? printLSystemModule(grammar, module) : printing::Printer(grammar).alone(module);
}

}  // namespace axil::simeco
