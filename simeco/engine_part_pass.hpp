#pragma once
/// \file
/// PartPass: one thread's part of a step of the plain way. Its inner loops, `rewriteBytes` and `rewrite`, do what nearly all modules
/// need; what is rarer (rules that must be tried, decomposition) follows below. Private to engine_plain.cpp.

#include "simeco/engine_fringe.hpp"
#include "simeco/engine_state.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace axil::simeco {

/// Up to 32 bytes are copied without asking how many; both sides have room behind their end.
inline void copyCodes(SymbolCode* to, const QuickSuccessor& from) {
  if (from.length <= 16) {
    std::memcpy(to, from.codes.data(), 16);
  } else if (from.length <= 32) {
    std::memcpy(to, from.codes.data(), 32);
  } else {
    std::memcpy(to, from.successor->codes.data(), from.length);
  }
}

inline void copyNumbers(double* to, const double* from, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) to[i] = from[i];
}

/// Where the next module is read and written. It lives in registers: codes are bytes, and a byte that is written could be a
/// piece of anything else that is in memory.
struct Pen {
  const double* in = nullptr;   ///< parameters of the module at hand
  SymbolCode* to = nullptr;
  double* numbers = nullptr;
  Identity* who = nullptr;      ///< only where something draws
};

/// Rewrites one part of the string.
class PartPass {
 public:
  PartPass(Engine::State& state, Machine& machine, Lane& lane)
      : s_(state), plans_(*state.plans), program_(*state.program), machine_(machine), lane_(lane), old_(state.oldString()),
        matcher_(program_, program_.main(), old_, state.around, false), choices_(state.stream(Stream::Choice)), successors_(state.stream(Stream::Successor)),
        decompositions_(state.stream(Stream::Decomposition)),
        step_(static_cast<std::uint64_t>(state.steps)), stochastic_(program_.main().stochastic), identified_(state.identified), finite_(program_.language == Language::SimEco),
        single_(state.options.singlePrecision) {
    std::size_t frame = 1;
    for (const RuleTable* table : {&program_.main().productions, &program_.main().decomposition})
      for (const CompiledRule& rule : table->rules) frame = std::max<std::size_t>(frame, rule.frame);
    frame_ = frame;
    const bool fits = std::all_of(plans_.hot.begin(), plans_.hot.end(), [](const Hot& hot) { return hot.parameters <= kMostParameters; });
    unfolding_ = plans_.unfoldsQuickly && fits && !single_ && !finite_;
    maximumDepth_ = program_.main().decomposition.maximumDepth;
    calls_ = unfolding_ ? static_cast<std::size_t>(std::clamp(maximumDepth_, 0, kCalls)) + 1 : 0;
    lane_.locals.resize(frame);
  }

  void run(std::size_t begin, std::size_t end, std::size_t parameter) {
    machine_.setInstance(&s_.main, &program_.main());
    lane_.fired = 0;
    lane_.depthReached = false;
    lane_.cursors.clear();
    lane_.lists.clear();
    lane_.out->clear();
    AXIL_ASSERT(old_.parameters.data() != nullptr, "two numbers can always be read, even where there are none");
    in_ = old_.parameters.data() + parameter;
    rule_ = nullptr;
    if (plans_.rightCodes) readRightCodes(begin, end);
    if (plans_.bytes)
      identified_ ? byteNeighbours<true>(begin, end) : byteNeighbours<false>(begin, end);
    else if (identified_)
      withParameters<true, true>(begin, end);
    else
      plans_.parameters ? withParameters<true, false>(begin, end) : withParameters<false, false>(begin, end);
    lane_.lastRule = rule_;
  }

 private:
  template <bool identified>
  void byteNeighbours(std::size_t begin, std::size_t end) {
    if (plans_.leftCodes)
      plans_.rightCodes ? byteBlocks<identified, true, true>(begin, end) : byteBlocks<identified, true, false>(begin, end);
    else
      plans_.rightCodes ? byteBlocks<identified, false, true>(begin, end) : byteBlocks<identified, false, false>(begin, end);
  }
  template <bool identified, bool withLeft, bool withRight>
  void byteBlocks(std::size_t begin, std::size_t end) {
    eachBlock(begin, end, [this](std::size_t at, std::size_t to, SymbolCode last, LeftFringe& fringe) {
      return rewriteBytes<identified, withLeft, withRight>(at, to, last, fringe);
    });
  }

