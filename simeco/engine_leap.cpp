// Leaps: where every rule is free of contexts, conditions and parameters of its own, what a module becomes in k steps is always
// the same string. So that string is worked out once per symbol, and the last k steps are copies of whole blocks: a derivation
// costs little more than writing its last string. The numbers of modules in between come from the growth of letter counts.

#include "simeco/engine_state.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace axil::simeco {

namespace {

/// For every symbol the modules that it becomes in some number of steps; nothing for symbols without a rule.
struct Blocks {
  std::array<Arrays, 256> bySymbol;
  std::size_t bytes = 0;
};

using Counts = std::array<double, 256>;  // exact up to 2^53 modules, far above any limit

class Leap {
 public:
  Leap(Engine::State& state, std::int64_t steps) : s_(state), plans_(*state.plans), steps_(steps) {}

  Result<Engine::Outcome> run(std::vector<std::size_t>& modulesPerStep) {
    if (auto counted = count(modulesPerStep); !counted) return counted.failure();
    // The remainder first, while the string is short, then whole blocks.
    prepare();
    for (std::int64_t left = steps_; left > 0;) {
      const std::int64_t whole = static_cast<std::int64_t>(powers_.size());
      const std::int64_t now = left % whole == 0 ? whole : left % whole;
      apply(powers_[static_cast<std::size_t>(now - 1)]);
      left -= now;
      s_.steps += now;
      if (auto go = s_.mayGoOn(); !go) return go.failure();
      s_.options.watch.report("deriving", static_cast<double>(steps_ - left) / static_cast<double>(steps_));
    }
    return settled_ ? Engine::Outcome::Settled : Engine::Outcome::Changed;
  }

 private:
  [[nodiscard]] const CompiledSuccessor* successorOf(std::size_t code) const {
    return plans_.hot[code].kind == Plan::Kind::Direct ? plans_.bySymbol[code].direct->successor : nullptr;
  }
  /// Whether rewriting the symbol changes anything.
  [[nodiscard]] bool active(std::size_t code) const {
    const CompiledSuccessor* successor = successorOf(code);
    return successor != nullptr && !(successor->codes.size() == 1 && successor->codes.front() == code && successor->terms.empty());
  }

  /// Modules after each step, and whether the limits allow them, before anything is written.
  Result<void> count(std::vector<std::size_t>& modulesPerStep) {
    Counts counts{};
    for (const SymbolCode code : s_.string.codes()) counts[code] += 1;
    bool resting = false;
    for (std::int64_t step = 0; step < steps_; ++step) {
      resting = true;
      Counts next{};
      double modules = 0, parameters = 0;
      for (std::size_t code = 0; code < plans_.codes; ++code) {
        if (counts[code] == 0) continue;
        resting = resting && !active(code);
        const CompiledSuccessor* successor = successorOf(code);
        if (successor == nullptr) next[code] += counts[code];
        if (successor != nullptr)
          for (const SymbolCode made : successor->codes) next[made] += counts[code];
      }
      for (std::size_t code = 0; code < plans_.codes; ++code) {
        modules += next[code];
        parameters += next[code] * s_.program->parameterCount[code];
      }
      counts = next;
      if (modules > static_cast<double>(s_.options.limits.modules)) return tooMany("modules", s_.options.limits.modules, counts, step);
      if (modules + 8 * parameters > static_cast<double>(s_.options.limits.bytes)) return tooMany("bytes", s_.options.limits.bytes, counts, step);
      modulesPerStep.push_back(static_cast<std::size_t>(modules));
      modules_ = static_cast<std::size_t>(modules);
      if (!resting) continue;
      modulesPerStep.resize(modulesPerStep.size() + static_cast<std::size_t>(steps_ - step - 1), modules_);
      break;
    }
    settled_ = resting;
    return {};
  }
  /// The rule that makes most of what there is too much of.
  Failure tooMany(const char* what, std::size_t limit, const Counts& counts, std::int64_t step) {
    const CompiledRule* most = nullptr;
    double made = -1;
    for (std::size_t code = 0; code < plans_.codes; ++code) {
      if (!active(code) || counts[code] * plans_.bySymbol[code].direct->length <= made) continue;
      made = counts[code] * plans_.bySymbol[code].direct->length;
      most = plans_.bySymbol[code].direct->rule;
    }
    s_.steps += step;
    return s_.tooMany(what, limit, most);
  }

  /// What each symbol becomes in one, two, ... steps, while all of it stays small against the string and the cache.
  void prepare() {
    constexpr std::size_t enough = 1 << 17;
    Blocks one;
    for (std::size_t code = 0; code < plans_.codes; ++code) {
      if (const CompiledSuccessor* successor = successorOf(code)) {
        one.bySymbol[code].codes.assign(successor->codes);
        one.bySymbol[code].parameters.assign(successor->values);
        one.bySymbol[code].parameters.reserve(1);
        if (s_.options.singlePrecision)
          for (std::size_t i = 0; i < successor->values.size(); ++i)
            one.bySymbol[code].parameters[i] = static_cast<double>(static_cast<float>(successor->values[i]));
      }
    }
    measure(one);
    powers_.push_back(std::move(one));
    while (static_cast<std::int64_t>(powers_.size()) < steps_) {
      // k + 1 steps: one step, then k steps of what that made.
      std::size_t expected = 0;
      for (std::size_t code = 0; code < plans_.codes; ++code) expected += expectedBytes(powers_.front().bySymbol[code], powers_.back());
      if (expected > std::min(enough, modules_ / 8 + 64)) return;
      Blocks next;
      for (std::size_t code = 0; code < plans_.codes; ++code)
        if (successorOf(code) != nullptr) write(powers_.front().bySymbol[code].codes.span(), powers_.front().bySymbol[code].parameters.data(), powers_.back(), next.bySymbol[code]);
      measure(next);
      powers_.push_back(std::move(next));
    }
  }
  static void measure(Blocks& blocks) {
    for (const Arrays& block : blocks.bySymbol) blocks.bytes += block.codes.size() + block.parameters.size() * sizeof(double);
  }
  [[nodiscard]] std::size_t expectedBytes(const Arrays& from, const Blocks& blocks) const {
    std::size_t bytes = 0;
    for (const SymbolCode code : from.codes.span()) {
      const Arrays& block = blocks.bySymbol[code];
      bytes += successorOf(code) == nullptr ? 1 + 8 * std::size_t{s_.program->parameterCount[code]} : block.codes.size() + 8 * block.parameters.size();
    }
    return bytes;
  }

