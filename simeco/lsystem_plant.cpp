#include "simeco/lsystem_plant.hpp"

#include "base/large_array.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

namespace axil::simeco {

namespace {

/// Collects what the turtle draws. Widths stay as drawn; `finish` makes them lengths.
class PlantMaker : public TurtleSink {
 public:
  PlantMaker(const Derivation& derivation, const Image& image, const LSystemView& view) : derivation_(derivation), image_(image), view_(view) {
    std::array<std::uint8_t, 256> draws{}, outlines{};
    for (std::size_t code = 0; code < image.string.symbols().size(); ++code) {
      const std::string& letter = image.string.symbols()[code].letter;
      draws[code] = letter == "F" || letter == "G" || letter == "~" ? 1 : 0;
      outlines[code] = letter == "{" && image.string.symbols()[code].parameters == 0 ? 1 : 0;
    }
    std::size_t organs = 0, faces = 0;
    for (const SymbolCode code : image.string.codes()) {
      organs += draws[code];
      faces += outlines[code];
    }
    growRoom(plant_.faces, faces);
    growRoom(plant_.organs, organs);
    organOf_.reserve(organs);
  }

  void segment(const TurtleSegment& s) override {
    Organ organ;
    organ.kind = OrganKind::Stem;
    organ.style = style(OrganKind::Stem, s.colour, {});
    if (s.parent) organ.parent = OrganId(organOf_[*s.parent]);
    organ.branch = s.branch;
    organ.base = {s.start};
    place(organ, s.frame, s.end - s.start);
    organ.radius = s.startWidth / 2;
    organ.tipRadius = s.endWidth / 2;
    origin(organ, s.module);
    organOf_.push_back(static_cast<std::int32_t>(plant_.organs.size()));
    reach(s.start);
    reach(s.end);
    plant_.organs.push_back(std::move(organ));
  }

  void surface(const TurtleSurface& s) override {
    Organ organ;
    const auto known = view_.surfaces.find(s.name);
    const ViewSurface drawn = known == view_.surfaces.end() ? ViewSurface{.kind = OrganKind::Leaf, .model = std::string(1, s.name), .scale = 1} : known->second;
    organ.kind = drawn.kind;
    organ.style = style(drawn.kind, s.colour, drawn.model);
    organ.branch = true;
    organ.base = {s.frame.position};
    place(organ, s.frame, s.frame.heading * (s.size.y * drawn.scale));
    origin(organ, s.module);
    reach(organ.tip().at);
    plant_.organs.push_back(std::move(organ));
  }

  void polygon(const TurtlePolygon& p) override {
    PlantFace face;
    face.vertices.reserve(p.vertices.size());
    for (const glm::dvec3& vertex : p.vertices) {
      // f and . often record one point twice.
      if (face.vertices.empty() || face.vertices.back().at != vertex) face.vertices.push_back({vertex});
      reach(vertex);
    }
    if (face.vertices.size() > 1 && face.vertices.front() == face.vertices.back()) face.vertices.pop_back();
    if (face.vertices.size() < 3) return;
    face.style = style(OrganKind::Leaf, p.colour, {});
    origin(face, p.module);
    plant_.faces.push_back(std::move(face));
  }

  void sphere(const TurtleSphere& s) override {
    PlantBall ball{{s.centre}, std::fabs(s.diameter) / 2, style(OrganKind::Fruit, s.colour, {}), -1, -1};
    origin(ball, s.module);
    reach(s.centre);
    plant_.balls.push_back(ball);
  }

  void disc(const TurtleDisc& d) override {
    PlantDisc disc{{d.centre}, PlantDirection::along(d.normal), std::fabs(d.diameter) / 2, style(OrganKind::Flower, d.colour, {}), -1, -1};
    origin(disc, d.module);
    reach(d.centre);
    plant_.discs.push_back(disc);
  }

  Plant finish(const std::string& name, double pixelsAcross) {
    plant_.name = name;
    plant_.rules = derivation_.rules;
    plant_.time = static_cast<double>(derivation_.modulesPerStep.size());
    if (view_.lineStyle == LineStyle::Pixel) scaleWidths(extent() / std::max(pixelsAcross, 1.0));
    return std::move(plant_);
  }

