#pragma once
/// \file
/// One file of what is shown: a picture, a video, a mesh, or a grammar in any dialect; the file's ending says which. Written in the
/// background, aside and then renamed.

#include "simeco/growth.hpp"
#include "skeleton3d/types.hpp"
#include "ui/worker.hpp"

#include <filesystem>
#include <string>

namespace axil::ui {

struct FileQuestion {
  std::filesystem::path file;
  std::string text;               ///< the grammar shown
  std::optional<simeco::Growth> growth;
  double time = 0;
  double end = 0;
  skeleton3d::Camera camera;      ///< of a picture or video
  glm::ivec2 size_px{0, 0};
  std::string unit = "m";
};

struct FileAnswer {
  std::filesystem::path file;
  Result<void> written = {};
};

using FileWriter = Worker<FileQuestion, FileAnswer>;
[[nodiscard]] FileWriter::Work fileWork();

/// Endings that can be written: ".png", ".mp4", ".webm", ".glb", ".obj", ".ply", ".simeco", ".l", ".lpy", ".mtg".
[[nodiscard]] bool canExport(const std::filesystem::path& file);

}  // namespace axil::ui
