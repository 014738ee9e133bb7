#pragma once
/// \file
/// The image of a string where its rules are quick: most homomorphisms ask for a module's own parameters alone and have no effects. Those
/// are followed at once, and for any stretch of the string by itself. Private to the engine; ImageReader is for who draws.

#include "base/large_array.hpp"
#include "simeco/engine_state.hpp"

#include <algorithm>

namespace axil::simeco {

inline constexpr int kMostDepth = 48;

/// A rule that needs its module's parameters and nothing else.
inline bool isQuick(const CompiledRule& rule, const Program& program) {
  return rule.predecessor.size() == 1 && rule.predecessor.front().slot == 0 && rule.left.empty() && rule.right.empty() && !rule.statements && !rule.random &&
         !rule.randomCondition && rule.successors.size() == 1 && rule.frame <= program.parameterCount[rule.predecessor.front().code];
}

class QuickImage {
 public:
  /// Whether all rules can be followed this way.
  static bool knows(const Engine::State& s) {
    const Program& program = *s.program;
    if (program.systems.size() > 1 || program.enter >= 0 || program.language != Language::LSystem || s.options.singlePrecision || s.options.generalWay) return false;
    const RuleTable& table = program.main().homomorphism;
    return table.maximumDepth <= kMostDepth && !table.draws &&
           std::all_of(table.rules.begin(), table.rules.end(), [&](const CompiledRule& rule) { return isQuick(rule, program); });
  }

  QuickImage(Engine::State& state, Machine& machine, ImagePiece& image)
      : s_(state), program_(*state.program), table_(program_.main().homomorphism), image_(image), machine_(machine) {
    image_.modules.parameters.reserve(1);  // so that there always is a place to read from
    machine_.setInstance(&s_.main, &program_.main());
    for (const RuleIndex& index : table_.bySymbol) hasRules_[static_cast<std::size_t>(&index - table_.bySymbol.data())] = !index.all.empty();
    for (const CompiledRule& rule : table_.rules) {
      const auto& codes = rule.successors.front().codes;
      ends_.push_back(std::none_of(codes.begin(), codes.end(), [this](SymbolCode code) { return hasRules_[code]; }));
    }
  }

  /// Appends the image of a stretch of the string that starts with module number `first`. False when it cannot be finished this way.
  bool draw(std::span<const SymbolCode> codes, const double* parameters, std::size_t first) {
    for (std::size_t at = 0; at < codes.size();) {
      if (!hasRules_[codes[at]]) {
        copyRun(codes, first, at, parameters);
        continue;
      }
      source_ = static_cast<std::uint32_t>(first + at);
      if (!lookUp(codes[at], parameters, 0, -1)) return false;
      parameters += program_.parameterCount[codes[at++]];
    }
    return withinLimits();
  }
  [[nodiscard]] bool depthReached() const { return depthReached_; }

 private:
  /// The modules up to the next that has rules.
  void copyRun(std::span<const SymbolCode> codes, std::size_t first, std::size_t& at, const double*& parameters) {
    const std::size_t begin = at;
    std::size_t numbers = 0;
    for (; at < codes.size() && !hasRules_[codes[at]]; ++at) numbers += program_.parameterCount[codes[at]];
    append(codes.subspan(begin, at - begin), {parameters, numbers});
    parameters += numbers;
    makeRoom(at - begin);
    for (std::size_t i = begin; i < at; ++i) image_.source.push_back(static_cast<std::uint32_t>(first + i));
    image_.drawnBy.insert(image_.drawnBy.end(), at - begin, -1);
  }
  /// For so many more notes; a quarter more at least, so that each costs the same.
  void makeRoom(std::size_t more) {
    const std::size_t needed = image_.source.size() + more;
    if (needed <= image_.source.capacity()) return;
    growRoom(image_.source, needed + needed / 4);
    growRoom(image_.drawnBy, image_.source.capacity());
  }
  void append(std::span<const SymbolCode> codes, std::span<const double> numbers) {
    const std::size_t codesBefore = image_.modules.codes.size(), numbersBefore = image_.modules.parameters.size();
    image_.modules.codes.reserveMore(codesBefore + codes.size());
    image_.modules.parameters.reserveMore(numbersBefore + numbers.size());
    if (!codes.empty()) std::memcpy(image_.modules.codes.data() + codesBefore, codes.data(), codes.size());
    if (!numbers.empty()) std::memcpy(image_.modules.parameters.data() + numbersBefore, numbers.data(), numbers.size_bytes());
    image_.modules.codes.setSize(codesBefore + codes.size());
    image_.modules.parameters.setSize(numbersBefore + numbers.size());
  }
  void note(std::size_t modules, std::int32_t rule) {
    makeRoom(modules);
    image_.source.insert(image_.source.end(), modules, source_);
    image_.drawnBy.insert(image_.drawnBy.end(), modules, rule);
  }

