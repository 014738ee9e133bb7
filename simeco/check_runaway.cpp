#include "simeco/check_runaway.hpp"

#include "simeco/check_reach.hpp"

#include "simeco/derive.hpp"
#include "simeco/language.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

namespace axil::simeco {

namespace {

constexpr std::size_t kMostWork = 4'000'000;  ///< additions; a check must stay quick
constexpr std::size_t kMostSymbols = 20'000;

/// What a module is to the rules, as far as it is written. Compared number first: a measured plant's modules are one letter with a
/// thousand numbers.
struct SymbolKey {
  std::optional<double> number = {};  ///< literal first argument
  std::size_t arguments = 0;
  std::string letter;
  friend auto operator<=>(const SymbolKey&, const SymbolKey&) = default;
};

struct Made {
  std::size_t symbol = 0;
  double count = 0;
};

class Estimate {
 public:
  Estimate(const Grammar& grammar, const RuleSet& rules) : grammar_(grammar) {
    for (const Production& p : rules.productions)
      if (!p.predecessor.empty()) first_.try_emplace(keyOf(p.predecessor[0]), &p);
    for (const auto& [key, production] : first_)
      if (key.number) firstNumbered(key, production);
    for (const Module& m : rules.axiom) axiom_.push_back({symbolOf(m), 1});
    for (std::size_t i = 0; i < symbols_.size() && symbols_.size() < kMostSymbols; ++i) addSuccessors(i);
  }

  /// Modules after `steps` steps, as far as they are certain; stops above `enough`.
  struct Total {
    double modules = 0;
    std::int64_t steps = 0;
    const Production* most = nullptr;  ///< the rule that made most of them
  };
  [[nodiscard]] Total after(std::int64_t steps, double enough) const {
    std::vector<double> counts(symbols_.size(), 0);
    for (const Made& m : axiom_) counts[m.symbol] += m.count;
    Total total;
    std::size_t work = 0;
    for (total.steps = 0; total.steps < steps && work < kMostWork; ++total.steps) {
      std::vector<double> next(symbols_.size(), 0);
      double most = 0;
      for (std::size_t i = 0; i < counts.size(); ++i) {
        if (counts[i] == 0) continue;
        if (fires_[i] == nullptr) next[i] += counts[i];
        double here = 0;
        for (const Made& m : made_[i]) next[m.symbol] += counts[i] * m.count, here += counts[i] * m.count;
        if (here > most) most = here, total.most = fires_[i];
        work += 1 + made_[i].size();
      }
      const bool still = next == counts;
      counts = std::move(next);
      total.modules = 0;
      for (const double n : counts) total.modules += n;
      if (total.modules > enough || still) break;
    }
    return total;
  }

  /// A rule that is reached from the axiom and makes, by itself or by others, its predecessor again.
  [[nodiscard]] const Production* endless() const {
    std::vector<int> state(symbols_.size(), 0);  // 0 new, 1 open, 2 done
    for (const Made& start : axiom_) {
      struct Frame {
        std::size_t symbol, next;
      };
      std::vector<Frame> open;
      if (state[start.symbol] == 0) open.push_back({start.symbol, 0}), state[start.symbol] = 1;
      while (!open.empty()) {
        Frame& top = open.back();
        if (top.next == made_[top.symbol].size()) {
          state[top.symbol] = 2;
          open.pop_back();
          continue;
        }
        const std::size_t child = made_[top.symbol][top.next++].symbol;
        // What becomes only itself stays as it is.
        const bool same = child == top.symbol && made_[child].size() == 1 && made_[child][0].count == 1 && symbols_[child].number;
        if (state[child] == 1 && !same) return fires_[child];
        if (state[child] == 0) open.push_back({child, 0}), state[child] = 1;
      }
    }
    return nullptr;
  }

