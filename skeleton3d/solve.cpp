#include "skeleton3d/solve.hpp"

#include "base/text.hpp"
#include "skeleton3d/camera.hpp"
#include "skeleton3d/linear_least_squares.hpp"
#include "skeleton3d/placed_clicks.hpp"
#include "skeleton3d/projection.hpp"
#include "skeleton3d/solve_all.hpp"

#include <ceres/tiny_solver.h>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace axil::skeleton3d {
namespace {

using detail::Trouble;

/// One click as the solver needs it.
struct Sighting {
  const View* view = nullptr;
  PhotoPoint click;
  glm::dvec2 undistorted{0, 0};
  Ray ray;
  double weight = 1;  ///< standard deviation of a person's click over this one's
};

std::string nodeName(NodeId id) { return "node " + std::to_string(id.value); }

std::vector<Sighting> allSightingsOf(std::span<const View> views, const ClickedNode& node, double click_px) {
  std::vector<Sighting> sightings;
  for (const auto& [name, click] : node.clicks) {
    const View* view = detail::findView(views, name);
    const glm::dvec2 straight = undistorted(view->camera, click);
    sightings.push_back({view, click, straight, rayOf(view->camera, straight), click_px / detail::scatterOf(node, name, click_px)});
  }
  return sightings;
}

/// The largest angle at which two of the rays cross, 0 to 90 degrees: opposite views fix a point as little as equal ones.
Angle widestAngle(const std::vector<Sighting>& sightings) {
  Angle widest;
  for (std::size_t i = 0; i < sightings.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Angle between = angleBetween(sightings[i].ray.direction, sightings[j].ray.direction);
      widest = std::max(widest, std::min(between, Angle::fromDegrees(180) - between));
    }
  return widest;
}

/// The clicks that place a node: those of a person, as far as they do; with what the program placed where they do not.
std::vector<Sighting> sightingsOf(std::span<const View> views, const ClickedNode& node, const SolveOptions& options) {
  if (node.placed.empty()) return allSightingsOf(views, node, options.click_px);
  std::vector<Sighting> own = allSightingsOf(views, detail::byHand(node), options.click_px);
  return widestAngle(own) >= options.minRayAngle ? own : allSightingsOf(views, node, options.click_px);
}

/// The two equations x_view = x of a click, in pixels at the depth of the plant's origin, so that near and far views weigh
/// about alike.
void addRows(const Sighting& s, std::vector<detail::LinearRow>& rows) {
  const Camera& camera = s.view->camera;
  const glm::dmat3 r = glm::transpose(camera.rotation);  // r[i]: row i of the rotation
  const bool flat = camera.model == CameraModel::Orthographic;
  const double depth = std::max(std::abs(camera.translation.z), 1e-6 * glm::length(camera.translation));
  for (int i = 0; i < 2; ++i) {
    const double weight = s.weight * (flat ? camera.scale_px_per_unit : depth > 0 ? (*camera.focal_px)[i] / depth : 1.0);
    const glm::dvec3 a = flat ? r[i] : r[i] - s.undistorted[i] * r[2];
    const double b = flat ? s.undistorted[i] - camera.translation[i] : s.undistorted[i] * camera.translation.z - camera.translation[i];
    rows.push_back({weight * a, weight * b});
  }
}

PlantPoint triangulated(const std::vector<Sighting>& sightings) {
  std::vector<detail::LinearRow> rows;
  rows.reserve(2 * sightings.size());
  for (const Sighting& s : sightings) addRows(s, rows);
  return {detail::solveThree(rows)};
}

/// d(pixel)/d(point of the plant), two rows.
std::array<glm::dvec3, 2> pixelJacobian(const Camera& camera, PlantPoint point) {
  const glm::dmat3 r = glm::transpose(camera.rotation);
  if (camera.model == CameraModel::Orthographic) return {camera.scale_px_per_unit * r[0], camera.scale_px_per_unit * r[1]};
  const glm::dvec3 v = toView(camera, point).at;
  const glm::dvec3 dx = (r[0] - (v.x / v.z) * r[2]) / v.z;
  const glm::dvec3 dy = (r[1] - (v.y / v.z) * r[2]) / v.z;
  const auto d = detail::distortJacobian(camera.distortion, v.x / v.z, v.y / v.z);
  return {camera.focal_px->x * (d[0] * dx + d[1] * dy), camera.focal_px->y * (d[2] * dx + d[3] * dy)};
}

/// The reprojection errors of one node as a function of its place, for Ceres' small solver.
class Reprojection {
 public:
  using Scalar = double;
  enum { NUM_RESIDUALS = Eigen::Dynamic, NUM_PARAMETERS = 3 };

