#include "simeco/lsystem_derive.hpp"

#include "simeco/lsystem_turtle.hpp"

#include <algorithm>

namespace axil::simeco {

namespace {

bool asks(const std::vector<Module>& modules) {
  return std::any_of(modules.begin(), modules.end(), [](const Module& m) { return m.letter == "?" && m.arguments.empty(); });
}
bool asks(const std::vector<Production>& rules) {
  return std::any_of(rules.begin(), rules.end(), [](const Production& rule) {
    return std::any_of(rule.successors.begin(), rule.successors.end(), [](const Successor& s) { return asks(s.modules); });
  });
}
bool asks(const RuleSet& rules) { return asks(rules.axiom) || asks(rules.productions) || (rules.decomposition && asks(rules.decomposition->productions)); }
bool asks(const PlantGrammar& plant) {
  return asks(plant.rules) || std::any_of(plant.subRules.begin(), plant.subRules.end(), [](const RuleSet& r) { return asks(r); });
}

/// Where the parameters of every module start.
std::vector<std::size_t> parameterPlaces(const ModuleString& string) {
  std::vector<std::size_t> places;
  places.reserve(string.size());
  std::size_t at = 0;
  for (const SymbolCode code : string.codes()) {
    places.push_back(at);
    at += static_cast<std::size_t>(string.symbols()[code].parameters);
  }
  return places;
}

/// Writes what the turtle answers into the parameters of the string.
class Answers : public TurtleSink {
 public:
  Answers(HostStep& step, const Image& image) : string_(step.string()), parameters_(step.parameters()), image_(image), places_(parameterPlaces(string_)) {}

  void query(const TurtleQuery& q) override {
    const std::size_t module = image_.source[q.module];
    const Symbol& symbol = string_.symbols()[string_.codes()[module]];
    // A query that only the homomorphism makes has no parameters of its own in the string.
    if (symbol.letter.size() != 1 || symbol.letter[0] != q.asked || q.asked == 'E') return;
    const glm::dvec3 value = answer(q);
    for (int i = 0; i < std::min(symbol.parameters, 3); ++i) parameters_[places_[module] + static_cast<std::size_t>(i)] = value[i];
  }

 private:
  static glm::dvec3 answer(const TurtleQuery& q) {
    switch (q.asked) {
      case 'H': return q.frame.heading;
      case 'L': return q.frame.left;
      case 'U': return q.frame.up;
      default: return q.frame.position;
    }
  }

  const ModuleString& string_;
  std::span<double> parameters_;
  const Image& image_;
  std::vector<std::size_t> places_;
};

Result<void> answerQueries(HostStep& step, const LSystemView& view) {
  const auto image = step.image();
  if (!image) return image.failure();
  Answers answers(step, *image);
  const auto report = interpret(image->string, view, answers);
  if (!report) return report.failure();
  return {};
}

}  // namespace

Result<Derivation> deriveLSystem(const Grammar& grammar, const DeriveLSystemOptions& options) {
  DeriveOptions derivation = options.derive;
  if (derivation.plant >= grammar.plants.size()) return fail(ErrorCode::BadInput, "the grammar has no plant number " + std::to_string(derivation.plant + 1));
  if (asks(grammar.plants[derivation.plant])) {
    derivation.host.betweenSteps = [view = options.view, next = options.derive.host.betweenSteps](HostStep& step) -> Result<void> {
      if (auto answered = answerQueries(step, view); !answered) return answered;
      return next ? next(step) : Result<void>{};
    };
  }
  return derive(grammar, derivation);
}

}  // namespace axil::simeco
