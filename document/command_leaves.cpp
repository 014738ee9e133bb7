#include "base/text.hpp"
#include "document/command_parts.hpp"
#include "keywords/keywords.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace axil::document {

using quantify::LeafArrangement;

namespace {

constexpr int kMaximumLeafNodes = 10'000;
constexpr double kMaximumLength = 1e6;

std::string listOf(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

Result<void> checkNames(const LeafArrangement& leaves) {
  if (!leaves.arrangement.empty() && !keywords::arrangementNamed(leaves.arrangement))
    return fail(ErrorCode::BadInput, "no leaf arrangement is called " + inQuotes(leaves.arrangement) + "; there are " + listOf(keywords::arrangementNames()));
  if (!leaves.shape.empty()) return checkName("the leaf's shape", leaves.shape);
  return {};
}

Result<void> checkAngles(const LeafArrangement& leaves) {
  if (leaves.angle)
    if (auto checked = checkNumber("the angle between stem and leaf, in degrees,", leaves.angle->degrees(), 0, 180); !checked) return checked;
  for (const auto& turn : {leaves.roll, leaves.azimuth})
    if (turn && !(std::abs(turn->radians()) <= 1000 * std::numbers::pi))
      return fail(ErrorCode::BadInput, "a leaf cannot be turned by " + shortest(turn->degrees()) + " degrees; keep to a few whole turns");
  return {};
}

Result<void> checkSizes(const LeafArrangement& leaves) {
  if (leaves.length && *leaves.length == 0) return fail(ErrorCode::BadInput, "the leaf's length must be above zero; leave it out for the description's");
  const std::pair<const char*, std::optional<double>> sizes[] = {{"the leaf's length", leaves.length}, {"the leaf's width", leaves.width}, {"the leaf stalk's length", leaves.petiole}};
  for (const auto& [what, size] : sizes)
    if (size)
      if (auto checked = checkNumber(what, *size, 0, kMaximumLength); !checked) return checked;
  return {};
}

Result<void> checkPlaces(const Project& project, const LeafArrangement& leaves) {
  const auto stem = placeOfStem(project, leaves.stem);
  if (!stem) return stem.failure();
  if (!leaves.nodes && leaves.at.empty()) return fail(ErrorCode::BadInput, "say how many leaf nodes there are (nodes=4), or which nodes carry leaves (at=2,3)");
  if (leaves.nodes && (*leaves.nodes < 1 || *leaves.nodes > kMaximumLeafNodes))
    return fail(ErrorCode::BadInput, std::to_string(*leaves.nodes) + " leaf nodes are not possible; give 1 to " + std::to_string(kMaximumLeafNodes));
  if (leaves.nodes && leaves.at.size() > 1 && static_cast<std::size_t>(*leaves.nodes) != leaves.at.size())
    return fail(ErrorCode::BadInput, std::to_string(*leaves.nodes) + " leaf nodes are wanted but " + std::to_string(leaves.at.size()) + " are listed; give one of the two");
  const auto& nodes = project.stems[*stem].stem.nodes;
  for (const NodeId node : leaves.at)
    if (std::find(nodes.begin(), nodes.end(), node) == nodes.end()) return fail(ErrorCode::NotFound, nameOf(leaves.stem) + " has no " + nameOf(node));
  return {};
}

Result<void> checkLeaves(const Project& project, const LeafArrangement& leaves) {
  if (auto checked = checkPlaces(project, leaves); !checked) return checked;
  if (auto checked = checkNames(leaves); !checked) return checked;
  if (auto checked = checkAngles(leaves); !checked) return checked;
  return checkSizes(leaves);
}

Result<std::size_t> placeOfLeaves(const Project& project, int number) {
  if (number >= 1 && static_cast<std::size_t>(number) <= project.leaves.size()) return static_cast<std::size_t>(number - 1);
  return fail(ErrorCode::NotFound, "there are no leaves number " + std::to_string(number) + "; the list has " + std::to_string(project.leaves.size()));
}

/// The same leaves for another stem: nodes that it does not have become a count.
LeafArrangement forStem(LeafArrangement leaves, StemId stem) {
  if (!leaves.nodes) leaves.nodes = static_cast<int>(leaves.at.size());
  leaves.at.clear();
  leaves.stem = stem;
  return leaves;
}

Result<Project> withLeaves(Project project, ProjectLeaves leaves) {
  if (auto checked = checkLeaves(project, leaves.arrangement); !checked) return checked.failure();
  if (project.leaves.size() >= kMaximumLeaves)
    return fail(ErrorCode::LimitReached, "a project has at most " + std::to_string(kMaximumLeaves) + " leaf arrangements");
  project.leaves.push_back(std::move(leaves));
  return project;
}

}  // namespace

Result<Project> after(Project project, const AddLeaves& command) { return withLeaves(std::move(project), ProjectLeaves{command.leaves, {}}); }

Result<Project> after(Project project, const ChangeLeaves& command) {
  const auto at = placeOfLeaves(project, command.number);
  if (!at) return at.failure();
  if (auto checked = checkLeaves(project, command.leaves); !checked) return checked.failure();
  project.leaves.set(*at, ProjectLeaves{command.leaves, project.leaves[*at].extras});
  return project;
}

Result<Project> after(Project project, const RemoveLeaves& command) {
  const auto at = placeOfLeaves(project, command.number);
  if (!at) return at.failure();
  project.leaves.erase(*at);
  return project;
}

Result<Project> after(Project project, const CopyLeaves& command) {
  const auto at = placeOfLeaves(project, command.number);
  if (!at) return at.failure();
  if (command.stems.empty()) return fail(ErrorCode::BadInput, "no stem is named; choose the stems that get the same leaves");
  const ProjectLeaves original = project.leaves[*at];
  for (const StemId stem : command.stems) {
    const ProjectLeaves copy{forStem(original.arrangement, stem), original.extras};
    const bool there = stem == original.arrangement.stem ||
                       std::any_of(project.leaves.begin(), project.leaves.end(), [&](const ProjectLeaves& l) { return l.arrangement == copy.arrangement; });
    if (there) return fail(ErrorCode::BadInput, nameOf(stem) + " has these leaves already");
    auto with = withLeaves(std::move(project), copy);
    if (!with) return with;
    project = std::move(*with);
  }
  return project;
}

}  // namespace axil::document
