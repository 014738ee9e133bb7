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

class Planner {
 public:
  explicit Planner(const Program& program) : program_(program), main_(program.main()) {}

  Plans plans() {
    plans_.codes = program_.symbols->size();
    for (std::size_t code = 0; code < 256; ++code)
      plans_.roles[code] = program_.opens[code] ? Plans::Opens : program_.closes[code] ? Plans::Closes : main_.ignored[code] ? Plans::Ignored : Plans::Considered;
    for (std::size_t code = 0; code < plans_.codes; ++code) planSymbol(code);
    // The tables are in place now and do not move any more.
    for (std::size_t code = 0; code < plans_.codes; ++code)
      if (tableOf_[code] >= 0) plans_.bySymbol[code].table = plans_.tables[static_cast<std::size_t>(tableOf_[code])].data();
    return std::move(plans_);
  }

 private:
  void planSymbol(std::size_t code) {
    Plan& plan = plans_.bySymbol[code];
    plan.parameters = program_.parameterCount[code];
    plan.index = &main_.productions.bySymbol[code];
    plans_.parameters = plans_.parameters || plan.parameters > 0;
    plans_.most = std::max<std::size_t>(plans_.most, plan.parameters);
    plan.kind = kindOf(plan, code);
    plans_.constant = plans_.constant && (plan.kind == Plan::Kind::Copy || plan.kind == Plan::Kind::Constant);
    for (const std::uint32_t number : plan.index->all) measure(main_.productions.rules[number]);
  }
  void measure(const CompiledRule& rule) {
    for (const CompiledSuccessor& successor : rule.successors) {
      plans_.longest = std::max(plans_.longest, successor.codes.size());
      plans_.most = std::max(plans_.most, successor.terms.size());
    }
  }

  Plan::Kind kindOf(Plan& plan, std::size_t code) {
    const auto rules = rulesOf(plan);
    if (rules.empty()) return Plan::Kind::Copy;
    const CompiledRule& first = *rules.front();
    if (!main_.stochastic && demandsNothing(first) && contextFree(first) && first.successors.size() == 1) return direct(plan, first);
    if (main_.stochastic && std::all_of(rules.begin(), rules.end(), [](const CompiledRule* r) {
          return demandsNothing(*r) && contextFree(*r) && r->successors.front().weight.kind == Term::Kind::Constant && r->successors.front().weight.value >= 0;
        }))
      return lottery(plan, rules);
    constexpr std::size_t mostCodes = 64;
    const bool codesOnly = std::all_of(rules.begin(), rules.end(), [&](const CompiledRule* r) { return asksForCodesOnly(*r, program_); });
    const bool context = std::any_of(rules.begin(), rules.end(), [](const CompiledRule* r) { return !contextFree(*r); });
    if (!main_.stochastic && context && codesOnly && !plan.index->numbered && plans_.codes <= mostCodes) return neighbours(rules, code);
    for (const CompiledRule* rule : rules) addNeeds(*rule);
    return Plan::Kind::Rules;
  }
  [[nodiscard]] std::vector<const CompiledRule*> rulesOf(const Plan& plan) const {
    std::vector<const CompiledRule*> rules;
    for (const std::uint32_t number : plan.index->all) rules.push_back(&main_.productions.rules[number]);
    return rules;
  }

  static Plan::Kind direct(Plan& plan, const CompiledRule& rule) {
    plan.rule = &rule;
    plan.successor = &rule.successors.front();
    plan.length = static_cast<std::uint32_t>(plan.successor->codes.size());
    plan.values = static_cast<std::uint32_t>(plan.successor->terms.size());
    std::copy_n(plan.successor->codes.begin(), std::min<std::size_t>(plan.length, plan.codes.size()), plan.codes.begin());
    return plan.successor->constant ? Plan::Kind::Constant : Plan::Kind::Direct;
  }
  static Plan::Kind lottery(Plan& plan, const std::vector<const CompiledRule*>& rules) {
    plan.lottery = rules;
    for (const CompiledRule* rule : rules) {
      plan.weights.push_back(rule->successors.front().weight.value);
      plan.sum += plan.weights.back();
    }
    return Plan::Kind::Lottery;
  }

  /// For every pair of neighbours the rules whose contexts they meet.
  Plan::Kind neighbours(const std::vector<const CompiledRule*>& rules, std::size_t code) {
    const std::size_t width = plans_.codes + 1;
    std::vector<std::uint16_t> table(width * width);
    for (std::size_t left = 0; left < width; ++left)
      for (std::size_t right = 0; right < width; ++right) table[left * width + right] = listOf(rules, left, right);
    for (const CompiledRule* rule : rules) {
      plans_.leftCodes = plans_.leftCodes || !rule->left.empty();
      plans_.rightCodes = plans_.rightCodes || !rule->right.empty();
    }
    tableOf_[code] = static_cast<int>(plans_.tables.size());
    plans_.tables.push_back(std::move(table));
    return Plan::Kind::Neighbours;
  }
  std::uint16_t listOf(const std::vector<const CompiledRule*>& rules, std::size_t left, std::size_t right) {
    CandidateList list;
    for (const CompiledRule* rule : rules) {
      if (!rule->left.empty() && (rule->left.front().code != left || left == plans_.codes)) continue;
      if (!rule->right.empty() && (rule->right.front().code != right || right == plans_.codes)) continue;
      list.outright = list.outright || (list.rules.empty() && demandsNothing(*rule) && rule->successors.size() == 1);
      list.rules.push_back(rule);
    }
    const auto [known, added] = listIds_.emplace(list.rules, static_cast<std::uint16_t>(plans_.lists.size()));
    if (added) plans_.lists.push_back(list);
    return known->second;
  }

  void addNeeds(const CompiledRule& rule) {
    SurroundingNeeds& needs = plans_.needs;
    needs.left = needs.left || !rule.left.empty();
    needs.right = needs.right || (!rule.right.empty() && rule.simpleRight);
    needs.brackets = needs.brackets || !rule.simpleRight;
    for (const auto* context : {&rule.left, &rule.right})
      for (const Pattern& pattern : *context)
        needs.offsets = needs.offsets || (pattern.kind == Pattern::Kind::Symbol && program_.parameterCount[pattern.code] > 0);
  }

  const Program& program_;
  const System& main_;
  Plans plans_;
  std::array<int, 256> tableOf_ = [] {
    std::array<int, 256> none{};
    none.fill(-1);
    return none;
  }();
  std::map<std::vector<const CompiledRule*>, std::uint16_t> listIds_;
};

}  // namespace

Plans planFor(const Program& program) { return Planner(program).plans(); }

}  // namespace axil::simeco
