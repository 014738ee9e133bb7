#pragma once
/// \file
/// The nouns of the measuring room: cameras and clicks come in, a Skeleton goes out.
///
/// Frames and units: clicks are PhotoPoints (px), everything else is in the plant's frame and the project's unit (metres
/// unless the project says otherwise). A Skeleton is a tree: one root, each stem a chain of nodes that begins with a node
/// of its parent stem (the first stem with the root). Plain values; nothing here owns a photo.
/// Source: L-Grammar Generator 2005, section 3.2.

#include "base/frames.hpp"
#include "base/ids.hpp"

#include <glm/mat3x3.hpp>

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace axil::skeleton3d {

struct NodeTag;
struct StemTag;
using NodeId = Id<NodeTag>;  ///< the id a project gives a node; unique, any number from 0
using StemId = Id<StemTag>;

enum class CameraModel {
  Orthographic,  ///< u = s x + cx, v = s y + cy
  Perspective,   ///< u = fx x/z + cx after lens distortion
  Unknown,       ///< to be estimated; cannot project yet
};

/// How a view projects: x_cam = rotation * X + translation, x right, y down, z forward, as in OpenCV.
struct Camera {
  CameraModel model = CameraModel::Unknown;
  std::optional<glm::dvec2> focal_px;            ///< fx, fy; perspective, or a hint for an unknown camera
  glm::dvec2 centre_px{0, 0};                    ///< cx, cy; for an unknown camera (0, 0) is the middle of the photo
  std::array<double, 5> distortion{0, 0, 0, 0, 0};  ///< k1, k2, p1, p2, k3 (perspective)
  double scale_px_per_unit = 0;                  ///< s; orthographic
  glm::dmat3 rotation{1.0};                      ///< GLM is column-major: rotation[column][row]
  glm::dvec3 translation{0, 0, 0};

  friend bool operator==(const Camera&, const Camera&) = default;
};

/// One photo's place in the measurement. `size_px` may be unknown (0, 0); then clicks are not checked against it.
struct View {
  std::string name;  ///< "front", "right", "top", or any other
  Camera camera;
  glm::ivec2 size_px{0, 0};

  friend bool operator==(const View&, const View&) = default;
};

/// Two clicked points of a photo whose true distance (project's unit) is known: a ruler, a rod, the edge of a pot.
struct KnownLength {
  PhotoPoint from;
  PhotoPoint to;
  double length = 0;

  friend bool operator==(const KnownLength&, const KnownLength&) = default;
};

/// What is known about a camera that nobody calibrated; its focal length, where known exactly, is Camera::focal_px.
struct UnknownCameraHints {
  std::optional<PhotoPoint> origin_px;      ///< the plant's origin (collar) in this photo
  std::optional<KnownLength> scale;         ///< where several views give the same length it is taken for the same object
  std::optional<double> exif_focal_px;      ///< what the photo's EXIF data say: good to some percent
  std::array<std::optional<double>, 2> scaleSigma_px = {};  ///< standard deviations of the ends of `scale`; nothing: as of any click

  friend bool operator==(const UnknownCameraHints&, const UnknownCameraHints&) = default;
};

/// A point of the plant as a person clicked it: at most one click a view, keyed by the view's name.
///
/// A click that the program put there by what other views say, and that nobody has confirmed, is named in `placed`. It agrees with the
/// cameras that placed it, so it tells nothing about cameras or about other clicks: cameras are estimated without it, no click is judged
/// by it, and a node that a person clicked in two views is placed without it. Only where those do not fix the node does it count.
struct ClickedNode {
  NodeId id;
  std::map<std::string, PhotoPoint> clicks;
  std::optional<double> radius;  ///< half the stem's width, project's unit
  std::map<std::string, double> placed = {};  ///< view -> how far off such a click may be (standard deviation, px; as any click where less)

  friend bool operator==(const ClickedNode&, const ClickedNode&) = default;
};

/// A stem as a person clicked it: node ids from where it leaves its parent to its tip.
struct ClickedStem {
  StemId id;
  std::vector<NodeId> nodes;

  friend bool operator==(const ClickedStem&, const ClickedStem&) = default;
};

/// A node of the skeleton. `sigma`: standard deviation of each coordinate for a click noise of `SolveOptions::click_px`, until
/// `withUncertainty` puts in what clicks and cameras together say.
struct Node {
  NodeId id;
  PlantPoint position;
  std::optional<double> radius;
  glm::dvec3 sigma{0, 0, 0};
  std::map<std::string, double> reprojection_px;  ///< view name -> distance of the click from the node's projection

  friend bool operator==(const Node&, const Node&) = default;
};

struct Stem {
  StemId id;
  std::optional<StemId> parent;  ///< none: the first stem
  std::vector<NodeId> nodes;     ///< at least two; the first belongs to the parent (or is the root)

  friend bool operator==(const Stem&, const Stem&) = default;
};

/// A leaf blade on a stem. `position` is where it is attached, `direction` points along the blade to its tip, `normal` is
/// its adaxial (upper) side, perpendicular to `direction`.
struct Leaf {
  StemId stem;
  PlantPoint position;
  PlantDirection direction = PlantDirection::up();
  PlantDirection normal = PlantDirection::up();
  double length = 0;
  double width = 0;
  std::string shape;  ///< a name that organs::leafShape knows; empty: unknown

  friend bool operator==(const Leaf&, const Leaf&) = default;
};

/// A node that is kept though it has no place yet: clicked in one view, or with clicks that contradict one another. It takes
/// its place in its stem as soon as another view sees it.
struct IncompleteNode {
  NodeId id;
  std::vector<std::string> views;  ///< in which it is clicked

  friend bool operator==(const IncompleteNode&, const IncompleteNode&) = default;
};

struct Skeleton {
  std::string unit = "m";
  NodeId root;
  std::vector<Node> nodes;  ///< in the order they came
  std::vector<Stem> stems;  ///< a parent always before its children
  std::vector<Leaf> leaves;
  std::vector<IncompleteNode> incomplete = {};  ///< nodes that wait for another view
  std::vector<StemId> waiting = {};             ///< stems that cannot be joined without them

  friend bool operator==(const Skeleton&, const Skeleton&) = default;
};

}  // namespace axil::skeleton3d