  template <bool parameters, bool identified>
  void withParameters(std::size_t begin, std::size_t end) {
    if (plans_.leftCodes)
      plans_.rightCodes ? blocks<parameters, identified, true, true>(begin, end) : blocks<parameters, identified, true, false>(begin, end);
    else
      plans_.rightCodes ? blocks<parameters, identified, false, true>(begin, end) : blocks<parameters, identified, false, false>(begin, end);
  }

  void readRightCodes(std::size_t begin, std::size_t end) {
    RightFringe fringe(plans_, old_.codes, end);
    SymbolCode* const right = s_.rightCodes.data();
    const SymbolCode* const codes = old_.codes.data();
    const Hot* const hots = plans_.hot.data();
    const SymbolCode nobody = fringe.nobody();
    Buffer<SymbolCode>& stack = lane_.stack;
    stack.clear();
    SymbolCode next = fringe.nearest();
    for (std::size_t i = end; i-- > begin;) {
      right[i] = next;
      const SymbolCode code = codes[i];
      const std::uint8_t role = hots[code].role;
      if (role < Plans::Opens) {
        next = role == Plans::Considered ? code : next;
      } else if (role == Plans::Closes) {
        stack.push(next);
        next = nobody;
      } else if (stack.size() > 0) {
        next = stack[stack.size() - 1];
        stack.setSize(stack.size() - 1);
      } else {
        fringe.leave();
        next = fringe.nearest();
      }
    }
  }

  template <bool withParameters, bool identified, bool withLeft, bool withRight>
  void blocks(std::size_t begin, std::size_t end) {
    eachBlock(begin, end, [this](std::size_t at, std::size_t to, SymbolCode last, LeftFringe& fringe) {
      return rewrite<withParameters, identified, withLeft, withRight>(at, to, last, fringe);
    });
  }

  /// Block by block: room for the longest that a block can become is made before it, so that nothing inside has to ask.
  template <class Rewrite>
  void eachBlock(std::size_t begin, std::size_t end, Rewrite rewriteBlock) {
    constexpr std::size_t blockModules = 1 << 14;
    // Short strings in short blocks: the room for the longest a block can become shall stay small beside the string.
    const std::size_t most = std::clamp<std::size_t>((end - begin) / 16, 16, 2048);
    const std::size_t block = std::clamp<std::size_t>(blockModules / std::max(plans_.longest, plans_.most), 1, most);
    room_ = block;
    const std::size_t bytesLeft = s_.bytesLeft();
    LeftFringe fringe(plans_, old_.codes, begin);
    lane_.stack.clear();
    SymbolCode last = plans_.leftCodes ? fringe.nearest() : SymbolCode{0};
    std::size_t looks = 0;
    std::size_t before = 0;
    for (std::size_t at = begin; at < end && !lane_.ended(); at += block) {
      const std::size_t to = std::min(end, at + block);
      Arrays& out = *lane_.out;
      const std::size_t modules = to - at;
      out.codes.reserveMore(out.codes.size() + modules * plans_.longest);
      out.parameters.reserveMore(out.parameters.size() + (plans_.parameters ? modules * plans_.most : 0));
      if (identified_) out.identities.reserve(out.codes.capacity());
      endsOfRoom();
      last = rewriteBlock(at, to, last, fringe);
      if (lane_.ended()) return;
      if (out.codes.size() > s_.options.limits.modules) lane_.limit = Lane::Limit::Modules;
      const std::size_t now = out.used();
      if (s_.written.fetch_add(now - before, std::memory_order_relaxed) + (now - before) > bytesLeft) lane_.limit = Lane::Limit::Bytes;
      before = now;
      constexpr std::size_t betweenLooks = 64;
      if (++looks % betweenLooks == 0) look();
    }
  }
  /// Whether to go on at all.
  void look() {
    if (s_.options.watch.cancelled() || s_.shared.late()) lane_.limit = Lane::Limit::Time;
  }

