#include "skeleton3d/mask_lines.hpp"

#include <array>
#include <opencv2/imgproc.hpp>

namespace axil::skeleton3d::detail {
namespace {

template <class Visit>
void forAround(cv::Point p, const Visit& visit) {
  for (int y = p.y - 1; y <= p.y + 1; ++y)
    for (int x = p.x - 1; x <= p.x + 1; ++x) visit(cv::Point(x, y));
}

/// The plant's pixels (1) that touch the background; they become 2 in `known`.
std::vector<cv::Point> borderOf(const cv::Mat& m, cv::Mat& known) {
  std::vector<cv::Point> border;
  for (int y = 1; y + 1 < m.rows; ++y)
    for (int x = 1; x + 1 < m.cols; ++x) {
      if (m.at<std::uint8_t>(y, x) == 0) continue;
      bool touches = false;
      forAround({x, y}, [&](cv::Point n) { touches = touches || m.at<std::uint8_t>(n) == 0; });
      if (touches) border.push_back({x, y}), known.at<std::uint8_t>(y, x) = 2;
    }
  return border;
}

/// One of the two passes of Zhang and Suen's thinning over `left`, the pixels that touch the background (no other can go), which
/// then grows by those laid bare; whether any was taken away.
bool thinOnce(cv::Mat& m, std::vector<cv::Point>& left, cv::Mat& known, bool second) {
  std::vector<cv::Point> gone, stay;
  for (const cv::Point& place : left) {
    const int x = place.x, y = place.y;
    stay.push_back(place);
    const std::array<int, 9> p{m.at<std::uint8_t>(y - 1, x),     m.at<std::uint8_t>(y - 1, x + 1), m.at<std::uint8_t>(y, x + 1),
                               m.at<std::uint8_t>(y + 1, x + 1), m.at<std::uint8_t>(y + 1, x),     m.at<std::uint8_t>(y + 1, x - 1),
                               m.at<std::uint8_t>(y, x - 1),     m.at<std::uint8_t>(y - 1, x - 1), m.at<std::uint8_t>(y - 1, x)};
    int count = 0, changes = 0;
    for (std::size_t i = 0; i < 8; ++i) {
      count += p[i];
      changes += p[i] == 0 && p[i + 1] == 1;
    }
    if (count < 2 || count > 6 || changes != 1) continue;
    const bool free = second ? p[0] * p[2] * p[6] == 0 && p[0] * p[4] * p[6] == 0 : p[0] * p[2] * p[4] == 0 && p[2] * p[4] * p[6] == 0;
    if (free) gone.push_back(place), stay.pop_back();
  }
  for (const cv::Point& g : gone) m.at<std::uint8_t>(g) = 0;
  left = std::move(stay);
  for (const cv::Point& g : gone)
    forAround(g, [&](cv::Point n) {
      if (m.at<std::uint8_t>(n) == 0 || known.at<std::uint8_t>(n) == 2) return;
      known.at<std::uint8_t>(n) = 2;
      left.push_back(n);
    });
  return !gone.empty();
}

std::vector<float> valuesOf(const cv::Mat& m) {
  std::vector<float> values;
  values.reserve(m.total());
  for (int y = 0; y < m.rows; ++y) values.insert(values.end(), m.ptr<float>(y), m.ptr<float>(y) + m.cols);
  return values;
}

}  // namespace

MaskLines linesOf(const Mask& mask) {
  MaskLines lines{mask.width, mask.height, {}, {}, {}, {}, {}};
  cv::Mat plant(mask.height, mask.width, CV_8UC1);
  for (int y = 0; y < mask.height; ++y)
    for (int x = 0; x < mask.width; ++x)
      plant.at<std::uint8_t>(y, x) =
          mask.plant[static_cast<std::size_t>(y) * static_cast<std::size_t>(mask.width) + static_cast<std::size_t>(x)] != 0 ? 1 : 0;
  cv::Mat toPlant, inside, toLine, labels, thin = plant.clone();
  cv::distanceTransform(1 - plant, toPlant, cv::DIST_L2, cv::DIST_MASK_5);
  cv::distanceTransform(plant, inside, cv::DIST_L2, cv::DIST_MASK_5);
  thin.row(0).setTo(0), thin.row(thin.rows - 1).setTo(0), thin.col(0).setTo(0), thin.col(thin.cols - 1).setTo(0);
  cv::Mat known = cv::Mat::zeros(thin.size(), CV_8UC1);
  std::vector<cv::Point> left = borderOf(thin, known);
  for (bool more = true; more;) {
    const bool first = thinOnce(thin, left, known, false), second = thinOnce(thin, left, known, true);
    more = first || second;
  }
  cv::distanceTransform(1 - thin, toLine, labels, cv::DIST_L2, cv::DIST_MASK_5, cv::DIST_LABEL_PIXEL);
  // OpenCV numbers the zero pixels (here the line's) row by row, from 1.
  std::vector<std::int32_t> numberOf(thin.total() + 1, 0);
  for (int y = 0; y < thin.rows; ++y)
    for (int x = 0; x < thin.cols; ++x)
      if (thin.at<std::uint8_t>(y, x) != 0) {
        numberOf[static_cast<std::size_t>(labels.at<std::int32_t>(y, x))] = static_cast<std::int32_t>(lines.line.size());
        lines.line.push_back({x, y});
      }
  for (int y = 0; y < thin.rows; ++y)
    for (int x = 0; x < thin.cols; ++x) lines.nearest.push_back(numberOf[static_cast<std::size_t>(labels.at<std::int32_t>(y, x))]);
  lines.toPlant = valuesOf(toPlant);
  lines.inside = valuesOf(inside);
  lines.toLine = valuesOf(toLine);
  return lines;
}

}  // namespace axil::skeleton3d::detail
