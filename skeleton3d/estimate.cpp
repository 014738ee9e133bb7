#include "skeleton3d/estimate.hpp"

#include "base/text.hpp"
#include "skeleton3d/camera.hpp"
#include "skeleton3d/linear_least_squares.hpp"
#include "skeleton3d/projection.hpp"
#include "skeleton3d/solve.hpp"
#include "skeleton3d/solve_all.hpp"

#include <ceres/ceres.h>
#include <ceres/rotation.h>
#include <glm/mat3x2.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numeric>

namespace axil::skeleton3d {
namespace {

constexpr std::size_t kFewestSharedNodes = 4;
constexpr double kMostTurned_deg = 45;
constexpr double kMostTypicalMiss = 0.01;  // of the photo's longer side
constexpr double kFlatFocalInverse = 1e-3;  // of the first guess: beyond a thousand times its distance a camera counts as orthographic

/// What is adjusted of an unknown camera: u = c + (s x + a) / (1 + k z), where (x, y, z) is the node turned into the view
/// about the plant's origin, a the origin's pixel from the picture's centre, s pixels per unit at the origin, and
/// k = s / focal. It stays smooth down to k = 0, the orthographic camera, where focal and distance run off to infinity.
enum Parameter : std::size_t { kTurnX, kTurnY, kTurnZ, kOriginX, kOriginY, kLogScale, kFocalInverse, kParameters };

struct Unknown {
  bool known = false;                         ///< the camera is given and stays; the rest is for the first guess only
  View view;
  UnknownCameraHints hints;
  glm::dmat3 nominal{1.0};
  double focal_px = 0;                        ///< first guess
  double focalShare = 0;                      ///< how far to trust its inverse
  double aspect = 1;                          ///< fy / fx
  std::array<double, kParameters> values{};   ///< kFocalInverse is first guess / focal
};

struct Click {
  std::size_t view;
  glm::dvec2 px;
};

struct Point {
  NodeId id;
  std::vector<Click> clicks;
  std::array<double, 3> at{0, 0, 0};
};

struct Bundle {
  std::vector<Unknown> cameras;  ///< by name
  std::vector<Point> points;     ///< by id; those clicked in two views or more
  std::size_t reference = 0;     ///< the camera whose scale is held until the known length is looked at; none if one is known
  bool scaleIsKnown = false;
};

Failure viewFault(ErrorCode code, const std::string& name, const std::string& what) { return fail(code, "the camera of view '" + name + "' cannot be estimated: " + what); }

// ---- gathering --------------------------------------------------------------------------------------------------------

Result<void> checkHints(const Unknown& camera) {
  const auto& name = camera.view.name;
  const auto finite = [](glm::dvec2 p) { return std::isfinite(p.x) && std::isfinite(p.y); };
  if (camera.hints.origin_px && !finite(camera.hints.origin_px->px)) return viewFault(ErrorCode::BadInput, name, "its origin_px is not a number");
  if (!camera.hints.scale) return {};
  const KnownLength& scale = *camera.hints.scale;
  if (!finite(scale.from.px) || !finite(scale.to.px)) return viewFault(ErrorCode::BadInput, name, "an end of its known length is not a number");
  if (!(std::isfinite(scale.length) && scale.length > 0)) return viewFault(ErrorCode::BadInput, name, "its known length is not above zero");
  return {};
}

void guessFocal(Unknown& camera, const EstimateOptions& options) {
  const auto& given = camera.view.camera.focal_px;
  if (given) {
    camera.focal_px = given->x;
    camera.focalShare = options.givenFocalShare;
    camera.aspect = given->y / given->x;
  } else if (camera.hints.exif_focal_px && *camera.hints.exif_focal_px > 0) {
    camera.focal_px = *camera.hints.exif_focal_px;
    camera.focalShare = options.exifFocalShare;
  } else {
    camera.focal_px = options.defaultFocalShareOfDiagonal * glm::length(glm::dvec2(camera.view.size_px));
    camera.focalShare = 1;
  }
}

Result<Unknown> unknownFrom(const View& view, const UnknownCameraHints& hints, const EstimateOptions& options) {
  Unknown camera{view.camera.model != CameraModel::Unknown, view, hints};
  if (const auto good = checkHints(camera); !good) return good.failure();
  if (camera.known) return camera;
  const auto nominal = nominalRotation(view.name);
  if (!nominal) return viewFault(ErrorCode::BadInput, view.name, "its name does not say where it looks; call it front, right, top, back or left");
  if (view.size_px.x <= 0 || view.size_px.y <= 0) return viewFault(ErrorCode::BadInput, view.name, "the size of its photo is unknown; give the photo or size_px");
  camera.nominal = *nominal;
  camera.view.camera.centre_px = glm::dvec2(view.size_px) / 2.0;
  guessFocal(camera, options);
  return camera;
}

std::vector<Point> pointsOf(const std::vector<Unknown>& cameras, std::span<const ClickedNode> nodes) {
  std::vector<Point> points;
  for (const ClickedNode& node : nodes) {
    Point point{node.id, {}};
    for (std::size_t v = 0; v < cameras.size(); ++v)
      if (const auto click = node.clicks.find(cameras[v].view.name); click != node.clicks.end()) point.clicks.push_back({v, click->second.px});
    if (point.clicks.size() >= 2) points.push_back(std::move(point));
  }
  std::stable_sort(points.begin(), points.end(), [](const Point& a, const Point& b) { return a.id < b.id; });
  return points;
}

Result<void> checkEnough(const Bundle& bundle) {
  for (std::size_t v = 0; v < bundle.cameras.size(); ++v) {
    if (bundle.cameras[v].known) continue;
    const auto shared = static_cast<std::size_t>(std::count_if(bundle.points.begin(), bundle.points.end(), [&](const Point& p) {
      return std::any_of(p.clicks.begin(), p.clicks.end(), [&](const Click& c) { return c.view == v; });
    }));
    if (shared < kFewestSharedNodes)
      return viewFault(ErrorCode::NoAnswer, bundle.cameras[v].view.name, "it shares " + std::to_string(shared) + " clicked nodes with other views; click at least " +
                                                                             std::to_string(kFewestSharedNodes));
  }
  const auto any = [&](auto has) { return std::any_of(bundle.cameras.begin(), bundle.cameras.end(), has); };
  if (!any([](const Unknown& c) { return c.known || c.hints.origin_px.has_value(); }))
    return fail(ErrorCode::NoAnswer, "the cameras cannot be estimated: the plant's origin is clicked in no view; click its collar in at least one");
  if (!any([](const Unknown& c) { return c.known || c.hints.scale.has_value(); }))
    return fail(ErrorCode::NoAnswer, "the cameras cannot be estimated: no length is known; click the two ends of something you measured in at least one view");
  return {};
}

Result<Bundle> gathered(std::span<const View> views, const std::map<std::string, UnknownCameraHints>& hints, std::span<const ClickedNode> nodes,
                        const EstimateOptions& options) {
  Bundle bundle;
  for (const View& view : views) {
    const auto hint = hints.find(view.name);
    auto camera = unknownFrom(view, hint == hints.end() ? UnknownCameraHints{} : hint->second, options);
    if (!camera) return camera.failure();
    bundle.scaleIsKnown = bundle.scaleIsKnown || camera->known;
    bundle.cameras.push_back(std::move(*camera));
  }
  std::sort(bundle.cameras.begin(), bundle.cameras.end(), [](const Unknown& a, const Unknown& b) { return a.view.name < b.view.name; });
  bundle.points = pointsOf(bundle.cameras, nodes);
  if (const auto enough = checkEnough(bundle); !enough) return enough.failure();
  return bundle;
}

// ---- first guess: everything seen from far away -----------------------------------------------------------------------

/// A camera as seen from far away: click - centre = (P X + b) / q, P the first two rows of its rotation.
struct FarCamera {
  glm::dmat3 rotation{1.0};
  glm::dvec2 centre{0, 0};
  std::optional<double> fixed;  ///< q, where it is not asked for
  std::size_t scaleColumn = 0;  ///< of q among the unknowns
  bool hasOrigin = false;
  glm::dvec2 origin{0, 0};        ///< b = q * origin, where the origin is clicked
  std::size_t originColumn = 0;   ///< of b, where it is not
};

double pixelsOf(const KnownLength& scale) { return glm::length(scale.to.px - scale.from.px); }

FarCamera farCameraOf(const Unknown& unknown) {
  FarCamera far;
  const Camera& camera = unknown.view.camera;
  far.centre = camera.centre_px;
  far.rotation = unknown.known ? camera.rotation : unknown.nominal;
  far.hasOrigin = unknown.known || unknown.hints.origin_px;
  if (!unknown.known) {
    if (far.hasOrigin) far.origin = unknown.hints.origin_px->px - far.centre;
    return far;
  }
  const double depth = std::max(std::abs(camera.translation.z), 1e-9);
  const double scale = camera.model == CameraModel::Orthographic ? camera.scale_px_per_unit : camera.focal_px->x / depth;
  far.fixed = 1 / scale;
  far.origin = scale * glm::dvec2{camera.translation.x, camera.translation.y};
  return far;
}

/// Any scale would do until the end; one near the truth keeps the numbers of ordinary size.
double guessedUnitsPerPixel(const Unknown& camera) {
  const auto& scale = camera.hints.scale;
  return scale && pixelsOf(*scale) > 10 ? scale->length / pixelsOf(*scale) : 1.0 / std::max(camera.view.size_px.x, camera.view.size_px.y);
}

struct FarProblem {
  std::vector<FarCamera> cameras;
  std::size_t unknowns = 0;
};

FarProblem farProblemOf(Bundle& bundle) {
  FarProblem far;
  for (const Unknown& camera : bundle.cameras) far.cameras.push_back(farCameraOf(camera));
  if (!bundle.scaleIsKnown) {
    const auto withScale = std::find_if(bundle.cameras.begin(), bundle.cameras.end(), [](const Unknown& c) { return c.hints.scale && pixelsOf(*c.hints.scale) > 10; });
    bundle.reference = withScale == bundle.cameras.end() ? 0 : static_cast<std::size_t>(withScale - bundle.cameras.begin());
    far.cameras[bundle.reference].fixed = guessedUnitsPerPixel(bundle.cameras[bundle.reference]);
  }
  for (FarCamera& camera : far.cameras) {
    if (!camera.fixed) camera.scaleColumn = far.unknowns++;
    if (camera.hasOrigin) continue;
    camera.originColumn = far.unknowns;
    far.unknowns += 2;
  }
  return far;
}

/// The right-hand side q (click - centre) - b of one coordinate of a click as coefficients of the unknowns and a constant.
struct FarRow {
  std::vector<double> coefficients;
  double constant = 0;
};

FarRow farRowOf(const FarProblem& far, const FarCamera& camera, glm::dvec2 px, int k) {
  FarRow row{std::vector<double>(far.unknowns, 0.0), 0};
  const double offset = px[k] - camera.centre[k] - (camera.hasOrigin ? camera.origin[k] : 0.0);
  if (camera.fixed)
    row.constant = *camera.fixed * offset;
  else
    row.coefficients[camera.scaleColumn] = offset;
  if (!camera.hasOrigin) row.coefficients[camera.originColumn + static_cast<std::size_t>(k)] = -1;
  return row;
}

/// The point of least squared distance from P X = rhs over its clicks, as a linear map of the right-hand sides.
struct Elimination {
  std::vector<glm::dvec3> rows;  ///< of P
  glm::dmat3 inverse{1.0};       ///< of P^T P, kept from being singular where all views look alike
};

Elimination eliminationOf(const FarProblem& far, const Point& point) {
  Elimination e;
  glm::dmat3 normal(1e-9);
  for (const Click& click : point.clicks) {
    const glm::dmat3 r = glm::transpose(far.cameras[click.view].rotation);
    for (int k = 0; k < 2; ++k) {
      e.rows.push_back(r[k]);
      normal += glm::outerProduct(r[k], r[k]);
    }
  }
  e.inverse = glm::inverse(normal);
  return e;
}

void addPoint(const FarProblem& far, const Point& point, std::vector<double>& a, std::vector<double>& b) {
  const Elimination e = eliminationOf(far, point);
  std::vector<FarRow> rows;
  for (const Click& click : point.clicks)
    for (int k = 0; k < 2; ++k) rows.push_back(farRowOf(far, far.cameras[click.view], click.px, k));
  for (std::size_t i = 0; i < rows.size(); ++i) {  // what of row i no place of the point can take up
    FarRow left = rows[i];
    for (std::size_t j = 0; j < rows.size(); ++j) {
      const double share = glm::dot(e.rows[i], e.inverse * e.rows[j]);
      for (std::size_t c = 0; c < far.unknowns; ++c) left.coefficients[c] -= share * rows[j].coefficients[c];
      left.constant -= share * rows[j].constant;
    }
    a.insert(a.end(), left.coefficients.begin(), left.coefficients.end());
    b.push_back(-left.constant);
  }
}

/// Where a view's origin is not clicked and nothing else places it: faintly, the middle of its clicks.
void addFaintMiddles(const FarProblem& far, const Bundle& bundle, std::vector<double>& a, std::vector<double>& b) {
  for (std::size_t v = 0; v < far.cameras.size(); ++v) {
    if (far.cameras[v].hasOrigin) continue;
    glm::dvec2 sum{0, 0};
    double count = 0;
    for (const Point& point : bundle.points)
      for (const Click& click : point.clicks)
        if (click.view == v) sum += click.px, ++count;
    for (int k = 0; k < 2; ++k) {
      FarRow row = farRowOf(far, far.cameras[v], sum / std::max(count, 1.0), k);
      for (double& c : row.coefficients) c *= 1e-3;
      a.insert(a.end(), row.coefficients.begin(), row.coefficients.end());
      b.push_back(-1e-3 * row.constant);
    }
  }
}

std::vector<double> solvedFar(const FarProblem& far, const Bundle& bundle) {
  if (far.unknowns == 0) return {};
  std::vector<double> a, b;
  for (const Point& point : bundle.points) addPoint(far, point, a, b);
  addFaintMiddles(far, bundle, a, b);
  return detail::solveLeastSquares(a, b);
}

void placePoint(const FarProblem& far, const std::vector<double>& solution, Point& point) {
  const Elimination e = eliminationOf(far, point);
  glm::dvec3 sum{0, 0, 0};
  for (std::size_t i = 0; i < e.rows.size(); ++i) {
    const Click& click = point.clicks[i / 2];
    const FarRow row = farRowOf(far, far.cameras[click.view], click.px, static_cast<int>(i % 2));
    sum += e.rows[i] * std::inner_product(solution.begin(), solution.end(), row.coefficients.begin(), row.constant);
  }
  const glm::dvec3 at = e.inverse * sum;
  point.at = {at.x, at.y, at.z};
}

Failure doNotFit(const std::string& why) {
  return fail(ErrorCode::NoAnswer, "the views do not fit together" + why + "; check that front, right and top are not exchanged, no photo is mirrored, and the same points are clicked in each");
}

/// A focal length so short that the plant would reach into the camera is no place to start from.
void keepInFront(Unknown& camera, const std::vector<Point>& points) {
  double nearest = 0;  // along the view, from the origin towards the camera
  for (const Point& point : points) nearest = std::max(nearest, -(camera.nominal * glm::dvec3{point.at[0], point.at[1], point.at[2]}).z);
  const double reach = nearest * std::exp(camera.values[kLogScale]) / camera.focal_px;  // share of the camera's distance
  if (reach > 0.5) camera.values[kFocalInverse] = 0.5 / reach;
}

Result<void> guess(Bundle& bundle) {
  const FarProblem far = farProblemOf(bundle);
  const std::vector<double> solution = solvedFar(far, bundle);
  for (std::size_t v = 0; v < far.cameras.size(); ++v) {
    const FarCamera& camera = far.cameras[v];
    Unknown& unknown = bundle.cameras[v];
    if (unknown.known) continue;
    const double q = camera.fixed ? *camera.fixed : solution[camera.scaleColumn];
    if (!(std::isfinite(q) && q > 0)) return doNotFit(": view '" + unknown.view.name + "' shows the plant the wrong way round");
    const glm::dvec2 origin = camera.hasOrigin ? camera.origin : glm::dvec2{solution[camera.originColumn], solution[camera.originColumn + 1]} / q;
    unknown.values = {0, 0, 0, origin.x, origin.y, -std::log(q), 1};
  }
  for (Point& point : bundle.points) placePoint(far, solution, point);
  for (Unknown& camera : bundle.cameras)
    if (!camera.known) keepInFront(camera, bundle.points);
  return {};
}

// ---- bundle adjustment ------------------------------------------------------------------------------------------------

glm::dmat3 crossMatrix(const glm::dvec3& v) { return {{0, v.z, -v.y}, {-v.z, 0, v.x}, {v.y, -v.x, 0}}; }

/// A turn written as an axis times an angle, as a matrix and with how the matrix moves with it: d(R y) = -[R y] x (left dw).
struct Turn {
  glm::dmat3 rotation{1.0};
  glm::dmat3 left{1.0};
};

Turn turnOf(const glm::dvec3& w) {
  const double angle2 = glm::dot(w, w), angle = std::sqrt(angle2);
  const bool tiny = angle < 1e-4;  // series, before the differences lose their digits
  const double sine = tiny ? 1 - angle2 / 6 : std::sin(angle) / angle;
  const double cosine = tiny ? 0.5 - angle2 / 24 : (1 - std::cos(angle)) / angle2;
  const double rest = tiny ? 1.0 / 6 - angle2 / 120 : (angle - std::sin(angle)) / (angle2 * angle);
  const glm::dmat3 k = crossMatrix(w), kk = k * k;
  return {glm::dmat3(1.0) + sine * k + cosine * kk, glm::dmat3(1.0) + cosine * k + rest * kk};
}

/// Reprojection error of a click in an unknown camera; both are adjusted. The derivatives are written out, since this is
/// where an adjustment spends its time.
class UnknownError : public ceres::SizedCostFunction<2, kParameters, 3> {
 public:
  UnknownError(const Unknown& camera, glm::dvec2 click, double click_px) : camera_(camera), click_(click), click_px_(click_px) {}

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const double* values = parameters[0];
    const Turn turn = turnOf({values[kTurnX], values[kTurnY], values[kTurnZ]});
    const glm::dmat3 rotation = turn.rotation * camera_.nominal;
    const glm::dvec3 turned = rotation * glm::dvec3{parameters[1][0], parameters[1][1], parameters[1][2]};
    const double scale = std::exp(values[kLogScale]), inverse = values[kFocalInverse] / camera_.focal_px;
    const double near = 1 + scale * inverse * turned.z;
    if (near < 1e-3) return false;  // at or behind the camera: a step to refuse
    const glm::dvec2 straight = (scale * glm::dvec2{turned.x, turned.y} + glm::dvec2{values[kOriginX], values[kOriginY]}) / near;
    const Bent bent = bend(straight, inverse);
    const glm::dvec2 weight = glm::dvec2{1, camera_.aspect} / click_px_;
    const glm::dvec2 residual = weight * (bent.at - (click_ - camera_.view.camera.centre_px) / glm::dvec2{1, camera_.aspect});
    residuals[0] = residual.x;
    residuals[1] = residual.y;
    if (jacobians == nullptr) return true;

