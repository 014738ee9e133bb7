#include "skeleton3d/bundle_errors_interop.hpp"

#include "skeleton3d/projection.hpp"

#include <ceres/autodiff_cost_function.h>
#include <ceres/sized_cost_function.h>
#include <glm/mat3x2.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace axil::skeleton3d::detail {
namespace {

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

/// Where a click says that its point is seen, and how much it says: residuals are `weight` times how far off the point is.
struct Target {
  glm::dvec2 px{0, 0};
  glm::dmat2 weight{1.0};  ///< 1/px
};

glm::dmat2 evenWeight(double sigma_px) { return glm::dmat2(1 / sigma_px); }

/// A click alone says the same in all directions; a centre line beside it says most of what is across the stem.
Target targetOf(const BundleClick& click, double click_px) {
  const double sigma_px = click.sigma_px.value_or(click_px);
  if (!click.line) return {click.px, evenWeight(sigma_px)};
  const glm::dvec2 across = click.line->across, along{-across.y, across.x};
  const double byClick = 1 / (sigma_px * sigma_px), byLine = 1 / (click.line->sigma_px * click.line->sigma_px), both = byClick + byLine;
  const double shift = byLine / both * glm::dot(click.line->px - click.px, across);
  return {click.px + shift * across, glm::transpose(glm::dmat2{std::sqrt(both) * across, along / sigma_px})};
}

/// Reprojection error of a click in an unknown camera; both are adjusted. The derivatives are written out, since this is
/// where an adjustment spends its time.
class ClickError : public ceres::SizedCostFunction<2, kParameters, 3> {
 public:
  ClickError(const BundleCamera& camera, const Target& target)
      : camera_(camera), at_((target.px - camera.view.camera.centre_px) / glm::dvec2{1, camera.aspect}), weight_(target.weight * glm::dmat2{{1, 0}, {0, camera.aspect}}) {}

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const double* values = parameters[0];
    const Turn turn = turnOf({values[kTurnX], values[kTurnY], values[kTurnZ]});
    const glm::dmat3 rotation = turn.rotation * camera_.nominal;
    const glm::dvec3 turned = rotation * glm::dvec3{parameters[1][0], parameters[1][1], parameters[1][2]};
    const double scale = std::exp(values[kLogScale]), inverse = values[kFocalInverse] / camera_.focal_px;
    const double near = 1 + scale * inverse * turned.z;
    if (near < 1e-3) return false;  // at or behind the camera: a step to refuse
    const glm::dvec2 straight = (scale * glm::dvec2{turned.x, turned.y} + glm::dvec2{values[kOriginX], values[kOriginY]}) / near;
    const Bent bent = bend(straight, inverse, values[kBend]);
    const glm::dvec2 residual = weight_ * (bent.at - at_);
    residuals[0] = residual.x;
    residuals[1] = residual.y;
    if (jacobians == nullptr) return true;

    // Columns: how `straight` moves with the turned node; then everything goes through the lens and the weight.
    const double k = scale * inverse;
    const glm::dmat3x2 byTurned = glm::dmat3x2{{scale, 0}, {0, scale}, -k * straight} / near;
    const auto through = [&](const glm::dvec2& column) { return weight_ * (bent.derivative * column); };
    if (jacobians[0] != nullptr) {
      const glm::dmat3x2 byTurn = byTurned * (-crossMatrix(turned) * turn.left);
      const glm::dvec2 byScale = (scale * glm::dvec2{turned.x, turned.y} - k * turned.z * straight) / near;
      const glm::dvec2 byInverse = -(scale * turned.z / camera_.focal_px) * straight / near;
      const glm::dvec2 columns[kParameters] = {through(byTurn[0]), through(byTurn[1]), through(byTurn[2]), through({1 / near, 0}), through({0, 1 / near}), through(byScale),
                                               through(byInverse) + weight_ * bent.byInverse / camera_.focal_px, weight_ * bent.byBend};
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
    glm::dvec2 byBend{0, 0};
  };

