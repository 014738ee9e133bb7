#include "skeleton3d/photo.hpp"

#include "base/files.hpp"
#include "skeleton3d/photo_header.hpp"

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace axil::skeleton3d {
namespace {

constexpr double kFilmDiagonal_mm = 43.266615305567875;  // 36 x 24 mm

std::string named(const std::filesystem::path& path) { return "photo '" + path.string() + "' "; }

bool liesOnItsSide(int orientation) { return orientation >= 5; }

std::optional<double> focalOf(const detail::PhotoHeader& header) {
  const detail::Exif& exif = header.exif;
  const double original = exif.originalWidth_px > 0 ? exif.originalWidth_px : header.width;
  double focal_px = 0;
  if (exif.focal_mm > 0 && exif.sensor_px_per_mm > 0)
    focal_px = exif.focal_mm * exif.sensor_px_per_mm * header.width / original;
  else if (exif.focal35_mm > 0)
    focal_px = exif.focal35_mm / kFilmDiagonal_mm * std::hypot(header.width, header.height);
  // Cameras that know nothing write nonsense rather than nothing; a lens below 5 or above 2000 mm (35 mm equivalent) is none.
  const double equivalent_mm = focal_px / std::hypot(header.width, header.height) * kFilmDiagonal_mm;
  return equivalent_mm >= 5 && equivalent_mm <= 2000 ? std::optional(focal_px) : std::nullopt;
}

PhotoInfo infoOf(const detail::PhotoHeader& header) {
  PhotoInfo info{header.width, header.height, focalOf(header)};
  if (liesOnItsSide(header.exif.orientation)) std::swap(info.width, info.height);
  return info;
}

Result<detail::PhotoHeader> headerOf(const std::filesystem::path& path, const std::string& bytes) {
  const detail::HeaderReading reading = detail::readPhotoHeader(bytes);
  if (!reading.header) return fail(ErrorCode::Unreadable, named(path) + reading.fault);
  const std::int64_t pixels = std::int64_t{reading.header->width} * reading.header->height;
  if (pixels > kMaxPhotoPixels)
    return fail(ErrorCode::LimitReached, named(path) + "has " + std::to_string(pixels / 1'000'000) + " million pixels; the limit is " +
                                             std::to_string(kMaxPhotoPixels / 1'000'000) + " million, scale it down");
  return *reading.header;
}

/// The stored picture turned upright, by the EXIF standard's eight cases.
cv::Mat upright(const cv::Mat& stored, int orientation) {
  cv::Mat turned = stored;
  if (liesOnItsSide(orientation)) cv::transpose(stored, turned);
  constexpr int kNone = 2;  // cv::flip: 0 about the x axis, 1 about the y axis, -1 both
  constexpr int kFlip[9] = {kNone, kNone, 1, -1, 0, kNone, 1, -1, 0};
  const int flip = kFlip[orientation];
  if (flip == kNone) return turned;
  cv::Mat flipped;
  cv::flip(turned, flipped, flip);
  return flipped;
}

Photo photoFrom(const cv::Mat& bgr) {
  Photo photo{bgr.cols, bgr.rows, {}};
  photo.rgb.resize(std::size_t{3} * static_cast<std::size_t>(bgr.cols) * static_cast<std::size_t>(bgr.rows));
  cv::Mat rgb(bgr.rows, bgr.cols, CV_8UC3, photo.rgb.data());
  cv::cvtColor(bgr, rgb, cv::COLOR_BGR2RGB);
  return photo;
}

/// OpenCV may turn by EXIF itself, but not for every format; so it is told not to, and `upright` does it for all alike.
Result<Photo> decoded(const std::filesystem::path& path, const std::string& bytes, const detail::PhotoHeader& header) {
  try {
    const cv::Mat raw(1, static_cast<int>(bytes.size()), CV_8UC1, const_cast<char*>(bytes.data()));
    const cv::Mat stored = cv::imdecode(raw, cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION);
    if (stored.cols != header.width || stored.rows != header.height) return fail(ErrorCode::Unreadable, named(path) + "is damaged and cannot be decoded");
    return photoFrom(upright(stored, header.exif.orientation));
  } catch (const cv::Exception& e) {
    return fail(ErrorCode::Unreadable, named(path) + "cannot be decoded: " + e.err);
  }
}

}  // namespace

Result<PhotoInfo> probePhoto(const std::filesystem::path& path) {
  const auto bytes = readFile(path);
  if (!bytes) return bytes.failure();
  const auto header = headerOf(path, *bytes);
  if (!header) return header.failure();
  return infoOf(*header);
}

Result<Photo> readPhoto(const std::filesystem::path& path) {
  const auto bytes = readFile(path);
  if (!bytes) return bytes.failure();
  const auto header = headerOf(path, *bytes);
  if (!header) return header.failure();
  return decoded(path, *bytes, *header);
}

}  // namespace axil::skeleton3d