    // Columns: how `straight` moves with the turned node; then everything goes through the lens and the weight.
    const double k = scale * inverse;
    const glm::dmat3x2 byTurned = glm::dmat3x2{{scale, 0}, {0, scale}, -k * straight} / near;
    const auto through = [&](const glm::dvec2& column) { return weight * (bent.derivative * column); };
    if (jacobians[0] != nullptr) {
      const glm::dmat3x2 byTurn = byTurned * (-crossMatrix(turned) * turn.left);
      const glm::dvec2 byScale = (scale * glm::dvec2{turned.x, turned.y} - k * turned.z * straight) / near;
      const glm::dvec2 byInverse = -(scale * turned.z / camera_.focal_px) * straight / near;
      const glm::dvec2 columns[kParameters] = {through(byTurn[0]), through(byTurn[1]), through(byTurn[2]), through({1 / near, 0}), through({0, 1 / near}), through(byScale),
                                               through(byInverse) + weight * bent.byInverse / camera_.focal_px};
      for (std::size_t c = 0; c < kParameters; ++c) setColumn(jacobians[0], kParameters, c, columns[c]);
    }
    if (jacobians[1] != nullptr) {
      const glm::dmat3x2 byPoint = byTurned * rotation;
      for (std::size_t c = 0; c < 3; ++c) setColumn(jacobians[1], 3, c, through(byPoint[static_cast<int>(c)]));
    }
    return true;
  }

