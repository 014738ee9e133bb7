#include "render/known_plants.hpp"

#include "base/rng.hpp"

#include <cmath>

namespace axil::render::test {

using simeco::Organ;
using simeco::OrganId;
using simeco::OrganKind;
using simeco::OrganStyle;
using simeco::Plant;

PlantMaker::PlantMaker() { plant.name = "known"; }

std::int32_t PlantMaker::style(OrganKind kind, const std::string& model, std::optional<glm::dvec4> colour) {
  for (std::size_t i = 0; i < plant.styles.size(); ++i)
    if (plant.styles[i].kind == kind && plant.styles[i].model == model && plant.styles[i].colour == colour) return static_cast<std::int32_t>(i);
  OrganStyle style;
  style.kind = kind;
  style.stage = static_cast<int>(plant.styles.size()) + 1;
  style.model = model;
  style.colour = colour;
  plant.styles.push_back(style);
  return static_cast<std::int32_t>(plant.styles.size() - 1);
}

OrganId PlantMaker::first(glm::dvec3 base, glm::dvec3 direction, double length, double radius, std::int32_t styleIndex) {
  Organ organ;
  organ.style = styleIndex;
  organ.kind = plant.styles[static_cast<std::size_t>(styleIndex)].kind;
  organ.base = {base};
  organ.direction = PlantDirection::along(direction);
  const StemFrame frame = firstFrame(organ.direction);
  organ.rAxis = frame.rAxis;
  organ.adaxial = frame.adaxial;
  organ.length = length;
  organ.radius = radius;
  plant.organs.push_back(organ);
  return OrganId(static_cast<std::int32_t>(plant.organs.size() - 1));
}

OrganId PlantMaker::on(OrganId parent, bool branch, glm::dvec3 direction, double length, double radius, std::int32_t styleIndex) {
  const Organ below = plant.at(parent);
  const OrganId id = first(below.tip().at, direction, length, radius, styleIndex);
  Organ& organ = plant.organs.back();
  organ.parent = parent;
  organ.branch = branch;
  if (!areParallel(organ.direction, below.direction)) organ.adaxial = perpendicularTo(organ.direction, below.direction);
  return id;
}

Plant straightStem(int segments, double length, double radius) {
  std::vector<glm::dvec3> nodes;
  for (int i = 0; i <= segments; ++i) nodes.emplace_back(0, length * i / segments, 0);
  return stemThrough(nodes, radius);
}

Plant stemThrough(const std::vector<glm::dvec3>& nodes, double radius) {
  PlantMaker make;
  const std::int32_t stem = make.style(OrganKind::Stem);
  OrganId last = make.first(nodes[0], nodes[1] - nodes[0], glm::distance(nodes[0], nodes[1]), radius, stem);
  for (std::size_t i = 2; i < nodes.size(); ++i)
    last = make.on(last, false, nodes[i] - nodes[i - 1], glm::distance(nodes[i], nodes[i - 1]), radius, stem);
  return make.plant;
}

namespace {

struct Shoot {
  OrganId base;
  bool branch;
  glm::dvec3 direction;
  double length;   // of a segment
  double radius;
  int segments;
  int level;
};

class ShrubMaker {
 public:
  explicit ShrubMaker(int levels) : levels_(levels) {
    stem_ = make_.style(OrganKind::Stem, "", glm::dvec4(0, 1, 0, 1));
    leaf_ = make_.style(OrganKind::Leaf, "ovate.i", glm::dvec4(0, 1, 0, 1));
    flower_ = make_.style(OrganKind::Flower);
    fruit_ = make_.style(OrganKind::Fruit);
  }

  Plant made() {
    const OrganId collar = make_.first({0, 0, 0}, {0.05, 1, 0.02}, 0.11, 0.0075, stem_);
    grow({collar, false, {-0.05, 1, 0.05}, 0.085, 0.007, 7, 0});
    return std::move(make_.plant);
  }

 private:
  void grow(const Shoot& shoot) {
    OrganId at = shoot.base;
    glm::dvec3 direction = shoot.direction;
    double side = rng_.uniform(0, 3);
    for (int k = 0; k < shoot.segments; ++k) {
      const double along = static_cast<double>(k) / shoot.segments;
      direction = glm::normalize(glm::normalize(direction) + glm::dvec3{rng_.uniform(-0.16, 0.16), 0.13, rng_.uniform(-0.16, 0.16)});
      at = make_.on(at, shoot.branch && k == 0, direction, shoot.length * (1 - 0.35 * along), shoot.radius * (1 - 0.7 * along), stem_);
      side += 1.5707963;  // decussate
      const bool last = k + 1 == shoot.segments;
      for (const double half : {0.0, 3.14159265}) sprout(at, direction, side + half, along, shoot, last);
    }
    if (shoot.level == 0 || rng_.uniform() < 0.5) make_.on(at, false, direction, 0.024, 0, flower_);
  }

  void sprout(OrganId at, glm::dvec3 direction, double side, double along, const Shoot& shoot, bool last) {
    const glm::dvec3 u = glm::normalize(glm::cross(direction, glm::dvec3(0.3, 0.1, 1)));
    const glm::dvec3 out = u * std::cos(side) + glm::cross(direction, u) * std::sin(side);
    if (shoot.level < levels_ && along > 0.05 && along < 0.75 && rng_.uniform() < 0.75)
      grow({at, true, glm::normalize(out * 0.9 + direction * 0.75), shoot.length * 0.72, shoot.radius * (1 - 0.6 * along) * 0.62, 5, shoot.level + 1});
    if (shoot.level == levels_ && !last && rng_.uniform() < 0.12) {
      const OrganId stalk = make_.on(at, true, glm::normalize(out + direction), 0.012, 0.0007, stem_);
      make_.on(stalk, false, glm::normalize(out + glm::dvec3(0, -0.6, 0)), 0.014, 0, fruit_);
      return;
    }
    if (along < 0.1 && shoot.level == 0) return;
    const OrganId petiole = make_.on(at, true, glm::normalize(out * 0.8 + direction * 0.6), 0.014, 0.0011, stem_);
    const double size = (last ? 0.6 : 1.0) * rng_.uniform(0.052, 0.075);
    const double droop = rng_.uniform(-0.35, 0.1);
    make_.on(petiole, false, glm::normalize(out + direction * 0.25 + glm::dvec3(0, droop, 0)), size, 0, leaf_);
    Organ& blade = make_.plant.organs.back();
    blade.adaxial = perpendicularTo(blade.direction, PlantDirection::along({0.02, 1, 0.01}));
  }

  PlantMaker make_;
  Rng rng_{5};
  int levels_;
  std::int32_t stem_, leaf_, flower_, fruit_;
};

}  // namespace

Plant shrub(int levels) { return ShrubMaker(levels).made(); }

}  // namespace axil::render::test
