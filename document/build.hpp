#pragma once
/// \file
/// Build: everything that follows from a project, in one folder. Nothing is written until all of it is made.

#include "document/chain.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace axil::document {

enum class Video { None, Mp4 };

struct BuildOptions {
  ChainOptions chain = {};
  int frames = 6;              ///< growth pictures
  Video video = Video::None;
  int width = 720;             ///< of the pictures, px
  int height = 960;
};

/// What a build found out, also in report.json. Lengths in the project's unit.
struct BuildReport {
  std::string name;
  std::string unit;
  std::size_t nodes = 0;
  std::size_t stems = 0;
  std::size_t segments = 0;
  std::size_t leaves = 0;
  double height = 0;
  double worstReprojection_px = 0;
  double worstRegrown = 0;              ///< largest distance of a regrown node from where the skeleton has it
  std::vector<skeleton3d::SuspectClick> suspects;  ///< left out, since no camera explains them
  std::vector<std::string> notes;       ///< what is not as a user may expect, a sentence each
  std::vector<std::string> files;       ///< written, relative to the folder, in the order they were made
};

/// Writes skeleton.json, stems.csv, statistics.json, layers.png, {initial,predictive,structured}.simeco, plant.png, predicted.png, growth/, plant.glb and
/// report.json into `folder`. Fails without a trace in `folder`.
[[nodiscard]] Result<BuildReport> build(const OpenProject& open, const std::filesystem::path& folder, const BuildOptions& options);

}  // namespace axil::document
