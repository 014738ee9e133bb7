#pragma once
/// \file
/// The rendered plants of ../shared/data/plants as clicked projects with known truth, made as to_project.py there makes
/// them: stems share a node where a branch leaves its parent; clicks are rounded to 0.001 px.

#include "skeleton3d/types.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace axil::test {

struct PlantCase {
  std::string name;
  double height_m = 0;
  std::vector<skeleton3d::View> views;  ///< front, right, top
  std::map<std::string, skeleton3d::UnknownCameraHints> hints;
  std::vector<skeleton3d::ClickedNode> nodes;
  std::vector<skeleton3d::ClickedStem> stems;
  std::vector<PlantPoint> truth;  ///< of nodes[i]
};

struct PlantCaseOptions {
  std::string cameras = "persp";  ///< ortho, persp or handheld
  double noise_px = 0;            ///< standard deviation of the clicks
  std::uint64_t seed = 1;
  int every = 1;                  ///< keep every n-th node of a branch; ends and branching points always
  double wrongShare = 0;          ///< of the clicks, off by 20 to 80 px
  bool known = true;              ///< false: model Unknown, focal length given for perspective cameras, `hints` filled
  bool radius = false;
};

/// The folders of the cases, sorted; empty where ../shared is missing.
[[nodiscard]] std::vector<std::filesystem::path> plantCaseFolders();

[[nodiscard]] PlantCase readPlantCase(const std::filesystem::path& folder, const PlantCaseOptions& options = {});

}  // namespace axil::test
