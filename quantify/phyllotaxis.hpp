#pragma once
/// \file
/// Phyllotaxis: how leaves or branches stand around their axes, estimated from the measured divergence.
///
/// A node with n organs is an n-armed star: its azimuth is the circular mean of its organs' azimuths modulo a whole turn over n. The
/// divergence from one node to the next is the difference of their azimuths, with the same period. Axes may wind either way: where
/// the differences of all axes agree they are taken as they are, else each axis is turned to wind the way its own mean does.
/// The preset that fits is the one (of the botanical vocabulary, with the same number of organs a node) nearest to the mean.
/// Sources: Mardia and Jupp 2000 (circular statistics); L-Grammar Generator 2005, section 3.2.3 (arrangements).

#include "quantify/structure.hpp"

#include <span>
#include <string>
#include <vector>

namespace axil::quantify {

enum class Winding { Left, Right, Either, None };  ///< seen along the axis from its base; None: 0 or half a period
enum class OrgansAround { Leaves, Branches };

struct Phyllotaxis {
  OrgansAround organs = OrgansAround::Leaves;
  int perNode = 0;              ///< the commonest number of organs at a node that has any; 0: nothing stands on the plant
  double perNodeShare = 0;      ///< share of those nodes that have it
  Angle divergence;             ///< from 0 to half a period (360 degrees / perNode)
  Angle deviation;              ///< circular, of single differences
  Angle error;                  ///< standard error of `divergence`
  double concentration = 0;     ///< 1: every step alike
  double chance = 1;            ///< that evenly spread steps look as regular (Rayleigh)
  Winding winding = Winding::None;
  std::size_t samples = 0;      ///< differences between neighbouring nodes
  std::string preset;           ///< "spiral", "decussate", ...; "irregular" where chance is above 0.05; "none" where none is within 10 degrees or three standard errors; empty: too few samples
  std::string nearest;          ///< the preset whose divergence is nearest, fit or not
  Angle presetDivergence;
  Angle off;                    ///< divergence - presetDivergence, absolute

  [[nodiscard]] Angle period() const { return Angle::fromDegrees(perNode > 0 ? 360.0 / perNode : 360.0); }
};

/// One plant, or many of a kind. Only pairs of neighbouring nodes of an axis count, with no bare segment-tip between them unless every step has as
/// many (leaves on every second node are still neighbours); organs within half a degree of their axis have no side and are left out.
struct MeasuredPlant {
  const Measurements* measurements = nullptr;
  const PlantStructure* structure = nullptr;
};
[[nodiscard]] Phyllotaxis phyllotaxisOf(std::span<const MeasuredPlant> plants, OrgansAround organs);
/// On the axes of one order only.
[[nodiscard]] Phyllotaxis phyllotaxisOf(std::span<const MeasuredPlant> plants, OrgansAround organs, int order);

}  // namespace axil::quantify
