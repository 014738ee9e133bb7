#include "skeleton3d/stemness.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace axil::skeleton3d::detail {
namespace {

constexpr double kMostCells = 0.5e6;
constexpr double kMostPixels = 24e6;  ///< of the finest level
constexpr double kWidest = 0.06;      ///< of the photo's longer side
constexpr int kStripCells = 32;
constexpr int kMargin = 10;           ///< px around a strip: kernels and edges reach so far

/// One smoothing of one level of the picture's pyramid, with the derivatives of all three channels.
struct Scale {
  cv::Mat gx, gy, gxx, gxy, gyy;  ///< CV_32FC3
  double sigma = 1;

  explicit Scale(const cv::Mat& rgb, double s) : sigma(s) {
    cv::Mat smooth;
    rgb.convertTo(smooth, CV_32FC3);
    cv::GaussianBlur(smooth, smooth, {}, sigma, sigma, cv::BORDER_REPLICATE);
    cv::Sobel(smooth, gx, CV_32F, 1, 0, 1, 0.5, 0, cv::BORDER_REPLICATE);
    cv::Sobel(smooth, gy, CV_32F, 0, 1, 1, 0.5, 0, cv::BORDER_REPLICATE);
    cv::Sobel(smooth, gxx, CV_32F, 2, 0, 1, 1, 0, cv::BORDER_REPLICATE);
    cv::Sobel(smooth, gyy, CV_32F, 0, 2, 1, 1, 0, cv::BORDER_REPLICATE);
    cv::Sobel(gx, gxy, CV_32F, 0, 1, 1, 0.5, 0, cv::BORDER_REPLICATE);
  }
};

cv::Vec3f bilinear(const cv::Mat& m, double x, double y) {
  const int ix = std::clamp(static_cast<int>(std::floor(x)), 0, m.cols - 2), iy = std::clamp(static_cast<int>(std::floor(y)), 0, m.rows - 2);
  const float u = std::clamp(static_cast<float>(x - ix), 0.0F, 1.0F), v = std::clamp(static_cast<float>(y - iy), 0.0F, 1.0F);
  const cv::Vec3f *a = m.ptr<cv::Vec3f>(iy) + ix, *b = m.ptr<cv::Vec3f>(iy + 1) + ix;
  return (a[0] * (1 - u) + a[1] * u) * (1 - v) + (b[0] * (1 - u) + b[1] * u) * v;
}

struct Bend {
  float value = 0;  ///< the larger eigenvalue of the Hessian, by size
  int channel = 0;
};

Bend strongestBend(const cv::Vec3f& xx, const cv::Vec3f& xy, const cv::Vec3f& yy) {
  Bend best;
  for (int c = 0; c < 3; ++c) {
    const float mean = 0.5F * (xx[c] + yy[c]), half = 0.5F * (xx[c] - yy[c]);
    const float value = mean + std::copysign(std::sqrt(half * half + xy[c] * xy[c]), mean);
    if (std::abs(value) > std::abs(best.value)) best = {value, c};
  }
  return best;
}

/// The ridge at pixel (x, y) of a scale, in the scale's pixels; strength 0 where there is none.
StemCell ridgeAt(const Scale& scale, int x, int y) {
  constexpr double kLeastBend = 1.2;  // grey levels
  const cv::Vec3f &xx = scale.gxx.ptr<cv::Vec3f>(y)[x], &xy = scale.gxy.ptr<cv::Vec3f>(y)[x], &yy = scale.gyy.ptr<cv::Vec3f>(y)[x];
  const Bend bend = strongestBend(xx, xy, yy);
  if (std::abs(bend.value) * scale.sigma * scale.sigma < kLeastBend) return {};
  const int c = bend.channel;
  // The eigenvector, from the row of (H - value) that is further from zero.
  cv::Vec2f across = std::abs(xx[c] - bend.value) < std::abs(yy[c] - bend.value) ? cv::Vec2f(bend.value - yy[c], xy[c]) : cv::Vec2f(xy[c], bend.value - xx[c]);
  const auto length = static_cast<float>(cv::norm(across));
  across = length > 0 ? across / length : cv::Vec2f(1, 0);
  const float slope = scale.gx.ptr<cv::Vec3f>(y)[x][c] * across[0] + scale.gy.ptr<cv::Vec3f>(y)[x][c] * across[1];
  const float off = -slope / bend.value;
  if (std::abs(off) > 1) return {};
  const double mx = x + static_cast<double>(off * across[0]), my = y + static_cast<double>(off * across[1]), dx = scale.sigma * across[0], dy = scale.sigma * across[1];
  const cv::Vec3f in = bilinear(scale.gx, mx - dx, my - dy) * across[0] + bilinear(scale.gy, mx - dx, my - dy) * across[1];
  const cv::Vec3f out = -(bilinear(scale.gx, mx + dx, my + dy) * across[0] + bilinear(scale.gy, mx + dx, my + dy) * across[1]);
  const double a = cv::norm(in), b = cv::norm(out), alike = a * b > 0 ? in.dot(out) / (a * b) : 0;
  constexpr double kStep = 2.5066;  // the height of a step over its steepest slope, for a smoothing of 1
  return {{static_cast<float>(mx), static_cast<float>(my)}, {-across[1], across[0]}, static_cast<float>(std::min(a, b) * std::max(2 + 3 * alike, 0.0) / 5 * kStep * scale.sigma),
          static_cast<float>(2 * scale.sigma)};
}

/// `found` in the whole picture's pixels, where 0.5 is the first pixel's centre.
StemCell inPhoto(StemCell found, glm::vec2 corner, float shrunk) {
  found.at = (found.at + corner + 0.5F) * shrunk;
  found.width_px *= shrunk;
  return found;
}

/// All cells of some rows at one level, both smoothings of it.
void fillStrip(StemnessMap& map, const cv::Mat& level, int shrunk, int firstRow) {
  const int lastRow = std::min(firstRow + kStripCells, map.rows), f = map.cell_px;
  const int top = std::clamp(firstRow * f / shrunk - kMargin, 0, level.rows), bottom = std::clamp(lastRow * f / shrunk + kMargin + 1, 0, level.rows);
  if (bottom - top < 3) return;
  for (const double sigma : {1.0, 1.41}) {
    const Scale scale(level.rowRange(top, bottom), sigma);
    const auto offer = [&](int column, int row, int x, int y) {
      const StemCell found = ridgeAt(scale, x, y);
      StemCell& cell = map.cells[static_cast<std::size_t>(row) * static_cast<std::size_t>(map.columns) + static_cast<std::size_t>(column)];
      if (found.strength > cell.strength) cell = inPhoto(found, {0, static_cast<float>(top)}, static_cast<float>(shrunk));
    };
    if (shrunk <= f) {
      for (int y = 0; y < scale.gx.rows; ++y) {
        const int row = ((2 * (y + top) + 1) * shrunk / 2) / f;
        if (row < firstRow || row >= lastRow) continue;
        for (int x = 0; x < scale.gx.cols; ++x) offer(std::min(((2 * x + 1) * shrunk / 2) / f, map.columns - 1), row, x, y);
      }
    } else {
      for (int row = firstRow; row < lastRow; ++row)
        for (int column = 0; column < map.columns; ++column)
          offer(column, row, std::min((2 * column + 1) * f / 2 / shrunk, scale.gx.cols - 1), std::clamp((2 * row + 1) * f / 2 / shrunk - top, 0, scale.gx.rows - 1));
    }
  }
}

/// What grain and texture give: the median of the cells that have a ridge at all.
float usualStrength(const StemnessMap& map) {
  std::vector<float> all;
  for (std::size_t i = 0; i < map.cells.size(); i += 7)
    if (map.cells[i].strength > 0) all.push_back(map.cells[i].strength);
  if (all.empty()) return 6;
  std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2), all.end());
  return std::clamp(1.5F * all[all.size() / 2], 6.0F, 20.0F);
}

}  // namespace

