#include "simeco/lsystem_derive.hpp"

#include "simeco/lsystem_turtle.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <numbers>
#include <string>
#include <utility>

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

/// What is drawn as patches, and where the turtle is at every `?E`.
class Surveyor : public TurtleSink {
 public:
  explicit Surveyor(const LSystemView& view) : stemsShade_(view.lineStyle != LineStyle::Pixel) {}

  void segment(const TurtleSegment& s) override {
    if (stemsShade_) add((s.start + s.end) / 2.0, glm::length(s.end - s.start) * (s.startWidth + s.endWidth) / 2);
  }
  void surface(const TurtleSurface& s) override { add(s.frame.position + s.frame.heading * (s.size.y / 2), std::fabs(s.size.x * s.size.y)); }
  void sphere(const TurtleSphere& s) override { add(s.centre, std::numbers::pi / 4 * s.diameter * s.diameter); }
  void disc(const TurtleDisc& d) override {
    if (!d.outline) add(d.centre, std::numbers::pi / 4 * d.diameter * d.diameter);
  }
  void polygon(const TurtlePolygon& p) override {
    if (p.vertices.empty()) return;
    glm::dvec3 middle{0}, twice{0};
    for (std::size_t i = 0; i < p.vertices.size(); ++i) {
      middle += p.vertices[i];
      twice += glm::cross(p.vertices[i] - p.vertices[0], p.vertices[(i + 1) % p.vertices.size()] - p.vertices[0]);
    }
    add(middle / static_cast<double>(p.vertices.size()), glm::length(twice) / 2);
  }
  void query(const TurtleQuery& q) override {
    if (q.asked == 'E') asked.push_back(q);
  }

  std::vector<TurtleQuery> asked;
  std::vector<DrawnPatch> patches;

 private:
  void add(const glm::dvec3& at, double area) { patches.push_back({at, area}); }
  bool stemsShade_;
};

bool isCommunication(const Symbol& symbol) { return symbol.letter == "E"; }

/// One exchange with the environment program.
Result<void> communicate(HostStep& step, const Image& image, const LSystemView& view, const EnvironmentProgram& program, const Watch& watch) {
  Surveyor surveyor(view);
  if (const auto report = interpret(image.string, view, surveyor, watch); !report) return report.failure();
  const ModuleString& string = step.string();
  const std::vector<std::size_t> places = parameterPlaces(string), drawnPlaces = parameterPlaces(image.string);
  std::vector<double> lost(image.string.parameters().begin(), image.string.parameters().end());  // parameters of what only the homomorphism makes
  const auto drawnSymbol = [&](std::size_t module) -> const Symbol& { return image.string.symbols()[image.string.codes()[module]]; };
  std::vector<Message> messages;
  for (const TurtleQuery& q : surveyor.asked) {
    const std::size_t module = image.source[q.module];
    const Symbol& own = string.symbols()[string.codes()[module]];
    const Symbol& drawn = drawnSymbol(q.module);
    Message message{module, {}, q.frame, q.width, q.scale, {}};
    message.parameters = isCommunication(own) ? step.parameters().subspan(places[module], static_cast<std::size_t>(own.parameters))
                                              : std::span(lost).subspan(drawnPlaces[q.module], static_cast<std::size_t>(drawn.parameters));
    if (const std::size_t next = q.module + 1; next < image.string.size())
      message.following = ModuleView{drawnSymbol(next).letter, image.string.parameters().subspan(drawnPlaces[next], static_cast<std::size_t>(drawnSymbol(next).parameters))};
    messages.push_back(message);
  }
  return program({step.step(), messages, surveyor.patches});
}

Result<void> answerQueries(HostStep& step, const DeriveLSystemOptions& options) {
  auto image = step.image();
  if (!image) return image.failure();
  if (options.environment && !step.finished()) {
    if (auto done = communicate(step, *image, options.view, options.environment, options.derive.watch); !done) return done;
    image = step.image();  // the answers may be drawn
    if (!image) return image.failure();
  }
  Answers answers(step, *image);
  const auto report = interpret(image->string, options.view, answers, options.derive.watch);
  if (!report) return report.failure();
  return {};
}

/// `func(n, x)` as the n-th curve. A copy of the curves: an image of the string may ask later.
std::function<Result<double>(std::int64_t, std::span<const double>)> functionsOf(std::vector<ResponseCurve> curves) {
  return [curves = std::move(curves)](std::int64_t number, std::span<const double> arguments) -> Result<double> {
    const std::string name = "func(" + std::to_string(number) + ", ...)";
    if (number < 1 || number > std::ssize(curves) || curves[static_cast<std::size_t>(number - 1)].points.empty())
      return fail(ErrorCode::BadInput, name + " is called, but the view file has no such function; write function: 0 0  0.5 1  1 0 into it, one line a function");
    if (arguments.size() != 1) return fail(ErrorCode::BadInput, name + " takes one value");
    return curves[static_cast<std::size_t>(number - 1)].at(arguments[0]);
  };
}

}  // namespace

Result<Derivation> deriveLSystem(const Grammar& grammar, const DeriveLSystemOptions& options) {
  DeriveOptions derivation = options.derive;
  if (derivation.plant >= grammar.plants.size()) return fail(ErrorCode::BadInput, "the grammar has no plant number " + std::to_string(derivation.plant + 1));
  if (!derivation.host.function && !options.view.functions.empty()) derivation.host.function = functionsOf(options.view.functions);
  if (asks(grammar.plants[derivation.plant])) {
    derivation.host.betweenSteps = [&options](HostStep& step) -> Result<void> {
      if (auto answered = answerQueries(step, options); !answered) return answered;
      return options.derive.host.betweenSteps ? options.derive.host.betweenSteps(step) : Result<void>{};
    };
  }
  return derive(grammar, derivation);
}

}  // namespace axil::simeco
