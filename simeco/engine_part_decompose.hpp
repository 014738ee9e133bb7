#pragma once
/// \file
/// PartPass where modules are decomposed: at once where rules ask for a module's own parameters alone, else with lists of modules.
/// Behind engine_part_pass.hpp, private to engine_plain.cpp.

#include "simeco/engine_part_pass.hpp"

namespace axil::simeco {

template <bool identified>
bool PartPass::unfoldAll(Pen& pen, const QuickSuccessor& successor, std::size_t at) {
  return unfold<identified>(pen, successor, pen.in, identified ? old_.who(at) : 0, 0) && withinModules(pen);
}

inline bool PartPass::withinModules(const Pen& pen) {
  const auto made = static_cast<std::size_t>(pen.to - lane_.out->codes.data());
  return made <= s_.options.limits.modules || met(Lane::Limit::Modules);
}

template <bool identified>
bool PartPass::unfold(Pen& pen, const QuickSuccessor& successor, const double* in, std::uint64_t who, int depth) {
  if (pen.to + successor.length > codesEnd_ || pen.numbers + successor.values > numbersEnd_) [[unlikely]] {
    if (!roomToUnfold<identified>(pen, successor)) return false;
  }
  constexpr std::size_t betweenLooks = 1 << 14;
  if (++listed_ % betweenLooks == 0) [[unlikely]] {
    look();
    if (lane_.ended()) return false;
  }
  rule_ = successor.rule;
  const QuickTerm* term = successor.terms.data();
  const SymbolCode* const codes = successor.length <= successor.codes.size() ? successor.codes.data() : successor.successor->codes.data();
  const std::uint64_t* const keys = successor.keys;
  const std::uint64_t family = identified ? familyOf(who) : 0;
  const auto worked = [in](const QuickTerm& t) {
    const double moved = in[t.slot] * t.factor + t.value;
    return t.constant != 0 ? t.value : moved;
  };
  for (const Piece& piece : successor.pieces) {
    for (std::uint32_t i = 0; i < piece.modules; ++i) pen.to[i] = codes[piece.first + i];
    pen.to += piece.modules;
    if constexpr (identified) {
      for (std::uint32_t i = 0; i < piece.modules; ++i) writeIdentity(pen.who + i, childOf(family, keys[piece.first + i]));
      pen.who += piece.modules;
    }
    for (std::uint32_t i = 0; i < piece.values; ++i) pen.numbers[i] = worked(*term++);
    pen.numbers += piece.values;
    if (!piece.unfolds) continue;
    std::array<double, kMostParameters> own;
    own[0] = 0;  // there always is a number to read
    for (std::uint8_t i = 0; i < piece.parameters; ++i) own[i] = worked(*term++);
    const std::uint64_t child = identified ? childOf(family, keys[piece.first + piece.modules]) : 0;
    if (!unfoldModule<identified>(pen, piece.code, piece.parameters, own.data(), child, depth)) return false;
  }
  return true;
}

template <bool identified>
bool PartPass::unfoldModule(Pen& pen, SymbolCode code, std::size_t parameters, const double* own, std::uint64_t who, int depth) {
  for (const QuickSuccessor* choice : plans_.unfoldings[code].choices) {
    const CompiledRule& rule = *choice->rule;
    const bool holds = !rule.hasCondition || machine_.value(rule.condition, const_cast<double*>(own)) != 0;
    if (rule.condition.kind == Term::Kind::Coded && machine_.trouble()) return inTrouble(rule);
    if (!holds) continue;
    if (depth < maximumDepth_) {
      ++lane_.fired;
      if (depth >= kCalls) return unfoldDeeper<identified>(pen, rule, own, who, depth);
      return unfold<identified>(pen, *choice, own, who, depth + 1);
    }
    lane_.depthReached = lane_.depthReached || program_.main().decomposition.warn;
  }
  *pen.to++ = code;
  if constexpr (identified) writeIdentity(pen.who++, who);
  for (std::size_t i = 0; i < parameters; ++i) pen.numbers[i] = own[i];
  pen.numbers += parameters;
  return true;
}

template <bool identified>
bool PartPass::unfoldDeeper(Pen& pen, const CompiledRule& rule, const double* own, std::uint64_t who, int depth) {
  pen_ = pen;
  const bool fine = list(rule, rule.successors.front(), const_cast<double*>(own), who, depth + 1) && decompose(0);
  pen = pen_;
  endsOfRoom();
  return fine;
}

template <bool identified>
bool PartPass::roomToUnfold(Pen& pen, const QuickSuccessor& successor) {
  pen_ = pen;
  if (!mayGoOnListing()) return false;
  makeRoom(successor.length, successor.values);
  pen = pen_;
  endsOfRoom();
  return true;
}

inline void PartPass::endsOfRoom() {
  Arrays& out = *lane_.out;
  codesEnd_ = out.codes.data() + (out.codes.capacity() - std::min(out.codes.capacity(), promisedCodes()));
  numbersEnd_ = out.parameters.data() + (out.parameters.capacity() - std::min(out.parameters.capacity(), promisedNumbers()));
}

inline bool PartPass::decomposes(const CompiledSuccessor& successor) const {
  return std::any_of(successor.codes.begin(), successor.codes.end(), [&](SymbolCode code) { return plans_.hot[code].decomposes; });
}

inline bool PartPass::keep(SymbolCode code, std::size_t parameters, std::size_t at) {
  Arrays& lists = lane_.lists;
  lane_.cursors.push_back({0, 1, 0, 0, 0, 0});
  if (identified_) lists.identities.push(old_.identities[at]);
  lists.codes.reserveMore(1);
  lists.codes[0] = code;
  lists.codes.setSize(1);
  lists.parameters.reserveMore(parameters + 1);  // so that there always is a place to read from
  copyNumbers(lists.parameters.data(), pen_.in, parameters);
  lists.parameters.setSize(parameters);
  return decompose(at);
}

inline bool PartPass::list(const CompiledRule& rule, const CompiledSuccessor& successor, double* locals, std::uint64_t who, int depth) {
  Arrays& lists = lane_.lists;
  const std::size_t codes = lists.codes.size(), numbers = lists.parameters.size();
  rule_ = &rule;
  if (codes + successor.codes.size() > s_.options.limits.modules) return met(Lane::Limit::Modules);
  if (lists.used() > s_.bytesLeft()) return met(Lane::Limit::Bytes);
  if (identified_) {
    lists.identities.reserveMore(codes + successor.codes.size());
    writeChildren(lists.identities.data() + codes, who, successor.keys.data(), successor.keys.size());
    lists.identities.setSize(codes + successor.codes.size());
  }
  lists.codes.reserveMore(codes + successor.codes.size());
  lists.parameters.reserveMore(numbers + successor.terms.size() + 1);
  for (std::size_t i = 0; i < successor.codes.size(); ++i) lists.codes[codes + i] = successor.codes[i];
  lists.codes.setSize(codes + successor.codes.size());
  const Pen before = pen_;
  pen_.numbers = lists.parameters.data() + numbers;
  const bool fine = compute(rule, successor, locals);
  pen_ = before;
  lists.parameters.setSize(numbers + successor.terms.size());
  lane_.cursors.push_back({codes, lists.codes.size(), numbers, codes, numbers, depth});
  return fine;
}

inline bool PartPass::met(Lane::Limit limit) {
  lane_.limit = limit;
  return false;
}

inline void PartPass::makeRoom(std::size_t modules, std::size_t numbers) {
  Arrays& out = *lane_.out;
  const auto codesNow = static_cast<std::size_t>(pen_.to - out.codes.data()), numbersNow = static_cast<std::size_t>(pen_.numbers - out.parameters.data());
  const std::size_t codesThen = codesNow + modules + promisedCodes(), numbersThen = numbersNow + numbers + promisedNumbers();
  if (codesThen <= out.codes.capacity() && numbersThen <= out.parameters.capacity()) return;
  out.codes.setSize(codesNow);  // what is written is kept
  out.parameters.setSize(numbersNow);
  out.codes.reserveMore(codesThen);
  out.parameters.reserveMore(numbersThen);
  pen_.to = out.codes.data() + codesNow;
  pen_.numbers = out.parameters.data() + numbersNow;
  if (!identified_) return;
  out.identities.setSize(codesNow);
  out.identities.reserveMore(out.codes.capacity());
  pen_.who = out.identities.data() + codesNow;
}

inline void PartPass::copyListed(Cursor& cursor) {
  const Arrays& lists = lane_.lists;
  makeRoom(cursor.end - cursor.at, lists.parameters.size() - cursor.parameter);
  const SymbolCode* const codes = lists.codes.data();
  const double* from = lists.parameters.data() + cursor.parameter;
  const Hot* const hots = plans_.hot.data();
  SymbolCode* to = pen_.to;
  double* numbers = pen_.numbers;
  std::size_t at = cursor.at;
  for (; at < cursor.end && !hots[codes[at]].decomposes; ++at) {
    const std::size_t count = hots[codes[at]].parameters;
    *to++ = codes[at];
    std::memcpy(numbers, from, 2 * sizeof(double));
    for (std::size_t i = 2; i < count; ++i) numbers[i] = from[i];
    numbers += count;
    from += count;
  }
  if (identified_) {
    std::copy(lists.identities.data() + cursor.at, lists.identities.data() + at, pen_.who);
    pen_.who += at - cursor.at;
  }
  cursor.at = at;
  cursor.parameter = static_cast<std::size_t>(from - lists.parameters.data());
  pen_.to = to;
  pen_.numbers = numbers;
}

inline void PartPass::keepListed(Cursor& cursor) {
  const SymbolCode code = lane_.lists.codes[cursor.at];
  const std::size_t count = plans_.hot[code].parameters;
  makeRoom(1, count);
  *pen_.to++ = code;
  if (identified_) *pen_.who++ = lane_.lists.identities[cursor.at];
  copyNumbers(pen_.numbers, lane_.lists.parameters.data() + cursor.parameter, count);
  pen_.numbers += count;
  cursor.parameter += count;
  ++cursor.at;
}

inline bool PartPass::mayGoOnListing() {
  constexpr std::size_t betweenLooks = 1 << 14;
  if (++listed_ % betweenLooks == 0) look();
  if (lane_.ended()) return false;
  const auto made = static_cast<std::size_t>(pen_.to - lane_.out->codes.data());
  const auto numbers = static_cast<std::size_t>(pen_.numbers - lane_.out->parameters.data());
  if (made + numbers * sizeof(double) > s_.bytesLeft()) return met(Lane::Limit::Bytes);
  return made <= s_.options.limits.modules || met(Lane::Limit::Modules);
}

inline bool PartPass::decompose(std::size_t at) {
  const RuleTable& table = program_.main().decomposition;
  while (!lane_.cursors.empty()) {
    Cursor& cursor = lane_.cursors.back();
    copyListed(cursor);
    if (!mayGoOnListing()) return false;
    if (cursor.at == cursor.end) {
      lane_.lists.codes.setSize(cursor.listBegin);
      lane_.lists.parameters.setSize(cursor.parameterBegin);
      if (identified_) lane_.lists.identities.setSize(cursor.listBegin);
      lane_.cursors.pop_back();
      continue;
    }
    const std::size_t count = plans_.hot[lane_.lists.codes[cursor.at]].parameters;
    const CompiledRule* rule = decomposing(table, cursor, count, at);
    if (lane_.ended()) return false;
    if (rule == nullptr)
      keepListed(cursor);
    else if (!expand(*rule, count))
      return false;
  }
  return true;
}

inline const CompiledRule* PartPass::decomposing(const RuleTable& table, const Cursor& cursor, std::size_t count, std::size_t at) {
  const double* const parameters = lane_.lists.parameters.data() + cursor.parameter;
  if (table.draws) machine_.setRandom(decompositions_.split(step_, whoIs(lane_.lists.identities[cursor.at])));
  for (const std::uint32_t number : candidates(table.bySymbol[lane_.lists.codes[cursor.at]], parameters)) {
    const CompiledRule& rule = table.rules[number];
    double* const locals = lane_.locals.data();
    if (!Matcher::bind(rule.predecessor.front(), parameters, count, locals) || !matcher_.contexts(rule, at, at, locals)) continue;
    const bool holds = !rule.hasCondition || machine_.value(rule.condition, locals) != 0;
    if (machine_.trouble()) inTrouble(rule);
    if (machine_.trouble()) return nullptr;
    if (!holds) continue;
    if (cursor.depth < table.maximumDepth) return &rule;
    lane_.depthReached = lane_.depthReached || table.warn;
  }
  return nullptr;
}

inline bool PartPass::expand(const CompiledRule& rule, std::size_t count) {
  Cursor& cursor = lane_.cursors.back();
  const int depth = cursor.depth + 1;
  const std::uint64_t who = identified_ ? whoIs(lane_.lists.identities[cursor.at]) : 0;
  cursor.parameter += count;
  ++cursor.at;
  ++lane_.fired;
  const CompiledSuccessor* successor = choose(rule, lane_.locals.data());
  return successor != nullptr && list(rule, *successor, lane_.locals.data(), who, depth);
}

}  // namespace axil::simeco
