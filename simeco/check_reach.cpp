#include "simeco/check_reach.hpp"

#include "base/text.hpp"
#include "simeco/check_fold.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <unordered_map>
#include <unordered_set>

namespace axil::simeco {

namespace {

// More rules of one letter than these are not compared with those below them: the work must stay linear in the text.
constexpr std::size_t kMostCompared = 16;

/// An argument of a predecessor: which module's, and which of its arguments.
using Place = std::pair<std::size_t, std::size_t>;

/// What a rule asks of the values of the modules it rewrites: literal numbers, and a condition on one of them at most.
class Demands {
 public:
  Demands(const Grammar& grammar, const Production& rule) : grammar_(&grammar), condition_(rule.condition) {
    for (std::size_t m = 0; m < rule.predecessor.size(); ++m)
      for (std::size_t k = 0; k < rule.predecessor[m].arguments.size(); ++k) {
        const ExprId id = rule.predecessor[m].arguments[k];
        if (const Number* number = numberIn(grammar, id)) literals_[{m, k}] = number->value;
        else if (const Name* name = nameIn(grammar, id)) names_.emplace(name->name, Place{m, k});
        else clear_ = false;
      }
    if (!rule.before.empty()) clear_ = clear_ && !rule.condition;
    else if (rule.condition) readCondition(grammar);
  }

  /// Whether nothing but the demands read here decides.
  [[nodiscard]] bool clear() const { return clear_; }
  [[nodiscard]] const std::map<Place, double>& literals() const { return literals_; }
  [[nodiscard]] std::optional<Place> place() const { return place_; }
  [[nodiscard]] const std::vector<double>& limits() const { return comparing_.limits; }
  /// Of a clear rule, with that value at `place()`.
  [[nodiscard]] bool holds(double value) const { return !condition_ || foldedWith(*grammar_, *condition_, comparing_.name, value).value_or(1) != 0; }

 private:
  void readCondition(const Grammar& grammar) {
    const auto comparing = comparingIn(grammar, *condition_);
    const auto found = comparing ? names_.find(std::string(comparing->name)) : names_.end();
    if (!comparing || (!comparing->name.empty() && found == names_.end())) {
      clear_ = false;
      return;
    }
    comparing_ = *comparing;
    if (found != names_.end()) place_ = found->second;
  }