  /// The draws of up to so many modules, made ahead of them: they do not wait for each other then.
  struct Draws {
    static constexpr std::size_t most = 1024;
    std::array<std::uint16_t, most> places;       ///< of the modules that draw, counted from the first
    std::array<std::uint32_t, most + 1> tickets;
    std::array<std::uint64_t, most + 1> families;
    std::size_t next = 0;
  };
  void drawAhead(Draws& draws, std::size_t begin, std::size_t end) const {
    const SymbolCode* const codes = old_.codes.data();
    const ByteSymbol* const symbols = plans_.byteSymbols.data();
    std::size_t count = 0;
    for (std::size_t at = begin; at < end; ++at) {
      draws.places[count] = static_cast<std::uint16_t>(at - begin);
      count += symbols[codes[at]].drawn ? 1 : 0;
    }
    const Rng choices = choices_;
    const std::uint64_t step = step_;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t at = begin + draws.places[i];
      const std::uint64_t who = whoIs(old_.identities[at]);
      draws.families[i] = familyOf(who);
      draws.tickets[i] = ticket(plans_.bySymbol[codes[at]], choices.split(step, who).bits() >> 11);
    }
    draws.next = 0;
  }

  /// Without parameters every module is replaced by an entry of a table, copied whole; the only branches are brackets.
  template <bool identified, bool withLeft, bool withRight>
  SymbolCode rewriteBytes(std::size_t begin, std::size_t end, SymbolCode last, LeftFringe& fringe) {
    if constexpr (!identified) {
      return rewriteEntries<false, withLeft, withRight>(begin, end, last, fringe, nullptr);
    } else {
      Draws draws;
      for (std::size_t at = begin; at < end; at += Draws::most) {
        const std::size_t to = std::min(end, at + Draws::most);
        drawAhead(draws, at, to);
        last = rewriteEntries<true, withLeft, withRight>(at, to, last, fringe, &draws);
      }
      return last;
    }
  }
  template <bool identified, bool withLeft, bool withRight>
  SymbolCode rewriteEntries(std::size_t begin, std::size_t end, SymbolCode last, LeftFringe& fringe, const Draws* draws) {
    const SymbolCode* const codes = old_.codes.data();
    const SymbolCode* const rights = s_.rightCodes.data();
    const ByteSymbol* const symbols = plans_.byteSymbols.data();
    const ByteEntry* const entries = plans_.entries.data();
    const std::array<std::uint64_t, 16>* const keys = plans_.entryKeys.data();
    const Identity* const who = old_.identities.data();
    Identity* born = identified ? lane_.out->identities.data() + lane_.out->codes.size() : nullptr;
    SymbolCode* to = lane_.out->codes.data() + lane_.out->codes.size();
    std::size_t fired = 0, drawn = 0;
    const ByteEntry* fires = nullptr;
    for (std::size_t at = begin; at < end; ++at) {
      const SymbolCode code = codes[at];
      const ByteSymbol symbol = symbols[code];
      std::size_t entry = symbol.first;
      if constexpr (withLeft) entry += std::size_t{last} * symbol.leftStep;
      if constexpr (!withLeft && withRight) entry += plans_.codes * symbol.leftStep;
      if constexpr (withRight) entry += std::size_t{rights[at]} * symbol.rightStep;
      if constexpr (withLeft && !withRight) entry += plans_.codes * symbol.rightStep;
      if constexpr (identified) entry += symbol.drawn ? draws->tickets[drawn] : 0u;
      const ByteEntry& made = entries[entry];
      if constexpr (identified) {
        const std::uint64_t self = whoIs(who[at]);
        std::uint64_t family = symbol.drawn ? draws->families[drawn] : self;
        if (made.fires != 0 && !symbol.drawn) family = familyOf(self);
        drawn += symbol.drawn ? 1 : 0;
        writeFew(born, family, keys[entry], made);
        born += made.length;
      }
      std::memcpy(to, made.codes.data(), made.codes.size());
      if (made.longer != nullptr) [[unlikely]] {
        std::memcpy(to, made.longer->successor->codes.data(), made.length);
        fires = &made;
      }
      to += made.length;
      fired += made.fires;
      if constexpr (withLeft) {
        if (symbol.role >= Plans::Opens)
          last = leftAfter(symbol.role, code, last, fringe);
        else
          last = symbol.role == Plans::Considered ? code : last;
      }
    }
    if (fires != nullptr) rule_ = fires->longer->rule;
    lane_.fired += fired;
    lane_.out->codes.setSize(static_cast<std::size_t>(to - lane_.out->codes.data()));
    if constexpr (identified) lane_.out->identities.setSize(lane_.out->codes.size());
    return last;
  }
  /// The identities of an entry's modules, four at a time: a Buffer has room behind its end.
  static void writeFew(Identity* born, std::uint64_t family, const std::array<std::uint64_t, 16>& keys, const ByteEntry& made) {
    if (made.longer != nullptr) [[unlikely]] {
      for (std::uint32_t i = 0; i < made.length; ++i) writeIdentity(born + i, childOf(family, made.longer->keys[i]));
      return;
    }
    writeIdentity(born, childOf(family, keys[0]));
    for (std::uint32_t i = 1; i < made.length; i += 5)
      for (std::uint32_t k = i; k < i + 5; ++k) writeIdentity(born + k, childOf(family, keys[k]));
  }
  /// As `chosen`, without a branch that chance would take.
  static std::uint32_t ticket(const Plan& plan, std::uint64_t draw) {
    std::uint32_t choice = 0;
    for (const std::uint64_t threshold : plan.thresholds) choice += draw >= threshold ? 1 : 0;
    return choice;
  }

  template <bool withParameters, bool identified, bool withLeft, bool withRight>
  SymbolCode rewrite(std::size_t begin, std::size_t end, SymbolCode last, LeftFringe& fringe) {
    const SymbolCode* const codes = old_.codes.data();
    const SymbolCode* const rights = s_.rightCodes.data();
    const Hot* const hots = plans_.hot.data();
    const Plan* const plans = plans_.bySymbol.data();
    const CandidateList* const lists = plans_.lists.data();
    const std::size_t width = plans_.codes + 1;
    Pen pen{in_, lane_.out->codes.data() + lane_.out->codes.size(), lane_.out->parameters.data() + lane_.out->parameters.size(),
            identified ? lane_.out->identities.data() + lane_.out->codes.size() : nullptr};
    std::size_t fired = 0;
    const QuickSuccessor* chosen = nullptr;
    bool fine = true;
    for (std::size_t at = begin; at < end && fine; ++at) {
      const SymbolCode code = codes[at];
      const Hot hot = hots[code];
      switch (hot.kind) {
        case Plan::Kind::Copy:
          if constexpr (withParameters)
            copy<identified>(pen, code, hot.parameters, at);
          else
            *pen.to++ = code;
          break;
        case Plan::Kind::Keep:
          fine = keepWhole<identified>(pen, hot, code, at);
          break;
        case Plan::Kind::Direct:
          fine = put<identified>(pen, *plans[code].direct, at);
          chosen = plans[code].direct;
          ++fired;
          break;
        case Plan::Kind::Guarded: {
          const QuickSuccessor* const holding = firstThatHolds(plans[code], pen.in, fine);
          if (holding == nullptr) {
            fine = fine && keepOrCopy<identified>(pen, hot, code, at);
          } else {
            fine = put<identified>(pen, *holding, at);
            chosen = holding;
            ++fired;
          }
          break;
        }
        case Plan::Kind::Lottery:
          fine = put<identified>(pen, *plans[code].choices[drawn(plans[code], at)], at);
          ++fired;
          break;
        case Plan::Kind::Neighbours: {
          const std::size_t left = withLeft ? last : plans_.codes, right = withRight ? rights[at] : plans_.codes;
          const CandidateList& list = lists[plans[code].table[left * width + right]];
          if (list.outright != nullptr) {
            fine = put<identified>(pen, *list.outright, at);
            ++fired;
          } else if (list.rules.empty()) {
            fine = keepOrCopy<identified>(pen, hot, code, at);
          } else {
            pen_ = pen;
            fired += tryRules(list.rules, [](const CompiledRule* rule) { return rule; }, code, at, hot.parameters);
            pen = pen_;
            fine = !lane_.ended();
          }
          break;
        }
        case Plan::Kind::Rules: {
          pen_ = pen;
          fired += tryAny(plans[code], code, at, hot.parameters);
          pen = pen_;
          fine = !lane_.ended();
          break;
        }
      }
      if constexpr (withParameters) pen.in += hot.parameters;
      if constexpr (withLeft) last = leftAfter(hot.role, code, last, fringe);
    }
    in_ = pen.in;
    if (chosen != nullptr) rule_ = chosen->rule;
    lane_.fired += fired;
    lane_.out->codes.setSize(static_cast<std::size_t>(pen.to - lane_.out->codes.data()));
    lane_.out->parameters.setSize(static_cast<std::size_t>(pen.numbers - lane_.out->parameters.data()));
    if constexpr (identified) lane_.out->identities.setSize(lane_.out->codes.size());
    return last;
  }

  template <bool identified>
  void copy(Pen& pen, SymbolCode code, std::size_t parameters, std::size_t at) const {
    *pen.to++ = code;
    if constexpr (identified) *pen.who++ = old_.identities[at];
    // Nearly all modules have at most two parameters; there is always room for two.
    std::memcpy(pen.numbers, pen.in, 2 * sizeof(double));
    for (std::size_t i = 2; i < parameters; ++i) pen.numbers[i] = pen.in[i];
    pen.numbers += parameters;
  }

  /// Writes a successor whose parameters depend on the module's own at most.
  template <bool identified>
  bool put(Pen& pen, const QuickSuccessor& successor, std::size_t at) {
    if (!successor.quick || single_ || finite_) return unfolding_ && successor.unfolds ? unfoldAll<identified>(pen, successor, at) : putSlowly(pen, successor, at);
    copyCodes(pen.to, successor);
    pen.to += successor.length;
    if constexpr (identified) {
      writeChildren(pen.who, old_.who(at), successor.keys, successor.length);
      pen.who += successor.length;
    }
    const QuickTerm* const terms = successor.terms.data();
    for (std::uint32_t i = 0; i < successor.values; ++i) {
      const QuickTerm& term = terms[i];
      const double moved = pen.in[term.slot] * term.factor + term.value;
      pen.numbers[i] = term.constant != 0 ? term.value : moved;
    }
    pen.numbers += successor.values;
    return true;
  }
  bool putSlowly(Pen& pen, const QuickSuccessor& successor, std::size_t at) {
    if (successor.random) machine_.setRandom(successors_.split(step_, old_.who(at)));
    pen_ = pen;
    const bool fine = writeSuccessor(*successor.rule, *successor.successor, const_cast<double*>(pen.in), at);
    pen = pen_;
    return fine;
  }
  /// A module that no production rewrites: copied, or decomposed.
  template <bool identified>
  bool keepOrCopy(Pen& pen, Hot hot, SymbolCode code, std::size_t at) {
    if (!hot.decomposes) {
      copy<identified>(pen, code, hot.parameters, at);
      return true;
    }
    return keepWhole<identified>(pen, hot, code, at);
  }
  /// A module that no production rewrites and that decomposition rules know.
  template <bool identified>
  bool keepWhole(Pen& pen, Hot hot, SymbolCode code, std::size_t at) {
    if (unfolding_) {
      const double* const in = pen.in;
      return unfoldModule<identified>(pen, code, hot.parameters, in, identified ? old_.who(at) : 0, 0) && withinModules(pen);
    }
    pen_ = pen;
    const bool fine = keep(code, hot.parameters, at);
    pen = pen_;
    return fine;
  }

  const QuickSuccessor* firstThatHolds(const Plan& plan, const double* in, bool& fine) {
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
  std::size_t tryAny(const Plan& plan, SymbolCode code, std::size_t at, std::size_t parameters) {
    const auto& rules = program_.main().productions.rules;
    const auto& numbers = candidates(*plan.index, pen_.in);
    if (stochastic_) return tryByWeight(numbers, code, at, parameters);
    return tryRules(numbers, [&](std::uint32_t number) { return &rules[number]; }, code, at, parameters);
  }

  /// The left neighbour of what follows a module.
  SymbolCode leftAfter(std::uint8_t role, SymbolCode code, SymbolCode last, LeftFringe& fringe) {
    switch (role) {
      case Plans::Considered: return code;
      case Plans::Ignored: return last;
      case Plans::Opens: lane_.stack.push(last); return last;
      default: break;
    }
    if (lane_.stack.size() == 0) {
      fringe.leave();
      return fringe.nearest();
    }
    const SymbolCode before = lane_.stack[lane_.stack.size() - 1];
    lane_.stack.setSize(lane_.stack.size() - 1);
    return before;
  }

  bool inTrouble(const CompiledRule& rule) {
    lane_.error = s_.failure(*machine_.trouble(), &rule).error;
    return false;
  }

  /// The parameters of a successor.
  bool compute(const CompiledRule& rule, const CompiledSuccessor& successor, double* locals) {
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
  bool writeSuccessor(const CompiledRule& rule, const CompiledSuccessor& successor, double* locals, std::size_t at) {
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
  bool write(const CompiledRule& rule, double* locals, std::size_t at) {
    if (rule.random) machine_.setRandom(successors_.split(step_, old_.who(at)));
    return writeSuccessor(rule, rule.successors.front(), locals, at);
  }

  // ---- quick decomposition: rules that ask for a module's own parameters; each module is written where it belongs at once ------

  /// So deep rules are followed by calls; what is deeper goes on with lists.
  static constexpr int kCalls = 48;
  static constexpr std::size_t kMostParameters = 32;

  template <bool identified>
  bool unfoldAll(Pen& pen, const QuickSuccessor& successor, std::size_t at) {
    return unfold<identified>(pen, successor, pen.in, identified ? old_.who(at) : 0, 0) && withinModules(pen);
  }
  bool withinModules(const Pen& pen) {
    const auto made = static_cast<std::size_t>(pen.to - lane_.out->codes.data());
    return made <= s_.options.limits.modules || met(Lane::Limit::Modules);
  }
  template <bool identified>
  bool unfold(Pen& pen, const QuickSuccessor& successor, const double* in, std::uint64_t who, int depth) {
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
  /// A module that `depth` nested applications made: what its decomposition rules make of it, or itself.
  template <bool identified>
  bool unfoldModule(Pen& pen, SymbolCode code, std::size_t parameters, const double* own, std::uint64_t who, int depth) {
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
  /// With lists, which may be as deep as memory allows.
  template <bool identified>
  bool unfoldDeeper(Pen& pen, const CompiledRule& rule, const double* own, std::uint64_t who, int depth) {
    pen_ = pen;
    const bool fine = list(rule, rule.successors.front(), const_cast<double*>(own), who, depth + 1) && decompose(0);
    pen = pen_;
    endsOfRoom();
    return fine;
  }
  /// Room for a successor and the rest of the block; fails where a limit is met.
  template <bool identified>
  bool roomToUnfold(Pen& pen, const QuickSuccessor& successor) {
    pen_ = pen;
    if (!mayGoOnListing()) return false;
    makeRoom(successor.length, successor.values);
    pen = pen_;
    endsOfRoom();
    return true;
  }
  /// Room that must be left for the rest of the block, and for what the successors that are being unfolded still have to write.
  [[nodiscard]] std::size_t promisedCodes() const { return room_ * plans_.longest + calls_ * plans_.longestUnfolding; }
  [[nodiscard]] std::size_t promisedNumbers() const { return room_ * plans_.most + calls_ * plans_.mostUnfolding; }
  /// Up to where decomposed modules may be written.
  void endsOfRoom() {
    Arrays& out = *lane_.out;
    codesEnd_ = out.codes.data() + (out.codes.capacity() - std::min(out.codes.capacity(), promisedCodes()));
    numbersEnd_ = out.parameters.data() + (out.parameters.capacity() - std::min(out.parameters.capacity(), promisedNumbers()));
  }

  // ---- decomposition: lists of modules, the innermost first, each module looked up ----------------------------------

  bool decomposes(const CompiledSuccessor& successor) const {
    return std::any_of(successor.codes.begin(), successor.codes.end(), [&](SymbolCode code) { return plans_.hot[code].decomposes; });
  }
  /// A module without production: a list of one.
  bool keep(SymbolCode code, std::size_t parameters, std::size_t at) {
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
  /// Puts a successor on top of the lists.
  bool list(const CompiledRule& rule, const CompiledSuccessor& successor, double* locals, std::uint64_t who, int depth) {
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
  bool met(Lane::Limit limit) {
    lane_.limit = limit;
    return false;
  }
  /// Room for `modules` with `numbers` parameters here, and for the rest of the block as it was promised.
  void makeRoom(std::size_t modules, std::size_t numbers) {
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
  /// Copies the modules at the cursor up to the first that decomposition rules know.
  void copyListed(Cursor& cursor) {
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
  void keepListed(Cursor& cursor) {
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
  bool mayGoOnListing() {
    constexpr std::size_t betweenLooks = 1 << 14;
    if (++listed_ % betweenLooks == 0) look();
    if (lane_.ended()) return false;
    const auto made = static_cast<std::size_t>(pen_.to - lane_.out->codes.data());
    const auto numbers = static_cast<std::size_t>(pen_.numbers - lane_.out->parameters.data());
    if (made + numbers * sizeof(double) > s_.bytesLeft()) return met(Lane::Limit::Bytes);
    return made <= s_.options.limits.modules || met(Lane::Limit::Modules);
  }
  bool decompose(std::size_t at) {
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
  /// The decomposition rule that applies to the module at the cursor; its parameters are in the lane's locals then.
  const CompiledRule* decomposing(const RuleTable& table, const Cursor& cursor, std::size_t count, std::size_t at) {
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
  bool expand(const CompiledRule& rule, std::size_t count) {
    Cursor& cursor = lane_.cursors.back();
    const int depth = cursor.depth + 1;
    const std::uint64_t who = identified_ ? whoIs(lane_.lists.identities[cursor.at]) : 0;
    cursor.parameter += count;
    ++cursor.at;
    ++lane_.fired;
    const CompiledSuccessor* successor = choose(rule, lane_.locals.data());
    return successor != nullptr && list(rule, *successor, lane_.locals.data(), who, depth);
  }

  /// One of a rule's successors, by weight.
  const CompiledSuccessor* choose(const CompiledRule& rule, double* locals) {
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
  bool fire(const CompiledRule& rule, double* locals, std::size_t at) {
    if (rule.successors.size() == 1) return write(rule, locals, at);
    machine_.setRandom(successors_.split(step_, old_.who(at)));
    const CompiledSuccessor* successor = choose(rule, locals);
    return successor != nullptr && writeSuccessor(rule, *successor, locals, at);
  }

  double weight(const CompiledSuccessor& successor, double* locals) {
    const double w = machine_.value(successor.weight, locals);
    if (!machine_.trouble() && !(w >= 0)) machine_.giveUp(ErrorCode::NoAnswer, "a probability that is negative or no number");
    return w;
  }
  std::size_t drawn(const Plan& plan, std::size_t at) const { return chosen(plan.weights, plan.sum * choices_.split(step_, old_.who(at)).uniform()); }

  /// Whether a rule applies to the module at hand; `locals` is where its parameters are then: the string itself, where the rule
  /// has no contexts with parameters.
  bool applies(const CompiledRule& rule, std::size_t at, std::size_t parameters, double*& locals, double* frame) {
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
  std::size_t tryRules(const Rules& rules, RuleOf ruleOf, SymbolCode code, std::size_t at, std::size_t parameters) {
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

  std::size_t tryByWeight(const std::vector<std::uint32_t>& numbers, SymbolCode code, std::size_t at, std::size_t parameters) {
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
  std::size_t keepOrCopyAny(SymbolCode code, std::size_t at) {
    identified_ ? keepOrCopy<true>(pen_, plans_.hot[code], code, at) : keepOrCopy<false>(pen_, plans_.hot[code], code, at);
    return 0;
  }

  enum class Matched { NotYet, ByTable };

  Engine::State& s_;
  const Plans& plans_;
  const Program& program_;
  Machine& machine_;
  Lane& lane_;
  OldString old_;
  Matcher matcher_;
  Rng choices_, successors_, decompositions_;
  std::uint64_t step_;
  bool stochastic_, identified_, finite_, single_;
  Matched matched_ = Matched::NotYet;
  const CompiledRule* rule_ = nullptr;  ///< the last one that wrote; for messages
  std::size_t frame_ = 1;
  const double* in_ = nullptr;          ///< parameters of the module at hand
  std::size_t room_ = 0;                ///< modules of a block
  SymbolCode* codesEnd_ = nullptr;      ///< up to where decomposed modules may be written without making room
  double* numbersEnd_ = nullptr;
  bool unfolding_ = false;              ///< decomposition is quick
  int maximumDepth_ = 0;
  std::size_t calls_ = 0;               ///< successors that may be unfolded within each other
  std::size_t listed_ = 0;
  Pen pen_;                             ///< where the slower ways read and write
  std::vector<double> weights_;
};

}  // namespace axil::simeco