glm::ivec2 StemnessMap::cellOf(glm::dvec2 px) const {
  return {std::clamp(static_cast<int>(std::floor(px.x / cell_px)), 0, columns - 1), std::clamp(static_cast<int>(std::floor(px.y / cell_px)), 0, rows - 1)};
}

Result<StemnessMap> stemnessOf(const Photo& photo, const Watch& watch) {
  if (photo.width < 8 || photo.height < 8) return fail(ErrorCode::BadInput, "a photo of less than 8 x 8 px shows no stem");
  const double pixels = static_cast<double>(photo.width) * photo.height;
  StemnessMap map;
  map.cell_px = std::max(1, static_cast<int>(std::ceil(std::sqrt(pixels / kMostCells))));
  map.columns = (photo.width + map.cell_px - 1) / map.cell_px;
  map.rows = (photo.height + map.cell_px - 1) / map.cell_px;
  map.cells.resize(static_cast<std::size_t>(map.columns) * static_cast<std::size_t>(map.rows));
  cv::Mat level(photo.height, photo.width, CV_8UC3, const_cast<std::uint8_t*>(photo.rgb.data()));
  const int strips = (map.rows + kStripCells - 1) / kStripCells, longer = std::max(photo.width, photo.height);
  for (int shrunk = 1; 2 * shrunk < kWidest * longer || shrunk == 1; shrunk *= 2) {
    if (pixels / shrunk / shrunk <= kMostPixels)
      cv::parallel_for_({0, strips}, [&](const cv::Range& range) {
        for (int s = range.start; s < range.end && !watch.cancelled(); ++s) fillStrip(map, level, shrunk, s * kStripCells);
      });
    if (watch.cancelled()) return fail(ErrorCode::Cancelled, "looking for stems in the photo was stopped");
    watch.report("looking for stems", 1 - 0.25 / (shrunk * shrunk));
    if (std::min(level.cols, level.rows) < 16) break;
    cv::Mat half;
    cv::resize(level, half, {level.cols / 2, level.rows / 2}, 0, 0, cv::INTER_AREA);
    level = half;
  }
  map.usual = usualStrength(map);
  return map;
}

}  // namespace axil::skeleton3d::detail
