#pragma once
/// \file
/// Command: one thing a user does to a project, as a plain value. `apply` gives the project after it, or one clear Error and
/// no trace. Everything that changes a project goes through here: panels, keys, the command line, saved sessions, tests.
///
/// Commands name things by their ids: a node, a stem, a view's name, the place of leaves in the list (from 1, as people count). Ids
/// of new things are part of the command (document/lookup.hpp offers the next free ones), so that a line means the same whenever
/// it is replayed. Photo points in px of the photo, lengths in the project's unit, angles as Angle.
///
/// A project under work need not be a whole plant yet: nodes without a second click, stems of one node and parts that nothing
/// connects are allowed, and the chain says where they are. What can never become a tree is refused at once: a node in the
/// inside of two stems, a node twice in a stem, stems in a circle, names and ids that do not exist or exist already.
/// document/command_text.hpp prints each command as one line.

#include "base/result.hpp"
#include "document/project.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace axil::document {

using skeleton3d::NodeId;
using skeleton3d::StemId;

/// Limits that every command keeps.
inline constexpr std::size_t kMaximumNodes = 100'000;
inline constexpr std::size_t kMaximumStems = 100'000;
inline constexpr std::size_t kMaximumViews = 64;
inline constexpr std::size_t kMaximumLeaves = 100'000;
inline constexpr std::size_t kMaximumNameBytes = 200;               ///< of a project, a view, a unit, a trait's parts
inline constexpr std::size_t kMaximumDescriptionBytes = 1u << 20;
inline constexpr double kMaximumPixel = 1e6;                        ///< of any photo coordinate, either side of zero

// ---- the project -----------------------------------------------------------------------------------------------------

struct SetName {
  std::string name;
  friend bool operator==(const SetName&, const SetName&) = default;
};
struct SetDescription {
  SharedText text;
  friend bool operator==(const SetDescription&, const SetDescription&) = default;
};
struct SetSeed {
  std::uint64_t seed = 1;  ///< 0 to 2^53
  friend bool operator==(const SetSeed&, const SetSeed&) = default;
};
/// Names the unit of every length; no number changes.
struct SetUnit {
  std::string unit;
  friend bool operator==(const SetUnit&, const SetUnit&) = default;
};

// ---- facts of the description ----------------------------------------------------------------------------------------

struct AcceptTrait {
  std::string organ, property, words;
  friend bool operator==(const AcceptTrait&, const AcceptTrait&) = default;
};
/// `words` empty: a fact of the user's own.
struct ChangeTrait {
  std::string organ, property, words, value;
  friend bool operator==(const ChangeTrait&, const ChangeTrait&) = default;
};
struct ChangeTraitRange {
  std::string organ, property, words;
  double low = 0, high = 0;
  std::string unit;
  friend bool operator==(const ChangeTraitRange&, const ChangeTraitRange&) = default;
};
struct RejectTrait {
  std::string organ, property, words;
  friend bool operator==(const RejectTrait&, const RejectTrait&) = default;
};
/// Takes a decision back.
struct ForgetTrait {
  std::string organ, property, words;
  friend bool operator==(const ForgetTrait&, const ForgetTrait&) = default;
};

// ---- views -----------------------------------------------------------------------------------------------------------