  struct Lengths {
    std::array<std::size_t, 256> codes{}, parameters{};
  };
  [[nodiscard]] Lengths lengthsOf(const Blocks& blocks) const {
    Lengths lengths;
    for (std::size_t code = 0; code < plans_.codes; ++code) {
      const bool rewritten = successorOf(code) != nullptr;
      lengths.codes[code] = rewritten ? blocks.bySymbol[code].codes.size() : 1;
      lengths.parameters[code] = rewritten ? blocks.bySymbol[code].parameters.size() : s_.program->parameterCount[code];
    }
    return lengths;
  }

  /// Every module of `from` replaced by its block.
  void write(std::span<const SymbolCode> from, const double* parameters, const Blocks& blocks, Arrays& to) const {
    const Lengths lengths = lengthsOf(blocks);
    std::size_t codes = 0, numbers = 0;
    for (const SymbolCode code : from) {
      codes += lengths.codes[code];
      numbers += lengths.parameters[code];
    }
    to.codes.setSize(codes);
    to.parameters.setSize(numbers);
    writeAt(from, parameters, blocks, lengths, to.codes.data(), to.parameters.data());
  }
  void writeAt(std::span<const SymbolCode> from, const double* parameters, const Blocks& blocks, const Lengths& lengths, SymbolCode* to, double* numbers) const {
    std::array<const SymbolCode*, 256> sources{};
    for (std::size_t code = 0; code < plans_.codes; ++code) sources[code] = successorOf(code) == nullptr ? nullptr : blocks.bySymbol[code].codes.data();
    for (const SymbolCode code : from) {
      const std::size_t length = lengths.codes[code], count = lengths.parameters[code];
      if (sources[code] == nullptr) {
        *to = code;
        for (std::size_t i = 0; i < count; ++i) numbers[i] = parameters[i];
      } else {
        std::memcpy(to, sources[code], length);
        if (count > 0) std::memcpy(numbers, blocks.bySymbol[code].parameters.data(), count * sizeof(double));
      }
      to += length;
      numbers += count;
      parameters += s_.program->parameterCount[code];
    }
  }

  /// The whole string, in as many parts as there are threads; where each part goes is known from the lengths.
  void apply(const Blocks& blocks) {
    struct Part {
      std::size_t begin = 0, parameter = 0, to = 0, number = 0;
    };
    constexpr std::size_t worthThreads = 1 << 18;
    const Lengths lengths = lengthsOf(blocks);
    const std::span<const SymbolCode> codes = s_.string.codes();
    const auto threads = static_cast<std::size_t>(s_.workers->count());
    const std::size_t written = expectedTotal(codes, lengths);
    std::vector<Part> parts{Part{}};
    Part now;
    for (std::size_t i = 0; i < codes.size(); ++i) {
      if (now.to * threads >= written * parts.size() && parts.size() < threads && i > 0) {
        now.begin = i;
        parts.push_back(now);
      }
      now.to += lengths.codes[codes[i]];
      now.number += lengths.parameters[codes[i]];
      now.parameter += s_.program->parameterCount[codes[i]];
    }
    now.begin = codes.size();
    parts.push_back(now);
    s_.spare.codes.setSize(now.to);
    s_.spare.parameters.setSize(now.number);
    const auto part = [&](int thread) {
      const auto t = static_cast<std::size_t>(thread);
      if (t + 1 >= parts.size()) return;
      const Part& p = parts[t];
      writeAt(codes.subspan(p.begin, parts[t + 1].begin - p.begin), s_.string.parameters().data() + p.parameter, blocks, lengths, s_.spare.codes.data() + p.to,
              s_.spare.parameters.data() + p.number);
    };
    if (now.to + 8 * now.number < worthThreads)
      for (int thread = 0; thread < s_.workers->count(); ++thread) part(thread);
    else
      s_.workers->each(part);
    s_.string.codeBuffer().swap(s_.spare.codes);
    s_.string.parameterBuffer().swap(s_.spare.parameters);
    s_.notePeak(0);
  }
  static std::size_t expectedTotal(std::span<const SymbolCode> codes, const Lengths& lengths) {
    std::size_t total = 0;
    for (const SymbolCode code : codes) total += lengths.codes[code];
    return total;
  }

  Engine::State& s_;
  const Plans& plans_;
  std::int64_t steps_;
  std::size_t modules_ = 0;
  bool settled_ = false;
  std::vector<Blocks> powers_;
};

}  // namespace

bool Engine::State::canLeap() const {
  return plain && plans->leaps && timeless && !identified;
}

Result<Engine::Outcome> Engine::State::leap(std::int64_t count, std::vector<std::size_t>& modulesPerStep) { return Leap(*this, count).run(modulesPerStep); }

}  // namespace axil::simeco
