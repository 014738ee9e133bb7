#include "skeleton3d/photo.hpp"

#include "base/files.hpp"
#include "base/rng.hpp"
#include "skeleton3d/photo_header.hpp"
#include "support/shared_data.hpp"

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <unistd.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <string>

namespace axil::skeleton3d {
namespace {

namespace fs = std::filesystem;

/// A folder for one test, removed after it.
class PhotoFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("axil_photo_" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path write(const std::string& name, const std::string& bytes) {
    EXPECT_TRUE(writeFile(folder_ / name, bytes));
    return folder_ / name;
  }
  fs::path folder_;
};

/// 48 x 32 px: top left red, top right green, bottom left blue, bottom right white.
cv::Mat fourCorners() {
  cv::Mat picture(32, 48, CV_8UC3, cv::Scalar(255, 255, 255));
  picture(cv::Rect(0, 0, 24, 16)).setTo(cv::Scalar(0, 0, 255));
  picture(cv::Rect(24, 0, 24, 16)).setTo(cv::Scalar(0, 255, 0));
  picture(cv::Rect(0, 16, 24, 16)).setTo(cv::Scalar(255, 0, 0));
  return picture;
}

std::string encoded(const cv::Mat& picture, const std::string& ending) {
  std::vector<unsigned char> bytes;
  cv::imencode(ending, picture, bytes);
  return {bytes.begin(), bytes.end()};
}

/// A number of `count` bytes.
std::string number(std::uint32_t value, int count, bool big) {
  std::string text;
  for (int i = 0; i < count; ++i) text += static_cast<char>(value >> (8 * (big ? count - 1 - i : i)) & 0xFF);
  return text;
}

struct ExifEntry {
  std::uint32_t tag;
  std::uint32_t type;   // 3 SHORT, 4 LONG, 5 RATIONAL
  std::uint32_t value;  // of a RATIONAL: the numerator
  std::uint32_t below = 1;
};

/// A TIFF directory at `start` of its file, entries in order, rationals behind it.
std::string directory(const std::vector<ExifEntry>& entries, std::uint32_t start, bool big) {
  std::string body = number(static_cast<std::uint32_t>(entries.size()), 2, big), behind;
  const std::uint32_t end = start + 2 + 12 * static_cast<std::uint32_t>(entries.size()) + 4;
  for (const ExifEntry& e : entries) {
    body += number(e.tag, 2, big) + number(e.type, 2, big) + number(1, 4, big);
    if (e.type == 3) body += number(e.value, 2, big) + number(0, 2, big);
    if (e.type == 4) body += number(e.value, 4, big);
    if (e.type == 5) {
      body += number(end + static_cast<std::uint32_t>(behind.size()), 4, big);
      behind += number(e.value, 4, big) + number(e.below, 4, big);
    }
  }
  return body + number(0, 4, big) + behind;
}

/// EXIF data as a TIFF file: orientation in the first directory, the rest in the one it points to.
std::string exifText(int orientation, const std::vector<ExifEntry>& lens, bool big) {
  const std::uint32_t second = 8 + 2 + 12 * 2 + 4;
  return (big ? "MM" : "II") + number(42, 2, big) + number(8, 4, big) +
         directory({{0x0112, 3, static_cast<std::uint32_t>(orientation)}, {0x8769, 4, second}}, 8, big) + directory(lens, second, big);
}

std::string withExif(const std::string& jpeg, const std::string& exif) {
  const std::string content = std::string("Exif\0\0", 6) + exif;
  return jpeg.substr(0, 2) + "\xFF\xE1" + number(static_cast<std::uint32_t>(content.size()) + 2, 2, true) + content + jpeg.substr(2);
}

char colourAt(const Photo& photo, int x, int y) {
  const std::size_t at = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(photo.width) + static_cast<std::size_t>(x));
  const bool r = photo.rgb[at] > 128, g = photo.rgb[at + 1] > 128, b = photo.rgb[at + 2] > 128;
  return r && g && b ? 'w' : r ? 'r' : g ? 'g' : b ? 'b' : '-';
}

/// Colours of the four corners: top left, top right, bottom left, bottom right.
std::string cornersOf(const Photo& p) {
  const int l = p.width / 6, r = p.width - 1 - l, t = p.height / 6, b = p.height - 1 - t;
  return {colourAt(p, l, t), colourAt(p, r, t), colourAt(p, l, b), colourAt(p, r, b)};
}

TEST_F(PhotoFiles, AreTurnedUprightByTheirExifOrientation) {
  // What each of the eight stored orders of the four corners must look like once upright.
  const std::array<const char*, 9> expected{"", "rgbw", "grwb", "wbgr", "bwrg", "rbgw", "brwg", "wgbr", "gwrb"};
  for (int orientation = 1; orientation <= 8; ++orientation)
    for (const bool big : {false, true}) {
      const std::string bytes = withExif(encoded(fourCorners(), ".jpg"), exifText(orientation, {}, big));
      const auto path = write("turned.jpg", bytes);
      const auto photo = readPhoto(path);
      ASSERT_TRUE(photo) << photo.error().message;
      EXPECT_EQ(cornersOf(*photo), expected[static_cast<std::size_t>(orientation)]) << orientation;
      const auto info = probePhoto(path);
      ASSERT_TRUE(info);
      EXPECT_EQ(info->width, photo->width);
      EXPECT_EQ(info->height, photo->height);
      EXPECT_EQ(info->width, orientation >= 5 ? 32 : 48);
      const cv::Mat judge = cv::imread(path.string());  // honours the orientation itself
      EXPECT_EQ(judge.cols, photo->width);
      EXPECT_EQ(judge.at<cv::Vec3b>(2, 3)[2], photo->rgb[3 * (2 * static_cast<std::size_t>(photo->width) + 3)]);
    }
}

TEST_F(PhotoFiles, OfEveryFormatGiveSizeAndColours) {
  for (const char* ending : {".jpg", ".png", ".bmp", ".webp"}) {
    const auto path = write(std::string("four") + ending, encoded(fourCorners(), ending));
    const auto info = probePhoto(path);
    const auto photo = readPhoto(path);
    ASSERT_TRUE(info) << ending << info.error().message;
    ASSERT_TRUE(photo) << ending << photo.error().message;
    EXPECT_EQ(*info, (PhotoInfo{48, 32})) << ending;
    EXPECT_EQ(cornersOf(*photo), "rgbw") << ending;
  }
}

TEST_F(PhotoFiles, TellTheirFocalLength) {
  const double diagonal_px = std::hypot(48, 32);
  const std::string jpeg = encoded(fourCorners(), ".jpg");
  // A 50 mm equivalent lens: 50 / 43.27 of the diagonal.
  auto info = probePhoto(write("a.jpg", withExif(jpeg, exifText(6, {{0xA405, 3, 50}}, false))));
  ASSERT_TRUE(info && info->exif_focal_px);
  EXPECT_NEAR(*info->exif_focal_px, 50 / 43.2666 * diagonal_px, 1e-3);
  // 5 mm lens, sensor of 40 px/cm at 96 px width: 2 px/mm here, so 10 px... too short for a lens; 20 mm makes 40 px.
  info = probePhoto(write("b.jpg", withExif(jpeg, exifText(1, {{0x920A, 5, 200, 10}, {0xA002, 4, 96}, {0xA20E, 5, 40, 1}, {0xA210, 3, 3}}, true))));
  ASSERT_TRUE(info && info->exif_focal_px);
  EXPECT_NEAR(*info->exif_focal_px, 20 * 4.0 * 48 / 96, 1e-9);
  info = probePhoto(write("c.jpg", withExif(jpeg, exifText(1, {{0xA405, 3, 0}, {0x920A, 5, 0, 0}}, true))));
  ASSERT_TRUE(info);
  EXPECT_FALSE(info->exif_focal_px);
}

void expectRefused(const fs::path& path, ErrorCode code, const std::string& part) {
  const auto probed = probePhoto(path);
  const auto read = readPhoto(path);
  ASSERT_FALSE(probed) << path;
  ASSERT_FALSE(read) << path;
  EXPECT_EQ(probed.error(), read.error());
  EXPECT_EQ(probed.error().code, code) << probed.error().message;
  EXPECT_NE(probed.error().message.find(path.filename().string()), std::string::npos) << probed.error().message;
  EXPECT_NE(probed.error().message.find(part), std::string::npos) << probed.error().message;
}

TEST_F(PhotoFiles, ThatCannotBeUsedAreRefusedByName) {
  expectRefused(folder_ / "missing.jpg", ErrorCode::NotFound, "no file");
  expectRefused(folder_, ErrorCode::Unreadable, "folder");
  expectRefused(write("empty.jpg", ""), ErrorCode::Unreadable, "empty");
  expectRefused(write("words.jpg", "this is a text"), ErrorCode::Unreadable, "no photo");
  for (const char* ending : {".jpg", ".png", ".bmp", ".webp"}) {
    const std::string whole = encoded(fourCorners(), ending);
    for (const std::size_t size : {whole.size() - 3, whole.size() / 2, std::size_t{20}})
      expectRefused(write(std::string("half") + ending, whole.substr(0, size)), ErrorCode::Unreadable, "cut off");
  }
}

TEST_F(PhotoFiles, TooLargeOnesAreRefusedBeforeTheyAreDecoded) {
  std::string png = encoded(fourCorners(), ".png");
  png.replace(16, 8, number(20000, 4, true) + number(10001, 4, true));
  expectRefused(write("huge.png", png), ErrorCode::LimitReached, "200 million pixels");
}

TEST_F(PhotoFiles, WithDamagedPixelsAreRefusedWhenRead) {
  std::string png = encoded(fourCorners(), ".png");
  for (std::size_t i = 41; i < png.size() - 20; ++i) png[i] = static_cast<char>(png[i] ^ 0x5A);
  const auto read = readPhoto(write("damaged.png", png));
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, ErrorCode::Unreadable);
}