  [[nodiscard]] Bent bend(glm::dvec2 p, double inverse, double more) const {
    if (inverse < 1e-12) return {p};
    auto d = camera_.view.camera.distortion;
    d[0] += more;
    const auto at = detail::distort(d, p.x * inverse, p.y * inverse);
    const auto j = detail::distortJacobian(d, p.x * inverse, p.y * inverse);
    Bent bent{glm::dvec2{at[0], at[1]} / inverse, {{j[0], j[2]}, {j[1], j[3]}}, {0, 0}, p * glm::dot(p, p) * inverse * inverse};
    bent.byInverse = (bent.derivative * p - bent.at) / inverse;
    return bent;
  }

  static void setColumn(double* rowMajor, std::size_t columns, std::size_t c, const glm::dvec2& value) {
    rowMajor[c] = value.x;
    rowMajor[columns + c] = value.y;
  }

  const BundleCamera& camera_;
  glm::dvec2 at_;       ///< from the picture's centre, pixels made square
  glm::dmat2 weight_;
};

/// Reprojection error of a click in a known camera; only the node moves.
struct KnownCameraError {
  const Camera* camera;
  Target target;

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
    const T x = scale.x * p[0] + camera->centre_px.x - target.px.x, y = scale.y * p[1] + camera->centre_px.y - target.px.y;
    for (int row = 0; row < 2; ++row) residual[row] = target.weight[0][row] * x + target.weight[1][row] * y;
    return true;
  }
};

/// The plant's origin seen in an unknown camera: a click on a point that stays at (0, 0, 0).
class OriginError : public ceres::SizedCostFunction<2, kParameters> {
 public:
  OriginError(const BundleCamera& camera, glm::dvec2 click, double click_px) : error_(camera, {click, evenWeight(click_px)}) {}

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const double origin[3] = {0, 0, 0};
    const double* both[2] = {parameters[0], origin};
    double* derivatives[2] = {jacobians == nullptr ? nullptr : jacobians[0], nullptr};
    return error_.Evaluate(both, residuals, derivatives);
  }

 private:
  ClickError error_;
};

/// What is believed of a camera before its clicks: its turn, its focal length, its lens, and faintly where the origin is.
struct Prior {
  double tilt_rad;
  double focalShare;
  double bend;
  glm::dvec2 origin;
  double origin_px;  ///< standard deviation

  template <class T>
  bool operator()(const T* values, T* residual) const {
    for (std::size_t i = kTurnX; i <= kTurnZ; ++i) residual[i] = values[i] / tilt_rad;
    residual[3] = (values[kFocalInverse] - 1.0) / focalShare;
    residual[4] = values[kBend] / bend;
    residual[5] = (values[kOriginX] - origin.x) / origin_px;
    residual[6] = (values[kOriginY] - origin.y) / origin_px;
    return true;
  }
};

Prior priorOf(const BundleCamera& camera, const EstimateOptions& options) {
  const auto& size = camera.view.size_px;
  constexpr double kFaint = 10;  // times the picture: an origin that is clicked says all
  return {options.tilt.radians(), camera.focalShare, camera.bend > 0 ? camera.bend : 1.0, {0, 0},
          (camera.hints.origin_px ? kFaint : 0.25) * std::max(size.x, size.y)};
}

/// Two cameras with the same lens.
struct SameLens {
  double share;

  template <class T>
  bool operator()(const T* a, const T* b, T* residual) const {
    residual[0] = (a[kFocalInverse] - b[kFocalInverse]) / share;
    residual[1] = (a[kBend] - b[kBend]) / 0.01;
    return true;
  }
};

/// A point seen in one view only: about as far from the camera as the origin.
struct AtOriginsDepth {
  glm::dmat3 rotation;  ///< of the view, held: it says only where far is
  double focal_px;
  double share;

  template <class T>
  bool operator()(const T* values, const T* point, T* residual) const {
    using std::exp;
    const T z = rotation[0][2] * point[0] + rotation[1][2] * point[1] + rotation[2][2] * point[2];
    residual[0] = exp(values[kLogScale]) * z / (focal_px * share);
    return true;
  }
};

