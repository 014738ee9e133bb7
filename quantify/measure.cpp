#include "quantify/measure.hpp"

#include "base/text.hpp"
#include "quantify/skeleton_index.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <tuple>
#include <utility>

namespace axil::quantify {

namespace {

using skeleton3d::NodeId;
using skeleton3d::Skeleton;

// Children whose angles differ by less than this are equally near; the smaller id is then the main one. Far above the
// rounding of a turned copy of the plant, far below any measurement.
constexpr double kSameAngle = 1e-9;
// A leaf is attached where it stands off its node by no more than this share of the plant's size, along its own direction.
constexpr double kAttached = 1e-6;

/// Step 1: every straight piece between two neighbouring nodes, with its length and direction.
std::vector<Segment> segmentsWithLengths(const Skeleton& skeleton, const SkeletonIndex& index) {
  std::vector<Segment> segments;
  for (const skeleton3d::Stem& stem : skeleton.stems) {
    for (std::size_t i = 1; i < stem.nodes.size(); ++i) {
      const skeleton3d::Node& from = index.node(stem.nodes[i - 1]);
      const skeleton3d::Node& to = index.node(stem.nodes[i]);
      const glm::dvec3 along = to.position.at - from.position.at;
      Segment segment;
      segment.stem = stem.id;
      segment.from = from.id;
      segment.to = to.id;
      segment.length = glm::length(along);
      segment.direction = PlantDirection::along(along);
      segment.radius = to.radius ? to.radius : from.radius;
      segments.push_back(std::move(segment));
    }
  }
  return segments;
}

/// Segments by the place of the node where they begin.
std::vector<std::vector<std::size_t>> segmentsLeaving(const std::vector<Segment>& segments, const SkeletonIndex& index) {
  std::vector<std::vector<std::size_t>> leaving(index.nodeCount());
  for (std::size_t s = 0; s < segments.size(); ++s) leaving[index.place(segments[s].from)].push_back(s);
  return leaving;
}

/// Step 2: how many segments lie between each one and the root, by Dijkstra's shortest paths where a segment counts 1.
/// A segment that the root does not reach keeps level -1.
void setLevels(std::vector<Segment>& segments, NodeId root, const SkeletonIndex& index) {
  constexpr int kFar = std::numeric_limits<int>::max();
  for (Segment& segment : segments) segment.level = -1;
  const std::vector<std::vector<std::size_t>> leaving = segmentsLeaving(segments, index);
  std::vector<int> distance(index.nodeCount(), kFar);
  using Entry = std::pair<int, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  distance[index.place(root)] = 0;
  open.push({0, index.place(root)});
  while (!open.empty()) {
    const auto [far, place] = open.top();
    open.pop();
    if (far > distance[place]) continue;
    for (const std::size_t s : leaving[place]) {
      segments[s].level = far;
      const std::size_t next = index.place(segments[s].to);
      if (far + 1 >= distance[next]) continue;
      distance[next] = far + 1;
      open.push({far + 1, next});
    }
  }
}

Result<void> allReached(const std::vector<Segment>& segments) {
  Error error{ErrorCode::BadInput, "the skeleton is not one plant: some stems are not connected with the root; let each begin with a node of its parent"};
  for (const Segment& segment : segments)
    if (segment.level < 0) error.details.push_back("stem " + std::to_string(segment.stem.value) + ": nothing leads from the root to node " + std::to_string(segment.to.value));
  if (error.details.empty()) return {};
  return fail(std::move(error));
}

/// Step 3: parent before child, the root segment first; then who is whose child.
void setFamilies(std::vector<Segment>& segments, const Skeleton& skeleton, const SkeletonIndex& index) {
  const skeleton3d::StemId first = skeleton.stems[index.firstStem()].id;
  std::sort(segments.begin(), segments.end(), [first](const Segment& a, const Segment& b) {
    return std::tuple(a.level, a.level == 0 && a.stem != first, a.stem) < std::tuple(b.level, b.level == 0 && b.stem != first, b.stem);
  });
  std::vector<std::optional<SegmentId>> arriving(index.nodeCount());
  for (std::size_t s = 0; s < segments.size(); ++s) {
    const SegmentId id{static_cast<std::int32_t>(s)};
    arriving[index.place(segments[s].to)] = id;
    segments[s].parent = arriving[index.place(segments[s].from)];
    if (segments[s].parent) segments[static_cast<std::size_t>(segments[s].parent->value)].children.push_back(id);
  }
}

/// The child that goes on most nearly straight; none where there are no children.
std::optional<SegmentId> mainChild(const std::vector<Segment>& segments, const Segment& parent) {
  const auto angle = [&](SegmentId id) { return angleBetween(parent.direction, segments[static_cast<std::size_t>(id.value)].direction).radians(); };
  double least = std::numeric_limits<double>::infinity();
  for (const SegmentId id : parent.children) least = std::min(least, angle(id));
  for (const SegmentId id : parent.children)
    if (angle(id) <= least + kSameAngle) return id;
  return std::nullopt;
}

void setKinds(std::vector<Segment>& segments) {
  for (Segment& segment : segments) segment.kind = SegmentKind::Branch;
  segments.front().kind = SegmentKind::Root;
  for (const Segment& parent : segments)
    if (const auto main = mainChild(segments, parent)) segments[static_cast<std::size_t>(main->value)].kind = SegmentKind::Main;
}

StemFrame rootFrame(const std::vector<Segment>& segments, TurningRule rule) {
  StemFrame frame = firstFrame(segments.front().direction);
  if (rule == TurningRule::Exact) return frame;
  const auto nearest = mainChild(segments, segments.front());
  if (!nearest) return frame;
  const PlantDirection child = segments[static_cast<std::size_t>(nearest->value)].direction;
  if (!areParallel(frame.direction, child)) frame.rAxis = PlantDirection::along(glm::cross(frame.direction.unit(), child.unit()));
  return frame;
}

/// Step 4: rotr and rotu of every segment against its parent, and its own r-axis. Each frame is the one that growing will
/// have there, so that what rounding does to one segment is measured away in its children and cannot add up.
std::vector<StemFrame> setTurns(std::vector<Segment>& segments, TurningRule rule) {
  std::vector<StemFrame> frames(segments.size());
  frames.front() = rootFrame(segments, rule);
  segments.front().rAxis = frames.front().rAxis;
  for (std::size_t s = 1; s < segments.size(); ++s) {
    Segment& segment = segments[s];
    const StemFrame& parent = frames[segment.parent ? static_cast<std::size_t>(segment.parent->value) : 0];
    const Turn turn = measuredTurn(parent, segment.direction);
    segment.rotr = turn.rotr;
    segment.rotu = turn.rotu;
    frames[s] = childFrame(parent, turn, segment.kind == SegmentKind::Main ? ChildKind::Main : ChildKind::Branch, rule);
    if (rule == TurningRule::Literal) frames[s].direction = segment.direction;
    segment.rAxis = frames[s].rAxis;
  }
  return frames;
}

/// The thesis prints the main child last, outside brackets.
void orderChildren(std::vector<Segment>& segments) {
  const auto key = [&](SegmentId id) {
    const Segment& child = segments[static_cast<std::size_t>(id.value)];
    return std::tuple(child.kind == SegmentKind::Main, child.rotr, id);
  };
  for (Segment& segment : segments)
    std::sort(segment.children.begin(), segment.children.end(), [&](SegmentId a, SegmentId b) { return key(a) < key(b); });
}

struct Attachment {
  NodeId node;
  double petiole = 0;
};

/// The node of the leaf's stem that its blade, or the stalk in line with the blade, leaves from; the nearest if several do.
std::optional<Attachment> attachmentOf(const skeleton3d::Leaf& leaf, const skeleton3d::Stem& stem, const SkeletonIndex& index) {
  const double reach = kAttached * index.extent();
  std::optional<Attachment> best;
  for (const NodeId id : stem.nodes) {
    const glm::dvec3 off = leaf.position.at - index.node(id).position.at;
    const double along = glm::dot(off, leaf.direction.unit());
    const double beside = glm::length(off - leaf.direction.unit() * along);
    if (beside > reach || along < -reach) continue;
    const double petiole = along > reach ? along : 0;
    if (!best || petiole < best->petiole) best = Attachment{id, petiole};
  }
  return best;
}

LeafMeasure measuredLeaf(const skeleton3d::Leaf& leaf, std::size_t number, double petiole, const StemFrame& stem) {
  const Turn turn = measuredTurn(stem, leaf.direction);
  const StemFrame blade = childFrame(stem, turn, ChildKind::Branch);
  LeafMeasure measured;
  measured.rotr = turn.rotr;
  measured.rotu = turn.rotu;
  measured.roll = signedAngleAbout(blade.direction, blade.adaxial, leaf.normal);
  measured.direction = leaf.direction;
  measured.normal = leaf.normal;
  measured.length = leaf.length;
  measured.width = leaf.width;
  measured.petiole = petiole;
  measured.shape = leaf.shape;
  measured.skeletonLeaf = number;
  return measured;
}

Result<void> addLeaves(Measurements& measured, const Skeleton& skeleton, const SkeletonIndex& index, const std::vector<StemFrame>& frames) {
  std::vector<std::size_t> arriving(index.nodeCount(), 0);
  for (std::size_t s = 0; s < measured.segments.size(); ++s) arriving[index.place(measured.segments[s].to)] = s;
  Error error{ErrorCode::NoAnswer, "a leaf must leave from a node of its stem, or stand off one along its own direction by the length of its stalk"};
  for (std::size_t l = 0; l < skeleton.leaves.size(); ++l) {
    const skeleton3d::Leaf& leaf = skeleton.leaves[l];
    const auto at = attachmentOf(leaf, *index.stem(leaf.stem), index);
    if (!at) {
      error.details.push_back("leaf " + std::to_string(l + 1) + " of stem " + std::to_string(leaf.stem.value) + " is attached to none of the stem's nodes");
      continue;
    }
    const bool collar = at->node == skeleton.root;
    const std::size_t s = collar ? 0 : arriving[index.place(at->node)];
    auto& leaves = collar ? measured.rootLeaves : measured.segments[s].leaves;
    leaves.push_back(measuredLeaf(leaf, l, at->petiole, frames[s]));
  }
  if (error.details.empty()) return {};
  return fail(std::move(error));
}

}  // namespace

Result<Measurements> measure(const Skeleton& skeleton, const MeasureOptions& options) {
  const Result<SkeletonIndex> index = SkeletonIndex::of(skeleton);
  if (!index) return index.failure();

  Measurements measured;
  measured.unit = skeleton.unit;
  measured.origin = index->node(skeleton.root).position;
  measured.segments = segmentsWithLengths(skeleton, *index);
  setLevels(measured.segments, skeleton.root, *index);
  if (const auto reached = allReached(measured.segments); !reached) return reached.failure();
  setFamilies(measured.segments, skeleton, *index);
  setKinds(measured.segments);
  const std::vector<StemFrame> frames = setTurns(measured.segments, options.turning);
  orderChildren(measured.segments);
  if (const auto attached = addLeaves(measured, skeleton, *index, frames); !attached) return attached.failure();
  return measured;
}

}  // namespace axil::quantify
