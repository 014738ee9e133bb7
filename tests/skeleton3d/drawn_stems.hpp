#pragma once
/// \file
/// Photos of stems drawn for tests: exact to a small part of a pixel, since drawn eight times larger and averaged.

#include "base/rng.hpp"
#include "skeleton3d/photo.hpp"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <opencv2/imgproc.hpp>

#include <vector>

namespace axil::test {

struct DrawnStem {
  std::vector<glm::dvec2> points;  ///< px
  double width_px = 6;
  cv::Scalar colour{60, 110, 40};  ///< red, green, blue
};

inline skeleton3d::Photo drawnPhoto(cv::Size size, cv::Scalar background, const std::vector<DrawnStem>& stems, double noise, std::uint64_t seed, double blur_px = 0.6) {
  constexpr int kTimes = 8;
  cv::Mat large(size * kTimes, CV_8UC3, background), small;
  for (const DrawnStem& stem : stems)
    for (std::size_t i = 0; i + 1 < stem.points.size(); ++i) {
      const glm::dvec2 a = stem.points[i] * double(kTimes), b = stem.points[i + 1] * double(kTimes), along = glm::normalize(b - a);
      const glm::dvec2 half = 0.5 * stem.width_px * kTimes * glm::dvec2{-along.y, along.x};
      std::vector<cv::Point> corners;
      for (const glm::dvec2 c : {a + half, b + half, b - half, a - half}) corners.push_back({cvRound((c.x - 0.5) * 16), cvRound((c.y - 0.5) * 16)});
      cv::fillConvexPoly(large, corners, stem.colour, cv::LINE_AA, 4);
      if (i > 0) cv::circle(large, {cvRound((a.x - 0.5) * 16), cvRound((a.y - 0.5) * 16)}, cvRound(0.5 * stem.width_px * kTimes * 16), stem.colour, -1, cv::LINE_AA, 4);
    }
  cv::resize(large, small, size, 0, 0, cv::INTER_AREA);
  if (blur_px > 0) cv::GaussianBlur(small, small, {}, blur_px);
  skeleton3d::Photo photo{size.width, size.height, {}};
  Rng rng(seed);
  photo.rgb.reserve(small.total() * 3);
  for (int y = 0; y < small.rows; ++y)
    for (int x = 0; x < small.cols * 3; ++x) photo.rgb.push_back(cv::saturate_cast<std::uint8_t>(small.ptr(y)[x] + noise * rng.normal()));
  return photo;
}

}  // namespace axil::test
