#pragma once
/// \file
/// The project's photos, ready to be shown. They are read in the background, one after another; a photo that cannot be read says why.

#include "document/project.hpp"
#include "skeleton3d/photo.hpp"
#include "ui/photo_tiles.hpp"
#include "ui/worker.hpp"

#include <filesystem>
#include <map>
#include <memory>
#include <optional>

namespace axil::ui {

struct ShownPhoto {
  std::unique_ptr<PhotoTiles> tiles;  ///< null while there is nothing to show
  glm::ivec2 size_px{0, 0};
  std::optional<Error> trouble;
  std::filesystem::file_time_type changed;
};

class Photos {
 public:
  explicit Photos(std::function<void()> answered);

  /// Asks for what is named by the project and not here yet; takes what has come. Once a frame.
  void update(const document::OpenProject& open);
  /// Null while it is being read.
  [[nodiscard]] const ShownPhoto* find(const std::filesystem::path& file) const;
  /// The pixels of a view's photo, for work in the background; null while it is being read or where there is none.
  [[nodiscard]] std::shared_ptr<const skeleton3d::Photo> photoOf(const document::OpenProject& open, const document::ProjectView& view) const;
  [[nodiscard]] bool busy() const;

 private:
  struct Read {
    std::filesystem::path file;
    std::vector<skeleton3d::Photo> levels;  ///< of the photo; empty where it cannot be read
    std::optional<Error> trouble;
  };
  static Read read(const std::filesystem::path& file);
  void take(Read read);

  std::map<std::filesystem::path, ShownPhoto> photos_;
  bool waiting_ = false;
  Worker<std::filesystem::path, Read> reader_;
};

}  // namespace axil::ui
