#include "render/plot.hpp"

#include "base/text.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace axil::render {

namespace {

// Room for the labels, px.
constexpr int kLeft = 84, kRight = 20, kTop = 44, kBottom = 58;
const cv::Scalar kInk(40, 40, 40), kGrid(228, 228, 228);
const std::array<cv::Scalar, 8> kColours{cv::Scalar(31, 119, 180), cv::Scalar(214, 88, 20), cv::Scalar(44, 140, 60), cv::Scalar(150, 60, 160),
                                         cv::Scalar(140, 86, 75),  cv::Scalar(200, 40, 60), cv::Scalar(110, 110, 110), cv::Scalar(20, 150, 160)};

struct Range {
  double low = 0;
  double high = 1;
};

std::string ascii(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    if (c < 0x80) out.push_back(text[i]);
    else if (c >= 0xC0) out.push_back('?');  // one mark a character, not one a byte
  }
  return out;
}

void put(cv::Mat& image, const std::string& text, cv::Point at, double size, bool centred) {
  const std::string plain = ascii(text);
  int base = 0;
  const cv::Size box = cv::getTextSize(plain, cv::FONT_HERSHEY_SIMPLEX, size, 1, &base);
  cv::putText(image, plain, centred ? cv::Point(at.x - box.width / 2, at.y) : at, cv::FONT_HERSHEY_SIMPLEX, size, kInk, 1, cv::LINE_AA);
}

void putUpwards(cv::Mat& image, const std::string& text, int middle) {
  const std::string plain = ascii(text);
  int base = 0;
  const cv::Size box = cv::getTextSize(plain, cv::FONT_HERSHEY_SIMPLEX, 0.45, 1, &base);
  cv::Mat label(box.height + base + 2, box.width + 2, CV_8UC3, cv::Scalar(255, 255, 255));
  cv::putText(label, plain, {1, box.height}, cv::FONT_HERSHEY_SIMPLEX, 0.45, kInk, 1, cv::LINE_AA);
  cv::rotate(label, label, cv::ROTATE_90_COUNTERCLOCKWISE);
  const int y = std::max(0, middle - label.rows / 2);
  const cv::Rect place(2, y, std::min(label.cols, image.cols - 2), std::min(label.rows, image.rows - y));
  label(cv::Rect(0, 0, place.width, place.height)).copyTo(image(place));
}

/// A range with a twentieth of room on both sides; a single value gets room around it.
Range widened(double low, double high) {
  if (!(low <= high)) return {0, 1};
  const double room = high > low ? 0.06 * (high - low) : std::max(std::abs(low) * 0.2, 0.5);
  return {low - room, high + room};
}

constexpr double kForLegend = 0.055;  // of the height, a line of the legend

Range rangeOf(const Plot& plot, bool ofX) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const PlotSeries& series : plot.series)
    for (const PlotPoint& p : series.points)
      for (const double v : ofX ? std::array{p.x, p.x, p.x} : std::array{p.y, p.low.value_or(p.y), p.high.value_or(p.y)}) {
        low = std::min(low, v);
        high = std::max(high, v);
      }
  if (!ofX && plot.fromZero) low = std::min(low, 0.0);
  Range range = widened(low, high);
  if (!ofX && plot.fromZero && low == 0) range.low = 0;
  if (ofX && plot.counted) return {std::min(range.low, low - 0.5), std::max(range.high, high + 0.5)};
  if (!ofX) range.high += kForLegend * static_cast<double>(plot.series.size()) * (range.high - range.low);
  return range;
}

/// 1, 2 or 5 times a power of ten, so that there are about six steps.
double stepFor(const Range& range) {
  const double rough = (range.high - range.low) / 6;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double times : {1.0, 2.0, 5.0})
    if (times * power >= rough) return times * power;
  return 10 * power;
}

class Painter {
 public:
  Painter(cv::Mat image, const Plot& plot) : image_(std::move(image)), plot_(plot), x_(rangeOf(plot, true)), y_(rangeOf(plot, false)) {}

  void paint() {
    image_.setTo(cv::Scalar(255, 255, 255));
    put(image_, plot_.title, {image_.cols / 2, 24}, 0.55, true);
    put(image_, plot_.xLabel, {(kLeft + image_.cols - kRight) / 2, image_.rows - 12}, 0.45, true);
    putUpwards(image_, plot_.yLabel, (kTop + image_.rows - kBottom) / 2);
    grid();
    for (std::size_t s = 0; s < plot_.series.size(); ++s) draw(plot_.series[s], kColours[s % kColours.size()]);
    cv::rectangle(image_, {kLeft, kTop}, {image_.cols - kRight, image_.rows - kBottom}, kInk, 1);
    legend();
  }

