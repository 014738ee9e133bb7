#include "skeleton3d/bundle.hpp"
#include "skeleton3d/bundle_errors_interop.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/LU>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace axil::skeleton3d::detail {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;

/// Where the moving values of the cameras stand among the columns of the normal equations; -1: held.
struct Columns {
  std::vector<std::array<Index, kParameters>> of;
  Index count = 0;
};

Columns columnsOf(const Bundle& bundle) {
  Columns columns;
  for (std::size_t v = 0; v < bundle.cameras.size(); ++v) {
    std::array<Index, kParameters> own{};
    const auto held = heldValues(bundle, v);
    for (std::size_t k = 0; k < kParameters; ++k) {
      const bool moves = !bundle.cameras[v].known && std::find(held.begin(), held.end(), static_cast<int>(k)) == held.end();
      own[k] = moves ? columns.count++ : -1;
    }
    columns.of.push_back(own);
  }
  return columns;
}

/// The normal equations of the adjustment, cameras (U), points (V, one 3 x 3 each) and what joins them (W).
struct Normal {
  MatrixXd cameras;
  std::vector<Matrix3d> points;
  std::vector<MatrixXd> joint;  ///< columns x 3
};

using Jacobian = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

std::vector<Jacobian> jacobiansOf(const Bundle& bundle, const ErrorBlock& block) {
  std::vector<const double*> values;
  std::vector<Jacobian> jacobians;
  const Index rows = block.error->num_residuals();
  for (const std::size_t v : block.cameras) {
    values.push_back(bundle.cameras[v].values.data());
    jacobians.push_back(Jacobian::Zero(rows, static_cast<Index>(kParameters)));
  }
  if (block.point) {
    values.push_back(bundle.points[*block.point].at.data());
    jacobians.push_back(Jacobian::Zero(rows, 3));
  }
  std::vector<double> residuals(static_cast<std::size_t>(rows));
  std::vector<double*> places;
  for (Jacobian& jacobian : jacobians) places.push_back(jacobian.data());
  if (!block.error->Evaluate(values.data(), residuals.data(), places.data()))
    for (Jacobian& jacobian : jacobians) jacobian.setZero();
  return jacobians;
}

/// A block's derivatives by all moving values of its cameras, side by side.
struct CameraPart {
  std::vector<Index> columns;
  MatrixXd jacobian;
};

CameraPart cameraPartOf(const ErrorBlock& block, const std::vector<Jacobian>& jacobians, const Columns& columns) {
  CameraPart part;
  std::vector<Eigen::VectorXd> moving;
  for (std::size_t i = 0; i < block.cameras.size(); ++i)
    for (std::size_t k = 0; k < kParameters; ++k)
      if (const Index c = columns.of[block.cameras[i]][k]; c >= 0) {
        part.columns.push_back(c);
        moving.emplace_back(jacobians[i].col(static_cast<Index>(k)));
      }
  part.jacobian.resize(block.error->num_residuals(), static_cast<Index>(moving.size()));
  for (std::size_t c = 0; c < moving.size(); ++c) part.jacobian.col(static_cast<Index>(c)) = moving[c];
  return part;
}

void addTo(Normal& normal, const ErrorBlock& block, const std::vector<Jacobian>& jacobians, const Columns& columns) {
  const CameraPart part = cameraPartOf(block, jacobians, columns);
  const MatrixXd own = part.jacobian.transpose() * part.jacobian;
  for (std::size_t a = 0; a < part.columns.size(); ++a)
    for (std::size_t b = 0; b < part.columns.size(); ++b) normal.cameras(part.columns[a], part.columns[b]) += own(static_cast<Index>(a), static_cast<Index>(b));
  if (!block.point) return;
  const Jacobian& byPoint = jacobians.back();
  normal.points[*block.point] += byPoint.transpose() * byPoint;
  const MatrixXd joint = part.jacobian.transpose() * byPoint;
  for (std::size_t a = 0; a < part.columns.size(); ++a) normal.joint[*block.point].row(part.columns[a]) += joint.row(static_cast<Index>(a));
}

Normal normalOf(const Bundle& bundle, const AdjustOptions& options, const Columns& columns) {
  Normal normal{MatrixXd::Zero(columns.count, columns.count), std::vector<Matrix3d>(bundle.points.size(), Matrix3d::Zero()),
                std::vector<MatrixXd>(bundle.points.size(), MatrixXd::Zero(columns.count, 3))};
  for (const ErrorBlock& block : errorBlocksOf(bundle, options)) addTo(normal, block, jacobiansOf(bundle, block), columns);
  return normal;
}

