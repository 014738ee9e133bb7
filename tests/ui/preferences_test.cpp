#include "ui/actions.hpp"
#include "ui/photo_tiles.hpp"
#include "ui/preferences.hpp"

#include <gtest/gtest.h>

namespace axil::ui {
namespace {

TEST(Preferences, AreReadBackAsTheyWereWritten) {
  Preferences preferences;
  preferences.theme = Theme::Light;
  preferences.language = Language::TraditionalChinese;
  preferences.scale = 1.5f;
  preferences.layout = {310, 240, 0.4f, 0.6f};
  rememberProject(preferences, "/plants/a.axil");
  rememberProject(preferences, "/plants/馬櫻丹.axil");
  rememberProject(preferences, "/plants/a.axil");
  EXPECT_EQ(parsePreferences(print(preferences)), preferences);
  EXPECT_EQ(preferences.recent.size(), 2u);
  EXPECT_EQ(preferences.recent.front(), "/plants/a.axil");
}

TEST(Preferences, ADamagedFileDoesNoHarm) {
  const Preferences read = parsePreferences("left\tnan\nright\t-5\nacross\t99\nscale\t1000\ntheme\tpink\nrubbish\n\t\nleft\n");
  EXPECT_EQ(read.layout, withinReason(read.layout));
  EXPECT_FALSE(read.theme.has_value());
  EXPECT_FALSE(read.scale.has_value());
}

TEST(Likeness, PrefersWhatBeginsAsTyped) {
  ASSERT_TRUE(likeness("Save under another name", "save"));
  EXPECT_FALSE(likeness("Save", "xyz"));
  EXPECT_LT(*likeness("Split the stem", "spl"), *likeness("Show or hide the plant", "spl"));
}

TEST(PhotoLevels, HalveDownToOneTileAndKeepTheMean) {
  skeleton3d::Photo photo{1030, 700, {}};
  for (int y = 0; y < photo.height; ++y)
    for (int x = 0; x < photo.width; ++x) photo.rgb.insert(photo.rgb.end(), {static_cast<std::uint8_t>(x % 2 * 200), 100, 40});
  const auto levels = photoLevels(photo);
  ASSERT_EQ(levels.size(), 3u);
  EXPECT_EQ(levels[1].width, 515);
  EXPECT_EQ(levels[2].width, 257);
  EXPECT_EQ(levels[1].rgb[0], 100) << "0 and 200";
  EXPECT_EQ(levels[1].rgb[1], 100);
}

TEST(LookTable, AsTakenChangesNothingAndContrastKeepsTheMiddle) {
  const auto plain = lookTable({});
  for (int i = 0; i < 256; ++i) EXPECT_EQ(plain[static_cast<std::size_t>(i)], i);
  const auto strong = lookTable({.brightness = 0, .contrast = 2});
  EXPECT_EQ(strong[0], 0);
  EXPECT_EQ(strong[255], 255);
  EXPECT_NEAR(strong[128], 128, 1);
}

}  // namespace
}  // namespace axil::ui