 private:
  /// The lens distortion of pixels that the focal length makes of tangents: distort(p * inverse) / inverse.
  struct Bent {
    glm::dvec2 at{0, 0};
    glm::dmat2 derivative{1.0};
    glm::dvec2 byInverse{0, 0};
  };

  [[nodiscard]] Bent bend(glm::dvec2 p, double inverse) const {
    if (inverse < 1e-12) return {p};
    const auto& d = camera_.view.camera.distortion;
    const auto at = detail::distort(d, p.x * inverse, p.y * inverse);
    const auto j = detail::distortJacobian(d, p.x * inverse, p.y * inverse);
    Bent bent{glm::dvec2{at[0], at[1]} / inverse, {{j[0], j[2]}, {j[1], j[3]}}, {0, 0}};
    bent.byInverse = (bent.derivative * p - bent.at) / inverse;
    return bent;
  }

  static void setColumn(double* rowMajor, std::size_t columns, std::size_t c, const glm::dvec2& value) {
    rowMajor[c] = value.x;
    rowMajor[columns + c] = value.y;
  }

  const Unknown& camera_;
  glm::dvec2 click_;
  double click_px_;
};

/// Reprojection error of a click in a known camera; only the node moves.
struct KnownError {
  const Camera* camera;
  glm::dvec2 click;
  double click_px;