  /// A module that `depth` nested applications made, the last of them by rule `maker`.
  bool lookUp(SymbolCode code, const double* own, int depth, std::int32_t maker) {
    for (const std::uint32_t number : candidates(table_.bySymbol[code], own)) {
      const CompiledRule& rule = table_.rules[number];
      const auto met = [own](const Demand& demand) { return own[demand.offset] == demand.value; };
      const auto& demands = rule.predecessor.front().demands;
      if (!std::all_of(demands.begin(), demands.end(), met)) continue;
      const bool holds = !rule.hasCondition || machine_.value(rule.condition, const_cast<double*>(own)) != 0;
      if (machine_.trouble()) return false;
      if (!holds) continue;
      if (depth < table_.maximumDepth) return unfold(rule, number, own, depth + 1);
      depthReached_ = depthReached_ || (depth > 0 && table_.warn);
    }
    append({&code, 1}, {own, program_.parameterCount[code]});
    note(1, maker);
    return true;
  }
  bool unfold(const CompiledRule& rule, std::uint32_t number, const double* own, int depth) {
    const CompiledSuccessor& successor = rule.successors.front();
    const auto id = static_cast<std::int32_t>(rule.id);
    constexpr std::size_t betweenLooks = 1 << 12;
    if (++looks_ % betweenLooks == 0 && (!withinLimits() || s_.shared.late() || s_.options.watch.cancelled())) return false;
    std::vector<double>& numbers = numbers_[static_cast<std::size_t>(depth)];
    numbers.assign(successor.values.begin(), successor.values.end());
    if (!successor.constant) {
      numbers.clear();
      for (const Term& term : successor.terms) numbers.push_back(machine_.value(term, const_cast<double*>(own)));
      if (machine_.trouble()) return false;
    }
    if (ends_[number]) {
      append(successor.codes, numbers);
      note(successor.codes.size(), id);
      return true;
    }
    numbers.push_back(0);  // so that there always is a number to read
    const double* at = numbers.data();
    for (const SymbolCode code : successor.codes) {
      if (!lookUp(code, at, depth, id)) return false;
      at += program_.parameterCount[code];
    }
    return true;
  }
  [[nodiscard]] bool withinLimits() const { return image_.modules.codes.size() <= s_.options.limits.modules && image_.modules.used() <= s_.bytesLeft(); }

  Engine::State& s_;
  const Program& program_;
  const RuleTable& table_;
  ImagePiece& image_;
  Machine& machine_;
  std::array<bool, 256> hasRules_{};
  std::vector<char> ends_;             ///< of each rule, whether nothing that it makes has rules
  std::array<std::vector<double>, kMostDepth + 1> numbers_;  ///< parameters of the successor at each depth
  std::uint32_t source_ = 0;
  std::size_t looks_ = 0;
  bool depthReached_ = false;
};

/// Reads the image of a string in stretches, in any order; what it makes of one depends on nothing else. One thread, one reader.
class ImageReader {
 public:
  virtual ~ImageReader() = default;
  /// Appends the image of `codes`, of which the first is module number `first`, to `piece()`. False when it cannot be made this way.
  virtual bool read(std::span<const SymbolCode> codes, const double* parameters, std::size_t first) = 0;
  [[nodiscard]] virtual ImagePiece& piece() = 0;
  /// Upper bounds of how many of the letters in `letters` stand in the image of one module, by its code.
  [[nodiscard]] virtual std::array<std::size_t, 256> mostOf(std::string_view letters) const = 0;
  [[nodiscard]] virtual std::size_t mostModules() const = 0;  ///< that an image may have
};

}  // namespace axil::simeco
