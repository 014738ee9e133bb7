#pragma once
/// \file
/// What a turtle draws, as organs: each part of a string by itself, then all of them as one plant. Private to lsystem_plant.cpp.

#include "base/large_array.hpp"
#include "base/result.hpp"
#include "simeco/engine_workers.hpp"
#include "simeco/lsystem_plant.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <tuple>

namespace axil::simeco {

/// Segments that a part's turtle stands on at its start, but that an earlier part draws: the module of each, and which of that module's it is.
struct EarlierSegment {
  std::size_t module = 0;
  std::size_t ordinal = 0;
};

/// Notes which segments a turtle draws on its way to where a part starts.
class PathNotes : public TurtleSink {
 public:
  void segment(const TurtleSegment& s) override {
    const bool again = !segments.empty() && segments.back().module == s.module;
    segments.push_back({s.module, again ? segments.back().ordinal + 1 : 0});
  }
  std::vector<EarlierSegment> segments;
};

/// Collects what the turtle draws of a part of the string. Widths stay as drawn; what starts on a segment of an earlier part names it by a number below
/// `noOrgan`. PlantJoiner mends both.
class PlantMaker : public TurtleSink {
 public:
  PlantMaker(const Derivation& derivation, const LSystemView& view, std::vector<EarlierSegment> earlier = {})
      : derivation_(derivation), view_(view), earlier_(std::move(earlier)) {
    for (std::size_t i = 0; i < earlier_.size(); ++i) organOf_.push_back(noOrgan - 1 - static_cast<std::int32_t>(i));
  }

  /// For so many organs and faces at most.
  void makeRoom(std::size_t organs, std::size_t faces) {
    growRoom(plant_.organs, organs);
    growRoom(plant_.faces, faces);
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

  static constexpr std::int32_t noOrgan = -1;

 private:
  friend class PlantJoiner;

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
  void origin(Drawn& drawn, std::size_t module) const {
    drawn.module = static_cast<std::int64_t>(module);
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

  const Derivation& derivation_;
  const LSystemView& view_;
  std::vector<EarlierSegment> earlier_;
  Plant plant_;
  std::vector<std::int32_t> organOf_;  ///< of each segment
  std::int32_t lastStyle_ = 0;
  std::map<std::tuple<OrganKind, int, std::string>, std::int32_t> styles_;
  glm::dvec3 low_{0, 0, 0};
  glm::dvec3 high_{0, 0, 0};
  bool reached_ = false;
};

/// The parts of a string, in its order, as one plant.
class PlantJoiner {
 public:
  explicit PlantJoiner(std::vector<std::unique_ptr<PlantMaker>> parts) : parts_(std::move(parts)), plant_(std::move(parts_.front()->plant_)) {}

  Plant join(Workers& workers, double pixelsAcross) {
    for (std::size_t k = 1; k < parts_.size(); ++k) add(*parts_[k]);
    if (parts_.front()->view_.lineStyle == LineStyle::Pixel) scaleWidths(workers, extent() / std::max(pixelsAcross, 1.0));
    return std::move(plant_);
  }

 private:
  void add(PlantMaker& part) {
    Plant& from = part.plant_;
    const std::vector<std::int32_t> styles = stylesOf(from);
    const std::vector<std::int32_t> earlier = organsOf(part.earlier_);
    const auto first = static_cast<std::int32_t>(plant_.organs.size());
    plant_.organs.reserve(plant_.organs.size() + from.organs.size());
    for (Organ& organ : from.organs) {
      organ.style = styles[static_cast<std::size_t>(organ.style)];
      if (organ.parent && organ.parent->value >= 0) organ.parent->value += first;
      else if (organ.parent) organ.parent->value = earlier[static_cast<std::size_t>(PlantMaker::noOrgan - 1 - organ.parent->value)];
      plant_.organs.push_back(std::move(organ));
    }
    append(plant_.faces, from.faces, styles);
    append(plant_.balls, from.balls, styles);
    append(plant_.discs, from.discs, styles);
  }
  template <class Drawn>
  static void append(std::vector<Drawn>& to, std::vector<Drawn>& from, const std::vector<std::int32_t>& styles) {
    to.reserve(to.size() + from.size());
    for (Drawn& drawn : from) {
      drawn.style = styles[static_cast<std::size_t>(drawn.style)];
      to.push_back(std::move(drawn));
    }
  }
  /// The styles of a part among those of the plant, new ones at their end: in the order in which the string asks for them.
  std::vector<std::int32_t> stylesOf(const Plant& from) {
    std::vector<std::int32_t> numbers;
    for (const OrganStyle& style : from.styles) {
      const auto found = std::find(plant_.styles.begin(), plant_.styles.end(), style);
      numbers.push_back(static_cast<std::int32_t>(found - plant_.styles.begin()));
      if (found == plant_.styles.end()) plant_.styles.push_back(style);
    }
    return numbers;
  }
  /// Organs stand in the order of their modules, and a module's segments in theirs.
  [[nodiscard]] std::vector<std::int32_t> organsOf(const std::vector<EarlierSegment>& segments) const {
    std::vector<std::int32_t> numbers;
    for (const EarlierSegment& segment : segments) {
      const auto before = [](const Organ& organ, std::size_t module) { return organ.module < static_cast<std::int64_t>(module); };
      auto at = std::lower_bound(plant_.organs.begin(), plant_.organs.end(), segment.module, before);
      for (std::size_t left = segment.ordinal;; ++at) {
        AXIL_ASSERT(at != plant_.organs.end(), "what a turtle draws on its way to a part, the parts before draw too");
        if (at->tipRadius && left-- == 0) break;
      }
      numbers.push_back(static_cast<std::int32_t>(at - plant_.organs.begin()));
    }
    return numbers;
  }

  [[nodiscard]] double extent() const {
    glm::dvec3 low{0, 0, 0}, high{0, 0, 0};
    bool reached = false;
    for (const auto& part : parts_) {
      if (!part->reached_) continue;
      low = reached ? glm::min(low, part->low_) : part->low_;
      high = reached ? glm::max(high, part->high_) : part->high_;
      reached = true;
    }
    return glm::length(high - low);
  }
  void scaleWidths(Workers& workers, double factor) {
    const std::size_t share = plant_.organs.size() / static_cast<std::size_t>(workers.count()) + 1;
    workers.each([&](int worker) {
      const std::size_t begin = std::min(share * static_cast<std::size_t>(worker), plant_.organs.size());
      for (std::size_t i = begin; i < std::min(begin + share, plant_.organs.size()); ++i) {
        plant_.organs[i].radius *= factor;
        if (plant_.organs[i].tipRadius) *plant_.organs[i].tipRadius *= factor;
      }
    });
  }

  std::vector<std::unique_ptr<PlantMaker>> parts_;
  Plant plant_;
};

}  // namespace axil::simeco
