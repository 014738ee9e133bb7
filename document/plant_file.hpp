#pragma once
/// \file
/// A measured plant from a file: a project (.axil), whose clicks are solved, or a skeleton file (.json), as `axil skeleton` and
/// `axil grow -o plant.json` write it. Both become Measurements.

#include "document/chain.hpp"

#include <filesystem>
#include <string>
#include <string_view>

namespace axil::document {

/// Reads skeleton.json text. Fails with BadInput and lists every fault with the path of the value it is about.
[[nodiscard]] Result<skeleton3d::Skeleton> parseSkeleton(std::string_view text);

struct PlantFile {
  std::string name;                       ///< of the project, or the file's name without its ending
  skeleton3d::Skeleton skeleton;
  quantify::Measurements measurements;
};
/// Fails as loading and measuring do, naming the file.
[[nodiscard]] Result<PlantFile> readPlant(const std::filesystem::path& file, const ChainOptions& options = {});

}  // namespace axil::document
