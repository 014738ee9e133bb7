#pragma once
/// \file
/// Private to skeleton3d: what a bundle adjustment adjusts, and its steps: gather, guess, adjust, add the known lengths,
/// find the scatter of the clicks. Each takes a Bundle and gives a better one.

#include "base/result.hpp"
#include "skeleton3d/estimate.hpp"
#include "skeleton3d/types.hpp"
#include "skeleton3d/uncertainty.hpp"

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace axil::skeleton3d::detail {

/// What is adjusted of an unknown camera: u = c + lens((s x + a) / (1 + k z)), where (x, y, z) is the node turned into the
/// view about the plant's origin, a the origin's pixel from the picture's centre, s pixels per unit at the origin, and
/// k = s / focal. It stays smooth down to k = 0, the orthographic camera, where focal and distance run off to infinity.
/// kBend is what the lens' radial k1 has beyond what is given; it moves only where nothing is known of the lens.
enum Parameter : std::size_t { kTurnX, kTurnY, kTurnZ, kOriginX, kOriginY, kLogScale, kFocalInverse, kBend, kParameters };

/// Where a camera's focal length comes from; views of one photo size and one source are taken for the same lens.
enum class FocalSource { Given, Exif, Guessed };

struct BundleCamera {
  bool known = false;                         ///< the camera is given and stays; the rest is for the first guess only
  View view;
  UnknownCameraHints hints;
  glm::dmat3 nominal{1.0};
  FocalSource source = FocalSource::Guessed;
  double focal_px = 0;                        ///< first guess
  double focalShare = 0;                      ///< how far to trust its inverse
  double bend = 0;                            ///< how far kBend may be from 0; 0: it is held
  double aspect = 1;                          ///< fy / fx
  std::array<double, kParameters> values{};   ///< kFocalInverse is first guess / focal
};

/// A stem's centre line as a photo shows it beside a click.
struct BundleLine {
  glm::dvec2 px{0, 0};
  glm::dvec2 across{1, 0};  ///< unit
  double sigma_px = 1;
};

struct BundleClick {
  std::size_t view = 0;
  glm::dvec2 px{0, 0};
  std::optional<double> sigma_px = std::nullopt;     ///< nothing: that of all clicks
  std::optional<BundleLine> line = std::nullopt;
};

struct BundlePoint {
  NodeId id;
  std::vector<BundleClick> clicks;
  std::array<double, 3> at{0, 0, 0};
  bool atOriginsDepth = false;  ///< seen in its one view only: about as far from the camera as the plant's origin
};

/// A known length between two points of the bundle.
struct BundleRod {
  double length = 0;
  std::size_t from = 0;
  std::size_t to = 0;
};

struct Bundle {
  std::vector<BundleCamera> cameras;  ///< by name
  std::vector<BundlePoint> points;    ///< nodes clicked in two views or more, by id; after them the ends of known lengths
  std::size_t nodes = 0;              ///< how many of the points are nodes
  std::vector<BundleRod> rods;
  std::size_t reference = 0;          ///< the camera whose scale is held until the known lengths are looked at
  bool scaleIsKnown = false;          ///< by a known camera
};

/// Views are by name, as in Bundle. Fails as estimateCameras says.
[[nodiscard]] Result<Bundle> gatherBundle(std::span<const View> views, const std::map<std::string, UnknownCameraHints>& hints, std::span<const ClickedNode> nodes,
                                          const EstimateOptions& options);

/// First guess: everything seen from far away. Fails where a view shows the plant the wrong way round.
[[nodiscard]] Result<Bundle> guessBundle(Bundle bundle);

struct AdjustOptions {
  double click_px = 1;               ///< standard deviation of a click
  std::optional<double> loss;        ///< in these, beyond which a click counts less and less; none: squares throughout
  EstimateOptions priors = {};
  int iterations = 100;
};
/// Fails with NoAnswer where the adjustment runs off.
[[nodiscard]] Result<Bundle> adjustBundle(Bundle bundle, const AdjustOptions& options);

/// The ends of the known lengths as points; which end is which is tried for every view. Where several views give the same
/// length and its rays meet it is one object, else each is seen alone. Fails where no length has two different ends.
[[nodiscard]] Result<Bundle> withKnownLengths(Bundle bundle, double click_px);

/// The clicks of nodes with the centre lines beside them. Readings of ids that are no node of the bundle are places along stems
/// that nobody clicked; they become points after all others.
[[nodiscard]] Bundle withCentreLines(Bundle bundle, const RidgeReadings& readings);

/// True size over the size the bundle has, all known lengths weighted by how well they are seen; 1 without any.
[[nodiscard]] double trueScale(const Bundle& bundle, const Uncertainty& shape);
/// Those weights, one a rod, their sum 1.
[[nodiscard]] std::vector<double> rodWeights(const Bundle& bundle, const Uncertainty& shape);

[[nodiscard]] Camera cameraOf(const BundleCamera& camera);
[[nodiscard]] std::vector<View> viewsOf(const Bundle& bundle);

/// A click and how far it is from where its point projects to.
struct Miss {
  std::size_t point;
  std::size_t view;
  glm::dvec2 off_px;
};
[[nodiscard]] std::vector<Miss> missesOf(const Bundle& bundle);
[[nodiscard]] double medianOf(std::vector<double> values);
[[nodiscard]] double typicalMiss(const std::vector<Miss>& misses);

/// The standard deviation of the clicks that the misses show, with the fitted numbers counted off; drawn a little towards
/// one pixel where there are few. `robust`: from the median, so that a few wrong clicks do not matter.
struct Scatter {
  double click_px = 1;
  int freedom = 0;
};
[[nodiscard]] Scatter scatterOf(const Bundle& bundle);
[[nodiscard]] Scatter robustScatterOf(const Bundle& bundle);
/// The same for known cameras.
[[nodiscard]] Scatter robustScatterOf(std::span<const View> views, std::span<const ClickedNode> nodes);

/// Clicks that do not fit, judged node by node in `views`, the bundle's cameras or better ones. See SuspectClick.
[[nodiscard]] std::vector<SuspectClick> suspectsOf(const Bundle& bundle, const std::vector<View>& views, double click_px, std::span<const ClickedStem> stems,
                                                   const StemEvidence* evidence = nullptr);
/// `evidence`: what photos say, or null.
[[nodiscard]] std::vector<SuspectClick> suspectsAmong(const std::vector<ClickedNode>& nodes, const std::vector<View>& views, double click_px, std::span<const ClickedStem> stems,
                                                      const StemEvidence* evidence = nullptr);
/// The bundle without the suspects that withoutSuspects drops.
[[nodiscard]] Bundle withoutSuspectsIn(Bundle bundle, const std::vector<SuspectClick>& suspects);

/// Joint covariance of the points and what is weakly determined of each camera, in the bundle's own scale.
struct BundleSpread {
  Uncertainty shape;                                 ///< all points, rods' ends included (ids below 0), before any gauge
  std::vector<std::array<double, kParameters>> cameraSigma;  ///< of `values`; 0 of what is held
};
[[nodiscard]] BundleSpread spreadOf(const Bundle& bundle, const AdjustOptions& options);

/// `shape` with the gauge of uncertainty.hpp: size from the known lengths, turn taken out, the rods' ends dropped.
[[nodiscard]] Uncertainty gauged(const Bundle& bundle, const Uncertainty& shape);

[[nodiscard]] Failure viewFault(ErrorCode code, const std::string& name, const std::string& what);
[[nodiscard]] Failure doNotFit(const std::string& why);

}  // namespace axil::skeleton3d::detail
