#include "skeleton3d/calibrate.hpp"

#include "base/text.hpp"
#include "skeleton3d/photo.hpp"

#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace axil::skeleton3d {
namespace {

constexpr std::size_t kFewestPhotos = 3;

/// A photo in which the board was found.
struct Found {
  std::size_t photo;
  std::vector<cv::Point2f> corners;
};

struct Looked {
  std::vector<CalibratedPhoto> photos;
  std::vector<Found> found;
  cv::Size size;
  glm::ivec2 board{0, 0};
};

Result<cv::Mat> greyOf(const std::filesystem::path& path) {
  const auto photo = readPhoto(path);
  if (!photo) return photo.failure();
  const cv::Mat rgb(photo->height, photo->width, CV_8UC3, const_cast<std::uint8_t*>(photo->rgb.data()));
  cv::Mat grey;
  cv::cvtColor(rgb, grey, cv::COLOR_RGB2GRAY);
  return grey;
}

/// Found on a smaller picture, where that is quick, and refined on the whole one.
std::vector<cv::Point2f> cornersIn(const cv::Mat& grey, glm::ivec2 board) {
  constexpr double kQuick_px = 1200;
  const double scale = std::min(1.0, kQuick_px / std::max(grey.cols, grey.rows));
  cv::Mat smaller = grey;
  if (scale < 1) cv::resize(grey, smaller, {}, scale, scale, cv::INTER_AREA);
  std::vector<cv::Point2f> corners;
  if (!cv::findChessboardCorners(smaller, {board.x, board.y}, corners, cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_FAST_CHECK)) return {};
  // OpenCV's corners count from the middle of the first pixel, ours from its edge.
  for (cv::Point2f& corner : corners) corner = (corner + cv::Point2f(0.5F, 0.5F)) / static_cast<float>(scale) - cv::Point2f(0.5F, 0.5F);
  double side = 1e9;
  for (std::size_t i = 1; i < corners.size(); ++i) side = std::min(side, static_cast<double>(cv::norm(corners[i] - corners[i - 1])));
  const int half = std::clamp(static_cast<int>(side / 3), 2, 15);
  cv::cornerSubPix(grey, corners, {half, half}, {-1, -1}, {cv::TermCriteria::EPS | cv::TermCriteria::COUNT, 60, 1e-3});
  for (cv::Point2f& corner : corners) corner += cv::Point2f(0.5F, 0.5F);
  return corners;
}

std::vector<glm::ivec2> boardsToTry(const CalibrateOptions& options) {
  if (options.corners) return {*options.corners};
  return {{10, 7}, {9, 7}, {9, 6}, {8, 6}, {7, 7}, {8, 5}, {7, 6}, {7, 5}, {6, 5}, {6, 4}, {5, 4}};
}

Result<Looked> lookedAt(std::span<const std::filesystem::path> photos, const CalibrateOptions& options, const Watch& watch) {
  Looked looked;
  std::vector<glm::ivec2> boards = boardsToTry(options);
  for (const auto& path : photos) {
    const auto grey = greyOf(path);
    if (!grey) return grey.failure();
    if (looked.size.empty()) looked.size = grey->size();
    if (grey->size() != looked.size)
      return fail(ErrorCode::BadInput, "photo '" + path.string() + "' has " + std::to_string(grey->cols) + " x " + std::to_string(grey->rows) + " px, the first one " +
                                           std::to_string(looked.size.width) + " x " + std::to_string(looked.size.height) + "; calibrate with photos of one size, held one way up");
    CalibratedPhoto photo{path.filename().string(), 0, "the board was not found"};
    for (const glm::ivec2 board : boards) {
      if (watch.cancelled()) return fail(ErrorCode::Cancelled, "looking for the chessboard was stopped");
      watch.report("looking for the chessboard", static_cast<double>(looked.photos.size()) / static_cast<double>(photos.size()));
      auto corners = cornersIn(*grey, board);
      if (corners.empty()) continue;
      looked.found.push_back({looked.photos.size(), std::move(corners)});
      photo.fault.clear();
      looked.board = board;
      boards = {board};  // it is one board
      break;
    }
    looked.photos.push_back(std::move(photo));
  }
  return looked;
}

std::vector<cv::Point3f> boardCorners(glm::ivec2 board) {
  std::vector<cv::Point3f> corners;
  for (int y = 0; y < board.y; ++y)
    for (int x = 0; x < board.x; ++x) corners.emplace_back(static_cast<float>(x), static_cast<float>(y), 0.0F);
  return corners;
}

struct Fitted {
  cv::Mat matrix = cv::Mat::eye(3, 3, CV_64F);
  cv::Mat distortion = cv::Mat::zeros(5, 1, CV_64F);
  cv::Mat sigmas;
  std::vector<double> perPhoto;
  std::vector<cv::Mat> turns;
  double rms_px = 0;
};

/// Whether corners reach so far out that the sixth power of the radius can be told from the fourth.
bool reachesFar(const std::vector<Found>& found, cv::Size size) {
  const double half = 0.5 * std::hypot(size.width, size.height);
  double furthest = 0;
  for (const Found& one : found)
    for (const cv::Point2f& c : one.corners) furthest = std::max(furthest, std::hypot(c.x - 0.5 * size.width, c.y - 0.5 * size.height));
  return furthest > 0.85 * half && found.size() >= 8;
}

Fitted fittedTo(const Looked& looked) {
  std::vector<std::vector<cv::Point3f>> boards(looked.found.size(), boardCorners(looked.board));
  std::vector<std::vector<cv::Point2f>> corners;
  for (const Found& one : looked.found) corners.push_back(one.corners);
  Fitted fitted;
  std::vector<cv::Mat> shifts;
  cv::Mat poseSigmas, perPhoto;
  const int flags = reachesFar(looked.found, looked.size) ? 0 : cv::CALIB_FIX_K3;
  fitted.rms_px = cv::calibrateCamera(boards, corners, looked.size, fitted.matrix, fitted.distortion, fitted.turns, shifts, fitted.sigmas, poseSigmas, perPhoto, flags);
  for (int i = 0; i < perPhoto.rows; ++i) fitted.perPhoto.push_back(perPhoto.at<double>(i));
  return fitted;
}

/// Leaves out, once, the photos that fit far worse than the middle one: blurred, or a corner mistaken.
Looked withoutBad(Looked looked, const Fitted& fitted) {
  std::vector<double> sorted = fitted.perPhoto;
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2), sorted.end());
  const double limit = std::max(4 * sorted[sorted.size() / 2], 0.5);
  std::vector<Found> kept;
  for (std::size_t i = 0; i < looked.found.size(); ++i) {
    if (fitted.perPhoto[i] <= limit)
      kept.push_back(std::move(looked.found[i]));
    else
      looked.photos[looked.found[i].photo].fault = "its corners fit far worse than the others' (" + fixed(fitted.perPhoto[i], 1) + " px)";
  }
  looked.found = std::move(kept);
  return looked;
}