  template <class T>
  bool operator()(const T* point, T* residual) const {
    T v[3];
    for (int row = 0; row < 3; ++row)
      v[row] = camera->rotation[0][row] * point[0] + camera->rotation[1][row] * point[1] + camera->rotation[2][row] * point[2] + camera->translation[row];
    std::array<T, 2> p{v[0], v[1]};
    glm::dvec2 scale{camera->scale_px_per_unit, camera->scale_px_per_unit};
    if (camera->model == CameraModel::Perspective) {
      if (v[2] < 1e-9) return false;
      p = detail::distort(camera->distortion, T(v[0] / v[2]), T(v[1] / v[2]));
      scale = *camera->focal_px;
    }
    residual[0] = (scale.x * p[0] + camera->centre_px.x - click.x) / click_px;
    residual[1] = (scale.y * p[1] + camera->centre_px.y - click.y) / click_px;
    return true;
  }
};

/// What is believed of a camera before its clicks: its turn, its focal length, and where the origin was clicked.
struct Prior {
  double tilt_rad;
  double focalShare;
  glm::dvec2 origin;
  double origin_px;  ///< standard deviation

  template <class T>
  bool operator()(const T* values, T* residual) const {
    for (std::size_t i = kTurnX; i <= kTurnZ; ++i) residual[i] = values[i] / tilt_rad;
    residual[3] = (values[kFocalInverse] - 1.0) / focalShare;
    residual[4] = (values[kOriginX] - origin.x) / origin_px;
    residual[5] = (values[kOriginY] - origin.y) / origin_px;
    return true;
  }
};

Prior priorOf(const Unknown& camera, const EstimateOptions& options) {
  const auto& size = camera.view.size_px;
  const bool clicked = camera.hints.origin_px.has_value();
  return {options.tilt.radians(), camera.focalShare, glm::dvec2{camera.values[kOriginX], camera.values[kOriginY]}, clicked ? options.click_px : 0.25 * std::max(size.x, size.y)};
}

ceres::CostFunction* errorOf(const Unknown& camera, const Click& click, const EstimateOptions& options) {
  if (camera.known) return new ceres::AutoDiffCostFunction<KnownError, 2, 3>(new KnownError{&camera.view.camera, click.px, options.click_px});
  return new UnknownError(camera, click.px, options.click_px);
}

void addCameras(Bundle& bundle, const std::vector<Prior>& priors, ceres::Problem& problem) {
  for (std::size_t v = 0; v < bundle.cameras.size(); ++v) {
    Unknown& camera = bundle.cameras[v];
    if (camera.known) continue;
    double* values = camera.values.data();
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<Prior, 6, kParameters>(new Prior(priors[v])), nullptr, values);
    problem.SetParameterLowerBound(values, kFocalInverse, 0);
    if (!bundle.scaleIsKnown && v == bundle.reference) problem.SetManifold(values, new ceres::SubsetManifold(kParameters, {static_cast<int>(kLogScale)}));
  }
}

