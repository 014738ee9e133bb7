#include "skeleton3d/draft.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace axil::skeleton3d {

Result<Mask> readMask(const std::filesystem::path& path) {
  const auto photo = readPhoto(path);
  if (!photo) return photo.failure();
  Mask mask{photo->width, photo->height, {}};
  for (std::size_t i = 0; i + 2 < photo->rgb.size(); i += 3) mask.plant.push_back(std::max({photo->rgb[i], photo->rgb[i + 1], photo->rgb[i + 2]}) >= 128 ? 1 : 0);
  return mask;
}

Result<Mask> maskByColour(const Photo& photo, const PlantBox& box) {
  const int x0 = std::clamp(static_cast<int>(box.from.x), 1, photo.width - 2), y0 = std::clamp(static_cast<int>(box.from.y), 1, photo.height - 2);
  const int x1 = std::clamp(static_cast<int>(box.to.x), 1, photo.width - 2), y1 = std::clamp(static_cast<int>(box.to.y), 1, photo.height - 2);
  if (x1 - x0 < 8 || y1 - y0 < 8) return fail(ErrorCode::BadInput, "the box about the plant is smaller than 8 px; draw it around the whole plant");
  try {
    const cv::Mat rgb(photo.height, photo.width, CV_8UC3, const_cast<std::uint8_t*>(photo.rgb.data()));
    cv::Mat state, back, front;
    cv::setRNGSeed(1);
    cv::grabCut(rgb, state, {x0, y0, x1 - x0, y1 - y0}, back, front, 4, cv::GC_INIT_WITH_RECT);
    Mask mask{photo.width, photo.height, {}};
    std::size_t count = 0;
    for (int y = 0; y < state.rows; ++y)
      for (int x = 0; x < state.cols; ++x) {
        mask.plant.push_back((state.at<std::uint8_t>(y, x) & 1) != 0 ? 1 : 0);
        count += mask.plant.back();
      }
    if (count < 50) return fail(ErrorCode::NoAnswer, "colours do not tell the plant from its background; give a mask of the plant");
    return mask;
  } catch (const cv::Exception& e) {
    return fail(ErrorCode::NoAnswer, "colours do not tell the plant from its background (" + e.err + "); give a mask of the plant");
  }
}

}  // namespace axil::skeleton3d
