#pragma once
/// \file
/// Photo files: JPEG, PNG, WebP and BMP, decoded by OpenCV, turned upright as their EXIF orientation says. So sizes and
/// pixels are always those a person sees when they click: x right, y down, the first pixel's centre at (0.5, 0.5).
///
/// Fails with NotFound or Unreadable (no such file, a folder, no permission, no image, cut off, an empty picture) and with
/// LimitReached (`kMaxPhotoPixels`, files above 1 GiB); every message names the file.

#include "base/result.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

namespace axil::skeleton3d {

inline constexpr std::int64_t kMaxPhotoPixels = 200'000'000;

/// What a photo file says of itself, without its pixels.
struct PhotoInfo {
  int width = 0;  ///< px, upright
  int height = 0;
  /// Focal length in pixels of the upright picture, from EXIF: the lens' millimetres over the sensor's pixel size where
  /// both are given, else from the 35 mm equivalent (by diagonal: 43.27 mm). Good to some percent.
  std::optional<double> exif_focal_px = std::nullopt;

  friend bool operator==(const PhotoInfo&, const PhotoInfo&) = default;
};

struct Photo {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;  ///< 3 bytes a pixel, row by row from the top
};

/// Size and EXIF of a photo; also notices a file that is cut off. Does not decode, so it takes the time of reading the file.
[[nodiscard]] Result<PhotoInfo> probePhoto(const std::filesystem::path& path);

[[nodiscard]] Result<Photo> readPhoto(const std::filesystem::path& path);

}  // namespace axil::skeleton3d