/// One round of adjustment; `loss` is where a residual (in standard deviations of a click) begins to count less.
bool adjust(Bundle& bundle, const std::vector<Prior>& priors, double loss, const EstimateOptions& options) {
  ceres::Problem problem;
  addCameras(bundle, priors, problem);
  auto ordering = std::make_shared<ceres::ParameterBlockOrdering>();
  for (Point& point : bundle.points) {
    for (const Click& click : point.clicks) {
      Unknown& camera = bundle.cameras[click.view];
      auto* robust = new ceres::CauchyLoss(loss);
      if (camera.known)
        problem.AddResidualBlock(errorOf(camera, click, options), robust, point.at.data());
      else
        problem.AddResidualBlock(errorOf(camera, click, options), robust, camera.values.data(), point.at.data());
    }
    ordering->AddElementToGroup(point.at.data(), 0);
  }
  for (Unknown& camera : bundle.cameras)
    if (!camera.known) ordering->AddElementToGroup(camera.values.data(), 1);

  ceres::Solver::Options solve;
  solve.linear_solver_type = ceres::DENSE_SCHUR;
  solve.linear_solver_ordering = ordering;
  solve.num_threads = 1;  // the same sums in the same order, so the same bits
  solve.max_num_iterations = 200;
  solve.function_tolerance = 1e-7;  // of a sum of squares in standard deviations: far below what the clicks can tell
  // The plant as a whole turns with only the priors to hold it: damping like the clicks' own stiffness would let it creep.
  solve.initial_trust_region_radius = 1e9;
  solve.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(solve, &problem, &summary);
  return summary.IsSolutionUsable();
}

