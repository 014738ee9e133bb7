#pragma once
/// \file
/// Private to skeleton3d: what stands at the beginning (and end) of an image file, read without decoding it. Any bytes may
/// come in; nothing is read beyond them.

#include <optional>
#include <string>
#include <string_view>

namespace axil::skeleton3d::detail {

/// The EXIF numbers that measuring needs; 0 where they are not given.
struct Exif {
  int orientation = 1;               ///< 1 to 8, as the EXIF standard numbers them
  double focal_mm = 0;               ///< FocalLength
  double focal35_mm = 0;             ///< FocalLengthIn35mmFilm
  double sensor_px_per_mm = 0;       ///< FocalPlaneXResolution, in the unit it names
  double originalWidth_px = 0;       ///< PixelXDimension: the width for which the sensor's resolution holds
};

struct PhotoHeader {
  int width = 0;  ///< as stored, before the orientation is honoured
  int height = 0;
  Exif exif = {};
};

/// Either the header or, in `fault`, what is wrong with the file ("is cut off").
struct HeaderReading {
  std::optional<PhotoHeader> header = std::nullopt;
  std::string fault = {};
};

[[nodiscard]] HeaderReading readPhotoHeader(std::string_view bytes);

}  // namespace axil::skeleton3d::detail