/// Boards that all face the same way leave focal length and distance one number.
double mostBetween(const std::vector<cv::Mat>& turns) {
  double most = 0;
  for (const cv::Mat& a : turns)
    for (const cv::Mat& b : turns) {
      cv::Mat one, other;
      cv::Rodrigues(a, one);
      cv::Rodrigues(b, other);
      most = std::max(most, std::acos(std::clamp(one.col(2).dot(other.col(2)), -1.0, 1.0)));
    }
  return most;
}

Result<void> checkFound(const Looked& looked) {
  if (looked.found.size() >= kFewestPhotos) return {};
  return fail(ErrorCode::NoAnswer, "the chessboard was found in " + std::to_string(looked.found.size()) + " of " + std::to_string(looked.photos.size()) + " photos, at least " +
                                       std::to_string(kFewestPhotos) + " are needed; show the whole board with a white rim, or say how many inner corners it has (--corners 9x6)");
}

CalibratedLens lensOf(const Looked& looked, const Fitted& fitted) {
  CalibratedLens lens{{looked.size.width, looked.size.height}, looked.board, {}, {}, {}, {}, {}, fitted.rms_px, looked.photos};
  lens.focal_px = {fitted.matrix.at<double>(0, 0), fitted.matrix.at<double>(1, 1)};
  lens.centre_px = {fitted.matrix.at<double>(0, 2), fitted.matrix.at<double>(1, 2)};
  lens.focalSigma_px = {fitted.sigmas.at<double>(0), fitted.sigmas.at<double>(1)};
  lens.centreSigma_px = {fitted.sigmas.at<double>(2), fitted.sigmas.at<double>(3)};
  for (int k = 0; k < 5; ++k) lens.distortion[static_cast<std::size_t>(k)] = fitted.distortion.at<double>(k);
  for (std::size_t i = 0; i < looked.found.size(); ++i) lens.photos[looked.found[i].photo].rms_px = fitted.perPhoto[i];
  return lens;
}

bool isFinite(const CalibratedLens& lens) {
  return std::isfinite(lens.rms_px) && std::isfinite(lens.focal_px.x + lens.focal_px.y + lens.centre_px.x + lens.centre_px.y) && lens.focal_px.x > 0 && lens.focal_px.y > 0 &&
         std::all_of(lens.distortion.begin(), lens.distortion.end(), [](double k) { return std::isfinite(k); });
}

Result<CalibratedLens> calibrated(Looked looked) {
  if (const auto enough = checkFound(looked); !enough) return enough.failure();
  Fitted fitted = fittedTo(looked);
  const std::size_t before = looked.found.size();
  looked = withoutBad(std::move(looked), fitted);
  if (const auto enough = checkFound(looked); !enough) return enough.failure();
  if (looked.found.size() < before) fitted = fittedTo(looked);
  constexpr double kSameWay_rad = 0.17;  // 10 degrees
  if (mostBetween(fitted.turns) < kSameWay_rad)
    return fail(ErrorCode::NoAnswer, "the board faces the same way in all photos, so that the focal length cannot be told from the distance; tilt it by 20 to 40 degrees, to other sides");
  CalibratedLens lens = lensOf(looked, fitted);
  if (!isFinite(lens)) return fail(ErrorCode::NoAnswer, "no lens fits the photos of the board; take sharper ones, from more sides");
  return lens;
}

}  // namespace

Result<CalibratedLens> calibrateLens(std::span<const std::filesystem::path> photos, const CalibrateOptions& options, const Watch& watch) {
  if (photos.empty()) return fail(ErrorCode::BadInput, "there is no photo of a chessboard; give at least " + std::to_string(kFewestPhotos));
  if (options.corners && (options.corners->x < 3 || options.corners->y < 3))
    return fail(ErrorCode::BadInput, "a board of " + std::to_string(options.corners->x) + " x " + std::to_string(options.corners->y) + " inner corners is too small; it needs 3 x 3");
  auto looked = lookedAt(photos, options, watch);
  if (!looked) return looked.failure();
  try {
    return calibrated(*std::move(looked));
  } catch (const cv::Exception& e) {
    return fail(ErrorCode::NoAnswer, "the lens cannot be fitted: " + e.err);
  }
}

}  // namespace axil::skeleton3d
