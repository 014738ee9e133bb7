#include "simeco/engine_plan.hpp"

#include <algorithm>
#include <map>

namespace axil::simeco {

namespace {

bool demandsNothing(const CompiledRule& rule) { return rule.predecessor.front().demands.empty() && !rule.hasCondition; }
bool contextFree(const CompiledRule& rule) { return rule.left.empty() && rule.right.empty(); }

/// One neighbour at each side at most, nothing asked of its parameters.
bool asksForCodesOnly(const CompiledRule& rule, const Program& program) {
  const auto plain = [&](const std::vector<Pattern>& context) {
    return context.empty() || (context.size() == 1 && context.front().kind == Pattern::Kind::Symbol && program.parameterCount[context.front().code] == 0);
  };
  return plain(rule.left) && plain(rule.right) && (rule.right.empty() || rule.simpleRight);
}

/// Whether the term is a constant or a multiple or a sum of one parameter.
bool quickTerm(const Term& term, QuickTerm& quick) {
  quick.slot = term.slot;
  switch (term.kind) {
    case Term::Kind::Constant: quick.constant = 1; quick.value = term.value; quick.slot = 0; return true;
    case Term::Kind::Local: return true;
    case Term::Kind::LocalTimes: quick.factor = term.value; return true;
    case Term::Kind::LocalPlus: quick.value = term.value; return true;
    case Term::Kind::LocalOver:
    case Term::Kind::LocalCompared:
    case Term::Kind::Coded: break;
  }
  return false;
}

/// The least draw, as the whole number of which `uniform` is the 2^-53th part, that takes `choice` or a later one; 2^53 where none
/// does. Found by halving, so that comparing whole numbers takes exactly what `chosen` would.
std::uint64_t thresholdOf(const Plan& plan, std::size_t choice) {
  std::uint64_t low = 0, high = std::uint64_t{1} << 53;
  while (low < high) {
    const std::uint64_t middle = (low + high) / 2;
    if (chosen(plan.weights, plan.sum * (static_cast<double>(middle) * 0x1.0p-53)) >= choice)
      high = middle;
    else
      low = middle + 1;
  }
  return low;
}

class Planner {
 public:
  explicit Planner(const Program& program) : program_(program), main_(program.main()), plans_(std::make_unique<Plans>()) {}

  std::unique_ptr<Plans> plans() {
    plans_->codes = program_.symbols->size();
    for (std::size_t code = 0; code < 256; ++code)
      plans_->hot[code].role = program_.opens[code] ? Plans::Opens : program_.closes[code] ? Plans::Closes : main_.ignored[code] ? Plans::Ignored : Plans::Considered;
    for (std::size_t code = 0; code < 256; ++code) planTurns(static_cast<SymbolCode>(code));
    plans_->decomposes = !main_.decomposition.empty();
    for (std::size_t code = 0; code < plans_->codes; ++code) plans_->hot[code].decomposes = !main_.decomposition.bySymbol[code].all.empty();
    for (const CompiledRule& rule : main_.decomposition.rules) {
      addNeeds(rule);
      plans_->decomposesByChance = plans_->decomposesByChance || rule.random || rule.randomCondition;
    }
    for (std::size_t code = 0; code < plans_->codes; ++code) planSymbol(code);
    planUnfolding();
    // The tables are in place now and do not move any more.
    for (std::size_t code = 0; code < plans_->codes; ++code)
      if (tableOf_[code] >= 0) plans_->bySymbol[code].table = plans_->tables[static_cast<std::size_t>(tableOf_[code])].data();
    planBytes();
    if (plans_->bytes) planPairs();
    return std::move(plans_);
  }

 private:
  /// A branch that ends leaves who was nearest where it began. From the left a branch begins with that one near, from the right with
  /// nobody.
  void planTurns(SymbolCode code) {
    constexpr SymbolCode all = 0xff, none = 0;
    const auto nobody = static_cast<SymbolCode>(plans_->codes);
    NearestTurn &left = plans_->leftTurns[code], &right = plans_->rightTurns[code];
    switch (static_cast<Plans::Role>(plans_->hot[code].role)) {
      case Plans::Considered: left = right = {none, code, none, 0}; break;
      case Plans::Ignored: left = right = {all, none, none, 0}; break;
      case Plans::Opens: left = {all, none, none, 1}, right = {none, none, all, -1}; break;
      case Plans::Closes: left = {none, none, all, -1}, right = {none, nobody, none, 1}; break;
    }
  }

