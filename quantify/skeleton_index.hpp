#pragma once
/// \file
/// SkeletonIndex: a skeleton that was checked, with its nodes and stems found by id. Private to this room; it must not
/// outlive the skeleton it was made from.

#include "base/result.hpp"
#include "skeleton3d/types.hpp"

#include <cstddef>
#include <unordered_map>

namespace axil::quantify {

class SkeletonIndex {
 public:
  /// Fails as quantify::measure says for what is wrong with ids, numbers, lengths and the shape of the tree; whether the root
  /// reaches every part is left to the measuring of levels.
  [[nodiscard]] static Result<SkeletonIndex> of(const skeleton3d::Skeleton& skeleton);

  [[nodiscard]] std::size_t nodeCount() const { return nodes_.size(); }
  /// The node's place in Skeleton::nodes; the id must be one of the skeleton's.
  [[nodiscard]] std::size_t place(skeleton3d::NodeId id) const { return nodes_.at(id); }
  [[nodiscard]] const skeleton3d::Node& node(skeleton3d::NodeId id) const { return skeleton_->nodes[place(id)]; }
  /// Null where no stem has that id.
  [[nodiscard]] const skeleton3d::Stem* stem(skeleton3d::StemId id) const;
  [[nodiscard]] std::size_t firstStem() const { return firstStem_; }
  /// The largest side of the box around all nodes.
  [[nodiscard]] double extent() const { return extent_; }

 private:
  explicit SkeletonIndex(const skeleton3d::Skeleton& skeleton) : skeleton_(&skeleton) {}

  const skeleton3d::Skeleton* skeleton_;
  std::unordered_map<skeleton3d::NodeId, std::size_t> nodes_;
  std::unordered_map<skeleton3d::StemId, std::size_t> stems_;
  std::size_t firstStem_ = 0;
  double extent_ = 0;
};

}  // namespace axil::quantify