ErrorBlock clickBlock(const Bundle& bundle, const BundleClick& click, std::size_t point, double click_px) {
  const BundleCamera& camera = bundle.cameras[click.view];
  if (camera.known)
    return {std::make_unique<ceres::AutoDiffCostFunction<KnownCameraError, 2, 3>>(new KnownCameraError{&camera.view.camera, targetOf(click, click_px)}), {}, point, true};
  return {std::make_unique<ClickError>(camera, targetOf(click, click_px)), {click.view}, point, true};
}

ErrorBlock depthBlock(const Bundle& bundle, std::size_t point) {
  const std::size_t view = bundle.points[point].clicks.front().view;
  const BundleCamera& camera = bundle.cameras[view];
  constexpr double kShare = 0.005;  // of the camera's distance: a rod put beside the stem
  const auto& v = camera.values;
  const glm::dmat3 rotation = turnOf({v[kTurnX], v[kTurnY], v[kTurnZ]}).rotation * camera.nominal;
  return {std::make_unique<ceres::AutoDiffCostFunction<AtOriginsDepth, 1, kParameters, 3>>(new AtOriginsDepth{rotation, camera.focal_px, kShare}), {view}, point, false};
}

/// Two unknown cameras whose focal lengths come from the same source at the same size of photo; a zoom that was moved
/// between guessed ones is possible, so the guess binds them less.
std::optional<ErrorBlock> sameLensBlock(const Bundle& bundle, std::size_t a, std::size_t b) {
  const BundleCamera &one = bundle.cameras[a], &other = bundle.cameras[b];
  const auto longer = [](const BundleCamera& c) { return std::max(c.view.size_px.x, c.view.size_px.y); };
  if (one.known || other.known || one.source != other.source || one.source == FocalSource::Given || longer(one) != longer(other)) return std::nullopt;
  if (std::abs(one.focal_px / other.focal_px - 1) > 1e-3) return std::nullopt;
  const double share = one.source == FocalSource::Exif ? 0.01 : 0.05;
  return ErrorBlock{std::make_unique<ceres::AutoDiffCostFunction<SameLens, 2, kParameters, kParameters>>(new SameLens{share}), {a, b}, std::nullopt, true};
}

}  // namespace

std::vector<int> heldValues(const Bundle& bundle, std::size_t camera) {
  std::vector<int> held;
  if (!bundle.scaleIsKnown && camera == bundle.reference) held.push_back(static_cast<int>(kLogScale));
  if (!(bundle.cameras[camera].bend > 0)) held.push_back(static_cast<int>(kBend));
  return held;
}

std::vector<ErrorBlock> errorBlocksOf(const Bundle& bundle, const AdjustOptions& options) {
  std::vector<ErrorBlock> blocks;
  for (std::size_t v = 0; v < bundle.cameras.size(); ++v) {
    const BundleCamera& camera = bundle.cameras[v];
    if (camera.known) continue;
    blocks.push_back({std::make_unique<ceres::AutoDiffCostFunction<Prior, 7, kParameters>>(new Prior(priorOf(camera, options.priors))), {v}, std::nullopt, false});
    if (camera.hints.origin_px) blocks.push_back({std::make_unique<OriginError>(camera, camera.hints.origin_px->px, options.click_px), {v}, std::nullopt, true});
    for (std::size_t w = 0; w < v; ++w)
      if (auto same = sameLensBlock(bundle, w, v)) blocks.push_back(std::move(*same));
  }
  for (std::size_t p = 0; p < bundle.points.size(); ++p) {
    for (const BundleClick& click : bundle.points[p].clicks) blocks.push_back(clickBlock(bundle, click, p, options.click_px));
    if (bundle.points[p].atOriginsDepth) blocks.push_back(depthBlock(bundle, p));
  }
  return blocks;
}

}  // namespace axil::skeleton3d::detail
