#include "simeco/engine_calm.hpp"

#include <algorithm>
#include <cmath>

namespace axil::simeco {

namespace {

// At most this share of the modules may move.
constexpr std::size_t kShare = 32;

}  // namespace

bool Calm::worthTrying(std::size_t modules) const {
  if (!plans_.calms || modules < fewest_ || modules >= nowhere) return false;
  return known_ || (patience_ == 0 && lastFired_ <= modules / kShare);
}

void Calm::disturbed(std::size_t fired) {
  lastFired_ = fired;
  known_ = false;
  if (patience_ > 0) --patience_;
}

void Calm::readTables(const ModuleString& string) {
  const std::span<const SymbolCode> codes = string.codes();
  left_.setSize(codes.size());
  right_.setSize(codes.size());
  withOffsets_ = !string.parameters().empty();
  if (withOffsets_) offsets_.read(program_, codes);
  std::uint32_t last = nowhere;
  // The stack holds, for every open bracket, its place and the left neighbour before it.
  stack_.clear();
  for (std::uint32_t i = 0; i < codes.size(); ++i) {
    const SymbolCode code = codes[i];
    left_[i] = last;
    if (role(code) == Plans::Considered) last = i;
    if (role(code) == Plans::Opens) {
      stack_.push(i);
      stack_.push(last);
      left_[i] = nowhere;
    }
    if (role(code) != Plans::Closes) continue;
    left_[i] = nowhere;
    last = nowhere;
    if (stack_.size() == 0) continue;
    last = stack_[stack_.size() - 1];
    const std::uint32_t open = stack_[stack_.size() - 2];
    stack_.setSize(stack_.size() - 2);
    left_[i] = open;
    left_[open] = i;
  }
  std::uint32_t next = nowhere;
  stack_.clear();
  for (auto i = static_cast<std::uint32_t>(codes.size()); i-- > 0;) {
    right_[i] = next;
    const std::uint8_t r = role(codes[i]);
    if (r == Plans::Considered) next = i;
    if (r == Plans::Closes) {
      stack_.push(next);
      next = nowhere;
    }
    if (r != Plans::Opens) continue;
    next = stack_.size() == 0 ? nowhere : stack_[stack_.size() - 1];
    if (stack_.size() > 0) stack_.setSize(stack_.size() - 1);
  }
}

/// One module for one, with the same place in the tables.
bool Calm::fits(SymbolCode code, const CompiledSuccessor& successor) const {
  if (successor.codes.size() != 1) return false;
  const SymbolCode made = successor.codes.front();
  return role(made) == role(code) && program_.parameterCount[made] == program_.parameterCount[code];
}

/// What the step does with one module; false when it does not fit in place.
bool Calm::decide(const ModuleString& string, std::uint32_t at, std::uint32_t offset, Machine& machine) {
  const std::span<const SymbolCode> codes = string.codes();
  const SymbolCode code = codes[at];
  const Plan& plan = plans_.bySymbol[code];
  double* const locals = const_cast<double*>(string.parameters().data()) + offset;
  const auto holds = [&](const CompiledRule& rule) {
    for (const Demand& demand : rule.predecessor.front().demands)
      if (locals[demand.offset] != demand.value) return false;
    return !rule.hasCondition || machine.value(rule.condition, locals) != 0;
  };
  const auto take = [&](const CompiledRule& rule) {
    const CompiledSuccessor& successor = rule.successors.front();
    if (!fits(code, successor)) return false;
    if (successor.codes.front() != code || !successor.terms.empty()) changes_.push_back({at, nullptr, &rule});
    return true;
  };
  const auto codeAt = [&](std::uint32_t neighbour) { return neighbour == nowhere ? plans_.codes : codes[neighbour]; };
  switch (plans_.hot[code].kind) {
    case Plan::Kind::Copy: return true;
    case Plan::Kind::Direct: return take(*plan.direct->rule);
    case Plan::Kind::Guarded:
      for (const QuickSuccessor* choice : plan.choices)
        if (holds(*choice->rule)) return take(*choice->rule);
      return true;
    case Plan::Kind::Neighbours:
      for (const CompiledRule* rule : plans_.lists[plan.table[codeAt(left_[at]) * (plans_.codes + 1) + codeAt(right_[at])]].rules)
        if (holds(*rule)) return take(*rule);
      return true;
    case Plan::Kind::Keep:
    case Plan::Kind::Lottery:
    case Plan::Kind::Rules: break;
  }
  return false;
}

bool Calm::collect(const ModuleString& string, Machine& machine) {
  changes_.clear();
  if (known_) {
    return std::all_of(candidates_.begin(), candidates_.end(), [&](std::uint32_t at) { return decide(string, at, offsetOf(at), machine) && !machine.trouble(); });
  }
  readTables(string);
  std::uint32_t offset = 0;
  for (std::uint32_t at = 0; at < string.size(); ++at) {
    if (!decide(string, at, offset, machine) || machine.trouble() || changes_.size() > string.size() / kShare) return false;
    offset += program_.parameterCount[string.codes()[at]];
  }
  return true;
}

/// All new parameters are computed before the first is written: rules see the old string.
void Calm::apply(ModuleString& string, Machine& machine, bool singlePrecision) {
  double* const numbers = string.parameterBuffer().data();
  computed_.clear();
  for (const Change& change : changes_)
    for (const Term& term : change.rule->successors.front().terms) {
      const double value = machine.value(term, numbers + offsetOf(change.module));
      computed_.push_back(singlePrecision ? static_cast<double>(static_cast<float>(value)) : value);
    }
  const auto finite = [](double value) { return std::isfinite(value); };
  if (program_.language == Language::SimEco && !std::all_of(computed_.begin(), computed_.end(), finite))
    machine.giveUp(ErrorCode::NoAnswer, "a parameter that is not a finite number");
  if (machine.trouble()) return;
  changed_.clear();
  std::size_t next = 0;
  for (const Change& change : changes_) {
    const CompiledSuccessor& successor = change.rule->successors.front();
    SymbolCode& code = string.codeBuffer()[change.module];
    bool differs = code != successor.codes.front();
    code = successor.codes.front();
    double* const own = successor.terms.empty() ? numbers : numbers + offsetOf(change.module);
    for (std::size_t i = 0; i < successor.terms.size(); ++i, ++next) {
      double& number = own[i];
      differs = differs || std::memcmp(&number, &computed_[next], sizeof number) != 0;
      number = computed_[next];
    }
    if (differs) changed_.push_back(change.module);
    lastRule_ = change.rule;
  }
}

/// Modules whose left neighbour is `at`: up to the next considered one of its axis, and the first of each branch on the way.
void Calm::addLeftDependents(std::span<const SymbolCode> codes, std::uint32_t at) {
  branches_.clear();
  for (std::uint32_t i = at + 1; i < codes.size(); ++i) {
    switch (role(codes[i])) {
      case Plans::Opens: branches_.push_back(left_[i]); break;
      case Plans::Closes:
        if (branches_.empty()) return;
        branches_.pop_back();
        break;
      case Plans::Ignored: candidates_.push_back(i); break;
      default:
        candidates_.push_back(i);
        if (branches_.empty() || branches_.back() == nowhere) return;
        // The rest of this branch has nearer neighbours: on behind the bracket that closes it.
        i = branches_.back();
        branches_.pop_back();
    }
  }
}

/// Modules whose right neighbour is `at`: back to the considered one before it on its axis.
void Calm::addRightDependents(std::span<const SymbolCode> codes, std::uint32_t at) {
  for (std::uint32_t i = at; i-- > 0;) {
    const std::uint8_t r = role(codes[i]);
    if (r == Plans::Opens) return;
    if (r == Plans::Closes) {
      if (left_[i] == nowhere) return;
      i = left_[i];
      continue;
    }
    candidates_.push_back(i);
    if (r == Plans::Considered) return;
  }
}

void Calm::lookAgain(const ModuleString& string) {
  candidates_.clear();
  for (const std::uint32_t at : changed_) {
    candidates_.push_back(at);
    if (role(string.codes()[at]) == Plans::Ignored) continue;
    if (plans_.leftCodes) addLeftDependents(string.codes(), at);
    if (plans_.rightCodes) addRightDependents(string.codes(), at);
  }
  std::sort(candidates_.begin(), candidates_.end());
  candidates_.erase(std::unique(candidates_.begin(), candidates_.end()), candidates_.end());
}

std::optional<std::size_t> Calm::step(ModuleString& string, Machine& machine, bool singlePrecision) {
  const auto giveUp = [&]() -> std::optional<std::size_t> {
    // The other way meets the same trouble again and says what it is.
    machine.clearTrouble();
    constexpr int most = 6;
    failures_ = known_ ? 0 : std::min(failures_ + 1, most);
    patience_ = 1 << failures_;
    known_ = false;
    return std::nullopt;
  };
  if (!collect(string, machine)) return giveUp();
  apply(string, machine, singlePrecision);
  if (machine.trouble()) return giveUp();
  lookAgain(string);
  known_ = candidates_.size() <= string.size() / kShare;
  failures_ = 0;
  lastFired_ = changed_.size();
  return changed_.size();
}

}  // namespace axil::simeco