/// Of a positive definite matrix, a little stiffened where nothing holds a direction, so that it stays finite.
template <class Matrix>
Matrix inverseOf(const Matrix& normal) {
  const double stiff = 1e-13 * std::max(normal.trace(), 1e-300);
  return Matrix(normal + stiff * Matrix::Identity(normal.rows(), normal.cols())).inverse();
}

glm::dmat3 toGlm(const Matrix3d& m) {
  glm::dmat3 g;
  for (int c = 0; c < 3; ++c) g[c] = {m(0, c), m(1, c), m(2, c)};
  return g;
}

Matrix3d toEigen(const glm::dmat3& g) {
  Matrix3d m;
  for (int c = 0; c < 3; ++c) m.col(c) << g[c].x, g[c].y, g[c].z;
  return m;
}

NodeSpread spreadFrom(const BundlePoint& point, const Matrix3d& own, const MatrixXd& shared) {
  NodeSpread spread{point.id, {{point.at[0], point.at[1], point.at[2]}}, toGlm(own), {}};
  for (Index c = 0; c < shared.cols(); ++c) spread.shared.push_back({shared(0, c), shared(1, c), shared(2, c)});
  return spread;
}

std::vector<double> rowByRow(const MatrixXd& m) {
  std::vector<double> values;
  for (Index r = 0; r < m.rows(); ++r)
    for (Index c = 0; c < m.cols(); ++c) values.push_back(m(r, c));
  return values;
}

// ---- gauges: linear maps of all points by a few numbers that depend on all points -----------------------------------------

/// The covariance as matrices: C = D (one 3 x 3 a point) + U M U^T.
struct Joint {
  std::vector<Matrix3d> own;
  MatrixXd shared;  ///< U, 3 rows a point
  MatrixXd middle;  ///< M
};

Joint jointOf(const Uncertainty& shape) {
  Joint joint;
  const auto points = static_cast<Index>(shape.nodes.size());
  const auto columns = shape.nodes.empty() ? Index{0} : static_cast<Index>(shape.nodes.front().shared.size());
  joint.shared.resize(3 * points, columns);
  for (Index p = 0; p < points; ++p) {
    const NodeSpread& node = shape.nodes[static_cast<std::size_t>(p)];
    joint.own.push_back(toEigen(node.own));
    for (Index c = 0; c < columns; ++c) {
      const glm::dvec3& u = node.shared[static_cast<std::size_t>(c)];
      joint.shared.block<3, 1>(3 * p, c) << u.x, u.y, u.z;
    }
  }
  joint.middle.resize(columns, columns);
  for (Index r = 0; r < columns; ++r)
    for (Index c = 0; c < columns; ++c) joint.middle(r, c) = shape.middle[static_cast<std::size_t>(r * columns + c)];
  return joint;
}

/// Covariance of the numbers `ask` (rows over all points) gives.
struct Asked {
  MatrixXd byOwn;     ///< D ask^T
  MatrixXd byShared;  ///< ask U
  MatrixXd covariance;
};

Asked asked(const Joint& joint, const MatrixXd& ask) {
  Asked answer;
  answer.byOwn.resize(ask.cols(), ask.rows());
  for (std::size_t p = 0; p < joint.own.size(); ++p) {
    const auto at = static_cast<Index>(3 * p);
    answer.byOwn.middleRows<3>(at) = joint.own[p] * ask.middleCols<3>(at).transpose();
  }
  answer.byShared = ask * joint.shared;
  answer.covariance = ask * answer.byOwn + answer.byShared * joint.middle * answer.byShared.transpose();
  return answer;
}

/// The joint covariance of X - along * (ask X): what `ask` finds is taken out along `along`.
Joint without(const Joint& joint, const MatrixXd& along, const MatrixXd& ask, const Asked& answer) {
  const Index m = joint.middle.rows(), r = ask.rows();
  Joint left{joint.own, MatrixXd(joint.shared.rows(), m + 2 * r), MatrixXd::Zero(m + 2 * r, m + 2 * r)};
  left.shared << joint.shared, along, answer.byOwn;
  left.middle.topLeftCorner(m, m) = joint.middle;
  left.middle.block(m, 0, r, m) = -answer.byShared * joint.middle;
  left.middle.block(0, m, m, r) = left.middle.block(m, 0, r, m).transpose();
  left.middle.block(m, m, r, r) = answer.covariance;
  left.middle.block(m, m + r, r, r) = -MatrixXd::Identity(r, r);
  left.middle.block(m + r, m, r, r) = -MatrixXd::Identity(r, r);
  return left;
}

