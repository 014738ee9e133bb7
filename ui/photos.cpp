#include "ui/photos.hpp"

#include "document/chain.hpp"

#include <algorithm>

namespace axil::ui {
namespace {

std::filesystem::file_time_type changeOf(const std::filesystem::path& file) {
  std::error_code none;
  return std::filesystem::last_write_time(file, none);
}

}  // namespace

Photos::Photos(std::function<void()> answered) : reader_([] { return [](const std::filesystem::path& file) { return read(file); }; }, std::move(answered)) {}

Photos::Read Photos::read(const std::filesystem::path& file) {
  auto photo = skeleton3d::readPhoto(file);
  if (!photo) return {file, {}, photo.error()};
  return {file, photoLevels(std::move(*photo)), std::nullopt};
}

void Photos::take(Read read) {
  ShownPhoto& shown = photos_[read.file];
  shown.trouble = read.trouble;
  shown.changed = changeOf(read.file);
  if (read.levels.empty()) return;
  shown.size_px = {read.levels.front().width, read.levels.front().height};
  shown.tiles = std::make_unique<PhotoTiles>(std::move(read.levels));
}

void Photos::update(const document::OpenProject& open) {
  if (auto read = reader_.take()) take(std::move(*read));
  for (auto& [file, shown] : photos_)
    if (shown.tiles) shown.tiles->beginFrame();
  waiting_ = false;
  for (const document::ProjectView& view : open.project.views) {
    if (view.photo.empty()) continue;
    const std::filesystem::path file = document::photoPath(open, view);
    const auto known = photos_.find(file);
    if (known != photos_.end() && known->second.changed == changeOf(file)) continue;
    waiting_ = true;
    if (!reader_.working()) reader_.ask(file);
    return;
  }
}

bool Photos::busy() const {
  const bool sending = std::any_of(photos_.begin(), photos_.end(), [](const auto& photo) { return photo.second.tiles && photo.second.tiles->waiting(); });
  return reader_.busy() || waiting_ || sending;
}

const ShownPhoto* Photos::find(const std::filesystem::path& file) const {
  const auto photo = photos_.find(file);
  return photo == photos_.end() ? nullptr : &photo->second;
}

std::shared_ptr<const skeleton3d::Photo> Photos::photoOf(const document::OpenProject& open, const document::ProjectView& view) const {
  const ShownPhoto* shown = view.photo.empty() ? nullptr : find(document::photoPath(open, view));
  return shown == nullptr || !shown->tiles ? nullptr : shown->tiles->sharedPhoto();
}

}  // namespace axil::ui
