#include "skeleton3d/bundle.hpp"
#include "skeleton3d/linear_least_squares.hpp"

#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace axil::skeleton3d::detail {
namespace {

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

FarCamera farCameraOf(const BundleCamera& unknown) {
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
double guessedUnitsPerPixel(const BundleCamera& camera) {
  const auto& scale = camera.hints.scale;
  return scale && pixelsOf(*scale) > 10 ? scale->length / pixelsOf(*scale) : 1.0 / std::max(camera.view.size_px.x, camera.view.size_px.y);
}

struct FarProblem {
  std::vector<FarCamera> cameras;
  std::size_t unknowns = 0;
};

FarProblem farProblemOf(Bundle& bundle) {
  FarProblem far;
  for (const BundleCamera& camera : bundle.cameras) far.cameras.push_back(farCameraOf(camera));
  if (!bundle.scaleIsKnown) {
    const auto withScale = std::find_if(bundle.cameras.begin(), bundle.cameras.end(), [](const BundleCamera& c) { return c.hints.scale && pixelsOf(*c.hints.scale) > 10; });
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

Elimination eliminationOf(const FarProblem& far, const BundlePoint& point) {
  Elimination e;
  glm::dmat3 normal(1e-9);
  for (const BundleClick& click : point.clicks) {
    const glm::dmat3 r = glm::transpose(far.cameras[click.view].rotation);
    for (int k = 0; k < 2; ++k) {
      e.rows.push_back(r[k]);
      normal += glm::outerProduct(r[k], r[k]);
    }
  }
  e.inverse = glm::inverse(normal);
  return e;
}

void addPoint(const FarProblem& far, const BundlePoint& point, std::vector<double>& a, std::vector<double>& b) {
  const Elimination e = eliminationOf(far, point);
  std::vector<FarRow> rows;
  for (const BundleClick& click : point.clicks)
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
    for (const BundlePoint& point : bundle.points)
      for (const BundleClick& click : point.clicks)
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
  for (const BundlePoint& point : bundle.points) addPoint(far, point, a, b);
  addFaintMiddles(far, bundle, a, b);
  return solveLeastSquares(a, b);
}

void placePoint(const FarProblem& far, const std::vector<double>& solution, BundlePoint& point) {
  const Elimination e = eliminationOf(far, point);
  glm::dvec3 sum{0, 0, 0};
  for (std::size_t i = 0; i < e.rows.size(); ++i) {
    const BundleClick& click = point.clicks[i / 2];
    const FarRow row = farRowOf(far, far.cameras[click.view], click.px, static_cast<int>(i % 2));
    sum += e.rows[i] * std::inner_product(solution.begin(), solution.end(), row.coefficients.begin(), row.constant);
  }
  const glm::dvec3 at = e.inverse * sum;
  point.at = {at.x, at.y, at.z};
}

/// A focal length so short that the plant would reach into the camera is no place to start from.
void keepInFront(BundleCamera& camera, const std::vector<BundlePoint>& points) {
  double nearest = 0;  // along the view, from the origin towards the camera
  for (const BundlePoint& point : points) nearest = std::max(nearest, -(camera.nominal * glm::dvec3{point.at[0], point.at[1], point.at[2]}).z);
  const double reach = nearest * std::exp(camera.values[kLogScale]) / camera.focal_px;  // share of the camera's distance
  if (reach > 0.5) camera.values[kFocalInverse] = 0.5 / reach;
}

}  // namespace

Result<Bundle> guessBundle(Bundle bundle) {
  const FarProblem far = farProblemOf(bundle);
  const std::vector<double> solution = solvedFar(far, bundle);
  for (std::size_t v = 0; v < far.cameras.size(); ++v) {
    const FarCamera& camera = far.cameras[v];
    BundleCamera& unknown = bundle.cameras[v];
    if (unknown.known) continue;
    const double q = camera.fixed ? *camera.fixed : solution[camera.scaleColumn];
    if (!(std::isfinite(q) && q > 0)) return doNotFit(": view '" + unknown.view.name + "' shows the plant the wrong way round");
    const glm::dvec2 origin = camera.hasOrigin ? camera.origin : glm::dvec2{solution[camera.originColumn], solution[camera.originColumn + 1]} / q;
    unknown.values = {0, 0, 0, origin.x, origin.y, -std::log(q), 1, 0};
  }
  for (BundlePoint& point : bundle.points) placePoint(far, solution, point);
  for (BundleCamera& camera : bundle.cameras)
    if (!camera.known) keepInFront(camera, bundle.points);
  return bundle;
}

}  // namespace axil::skeleton3d::detail
