#pragma once
/// \file
/// PartPass: one thread's part of a step of the plain way. Its inner loops, `rewriteBytes` and `rewrite`, do what nearly all modules
/// need; what is rarer stands in engine_part_rules and engine_part_decompose. Private to engine_plain.cpp.

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
    if (plans_.rightCodes) plans_.pairs ? readRightCodes<true>(begin, end) : readRightCodes<false>(begin, end);
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
    if (!identified && plans_.pairs)
      return eachBlock(begin, end, [this](std::size_t at, std::size_t to, SymbolCode last, LeftFringe& fringe) { return rewritePairs(at, to, last, fringe); });
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

  /// Who is to the right of each module; `pairs`: beside the module itself, in one byte.
  template <bool pairs>
  void readRightCodes(std::size_t begin, std::size_t end);

  template <bool withParameters, bool identified, bool withLeft, bool withRight>
  void blocks(std::size_t begin, std::size_t end) {
    eachBlock(begin, end, [this](std::size_t at, std::size_t to, SymbolCode last, LeftFringe& fringe) {
      return rewrite<withParameters, identified, withLeft, withRight>(at, to, last, fringe);
    });
  }

  /// Block by block: room for the longest that a block can become is made before it, so that nothing inside has to ask.
  template <class Rewrite>
  void eachBlock(std::size_t begin, std::size_t end, Rewrite rewriteBlock);
  /// Whether to go on at all.
  void look();

  // ---- strings without parameters (engine_part_bytes.hpp)

  /// The draws of up to so many modules, made ahead of them: they do not wait for each other then.
  struct Draws {
    static constexpr std::size_t most = 1024;
    std::array<std::uint16_t, most> places;       ///< of the modules that draw, counted from the first
    std::array<std::uint32_t, most + 1> tickets;
    std::array<std::uint64_t, most + 1> families;
  };
  void drawAhead(Draws& draws, std::size_t begin, std::size_t end) const;

  /// Without parameters every module is replaced by an entry of a table, copied whole; the only branches are brackets.
  template <bool identified, bool withLeft, bool withRight>
  SymbolCode rewriteBytes(std::size_t begin, std::size_t end, SymbolCode last, LeftFringe& fringe);
  template <bool identified, bool withLeft, bool withRight>
  SymbolCode rewriteEntries(std::size_t begin, std::size_t end, SymbolCode last, LeftFringe& fringe, const Draws* draws);
  /// The same where a module and its right neighbour are one byte.
  SymbolCode rewritePairs(std::size_t begin, std::size_t end, SymbolCode last, LeftFringe& fringe);
  /// The identities of an entry's modules, the first and then five at a time: a Buffer has room behind its end.
  static void writeFew(Identity* born, std::uint64_t family, const std::array<std::uint64_t, 16>& keys, const ByteEntry& made);
  /// As `chosen`, without a branch that chance would take.
  static std::uint32_t ticket(const Plan& plan, std::uint64_t draw);

  // ---- every module in turn

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

  const QuickSuccessor* firstThatHolds(const Plan& plan, const double* in, bool& fine);
  std::size_t tryAny(const Plan& plan, SymbolCode code, std::size_t at, std::size_t parameters);

  /// The left neighbour of what follows a module.
  SymbolCode leftAfter(std::uint8_t role, SymbolCode code, SymbolCode last, LeftFringe& fringe);

  // ---- rules that must be tried (engine_part_rules.hpp)

  bool inTrouble(const CompiledRule& rule);
  /// The parameters of a successor.
  bool compute(const CompiledRule& rule, const CompiledSuccessor& successor, double* locals);
  bool writeSuccessor(const CompiledRule& rule, const CompiledSuccessor& successor, double* locals, std::size_t at);
  /// A rule with one successor.
  bool write(const CompiledRule& rule, double* locals, std::size_t at);
  /// One of a rule's successors, by weight.
  const CompiledSuccessor* choose(const CompiledRule& rule, double* locals);
  bool fire(const CompiledRule& rule, double* locals, std::size_t at);
  double weight(const CompiledSuccessor& successor, double* locals);
  std::size_t drawn(const Plan& plan, std::size_t at) const { return chosen(plan.weights, plan.sum * choices_.split(step_, old_.who(at)).uniform()); }
  /// Whether a rule applies to the module at hand; `locals` is where its parameters are then: the string itself, where the rule
  /// has no contexts with parameters.
  bool applies(const CompiledRule& rule, std::size_t at, std::size_t parameters, double*& locals, double* frame);
  /// The first of the rules that applies fires; else the module is copied. How many fired: 0 or 1.
  template <class Rules, class RuleOf>
  std::size_t tryRules(const Rules& rules, RuleOf ruleOf, SymbolCode code, std::size_t at, std::size_t parameters);
  std::size_t tryByWeight(const std::vector<std::uint32_t>& numbers, SymbolCode code, std::size_t at, std::size_t parameters);
  /// No rule applied: none fired.
  std::size_t keepOrCopyAny(SymbolCode code, std::size_t at);

  // ---- quick decomposition: rules that ask for a module's own parameters; each module is written where it belongs at once ------

  /// So deep rules are followed by calls; what is deeper goes on with lists.
  static constexpr int kCalls = 48;
  static constexpr std::size_t kMostParameters = 32;

  template <bool identified>
  bool unfoldAll(Pen& pen, const QuickSuccessor& successor, std::size_t at);
  bool withinModules(const Pen& pen);
  template <bool identified>
  bool unfold(Pen& pen, const QuickSuccessor& successor, const double* in, std::uint64_t who, int depth);
  /// A module that `depth` nested applications made: what its decomposition rules make of it, or itself.
  template <bool identified>
  bool unfoldModule(Pen& pen, SymbolCode code, std::size_t parameters, const double* own, std::uint64_t who, int depth);
  /// With lists, which may be as deep as memory allows.
  template <bool identified>
  bool unfoldDeeper(Pen& pen, const CompiledRule& rule, const double* own, std::uint64_t who, int depth);
  /// Room for a successor and the rest of the block; fails where a limit is met.
  template <bool identified>
  bool roomToUnfold(Pen& pen, const QuickSuccessor& successor);
  /// Room that must be left for the rest of the block, and for what the successors that are being unfolded still have to write.
  [[nodiscard]] std::size_t promisedCodes() const { return room_ * plans_.longest + calls_ * plans_.longestUnfolding; }
  [[nodiscard]] std::size_t promisedNumbers() const { return room_ * plans_.most + calls_ * plans_.mostUnfolding; }
  /// Up to where decomposed modules may be written.
  void endsOfRoom();

  // ---- decomposition: lists of modules, the innermost first, each module looked up ----------------------------------

  bool decomposes(const CompiledSuccessor& successor) const;
  /// A module without production: a list of one.
  bool keep(SymbolCode code, std::size_t parameters, std::size_t at);
  /// Puts a successor on top of the lists.
  bool list(const CompiledRule& rule, const CompiledSuccessor& successor, double* locals, std::uint64_t who, int depth);
  bool met(Lane::Limit limit);
  /// Room for `modules` with `numbers` parameters here, and for the rest of the block as it was promised.
  void makeRoom(std::size_t modules, std::size_t numbers);
  /// Copies the modules at the cursor up to the first that decomposition rules know.
  void copyListed(Cursor& cursor);
  void keepListed(Cursor& cursor);
  bool mayGoOnListing();
  bool decompose(std::size_t at);
  /// The decomposition rule that applies to the module at the cursor; its parameters are in the lane's locals then.
  const CompiledRule* decomposing(const RuleTable& table, const Cursor& cursor, std::size_t count, std::size_t at);
  bool expand(const CompiledRule& rule, std::size_t count);

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

#include "simeco/engine_part_blocks.hpp"
#include "simeco/engine_part_rules.hpp"
#include "simeco/engine_part_bytes.hpp"
#include "simeco/engine_part_decompose.hpp"
