#pragma once
/// \file
/// Project: what a user said about one plant, as one value: photos and cameras, clicks, stems, leaves, the description.
/// Everything else (skeleton, numbers, grammars, pictures) is derived from it and never saved as truth.
///
/// Frames and units are those of docs/files.md: clicks in px of their photo, lengths in `unit`. Keys of the file that this
/// program does not know are kept in `Extras`, object by object, and written back.

#include "base/result.hpp"
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

/// A length the user knows, clicked in a photo.
struct KnownLength {
  PhotoPoint from;
  PhotoPoint to;
  double length = 0;
  friend bool operator==(const KnownLength&, const KnownLength&) = default;
};

struct ProjectView {
  skeleton3d::View view;                ///< name, camera, size in px (0, 0 where the file does not say)
  std::string photo;                    ///< path, relative to the project's folder or absolute; empty: no photo
  std::optional<PhotoPoint> origin_px;  ///< where the plant's collar is seen
  std::optional<KnownLength> scale;
  Extras extras;
  Extras cameraExtras;
};

struct ProjectNode {
  skeleton3d::ClickedNode node;
  Extras extras;
};

struct ProjectStem {
  skeleton3d::ClickedStem stem;
  Extras extras;
};

struct ProjectLeaves {
  quantify::LeafArrangement arrangement;
  Extras extras;
};

struct Project {
  std::string name = "plant";
  std::string unit = "m";
  std::uint64_t seed = 1;
  std::string description;
  std::vector<ProjectView> views;
  std::vector<ProjectNode> nodes;
  std::vector<ProjectStem> stems;
  std::vector<ProjectLeaves> leaves;
  Extras extras;
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
