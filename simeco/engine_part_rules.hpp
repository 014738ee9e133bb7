#pragma once
/// \file
/// PartPass: rules that must be tried, their chances and what they write. Private to engine_plain.cpp.

#include "simeco/engine_part_pass.hpp"

namespace axil::simeco {

inline const QuickSuccessor* PartPass::firstThatHolds(const Plan& plan, const double* in, bool& fine) {
  for (const QuickSuccessor* choice : plan.choices) {
    const CompiledRule& rule = *choice->rule;
    const bool holds = !rule.hasCondition || machine_.value(rule.condition, const_cast<double*>(in)) != 0;
    if (holds) return choice;
    if (rule.condition.kind == Term::Kind::Coded && machine_.trouble()) {
      fine = inTrouble(rule);
      return nullptr;
    }
  }
  return nullptr;
}

inline std::size_t PartPass::tryAny(const Plan& plan, SymbolCode code, std::size_t at, std::size_t parameters) {
  const auto& rules = program_.main().productions.rules;
  const auto& numbers = candidates(*plan.index, pen_.in);
  if (stochastic_) return tryByWeight(numbers, code, at, parameters);
  return tryRules(numbers, [&](std::uint32_t number) { return &rules[number]; }, code, at, parameters);
}

inline bool PartPass::inTrouble(const CompiledRule& rule) {
  lane_.error = s_.failure(*machine_.trouble(), &rule).error;
  return false;
}

/// The parameters of a successor.
inline bool PartPass::compute(const CompiledRule& rule, const CompiledSuccessor& successor, double* locals) {
  const std::size_t count = successor.terms.size();
  const Term* const terms = successor.terms.data();
  for (std::size_t i = 0; i < count; ++i) pen_.numbers[i] = machine_.value(terms[i], locals);
  if (machine_.trouble()) return inTrouble(rule);
  if (single_)
    for (std::size_t i = 0; i < count; ++i) pen_.numbers[i] = static_cast<double>(static_cast<float>(pen_.numbers[i]));
  if (finite_ && !successor.constant) {
    double sum = 0;  // 0 * x is 0 for every finite x, nan for the others
    for (std::size_t i = 0; i < count; ++i) sum += 0 * pen_.numbers[i];
    if (sum != 0) {
      machine_.giveUp(ErrorCode::NoAnswer, "a parameter that is not a finite number");
      return inTrouble(rule);
    }
  }
  pen_.numbers += count;
  return true;
}

inline bool PartPass::writeSuccessor(const CompiledRule& rule, const CompiledSuccessor& successor, double* locals, std::size_t at) {
  rule_ = &rule;
  if (plans_.decomposes && decomposes(successor)) return list(rule, successor, locals, old_.who(at), 0) && decompose(at);
  const std::size_t length = successor.codes.size();
  const SymbolCode* const codes = successor.codes.data();
  for (std::size_t i = 0; i < length; ++i) pen_.to[i] = codes[i];
  pen_.to += length;
  if (identified_) {
    writeChildren(pen_.who, old_.who(at), successor.keys.data(), length);
    pen_.who += length;
  }
  return successor.terms.empty() || compute(rule, successor, locals);
}

/// A rule with one successor.
inline bool PartPass::write(const CompiledRule& rule, double* locals, std::size_t at) {
  if (rule.random) machine_.setRandom(successors_.split(step_, old_.who(at)));
  return writeSuccessor(rule, rule.successors.front(), locals, at);
}

/// One of a rule's successors, by weight.
inline const CompiledSuccessor* PartPass::choose(const CompiledRule& rule, double* locals) {
  if (rule.successors.size() == 1) return &rule.successors.front();
  weights_.clear();
  double sum = 0;
  for (const CompiledSuccessor& successor : rule.successors) {
    weights_.push_back(weight(successor, locals));
    sum += weights_.back();
  }
  if (machine_.trouble()) inTrouble(rule);
  if (machine_.trouble()) return nullptr;
  return &rule.successors[chosen(weights_, sum * machine_.rng().uniform())];
}

inline bool PartPass::fire(const CompiledRule& rule, double* locals, std::size_t at) {
  if (rule.successors.size() == 1) return write(rule, locals, at);
  machine_.setRandom(successors_.split(step_, old_.who(at)));
  const CompiledSuccessor* successor = choose(rule, locals);
  return successor != nullptr && writeSuccessor(rule, *successor, locals, at);
}

inline double PartPass::weight(const CompiledSuccessor& successor, double* locals) {
  const double w = machine_.value(successor.weight, locals);
  if (!machine_.trouble() && !(w >= 0)) machine_.giveUp(ErrorCode::NoAnswer, "a probability that is negative or no number");
  return w;
}

/// Whether a rule applies to the module at hand; `locals` is where its parameters are then: the string itself, where the rule
/// has no contexts with parameters.
inline bool PartPass::applies(const CompiledRule& rule, std::size_t at, std::size_t parameters, double*& locals, double* frame) {
  for (const Demand& demand : rule.predecessor.front().demands)
    if (pen_.in[demand.offset] != demand.value) return false;
  locals = const_cast<double*>(pen_.in);
  if (rule.bound > parameters) {
    copyNumbers(frame, pen_.in, parameters);
    locals = frame;
  }
  if (matched_ != Matched::ByTable && !matcher_.contexts(rule, at, at, locals)) return false;
  const bool holds = !rule.hasCondition || machine_.value(rule.condition, locals) != 0;
  if (machine_.trouble()) return inTrouble(rule);
  return holds;
}

/// The first of the rules that applies fires; else the module is copied. How many fired: 0 or 1.
template <class Rules, class RuleOf>
std::size_t PartPass::tryRules(const Rules& rules, RuleOf ruleOf, SymbolCode code, std::size_t at, std::size_t parameters) {
  matched_ = std::is_same_v<Rules, std::vector<const CompiledRule*>> ? Matched::ByTable : Matched::NotYet;
  if (s_.drawsConditions) machine_.setRandom(choices_.split(step_, old_.who(at)));
  for (const auto& candidate : rules) {
    const CompiledRule& rule = *ruleOf(candidate);
    double* locals = nullptr;
    if (applies(rule, at, parameters, locals, lane_.locals.data())) {
      fire(rule, locals, at);
      return 1;
    }
    if (lane_.ended()) return 0;
  }
  return keepOrCopyAny(code, at);
}

inline std::size_t PartPass::tryByWeight(const std::vector<std::uint32_t>& numbers, SymbolCode code, std::size_t at, std::size_t parameters) {
  matched_ = Matched::NotYet;
  machine_.setRandom(choices_.split(step_, old_.who(at)));
  if (lane_.frames.size() < numbers.size() * frame_) lane_.frames.resize(numbers.size() * frame_);
  lane_.applicable.clear();
  weights_.clear();
  double sum = 0;
  for (const std::uint32_t number : numbers) {
    const CompiledRule& rule = program_.main().productions.rules[number];
    double* locals = nullptr;
    if (applies(rule, at, parameters, locals, lane_.frames.data() + lane_.applicable.size() * frame_)) {
      weights_.push_back(weight(rule.successors.front(), locals));
      if (machine_.trouble()) return inTrouble(rule);
      sum += weights_.back();
      lane_.applicable.emplace_back(&rule, locals);
    }
    if (lane_.ended()) return 0;
  }
  if (weights_.empty()) return keepOrCopyAny(code, at);
  const auto& [rule, locals] = lane_.applicable[chosen(weights_, sum * machine_.rng().uniform())];
  write(*rule, locals, at);
  return 1;
}

/// No rule applied: none fired.
inline std::size_t PartPass::keepOrCopyAny(SymbolCode code, std::size_t at) {
  identified_ ? keepOrCopy<true>(pen_, plans_.hot[code], code, at) : keepOrCopy<false>(pen_, plans_.hot[code], code, at);
  return 0;
}

}  // namespace axil::simeco
