#pragma once
/// \file
/// The layers of a pass, first: reading the old string, whether a rule fits and what it makes, writing the new string, noting what became of
/// what. Private to the general way.

#include "simeco/engine_state.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace axil::simeco {

class PassGround {
 public:
  PassGround(Engine::State& state, const ModuleString& old, StepTrace* trace)
      : s_(state), program_(*state.program), machine_(state.machine()), trace_(trace), old_{old.codes(), old.parameters(), old.identities()},
        identified_(!old_.identities.empty()) {
    std::size_t frame = 1;
    for (const System& system : program_.systems)
      for (const RuleTable* table : {&system.productions, &system.decomposition, &system.homomorphism})
        for (const CompiledRule& rule : table->rules) frame = std::max<std::size_t>(frame, rule.frame);
    frame_ = frame;
    locals_.resize(frame);
  }

  [[nodiscard]] bool depthReached() const { return depthReached_; }
  [[nodiscard]] std::size_t fired() const { return fired_; }
  [[nodiscard]] Failure failure() const { return fail(*error_); }

 protected:
  // ---- where we are

  /// From time to time: whether to go on at all.
  bool lookUp(std::size_t) {
    constexpr std::size_t betweenLooks = 1 << 14, enoughLooks = 1 << 18;
    ++looks_;
    if (surveying_) return looks_ < enoughLooks;
    if (looks_ % betweenLooks != 0) return true;
    return passOn(s_.mayGoOn());
  }

  void enter(Instance* instance) {
    Instance* now = instance == nullptr ? &s_.main : instance;
    system_ = &program_.systems[now->system];
    machine_.setInstance(now, system_);
    matcher_.emplace(program_, *system_, old_, s_.around, s_.walking);
  }

  /// Notes who wrote the last modules of the new string, up to its end.
  void madeBy(std::int32_t rule) {
    if (trace_ != nullptr) trace_->maker.resize(out_->codes.size(), rule);
  }
  /// Notes what became of `count` modules, whose successor stands from `first` on in the new string.
  void traced(std::size_t count, std::int32_t rule, std::size_t first) {
    if (trace_ == nullptr) return;
    for (std::size_t i = 0; i < count; ++i) {
      trace_->rule.push_back(i == 0 || rule < 0 ? rule : StepTrace::consumed);
      trace_->begin.push_back(static_cast<std::uint32_t>(i == 0 ? first : out_->codes.size()));
    }
  }

  void advance(std::size_t& at, std::size_t modules) {
    for (std::size_t i = 0; i < modules; ++i) parameter_ += program_.parameterCount[old_.codes[at++]];
  }

  void copyModule(std::size_t& at) {
    traced(1, StepTrace::copied, out_->codes.size());
    put(old_.codes[at], old_.parameters.data() + parameter_, old_.who(at));
    madeBy(StepTrace::copied);
    advance(at, 1);
  }

  // ---- what is wrong

  bool inTrouble(const CompiledRule& rule) { return stop(s_.failure(*machine_.trouble(), &rule)); }
  /// Notes why the pass ends early.
  bool stop(Failure failure) {
    if (!error_) error_ = std::move(failure.error);
    return false;
  }
  bool passOn(const Result<void>& done) { return done || stop(done.failure()); }

  // ---- rules

  /// Whether the modules from `at` on are the rule's predecessor; binds their parameters.
  [[nodiscard]] bool predecessorAt(const CompiledRule& rule, std::span<const SymbolCode> codes, const double* parameters, double* locals) const {
    if (rule.predecessor.size() > codes.size()) return false;
    for (std::size_t i = 0; i < rule.predecessor.size(); ++i) {
      const Pattern& pattern = rule.predecessor[i];
      if (codes[i] != pattern.code) return false;
      const std::size_t count = program_.parameterCount[pattern.code];
      if (!Matcher::bind(pattern, parameters, count, locals)) return false;
      parameters += count;
    }
    return true;
  }

