#include "ui/photos.hpp"

#include "document/chain.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace axil::ui {
namespace {

/// Every second pixel of every second row: what a machine with small textures gets to see.
void halve(skeleton3d::Photo& photo) {
  const int width = photo.width / 2, height = photo.height / 2;
  std::vector<std::uint8_t> rgb(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const std::size_t from = (static_cast<std::size_t>(2 * y) * static_cast<std::size_t>(photo.width) + static_cast<std::size_t>(2 * x)) * 3;
      std::copy_n(photo.rgb.begin() + static_cast<std::ptrdiff_t>(from), 3,
                  rgb.begin() + static_cast<std::ptrdiff_t>((static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) * 3));
    }
  photo = {width, height, std::move(rgb)};
}

std::filesystem::file_time_type changeOf(const std::filesystem::path& file) {
  std::error_code none;
  return std::filesystem::last_write_time(file, none);
}

}  // namespace

Photos::Photos(std::function<void()> answered) : reader_([] { return [](const std::filesystem::path& file) { return read(file); }; }, std::move(answered)) {}

Photos::Read Photos::read(const std::filesystem::path& file) {
  auto photo = skeleton3d::readPhoto(file);
  if (!photo) return {file, std::nullopt, photo.error()};
  return {file, std::move(*photo), std::nullopt};
}

void Photos::take(Read read) {
  ShownPhoto& shown = photos_[read.file];
  shown.trouble = read.trouble;
  shown.changed = changeOf(read.file);
  if (!read.photo) return;
  shown.size_px = {read.photo->width, read.photo->height};
  while (std::max(read.photo->width, read.photo->height) > largestTexture()) halve(*read.photo);
  shown.texture.set(read.photo->width, read.photo->height, read.photo->rgb, Texture::Smaller::Versions);
}

void Photos::update(const document::OpenProject& open) {
  if (auto read = reader_.take()) take(std::move(*read));
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

const ShownPhoto* Photos::find(const std::filesystem::path& file) const {
  const auto photo = photos_.find(file);
  return photo == photos_.end() ? nullptr : &photo->second;
}

}  // namespace axil::ui