struct AddView {
  std::string view, photo;  ///< photo may be empty
  friend bool operator==(const AddView&, const AddView&) = default;
};
/// Takes the clicks made in the view along.
struct RemoveView {
  std::string view;
  friend bool operator==(const RemoveView&, const RemoveView&) = default;
};
/// The view's clicks follow.
struct RenameView {
  std::string view, name;
  friend bool operator==(const RenameView&, const RenameView&) = default;
};
/// Two photos were given the wrong way round: they exchange names; camera, origin, scale and clicks stay with their photo.
struct SwapViews {
  std::string view, other;
  friend bool operator==(const SwapViews&, const SwapViews&) = default;
};
/// Another file for the same picture; clicks and camera stay. Empty: no photo.
struct RelinkPhoto {
  std::string view, photo;
  friend bool operator==(const RelinkPhoto&, const RelinkPhoto&) = default;
};
/// What size the photo must have; 0 x 0: whatever it has.
struct SetPhotoSize {
  std::string view;
  int width = 0, height = 0;
  friend bool operator==(const SetPhotoSize&, const SetPhotoSize&) = default;
};
/// A whole camera, as a calibration gives it.
struct SetCamera {
  std::string view;
  skeleton3d::Camera camera;
  friend bool operator==(const SetCamera&, const SetCamera&) = default;
};
/// Unknown forgets the pose and keeps the focal length. Orthographic, for a view whose pose is unknown: held exactly as the view's
/// name says, with scale and place from its known length and origin. Perspective: only where the pose is known.
struct SetCameraModel {
  std::string view;
  skeleton3d::CameraModel model = skeleton3d::CameraModel::Unknown;
  friend bool operator==(const SetCameraModel&, const SetCameraModel&) = default;
};
struct SetFocal {
  std::string view;
  double fx_px = 0, fy_px = 0;
  friend bool operator==(const SetFocal&, const SetFocal&) = default;
};
struct ClearFocal {
  std::string view;
  friend bool operator==(const ClearFocal&, const ClearFocal&) = default;
};
struct SetOrigin {
  std::string view;
  PhotoPoint at;
  friend bool operator==(const SetOrigin&, const SetOrigin&) = default;
};
struct ClearOrigin {
  std::string view;
  friend bool operator==(const ClearOrigin&, const ClearOrigin&) = default;
};
struct SetScale {
  std::string view;
  PhotoPoint from, to;
  double length = 0;
  friend bool operator==(const SetScale&, const SetScale&) = default;
};
struct ClearScale {
  std::string view;
  friend bool operator==(const ClearScale&, const ClearScale&) = default;
};

// ---- nodes and clicks ------------------------------------------------------------------------------------------------

/// A new node with its first click; it is on no stem yet.
struct AddNode {
  NodeId node;
  std::string view;
  PhotoPoint at;
  friend bool operator==(const AddNode&, const AddNode&) = default;
};
/// The stems they were on close over the gap. Refused where a stem that would remain begins at one of them.
struct RemoveNodes {
  std::vector<NodeId> nodes;
  friend bool operator==(const RemoveNodes&, const RemoveNodes&) = default;
};
struct AddClick {
  NodeId node;
  std::string view;
  PhotoPoint at;
  friend bool operator==(const AddClick&, const AddClick&) = default;
};
/// A click that the program puts where other photos say the node is, and that no person has confirmed yet: cameras are not estimated
/// from it (skeleton3d::ClickedNode::placed).
struct PlaceClick {
  NodeId node;
  std::string view;
  PhotoPoint at;
  double within_px = 0;  ///< how far off it may be (standard deviation); as any click where that is less
  friend bool operator==(const PlaceClick&, const PlaceClick&) = default;
};
/// From here on it is a person's click.
struct MoveClick {
  NodeId node;
  std::string view;
  PhotoPoint at;
  friend bool operator==(const MoveClick&, const MoveClick&) = default;
};
struct RemoveClick {
  NodeId node;
  std::string view;
  friend bool operator==(const RemoveClick&, const RemoveClick&) = default;
};
struct SetRadius {
  NodeId node;
  double radius = 0;  ///< half the width; 0: as thin as a line
  friend bool operator==(const SetRadius&, const SetRadius&) = default;
};
struct ClearRadius {
  NodeId node;
  friend bool operator==(const ClearRadius&, const ClearRadius&) = default;
};

// ---- stems -----------------------------------------------------------------------------------------------------------

