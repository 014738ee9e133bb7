#include "skeleton3d/photo_header.hpp"

#include <cmath>
#include <cstdint>

namespace axil::skeleton3d::detail {
namespace {

enum class ByteOrder { Little, Big };

/// Numbers out of bytes; past the end they are 0 and `holds` says so beforehand.
class Bytes {
 public:
  Bytes(std::string_view text, ByteOrder order) : text_(text), order_(order) {}

  [[nodiscard]] bool holds(std::size_t at, std::size_t count) const { return at <= text_.size() && count <= text_.size() - at; }
  [[nodiscard]] std::uint32_t number(std::size_t at, std::size_t count) const {
    if (!holds(at, count)) return 0;
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t from = order_ == ByteOrder::Big ? at + i : at + count - 1 - i;
      value = value << 8 | static_cast<unsigned char>(text_[from]);
    }
    return value;
  }
  [[nodiscard]] std::uint32_t u8(std::size_t at) const { return number(at, 1); }
  [[nodiscard]] std::uint32_t u16(std::size_t at) const { return number(at, 2); }
  [[nodiscard]] std::uint32_t u32(std::size_t at) const { return number(at, 4); }

 private:
  std::string_view text_;
  ByteOrder order_;
};

/// One entry of a TIFF directory: a SHORT, a LONG or a RATIONAL; 0 for anything else.
double valueOf(const Bytes& tiff, std::size_t entry) {
  switch (tiff.u16(entry + 2)) {
    case 3: return tiff.u16(entry + 8);
    case 4: return tiff.u32(entry + 8);
    case 5: {
      const std::size_t at = tiff.u32(entry + 8);
      const double below = tiff.u32(at + 4);
      return below > 0 ? tiff.u32(at) / below : 0;
    }
    default: return 0;
  }
}

struct ExifReading {
  Exif exif = {};
  std::size_t subDirectory = 0;
  double planeResolution = 0;
  double planeUnit = 2;  // inches, unless the file says otherwise
};

void readDirectory(const Bytes& tiff, std::size_t at, ExifReading& reading) {
  const std::size_t count = tiff.u16(at);
  for (std::size_t i = 0; i < count && tiff.holds(at + 2 + 12 * i, 12); ++i) {
    const std::size_t entry = at + 2 + 12 * i;
    const double value = valueOf(tiff, entry);
    switch (tiff.u16(entry)) {
      case 0x0112: reading.exif.orientation = value >= 1 && value <= 8 ? static_cast<int>(value) : 1; break;
      case 0x8769: reading.subDirectory = static_cast<std::size_t>(value); break;
      case 0x920A: reading.exif.focal_mm = value; break;
      case 0xA405: reading.exif.focal35_mm = value; break;
      case 0xA20E: reading.planeResolution = value; break;
      case 0xA210: reading.planeUnit = value; break;
      case 0xA002: reading.exif.originalWidth_px = value; break;
      default: break;
    }
  }
}

double millimetresOf(double unit) { return unit == 3 ? 10.0 : unit == 4 ? 1.0 : 25.4; }

/// EXIF is a small TIFF file: byte order, 42, the place of the first directory.
Exif readExif(std::string_view text) {
  if (text.size() < 8 || (text.substr(0, 2) != "II" && text.substr(0, 2) != "MM")) return {};
  const Bytes tiff(text, text[0] == 'I' ? ByteOrder::Little : ByteOrder::Big);
  if (tiff.u16(2) != 42) return {};
  ExifReading reading;
  readDirectory(tiff, tiff.u32(4), reading);
  if (reading.subDirectory != 0) readDirectory(tiff, reading.subDirectory, reading);
  reading.exif.sensor_px_per_mm = reading.planeResolution / millimetresOf(reading.planeUnit);
  return reading.exif;
}

HeaderReading faulty(std::string why) { return {std::nullopt, std::move(why)}; }
HeaderReading cutOff() { return faulty("is cut off; copy it again from the camera"); }
HeaderReading good(PhotoHeader header) {
  if (header.width <= 0 || header.height <= 0) return faulty("has no pixels");
  return {header, {}};
}

bool isFrameHeader(std::uint32_t marker) { return marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC; }

/// Segments up to the first scan; then only the end marker is looked for (thumbnails with one of their own lie before it).
HeaderReading readJpeg(std::string_view text) {
  const Bytes file(text, ByteOrder::Big);
  PhotoHeader header;
  for (std::size_t at = 2; file.holds(at, 4);) {
    if (file.u8(at) != 0xFF) return faulty("is a damaged JPEG");
    const std::uint32_t marker = file.u8(at + 1);
    if (marker == 0xFF) {  // filling
      ++at;
      continue;
    }
    const std::size_t length = file.u16(at + 2);
    if (length < 2) return faulty("is a damaged JPEG");
    if (!file.holds(at + 2, length)) return cutOff();
    const std::string_view content = text.substr(at + 4, length - 2);
    if (isFrameHeader(marker)) {
      header.height = static_cast<int>(file.u16(at + 5));
      header.width = static_cast<int>(file.u16(at + 7));
    } else if (marker == 0xE1 && content.substr(0, 6) == std::string_view("Exif\0\0", 6)) {
      header.exif = readExif(content.substr(6));
    } else if (marker == 0xDA) {
      return text.find("\xFF\xD9", at + 2 + length) == std::string_view::npos ? cutOff() : good(header);
    }
    at += 2 + length;
  }
  return cutOff();
}

HeaderReading readPng(std::string_view text) {
  const Bytes file(text, ByteOrder::Big);
  PhotoHeader header;
  for (std::size_t at = 8; file.holds(at, 12);) {
    const std::size_t length = file.u32(at);
    const std::string_view kind = text.substr(at + 4, 4);
    if (!file.holds(at + 8, length) || !file.holds(at + 8 + length, 4)) return cutOff();
    if (kind == "IHDR" && file.u32(at + 8) <= INT32_MAX && file.u32(at + 12) <= INT32_MAX)
      header = {static_cast<int>(file.u32(at + 8)), static_cast<int>(file.u32(at + 12)), header.exif};
    if (kind == "eXIf") header.exif = readExif(text.substr(at + 8, length));
    if (kind == "IEND") return good(header);
    at += 12 + length;
  }
  return cutOff();
}

HeaderReading readWebp(std::string_view text) {
  const Bytes file(text, ByteOrder::Little);
  if (!file.holds(8, file.u32(4))) return cutOff();
  PhotoHeader header;
  for (std::size_t at = 12; file.holds(at, 8);) {
    const std::size_t length = file.u32(at + 4);
    const std::string_view kind = text.substr(at, 4);
    if (!file.holds(at + 8, length)) return cutOff();
    if (kind == "VP8X")
      header = {static_cast<int>(file.number(at + 12, 3)) + 1, static_cast<int>(file.number(at + 15, 3)) + 1, header.exif};
    else if (kind == "VP8 " && header.width == 0)
      header = {static_cast<int>(file.u16(at + 14) & 0x3FFF), static_cast<int>(file.u16(at + 16) & 0x3FFF), header.exif};
    else if (kind == "VP8L" && header.width == 0)
      header = {static_cast<int>(file.u32(at + 9) & 0x3FFF) + 1, static_cast<int>(file.u32(at + 9) >> 14 & 0x3FFF) + 1, header.exif};
    else if (kind == "EXIF")
      header.exif = readExif(text.substr(at + 8, 6) == std::string_view("Exif\0\0", 6) ? text.substr(at + 14, length - 6) : text.substr(at + 8, length));
    at += 8 + length + length % 2;
  }
  return good(header);
}

HeaderReading readBmp(std::string_view text) {
  const Bytes file(text, ByteOrder::Little);
  if (!file.holds(0, 26)) return cutOff();
  const auto width = static_cast<std::int32_t>(file.u32(18)), height = static_cast<std::int32_t>(file.u32(22));
  if (width == INT32_MIN || height == INT32_MIN) return faulty("has no pixels");
  if (!file.holds(0, file.u32(2))) return cutOff();
  return good({width, std::abs(height), {}});  // a negative height: rows from the top
}

}  // namespace

HeaderReading readPhotoHeader(std::string_view bytes) {
  if (bytes.empty()) return faulty("is empty");
  if (bytes.substr(0, 3) == "\xFF\xD8\xFF") return readJpeg(bytes);
  if (bytes.substr(0, 8) == "\x89PNG\r\n\x1A\n") return readPng(bytes);
  if (bytes.substr(0, 4) == "RIFF" && bytes.size() >= 12 && bytes.substr(8, 4) == "WEBP") return readWebp(bytes);
  if (bytes.substr(0, 2) == "BM") return readBmp(bytes);
  return faulty("is no photo that can be read; give a JPEG, PNG, WebP or BMP file");
}

}  // namespace axil::skeleton3d::detail
