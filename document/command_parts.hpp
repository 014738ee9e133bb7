#pragma once
/// \file
/// Private to document: one function a command, each giving the project after it, and the checks they share.

#include "document/command.hpp"
#include "document/lookup.hpp"

#include <set>
#include <string>
#include <string_view>

namespace axil::document {

// ---- checks and words ------------------------------------------------------------------------------------------------

[[nodiscard]] inline std::string inQuotes(std::string_view text) { return "'" + std::string(text) + "'"; }
[[nodiscard]] inline std::string nameOf(NodeId id) { return "node " + std::to_string(id.value); }
[[nodiscard]] inline std::string nameOf(StemId id) { return "stem " + std::to_string(id.value); }

/// Whether the text is fit to be a name: not empty, one line of UTF-8, at most kMaximumNameBytes. `what` begins the sentence.
[[nodiscard]] Result<void> checkName(const std::string& what, std::string_view text);
[[nodiscard]] Result<void> checkNumber(const std::string& what, double value, double low, double high);
/// Whether `at` can be a place in the view's photo.
[[nodiscard]] Result<void> checkPoint(const skeleton3d::View& view, PhotoPoint at);

/// Places in the project's lists, or the sentence that there is no such thing.
[[nodiscard]] Result<std::size_t> placeOfView(const Project& project, std::string_view name);
[[nodiscard]] Result<std::size_t> placeOfNode(const Project& project, NodeId id);
[[nodiscard]] Result<std::size_t> placeOfStem(const Project& project, StemId id);

/// Whether a new node or stem may have this id.
[[nodiscard]] Result<void> checkNewNode(const Project& project, NodeId id);
[[nodiscard]] Result<void> checkNewStem(const Project& project, StemId id);

/// Takes nodes out of the leaves that name them; `stem` alone, or every stem. Leaves whose nodes are all gone go too.
void forgetLeafNodes(Project& project, const std::set<NodeId>& nodes, std::optional<StemId> stem);
/// Takes away stems and their leaves.
void eraseStems(Project& project, const std::set<StemId>& stems);

// ---- one function a command ------------------------------------------------------------------------------------------

[[nodiscard]] Result<Project> after(Project project, const SetName& command);
[[nodiscard]] Result<Project> after(Project project, const SetDescription& command);
[[nodiscard]] Result<Project> after(Project project, const SetSeed& command);
[[nodiscard]] Result<Project> after(Project project, const SetUnit& command);
[[nodiscard]] Result<Project> after(Project project, const AcceptTrait& command);
[[nodiscard]] Result<Project> after(Project project, const ChangeTrait& command);
[[nodiscard]] Result<Project> after(Project project, const ChangeTraitRange& command);
[[nodiscard]] Result<Project> after(Project project, const RejectTrait& command);
[[nodiscard]] Result<Project> after(Project project, const ForgetTrait& command);
[[nodiscard]] Result<Project> after(Project project, const AddView& command);
[[nodiscard]] Result<Project> after(Project project, const RemoveView& command);
[[nodiscard]] Result<Project> after(Project project, const RenameView& command);
[[nodiscard]] Result<Project> after(Project project, const SwapViews& command);
[[nodiscard]] Result<Project> after(Project project, const RelinkPhoto& command);
[[nodiscard]] Result<Project> after(Project project, const SetPhotoSize& command);
[[nodiscard]] Result<Project> after(Project project, const SetCamera& command);
[[nodiscard]] Result<Project> after(Project project, const SetCameraModel& command);
[[nodiscard]] Result<Project> after(Project project, const SetFocal& command);
[[nodiscard]] Result<Project> after(Project project, const ClearFocal& command);
[[nodiscard]] Result<Project> after(Project project, const SetOrigin& command);
[[nodiscard]] Result<Project> after(Project project, const ClearOrigin& command);
[[nodiscard]] Result<Project> after(Project project, const SetScale& command);
[[nodiscard]] Result<Project> after(Project project, const ClearScale& command);
[[nodiscard]] Result<Project> after(Project project, const AddNode& command);
[[nodiscard]] Result<Project> after(Project project, const RemoveNodes& command);
[[nodiscard]] Result<Project> after(Project project, const AddClick& command);
[[nodiscard]] Result<Project> after(Project project, const PlaceClick& command);
[[nodiscard]] Result<Project> after(Project project, const MoveClick& command);
[[nodiscard]] Result<Project> after(Project project, const RemoveClick& command);
[[nodiscard]] Result<Project> after(Project project, const SetRadius& command);
[[nodiscard]] Result<Project> after(Project project, const ClearRadius& command);
[[nodiscard]] Result<Project> after(Project project, const AddStem& command);
[[nodiscard]] Result<Project> after(Project project, const StartBranch& command);
[[nodiscard]] Result<Project> after(Project project, const AppendNode& command);
[[nodiscard]] Result<Project> after(Project project, const InsertNode& command);
[[nodiscard]] Result<Project> after(Project project, const RemoveFromStem& command);
[[nodiscard]] Result<Project> after(Project project, const AttachStem& command);
[[nodiscard]] Result<Project> after(Project project, const SplitStem& command);
[[nodiscard]] Result<Project> after(Project project, const JoinStems& command);
[[nodiscard]] Result<Project> after(Project project, const ReverseStem& command);
[[nodiscard]] Result<Project> after(Project project, const RemoveStem& command);
[[nodiscard]] Result<Project> after(Project project, const AddLeaves& command);
[[nodiscard]] Result<Project> after(Project project, const ChangeLeaves& command);
[[nodiscard]] Result<Project> after(Project project, const RemoveLeaves& command);
[[nodiscard]] Result<Project> after(Project project, const CopyLeaves& command);

}  // namespace axil::document