 private:
  static void place(Organ& organ, const TurtleFrame& frame, const glm::dvec3& along) {
    organ.length = glm::length(along);
    const bool directed = PlantDirection::hasDirection(along);
    organ.direction = PlantDirection::along(directed ? along : frame.heading);
    organ.rAxis = across(organ.direction, frame.left, frame.up);
    organ.adaxial = across(organ.direction, -frame.up, frame.left);
  }
  /// `wanted` made perpendicular to the organ; `otherwise` where it runs along it.
  static PlantDirection across(PlantDirection direction, const glm::dvec3& wanted, const glm::dvec3& otherwise) {
    const PlantDirection first = PlantDirection::along(wanted);
    return perpendicularTo(direction, areParallel(direction, first) ? PlantDirection::along(otherwise) : first);
  }

  template <class Drawn>
  void origin(Drawn& drawn, std::size_t imageModule) const {
    const std::uint32_t module = image_.source[imageModule];
    drawn.module = module;
    if (module < derivation_.origins.size()) drawn.production = derivation_.origins[module].production;
  }

  std::int32_t style(OrganKind kind, int colour, const std::string& model) {
    // Nearly every thing looks like the one before it.
    if (!plant_.styles.empty()) {
      const OrganStyle& last = plant_.styles[static_cast<std::size_t>(lastStyle_)];
      if (last.kind == kind && last.stage == colour && last.model == model) return lastStyle_;
    }
    const auto [found, isNew] = styles_.try_emplace({kind, colour, model}, static_cast<std::int32_t>(plant_.styles.size()));
    lastStyle_ = found->second;
    if (!isNew) return found->second;
    OrganStyle style;
    style.kind = kind;
    style.stage = colour;
    style.model = model;
    // What keeps the colour it started with looks as its kind does.
    if (const auto painted = view_.colours.find(colour); painted != view_.colours.end()) style.colour = painted->second;
    else if (colour != view_.colour) style.colour = colourOfIndex(colour);
    plant_.styles.push_back(std::move(style));
    return found->second;
  }

  void reach(const glm::dvec3& point) {
    low_ = reached_ ? glm::min(low_, point) : point;
    high_ = reached_ ? glm::max(high_, point) : point;
    reached_ = true;
  }
  [[nodiscard]] double extent() const { return glm::length(high_ - low_); }

  void scaleWidths(double factor) {
    for (Organ& organ : plant_.organs) {
      organ.radius *= factor;
      if (organ.tipRadius) *organ.tipRadius *= factor;
    }
  }

  const Derivation& derivation_;
  const Image& image_;
  const LSystemView& view_;
  Plant plant_;
  std::vector<std::int32_t> organOf_;  ///< of each segment
  std::int32_t lastStyle_ = 0;
  std::map<std::tuple<OrganKind, int, std::string>, std::int32_t> styles_;
  glm::dvec3 low_{0, 0, 0};
  glm::dvec3 high_{0, 0, 0};
  bool reached_ = false;
};

}  // namespace

glm::dvec4 colourOfIndex(int index) {
  const double share = ((index % 256 + 256) % 256) / 256.0;
  const auto channel = [&](double shift) { return std::clamp(std::fabs(std::fmod(share + shift, 1.0) * 6 - 3) - 1, 0.0, 1.0); };
  const double light = 0.45 + 0.4 * share;
  return {light * channel(1.0), light * channel(2.0 / 3), light * channel(1.0 / 3), 1};
}

Result<Plant> plantOfDerivation(const Grammar& grammar, const Derivation& derivation, const LSystemPlantOptions& options) {
  const auto image = imageOf(derivation);
  if (!image) return image.failure();
  PlantMaker maker(derivation, *image, options.derive.view);
  const auto report = interpret(image->string, options.derive.view, maker, options.derive.derive.watch);
  if (!report) return report.failure();
  return maker.finish(grammar.name, options.pixelsAcross);
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