 private:
  [[nodiscard]] int column(double x) const { return kLeft + static_cast<int>(std::lround((x - x_.low) / (x_.high - x_.low) * (image_.cols - kLeft - kRight))); }
  [[nodiscard]] int row(double y) const { return image_.rows - kBottom - static_cast<int>(std::lround((y - y_.low) / (y_.high - y_.low) * (image_.rows - kTop - kBottom))); }

  void grid() {
    const double dx = plot_.counted ? std::max(1.0, std::ceil(stepFor(x_))) : stepFor(x_);
    for (double x = std::ceil(x_.low / dx) * dx; x <= x_.high; x += dx) {
      cv::line(image_, {column(x), kTop}, {column(x), image_.rows - kBottom}, kGrid, 1);
      put(image_, shortest(roundedTo(x, 6) + 0.0), {column(x), image_.rows - kBottom + 18}, 0.4, true);
    }
    const double dy = stepFor(y_);
    for (double y = std::ceil(y_.low / dy) * dy; y <= y_.high; y += dy) {
      cv::line(image_, {kLeft, row(y)}, {image_.cols - kRight, row(y)}, kGrid, 1);
      put(image_, shortest(roundedTo(y, 6) + 0.0), {kLeft - 32, row(y) + 4}, 0.4, true);
    }
  }

  void draw(const PlotSeries& series, const cv::Scalar& colour) {
    for (const PlotPoint& p : series.points)
      if (p.low && p.high) {
        cv::line(image_, {column(p.x), row(*p.low)}, {column(p.x), row(*p.high)}, colour, 1, cv::LINE_AA);
        for (const double end : {*p.low, *p.high}) cv::line(image_, {column(p.x) - 3, row(end)}, {column(p.x) + 3, row(end)}, colour, 1, cv::LINE_AA);
      }
    for (std::size_t i = 1; series.line && i < series.points.size(); ++i)
      cv::line(image_, {column(series.points[i - 1].x), row(series.points[i - 1].y)}, {column(series.points[i].x), row(series.points[i].y)}, colour, 2, cv::LINE_AA);
    for (const PlotPoint& p : series.points)
      if (series.dots) cv::circle(image_, {column(p.x), row(p.y)}, 3, colour, cv::FILLED, cv::LINE_AA);
  }

  void legend() {
    int y = kTop + 16;
    for (std::size_t s = 0; s < plot_.series.size(); ++s) {
      if (plot_.series[s].name.empty()) continue;
      int base = 0;
      const int width = cv::getTextSize(ascii(plot_.series[s].name), cv::FONT_HERSHEY_SIMPLEX, 0.4, 1, &base).width;
      const int x = image_.cols - kRight - width - 10;
      cv::rectangle(image_, {x - 20, y - 11}, {image_.cols - kRight - 4, y + 4}, cv::Scalar(255, 255, 255), cv::FILLED);
      cv::line(image_, {x - 18, y - 4}, {x - 5, y - 4}, kColours[s % kColours.size()], 3);
      put(image_, plot_.series[s].name, {x, y}, 0.4, false);
      y += 17;
    }
  }

  cv::Mat image_;
  const Plot& plot_;
  Range x_;
  Range y_;
};

bool finite(const Plot& plot) {
  for (const PlotSeries& series : plot.series)
    for (const PlotPoint& p : series.points)
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.low.value_or(0)) || !std::isfinite(p.high.value_or(0))) return false;
  return true;
}

}  // namespace

Result<Image> drawPlots(std::span<const Plot> plots, int columns, int width_px, int height_px) {
  constexpr int kLeast = 200, kMost = 4000;
  if (plots.empty() || columns < 1) return fail(ErrorCode::BadInput, "there is nothing to plot");
  if (width_px < kLeast || height_px < kLeast || width_px > kMost || height_px > kMost)
    return fail(ErrorCode::BadInput, "a plot is 200 to 4000 px wide and high, not " + std::to_string(width_px) + " x " + std::to_string(height_px));
  const int count = static_cast<int>(plots.size());
  const int across = std::min(columns, count);
  const int down = (count + across - 1) / across;
  cv::Mat sheet(down * height_px, across * width_px, CV_8UC3, cv::Scalar(255, 255, 255));
  for (int p = 0; p < count; ++p) {
    const Plot& plot = plots[static_cast<std::size_t>(p)];
    if (!finite(plot)) return fail(ErrorCode::BadInput, "the plot '" + plot.title + "' holds a value that is not a number");
    Painter(sheet(cv::Rect((p % across) * width_px, (p / across) * height_px, width_px, height_px)), plot).paint();
  }
  Image image;
  image.width_px = sheet.cols;
  image.height_px = sheet.rows;
  image.rgb.assign(sheet.data, sheet.data + sheet.total() * 3);
  return image;
}

}  // namespace axil::render