// ---- what came out ----------------------------------------------------------------------------------------------------

Camera cameraOf(const Unknown& unknown) {
  if (unknown.known) return unknown.view.camera;
  const auto& v = unknown.values;
  Camera camera = unknown.view.camera;
  const double scale = std::exp(v[kLogScale]);
  double columns[9];
  ceres::AngleAxisToRotationMatrix(v.data(), columns);  // column by column, as GLM
  glm::dmat3 turn;
  for (int c = 0; c < 3; ++c) turn[c] = {columns[3 * c], columns[3 * c + 1], columns[3 * c + 2]};
  camera.rotation = turn * unknown.nominal;
  camera.translation = {v[kOriginX] / scale, v[kOriginY] / scale, 0};
  if (v[kFocalInverse] < kFlatFocalInverse) {
    camera.model = CameraModel::Orthographic;
    camera.focal_px.reset();
    camera.distortion = {0, 0, 0, 0, 0};
    camera.scale_px_per_unit = scale;
    return camera;
  }
  const double focal_px = unknown.focal_px / v[kFocalInverse];
  camera.model = CameraModel::Perspective;
  camera.focal_px = glm::dvec2{focal_px, unknown.aspect * focal_px};
  camera.translation.z = focal_px / scale;
  return camera;
}

std::vector<View> viewsOf(const Bundle& bundle) {
  std::vector<View> views;
  for (const Unknown& camera : bundle.cameras) views.push_back({camera.view.name, cameraOf(camera), camera.view.size_px});
  return views;
}

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

struct Miss {
  NodeId node;
  std::size_t view;
  double off_px;
};

std::vector<Miss> missesOf(const Bundle& bundle, const std::vector<View>& views) {
  std::vector<Miss> misses;
  for (const Point& point : bundle.points)
    for (const Click& click : point.clicks) {
      const PlantPoint at{{point.at[0], point.at[1], point.at[2]}};
      misses.push_back({point.id, click.view, glm::length(project(views[click.view].camera, at).px - click.px)});
    }
  return misses;
}

double typical(const std::vector<Miss>& misses) {
  std::vector<double> off;
  for (const Miss& miss : misses) off.push_back(miss.off_px);
  return median(std::move(off));
}

/// Further off than clicks that scatter about as these do ever are: five standard deviations, of which the median of a
/// distance in the plane is 1.18, some of it lost to the fit.
double suspicionLimit(const std::vector<Miss>& misses, const EstimateOptions& options) { return std::max(5 * options.click_px, 6 * typical(misses) / 1.18); }

ClickedNode clickedAgain(const Point& point, const std::vector<View>& views) {
  ClickedNode node{point.id, {}, std::nullopt};
  for (const Click& click : point.clicks) node.clicks[views[click.view].name] = {click.px};
  return node;
}

