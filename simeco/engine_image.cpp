// The image of a string: what its homomorphism makes of it, for drawing. Most homomorphisms ask for a module's own parameters alone
// and have no effects: those are followed at once. All others, and whatever goes wrong, take the general way, which says what it was.

#include "base/large_array.hpp"
#include "simeco/engine_pass.hpp"

#include <numeric>

namespace axil::simeco {

namespace {

constexpr int kMostDepth = 48;

/// A rule that needs its module's parameters and nothing else.
bool isQuick(const CompiledRule& rule, const Program& program) {
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

  QuickImage(Engine::State& state, const ModuleString& of, Arrays& out, Image& image)
      : s_(state), program_(*state.program), table_(program_.main().homomorphism), of_(of), out_(out), image_(image), machine_(state.machine()) {
    machine_.setInstance(&s_.main, &program_.main());
    for (const RuleIndex& index : table_.bySymbol) hasRules_[static_cast<std::size_t>(&index - table_.bySymbol.data())] = !index.all.empty();
    for (const CompiledRule& rule : table_.rules) {
      const auto& codes = rule.successors.front().codes;
      ends_.push_back(std::none_of(codes.begin(), codes.end(), [this](SymbolCode code) { return hasRules_[code]; }));
    }
  }

  /// False when it cannot be finished this way.
  bool draw() {
    const std::span<const SymbolCode> codes = of_.codes();
    const double* parameters = of_.parameters().data();
    for (std::size_t at = 0; at < codes.size();) {
      if (!hasRules_[codes[at]]) {
        copyRun(at, parameters);
        continue;
      }
      source_ = static_cast<std::uint32_t>(at);
      if (!lookUp(codes[at], parameters, 0, -1)) return false;
      parameters += program_.parameterCount[codes[at++]];
    }
    return withinLimits();
  }
  [[nodiscard]] bool depthReached() const { return depthReached_; }

 private:
  /// The modules up to the next that has rules.
  void copyRun(std::size_t& at, const double*& parameters) {
    const std::span<const SymbolCode> codes = of_.codes();
    const std::size_t begin = at;
    std::size_t numbers = 0;
    for (; at < codes.size() && !hasRules_[codes[at]]; ++at) numbers += program_.parameterCount[codes[at]];
    append(codes.subspan(begin, at - begin), {parameters, numbers});
    parameters += numbers;
    makeRoom(at - begin);
    for (std::size_t i = begin; i < at; ++i) image_.source.push_back(static_cast<std::uint32_t>(i));
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
    const std::size_t codesBefore = out_.codes.size(), numbersBefore = out_.parameters.size();
    out_.codes.reserveMore(codesBefore + codes.size());
    out_.parameters.reserveMore(numbersBefore + numbers.size());
    if (!codes.empty()) std::memcpy(out_.codes.data() + codesBefore, codes.data(), codes.size());
    if (!numbers.empty()) std::memcpy(out_.parameters.data() + numbersBefore, numbers.data(), numbers.size_bytes());
    out_.codes.setSize(codesBefore + codes.size());
    out_.parameters.setSize(numbersBefore + numbers.size());
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
    if (++looks_ % betweenLooks == 0 && (!withinLimits() || !s_.mayGoOn())) return false;
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
  [[nodiscard]] bool withinLimits() const { return out_.codes.size() <= s_.options.limits.modules && out_.used() <= s_.bytesLeft(); }

  Engine::State& s_;
  const Program& program_;
  const RuleTable& table_;
  const ModuleString& of_;
  Arrays& out_;
  Image& image_;
  Machine& machine_;
  std::array<bool, 256> hasRules_{};
  std::vector<char> ends_;             ///< of each rule, whether nothing that it makes has rules
  std::array<std::vector<double>, kMostDepth + 1> numbers_;  ///< parameters of the successor at each depth
  std::uint32_t source_ = 0;
  std::size_t looks_ = 0;
  bool depthReached_ = false;
};

void noteDepth(Engine::State& s) { s.note("the maximum depth of the homomorphism kept rules from being applied"); }

void take(Arrays& out, Image& image) {
  image.string.codeBuffer() = std::move(out.codes);
  image.string.parameterBuffer() = std::move(out.parameters);
}

}  // namespace

Result<Image> Engine::State::makeImage(const ModuleString& of) {
  const auto drawnAsItIs = [](const System& system) { return system.homomorphism.empty(); };
  if (std::all_of(program->systems.begin(), program->systems.end(), drawnAsItIs)) {
    Image same{of, std::vector<std::uint32_t>(of.size()), {}};
    std::iota(same.source.begin(), same.source.end(), 0u);
    return same;
  }
  if (QuickImage::knows(*this)) {
    Image image{ModuleString(program->symbols), {}, {}};
    Arrays out;
    out.parameters.reserve(1);  // so that there always is a place to read from
    QuickImage quick(*this, of, out, image);
    const bool drawn = quick.draw();
    machine().clearTrouble();
    if (drawn) {
      if (quick.depthReached()) noteDepth(*this);
      take(out, image);
      return image;
    }
  }
  Image image{ModuleString(program->symbols), {}, {}};
  Arrays out;
  std::fill(made.begin(), made.end(), 0);
  around.read(*program, program->main().ignored, needs, of.codes());
  const Instance mainBefore = main;
  const std::vector<Instance> visitsBefore = visits;
  Pass pass(*this, of, nullptr);
  const bool drawn = pass.draw(out, image);
  // An image is a view: what its statements do to variables is forgotten.
  main = mainBefore;
  visits = visitsBefore;
  if (!drawn) return pass.failure();
  if (pass.depthReached()) noteDepth(*this);
  take(out, image);
  return image;
}

}  // namespace axil::simeco
