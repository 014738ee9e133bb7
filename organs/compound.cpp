#include "organs/compound.hpp"

#include "base/angle.hpp"
#include "organs/mesh_tools.hpp"

#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace axil::organs {

namespace {

constexpr std::array<std::pair<std::string_view, LeafType>, 11> typeWords{{{"odd-pinnate", LeafType::OddPinnate},
                                                                           {"even-pinnate", LeafType::EvenPinnate},
                                                                           {"bipinnate", LeafType::Bipinnate},
                                                                           {"tripinnate", LeafType::Tripinnate},
                                                                           {"palmate", LeafType::Palmate},
                                                                           {"trifoliolate", LeafType::Trifoliolate},
                                                                           {"biternate", LeafType::Biternate},
                                                                           {"unifoliolate", LeafType::Unifoliolate},
                                                                           {"bifoliolate", LeafType::Bifoliolate},
                                                                           {"pinnate", LeafType::OddPinnate},
                                                                           {"compound", LeafType::OddPinnate}}};
constexpr int mostLeaflets = 81;

/// A leaflet, or a pinna: where it stands in the leaf's plane, which way it points (from +Y, to the right above 0), how long it is.
struct Place {
  glm::dvec2 foot{};
  Angle turn;
  double length = 1;
};

/// A leaf's plan: its stalks as lines, its leaflets as places. Everything is in the plane z = 0.
struct Plan {
  struct Stalk {
    glm::dvec2 from{}, to{};
    double radius = 0;
  };
  std::vector<Stalk> stalks;
  std::vector<Place> leaflets;
};

glm::dvec2 along(Angle turn) { return {std::sin(turn.radians()), std::cos(turn.radians())}; }

glm::dvec2 carried(const Place& place, const glm::dvec2& p) {
  const glm::dvec2 up = along(place.turn), right{up.y, -up.x};
  return place.foot + place.length * (right * p.x + up * p.y);
}

/// `part`, a leaf of its own, put in place as a pinna of a larger one.
void addPlaced(Plan& plan, const Plan& part, const Place& place) {
  for (const Plan::Stalk& s : part.stalks) plan.stalks.push_back({carried(place, s.from), carried(place, s.to), 0.75 * s.radius * place.length});
  for (const Place& l : part.leaflets) plan.leaflets.push_back({carried(place, l.foot), place.turn + l.turn, l.length * place.length});
}

struct PinnateOptions {
  int pairs = 3;
  bool terminal = true;
  double petiole = 0.14;
  double width = 0.5;   ///< of a leaflet to its length
  double length = 0;    ///< of a leaflet; 0: so that neighbours about touch
  Angle angle = 62_deg;
};

/// Where the pinnae of a pinnate leaf stand: pairs up the rachis, the middle ones longest, and one at the tip.
std::vector<Place> pinnatePlaces(const PinnateOptions& o) {
  const double tipShare = o.terminal ? 0.75 : 0.25;
  // With n pairs over what the last leaflet leaves of the rachis, spaced by their width: l = 0.92 d / w.
  const double free = 1 - o.petiole;
  const double spacings = std::max(1.0, o.pairs - 1 + 0.45);
  const double ownLength = free / (spacings * o.width / 0.92 + tipShare);
  const double length = std::clamp(o.length > 0 ? o.length : ownLength, 0.05, 0.46);
  const double top = 1 - length * (o.terminal ? 1 : 0.55);
  std::vector<Place> places;
  for (int i = 0; i < o.pairs; ++i) {
    const double share = o.pairs == 1 ? 0.5 : static_cast<double>(i) / (o.pairs - 1);
    const double end = o.terminal ? top - 0.10 * (top - o.petiole) / o.pairs - 0.02 : top;
    const double y = o.pairs == 1 ? 0.5 * (o.petiole + end) + 0.2 * (end - o.petiole) : o.petiole + (end - o.petiole) * share;
    const double size = length * (0.80 + 0.20 * std::sin(3.1 * std::min(1.0, 0.18 + 0.75 * share)));
    const Angle turn = o.angle * (1 - 0.22 * share);
    places.push_back({{0.004, y}, turn, size});
    places.push_back({{-0.004, y}, -turn, size});
  }
  if (o.terminal) places.push_back({{0, top}, Angle{}, length});
  return places;
}

Plan leafletsAt(const std::vector<Place>& places, double petiole) {
  Plan plan;
  double top = petiole;
  for (const Place& place : places) top = std::max(top, place.foot.y);
  plan.stalks.push_back({{0, 0}, {0, top}, 0.009});
  plan.leaflets = places;
  return plan;
}

Plan pinnaeAt(const std::vector<Place>& places, double petiole, const Plan& pinna) {
  Plan plan;
  double top = petiole;
  for (const Place& place : places) top = std::max(top, place.foot.y);
  plan.stalks.push_back({{0, 0}, {0, top}, 0.009});
  for (const Place& place : places) addPlaced(plan, pinna, place);
  return plan;
}

/// Leaflets from the end of the petiole, like fingers: the middle ones longest.
std::vector<Place> fingers(int count, double petiole, double leafletLength) {
  const double spread = count <= 3 ? 62 * (count - 1) : std::min(118.0 * 2, 38.0 * (count - 1));
  const double longest = leafletLength > 0 ? std::min(leafletLength, 1 - petiole) : 1 - petiole;
  std::vector<Place> places;
  for (int i = 0; i < count; ++i) {
    const double share = count == 1 ? 0 : 2.0 * i / (count - 1) - 1;  // -1 to 1 around the middle
    const double size = longest * (1 - 0.42 * std::pow(std::abs(share), 1.5));
    places.push_back({{0, petiole}, Angle::fromDegrees(0.5 * spread * share), size});
  }
  return places;
}

int oddAtLeast3(int count) { return std::max(3, count % 2 == 0 ? count + 1 : count); }
int evenAtLeast2(int count) { return std::max(2, count % 2 == 0 ? count : count + 1); }

int usualLeaflets(LeafType type) {
  switch (type) {
    case LeafType::OddPinnate: return 9;
    case LeafType::EvenPinnate: return 12;
    case LeafType::Bipinnate: return 20;
    case LeafType::Tripinnate: return 7;
    case LeafType::Palmate: return 5;
    case LeafType::Trifoliolate:
    case LeafType::Biternate: return 3;
    case LeafType::Unifoliolate: return 1;
    case LeafType::Bifoliolate: return 2;
  }
  return 1;
}

Plan pinnatePlan(const CompoundLeaf& leaf, int count, double petiole, double length) {
  return leafletsAt(pinnatePlaces({.pairs = count / 2, .terminal = count % 2 == 1, .petiole = petiole, .width = leaf.leaflet.widthToLength, .length = length}), petiole);
}

Plan bipinnatePlan(const CompoundLeaf& leaf) {
  const Plan pinna = pinnatePlan(leaf, leafletCount(leaf), 0.08, 0);
  const int pinnae = std::clamp(leaf.pinnae > 0 ? leaf.pinnae : 10, 2, 40);
  return pinnaeAt(pinnatePlaces({.pairs = pinnae / 2, .terminal = pinnae % 2 == 1, .petiole = leaf.petiole, .width = 0.36}), leaf.petiole, pinna);
}

Plan tripinnatePlan(const CompoundLeaf& leaf) {
  const Plan smallest = pinnatePlan(leaf, leafletCount(leaf), 0.1, 0);
  const Plan pinna = pinnaeAt(pinnatePlaces({.pairs = 3, .terminal = true, .petiole = 0.1, .width = 0.5}), 0.1, smallest);
  const int pinnae = std::clamp(leaf.pinnae > 0 ? leaf.pinnae : 7, 3, 21);
  return pinnaeAt(pinnatePlaces({.pairs = pinnae / 2, .terminal = true, .petiole = leaf.petiole + 0.08, .width = 0.5}), leaf.petiole + 0.08, pinna);
}

Plan fingerPlan(const CompoundLeaf& leaf, double petiole) { return leafletsAt(fingers(leafletCount(leaf), petiole, leaf.leafletLength), petiole); }

Plan planOf(const CompoundLeaf& leaf) {
  switch (leaf.type) {
    case LeafType::OddPinnate:
    case LeafType::EvenPinnate: return pinnatePlan(leaf, leafletCount(leaf), leaf.petiole, leaf.leafletLength);
    case LeafType::Bipinnate: return bipinnatePlan(leaf);
    case LeafType::Tripinnate: return tripinnatePlan(leaf);
    case LeafType::Palmate: return fingerPlan(leaf, std::max(leaf.petiole, 0.42));
    case LeafType::Trifoliolate: return fingerPlan(leaf, std::max(leaf.petiole, 0.38));
    case LeafType::Biternate: return pinnaeAt(fingers(3, 0.3, 0), 0.3, leafletsAt(fingers(3, 0.3, 0), 0.3));
    case LeafType::Unifoliolate: return leafletsAt({{{0, 0.26}, Angle{}, 0.74}}, 0.26);
    case LeafType::Bifoliolate: return leafletsAt({{{0, 0.3}, -26_deg, 0.74}, {{0, 0.3}, 26_deg, 0.74}}, 0.3);
  }
  return {};
}

glm::dmat4 matrixOf(const Place& place) {
  // Leaflets of one leaf do not lie in one plane to the last bit: they rise a little to their tips, each as its side does.
  const glm::dvec2 flat = along(place.turn);
  const glm::dvec3 up = glm::normalize(glm::dvec3{flat, 0.10 * std::abs(flat.x)});
  const glm::dvec3 right = glm::normalize(glm::dvec3{flat.y, -flat.x, 0});
  const glm::dvec3 face = glm::cross(right, up);
  return {glm::dvec4(right * place.length, 0), glm::dvec4(up * place.length, 0), glm::dvec4(face * place.length, 0), glm::dvec4(place.foot, 0, 1)};
}

/// A leaflet seen from afar: two triangles over its widest place.
std::vector<Part> rhomb(const LeafShape& leaflet) {
  const auto half = static_cast<float>(0.46 * leaflet.widthToLength), widest = static_cast<float>(leaflet.widest);
  Part part = leafParts(leaflet, std::nullopt, Detail::Far).front();
  part.mesh.positions = {{0, 0, 0}, {half, widest, 0}, {0, 1, 0}, {-half, widest, 0}};
  part.mesh.normals.assign(4, {0, 0, 1});
  part.mesh.uvs = {{0.5f, 0}, {1, widest}, {0.5f, 1}, {0, widest}};
  part.mesh.triangles = {0, 1, 2, 0, 2, 3};
  return {part};
}

std::vector<Part> leafletParts(const CompoundLeaf& leaf, std::size_t count, Detail detail) {
  LeafShape shape = leaf.leaflet;
  shape.arch *= 0.6;
  if (detail == Detail::Close && count <= 15) return leafParts(shape, std::nullopt, count <= 3 ? Detail::Close : Detail::Medium);
  if (detail == Detail::Far || count > 60) return rhomb(shape);
  return leafParts(shape, std::nullopt, detail == Detail::Close ? Detail::Medium : Detail::Far);
}

/// Leaflets of toothed leaves keep their teeth where a few of them are looked at closely.
std::vector<Part> closeLeafletParts(const CompoundLeaf& leaf, std::size_t count) {
  if (count <= 3 || count > 15) return leafletParts(leaf, count, Detail::Close);
  LeafShape shape = leaf.leaflet;
  shape.arch *= 0.6;
  std::vector<Part> parts = leafParts(shape, std::nullopt, shape.teeth > 0 || shape.lobes != LeafLobes::None ? Detail::Close : Detail::Medium);
  std::erase_if(parts, [](const Part& part) { return part.name == "vein" || part.name == "hair"; });
  return parts;
}

Part rachisOf(const Plan& plan, Detail detail) {
  Part part{"rachis", {0.24f, 0.36f, 0.10f}, {}};
  const int sides = detail == Detail::Close ? 5 : 3;
  for (const Plan::Stalk& s : plan.stalks) {
    const std::array<glm::dvec3, 2> path{glm::dvec3(s.from, 0), glm::dvec3(s.to, 0)};
    append(part.mesh, tube(path, std::array<double, 2>{s.radius, 0.6 * s.radius}, sides));
  }
  return part;
}

}  // namespace

