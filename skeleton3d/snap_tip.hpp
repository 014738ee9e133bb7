#pragma once
/// \file
/// Private to skeleton3d: where a stem ends in a photo. Across a stem its edges say where the centre line is; along it nothing
/// does but its end, so a tip clicked a little beyond the stem can be taken back to where the stem's colour ends.
///
/// How: the colour along the centre line, as a share of the way from the stem's own (well inside) to that of what lies beyond
/// it; the end is where that falls from one to nothing. It is taken only where the fall is one clear step.
/// Pixels of the upright photo. Source: beyond L-Grammar Generator 2005.

#include "skeleton3d/snap.hpp"

#include <glm/vec2.hpp>

#include <optional>

namespace axil::skeleton3d::detail {

/// How far beyond `reading.at`, along the unit vector `out` (the stem's own direction, away from its base), the stem ends;
/// negative where it ends before. Nothing within `reach_px`, or nothing clear: nothing.
[[nodiscard]] std::optional<double> tipBeyond(const Photo& photo, const RidgeReading& reading, glm::dvec2 out, double reach_px);

}  // namespace axil::skeleton3d::detail
