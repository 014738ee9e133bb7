#include "skeleton3d/bundle.hpp"
#include "skeleton3d/bundle_errors_interop.hpp"

#include <ceres/ceres.h>
#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace axil::skeleton3d::detail {
namespace {

void addBlocks(Bundle& bundle, std::vector<ErrorBlock> blocks, std::optional<double> loss, ceres::Problem& problem) {
  for (ErrorBlock& block : blocks) {
    std::vector<double*> values;
    for (const std::size_t v : block.cameras) values.push_back(bundle.cameras[v].values.data());
    if (block.point) values.push_back(bundle.points[*block.point].at.data());
    problem.AddResidualBlock(block.error.release(), block.isClick && loss ? new ceres::CauchyLoss(*loss) : nullptr, values);
  }
  for (std::size_t v = 0; v < bundle.cameras.size(); ++v) {
    if (bundle.cameras[v].known) continue;
    double* values = bundle.cameras[v].values.data();
    problem.SetParameterLowerBound(values, kFocalInverse, 0);
    if (const auto held = heldValues(bundle, v); !held.empty()) problem.SetManifold(values, new ceres::SubsetManifold(kParameters, held));
  }
}

std::shared_ptr<ceres::ParameterBlockOrdering> pointsFirst(Bundle& bundle) {
  auto ordering = std::make_shared<ceres::ParameterBlockOrdering>();
  for (BundlePoint& point : bundle.points) ordering->AddElementToGroup(point.at.data(), 0);
  for (BundleCamera& camera : bundle.cameras)
    if (!camera.known) ordering->AddElementToGroup(camera.values.data(), 1);
  return ordering;
}

bool isFinite(const Bundle& bundle) {
  const auto finite = [](const auto& values) { return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); }); };
  return std::all_of(bundle.cameras.begin(), bundle.cameras.end(), [&](const BundleCamera& c) { return finite(c.values); }) &&
         std::all_of(bundle.points.begin(), bundle.points.end(), [&](const BundlePoint& p) { return finite(p.at); });
}

}  // namespace

Result<Bundle> adjustBundle(Bundle bundle, const AdjustOptions& options) {
  ceres::Problem problem;
  const Bundle start = bundle;  // what the blocks refer to while the values move
  addBlocks(bundle, errorBlocksOf(start, options), options.loss, problem);

  ceres::Solver::Options solve;
  solve.linear_solver_type = ceres::DENSE_SCHUR;
  solve.linear_solver_ordering = pointsFirst(bundle);
  solve.num_threads = 1;  // the same sums in the same order, so the same bits
  solve.max_num_iterations = options.iterations;
  solve.function_tolerance = 1e-7;  // of a sum of squares in standard deviations: far below what the clicks can tell
  // The plant as a whole turns with only the priors to hold it: damping like the clicks' own stiffness would let it creep.
  solve.initial_trust_region_radius = 1e9;
  solve.logging_type = ceres::SILENT;
  FLAGS_minloglevel = google::GLOG_FATAL;  // a step that is taken back is no news for stderr
  ceres::Solver::Summary summary;
  ceres::Solve(solve, &problem, &summary);
  if (!summary.IsSolutionUsable() || !isFinite(bundle)) return doNotFit("");
  return bundle;
}

}  // namespace axil::skeleton3d::detail
