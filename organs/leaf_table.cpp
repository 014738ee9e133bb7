// Leaves by name: the tables of shapes and of the features that change them.
#include "organs/data.hpp"
#include "organs/leaf.hpp"
#include "organs/shape_table.hpp"

#include <algorithm>
#include <array>

namespace axil::organs {

namespace {

template <class T, std::size_t N>
using Words = std::array<std::pair<std::string_view, T>, N>;

constexpr Words<BaseLobes, 5> baseLobeWords{{{"none", BaseLobes::None},
                                             {"round", BaseLobes::Round},
                                             {"pointed", BaseLobes::Pointed},
                                             {"ears", BaseLobes::Ears},
                                             {"auricles", BaseLobes::Auricles}}};
constexpr Words<LeafLobes, 3> lobeWords{{{"none", LeafLobes::None}, {"pinnate", LeafLobes::Pinnate}, {"palmate", LeafLobes::Palmate}}};
constexpr Words<LeafMargin, 9> marginWords{{{"entire", LeafMargin::Entire},
                                            {"serrate", LeafMargin::Serrate},
                                            {"doubly-serrate", LeafMargin::DoublySerrate},
                                            {"dentate", LeafMargin::Dentate},
                                            {"crenate", LeafMargin::Crenate},
                                            {"undulate", LeafMargin::Undulate},
                                            {"sinuate", LeafMargin::Sinuate},
                                            {"spinose", LeafMargin::Spinose},
                                            {"ciliate", LeafMargin::Ciliate}}};
constexpr Words<LeafVeins, 8> veinWords{{{"pinnate", LeafVeins::Pinnate},
                                         {"palmate", LeafVeins::Palmate},
                                         {"parallel", LeafVeins::Parallel},
                                         {"arcuate", LeafVeins::Arcuate},
                                         {"reticulate", LeafVeins::Reticulate},
                                         {"dichotomous", LeafVeins::Dichotomous},
                                         {"midrib", LeafVeins::MidribOnly},
                                         {"none", LeafVeins::None}}};

using Cell = const ShapeCell&;
constexpr std::array<ShapeColumn<LeafShape>, 27> columns{{
    {"widthToLength", [](LeafShape& s, Cell c) { s.widthToLength = c.number(); }},
    {"widest", [](LeafShape& s, Cell c) { s.widest = c.number(); }},
    {"baseShoulder", [](LeafShape& s, Cell c) { s.base.shoulder = c.number(); }},
    {"baseEnd", [](LeafShape& s, Cell c) { s.base.end = c.number(); }},
    {"apexShoulder", [](LeafShape& s, Cell c) { s.apex.shoulder = c.number(); }},
    {"apexEnd", [](LeafShape& s, Cell c) { s.apex.end = c.number(); }},
    {"tailLength", [](LeafShape& s, Cell c) { s.tailLength = c.number(); }},
    {"tailWidth", [](LeafShape& s, Cell c) { s.tailWidth = c.number(); }},
    {"baseLobes", [](LeafShape& s, Cell c) { s.baseLobes = c.oneOf(baseLobeWords); }},
    {"baseLobeDepth", [](LeafShape& s, Cell c) { s.baseLobeDepth = c.number(); }},
    {"apexNotch", [](LeafShape& s, Cell c) { s.apexNotch = c.number(); }},
    {"shield", [](LeafShape& s, Cell c) { s.shield = c.number(); }},
    {"lobes", [](LeafShape& s, Cell c) { s.lobes = c.oneOf(lobeWords); }},
    {"lobeCount", [](LeafShape& s, Cell c) { s.lobeCount = c.whole(); }},
    {"lobeDepth", [](LeafShape& s, Cell c) { s.lobeDepth = c.number(); }},
    {"lobedUpTo", [](LeafShape& s, Cell c) { s.lobedUpTo = c.number(); }},
    {"lobeLean", [](LeafShape& s, Cell c) { s.lobeLean = c.number(); }},
    {"lobeTip", [](LeafShape& s, Cell c) { s.lobeTip = c.number(); }},
    {"margin", [](LeafShape& s, Cell c) { s.margin = c.oneOf(marginWords); }},
    {"teeth", [](LeafShape& s, Cell c) { s.teeth = c.whole(); }},
    {"toothDepth", [](LeafShape& s, Cell c) { s.toothDepth = c.number(); }},
    {"veins", [](LeafShape& s, Cell c) { s.veins = c.oneOf(veinWords); }},
    {"veinPairs", [](LeafShape& s, Cell c) { s.veinPairs = c.whole(); }},
    {"bend", [](LeafShape& s, Cell c) { s.bend = c.number(); }},
    {"oblique", [](LeafShape& s, Cell c) { s.oblique = c.number(); }},
    {"arch", [](LeafShape& s, Cell c) { s.arch = c.number(); }},
    {"fold", [](LeafShape& s, Cell c) { s.fold = c.number(); }},
}};

const ShapeTable<LeafShape>& tableOf(LeafFeature feature) {
  static const ShapeTable<LeafShape> apexes(data::leaf_apexes, "leaf_apexes.tsv", columns);
  static const ShapeTable<LeafShape> bases(data::leaf_bases, "leaf_bases.tsv", columns);
  static const ShapeTable<LeafShape> margins(data::leaf_margins, "leaf_margins.tsv", columns);
  static const ShapeTable<LeafShape> veins(data::leaf_veins, "leaf_veins.tsv", columns);
  switch (feature) {
    case LeafFeature::Apex: return apexes;
    case LeafFeature::Base: return bases;
    case LeafFeature::Margin: return margins;
    case LeafFeature::Veins: return veins;
  }
  return apexes;
}

void keepLobes(LeafShape& changed, const LeafShape& of) {
  changed.lobes = of.lobes;
  changed.lobeCount = of.lobeCount;
  changed.lobeDepth = of.lobeDepth;
  changed.lobedUpTo = of.lobedUpTo;
  changed.lobeLean = of.lobeLean;
  changed.lobeTip = of.lobeTip;
}

/// Lobes need room: a blade that becomes palmately cut is about as wide as long, and none is cut that is a thread.
void makeRoomForLobes(LeafShape& shape) {
  const bool palmate = shape.lobes == LeafLobes::Palmate;
  shape.widthToLength = std::max(shape.widthToLength, palmate ? 0.8 : 0.25);
  if (palmate && shape.veins == LeafVeins::Pinnate) shape.veins = LeafVeins::Palmate;
}

}  // namespace

const std::vector<LeafShape>& leafShapes() {
  static const std::vector<LeafShape> shapes = ShapeTable<LeafShape>(data::leaf_shapes, "leaf_shapes.tsv", columns).shapes();
  return shapes;
}

std::optional<LeafShape> leafShapeNamed(std::string_view name) { return namedIn(leafShapes(), name); }

LeafShape withWidth(LeafShape shape, double widthToLength) {
  shape.widthToLength = std::clamp(widthToLength, 0.005, 3.0);
  return shape;
}

std::vector<std::string> leafFeatureNames(LeafFeature feature) { return tableOf(feature).names(); }

std::optional<LeafShape> withFeature(const LeafShape& shape, LeafFeature feature, std::string_view name) {
  std::optional<LeafShape> changed = tableOf(feature).changed(name, shape);
  if (!changed) return changed;
  if (feature == LeafFeature::Margin && shape.lobes != LeafLobes::None) keepLobes(*changed, shape);
  else if (changed->lobes != shape.lobes) makeRoomForLobes(*changed);
  return changed;
}

}  // namespace axil::organs
