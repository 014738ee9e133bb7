#pragma once
/// \file
/// What in a measured plant a person should look at again: clicks that the other clicks of their node do not bear out, and segments far
/// longer than the plant's others, which are often a node clicked on the wrong stem. Nothing is changed.
///
/// A click is doubted when its node projects more than five pixels and four times the plant's typical distance away from it; a
/// segment when it is more than six times as long as the plant's typical one (of five or more). Source: beyond L-Grammar Generator 2005.

#include "skeleton3d/types.hpp"

#include <span>
#include <string>
#include <vector>

namespace axil::skeleton3d {

struct DoubtfulClick {
  NodeId node;
  std::string view;
  double off_px = 0;  ///< from where the node projects to

  friend bool operator==(const DoubtfulClick&, const DoubtfulClick&) = default;
};

struct DoubtfulSegment {
  StemId stem;
  NodeId from, to;
  double times = 1;  ///< as long as the typical segment

  friend bool operator==(const DoubtfulSegment&, const DoubtfulSegment&) = default;
};

struct Doubts {
  std::vector<DoubtfulClick> clicks;      ///< by node and view
  std::vector<DoubtfulSegment> segments;  ///< in the order of the stems

  [[nodiscard]] bool empty() const { return clicks.empty() && segments.empty(); }
  friend bool operator==(const Doubts&, const Doubts&) = default;
};

[[nodiscard]] Doubts doubtsOf(const Skeleton& skeleton);

}  // namespace axil::skeleton3d
