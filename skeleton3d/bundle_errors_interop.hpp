#pragma once
/// \file
/// Private to skeleton3d, and to the files that see Ceres: the errors a bundle adjustment makes small, each as a block with
/// the cameras and the point it depends on. Adjusting and asking for the covariance use the same blocks.

#include "skeleton3d/bundle.hpp"

#include <ceres/cost_function.h>

#include <memory>
#include <optional>
#include <vector>

namespace axil::skeleton3d::detail {

struct ErrorBlock {
  std::unique_ptr<ceres::CostFunction> error;  ///< in standard deviations
  std::vector<std::size_t> cameras;            ///< its first parameter blocks, in this order
  std::optional<std::size_t> point;            ///< its last one
  bool isClick = false;                        ///< may be wrong, so a loss may bound it
};

/// The blocks refer to `bundle`'s cameras, which must stay where they are.
[[nodiscard]] std::vector<ErrorBlock> errorBlocksOf(const Bundle& bundle, const AdjustOptions& options);

/// Which values of a camera do not move.
[[nodiscard]] std::vector<int> heldValues(const Bundle& bundle, std::size_t camera);

}  // namespace axil::skeleton3d::detail