std::optional<LeafType> leafTypeNamed(std::string_view name) {
  const auto found = std::find_if(typeWords.begin(), typeWords.end(), [&](const auto& w) { return w.first == name; });
  return found == typeWords.end() ? std::nullopt : std::optional(found->second);
}

std::vector<std::string> leafTypeNames() {
  std::vector<std::string> names;
  for (const auto& word : typeWords) names.emplace_back(word.first);
  return names;
}

int leafletCount(const CompoundLeaf& leaf) {
  const int wanted = std::clamp(leaf.leaflets > 0 ? leaf.leaflets : usualLeaflets(leaf.type), 1, mostLeaflets);
  switch (leaf.type) {
    case LeafType::OddPinnate:
    case LeafType::Tripinnate: return oddAtLeast3(wanted);
    case LeafType::EvenPinnate:
    case LeafType::Bipinnate: return evenAtLeast2(wanted);
    case LeafType::Palmate: return std::clamp(wanted, 3, 15);
    case LeafType::Trifoliolate:
    case LeafType::Biternate: return 3;
    case LeafType::Unifoliolate: return 1;
    case LeafType::Bifoliolate: return 2;
  }
  return wanted;
}

std::vector<Part> compoundParts(const CompoundLeaf& leaf, Detail detail) {
  const Plan plan = planOf(leaf);
  const std::vector<Part> leaflet = detail == Detail::Close ? closeLeafletParts(leaf, plan.leaflets.size()) : leafletParts(leaf, plan.leaflets.size(), detail);
  std::vector<Part> parts;
  for (const Part& source : leaflet) {
    if (source.name == "petiole") continue;
    Part part{source.name, source.colour, {}};
    for (const Place& place : plan.leaflets) append(part.mesh, transformed(source.mesh, matrixOf(place)));
    parts.push_back(std::move(part));
  }
  if (detail != Detail::Far) parts.push_back(rachisOf(plan, detail));
  return parts;
}

}  // namespace axil::organs