  // ---- entries for strings without parameters ----------------------------------------------------------------------

  [[nodiscard]] bool allBytes() const {
    if (plans_->parameters || plans_->decomposes) return false;
    for (std::size_t code = 0; code < plans_->codes; ++code) {
      const Plan::Kind kind = plans_->hot[code].kind;
      if (kind == Plan::Kind::Rules || kind == Plan::Kind::Guarded || kind == Plan::Kind::Keep) return false;
    }
    return std::all_of(plans_->lists.begin(), plans_->lists.end(), [](const CandidateList& list) { return list.rules.empty() || list.outright != nullptr; });
  }
  void planBytes() {
    plans_->bytes = allBytes();
    if (!plans_->bytes) return;
    const std::size_t width = plans_->codes + 1;
    for (std::size_t code = 0; code < plans_->codes; ++code) {
      const Plan& plan = plans_->bySymbol[code];
      const Plan::Kind kind = plans_->hot[code].kind;
      ByteSymbol& symbol = plans_->byteSymbols[code];
      symbol.first = static_cast<std::uint32_t>(plans_->entries.size());
      symbol.drawn = kind == Plan::Kind::Lottery;
      if (kind == Plan::Kind::Copy) addEntry(code, nullptr);
      if (kind == Plan::Kind::Direct) addEntry(code, plan.direct);
      for (const QuickSuccessor* choice : plan.choices) addEntry(code, choice);
      if (kind != Plan::Kind::Neighbours) continue;
      symbol.leftStep = static_cast<std::uint16_t>(width);
      symbol.rightStep = 1;
      for (std::size_t pair = 0; pair < width * width; ++pair) addEntry(code, plans_->lists[plan.table[pair]].outright);
    }
  }
  void planPairs() {
    const std::size_t width = plans_->codes + 1;
    const bool small = plans_->entries.size() <= 0xffff && std::all_of(plans_->entries.begin(), plans_->entries.end(), [](const ByteEntry& entry) { return entry.longer == nullptr; });
    plans_->pairs = plans_->leftCodes && plans_->rightCodes && width <= 16 && small && !main_.stochastic;
    if (!plans_->pairs) return;
    plans_->pairEntries.resize(16 * 256);
    for (std::size_t code = 0; code < plans_->codes; ++code)
      for (std::size_t right = 0; right < width; ++right) {
        const std::size_t pair = code << 4 | right;
        plans_->pairTurns[pair] = plans_->leftTurns[code];
        const ByteSymbol& symbol = plans_->byteSymbols[code];
        for (std::size_t left = 0; left < width; ++left)
          plans_->pairEntries[left << 8 | pair] = static_cast<std::uint16_t>(symbol.first + left * symbol.leftStep + right * symbol.rightStep);
      }
  }
  void addEntry(std::size_t code, const QuickSuccessor* successor) {
    ByteEntry entry;
    entry.codes[0] = static_cast<SymbolCode>(code);
    entry.length = 1;
    if (successor != nullptr) {
      entry.fires = 1;
      entry.length = successor->length;
      std::copy_n(successor->codes.begin(), entry.codes.size(), entry.codes.begin());
      if (entry.length > entry.codes.size()) entry.longer = successor;
    }
    plans_->entries.push_back(entry);
    auto& keys = plans_->entryKeys.emplace_back();
    if (successor != nullptr) std::copy_n(successor->keys, std::min<std::size_t>(entry.length, keys.size()), keys.begin());
  }

  // ---- decomposition -----------------------------------------------------------------------------------------------

