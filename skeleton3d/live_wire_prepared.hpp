#pragma once
/// \file
/// Private to skeleton3d: what a prepared photo holds.

#include "skeleton3d/live_wire.hpp"
#include "skeleton3d/stemness.hpp"

namespace axil::skeleton3d::detail {

struct PreparedWire {
  std::shared_ptr<const Photo> photo;
  StemnessMap stems;
};

}  // namespace axil::skeleton3d::detail