/// How the logarithm of the size that the known lengths give moves with their ends, as one row.
MatrixXd sizeRow(const Bundle& bundle, const Uncertainty& shape) {
  MatrixXd row = MatrixXd::Zero(1, static_cast<Index>(3 * bundle.points.size()));
  const std::vector<double> weights = rodWeights(bundle, shape);
  for (std::size_t r = 0; r < bundle.rods.size(); ++r) {
    const BundleRod& rod = bundle.rods[r];
    const glm::dvec3 along = shape.nodes[rod.to].at.at - shape.nodes[rod.from].at.at;
    const glm::dvec3 share = weights[r] * along / glm::dot(along, along);
    row.middleCols<3>(static_cast<Index>(3 * rod.to)) += Eigen::RowVector3d(share.x, share.y, share.z);
    row.middleCols<3>(static_cast<Index>(3 * rod.from)) -= Eigen::RowVector3d(share.x, share.y, share.z);
  }
  return row;
}

MatrixXd placesOf(const std::vector<NodeSpread>& nodes) {
  MatrixXd places(static_cast<Index>(3 * nodes.size()), 1);
  for (std::size_t i = 0; i < nodes.size(); ++i) places.block<3, 1>(static_cast<Index>(3 * i), 0) << nodes[i].at.at.x, nodes[i].at.at.y, nodes[i].at.at.z;
  return places;
}

/// How every place moves when the plant turns about its origin: w x X = -[X]x w.
MatrixXd turnsOf(const std::vector<NodeSpread>& nodes) {
  MatrixXd turns(static_cast<Index>(3 * nodes.size()), 3);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const glm::dvec3& x = nodes[i].at.at;
    Matrix3d cross;
    cross << 0, x.z, -x.y, -x.z, 0, x.x, x.y, -x.x, 0;
    turns.middleRows<3>(static_cast<Index>(3 * i)) = cross;
  }
  return turns;
}

void store(const Joint& joint, double scale, Uncertainty& into) {
  for (std::size_t i = 0; i < into.nodes.size(); ++i) {
    const auto at = static_cast<Index>(3 * i);
    BundlePoint point;
    const glm::dvec3 place = scale * into.nodes[i].at.at;
    point.id = into.nodes[i].id;
    point.at = {place.x, place.y, place.z};
    into.nodes[i] = spreadFrom(point, scale * scale * joint.own[i], scale * joint.shared.middleRows<3>(at));
  }
  into.middle = rowByRow(joint.middle);
}

}  // namespace

BundleSpread spreadOf(const Bundle& bundle, const AdjustOptions& options) {
  const Columns columns = columnsOf(bundle);
  const Normal normal = normalOf(bundle, options, columns);
  std::vector<Matrix3d> own;
  MatrixXd reduced = normal.cameras;
  for (std::size_t p = 0; p < bundle.points.size(); ++p) {
    own.push_back(inverseOf(normal.points[p]));
    reduced -= normal.joint[p] * own[p] * normal.joint[p].transpose();
  }
  BundleSpread spread;
  const MatrixXd covariance = columns.count > 0 ? inverseOf(reduced) : MatrixXd(0, 0);
  for (std::size_t p = 0; p < bundle.points.size(); ++p)
    spread.shape.nodes.push_back(spreadFrom(bundle.points[p], own[p], -own[p] * normal.joint[p].transpose()));
  spread.shape.middle = rowByRow(0.5 * (covariance + covariance.transpose()));
  for (const auto& of : columns.of) {
    std::array<double, kParameters> sigma{};
    for (std::size_t k = 0; k < kParameters; ++k) sigma[k] = of[k] < 0 ? 0.0 : std::sqrt(std::max(covariance(of[k], of[k]), 0.0));
    spread.cameraSigma.push_back(sigma);
  }
  return spread;
}

Uncertainty gauged(const Bundle& bundle, const Uncertainty& shape) {
  Uncertainty done = shape;
  if (bundle.scaleIsKnown) return done;
  const MatrixXd size = sizeRow(bundle, shape);
  Joint joint = jointOf(shape);
  const Asked sizes = asked(joint, size);
  done.scaleShare = std::sqrt(std::max(sizes.covariance(0, 0), 0.0));
  joint = without(joint, placesOf(shape.nodes), size, sizes);

  done.nodes.resize(bundle.nodes);  // the rods have done their part
  joint.own.resize(bundle.nodes);
  joint.shared = MatrixXd(joint.shared.topRows(static_cast<Index>(3 * bundle.nodes)));

  const MatrixXd turns = turnsOf(done.nodes);
  const MatrixXd ask = inverseOf(Matrix3d(turns.transpose() * turns)) * turns.transpose();
  const Asked turned = asked(joint, ask);
  for (int k = 0; k < 3; ++k) done.turned[static_cast<std::size_t>(k)] = Angle::fromRadians(std::sqrt(std::max(turned.covariance(k, k), 0.0)));
  store(without(joint, turns, ask, turned), trueScale(bundle, shape), done);
  return done;
}

}  // namespace axil::skeleton3d::detail