  /// Whether a decomposition rule asks for its module's own parameters at most, and makes none that have to be worked out.
  [[nodiscard]] bool unfoldsQuickly(const CompiledRule& rule) const {
    const Pattern& predecessor = rule.predecessor.front();
    QuickTerm ignored;
    const auto& terms = rule.successors.front().terms;
    return rule.predecessor.size() == 1 && contextFree(rule) && predecessor.demands.empty() && predecessor.slot == 0 && !rule.statements && !rule.random &&
           !rule.randomCondition && rule.frame <= program_.parameterCount[predecessor.code] && rule.successors.size() == 1 &&
           std::all_of(terms.begin(), terms.end(), [&](const Term& term) { return quickTerm(term, ignored = {}); });
  }
  void planUnfolding() {
    const auto& rules = main_.decomposition.rules;
    plans_->unfoldsQuickly = plans_->decomposes && std::all_of(rules.begin(), rules.end(), [this](const CompiledRule& rule) { return unfoldsQuickly(rule); });
    if (!plans_->unfoldsQuickly) return;
    for (std::size_t code = 0; code < plans_->codes; ++code)
      for (const std::uint32_t number : main_.decomposition.bySymbol[code].all) plans_->unfoldings[code].choices.push_back(quick(rules[number]));
    for (const auto& successor : plans_->successors) {
      successor->pieces = piecesOf(*successor->successor);
      plans_->longestUnfolding = std::max<std::size_t>(plans_->longestUnfolding, successor->length);
      plans_->mostUnfolding = std::max<std::size_t>(plans_->mostUnfolding, successor->values);
    }
  }
  [[nodiscard]] std::vector<Piece> piecesOf(const CompiledSuccessor& successor) const {
    std::vector<Piece> pieces(1);
    for (std::uint32_t i = 0; i < successor.codes.size(); ++i) {
      const SymbolCode code = successor.codes[i];
      Piece& piece = pieces.back();
      if (plans_->hot[code].decomposes) {
        piece.unfolds = true;
        piece.code = code;
        piece.parameters = program_.parameterCount[code];
        pieces.push_back({.first = i + 1});
      } else {
        ++piece.modules;
        piece.values += program_.parameterCount[code];
      }
    }
    return pieces;
  }

  void planSymbol(std::size_t code) {
    Plan& plan = plans_->bySymbol[code];
    Hot& hot = plans_->hot[code];
    hot.parameters = program_.parameterCount[code];
    plan.index = &main_.productions.bySymbol[code];
    plans_->parameters = plans_->parameters || hot.parameters > 0;
    plans_->most = std::max<std::size_t>(plans_->most, hot.parameters);
    std::vector<const CompiledRule*> rules;
    for (const std::uint32_t number : plan.index->all) rules.push_back(&main_.productions.rules[number]);
    for (const CompiledRule* rule : rules) measure(*rule);
    hot.kind = kindOf(plan, rules, code);
    if (hot.kind == Plan::Kind::Copy && hot.decomposes) hot.kind = Plan::Kind::Keep;
    using Kind = Plan::Kind;
    plans_->leaps = plans_->leaps && !plans_->decomposes && (hot.kind == Kind::Copy || (hot.kind == Kind::Direct && plan.direct->successor->constant));
    const bool steady = hot.kind == Kind::Copy || hot.role == Plans::Considered || hot.role == Plans::Ignored;
    const bool calm = hot.kind == Kind::Copy || hot.kind == Kind::Direct || hot.kind == Kind::Guarded || hot.kind == Kind::Neighbours;
    const bool random = std::any_of(rules.begin(), rules.end(), [](const CompiledRule* r) { return r->random; });
    plans_->calms = plans_->calms && steady && calm && !random && !plans_->decomposes;
  }
  void measure(const CompiledRule& rule) {
    for (const CompiledSuccessor& successor : rule.successors) {
      plans_->longest = std::max(plans_->longest, successor.codes.size());
      plans_->most = std::max(plans_->most, successor.terms.size());
    }
  }

  Plan::Kind kindOf(Plan& plan, const std::vector<const CompiledRule*>& rules, std::size_t code) {
    if (rules.empty()) return Plan::Kind::Copy;
    const auto all = [&](auto holds) { return std::all_of(rules.begin(), rules.end(), holds); };
    const bool free = all([](const CompiledRule* r) { return contextFree(*r); });
    const bool single = all([](const CompiledRule* r) { return r->successors.size() == 1; });
    if (main_.stochastic && free && all([](const CompiledRule* r) {
          const Term& weight = r->successors.front().weight;
          return demandsNothing(*r) && weight.kind == Term::Kind::Constant && weight.value >= 0;
        }))
      return lottery(plan, rules);
    if (!main_.stochastic && contextFree(*rules.front()) && demandsNothing(*rules.front()) && rules.front()->successors.size() == 1) {
      plan.direct = quick(*rules.front());
      return Plan::Kind::Direct;
    }
    if (!main_.stochastic && free && single && all([](const CompiledRule* r) { return r->predecessor.front().demands.empty() && !r->randomCondition; })) {
      for (const CompiledRule* rule : rules) plan.choices.push_back(quick(*rule));
      return Plan::Kind::Guarded;
    }
    constexpr std::size_t mostCodes = 64;
    const bool codesOnly = all([&](const CompiledRule* r) { return asksForCodesOnly(*r, program_); });
    if (!main_.stochastic && !free && codesOnly && !plan.index->numbered && plans_->codes <= mostCodes) return neighbours(rules, code);
    for (const CompiledRule* rule : rules) addNeeds(*rule);
    return Plan::Kind::Rules;
  }