/// How far `view`'s click is from where the other clicks put the node; nothing where these do not agree among themselves.
std::optional<double> offFromOthers(ClickedNode node, const std::string& view, const std::vector<View>& views, double limit_px) {
  const PhotoPoint click = node.clicks.at(view);
  node.clicks.erase(view);
  const auto solved = solveNodes(views, std::span(&node, 1), {.maxReprojection_px = limit_px});
  if (!solved) return std::nullopt;
  return glm::length(project(detail::findView(views, view)->camera, solved->front().position).px - click.px);
}

/// Of a node whose clicks do not agree: every click without which the others do. Where several would explain it (an error along
/// a direction that only two views see) all of them are named; where none does, or there are only two clicks, all are.
std::vector<SuspectClick> suspectsOf(const Point& point, const std::vector<View>& views, double limit_px) {
  const ClickedNode node = clickedAgain(point, views);
  std::vector<SuspectClick> suspects;
  for (const auto& [view, click] : node.clicks)
    if (const auto off = offFromOthers(node, view, views, limit_px)) suspects.push_back({node.id, view, *off});
  if (!suspects.empty()) return suspects;
  const glm::dvec3 at{point.at[0], point.at[1], point.at[2]};
  for (const auto& [view, click] : node.clicks) suspects.push_back({node.id, view, glm::length(project(detail::findView(views, view)->camera, {at}).px - click.px)});
  return suspects;
}

std::vector<SuspectClick> suspectsOf(const Bundle& bundle, const std::vector<View>& views, const std::vector<Miss>& misses, const EstimateOptions& options) {
  const double limit_px = suspicionLimit(misses, options);
  std::vector<SuspectClick> suspects;
  std::size_t next = 0;
  for (const Point& point : bundle.points) {
    double worst = 0;
    for (std::size_t i = 0; i < point.clicks.size(); ++i) worst = std::max(worst, misses[next++].off_px);
    if (worst <= limit_px) continue;
    const auto own = suspectsOf(point, views, limit_px);
    suspects.insert(suspects.end(), own.begin(), own.end());
  }
  return suspects;
}

CameraReport reportOf(const Unknown& camera, const View& view, const std::vector<Miss>& misses, std::size_t index) {
  CameraReport report{view.name, view.camera.focal_px ? view.camera.focal_px->x : 0.0, {}, 0, 0};
  report.turned = Angle::fromRadians(glm::length(glm::dvec3{camera.values[kTurnX], camera.values[kTurnY], camera.values[kTurnZ]}));
  std::vector<Miss> own;
  std::copy_if(misses.begin(), misses.end(), std::back_inserter(own), [&](const Miss& m) { return m.view == index; });
  report.typical_px = typical(own);
  report.clicks = own.size();
  return report;
}

Result<void> checkReports(const Bundle& bundle, const std::vector<CameraReport>& reports) {
  for (const CameraReport& report : reports) {
    const auto camera = std::find_if(bundle.cameras.begin(), bundle.cameras.end(), [&](const Unknown& c) { return c.view.name == report.view; });
    const int longer = std::max(camera->view.size_px.x, camera->view.size_px.y);
    if (report.typical_px > kMostTypicalMiss * longer) return doNotFit(": the clicks of view '" + report.view + "' are typically " + fixed(report.typical_px, 0) + " px off");
    if (report.turned.degrees() > kMostTurned_deg)
      return doNotFit(": view '" + report.view + "' would have to be turned by " + fixed(report.turned.degrees(), 0) + " degrees from what its name says");
  }
  return {};
}

// ---- the known length -------------------------------------------------------------------------------------------------

struct Measured {
  double ratio;   ///< true length over measured length
  double weight;  ///< pixels it spans in all: how well it is seen
};

/// Views that know the same length, as one object: its two ends triangulated.
std::optional<Measured> measuredTogether(const std::vector<View>& views, const std::vector<const KnownLength*>& scales, double length) {
  ClickedNode ends[2] = {{NodeId(0), {}, std::nullopt}, {NodeId(1), {}, std::nullopt}};
  double span_px = 0;
  for (std::size_t v = 0; v < views.size(); ++v) {
    if (scales[v] == nullptr || scales[v]->length != length) continue;
    ends[0].clicks[views[v].name] = scales[v]->from;
    ends[1].clicks[views[v].name] = scales[v]->to;
    span_px += pixelsOf(*scales[v]);
  }
  if (ends[0].clicks.size() < 2) return std::nullopt;
  const auto placed = solveNodes(views, ends);
  if (!placed) return std::nullopt;
  const double measured = glm::length((*placed)[0].position.at - (*placed)[1].position.at);
  return measured > 0 ? std::optional(Measured{length / measured, span_px}) : std::nullopt;
}

/// A length seen in one view, at the origin's distance and parallel to the picture.
std::optional<Measured> measuredAlone(const Unknown& camera, const KnownLength& scale) {
  const double span_px = pixelsOf(scale);
  if (span_px < 1) return std::nullopt;
  return Measured{scale.length * std::exp(camera.values[kLogScale]) / span_px, span_px};
}

