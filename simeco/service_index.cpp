#include "simeco/service_index.hpp"

#include "base/overloaded.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace axil::simeco {

namespace {

using Names = std::set<std::string, std::less<>>;

void assignedNames(const Block& block, Names& names) {
  for (const Statement& s : block)
    std::visit(overloaded{[&](const Assign& a) { names.insert(a.name); }, [](const AssignElement&) {}, [](const Evaluate&) {},
                          [&](const If& i) { assignedNames(i.yes, names), assignedNames(i.no, names); }, [&](const While& w) { assignedNames(w.body, names); }},
               s.node);
}

class Indexer {
 public:
  explicit Indexer(const Analysis& analysis) : analysis_(analysis), grammar_(analysis.parsed.grammar), text_(analysis.text) {}

  std::vector<Mention> run() {
    attributes(grammar_.attributes, kEcosystem);
    for (const PlantGrammar& plant : grammar_.plants) this->plant(plant);
    fromTokens();
    std::stable_sort(mentions_.begin(), mentions_.end(), [](const Mention& a, const Mention& b) { return a.where.begin < b.where.begin; });
    return std::move(mentions_);
  }

 private:
  static constexpr int kEcosystem = 1;

  /// `word` at byte `begin`, if the text has it there: what a macro made has no place of its own.
  void mention(std::size_t begin, std::string_view word, SubjectKind kind, std::string key, int scope, bool defines, SourceSpan whole, std::optional<double> number = {}) {
    if (word.empty() || text_.substr(std::min(begin, text_.size())).substr(0, word.size()) != word) return;
    mentions_.push_back({{static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(begin + word.size())}, kind, std::move(key), scope, defines, number, whole});
  }

  // ---- plants and attributes

  void attributes(const std::vector<Attribute>& list, int scope) {
    Names& names = named_[scope];
    attributeScopes_.insert(scope);
    for (const Attribute& a : list) names.insert(a.name);
    for (const Attribute& a : list) {
      mention(a.where.begin, a.name, SubjectKind::Attribute, a.name, scope, true, a.where);
      whole_ = a.where;
      expression(a.value, {scope, kEcosystem});
    }
  }
  void plant(const PlantGrammar& plant) {
    const int scope = nextScope_++;
    attributes(plant.attributes, scope);
    for (const OrganBlock& organ : plant.organs) {
      attributes(organ.attributes, nextScope_++);
      for (const Stage& stage : organ.stages) {
        const std::string key = std::string(letterOf(organ.kind)) + "/1";
        mention(stage.where.begin, "Stage", SubjectKind::Module, key, 0, true, stage.where, stage.number);
        attributes(stage.attributes, nextScope_++);
      }
    }
    rules(plant.rules, scope);
    for (const RuleSet& further : plant.subRules) rules(further, scope);
  }

  // ---- rules

  void rules(const RuleSet& rules, int plantScope) {
    const int scope = nextScope_++;
    Names& globals = named_[scope];
    for (const Block* block : {&rules.start, &rules.startEach, &rules.endEach, &rules.end}) assignedNames(*block, globals);
    globals.insert(rules.externals.begin(), rules.externals.end());
    for (const ArrayDeclaration& array : rules.arrays) globals.insert(array.name);
    const Scopes scopes{scope, plantScope, kEcosystem};
    whole_ = {};
    for (const Block* block : {&rules.start, &rules.startEach, &rules.endEach, &rules.end}) statements(*block, scopes);
    for (const ArrayDeclaration& array : rules.arrays)
      for (const ExprId id : array.initial) expression(id, scopes);
    if (rules.derivationLength) expression(*rules.derivationLength, scopes);
    modules(rules.axiom, scopes, Side::Made);
    productions(rules.productions, scopes);
    if (rules.decomposition) productions(rules.decomposition->productions, scopes);
    if (rules.homomorphism) productions(rules.homomorphism->productions, scopes);
    productions(rules.interaction, scopes);
  }

  using Scopes = std::vector<int>;
  enum class Side { Rewritten, Context, Made };

  void productions(const std::vector<Production>& list, const Scopes& outer) {
    for (const Production& p : list) production(p, outer);
  }
  void production(const Production& p, const Scopes& outer) {
    const int scope = nextScope_++;
    Names& own = named_[scope];
    for (const auto* side : {&p.left, &p.predecessor, &p.right})
      for (const Module& m : *side)
        for (const ExprId id : m.arguments)
          if (const auto* name = std::get_if<Name>(&grammar_.at(id).node)) own.insert(name->name);
    Names set;
    assignedNames(p.before, set);
    assignedNames(p.after, set);
    for (const std::string& name : set)
      if (!isNamed(name, outer)) own.insert(name);
    Scopes scopes{scope};
    scopes.insert(scopes.end(), outer.begin(), outer.end());
    whole_ = p.where;
    modules(p.left, scopes, Side::Context);
    modules(p.predecessor, scopes, Side::Rewritten);
    modules(p.right, scopes, Side::Context);
    statements(p.before, scopes);
    if (p.condition) expression(*p.condition, scopes);
    statements(p.after, scopes);
    for (const Successor& s : p.successors) {
      modules(s.modules, scopes, Side::Made);
      if (s.weight) expression(*s.weight, scopes);
    }
  }
  void modules(const std::vector<Module>& list, const Scopes& scopes, Side side) {
    for (std::size_t i = 0; i < list.size(); ++i) {
      const Module& m = list[i];
      std::optional<double> number;
      if (!m.arguments.empty() && organOfLetter(m.letter))
        if (const auto* literal = std::get_if<Number>(&grammar_.at(m.arguments[0]).node)) number = literal->value;
      mention(m.where.begin, m.letter, SubjectKind::Module, m.letter + "/" + std::to_string(m.arguments.size()), 0, side == Side::Rewritten && i == 0, whole_, number);
      for (const ExprId id : m.arguments) expression(id, scopes, side != Side::Made);
    }
  }