  const Grammar* grammar_;
  std::optional<ExprId> condition_;
  std::map<Place, double> literals_;
  std::map<std::string, Place> names_;
  Comparing comparing_;
  std::optional<Place> place_;  ///< what the condition asks for
  bool clear_ = true;
};

/// A rule above: what it takes of the modules of the rule at hand.
struct Taking {
  const Demands* demands = nullptr;
  std::optional<double> literal;  ///< at the place that is looked at
  [[nodiscard]] bool takes(double value, const Place& place) const {
    if (literal && *literal != value) return false;
    return demands->place() != place || demands->holds(value);
  }
};

/// Between these values nothing that was compared changes.
std::vector<double> samplesAround(std::vector<double> limits) {
  std::sort(limits.begin(), limits.end());
  limits.erase(std::unique(limits.begin(), limits.end()), limits.end());
  if (limits.empty()) return {0};
  std::vector<double> samples{limits.front() - 1 - std::abs(limits.front())};
  for (std::size_t i = 0; i < limits.size(); ++i) {
    samples.push_back(limits[i]);
    samples.push_back(i + 1 < limits.size() ? limits[i] + (limits[i + 1] - limits[i]) / 2 : limits[i] + 1 + std::abs(limits[i]));
  }
  return samples;
}

bool neverHolds(const Demands& demands) {
  if (!demands.clear()) return false;
  const auto samples = samplesAround(demands.limits());
  return std::none_of(samples.begin(), samples.end(), [&](double value) { return demands.holds(value); });
}

/// The rule above with what it still asks once the literals of the rule below are known; nothing where it takes none of its modules, or
/// asks for values at more places than one.
struct Rest {
  Taking taking;
  std::optional<Place> place;
};
std::optional<Rest> restOf(const Demands& above, const Demands& below) {
  Rest rest{{&above, {}}, {}};
  for (const auto& [place, value] : above.literals()) {
    const auto known = below.literals().find(place);
    if (known != below.literals().end() && known->second != value) return std::nullopt;
    if (known != below.literals().end()) continue;
    if (rest.place) return std::nullopt;
    rest.place = place;
    rest.taking.literal = value;
  }
  if (!above.place()) return rest;
  if (const auto known = below.literals().find(*above.place()); known != below.literals().end()) return above.holds(known->second) ? std::optional(rest) : std::nullopt;
  if (rest.place && *rest.place != *above.place()) return std::nullopt;
  rest.place = above.place();
  return rest;
}

/// Whether the rules above take, value by value at one place, everything that the rule below could take.
bool taken(const std::vector<const Demands*>& above, const Demands& below) {
  std::map<Place, std::vector<Taking>> byPlace;
  for (const Demands* demands : above) {
    const auto rest = restOf(*demands, below);
    if (!rest) continue;
    if (!rest->place) return true;
    byPlace[*rest->place].push_back(rest->taking);
  }
  for (const auto& entry : byPlace) {
    const Place& place = entry.first;
    const std::vector<Taking>& takings = entry.second;
    std::vector<double> limits;
    const bool own = below.clear() && below.place() == place;
    if (own) limits = below.limits();
    for (const Taking& taking : takings) {
      limits.insert(limits.end(), taking.demands->limits().begin(), taking.demands->limits().end());
      if (taking.literal) limits.push_back(*taking.literal);
    }
    const auto samples = samplesAround(limits);
    const bool all = std::all_of(samples.begin(), samples.end(), [&](double value) {
      return (own && !below.holds(value)) || std::any_of(takings.begin(), takings.end(), [&](const Taking& taking) { return taking.takes(value, place); });
    });
    if (all) return true;
  }
  return false;
}

/// Letters and numbers of arguments of the first modules of a predecessor.
std::string signatureOf(const Production& rule, std::size_t modules) {
  std::string signature;
  for (std::size_t m = 0; m < modules; ++m) signature += rule.predecessor[m].letter + '/' + std::to_string(rule.predecessor[m].arguments.size()) + ' ';
  return signature;
}
bool allLiteral(const Grammar& grammar, const Production& rule) {
  return std::all_of(rule.predecessor.begin(), rule.predecessor.end(), [&](const Module& m) {
    return std::all_of(m.arguments.begin(), m.arguments.end(), [&](ExprId id) { return numberIn(grammar, id) != nullptr; });
  });
}
std::string literalKey(const Grammar& grammar, const Production& rule) {
  std::string key = signatureOf(rule, rule.predecessor.size());
  for (const Module& m : rule.predecessor)
    for (const ExprId id : m.arguments) key += shortest(numberIn(grammar, id)->value) + ',';
  return key;
}

}  // namespace

std::vector<std::optional<Unreached>> unreachedRules(const Grammar& grammar, const std::vector<Production>& rules, Order order) {
  std::vector<std::optional<Unreached>> result(rules.size());
  std::vector<Demands> demands;
  demands.reserve(rules.size());
  std::unordered_map<std::string, std::vector<const Demands*>> general;  // by signature
  std::unordered_set<std::string> exact;                                 // rules for literal numbers alone
  for (std::size_t i = 0; i < rules.size(); ++i) {
    const Production& rule = rules[i];
    const Demands& own = demands.emplace_back(grammar, rule);
    if (rule.predecessor.empty()) continue;
    if (neverHolds(own)) {
      result[i] = Unreached::ByItsCondition;
      continue;
    }
    if (order == Order::ByChance) continue;
    const bool literal = allLiteral(grammar, rule);
    bool hidden = literal && exact.contains(literalKey(grammar, rule));
    for (std::size_t modules = 1; modules <= rule.predecessor.size() && !hidden; ++modules)
      if (const auto above = general.find(signatureOf(rule, modules)); above != general.end()) hidden = taken(above->second, own);
    if (hidden) result[i] = Unreached::ByRulesAbove;
    if (hidden || !own.clear() || !rule.left.empty() || !rule.right.empty()) continue;
    if (literal && !rule.condition && !own.literals().empty()) exact.insert(literalKey(grammar, rule));
    else if (auto& list = general[signatureOf(rule, rule.predecessor.size())]; list.size() < kMostCompared) list.push_back(&own);
  }
  return result;
}

bool firesAlways(const Grammar& grammar, const Production& rule) {
  const Demands demands(grammar, rule);
  if (!demands.clear() || !rule.left.empty() || !rule.right.empty()) return false;
  const auto samples = samplesAround(demands.limits());
  return std::all_of(samples.begin(), samples.end(), [&](double value) { return demands.holds(value); });
}

}  // namespace axil::simeco