Result<double> trueScale(const Bundle& bundle, const std::vector<View>& views) {
  std::vector<const KnownLength*> scales;
  for (const Unknown& camera : bundle.cameras) scales.push_back(camera.hints.scale ? &*camera.hints.scale : nullptr);
  std::optional<Measured> best;
  for (const KnownLength* scale : scales) {
    const auto together = scale == nullptr ? std::nullopt : measuredTogether(views, scales, scale->length);
    if (together && (!best || together->weight > best->weight)) best = together;
  }
  if (best) return best->ratio;
  for (std::size_t v = 0; v < views.size(); ++v) {
    const auto alone = scales[v] == nullptr ? std::nullopt : measuredAlone(bundle.cameras[v], *scales[v]);
    if (alone && (!best || alone->weight > best->weight)) best = alone;
  }
  if (!best) return fail(ErrorCode::NoAnswer, "the cameras cannot be estimated: the two ends of the known length are clicked in one place; click both its ends");
  return best->ratio;
}

View scaled(View view, double ratio) {
  view.camera.translation *= ratio;
  view.camera.scale_px_per_unit /= ratio;
  return view;
}

std::vector<View> inOrderOf(std::span<const View> order, const std::vector<View>& views) {
  std::vector<View> sorted;
  for (const View& view : order) sorted.push_back(*detail::findView(views, view.name));
  return sorted;
}

Result<void> checkInput(std::span<const View> views, std::span<const ClickedNode> nodes) {
  if (const auto good = detail::checkViews(views, detail::UnknownCameras::Allowed); !good) return good;
  std::vector<detail::Trouble> troubles;
  for (const ClickedNode& node : nodes)
    for (detail::Trouble& trouble : detail::clickTroubles(views, node)) troubles.push_back(std::move(trouble));
  if (!troubles.empty()) return detail::failWith(troubles, "the cameras cannot be estimated");
  return {};
}

/// Two rounds: first gently, since a first guess from far away may be off by many pixels, then with the clicks' own scatter.
Result<void> adjusted(Bundle& bundle, const EstimateOptions& options) {
  std::vector<Prior> priors;
  for (const Unknown& camera : bundle.cameras) priors.push_back(camera.known ? Prior{1, 1, {0, 0}, 1} : priorOf(camera, options));
  if (!adjust(bundle, priors, 30 / options.click_px, options)) return doNotFit("");
  const double scatter = std::max(1.0, typical(missesOf(bundle, viewsOf(bundle))) / options.click_px);
  if (!adjust(bundle, priors, 4 * scatter, options)) return doNotFit("");
  return {};
}

}  // namespace

Result<EstimatedCameras> estimateCameras(std::span<const View> views, const std::map<std::string, UnknownCameraHints>& hints, std::span<const ClickedNode> nodes,
                                         const EstimateOptions& options) {
  if (const auto good = checkInput(views, nodes); !good) return good.failure();
  if (std::none_of(views.begin(), views.end(), [](const View& v) { return v.camera.model == CameraModel::Unknown; }))
    return EstimatedCameras{{views.begin(), views.end()}, {}, {}};
  auto bundle = gathered(views, hints, nodes, options);
  if (!bundle) return bundle.failure();
  if (const auto guessed = guess(*bundle); !guessed) return guessed.failure();
  if (const auto done = adjusted(*bundle, options); !done) return done.failure();

  std::vector<View> found = viewsOf(*bundle);
  const std::vector<Miss> misses = missesOf(*bundle, found);
  EstimatedCameras estimated;
  for (std::size_t v = 0; v < found.size(); ++v)
    if (!bundle->cameras[v].known) estimated.reports.push_back(reportOf(bundle->cameras[v], found[v], misses, v));
  if (const auto fits = checkReports(*bundle, estimated.reports); !fits) return fits.failure();
  estimated.suspects = suspectsOf(*bundle, found, misses, options);
  if (!bundle->scaleIsKnown) {
    const auto ratio = trueScale(*bundle, found);
    if (!ratio) return ratio.failure();
    for (View& view : found) view = scaled(std::move(view), *ratio);
  }
  estimated.views = inOrderOf(views, found);
  return estimated;
}

std::vector<ClickedNode> withoutSuspects(std::span<const ClickedNode> nodes, std::span<const SuspectClick> suspects) {
  std::vector<SuspectClick> worstFirst(suspects.begin(), suspects.end());
  std::stable_sort(worstFirst.begin(), worstFirst.end(), [](const SuspectClick& a, const SuspectClick& b) { return a.off_px > b.off_px; });
  std::vector<ClickedNode> kept(nodes.begin(), nodes.end());
  for (const SuspectClick& suspect : worstFirst)
    for (ClickedNode& node : kept)
      if (node.id == suspect.node && node.clicks.size() > 2) node.clicks.erase(suspect.view);
  return kept;
}

}  // namespace axil::skeleton3d
