#include "skeleton3d/draft.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace axil::skeleton3d {
namespace {

constexpr double kMostPixels = 0.1e6;  ///< that grabCut looks at; what it learns of the colours is then applied to all
constexpr int kRounds = 4, kBins = 16;

/// Shares of the plant's and the background's pixels, by colour.
class Colours {
 public:
  Colours() : plant_(kBins * kBins * kBins, 1e-6), rest_(plant_) {}

  void add(const cv::Vec3b& rgb, bool plant) {
    (plant ? plant_ : rest_)[bin(rgb)] += 1;
    ++(plant ? plants_ : rests_);
  }
  [[nodiscard]] bool morePlant(const cv::Vec3b& rgb) const { return plant_[bin(rgb)] * (rests_ + 1) > rest_[bin(rgb)] * (plants_ + 1); }

 private:
  static std::size_t bin(const cv::Vec3b& c) {
    constexpr int kWide = 256 / kBins;
    return static_cast<std::size_t>((c[0] / kWide * kBins + c[1] / kWide) * kBins + c[2] / kWide);
  }
  std::vector<double> plant_, rest_;
  double plants_ = 0, rests_ = 0;
};

/// The plant's pixels (1) in a picture made small.
Result<cv::Mat> coarseMask(const cv::Mat& rgb, cv::Rect box, const Watch& watch) {
  cv::Mat state, back, front;
  cv::setRNGSeed(1);
  for (int round = 0; round < kRounds; ++round) {
    if (watch.cancelled()) return fail(ErrorCode::Cancelled, "finding the plant by its colours was stopped");
    watch.report("finding the plant by its colours", static_cast<double>(round) / kRounds);
    cv::grabCut(rgb, state, box, back, front, 1, round == 0 ? cv::GC_INIT_WITH_RECT : cv::GC_EVAL);
  }
  return cv::Mat(state & 1);
}

/// `coarse` brought to the size of `rgb`: near its border each pixel goes by its own colour, so thin stems keep their width.
Mask fineMask(const cv::Mat& rgb, const cv::Mat& small, const cv::Mat& coarse, cv::Rect box) {
  Colours colours;
  for (int y = 0; y < small.rows; ++y)
    for (int x = 0; x < small.cols; ++x) colours.add(small.at<cv::Vec3b>(y, x), coarse.at<std::uint8_t>(y, x) != 0);
  cv::Mat wide, core, near, sure;
  const cv::Mat kernel = cv::getStructuringElement(cv::MORPH_ELLIPSE, {5, 5});
  cv::dilate(coarse, wide, kernel);
  cv::erode(coarse, core, kernel);
  cv::resize(wide, near, rgb.size(), 0, 0, cv::INTER_NEAREST);
  cv::resize(core, sure, rgb.size(), 0, 0, cv::INTER_NEAREST);
  Mask mask{rgb.cols, rgb.rows, {}};
  for (int y = 0; y < rgb.rows; ++y)
    for (int x = 0; x < rgb.cols; ++x) {
      const bool plant = sure.at<std::uint8_t>(y, x) != 0 || (near.at<std::uint8_t>(y, x) != 0 && colours.morePlant(rgb.at<cv::Vec3b>(y, x)));
      mask.plant.push_back(plant && box.contains({x, y}) ? 1 : 0);
    }
  return mask;
}

}  // namespace

Result<Mask> readMask(const std::filesystem::path& path) {
  const auto photo = readPhoto(path);
  if (!photo) return photo.failure();
  Mask mask{photo->width, photo->height, {}};
  for (std::size_t i = 0; i + 2 < photo->rgb.size(); i += 3) mask.plant.push_back(std::max({photo->rgb[i], photo->rgb[i + 1], photo->rgb[i + 2]}) >= 128 ? 1 : 0);
  return mask;
}

Result<Mask> maskByColour(const Photo& photo, const PlantBox& box, const Watch& watch) {
  if (photo.width < 16 || photo.height < 16) return fail(ErrorCode::BadInput, "a photo of less than 16 x 16 px shows no plant");
  const int x0 = std::clamp(static_cast<int>(box.from.x), 1, photo.width - 2), y0 = std::clamp(static_cast<int>(box.from.y), 1, photo.height - 2);
  const int x1 = std::clamp(static_cast<int>(box.to.x), 1, photo.width - 2), y1 = std::clamp(static_cast<int>(box.to.y), 1, photo.height - 2);
  if (x1 - x0 < 8 || y1 - y0 < 8) return fail(ErrorCode::BadInput, "the box about the plant is smaller than 8 px; draw it around the whole plant");
  try {
    const cv::Mat rgb(photo.height, photo.width, CV_8UC3, const_cast<std::uint8_t*>(photo.rgb.data()));
    const double shrink = std::min(1.0, std::sqrt(kMostPixels / (static_cast<double>(photo.width) * photo.height)));
    cv::Mat small;
    cv::resize(rgb, small, {}, shrink, shrink, cv::INTER_AREA);
    const cv::Rect inSmall = cv::Rect(static_cast<int>(x0 * shrink), static_cast<int>(y0 * shrink), static_cast<int>((x1 - x0) * shrink), static_cast<int>((y1 - y0) * shrink)) &
                             cv::Rect(1, 1, small.cols - 2, small.rows - 2);
    if (inSmall.width < 4 || inSmall.height < 4) return fail(ErrorCode::BadInput, "the box about the plant is too small; draw it around the whole plant");
    const auto coarse = coarseMask(small, inSmall, watch);
    if (!coarse) return coarse.failure();
    Mask mask = fineMask(rgb, small, *coarse, {x0, y0, x1 - x0, y1 - y0});
    if (std::count(mask.plant.begin(), mask.plant.end(), 1) < 50)
      return fail(ErrorCode::NoAnswer, "colours do not tell the plant from its background; give a mask of the plant");
    return mask;
  } catch (const cv::Exception& e) {
    return fail(ErrorCode::NoAnswer, "colours do not tell the plant from its background (" + e.err + "); give a mask of the plant");
  }
}

}  // namespace axil::skeleton3d
