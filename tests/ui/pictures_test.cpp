/// The window as it was looked at and found good: tests/golden/studio has each picture at a quarter of its size, which forgives another
/// graphics driver its smoothing but no panel that has moved, lost its words or its colours.
/// A picture that differs is left beside the golden one as NAME.out.png; look at it, and copy it over where the difference is meant.
#include "render/picture.hpp"
#include "skeleton3d/photo.hpp"
#include "ui/fonts_interop.hpp"
#include "ui/headless.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

namespace axil::ui {
namespace {

const std::filesystem::path kGolden = std::filesystem::path(AXIL_UI_DIR).parent_path() / "tests" / "golden" / "studio";
constexpr int kShrink = 4;
constexpr int kBlock = 8;            ///< px of the small picture
constexpr double kMostOfBlock = 14;  ///< grey levels by which a block may differ
constexpr double kMostOfAll = 2;

render::Image shrunk(const render::Image& image) {
  render::Image small{image.width_px / kShrink, image.height_px / kShrink, {}};
  for (int y = 0; y < small.height_px; ++y)
    for (int x = 0; x < small.width_px; ++x)
      for (int c = 0; c < 3; ++c) {
        int sum = 0;
        for (int dy = 0; dy < kShrink; ++dy)
          for (int dx = 0; dx < kShrink; ++dx)
            sum += image.rgb[(static_cast<std::size_t>(y * kShrink + dy) * static_cast<std::size_t>(image.width_px) + static_cast<std::size_t>(x * kShrink + dx)) * 3 + static_cast<std::size_t>(c)];
        small.rgb.push_back(static_cast<std::uint8_t>(sum / (kShrink * kShrink)));
      }
  return small;
}

struct Difference {
  double mean = 0, worstBlock = 0;  ///< grey levels
};
Difference differenceOf(const render::Image& a, const skeleton3d::Photo& b) {
  Difference difference;
  for (int top = 0; top < a.height_px; top += kBlock)
    for (int left = 0; left < a.width_px; left += kBlock) {
      double sum = 0;
      int count = 0;
      for (int y = top; y < std::min(top + kBlock, a.height_px); ++y)
        for (int x = left * 3; x < std::min(left + kBlock, a.width_px) * 3; ++x, ++count) {
          const std::size_t at = static_cast<std::size_t>(y) * static_cast<std::size_t>(a.width_px) * 3 + static_cast<std::size_t>(x);
          sum += std::abs(int{a.rgb[at]} - int{b.rgb[at]});
        }
      difference.mean += sum;
      difference.worstBlock = std::max(difference.worstBlock, sum / count);
    }
  difference.mean /= static_cast<double>(a.rgb.size());
  return difference;
}

struct Look {
  const char* name;
  const char* lines;
};
class Picture : public testing::TestWithParam<Look> {};

TEST_P(Picture, IsTheOneThatWasLookedAt) {
  if (!FontBook::isInstalled()) GTEST_SKIP() << "the fonts of the golden pictures (fonts-wqy-microhei) are not installed";
  const auto& [name, lines] = GetParam();
  auto headless = HeadlessStudio::open({}, 1200, 800);
  ASSERT_TRUE(headless) << headless.error().message;
  ASSERT_TRUE(headless->studio().open(std::filesystem::path(AXIL_SAMPLES_DIR) / "lantana" / "lantana.axil"));
  const auto ran = headless->run(std::string("ui wait\nui way grammar\nui wait\nui press kind_initial\n") + lines + "\nui wait\n");
  ASSERT_TRUE(ran) << ran.error().message;
  const auto picture = headless->picture();
  ASSERT_TRUE(picture) << picture.error().message;
  const render::Image small = shrunk(*picture);
  const auto out = kGolden / (std::string(name) + ".out.png");
  const auto golden = skeleton3d::readPhoto(kGolden / (std::string(name) + ".png"));
  bool good = false;
  if (golden && golden->width == small.width_px && golden->height == small.height_px) {
    const Difference difference = differenceOf(small, *golden);
    EXPECT_LT(difference.mean, kMostOfAll) << name;
    EXPECT_LT(difference.worstBlock, kMostOfBlock) << name;
    good = difference.mean < kMostOfAll && difference.worstBlock < kMostOfBlock;
  } else {
    ADD_FAILURE() << "there is no golden picture " << name << " of " << small.width_px << " x " << small.height_px << " px";
  }
  if (good) return;
  EXPECT_TRUE(render::writePng(out, small));
}

INSTANTIATE_TEST_SUITE_P(Studio, Picture,
                         testing::Values(Look{"describe", "ui way describe"}, Look{"photos", "ui way photos"}, Look{"stems", "ui way stems"},
                                         Look{"stem_selected_light", "ui way stems\nui theme light\nui press stem_2"}, Look{"leaves", "ui way leaves"},
                                         Look{"grammar_zh_hant", "ui language zh_hant"}, Look{"grow_zh_hans", "ui way grow\nui language zh_hans\nui time 8"}),
                         [](const auto& look) { return std::string(look.param.name); });

}  // namespace
}  // namespace axil::ui