  explicit Reprojection(const std::vector<Sighting>& sightings) : sightings_(sightings) {}
  [[nodiscard]] int NumResiduals() const { return static_cast<int>(2 * sightings_.size()); }

  bool operator()(const double* parameters, double* residuals, double* jacobian) const {
    const PlantPoint point{{parameters[0], parameters[1], parameters[2]}};
    const std::size_t rows = 2 * sightings_.size();
    for (std::size_t i = 0; i < sightings_.size(); ++i) {
      const Camera& camera = sightings_[i].view->camera;
      const glm::dvec2 off = project(camera, point).px - sightings_[i].click.px;
      for (std::size_t k = 0; k < 2; ++k) residuals[2 * i + k] = sightings_[i].weight * off[static_cast<int>(k)];
      if (jacobian == nullptr) continue;
      const auto j = pixelJacobian(camera, point);
      for (std::size_t k = 0; k < 2; ++k)
        for (std::size_t c = 0; c < 3; ++c) jacobian[c * rows + 2 * i + k] = sightings_[i].weight * j[k][static_cast<int>(c)];
    }
    return true;
  }

 private:
  const std::vector<Sighting>& sightings_;
};

PlantPoint refined(const std::vector<Sighting>& sightings, PlantPoint start) {
  const Reprojection errors(sightings);
  ceres::TinySolver<Reprojection> solver;
  solver.options.function_tolerance = 1e-16;  // squared pixels: stop at rounding, not at "nearly"
  solver.options.parameter_tolerance = 1e-12;
  solver.options.cost_threshold = 1e-24;
  Eigen::Vector3d x(start.at.x, start.at.y, start.at.z);
  solver.Solve(errors, &x);
  return {{x[0], x[1], x[2]}};
}

glm::dmat3 covarianceAt(const std::vector<Sighting>& sightings, PlantPoint point) {
  glm::dmat3 normal(0.0);
  for (const Sighting& s : sightings)
    for (const glm::dvec3& row : pixelJacobian(s.view->camera, point)) normal += s.weight * s.weight * glm::outerProduct(row, row);
  return glm::inverse(normal);
}

glm::dvec3 sigmaAt(const std::vector<Sighting>& sightings, PlantPoint point, double click_px) {
  const glm::dmat3 covariance = covarianceAt(sightings, point);
  return click_px * glm::dvec3{std::sqrt(covariance[0][0]), std::sqrt(covariance[1][1]), std::sqrt(covariance[2][2])};
}

std::string cameraBehind(const std::vector<Sighting>& sightings, PlantPoint point) {
  for (const Sighting& s : sightings)
    if (!isInFront(s.view->camera, point)) return s.view->name;
  return {};
}

double limitOf(const View& view, const SolveOptions& options) {
  if (options.maxReprojection_px) return *options.maxReprojection_px;
  const int longer = std::max(view.size_px.x, view.size_px.y);
  return longer > 0 ? 0.025 * longer : 40.0;
}

double distanceTo(const Ray& ray, PlantPoint point) { return glm::length(glm::cross(point.at - ray.origin.at, ray.direction.unit())); }

std::string listOf(const std::vector<Sighting>& sightings) {
  std::string names;
  for (std::size_t i = 0; i < sightings.size(); ++i)
    names += (i == 0 ? "" : i + 1 == sightings.size() ? " and " : ", ") + sightings[i].view->name;
  return names;
}

/// Where the rays miss each other, in words: "front 83.2 px, right 79.9 px; 0.124 m between the rays and the node".
std::string missOf(const std::vector<Sighting>& sightings, const Node& node, const std::string& unit) {
  std::string text;
  double furthest = 0;
  for (const Sighting& s : sightings) {
    text += (text.empty() ? "" : ", ") + s.view->name + " " + fixed(node.reprojection_px.at(s.view->name), 1) + " px";
    furthest = std::max(furthest, distanceTo(s.ray, node.position));
  }
  return text + " off, its rays up to " + fixed(furthest, 4) + " " + unit + " from it";
}

bool meets(const std::vector<Sighting>& sightings, const Node& node, const SolveOptions& options) {
  return std::all_of(sightings.begin(), sightings.end(),
                     [&](const Sighting& s) { return node.reprojection_px.at(s.view->name) <= limitOf(*s.view, options); });
}

Node nodeAt(const ClickedNode& clicked, const std::vector<Sighting>& sightings, PlantPoint point, const SolveOptions& options) {
  Node node{clicked.id, point, clicked.radius, sigmaAt(sightings, point, options.click_px), {}};
  for (const Sighting& s : sightings) node.reprojection_px[s.view->name] = glm::length(project(s.view->camera, point).px - s.click.px);
  return node;
}

struct Attempt {
  std::optional<Node> node = std::nullopt;
  std::vector<Trouble> troubles = {};
};

Attempt refused(NodeId id, const std::string& why) { return {std::nullopt, {{ErrorCode::NoAnswer, nodeName(id) + " " + why}}}; }

Attempt solveOne(std::span<const View> views, const ClickedNode& clicked, const SolveOptions& options, const std::string& unit) {
  if (auto troubles = detail::clickTroubles(views, clicked); !troubles.empty()) return {std::nullopt, std::move(troubles)};
  const std::vector<Sighting> sightings = sightingsOf(views, clicked, options);
  if (sightings.empty()) return refused(clicked.id, "is clicked in no view; click it in two");
  if (sightings.size() < 2) return refused(clicked.id, "is clicked in one view only (" + sightings.front().view->name + "); click it in another too");
  if (const Angle widest = widestAngle(sightings); !(widest >= options.minRayAngle))
    return refused(clicked.id, "is seen from too similar directions: the rays of " + listOf(sightings) + " cross at " + fixed(widest.degrees(), 2) +
                                   " degrees; click it in a view from another side");

  const PlantPoint start = triangulated(sightings);
  const PlantPoint point = cameraBehind(sightings, start).empty() ? refined(sightings, start) : start;
  if (const std::string behind = cameraBehind(sightings, point); !behind.empty())
    return refused(clicked.id, "would lie behind the camera of view " + behind + ": the rays of " + listOf(sightings) +
                                   " do not meet in front of it; check its clicks and that camera");
  Node node = nodeAt(clicked, sightings, point, options);
  if (!meets(sightings, node, options))
    return refused(clicked.id, "has clicks whose rays do not meet: " + missOf(sightings, node, unit) + "; check its clicks in " + listOf(sightings));
  return {std::move(node), {}};
}

Result<void> checkOptions(const SolveOptions& options) {
  if (!(std::isfinite(options.click_px) && options.click_px > 0))
    return fail(ErrorCode::BadInput, "the standard deviation of a click must be above zero pixels");
  if (options.maxReprojection_px && !(*options.maxReprojection_px > 0))
    return fail(ErrorCode::BadInput, "the largest reprojection error that is accepted must be above zero pixels");
  return {};
}

}  // namespace

