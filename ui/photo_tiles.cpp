#include "ui/photo_tiles.hpp"

#include <algorithm>
#include <cmath>

namespace axil::ui {
namespace {

using skeleton3d::Photo;

/// Each pixel the mean of four; an odd last row or column is left out.
Photo half(const Photo& photo) {
  Photo small{std::max(1, photo.width / 2), std::max(1, photo.height / 2), {}};
  small.rgb.resize(static_cast<std::size_t>(small.width) * static_cast<std::size_t>(small.height) * 3);
  const std::size_t stride = static_cast<std::size_t>(photo.width) * 3;
  const std::size_t right = photo.width > 1 ? 3 : 0, below = photo.height > 1 ? stride : 0;
  std::uint8_t* out = small.rgb.data();
  for (int y = 0; y < small.height; ++y) {
    const std::uint8_t* in = &photo.rgb[static_cast<std::size_t>(2 * y) * (photo.height > 1 ? stride : 0)];
    for (int x = 0; x < small.width; ++x, in += 6)
      for (std::size_t c = 0; c < 3; ++c) *out++ = static_cast<std::uint8_t>((in[c] + in[c + right] + in[c + below] + in[c + right + below] + 2) / 4);
  }
  return small;
}

}  // namespace

std::vector<Photo> photoLevels(Photo photo) {
  std::vector<Photo> levels;
  levels.push_back(std::move(photo));
  while (std::max(levels.back().width, levels.back().height) > PhotoTiles::kTile) levels.push_back(half(levels.back()));
  return levels;
}

std::array<std::uint8_t, 256> lookTable(PhotoLook look) {
  std::array<std::uint8_t, 256> table{};
  for (int value = 0; value < 256; ++value) {
    const float shown = (static_cast<float>(value) - 127.5f) * look.contrast + 127.5f + 255 * look.brightness;
    table[static_cast<std::size_t>(value)] = static_cast<std::uint8_t>(std::clamp(std::lround(shown), 0L, 255L));
  }
  return table;
}

void PhotoTiles::send(Place place, Tile& tile) {
  const Photo& level = (*levels_)[static_cast<std::size_t>(place.level)];
  const int left = place.column * kTile, top = place.row * kTile;
  const int width = std::min(kTile, level.width - left), height = std::min(kTile, level.height - top);
  // One pixel of the neighbours around each tile: no seam where it is stretched.
  std::vector<std::uint8_t> rgb(static_cast<std::size_t>(width + 2) * static_cast<std::size_t>(height + 2) * 3);
  const auto table = lookTable(look_);
  std::uint8_t* out = rgb.data();
  for (int y = -1; y <= height; ++y) {
    const std::uint8_t* row = &level.rgb[static_cast<std::size_t>(std::clamp(top + y, 0, level.height - 1)) * static_cast<std::size_t>(level.width) * 3];
    for (int x = -1; x <= width; ++x) {
      const std::uint8_t* in = row + static_cast<std::ptrdiff_t>(std::clamp(left + x, 0, level.width - 1)) * 3;
      for (int c = 0; c < 3; ++c) *out++ = table[in[c]];
    }
  }
  tile.texture.set(width + 2, height + 2, rgb);
}

void PhotoTiles::forgetOldest() {
  while (tiles_.size() > kMostKept) {
    const auto oldest = std::min_element(tiles_.begin(), tiles_.end(), [](const auto& a, const auto& b) { return a.second.used < b.second.used; });
    tiles_.erase(oldest);
  }
}

const PhotoTiles::Tile* PhotoTiles::tile(Place place, double zoom) {
  auto found = tiles_.find(place);
  if (found == tiles_.end()) {
    // The smallest level never waits.
    if (toSend_ <= 0 && place.level + 1 < static_cast<int>(levels_->size())) {
      waiting_ = true;
      return nullptr;
    }
    --toSend_;
    found = tiles_.emplace(place, Tile{}).first;
    send(place, found->second);
  }
  found->second.used = ++clock_;
  constexpr double kPixelsShow = 3;  // from here on a photo's pixels are seen as such, to be clicked exactly
  found->second.texture.magnify(zoom > kPixelsShow ? Texture::Magnified::Pixels : Texture::Magnified::Smooth);
  return &found->second;
}

PhotoTiles::Piece PhotoTiles::pieceOf(Place place, const Tile& tile) {
  const double scale = std::exp2(place.level);  // photo px a px of the level
  const glm::dvec2 low(place.column * kTile, place.row * kTile);
  const glm::dvec2 inside(tile.texture.width() - 2, tile.texture.height() - 2);
  const glm::vec2 pixel = 1.0f / glm::vec2(tile.texture.width(), tile.texture.height());
  return {tile.texture.id(), low * scale, (low + inside) * scale, pixel, 1.0f - pixel};
}

std::vector<PhotoTiles::Piece> PhotoTiles::pieces(glm::dvec2 low, glm::dvec2 high, double zoom, PhotoLook look) {
  std::vector<Piece> pieces;
  if (levels_->empty()) return pieces;
  if (look != look_) {
    tiles_.clear();
    look_ = look;
  }
  const int last = static_cast<int>(levels_->size()) - 1;
  const int level = std::clamp(static_cast<int>(std::floor(std::log2(1 / std::max(zoom, 1e-6)))), 0, last);
  const Photo& shown = (*levels_)[static_cast<std::size_t>(level)];
  const double scale = std::exp2(level);
  const auto first = [&](double px) { return std::max(0, static_cast<int>(std::floor(px / scale / kTile))); };
  const auto final = [&](double px, int side) { return std::min((side - 1) / kTile, static_cast<int>(std::floor(px / scale / kTile))); };
  bool gaps = false;
  for (int row = first(low.y); row <= final(high.y, shown.height); ++row)
    for (int column = first(low.x); column <= final(high.x, shown.width); ++column) {
      const Tile* here = tile({level, column, row}, zoom);
      if (here != nullptr) pieces.push_back(pieceOf({level, column, row}, *here));
      gaps = gaps || here == nullptr;
    }
  // The smallest level stands in for what is missing, and only then: in software every pixel drawn twice costs twice.
  if (const Tile* base = tile({last, 0, 0}, zoom); gaps && base != nullptr) pieces.insert(pieces.begin(), pieceOf({last, 0, 0}, *base));
  forgetOldest();
  return pieces;
}

}  // namespace axil::ui
