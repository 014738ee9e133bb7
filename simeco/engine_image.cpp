// The image of a string: what its homomorphism makes of it, for drawing. Most homomorphisms ask for a module's own parameters alone
// and have no effects: those are followed at once. All others, and whatever goes wrong, take the general way, which says what it was.

#include "simeco/engine_image.hpp"
#include "simeco/engine_pass.hpp"

#include <numeric>

namespace axil::simeco {

namespace {

/// Whether an expression's value depends on a module's parameters and the variables alone, whoever asks and when.
bool isPure(const Term& term, const Program& program) {
  if (term.kind != Term::Kind::Coded) return true;
  const Code& code = program.codes[static_cast<std::size_t>(term.code)];
  return std::all_of(program.instructions.begin() + code.first, program.instructions.begin() + code.end, [](const Instruction& x) {
    if (x.op == Op::Call) return static_cast<Function>(x.index) < Function::Random;
    return x.op != Op::HostFunction && x.op != Op::HostExchange && x.op != Op::HostPrint && x.op != Op::HostFile && x.op != Op::StoreLocal &&
           x.op != Op::StoreGlobal && x.op != Op::StoreElement;
  });
}

/// [ with ], { with }, in this order and all within.
bool closesWhatItOpens(const CompiledSuccessor& successor, const Program& program) {
  int brackets = 0, braces = 0;
  for (const SymbolCode code : successor.codes) {
    const std::string& letter = (*program.symbols)[code].letter;
    brackets += letter == "[" ? 1 : letter == "]" ? -1 : 0;
    braces += letter == "{" ? 1 : letter == "}" ? -1 : 0;
    if (brackets < 0 || braces < 0) return false;
  }
  return brackets == 0 && braces == 0;
}

/// The image of a finished string, by rules that are quick and pure.
class QuickReader : public ImageReader {
 public:
  explicit QuickReader(Engine::State& state) : state_(state), machine_(state.shared), quick_(state, machine_, piece_) {}

  bool read(std::span<const SymbolCode> codes, const double* parameters, std::size_t first) override { return quick_.draw(codes, parameters, first); }
  [[nodiscard]] ImagePiece& piece() override { return piece_; }
  [[nodiscard]] std::size_t mostModules() const override { return state_.options.limits.modules; }

  /// From the deepest rules up: a module stays as it is, or becomes what one of its rules makes of it.
  [[nodiscard]] std::array<std::size_t, 256> mostOf(std::string_view letters) const override {
    const Program& program = *state_.program;
    const RuleTable& table = program.main().homomorphism;
    std::array<std::size_t, 256> own{};
    for (std::size_t code = 0; code < program.symbols->size(); ++code) {
      const std::string& letter = (*program.symbols)[code].letter;
      own[code] = letter.size() == 1 && letters.find(letter[0]) != std::string_view::npos ? 1 : 0;
    }
    std::array<std::size_t, 256> most = own;
    for (int depth = 0; depth < table.maximumDepth; ++depth) {
      std::array<std::size_t, 256> next = own;
      for (const CompiledRule& rule : table.rules) {
        std::size_t made = 0;
        for (const SymbolCode code : rule.successors.front().codes) made = std::min(made + most[code], mostModules());
        std::size_t& bound = next[rule.predecessor.front().code];
        bound = std::max(bound, made);
      }
      most = next;
    }
    return most;
  }

 private:
  Engine::State& state_;
  Machine machine_;
  ImagePiece piece_;
  QuickImage quick_;
};

void noteDepth(Engine::State& s) { s.note("the maximum depth of the homomorphism kept rules from being applied"); }

Image imageFrom(const Program& program, ImagePiece piece) {
  Image image{ModuleString(program.symbols), std::move(piece.source), std::move(piece.drawnBy)};
  image.string.codeBuffer() = std::move(piece.modules.codes);
  image.string.parameterBuffer() = std::move(piece.modules.parameters);
  return image;
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
    ImagePiece piece;
    QuickImage quick(*this, machine(), piece);
    const bool drawn = quick.draw(of.codes(), of.parameters().data(), 0);
    machine().clearTrouble();
    if (drawn) {
      if (quick.depthReached()) noteDepth(*this);
      return imageFrom(*program, std::move(piece));
    }
  }
  ImagePiece piece;
  std::fill(made.begin(), made.end(), 0);
  around.read(*program, program->main().ignored, needs, of.codes());
  const Instance mainBefore = main;
  const std::vector<Instance> visitsBefore = visits;
  Pass pass(*this, of, nullptr);
  const bool drawn = pass.draw(piece);
  // An image is a view: what its statements do to variables is forgotten.
  main = mainBefore;
  visits = visitsBefore;
  if (!drawn) return pass.failure();
  if (pass.depthReached()) noteDepth(*this);
  return imageFrom(*program, std::move(piece));
}

std::unique_ptr<ImageReader> Engine::imageReader() const {
  State& s = *state_;
  const Program& program = *s.program;
  if (!QuickImage::knows(s)) return nullptr;
  const auto& rules = program.main().homomorphism.rules;
  const auto isOpen = [&](const CompiledRule& rule) {
    const std::string& letter = (*program.symbols)[rule.predecessor.front().code].letter;
    const CompiledSuccessor& successor = rule.successors.front();
    const bool pure = isPure(rule.condition, program) && std::all_of(successor.terms.begin(), successor.terms.end(), [&](const Term& term) { return isPure(term, program); });
    return !pure || !closesWhatItOpens(successor, program) || letter == "[" || letter == "]" || letter == "{" || letter == "}";
  };
  if (std::any_of(rules.begin(), rules.end(), isOpen)) return nullptr;
  return std::make_unique<QuickReader>(s);
}

}  // namespace axil::simeco