  const QuickSuccessor* quick(const CompiledRule& rule) {
    auto q = std::make_unique<QuickSuccessor>();
    q->rule = &rule;
    q->successor = &rule.successors.front();
    q->keys = q->successor->keys.data();
    q->random = rule.random;
    q->length = static_cast<std::uint32_t>(q->successor->codes.size());
    q->values = static_cast<std::uint32_t>(q->successor->terms.size());
    std::copy_n(q->successor->codes.begin(), std::min<std::size_t>(q->length, q->codes.size()), q->codes.begin());
    for (const Term& term : q->successor->terms) q->quick = quickTerm(term, q->terms.emplace_back()) && q->quick;
    for (const SymbolCode code : q->successor->codes) q->decomposes = q->decomposes || plans_->hot[code].decomposes;
    q->unfolds = q->quick;
    q->quick = q->quick && !q->decomposes;
    plans_->successors.push_back(std::move(q));
    return plans_->successors.back().get();
  }
  Plan::Kind lottery(Plan& plan, const std::vector<const CompiledRule*>& rules) {
    for (const CompiledRule* rule : rules) {
      plan.choices.push_back(quick(*rule));
      plan.weights.push_back(rule->successors.front().weight.value);
      plan.sum += plan.weights.back();
    }
    for (std::size_t choice = 1; choice < plan.weights.size(); ++choice) plan.thresholds.push_back(thresholdOf(plan, choice));
    return Plan::Kind::Lottery;
  }

  /// For every pair of neighbours the rules whose contexts they meet.
  Plan::Kind neighbours(const std::vector<const CompiledRule*>& rules, std::size_t code) {
    const std::size_t width = plans_->codes + 1;
    std::vector<std::uint16_t> table(width * width);
    for (std::size_t left = 0; left < width; ++left)
      for (std::size_t right = 0; right < width; ++right) table[left * width + right] = listOf(rules, left, right);
    for (const CompiledRule* rule : rules) {
      plans_->leftCodes = plans_->leftCodes || !rule->left.empty();
      plans_->rightCodes = plans_->rightCodes || !rule->right.empty();
    }
    tableOf_[code] = static_cast<int>(plans_->tables.size());
    plans_->tables.push_back(std::move(table));
    return Plan::Kind::Neighbours;
  }
  std::uint16_t listOf(const std::vector<const CompiledRule*>& rules, std::size_t left, std::size_t right) {
    CandidateList list;
    for (const CompiledRule* rule : rules) {
      if (!rule->left.empty() && (rule->left.front().code != left || left == plans_->codes)) continue;
      if (!rule->right.empty() && (rule->right.front().code != right || right == plans_->codes)) continue;
      list.rules.push_back(rule);
    }
    const auto [known, added] = listIds_.emplace(list.rules, static_cast<std::uint16_t>(plans_->lists.size()));
    if (!added) return known->second;
    if (!list.rules.empty() && demandsNothing(*list.rules.front()) && list.rules.front()->successors.size() == 1) list.outright = quick(*list.rules.front());
    plans_->lists.push_back(std::move(list));
    return known->second;
  }

  void addNeeds(const CompiledRule& rule) {
    SurroundingNeeds& needs = plans_->needs;
    needs.left = needs.left || !rule.left.empty();
    needs.right = needs.right || (!rule.right.empty() && rule.simpleRight);
    needs.brackets = needs.brackets || !rule.simpleRight;
    for (const auto* context : {&rule.left, &rule.right})
      for (const Pattern& pattern : *context)
        needs.offsets = needs.offsets || (pattern.kind == Pattern::Kind::Symbol && program_.parameterCount[pattern.code] > 0);
  }

  const Program& program_;
  const System& main_;
  std::unique_ptr<Plans> plans_;
  std::array<int, 256> tableOf_ = [] {
    std::array<int, 256> none{};
    none.fill(-1);
    return none;
  }();
  std::map<std::vector<const CompiledRule*>, std::uint16_t> listIds_;
};

}  // namespace

std::unique_ptr<Plans> planFor(const Program& program) { return Planner(program).plans(); }

}  // namespace axil::simeco