TEST(PhotoHeader, AnyBytesAreReadWithoutHarm) {
  const std::string jpeg = withExif(encoded(fourCorners(), ".jpg"), exifText(6, {{0xA405, 3, 50}, {0xA20E, 5, 40, 1}}, true));
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    Rng rng(seed);
    std::string bytes = seed % 4 == 0 ? jpeg : encoded(fourCorners(), seed % 4 == 1 ? ".png" : seed % 4 == 2 ? ".webp" : ".bmp");
    for (int i = 0; i < 8; ++i) bytes[2 + rng.below(std::min<std::size_t>(bytes.size() - 2, 200))] = static_cast<char>(rng.bits());
    bytes.resize(rng.below(bytes.size() + 1));
    const auto reading = detail::readPhotoHeader(bytes);
    EXPECT_EQ(reading.header.has_value(), reading.fault.empty()) << "seed " << seed;
    EXPECT_TRUE(!reading.header || reading.header->width > 0) << "seed " << seed;
  }
}

TEST(Photos, OfTheSharedPlantsAreReadAtTheSizeOfTheirCameras) {
  AXIL_SKIP_WITHOUT_SHARED("data/plants/cases/p01_default_simple/bare_persp_plain_front.jpg");
  const auto path = test::sharedPath("data/plants/cases/p01_default_simple/bare_persp_plain_front.jpg");
  const auto photo = readPhoto(path);
  ASSERT_TRUE(photo) << photo.error().message;
  EXPECT_EQ(photo->width, 1200);
  EXPECT_EQ(photo->height, 1600);
  EXPECT_EQ(photo->rgb.size(), std::size_t{1200} * 1600 * 3);
}

}  // namespace
}  // namespace axil::skeleton3d
