#include "simeco/lsystem_plant.hpp"

#include "simeco/engine.hpp"
#include "simeco/engine_image.hpp"
#include "simeco/plant_maker.hpp"
#include "simeco/turtle_commands.hpp"
#include "simeco/turtle_parts.hpp"

#include <array>
#include <new>
#include <thread>

namespace axil::simeco {

namespace {

using turtle::Stretch;
using turtle::StringPart;
using turtle::Turtle;
using turtle::TurtleStand;

/// Stretches of a string, drawn as its homomorphism says, made while they are read: an image may be many times as long as its string.
class ImageInput : public turtle::TurtleInput {
 public:
  ImageInput(const ModuleString& string, std::vector<Stretch> stretches, ImageReader& reader) : string_(string), stretches_(std::move(stretches)), reader_(reader) {}

  bool more(std::size_t read, std::size_t parametersRead, turtle::TurtleWindow& window) override {
    if (failed_ || next_ == stretches_.size()) return false;
    forget(read, parametersRead);
    const ImagePiece& piece = reader_.piece();
    const std::size_t before = piece.source.size();
    while (piece.source.size() < before + turtle::kLongestCommand && !failed_ && readNext()) {}
    window = {piece.modules.codes.span(), piece.modules.parameters.data(), piece.source.data()};
    made_ += piece.source.size() - before;
    failed_ = failed_ || made_ > reader_.mostModules();
    return !failed_;
  }
  [[nodiscard]] bool failed() const { return failed_; }
  [[nodiscard]] std::size_t made() const { return made_; }

 private:
  bool readNext() {
    constexpr std::size_t atOnce = 1 << 12;
    if (next_ == stretches_.size()) return false;
    Stretch& stretch = stretches_[next_];
    const std::size_t count = std::min(atOnce, stretch.end - stretch.begin);
    const auto codes = string_.codes().subspan(stretch.begin, count);
    failed_ = !reader_.read(codes, string_.parameters().data() + stretch.parameter, stretch.begin);
    for (const SymbolCode code : codes) stretch.parameter += static_cast<std::size_t>(string_.symbols()[code].parameters);
    stretch.begin += count;
    if (stretch.begin == stretch.end) ++next_;
    return true;
  }
  /// Gives the room of what has been read back to what follows.
  void forget(std::size_t modules, std::size_t parameters) {
    ImagePiece& piece = reader_.piece();
    forget(piece.modules.codes, modules);
    forget(piece.modules.parameters, parameters);
    piece.source.erase(piece.source.begin(), piece.source.begin() + static_cast<std::ptrdiff_t>(modules));
    piece.drawnBy.erase(piece.drawnBy.begin(), piece.drawnBy.begin() + static_cast<std::ptrdiff_t>(modules));
  }
  template <class T>
  static void forget(Buffer<T>& buffer, std::size_t count) {
    if (buffer.size() > count) std::memmove(buffer.data(), buffer.data() + count, (buffer.size() - count) * sizeof(T));
    buffer.setSize(buffer.size() - count);
  }

  const ModuleString& string_;
  std::vector<Stretch> stretches_;
  ImageReader& reader_;
  std::size_t next_ = 0;
  std::size_t made_ = 0;
  bool failed_ = false;
};

/// What one turtle makes of its part of the string.
struct Drawing {
  std::unique_ptr<PlantMaker> maker;  ///< none where it failed
  bool alone = false;                 ///< it is only good when there is no other part
  std::size_t modules = 0;            ///< of the image
};

class PartDrawer {
 public:
  PartDrawer(const Derivation& derivation, const LSystemPlantOptions& options) : derivation_(derivation), options_(options) {}

  /// Nothing where memory runs out: no exception leaves a thread. The way that draws all as one then says so.
  [[nodiscard]] Drawing draw(const StringPart& part) const {
    try {
      return drawn(part);
    } catch (const std::bad_alloc&) {
      return {};
    }
  }

 private:
  [[nodiscard]] Drawing drawn(const StringPart& part) const {
    const std::unique_ptr<ImageReader> reader = derivation_.engine->imageReader(), pathReader = derivation_.engine->imageReader();
    std::optional<TurtleStand> stand;
    PathNotes notes;
    if (!part.path.empty()) {
      ImageInput path(derivation_.string, part.path, *pathReader);
      Turtle turtle = turtleOn(path, notes);
      auto reached = turtle.standAtEnd();
      if (!reached || path.failed() || turtle.leavesBranch()) return {};
      stand = *std::move(reached);
    }
    Drawing drawing{.maker = std::make_unique<PlantMaker>(derivation_, options_.derive.view, std::move(notes.segments))};
    makeRoom(*drawing.maker, part, *reader);
    ImageInput own(derivation_.string, {part.own}, *reader);
    Turtle turtle = turtleOn(own, *drawing.maker);
    if (stand) turtle.startAt(*std::move(stand));
    if (!turtle.run() || own.failed()) return {};
    drawing.alone = turtle.leavesBranch();
    drawing.modules = own.made();
    return drawing;
  }
  [[nodiscard]] Turtle turtleOn(turtle::TurtleInput& input, TurtleSink& sink) const {
    return {derivation_.string.symbols(), input, options_.derive.view, sink, options_.derive.derive.watch};
  }
  /// The first part takes in all others; room that is not touched costs nothing.
  void makeRoom(PlantMaker& maker, const StringPart& part, const ImageReader& reader) const {
    constexpr std::size_t mostOrgans = 4'000'000;
    const std::array<std::size_t, 256> organsOf = reader.mostOf("FG~"), facesOf = reader.mostOf("{");
    const std::size_t end = part.own.begin == 0 ? derivation_.string.size() : part.own.end;
    std::size_t organs = 0, faces = 0;
    for (const SymbolCode code : derivation_.string.codes().subspan(part.own.begin, end - part.own.begin)) {
      organs += organsOf[code];
      faces += facesOf[code];
    }
    maker.makeRoom(std::min(organs, mostOrgans), std::min(faces, mostOrgans));
  }

