#pragma once
/// \file
/// What the photos propose for nodes that are clicked in one photo and not yet in another: the whole way of a traced stem, and ranked places
/// for a single node. Proposals are shown, never taken by themselves.

#include "document/command.hpp"
#include "document/derived.hpp"
#include "skeleton3d/guide_candidates.hpp"
#include "skeleton3d/stem_between.hpp"
#include "ui/wires.hpp"

#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace axil::ui {

/// The clicks that the nodes of a stem would get in a view.
/// A place where the stem bends in the other photo and is straight in the first: a new node, there in both.
struct ProposedBend {
  document::NodeId above;  ///< the stem's next node
  PhotoPoint inFirst, inOther;
};

struct ProposedStem {
  std::string view;
  std::vector<std::pair<document::NodeId, PhotoPoint>> clicks;  ///< the last one is the tip's
  std::vector<PhotoPoint> line;                                 ///< the way through them
  PlantPoint tip;
  double confidence = 0;                                        ///< 0 to 1
  double within_px = 0;                                         ///< how far off the clicks before the tip's may be
  std::string first;                                            ///< the photo that shows all these nodes already
  std::vector<ProposedBend> bends = {};                         ///< from the base on
};

/// All that a proposal follows from: one stem's last nodes, clicked in `first` and not in `other`.
struct StemQuestion {
  skeleton3d::View first;
  skeleton3d::View other;
  std::vector<std::pair<document::NodeId, PhotoPoint>> nodes;  ///< from one that is clicked in both to the tip, their clicks in `first`
  skeleton3d::LiveWire otherPhoto;
  skeleton3d::Reach reach;
  skeleton3d::BetweenOptions options;
  std::vector<skeleton3d::TakenSegment> taken;                 ///< segments of other stems in `other`: what is there is not proposed again
  double within_px = 0;                                        ///< see Placed
};

/// What has been measured so far: cameras by view, and where the nodes are.
struct Placed {
  const document::Measured& measured;
  const skeleton3d::Skeleton* skeleton = nullptr;

  [[nodiscard]] const skeleton3d::View* view(const std::string& name) const;  ///< null while its camera is not known
  [[nodiscard]] const skeleton3d::Node* node(document::NodeId id) const;
  /// How far off a click may be that follows from the cameras of two views: nothing where they are given, twice as far as clicks miss where
  /// they are estimated.
  [[nodiscard]] double within_px(const std::string& from, const std::string& to) const;
  [[nodiscard]] skeleton3d::Reach reach() const;                                ///< where the plant may be: about its nodes, before those all that the photos show
  [[nodiscard]] skeleton3d::Reach scene() const;                                ///< all that the photos show, about the origin
};

/// Nothing where the tip is clicked in `view`, or no node before it is clicked in both photos, or a camera is not known.
[[nodiscard]] std::optional<StemQuestion> stemQuestion(const document::Project& project, const Placed& placed, document::NodeId tip, const std::string& view,
                                                       const skeleton3d::LiveWire& otherPhoto);
/// Nothing where the other photo shows no such stem, or one that is clicked already.
[[nodiscard]] std::optional<ProposedStem> proposedStem(const StemQuestion& question);
/// For several photos at once: of proposals that put the tip at different places the surest stays; one that no other photo agrees with
/// must be surer.
[[nodiscard]] std::vector<ProposedStem> agreeing(std::span<const StemQuestion> questions);
/// The clicks of them all, and the new nodes of the first one that has any.
[[nodiscard]] document::Step stepOf(const document::Project& project, std::span<const ProposedStem> proposed);

/// The likeliest places in `view` for a point clicked in `first`, best first; none without cameras.
[[nodiscard]] std::vector<skeleton3d::ProposedPlace> placesFor(const Placed& placed, const std::string& first, PhotoPoint click, const std::string& view,
                                                               const skeleton3d::LiveWire& otherPhoto, std::optional<document::NodeId> before);

/// Proposals for the stem of the selected node, worked out in the background.
class Proposals {
 public:
  explicit Proposals(std::function<void()> answered);

  /// Asks where the project or the selection has changed; once a frame.
  void update(const document::OpenProject& open, std::uint64_t revision, const UiState& state, const std::optional<Placed>& placed, const Photos& photos, const Wires& wires);
  [[nodiscard]] const ProposedStem* in(const std::string& view) const;
  [[nodiscard]] const std::vector<ProposedStem>& all() const { return stems_; }
  [[nodiscard]] bool busy() const { return worker_.busy(); }

 private:
  std::vector<ProposedStem> stems_;
  std::vector<std::string> askedViews_;
  std::pair<std::uint64_t, std::optional<document::NodeId>> asked_ = {0, {}};
  Worker<std::vector<StemQuestion>, std::vector<ProposedStem>> worker_;
};

}  // namespace axil::ui
