#pragma once
/// \file
/// The layers of a pass, third: decomposition and homomorphism, lists of modules of which each is looked up again. Private to the general way.

#include "simeco/engine_pass_visits.hpp"

namespace axil::simeco {

class PassLists : public PassVisits {
 public:
  using PassVisits::PassVisits;

 protected:
  /// A list of one: a module of the old string.
  void pushModule(std::size_t at) {
    const SymbolCode code = old_.codes[at];
    const Cursor cursor{lists_.codes.size(), lists_.codes.size() + 1, lists_.parameters.size(), lists_.codes.size(), lists_.parameters.size(), 0};
    lists_.codes.push(code);
    if (identified_) lists_.identities.push(identityOf(old_.who(at)));
    for (std::size_t i = 0; i < program_.parameterCount[code]; ++i) lists_.parameters.push(old_.parameters[parameter_ + i]);
    cursors_.push_back(cursor);
  }
  bool pushSuccessor(const CompiledRule& rule, const CompiledSuccessor& successor, double* locals, std::uint64_t who, int depth) {
    const std::size_t codes = lists_.codes.size(), parameters = lists_.parameters.size();
    if (!write(rule, successor, locals, who, lists_)) return false;
    cursors_.push_back({codes, lists_.codes.size(), parameters, codes, parameters, depth, static_cast<std::int32_t>(rule.id)});
    return true;
  }

  /// Looks up every module of the lists, the innermost list first, until nothing is left; [first, last] are the modules of the
  /// old string whose contexts count.
  bool emptyLists(const RuleTable& table, std::size_t first, std::size_t last) {
    while (!cursors_.empty()) {
      Cursor& cursor = cursors_.back();
      if (cursor.at == cursor.end) {
        lists_.codes.setSize(cursor.listBegin);
        lists_.parameters.setSize(cursor.parameterBegin);
        if (identified_) lists_.identities.setSize(cursor.listBegin);
        cursors_.pop_back();
        continue;
      }
      if (!lookUp(first)) return false;
      if (!lookUpModule(table, first, last)) return false;
    }
    return true;
  }
  bool lookUpModule(const RuleTable& table, std::size_t first, std::size_t last) {
    Cursor& cursor = cursors_.back();
    const SymbolCode code = lists_.codes[cursor.at];
    const RuleIndex& index = table.bySymbol[code];
    if (!index.all.empty()) {
      if (table.draws) machine_.setRandom(listStream(table, whoListed()));
      const std::span<const SymbolCode> codes = lists_.codes.span().subspan(cursor.at, cursor.end - cursor.at);
      for (const std::uint32_t number : candidates(index, lists_.parameters.data() + cursor.parameter)) {
        const CompiledRule& rule = table.rules[number];
        const bool fires = predecessorAt(rule, codes, lists_.parameters.data() + cursor.parameter, locals_.data()) &&
                           matcher_->contexts(rule, first, last, locals_.data()) && holdsAtDepth(rule, table, cursor.depth);
        if (machine_.trouble()) return inTrouble(rule);
        if (fires) return expand(rule);
      }
    }
    return putListed(code);
  }
  /// A rule that only the depth keeps from firing is worth a warning.
  [[nodiscard]] bool holdsAtDepth(const CompiledRule& rule, const RuleTable& table, int depth) {
    if (depth < table.maximumDepth) return conditionHolds(rule, locals_.data());
    depthReached_ = depthReached_ || (table.warn && (!rule.before.empty() || conditionHolds(rule, locals_.data())));
    return false;
  }
  bool expand(const CompiledRule& rule) {
    Cursor& cursor = cursors_.back();
    const int depth = cursor.depth + 1;
    const std::uint64_t who = whoListed();
    for (std::size_t i = 0; i < rule.predecessor.size(); ++i) cursor.parameter += program_.parameterCount[lists_.codes[cursor.at++]];
    if (!rule.after.empty()) machine_.run(rule.after, locals_.data());
    if (machine_.trouble()) return inTrouble(rule);
    ++fired_;
    if (expandedFirst_ == StepTrace::copied) expandedFirst_ = static_cast<std::int32_t>(rule.id);
    const CompiledSuccessor* successor = choose(rule, locals_.data());
    if (successor == nullptr) return false;
    return pushSuccessor(rule, *successor, locals_.data(), who, depth);
  }
  [[nodiscard]] std::uint64_t whoListed() const { return identified_ ? whoIs(lists_.identities[cursors_.back().at]) : 0; }
  /// The draws of a module that is decomposed or drawn: by its own identity, so none shifts those of the modules beside it.
  [[nodiscard]] Rng listStream(const RuleTable& table, std::uint64_t who) const {
    if (source_ != nullptr) return s_.stream(Stream::Homomorphism, table.seed.value_or(0), who);
    return s_.stream(Stream::Decomposition, static_cast<std::uint64_t>(s_.steps), who);
  }
  bool putListed(SymbolCode code) {
    Cursor& cursor = cursors_.back();
    if (!hasRoom(1, program_.parameterCount[code], nullptr)) return false;
    put(code, lists_.parameters.data() + cursor.parameter, whoListed());
    madeBy(cursor.rule);
    if (source_ != nullptr) source_->push_back(sourceNow_);
    if (drawnBy_ != nullptr) drawnBy_->push_back(cursor.rule);
    if (source_ == nullptr && code == program_.enter) newVisits_.emplace_back().system = unknownSystem;
    cursor.parameter += program_.parameterCount[code];
    ++cursor.at;
    return true;
  }

  std::vector<std::uint32_t>* source_ = nullptr;
  std::vector<std::int32_t>* drawnBy_ = nullptr;
  std::uint32_t sourceNow_ = 0;
  std::int32_t expandedFirst_ = StepTrace::copied;  ///< the rule that decomposed a module of the old string first

 private:
  std::vector<Cursor> cursors_;
};

}  // namespace axil::simeco