 private:
  [[nodiscard]] SymbolKey keyOf(const Module& m) const {
    SymbolKey key{{}, m.arguments.size(), m.letter};
    if (grammar_.language == Language::SimEco && !m.arguments.empty())
      if (const auto* n = std::get_if<Number>(&grammar_.at(m.arguments[0]).node)) key.number = n->value;
    return key;
  }
  void firstNumbered(const SymbolKey& key, const Production* production) {
    const auto [found, isNew] = numbered_.try_emplace({{}, key.arguments, key.letter}, production);
    if (!isNew) found->second = std::min(found->second, production);
  }
  std::size_t symbolOf(const Module& m) {
    const SymbolKey key = keyOf(m);
    const auto [found, isNew] = index_.try_emplace(key, symbols_.size());
    if (isNew) {
      symbols_.push_back(key);
      made_.emplace_back();
      fires_.push_back(nullptr);
    }
    return found->second;
  }
  /// The first rule for the symbol, when it certainly fires. All rules stand in one row, so the earlier one has the lower address.
  [[nodiscard]] const Production* ruleFor(const SymbolKey& key) const {
    const SymbolKey any{{}, key.arguments, key.letter};
    const Production* rule = ruleIn(first_, any);
    if (key.number) {
      const Production* exact = ruleIn(first_, key);
      if (rule == nullptr || (exact != nullptr && exact < rule)) rule = exact;
    } else if (const Production* numbered = ruleIn(numbered_, any); numbered != nullptr && (rule == nullptr || numbered < rule)) {
      return nullptr;  // it depends on the value
    }
    if (rule == nullptr) return nullptr;
    const bool always = rule->predecessor.size() == 1 && rule->before.empty() && firesAlways(grammar_, *rule);
    return always && furtherAreNames(rule->predecessor[0]) ? rule : nullptr;
  }
  using RuleMap = std::map<SymbolKey, const Production*>;
  static const Production* ruleIn(const RuleMap& rules, const SymbolKey& key) {
    const auto found = rules.find(key);
    return found == rules.end() ? nullptr : found->second;
  }
  [[nodiscard]] bool furtherAreNames(const Module& m) const {
    return m.arguments.size() < 2 || std::all_of(m.arguments.begin() + 1, m.arguments.end(), [&](ExprId id) { return std::holds_alternative<Name>(grammar_.at(id).node); });
  }
  void addSuccessors(std::size_t symbol) {
    const Production* p = ruleFor(symbols_[symbol]);
    if (p == nullptr || p->successors.size() != 1) return;  // of a choice the smallest way may be taken
    fires_[symbol] = p;
    std::map<std::size_t, double> counts;
    for (const Module& m : p->successors[0].modules) counts[symbolOf(m)] += 1;
    for (const auto& [made, count] : counts) made_[symbol].push_back({made, count});
  }

  const Grammar& grammar_;
  RuleMap first_;     ///< of each predecessor the first rule
  RuleMap numbered_;  ///< of each letter the first rule for a literal number
  std::map<SymbolKey, std::size_t> index_;
  std::vector<SymbolKey> symbols_;
  std::vector<std::vector<Made>> made_;
  std::vector<const Production*> fires_;
  std::vector<Made> axiom_;
};

std::string about(double count) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1e", count);
  return text;
}

/// The rules that are drawn by chance may stop at any time.
bool byChance(const RuleSet& rules, const Grammar& grammar) { return grammar.language == Language::LSystem && rules.seed.has_value(); }

}  // namespace

void warnAboutRunaway(const Grammar& grammar, const RuleSet& rules, Report& report) {
  if (rules.axiom.empty() || rules.productions.empty() || byChance(rules, grammar)) return;
  const Estimate estimate(grammar, rules);
  if (!rules.derivationLength) {
    if (const Production* p = estimate.endless())
      report.warning(p->where, "this never ends: the rule makes " + printModule(grammar, p->predecessor[0]) + " again in every case", "give it a condition, or say how many steps to do: steps = 10;");
    return;
  }
  const auto* steps = std::get_if<Number>(&grammar.at(*rules.derivationLength).node);
  if (steps == nullptr || !(steps->value >= 1) || steps->value > 1e9) return;
  const auto most = static_cast<double>(Limits{}.modules);
  const auto total = estimate.after(static_cast<std::int64_t>(steps->value), most);
  if (total.modules > most && total.most != nullptr)
    report.warning(total.most->where, "this grows beyond the limit of " + std::to_string(Limits{}.modules) + " modules: " + about(total.modules) + " after " + std::to_string(total.steps + 1) +
                                          " of " + textOf(*steps) + " steps", "derive fewer steps, or raise the limit with --max-modules");
}

}  // namespace axil::simeco
