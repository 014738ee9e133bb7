#pragma once
/// \file
/// From a click in one photo to places in another that may be the same point: the guide's band is searched for the middle
/// lines of stems in the other photo, prepared once as for live-wire, and what is found is ranked by how well it fits.
/// Milliseconds once the photo is prepared, so the second click is mostly a confirmation.
///
/// Pixels of the other view. No candidate is no failure: the band may show nothing like a stem.
/// Source: beyond L-Grammar Generator 2005.

#include "skeleton3d/guides.hpp"
#include "skeleton3d/live_wire.hpp"

#include <vector>

namespace axil::skeleton3d {

/// Where stems' middle lines cross the guide, one place a stem, the clearest first; at most `most`.
[[nodiscard]] std::vector<GuideCandidate> candidatesAlong(const Guide& guide, const LiveWire& otherPhoto, std::size_t most = 40);

/// A candidate with its rank.
struct ProposedPlace {
  GuideCandidate candidate;
  RankedCandidate rank;
};

/// The likeliest first. Fails as guideBetween does.
[[nodiscard]] Result<std::vector<ProposedPlace>> proposedPlaces(const View& clicked, PhotoPoint click, const View& other, const LiveWire& otherPhoto, const Reach& reach,
                                                                const GuideExpectation& expected = {}, double click_px = 2, double camera_px = 1);

}  // namespace axil::skeleton3d
