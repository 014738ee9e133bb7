#pragma once
/// \file
/// Pass: the general way over a string, one module after the other. Its layers are engine_pass_ground, engine_pass_visits and engine_pass_lists.
/// Private to engine_general.cpp and engine_image.cpp.

#include "simeco/engine_pass_lists.hpp"

namespace axil::simeco {

/// One pass over the old string. Its members are the state of the pass; `run` is the recipe.
class Pass : public PassLists {
 public:
  using PassLists::PassLists;

  /// Only these modules are rewritten, by interaction rules (by productions, where there are none), or by that one of them.
  void select(const std::vector<bool>& selected, std::optional<std::size_t> rule) {
    selected_ = &selected;
    onlyRule_ = rule;
  }
  /// The string without the selected modules and all that stands on them.
  bool prune(const std::vector<bool>& selected, Arrays& out) {
    out_ = &out;
    enter(nullptr);
    for (std::size_t at = 0; at < old_.codes.size();) {
      if (!lookUp(at)) return false;
      if (selected[at] && !program_.closes[old_.codes[at]])
        cutAt(at);
      else
        copyModule(at);
    }
    return true;
  }

  /// One derivation step into `out`.
  bool derive(Arrays& out) {
    out_ = &out;
    enter(nullptr);
    for (std::size_t at = 0; at < old_.codes.size();) {
      if (!lookUp(at)) return false;
      const SymbolCode code = old_.codes[at];
      if (code == program_.enter) {
        if (!enterVisit(at)) return false;
        continue;
      }
      if (code == program_.leave && !open_.empty()) {
        if (!leaveVisit(at)) return false;
        continue;
      }
      if (selected_ != nullptr && !(*selected_)[at]) {
        copyModule(at);
        continue;
      }
      if (code == program_.cut && selected_ == nullptr && system_->productions.bySymbol[code].all.empty()) {
        cutAt(at);
        continue;
      }
      if (!rewrite(at)) return false;
    }
    if (trace_ != nullptr) trace_->begin.push_back(static_cast<std::uint32_t>(out_->codes.size()));
    return hasRoom(0, 0, nullptr);
  }

  /// Rewrites the beginning of the string for the sake of the counts of what each rule makes.
  void survey(Arrays& out, std::size_t modules) {
    surveying_ = true;
    out_ = &out;
    old_.codes = old_.codes.first(modules);
    enter(nullptr);
    for (std::size_t at = 0; at < modules;)
      if (!rewrite(at)) return;
  }

  /// The homomorphism of the whole string, with the source of each module.
  bool draw(ImagePiece& image) {
    out_ = &image.modules;
    source_ = &image.source;
    if (std::any_of(program_.systems.begin(), program_.systems.end(), [](const System& system) { return !system.homomorphism.empty(); }))
      drawnBy_ = &image.drawnBy;
    enter(nullptr);
    for (std::size_t at = 0; at < old_.codes.size();) {
      if (!lookUp(at)) return false;
      if (old_.codes[at] == program_.enter) enter(&openVisit());
      if (old_.codes[at] == program_.leave && !open_.empty()) closeVisit();
      if (!drawModule(at)) return false;
    }
    return true;
  }

 private:
  // ---- one module of the old string

  /// `%`: everything up to the bracket that closes its branch, or to the end of its L-system or of the string, goes.
  void cutAt(std::size_t& at) {
    std::size_t end = at;
    int brackets = 0, visits = 0;
    for (; end < old_.codes.size(); ++end) {
      const SymbolCode code = old_.codes[end];
      if (program_.closes[code] && brackets == 0) break;
      if (code == program_.leave && visits == 0 && !open_.empty()) break;
      brackets += program_.opens[code] ? 1 : program_.closes[code] ? -1 : 0;
      if (code == program_.enter) {
        ++visits;
        ++nextVisit_;
      }
      if (code == program_.leave) --visits;
    }
    ++fired_;
    traced(end - at, StepTrace::removed, out_->codes.size());
    advance(at, end - at);
  }

  [[nodiscard]] const RuleTable& table() const {
    return selected_ != nullptr && !system_->interaction.empty() ? system_->interaction : system_->productions;
  }
  bool rewrite(std::size_t& at) {
    const RuleIndex& index = table().bySymbol[old_.codes[at]];
    if (index.all.empty()) return keep(at);
    if (identified_) machine_.setRandom(s_.stream(selected_ != nullptr ? Stream::Interaction : Stream::Choice, static_cast<std::uint64_t>(s_.steps), old_.who(at)));
    return system_->stochastic ? rewriteByWeight(index, at) : rewriteByFirst(index, at);
  }

  bool keep(std::size_t& at) {
    if (selected_ != nullptr || system_->decomposition.empty() || system_->decomposition.bySymbol[old_.codes[at]].all.empty()) {
      copyModule(at);
      return true;
    }
    const std::size_t first = out_->codes.size();
    pushModule(at);
    expandedFirst_ = StepTrace::copied;
    if (!emptyLists(system_->decomposition, at, at)) return false;
    traced(1, expandedFirst_, first);
    advance(at, 1);
    return true;
  }

