#include "skeleton3d/draft.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace axil::skeleton3d {
namespace {

constexpr double kMostPixels = 0.1e6;  ///< that grabCut looks at; what it learns of the colours is then applied to all
constexpr int kRounds = 4;

/// How far each pixel's colour is from all that are usual outside the box, in steps of Lab; less in lightness, as shadows are darker only.
cv::Mat strangeness(const cv::Mat& rgb, cv::Rect box) {
  constexpr int kWide = 8, kLab = 256 / kWide;
  constexpr double kUsual = 5e-4, kLightness = 0.3;
  cv::Mat lab;
  cv::cvtColor(rgb, lab, cv::COLOR_RGB2Lab);
  const auto binOf = [](const cv::Vec3b& c) { return cv::Vec3i(c[0] / kWide, c[1] / kWide, c[2] / kWide); };
  std::vector<int> count(kLab * kLab * kLab, 0);
  const auto at = [](const cv::Vec3i& bin) { return static_cast<std::size_t>((bin[0] * kLab + bin[1]) * kLab + bin[2]); };
  int outside = 0;
  for (int y = 0; y < lab.rows; ++y)
    for (int x = 0; x < lab.cols; ++x)
      if (!box.contains({x, y})) ++count[at(binOf(lab.at<cv::Vec3b>(y, x)))], ++outside;
  std::vector<cv::Vec3i> usual;
  for (int l = 0; l < kLab; ++l)
    for (int a = 0; a < kLab; ++a)
      for (int b = 0; b < kLab; ++b)
        if (count[at({l, a, b})] > kUsual * outside) usual.push_back({l, a, b});
  std::vector<float> away(count.size(), -1);
  cv::Mat strange(lab.size(), CV_32FC1);
  for (int y = 0; y < lab.rows; ++y)
    for (int x = 0; x < lab.cols; ++x) {
      const cv::Vec3i bin = binOf(lab.at<cv::Vec3b>(y, x));
      float& known = away[at(bin)];
      if (known < 0) {
        double least = 1e9;
        for (const cv::Vec3i& other : usual) {
          const cv::Vec3i d = kWide * (bin - other);
          least = std::min(least, std::sqrt(kLightness * kLightness * d[0] * d[0] + static_cast<double>(d[1] * d[1] + d[2] * d[2])));
        }
        known = static_cast<float>(least);
      }
      strange.at<float>(y, x) = known;
    }
  return strange;
}

/// Where grabCut begins: what is strange enough is probably the plant. A plant of thin stems fills so little of the box that a beginning
/// with all of the box would take its colours from the background.
cv::Mat firstGuess(const cv::Mat& rgb, cv::Rect box) {
  constexpr double kPlants = 0.005;  // share of the box that is the plant at least
  const cv::Mat strange = strangeness(rgb, box);
  std::vector<float> inside;
  for (int y = box.y; y < box.y + box.height; ++y)
    for (int x = box.x; x < box.x + box.width; ++x) inside.push_back(strange.at<float>(y, x));
  const auto clear = inside.begin() + static_cast<std::ptrdiff_t>((1 - kPlants) * static_cast<double>(inside.size() - 1));
  std::nth_element(inside.begin(), clear, inside.end());
  const double enough = std::max(0.4 * *clear, 1.0);
  cv::Mat state(rgb.size(), CV_8UC1, cv::Scalar(cv::GC_BGD));
  for (int y = box.y; y < box.y + box.height; ++y)
    for (int x = box.x; x < box.x + box.width; ++x) state.at<std::uint8_t>(y, x) = strange.at<float>(y, x) >= enough ? cv::GC_PR_FGD : cv::GC_PR_BGD;
  return state;
}

/// The plant's pixels (1) in a picture made small.
Result<cv::Mat> coarseMask(const cv::Mat& rgb, cv::Rect box, const Watch& watch) {
  cv::Mat state = firstGuess(rgb, box), back, front;
  cv::setRNGSeed(1);
  for (int round = 0; round < kRounds; ++round) {
    if (watch.cancelled()) return fail(ErrorCode::Cancelled, "finding the plant by its colours was stopped");
    watch.report("finding the plant by its colours", static_cast<double>(round) / kRounds);
    cv::grabCut(rgb, state, box, back, front, 1, round == 0 ? cv::GC_INIT_WITH_MASK : cv::GC_EVAL);
  }
  return cv::Mat(state & 1);
}

/// The mean colour about each pixel of those with weight; black where there are none.
cv::Mat meanColour(const cv::Mat& rgb, const cv::Mat& weight) {
  constexpr int kAbout = 9;  // pixels of the small picture
  cv::Mat colours, weights, sums, totals;
  rgb.convertTo(colours, CV_32FC3);
  cv::merge(std::vector<cv::Mat>(3, weight), weights);
  cv::blur(colours.mul(weights), sums, {kAbout, kAbout});
  cv::blur(weights, totals, {kAbout, kAbout});
  return sums / (totals + cv::Scalar::all(1e-6));
}

/// `coarse` brought to the size of `rgb`: near its border a pixel is the plant's where its colour is nearer to the plant's about there than
/// to the background's, so thin stems keep their width.
Mask fineMask(const cv::Mat& rgb, const cv::Mat& small, const cv::Mat& coarse, cv::Rect box, cv::Rect inSmall) {
  cv::Mat wide, core, soft, strange = strangeness(small, inSmall), isPlant, isRest;
  const cv::Mat kernel = cv::getStructuringElement(cv::MORPH_ELLIPSE, {5, 5});
  cv::dilate(coarse, wide, kernel);
  cv::erode(coarse, core, kernel);
  coarse.convertTo(isPlant, CV_32FC1);
  cv::Mat(wide == 0).convertTo(isRest, CV_32FC1, 1.0 / 255);
  // What is half the background's looks like it: the clearest pixels say what colour the plant has.
  const cv::Mat plantColour = meanColour(small, isPlant.mul(strange).mul(strange).mul(strange)), restColour = meanColour(small, isRest);
  cv::GaussianBlur(rgb, soft, {3, 3}, 0.8);
  Mask mask{rgb.cols, rgb.rows, {}};
  mask.plant.reserve(rgb.total());
  const auto nearerToPlant = [&](const cv::Vec3b& colour, int x, int y) {
    const cv::Vec3f own(colour[0], colour[1], colour[2]), rest = restColour.at<cv::Vec3f>(y, x), apart = plantColour.at<cv::Vec3f>(y, x) - rest;
    return 2 * (own - rest).dot(apart) >= apart.dot(apart);
  };
  for (int y = 0; y < rgb.rows; ++y)
    for (int x = 0; x < rgb.cols; ++x) {
      const int sx = std::min(small.cols - 1, x * small.cols / rgb.cols), sy = std::min(small.rows - 1, y * small.rows / rgb.rows);
      const bool plant = core.at<std::uint8_t>(sy, sx) != 0 || (wide.at<std::uint8_t>(sy, sx) != 0 && nearerToPlant(soft.at<cv::Vec3b>(y, x), sx, sy));
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
    Mask mask = fineMask(rgb, small, *coarse, {x0, y0, x1 - x0, y1 - y0}, inSmall);
    if (std::count(mask.plant.begin(), mask.plant.end(), 1) < 50)
      return fail(ErrorCode::NoAnswer, "colours do not tell the plant from its background; give a mask of the plant");
    return mask;
  } catch (const cv::Exception& e) {
    return fail(ErrorCode::NoAnswer, "colours do not tell the plant from its background (" + e.err + "); give a mask of the plant");
  }
}

}  // namespace axil::skeleton3d
