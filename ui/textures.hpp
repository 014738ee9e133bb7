#pragma once
/// \file
/// Pictures in the graphics memory. Belongs to the window's thread and its drawing context.

#include <cstdint>
#include <span>

namespace axil::ui {

/// A picture that can be shown; 0 x 0 until `set`.
class Texture {
 public:
  Texture() = default;
  Texture(const Texture&) = delete;
  Texture& operator=(const Texture&) = delete;
  Texture(Texture&& other) noexcept;
  Texture& operator=(Texture&& other) noexcept;
  ~Texture();

  /// Three bytes a pixel, rows from the top.
  void set(int width, int height, std::span<const std::uint8_t> rgb);

  [[nodiscard]] std::uint32_t id() const { return id_; }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  /// How it looks when it is larger than it is.
  enum class Magnified { Smooth, Pixels };
  void magnify(Magnified how) const;

 private:
  std::uint32_t id_ = 0;
  int width_ = 0;
  int height_ = 0;
};

}  // namespace axil::ui
