#include "render/animation.hpp"

#include "base/files.hpp"
#include "render/known_plants.hpp"

#include <gtest/gtest.h>

#include <set>

namespace axil::render {
namespace {

namespace fs = std::filesystem;

/// A stem that is as long as time.
Result<simeco::Plant> stemAt(double time) {
  if (time <= 0) return simeco::Plant{};
  return test::straightStem(2, time, 0.05);
}

AnimationOptions small() {
  AnimationOptions options{.from = 0, .to = 1, .frames = 5, .framesPerSecond = 10, .picture = {}};
  options.picture.width_px = 64;
  options.picture.height_px = 96;
  return options;
}

class Animation : public testing::Test {
 protected:
  Animation() {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~Animation() override { fs::remove_all(folder_); }
  [[nodiscard]] std::set<std::string> contents() const {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_)) names.insert(entry.path().filename().string());
    return names;
  }
  fs::path folder_ = fs::path(testing::TempDir()) / ("axil_animation_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
};

TEST_F(Animation, AFolderHasAFrameForEveryMoment) {
  const auto written = writeAnimation(folder_ / "growth", stemAt, small());
  ASSERT_TRUE(written) << written.error().message;
  EXPECT_EQ(contents(), std::set<std::string>{"growth"});
  std::set<std::string> bytes;
  for (int i = 1; i <= 5; ++i) bytes.insert(readFile(folder_ / "growth" / ("frame_000" + std::to_string(i) + ".png")).value());
  EXPECT_EQ(bytes.size(), 5u);  // each moment looks different
}

TEST_F(Animation, VideosAreWrittenAndAreTheSameBytesTwice) {
  for (const char* ending : {".mp4", ".webm"}) {
    const fs::path a = folder_ / (std::string("a") + ending), b = folder_ / (std::string("b") + ending);
    const auto first = writeAnimation(a, stemAt, small());
    ASSERT_TRUE(first) << first.error().message;
    ASSERT_TRUE(writeAnimation(b, stemAt, small()));
    const std::string bytes = readFile(a).value();
    EXPECT_GT(bytes.size(), 500u);
    EXPECT_EQ(bytes, readFile(b).value()) << ending;
    EXPECT_EQ(bytes.find(ending == std::string(".mp4") ? "avc1" : "V_VP8") != std::string::npos, true);
  }
  EXPECT_EQ(contents(), (std::set<std::string>{"a.mp4", "a.webm", "b.mp4", "b.webm"}));
}

TEST_F(Animation, StoppingLeavesNothingBehind) {
  for (const char* name : {"growth", "growth.mp4"}) {
    CancelToken token;
    const Watch watch{.progress = [&](std::string_view, double share) { if (share > 0.3) token.cancel(); }, .cancel = &token};
    const auto written = writeAnimation(folder_ / name, stemAt, small(), watch);
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().code, ErrorCode::Cancelled);
    EXPECT_TRUE(contents().empty());
  }
}

TEST_F(Animation, AFailureOfTheGrowthIsHandedOn) {
  const auto failing = [](double time) -> Result<simeco::Plant> {
    if (time > 0.5 && time < 1) return fail(ErrorCode::LimitReached, "too many modules");
    return stemAt(time);
  };
  const auto written = writeAnimation(folder_ / "growth.webm", failing, small());
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().message, "too many modules");
  EXPECT_TRUE(contents().empty());
}

TEST_F(Animation, OptionsThatMakeNoAnimationAreRefused) {
  const auto refused = [&](auto change, const char* name) {
    AnimationOptions options = small();
    change(options);
    return !writeAnimation(folder_ / name, stemAt, options);
  };
  EXPECT_TRUE(refused([](AnimationOptions& o) { o.frames = 1; }, "a"));
  EXPECT_TRUE(refused([](AnimationOptions& o) { o.to = -1; }, "a"));
  EXPECT_TRUE(refused([](AnimationOptions& o) { o.framesPerSecond = 0; }, "a.mp4"));
  EXPECT_TRUE(refused([](AnimationOptions& o) { o.picture.width_px = 63; }, "a.mp4"));
  EXPECT_TRUE(contents().empty());
}

}  // namespace
}  // namespace axil::render