/// A stem through nodes that exist; a single one is a stem just begun.
struct AddStem {
  StemId stem;
  std::vector<NodeId> nodes;
  friend bool operator==(const AddStem&, const AddStem&) = default;
};
/// A stem just begun, at a node that is on a stem already.
struct StartBranch {
  StemId stem;
  NodeId at;
  friend bool operator==(const StartBranch&, const StartBranch&) = default;
};
struct AppendNode {
  StemId stem;
  NodeId node;
  friend bool operator==(const AppendNode&, const AppendNode&) = default;
};
struct InsertNode {
  StemId stem;
  NodeId node, before;
  friend bool operator==(const InsertNode&, const InsertNode&) = default;
};
/// The node stays in the project, on no stem or on those that begin with it.
struct RemoveFromStem {
  StemId stem;
  NodeId node;
  friend bool operator==(const RemoveFromStem&, const RemoveFromStem&) = default;
};
/// Lets a branch begin at another node: its first node is replaced, and where nothing else uses that one, it stays free.
struct AttachStem {
  StemId stem;
  NodeId at;
  friend bool operator==(const AttachStem&, const AttachStem&) = default;
};
/// At an inner node: `stem` ends there, `upper` begins there. Leaves at named nodes go with them, others stay with `stem`.
struct SplitStem {
  StemId stem;
  NodeId at;
  StemId upper;
  friend bool operator==(const SplitStem&, const SplitStem&) = default;
};
/// `upper` goes on where `lower` ends: it begins at the tip of `lower`, or begins freely and gets a segment from there.
/// Leaves of `upper` become those of `lower`.
struct JoinStems {
  StemId lower, upper;
  friend bool operator==(const JoinStems&, const JoinStems&) = default;
};
struct ReverseStem {
  StemId stem;
  friend bool operator==(const ReverseStem&, const ReverseStem&) = default;
};
/// With every stem that hangs on it, their nodes and their leaves; the node where it leaves its parent stays.
struct RemoveStem {
  StemId stem;
  friend bool operator==(const RemoveStem&, const RemoveStem&) = default;
};

// ---- leaves ----------------------------------------------------------------------------------------------------------

struct AddLeaves {
  quantify::LeafArrangement leaves;
  friend bool operator==(const AddLeaves&, const AddLeaves&) = default;
};
/// Replaces the `number`-th arrangement of the list, from 1.
struct ChangeLeaves {
  int number = 1;
  quantify::LeafArrangement leaves;
  friend bool operator==(const ChangeLeaves&, const ChangeLeaves&) = default;
};
struct RemoveLeaves {
  int number = 1;
  friend bool operator==(const RemoveLeaves&, const RemoveLeaves&) = default;
};
/// The same leaves on other stems, besides those they have. Leaves at named nodes become as many, spread evenly.
struct CopyLeaves {
  int number = 1;
  std::vector<StemId> stems;
  friend bool operator==(const CopyLeaves&, const CopyLeaves&) = default;
};

using Command = std::variant<SetName, SetDescription, SetSeed, SetUnit,                                          //
                             AcceptTrait, ChangeTrait, ChangeTraitRange, RejectTrait, ForgetTrait,               //
                             AddView, RemoveView, RenameView, SwapViews, RelinkPhoto, SetPhotoSize,              //
                             SetCamera, SetCameraModel, SetFocal, ClearFocal,                                    //
                             SetOrigin, ClearOrigin, SetScale, ClearScale,                                       //
                             AddNode, RemoveNodes, AddClick, PlaceClick, MoveClick, RemoveClick,                 //
                             SetRadius, ClearRadius,                                                             //
                             AddStem, StartBranch, AppendNode, InsertNode, RemoveFromStem, AttachStem,           //
                             SplitStem, JoinStems, ReverseStem, RemoveStem,                                      //
                             AddLeaves, ChangeLeaves, RemoveLeaves, CopyLeaves>;

/// What is done and undone as one: usually one command; a click that also extends a stem is two.
using Step = std::vector<Command>;

/// The project after `command`. Fails with NotFound for a view, node, stem or place that does not exist, with LimitReached, or
/// with BadInput; the sentence says what to do instead. Call it as document::apply: a Command is a std::variant, so std::apply
/// listens too.
[[nodiscard]] Result<Project> apply(const Project& project, const Command& command);
/// All of a step or nothing of it.
[[nodiscard]] Result<Project> apply(const Project& project, std::span<const Command> step);

}  // namespace axil::document