namespace detail {

const View* findView(std::span<const View> views, const std::string& name) {
  const auto found = std::find_if(views.begin(), views.end(), [&](const View& view) { return view.name == name; });
  return found == views.end() ? nullptr : &*found;
}

Result<void> checkViews(std::span<const View> views, UnknownCameras unknown) {
  std::set<std::string> names;
  for (const View& view : views) {
    if (!names.insert(view.name).second) return fail(ErrorCode::BadInput, "two views are called '" + view.name + "'; give each its own name");
    if (const auto camera = checkCamera(view.camera, view.name, view.size_px); !camera) return camera;
    if (view.camera.model == CameraModel::Unknown && unknown == UnknownCameras::Refused)
      return fail(ErrorCode::NoAnswer, "the camera of view '" + view.name + "' is unknown; estimate it before the nodes are solved");
  }
  return {};
}

std::vector<Trouble> clickTroubles(std::span<const View> views, const ClickedNode& node) {
  std::vector<Trouble> troubles;
  const auto wrong = [&](const std::string& why) { troubles.push_back({ErrorCode::BadInput, nodeName(node.id) + " " + why}); };
  if (!node.id.valid()) wrong("has a negative id; ids start at 0");
  if (node.radius && !(std::isfinite(*node.radius) && *node.radius >= 0)) wrong("has a radius that is not a length of 0 or more");
  for (const auto& [name, click] : node.clicks) {
    const View* view = findView(views, name);
    const glm::dvec2 px = click.px;
    if (view == nullptr)
      wrong("has a click in view '" + name + "', which does not exist");
    else if (!std::isfinite(px.x) || !std::isfinite(px.y))
      wrong("has a click in view " + name + " that is not a number");
    else if (view->size_px.x > 0 && !(px.x >= 0 && px.y >= 0 && px.x <= view->size_px.x && px.y <= view->size_px.y))
      wrong("is clicked outside the photo of view " + name + ": (" + fixed(px.x, 1) + ", " + fixed(px.y, 1) + ") in " + std::to_string(view->size_px.x) + " x " +
            std::to_string(view->size_px.y) + " px");
  }
  return troubles;
}

glm::dmat3 covarianceOfPlace(std::span<const View> views, const ClickedNode& node, PlantPoint point, double click_px) {
  return click_px * click_px * covarianceAt(sightingsOf(views, node, {.click_px = click_px}), point);
}

Failure failWith(const std::vector<Trouble>& troubles, const std::string& what) {
  AXIL_ASSERT(!troubles.empty(), "no trouble to fail with");
  const bool wrongInput = std::any_of(troubles.begin(), troubles.end(), [](const Trouble& t) { return t.code == ErrorCode::BadInput; });
  Error error{wrongInput ? ErrorCode::BadInput : troubles.front().code, what + ": " + troubles.front().text};
  if (troubles.size() == 1) return fail(std::move(error));
  error.message += " (and " + std::to_string(troubles.size() - 1) + " more)";
  for (const Trouble& trouble : troubles) error.details.push_back(trouble.text);
  return fail(std::move(error));
}

Result<Solved> solveAll(std::span<const View> views, std::span<const ClickedNode> nodes, const SolveOptions& options, const std::string& unit) {
  if (const auto good = checkOptions(options); !good) return good.failure();
  if (const auto good = checkViews(views, UnknownCameras::Refused); !good) return good.failure();
  Solved solved;
  std::set<NodeId> seen;
  for (const ClickedNode& clicked : nodes) {
    Attempt attempt = solveOne(views, clicked, options, unit);
    solved.nodes.push_back(std::move(attempt.node));
    solved.troubles.insert(solved.troubles.end(), attempt.troubles.begin(), attempt.troubles.end());
    if (!seen.insert(clicked.id).second) solved.troubles.push_back({ErrorCode::BadInput, nodeName(clicked.id) + " is listed twice; give every node its own id"});
  }
  return solved;
}

}  // namespace detail

Result<std::vector<Node>> solveNodes(std::span<const View> views, std::span<const ClickedNode> nodes, const SolveOptions& options) {
  auto solved = detail::solveAll(views, nodes, options, "plant units");
  if (!solved) return solved.failure();
  if (!solved->troubles.empty()) return detail::failWith(solved->troubles, "not every node can be placed");
  std::vector<Node> placed;
  placed.reserve(solved->nodes.size());
  for (std::optional<Node>& node : solved->nodes) placed.push_back(std::move(*node));
  return placed;
}

}  // namespace axil::skeleton3d
