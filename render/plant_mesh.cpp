#include "render/plant_mesh.hpp"

#include "render/axes.hpp"
#include "render/colour.hpp"
#include "render/organ_models.hpp"
#include "render/parallel.hpp"
#include "render/stem_mesh.hpp"
#include "render/tube.hpp"
#include "render/turtle_shapes.hpp"

#include <glm/common.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

namespace axil::render {
namespace {

using organs::Detail;
using simeco::Organ;
using simeco::OrganId;
using simeco::OrganKind;
using simeco::OrganStyle;
using simeco::Plant;

/// A stem without a radius is this share of its length thick; no stem is thinner than the second share of the plant.
constexpr double radiusOfLength = 0.02, thinnestOfExtent = 2e-4;
/// Corners of a bent organ nearer to each other than this share of its length are drawn as one.
constexpr double shortestTrailPiece = 1e-4;
/// A turtle's lines keep their corners: sharper bends than this are joints, not curves.
constexpr Angle sharpestTurtleBend = 35_deg;
/// A stem ends this much thinner than its last segment is, when nothing sits on its tip, and when something does.
constexpr double freeTipTaper = 0.55, loadedTipTaper = 0.85;

bool isFinite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

bool isPlaced(const Organ& organ) {
  return isFinite(organ.base.at) && std::isfinite(organ.length) && std::isfinite(organ.radius) && organ.length >= 0;
}

Result<void> checkOrgans(const Plant& plant) {
  const std::size_t i = firstOf(plant.organs.size(), [&](std::size_t k) { return !isPlaced(plant.organs[k]); });
  if (i == plant.organs.size()) return {};
  const Organ& organ = plant.organs[i];
  return fail(ErrorCode::BadInput, "organ " + std::to_string(i) + " (" + simeco::keywordOf(organ.kind) + ", stage " +
                                       std::to_string(plant.styleOf(organ).stage) +
                                       ") has no finite place and size; look for a division by zero or a runaway growth rate in its stage");
}

TubeDetail tubeDetailFor(Detail detail, double relativeRadius) {
  switch (detail) {
    case Detail::Close: return {.sides = relativeRadius > 0.006 ? 16 : 10, .turnPerRing = 3_deg, .capRings = 3};
    case Detail::Medium: return {.sides = 8, .turnPerRing = 5_deg, .capRings = 2};
    case Detail::Far: return {.sides = 8, .turnPerRing = 20_deg, .capRings = 1};
  }
  return {};
}

std::string materialName(const PlantMesh& mesh, const std::string& wanted) {
  const auto taken = [&](const std::string& name) {
    return std::any_of(mesh.materials.begin(), mesh.materials.end(), [&](const Material& m) { return m.name == name; });
  };
  if (!taken(wanted)) return wanted;
  int number = 2;
  while (taken(wanted + " " + std::to_string(number))) ++number;
  return wanted + " " + std::to_string(number);
}

std::int32_t addMaterial(PlantMesh& mesh, Material material) {
  material.name = materialName(mesh, material.name);
  mesh.materials.push_back(std::move(material));
  return static_cast<std::int32_t>(mesh.materials.size() - 1);
}

// ---- stems -----------------------------------------------------------------------------------------------------------

/// What every stem of the plant is measured against.
struct StemScale {
  double extent = 0;
  double thickest = 0;
};

double radiusOf(const Organ& organ, const StemScale& scale) {
  const double radius = organ.radius > 0 ? organ.radius : organ.length * radiusOfLength;
  return std::max(radius, scale.extent * thinnestOfExtent);
}

double ramp(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// How far a stem of `radius` has turned to bark: the thick ones of a plant whose thickest are stout.
double woodiness(double radius, const StemScale& scale) {
  return ramp(0.25, 0.9, radius / scale.thickest) * ramp(0.003, 0.011, scale.thickest / scale.extent);
}

/// Colour and material of each style of a tube.
struct StemLook {
  glm::vec3 colour{0.5f};
  double bark = 0;  ///< how far it may go over to bark
  std::int32_t material = 0;
};

std::vector<StemLook> stemLooksOf(const Plant& plant, PlantMesh& mesh) {
  std::vector<StemLook> looks(plant.styles.size());
  std::map<std::tuple<OrganKind, float, float, float>, std::int32_t> known;
  for (std::size_t i = 0; i < plant.styles.size(); ++i) {
    const OrganStyle& style = plant.styles[i];
    if (isModelled(style.kind)) continue;
    StemLook& look = looks[i];
    look.colour = style.colour ? naturalColour(*style.colour, style.kind) : defaultColour(style.kind);
    look.bark = style.kind == OrganKind::Root ? 0 : style.colour ? 0.6 : 1;
    const auto [at, isNew] = known.try_emplace({style.kind, look.colour.r, look.colour.g, look.colour.b}, 0);
    if (isNew) at->second = addMaterial(mesh, {.name = style.kind == OrganKind::Root ? "root" : "stem", .colour = look.colour, .roughness = 0.85f});
    look.material = at->second;
  }
  return looks;
}

/// For each axis whether something sits on its very tip.
std::vector<bool> loadedTips(const Plant& plant, const PlantAxes& axes) {
  std::vector<bool> loaded(axes.axes.size(), false);
  const auto mark = [&](const std::optional<Site>& site) {
    if (!site) return;
    const auto axis = static_cast<std::size_t>(site->axis.value);
    if (static_cast<std::size_t>(site->node) == axes.axes[axis].organs.size()) loaded[axis] = true;
  };
  for (const Axis& axis : axes.axes) mark(axis.insertion);
  for (const Organ& organ : plant.organs)
    if (isModelled(organ.kind) && organ.length > axes.negligible && organ.parent)
      mark(axes.siteOfTip[static_cast<std::size_t>(organ.parent->value)]);
  return loaded;
}

/// What every stem of the plant is drawn by.
class StemDrawer {
 public:
  StemDrawer(const Plant& plant, const PlantAxes& axes, std::vector<StemLook> looks, StemScale scale)
      : plant_(plant), looks_(std::move(looks)), scale_(scale), axes_(axes), loaded_(loadedTips(plant, axes)) {}

  /// Sets `path` to the one of an axis. Its memory is used again.
  void follow(std::size_t index, TubePath& path) const {
    const Axis& axis = axes_.axes[index];
    path.nodes.clear();
    path.segments.clear();
    path.collar = {};
    path.sharpestBend = plant_.at(axis.organs.front()).tipRadius ? sharpestTurtleBend : TubePath{}.sharpestBend;
    addNodes(path, index);
    addTrails(path, axis);
    if (axis.insertion) path.collar.parentRadius = radiusAt(static_cast<std::size_t>(axis.insertion->axis.value), static_cast<std::size_t>(axis.insertion->node));
  }

 private:
  [[nodiscard]] const StemLook& lookOf(const Organ& organ) const { return looks_[static_cast<std::size_t>(organ.style)]; }

  [[nodiscard]] glm::vec3 colourOf(const Organ& organ) const {
    const StemLook& look = lookOf(organ);
    return glm::mix(look.colour, bark_, static_cast<float>(look.bark * woodiness(radiusOf(organ, scale_), scale_)));
  }

  /// The ends of an axis' organs: between two of them a node has the mean of their radii and colours.
  void addNodes(TubePath& path, std::size_t index) const {
    const std::vector<OrganId>& organs = axes_.axes[index].organs;
    glm::vec3 before = colourOf(plant_.at(organs.front()));
    path.nodes.push_back({.at = plant_.at(organs.front()).base.at, .radius = radiusAt(index, 0), .colour = before});
    for (std::size_t k = 0; k < organs.size(); ++k) {
      const Organ& organ = plant_.at(organs[k]);
      const glm::vec3 after = k + 1 < organs.size() ? colourOf(plant_.at(organs[k + 1])) : before;
      path.nodes.push_back({.at = organ.tip().at, .radius = radiusAt(index, k + 1), .colour = (before + after) * 0.5f});
      path.segments.push_back({.organ = organs[k], .material = lookOf(organ).material});
      before = after;
    }
  }

  /// The radius at node `k`. A turtle says how wide each piece is at its tip; elsewhere the tip of a stem is a share of its last radius.
  [[nodiscard]] double radiusAt(std::size_t index, std::size_t k) const {
    const Axis& axis = axes_.axes[index];
    if (k == 0) return radiusOf(plant_.at(axis.organs.front()), scale_);
    const Organ& before = plant_.at(axis.organs[k - 1]);
    const double here = before.tipRadius ? std::max(*before.tipRadius, scale_.extent * thinnestOfExtent) : radiusOf(before, scale_);
    if (k < axis.organs.size()) return 0.5 * (here + radiusOf(plant_.at(axis.organs[k]), scale_));
    return before.tipRadius ? here : here * (loaded_[index] ? loadedTipTaper : freeTipTaper);
  }

  /// Puts the corners of bent organs between their nodes; radius and colour run on along the trail.
  void addTrails(TubePath& path, const Axis& axis) const {
    if (std::none_of(axis.organs.begin(), axis.organs.end(), [&](OrganId id) { return !plant_.at(id).trail.empty(); })) return;
    TubePath bent{.nodes = {path.nodes.front()}, .segments = {}, .collar = path.collar, .sharpestBend = path.sharpestBend};
    for (std::size_t k = 0; k < axis.organs.size(); ++k) {
      const Organ& organ = plant_.at(axis.organs[k]);
      const TubeNode &from = path.nodes[k], &to = path.nodes[k + 1];
      double along = 0;
      for (std::size_t i = 1; i + 1 < organ.trail.size(); ++i) {
        along += glm::distance(organ.trail[i - 1].at, organ.trail[i].at);
        const double share = along / organ.length, shortest = organ.length * shortestTrailPiece;
        if (glm::distance(bent.nodes.back().at, organ.trail[i].at) <= shortest || glm::distance(organ.trail[i].at, to.at) <= shortest) continue;
        bent.nodes.push_back({.at = organ.trail[i].at, .radius = glm::mix(from.radius, to.radius, share), .colour = glm::mix(from.colour, to.colour, static_cast<float>(share))});
        bent.segments.push_back(path.segments[k]);
      }
      bent.nodes.push_back(to);
      bent.segments.push_back(path.segments[k]);
    }
    path = std::move(bent);
  }

  const Plant& plant_;
  std::vector<StemLook> looks_;
  StemScale scale_;
  const PlantAxes& axes_;
  std::vector<bool> loaded_;
  glm::vec3 bark_ = barkColour();
};

StemScale stemScaleOf(const Plant& plant, const PlantAxes& axes) {
  StemScale scale{.extent = axes.extent, .thickest = 0};
  for (const Axis& axis : axes.axes)
    for (const OrganId id : axis.organs) scale.thickest = std::max(scale.thickest, radiusOf(plant.at(id), scale));
  return scale;
}

/// The tubes of all pieces as one mesh, each piece written by one thread.
StemMesh meshOf(const std::vector<TubeRings>& pieces) {
  std::vector<std::size_t> firstVertex{0}, firstTriangle{0};
  for (const TubeRings& piece : pieces) {
    firstVertex.push_back(firstVertex.back() + piece.vertexCount());
    firstTriangle.push_back(firstTriangle.back() + piece.triangleCount());
  }
  StemMesh mesh = roomFor(firstVertex.back(), firstTriangle.back());
  inParallel(pieces.size(), [&](std::size_t piece) { pieces[piece].sweepInto(mesh, firstVertex[piece], firstTriangle[piece]); });
  return mesh;
}

Result<void> addStems(PlantMesh& mesh, const Plant& plant, const PlantAxes& axes, Detail detail, std::size_t maximumTriangles) {
  const StemScale scale = stemScaleOf(plant, axes);
  const StemDrawer drawer(plant, axes, stemLooksOf(plant, mesh), scale);
  constexpr std::size_t axesAtOnce = 1024;
  std::vector<TubeRings> pieces(piecesFor(axes.axes.size(), axesAtOnce));
  std::atomic<std::size_t> triangles = 0;
  inParallel(pieces.size(), [&](std::size_t piece) {
    TubePath path;
    for (std::size_t i = piece * axesAtOnce; i < std::min((piece + 1) * axesAtOnce, axes.axes.size()) && triangles <= maximumTriangles; ++i) {
      const std::size_t before = pieces[piece].triangleCount();
      drawer.follow(i, path);
      pieces[piece].add(path, tubeDetailFor(detail, path.nodes.front().radius / scale.extent));
      triangles += pieces[piece].triangleCount() - before;
    }
  });
  if (triangles > maximumTriangles)
    return fail(ErrorCode::LimitReached, "the stems alone have more than " + std::to_string(maximumTriangles) +
                                             " triangles; grow fewer steps or ask for a lower level of detail");
  mesh.stems = meshOf(pieces);
  return {};
}

// ---- leaves, flowers, fruits -----------------------------------------------------------------------------------------

struct ModelSlot {
  std::size_t index = 0;       ///< into PlantMesh::models
  float naturalWidth = 1;      ///< across the main part, in lengths
};

bool isMainPart(const std::string& name) { return name == "blade" || name == "petal" || name == "flesh"; }

/// The colour of a part once its style has named a colour for the whole organ: the main part takes it, what belongs to a leaf
/// and a flower's tube move along with it, the inside of a flower stays as it is.
glm::vec3 partColour(const organs::Part& part, const std::vector<organs::Part>& parts, const OrganStyle& style) {
  if (!style.colour) return part.colour;
  const glm::vec3 named = naturalColour(*style.colour, style.kind);
  if (isMainPart(part.name) || parts.size() == 1) return named;
  if (style.kind != OrganKind::Leaf && part.name != "tube") return part.colour;
  const auto blade = std::find_if(parts.begin(), parts.end(), [](const organs::Part& p) { return isMainPart(p.name); });
  const glm::vec3 main = blade == parts.end() ? part.colour : blade->colour;
  return glm::min(part.colour * (named / glm::max(main, glm::vec3(0.01f))), glm::vec3(0.9f));
}

/// Across the main part: what a style's radius is half of.
float widthOf(const std::vector<organs::Part>& parts) {
  const auto main = std::find_if(parts.begin(), parts.end(), [](const organs::Part& part) { return isMainPart(part.name); });
  float low = 0, high = 0;
  for (const glm::vec3& p : (main == parts.end() ? parts.front() : *main).mesh.positions) {
    low = std::min(low, p.x);
    high = std::max(high, p.x);
  }
  return std::max(high - low, 1e-4f);
}

OrganModel makeModel(PlantMesh& mesh, const ModelMesh& source, const OrganStyle& style) {
  OrganModel model{.name = source.name, .parts = {}, .placements = {}};
  for (const organs::Part& part : source.parts) {
    const bool thin = part.name == "blade" || part.name == "petal" || part.name == "sepal" || part.name == "wing" || part.name == "calyx";
    Material material{.name = source.name + " " + part.name, .colour = partColour(part, source.parts, style),
                      .roughness = style.kind == OrganKind::Fruit ? 0.45f : 0.7f, .surface = thin ? Surface::Blade : Surface::Solid};
    model.parts.push_back({.material = addMaterial(mesh, std::move(material)), .mesh = part.mesh});
  }
  return model;
}

/// The models that the plant's styles ask for, one for all styles that look the same; an index a style.
class Models {
 public:
  Models(const Plant& plant, PlantMesh& mesh, Detail detail) : plant_(plant), mesh_(mesh), detail_(detail), slots_(plant.styles.size()) {}

  [[nodiscard]] const ModelSlot& slotOf(std::int32_t style) {
    auto& slot = slots_[static_cast<std::size_t>(style)];
    if (!slot) slot = makeSlot(plant_.styles[static_cast<std::size_t>(style)]);
    return *slot;
  }

 private:
  [[nodiscard]] ModelSlot makeSlot(const OrganStyle& style) {
    const glm::dvec4 colour = style.colour.value_or(glm::dvec4(-1));
    const auto key = std::tuple(style.kind, modelStem(style.model), colour.r, colour.g, colour.b);
    if (const auto at = known_.find(key); at != known_.end()) return at->second;
    const ModelMesh source = modelFor(style.kind, style.model, detail_);
    if (!source.note.empty() && noted_.insert(source.note).second) mesh_.notes.push_back(source.note);
    const ModelSlot slot{.index = mesh_.models.size(), .naturalWidth = widthOf(source.parts)};
    mesh_.models.push_back(makeModel(mesh_, source, style));
    return known_.emplace(key, slot).first->second;
  }

  const Plant& plant_;
  PlantMesh& mesh_;
  Detail detail_;
  std::vector<std::optional<ModelSlot>> slots_;
  std::map<std::tuple<OrganKind, std::string, double, double, double>, ModelSlot> known_;
  std::set<std::string> noted_;
};

/// A model's frame is the organ's: +Y along it, +Z its adaxial side. Its width follows the organ's radius where it has one.
Placement placementOf(const Organ& organ, OrganId id, const ModelSlot& slot) {
  const glm::dvec3 y = organ.direction.unit();
  const glm::dvec3 z = organ.adaxial.unit();
  const glm::dvec3 x = glm::cross(y, z);
  // A bud is a sixth as wide as what it opens to; what withers shrivels.
  const double spread = (1 + 5 * organ.opening) / 6 * (1 - 0.4 * organ.withered);
  const double across = (organ.radius > 0 ? 2 * organ.radius / slot.naturalWidth : organ.length) * spread;
  const double through = organ.kind == OrganKind::Leaf ? std::sqrt(across * organ.length) : across;
  return {.organ = id, .position = glm::vec3(organ.base.at), .rotation = glm::quat(glm::normalize(glm::quat_cast(glm::dmat3(x, y, z)))),
          .scale = glm::vec3(across, organ.length, through)};
}

void addModels(PlantMesh& mesh, const Plant& plant, Detail detail, double negligible) {
  Models models(plant, mesh, detail);
  for (std::size_t i = 0; i < plant.organs.size(); ++i) {
    const Organ& organ = plant.organs[i];
    if (!isModelled(organ.kind) || organ.length <= negligible) continue;
    const ModelSlot& slot = models.slotOf(organ.style);
    mesh.models[slot.index].placements.push_back(placementOf(organ, OrganId(static_cast<std::int32_t>(i)), slot));
  }
}

}  // namespace

Detail detailFor(std::size_t organCount) {
  return organCount <= 400 ? Detail::Close : organCount <= 15'000 ? Detail::Medium : Detail::Far;
}

Result<PlantMesh> meshOf(const Plant& plant, const MeshOptions& options) {
  if (const auto checked = checkOrgans(plant); !checked) return checked.failure();
  if (const auto checked = checkTurtleShapes(plant); !checked) return checked.failure();
  PlantMesh mesh;
  mesh.name = plant.name;
  if (!plant.organs.empty()) mesh.collar = plant.organs.front().base;
  const Detail detail = options.detail.value_or(detailFor(plant.organs.size()));
  const PlantAxes axes = axesOf(plant, Continuation::Straightest);
  if (const auto stems = addStems(mesh, plant, axes, detail, options.maximumTriangles); !stems) return stems.failure();
  addModels(mesh, plant, detail, axes.negligible);
  addTurtleShapes(mesh, plant, detail);
  if (mesh.triangleCount() <= options.maximumTriangles) return mesh;
  return fail(ErrorCode::LimitReached, "the plant has " + std::to_string(mesh.triangleCount()) + " triangles, more than the limit of " +
                                           std::to_string(options.maximumTriangles) + "; grow fewer steps or ask for a lower level of detail");
}

}  // namespace axil::render
