#pragma once
/// \file
/// PhotoTiles: a photo of any size as small textures. The photo is kept with its halves, quarters and so on (each pixel the mean of four),
/// and only the tiles that the pane shows, of the level that fits its zoom, are sent to the graphics memory: a few a frame, so that a
/// 24-megapixel photo never holds a frame up. Until they are there, the smallest level stands in. Brightness and contrast are worked into
/// tiles as they are sent; the photo stays as it is.

#include "skeleton3d/photo.hpp"
#include "ui/state.hpp"
#include "ui/textures.hpp"

#include <array>
#include <compare>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

namespace axil::ui {

/// The photo first, each further level half as large, down to one tile.
[[nodiscard]] std::vector<skeleton3d::Photo> photoLevels(skeleton3d::Photo photo);

/// What a brightness and a contrast make of each of the 256 values.
[[nodiscard]] std::array<std::uint8_t, 256> lookTable(PhotoLook look);

class PhotoTiles {
 public:
  static constexpr int kTile = 512;          ///< side of a tile, px of its level
  static constexpr int kSentAFrame = 6;
  static constexpr std::size_t kMostKept = 160;

  explicit PhotoTiles(std::vector<skeleton3d::Photo> levels) : levels_(std::make_shared<const std::vector<skeleton3d::Photo>>(std::move(levels))) {}

  /// A tile as it is to be drawn: from `low` to `high` in px of the photo; the texture's part in shares of it.
  struct Piece {
    std::uint32_t texture = 0;
    glm::dvec2 low{0, 0}, high{0, 0};
    glm::vec2 from{0, 0}, to{1, 1};
  };
  /// What covers the photo from `low` to `high` at `zoom` screen px a photo px, in the order to be drawn. Sends what is missing, at most
  /// kSentAFrame tiles a call of `beginFrame`; pieces lie over each other only where tiles are missing.
  [[nodiscard]] std::vector<Piece> pieces(glm::dvec2 low, glm::dvec2 high, double zoom, PhotoLook look);
  [[nodiscard]] const skeleton3d::Photo& photo() const { return levels_->front(); }
  /// The same, for work in the background.
  [[nodiscard]] std::shared_ptr<const skeleton3d::Photo> sharedPhoto() const { return {levels_, &levels_->front()}; }
  void beginFrame() {
    toSend_ = kSentAFrame;
    waiting_ = false;
  }
  /// Something shown has still to be sent.
  [[nodiscard]] bool waiting() const { return waiting_; }
  [[nodiscard]] std::size_t kept() const { return tiles_.size(); }

 private:
  struct Place {
    int level = 0, column = 0, row = 0;
    friend auto operator<=>(const Place&, const Place&) = default;
  };
  struct Tile {
    Texture texture;
    std::uint64_t used = 0;
  };
  const Tile* tile(Place place, double zoom);
  void send(Place place, Tile& tile);
  void forgetOldest();
  [[nodiscard]] static Piece pieceOf(Place place, const Tile& tile);

  std::shared_ptr<const std::vector<skeleton3d::Photo>> levels_;
  std::map<Place, Tile> tiles_;
  PhotoLook look_;
  std::uint64_t clock_ = 0;
  int toSend_ = kSentAFrame;
  bool waiting_ = false;
};

}  // namespace axil::ui