  [[nodiscard]] bool applies(const CompiledRule& rule, std::size_t at, double* locals) {
    return predecessorAt(rule, old_.codes.subspan(at), old_.parameters.data() + parameter_, locals) &&
           matcher_->contexts(rule, at, at + rule.predecessor.size() - 1, locals) && conditionHolds(rule, locals);
  }

  bool rewriteByFirst(const RuleIndex& index, std::size_t& at) {
    for (const std::uint32_t number : candidates(index, old_.parameters.data() + parameter_)) {
      const CompiledRule& rule = table().rules[number];
      if (onlyRule_ && *onlyRule_ != number) continue;
      const bool fires = applies(rule, at, locals_.data());
      if (machine_.trouble()) return inTrouble(rule);
      if (fires) return fire(rule, at, locals_.data());
    }
    return keep(at);
  }

  /// Every applicable rule joins the set, with the locals that its `before` left; one is drawn by weight.
  bool rewriteByWeight(const RuleIndex& index, std::size_t& at) {
    applicable_.clear();
    std::size_t used = 0;
    double sum = 0;
    for (const std::uint32_t number : candidates(index, old_.parameters.data() + parameter_)) {
      const CompiledRule& rule = table().rules[number];
      if (onlyRule_ && *onlyRule_ != number) continue;
      if (frames_.size() < used + frame_) frames_.resize(used + frame_);
      double* locals = frames_.data() + used;
      const bool joins = applies(rule, at, locals);
      const double weight = joins ? machine_.value(rule.successors.front().weight, locals) : 0;
      if (!machine_.trouble() && !(weight >= 0)) machine_.giveUp(ErrorCode::NoAnswer, "a probability that is negative or no number");
      if (machine_.trouble()) return inTrouble(rule);
      if (!joins) continue;
      applicable_.push_back({&rule, used, weight});
      sum += weight;
      used += frame_;
    }
    if (applicable_.empty()) return keep(at);
    double left = sum * machine_.rng().uniform();
    std::size_t chosen = 0;
    while (chosen + 1 < applicable_.size() && left >= applicable_[chosen].weight) left -= applicable_[chosen++].weight;
    return fire(*applicable_[chosen].rule, at, frames_.data() + applicable_[chosen].locals);
  }

  bool fire(const CompiledRule& rule, std::size_t& at, double* locals) {
    ++fired_;
    if (identified_) machine_.setRandom(s_.stream(Stream::Successor, static_cast<std::uint64_t>(s_.steps), old_.who(at)));
    if (!rule.after.empty()) machine_.run(rule.after, locals);
    if (machine_.trouble()) return inTrouble(rule);
    const CompiledSuccessor* successor = choose(rule, locals);
    if (successor == nullptr) return false;
    const std::size_t first = out_->codes.size();
    const std::size_t consumed = rule.predecessor.size();
    if (system_->decomposition.empty()) {
      if (!write(rule, *successor, locals, old_.who(at), *out_)) return false;
      noteVisits(first);
      madeBy(static_cast<std::int32_t>(rule.id));
    } else {
      if (!pushSuccessor(rule, *successor, locals, old_.who(at), 0)) return false;
      if (!emptyLists(system_->decomposition, at, at + consumed - 1)) return false;
    }
    traced(consumed, static_cast<std::int32_t>(rule.id), first);
    advance(at, consumed);
    return true;
  }

  // ---- drawing

  /// At depth 0 a homomorphism rule may take several modules of the string itself.
  bool drawModule(std::size_t& at) {
    const RuleTable& table = system_->homomorphism;
    sourceNow_ = static_cast<std::uint32_t>(at);
    if (table.empty()) return drawAsItIs(at);
    if (table.draws) machine_.setRandom(listStream(table, old_.who(at)));
    const RuleIndex& index = table.bySymbol[old_.codes[at]];
    if (table.maximumDepth > 0 && !index.all.empty()) {
      for (const std::uint32_t number : candidates(index, old_.parameters.data() + parameter_)) {
        const CompiledRule& rule = table.rules[number];
        const bool fires = applies(rule, at, locals_.data());
        if (machine_.trouble()) return inTrouble(rule);
        if (!fires) continue;
        if (!rule.after.empty()) machine_.run(rule.after, locals_.data());
        if (machine_.trouble()) return inTrouble(rule);
        const CompiledSuccessor* successor = choose(rule, locals_.data());
        if (successor == nullptr) return false;
        if (!pushSuccessor(rule, *successor, locals_.data(), old_.who(at), 1)) return false;
        const std::size_t consumed = rule.predecessor.size();
        if (!emptyLists(table, at, at + consumed - 1)) return false;
        advance(at, consumed);
        return true;
      }
    }
    return drawAsItIs(at);
  }
  bool drawAsItIs(std::size_t& at) {
    if (!hasRoom(1, program_.parameterCount[old_.codes[at]], nullptr)) return false;
    put(old_.codes[at], old_.parameters.data() + parameter_, old_.who(at));
    source_->push_back(sourceNow_);
    if (drawnBy_ != nullptr) drawnBy_->push_back(-1);
    advance(at, 1);
    return true;
  }

  struct Applicable {
    const CompiledRule* rule;
    std::size_t locals;
    double weight;
  };

  const std::vector<bool>* selected_ = nullptr;
  std::optional<std::size_t> onlyRule_;
  std::vector<double> frames_;
  std::vector<Applicable> applicable_;
};

}  // namespace axil::simeco