  const Derivation& derivation_;
  const LSystemPlantOptions& options_;
};

std::size_t threadsFor(const Derivation& derivation, const LSystemPlantOptions& options) {
  constexpr std::size_t most = 16;
  const int asked = options.derive.derive.threads;
  const std::size_t threads = asked > 0 ? static_cast<std::size_t>(asked) : std::thread::hardware_concurrency();
  const std::size_t worthwhile = derivation.string.size() / std::max<std::size_t>(options.modulesPerThread, 1);
  return std::clamp<std::size_t>(std::min(threads, worthwhile), 1, most);
}

using Makers = std::vector<std::unique_ptr<PlantMaker>>;

/// Draws `parts` at once, a thread each; nothing where a turtle fails, or does what only a turtle that has read everything before may do.
Makers drawnParts(const Derivation& derivation, const LSystemPlantOptions& options, const std::vector<StringPart>& parts, Workers& workers) {
  const PartDrawer drawer(derivation, options);
  std::vector<Drawing> drawings(parts.size());
  workers.each([&](int k) {
    if (static_cast<std::size_t>(k) < parts.size()) drawings[static_cast<std::size_t>(k)] = drawer.draw(parts[static_cast<std::size_t>(k)]);
  });
  Makers makers;
  std::size_t modules = 0;
  for (Drawing& drawing : drawings) {
    if (!drawing.maker || (drawing.alone && parts.size() > 1)) return {};
    modules += drawing.modules;
    makers.push_back(std::move(drawing.maker));
  }
  return modules <= options.derive.derive.limits.modules ? std::move(makers) : Makers{};
}

/// Draws the string while its image is made, on several threads; nothing where one of both needs everything that stands before.
Makers drawnInParts(const Derivation& derivation, const LSystemPlantOptions& options, Workers& workers) {
  if (!derivation.engine->imageReader()) return {};
  const auto parts = turtle::partsOf(derivation.string, static_cast<std::size_t>(workers.count()));
  Makers makers = drawnParts(derivation, options, parts, workers);
  if (makers.empty() && parts.size() > 1) makers = drawnParts(derivation, options, turtle::partsOf(derivation.string, 1), workers);
  return makers;
}

/// The way that any string can be drawn, and that says what is wrong with one.
Result<Makers> drawnWhole(const Derivation& derivation, const LSystemPlantOptions& options) {
  const auto image = imageOf(derivation);
  if (!image) return image.failure();
  auto maker = std::make_unique<PlantMaker>(derivation, options.derive.view);
  turtle::WholeString whole(image->string.codes(), image->string.parameters().data(), image->source.data());
  Turtle turtle(image->string.symbols(), whole, options.derive.view, *maker, options.derive.derive.watch);
  if (const auto report = turtle.run(); !report) return report.failure();
  Makers makers;
  makers.push_back(std::move(maker));
  return makers;
}

}  // namespace

glm::dvec4 colourOfIndex(int index) {
  const double share = ((index % 256 + 256) % 256) / 256.0;
  const auto channel = [&](double shift) { return std::clamp(std::fabs(std::fmod(share + shift, 1.0) * 6 - 3) - 1, 0.0, 1.0); };
  const double light = 0.45 + 0.4 * share;
  return {light * channel(1.0), light * channel(2.0 / 3), light * channel(1.0 / 3), 1};
}

Result<Plant> plantOfDerivation(const Grammar& grammar, const Derivation& derivation, const LSystemPlantOptions& options) {
  if (!derivation.engine) return fail(ErrorCode::BadInput, "a plant needs a derivation, and nothing has been derived");
  Workers workers(static_cast<int>(threadsFor(derivation, options)));
  Makers makers = drawnInParts(derivation, options, workers);
  if (makers.empty()) {
    auto whole = drawnWhole(derivation, options);
    if (!whole) return whole.failure();
    makers = *std::move(whole);
  }
  Plant plant = PlantJoiner(std::move(makers)).join(workers, options.pixelsAcross);
  plant.name = grammar.name;
  plant.rules = derivation.rules;
  plant.time = static_cast<double>(derivation.modulesPerStep.size());
  return plant;
}

Result<Plant> plantOfLSystem(const Grammar& grammar, const LSystemPlantOptions& options) {
  // What is drawn knows its rule, so the derivation is traced.
  DeriveLSystemOptions derive = options.derive;
  derive.derive.traced = true;
  const auto derivation = deriveLSystem(grammar, derive);
  if (!derivation) return derivation.failure();
  return plantOfDerivation(grammar, *derivation, options);
}

}  // namespace axil::simeco