  /// `before` and the condition, once predecessor and contexts are bound.
  [[nodiscard]] bool conditionHolds(const CompiledRule& rule, double* locals) {
    for (std::size_t i = rule.bound; i < rule.frame; ++i) locals[i] = 0;
    if (!rule.before.empty()) machine_.run(rule.before, locals);
    if (machine_.trouble()) return false;
    return !rule.hasCondition || machine_.value(rule.condition, locals) != 0;
  }
  /// Which of a rule's successors: by weight, where there is a choice.
  const CompiledSuccessor* choose(const CompiledRule& rule, double* locals) {
    if (rule.successors.size() == 1) return &rule.successors.front();
    double sum = 0;
    weights_.clear();
    for (const CompiledSuccessor& successor : rule.successors) {
      weights_.push_back(machine_.value(successor.weight, locals));
      if (!machine_.trouble() && !(weights_.back() >= 0)) machine_.giveUp(ErrorCode::NoAnswer, "a probability that is negative or no number");
      if (machine_.trouble()) {
        inTrouble(rule);
        return nullptr;
      }
      sum += weights_.back();
    }
    double left = sum * machine_.rng().uniform();
    std::size_t chosen = 0;
    while (chosen + 1 < weights_.size() && left >= weights_[chosen]) left -= weights_[chosen++];
    return &rule.successors[chosen];
  }

  // ---- writing

  [[nodiscard]] double stored(double value) const { return s_.options.singlePrecision ? static_cast<double>(static_cast<float>(value)) : value; }

  /// Appends a successor with its parameters computed; `who` is its parent.
  bool write(const CompiledRule& rule, const CompiledSuccessor& successor, double* locals, std::uint64_t who, Arrays& to) {
    const std::size_t codes = to.codes.size(), parameters = to.parameters.size();
    s_.made[rule.id] += successor.codes.size();
    if (!hasRoom(successor.codes.size(), successor.terms.size(), &rule)) return false;
    if (identified_) {
      to.identities.reserveMore(codes + successor.codes.size());
      writeChildren(to.identities.data() + codes, who, successor.keys.data(), successor.keys.size());
      to.identities.setSize(codes + successor.codes.size());
    }
    to.codes.reserveMore(codes + successor.codes.size());
    to.parameters.reserveMore(parameters + successor.terms.size());
    for (std::size_t i = 0; i < successor.codes.size(); ++i) to.codes[codes + i] = successor.codes[i];
    for (std::size_t i = 0; i < successor.terms.size(); ++i) to.parameters[parameters + i] = stored(machine_.value(successor.terms[i], locals));
    if (machine_.trouble()) return inTrouble(rule);
    if (program_.language == Language::SimEco && !successor.constant)
      for (std::size_t i = 0; i < successor.terms.size(); ++i)
        if (!std::isfinite(to.parameters[parameters + i])) return stop(s_.failure({ErrorCode::NoAnswer, "a parameter that is not a finite number"}, &rule));
    to.codes.setSize(codes + successor.codes.size());
    to.parameters.setSize(parameters + successor.terms.size());
    return true;
  }
  /// Whether so much more fits into the limits.
  bool hasRoom(std::size_t modules, std::size_t parameters, const CompiledRule* rule) {
    const std::size_t all = out_->codes.size() + lists_.codes.size() + modules;
    constexpr std::size_t enoughMade = 1 << 20;
    if (surveying_) return all < enoughMade && parameters < enoughMade;
    if (all > s_.options.limits.modules) return stop(s_.tooMany("modules", s_.options.limits.modules, rule));
    const std::size_t bytes = out_->used() + lists_.used() + modules * (identified_ ? 1 + sizeof(Identity) : 1) + parameters * sizeof(double);
    return bytes <= bytesLeft_ || stop(s_.tooMany("bytes", s_.options.limits.bytes, rule));
  }
  void put(SymbolCode code, const double* parameters, std::uint64_t who) {
    if (identified_) out_->identities.push(identityOf(who));
    const std::size_t count = program_.parameterCount[code], used = out_->parameters.size();
    out_->codes.push(code);
    if (count == 0) return;
    out_->parameters.reserveMore(used + count);
    for (std::size_t i = 0; i < count; ++i) out_->parameters[used + i] = parameters[i];
    out_->parameters.setSize(used + count);
  }

  Engine::State& s_;
  const Program& program_;
  Machine& machine_;
  StepTrace* trace_;
  OldString old_;
  bool identified_;
  bool surveying_ = false;
  std::size_t bytesLeft_ = s_.bytesLeft();
  const System* system_ = nullptr;
  std::optional<Matcher> matcher_;
  Arrays* out_ = nullptr;
  Arrays lists_;               ///< of the decomposition and the homomorphism
  std::size_t parameter_ = 0;  ///< of the module at hand
  std::size_t fired_ = 0;
  std::size_t frame_ = 1;
  std::vector<double> locals_;
  bool depthReached_ = false;

 private:
  std::size_t looks_ = 0;
  std::vector<double> weights_;
  std::optional<Error> error_;
};

}  // namespace axil::simeco
