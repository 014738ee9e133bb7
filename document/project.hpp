#pragma once
/// \file
/// Project: what a user said about one plant, as one value: photos and cameras, clicks, stems, leaves, the description.
/// Everything else (skeleton, numbers, grammars, pictures) is derived from it and never saved as truth.
///
/// Frames and units are those of docs/files.md: clicks in px of their photo, lengths in `unit`. Keys of the file that this
/// program does not know are kept in `Extras`, object by object, and written back. Projects are copied freely: a copy shares
/// what it has in common with its original (document/shared_list.hpp).

#include "base/result.hpp"
#include "document/shared_list.hpp"
#include "quantify/leaves.hpp"
#include "skeleton3d/skeleton3d.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace axil::document {

/// Keys of a JSON object that the program does not know, each with its value as JSON text.
using Extras = std::map<std::string, std::string>;

struct ProjectView {
  skeleton3d::View view;                ///< name, camera, size in px (0, 0 where the file does not say)
  std::string photo;                    ///< path, relative to the project's folder or absolute; empty: no photo
  std::optional<PhotoPoint> origin_px;  ///< where the plant's collar is seen
  std::optional<skeleton3d::KnownLength> scale;
  Extras extras;
  Extras cameraExtras;
  friend bool operator==(const ProjectView&, const ProjectView&) = default;
};

struct ProjectNode {
  skeleton3d::ClickedNode node;
  Extras extras;
  friend bool operator==(const ProjectNode&, const ProjectNode&) = default;
};

struct ProjectStem {
  skeleton3d::ClickedStem stem;
  Extras extras;
  friend bool operator==(const ProjectStem&, const ProjectStem&) = default;
};

struct ProjectLeaves {
  quantify::LeafArrangement arrangement;
  Extras extras;
  friend bool operator==(const ProjectLeaves&, const ProjectLeaves&) = default;
};

/// What the user decided about a fact that the description states, or a fact of the user's own.
enum class Verdict {
  Accepted,  ///< as the description says
  Changed,   ///< `value`, or `low` to `high`, instead
  Rejected,  ///< as if the description did not say it
};

/// One decision. It belongs to every fact of the description with this organ, property and words, so it survives changes to
/// the text around them. Without words it is the user's own fact, which stands for all that the text says of that property.
struct ProjectTrait {
  std::string organ;
  std::string property;
  std::string words;
  Verdict verdict = Verdict::Accepted;
  std::string value;           ///< Changed: the concept's name, or empty where `low` and `high` are given
  std::optional<double> low;
  std::optional<double> high;
  std::string unit;            ///< of `low` and `high`
  Extras extras;
  friend bool operator==(const ProjectTrait&, const ProjectTrait&) = default;
};

struct Project {
  std::string name = "plant";
  std::string unit = "m";
  std::uint64_t seed = 1;
  SharedText description;
  SharedList<ProjectTrait> traits;
  SharedList<ProjectView> views;
  SharedList<ProjectNode> nodes;
  SharedList<ProjectStem> stems;
  SharedList<ProjectLeaves> leaves;
  Extras extras;
  friend bool operator==(const Project&, const Project&) = default;
};

/// A project with the folder its photo paths are relative to.
struct OpenProject {
  Project project;
  std::filesystem::path folder;
};

/// Reads a project's JSON text. All that is wrong with it is one Error: broken JSON with its line, else one detail a wrong
/// value, named like `nodes[3].clicks.front[1]`.
[[nodiscard]] Result<Project> parseProject(std::string_view json);
/// The project as JSON text; parseProject reads it back as the same value.
[[nodiscard]] std::string projectText(const Project& project);

[[nodiscard]] Result<OpenProject> loadProject(const std::filesystem::path& path);
[[nodiscard]] Result<void> saveProject(const Project& project, const std::filesystem::path& path);

}  // namespace axil::document