  // ---- statements and expressions

  void statements(const Block& block, const Scopes& scopes) {
    for (const Statement& s : block)
      std::visit(overloaded{[&](const Assign& a) {
                              name(s.where.begin, a.name, scopes, true);
                              expression(a.value, scopes);
                            },
                            [&](const AssignElement& a) {
                              name(s.where.begin, a.array, scopes, false);
                              for (const ExprId id : a.indices) expression(id, scopes);
                              expression(a.value, scopes);
                            },
                            [&](const Evaluate& e) { expression(e.value, scopes); },
                            [&](const If& i) {
                              expression(i.condition, scopes);
                              statements(i.yes, scopes);
                              statements(i.no, scopes);
                            },
                            [&](const While& w) {
                              expression(w.condition, scopes);
                              statements(w.body, scopes);
                            }},
                 s.node);
  }
  void expression(ExprId id, const Scopes& scopes, bool binds = false) {
    if (!id.valid()) return;
    const Expr& e = grammar_.at(id);
    const auto inner = [&](ExprId child) { expression(child, scopes); };
    std::visit(overloaded{[](const Number&) {}, [&](const Name& n) { name(e.where.begin, n.name, scopes, binds); }, [](const Text&) {},
                          [&](const Unary& u) { inner(u.operand); },
                          [&](const Binary& b) { inner(b.left), inner(b.right); },
                          [&](const Chain& c) { std::for_each(c.operands.begin(), c.operands.end(), inner); },
                          [&](const Conditional& c) { inner(c.condition), inner(c.yes), inner(c.no); },
                          [&](const Call& c) {
                            mention(e.where.begin, c.function, SubjectKind::Function, c.function, 0, false, whole_);
                            std::for_each(c.arguments.begin(), c.arguments.end(), inner);
                          },
                          [&](const Element& a) {
                            name(e.where.begin, a.array, scopes, false);
                            std::for_each(a.indices.begin(), a.indices.end(), inner);
                          }},
               e.node);
  }
  void name(std::size_t begin, const std::string& word, const Scopes& scopes, bool defines) {
    int scope = scopes.front();
    bool known = false;
    for (auto s = scopes.begin(); s != scopes.end() && !known; ++s)
      if (named_[*s].contains(word)) scope = *s, known = true;
    mention(begin, word, known && attributeScopes_.contains(scope) ? SubjectKind::Attribute : SubjectKind::Name, word, scope, defines, whole_);
  }
  bool isNamed(const std::string& word, const Scopes& scopes) {
    return std::any_of(scopes.begin(), scopes.end(), [&](int s) { return named_[s].contains(word); });
  }

  // ---- what only the tokens say

  void fromTokens() {
    bool defined = false;
    std::string_view last;
    for (const ServiceToken& token : analysis_.tokens) {
      const std::string_view word = text_.substr(token.span.begin, token.span.end - token.span.begin);
      if (token.role == TokenRole::Macro) mention(token.span.begin, word, SubjectKind::Macro, std::string(word), 0, defined, token.span);
      // Where a Stage can be read, it is the module of its number.
      const bool stage = word == "Stage" && analysis_.language == Language::SimEco;
      if (token.role == TokenRole::Keyword && !stage) mention(token.span.begin, word, SubjectKind::Keyword, std::string(word), 0, false, token.span);
      if (token.role == TokenRole::Text && analysis_.language == Language::LSystem && last.ends_with(':'))
        mention(token.span.begin, word, SubjectKind::Label, std::string(word), 0, true, token.span);
      defined = token.role == TokenRole::Directive && word.ends_with("define");
      last = word;
    }
  }

  const Analysis& analysis_;
  const Grammar& grammar_;
  std::string_view text_;
  std::vector<Mention> mentions_;
  std::map<int, Names> named_;  ///< what each scope names
  std::set<int> attributeScopes_;
  int nextScope_ = 2;
  SourceSpan whole_;
};

}  // namespace

std::vector<Mention> mentionsIn(const Analysis& analysis) { return Indexer(analysis).run(); }

const Mention* mentionAt(const std::vector<Mention>& mentions, std::size_t offset) {
  const Mention* found = nullptr;
  for (const Mention& m : mentions) {
    if (m.where.begin > offset) break;
    if (offset < m.where.end || (offset == m.where.end && found == nullptr)) found = &m;
  }
  return found;
}

}  // namespace axil::simeco
