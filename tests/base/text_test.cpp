#include "base/text.hpp"

#include "base/rng.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

namespace axil {
namespace {

TEST(Text, ShortestReadsBackAsTheSameNumber) {
  Rng rng(3);
  for (int i = 0; i < 10000; ++i) {
    const double value = std::bit_cast<double>(rng.bits());
    if (!std::isfinite(value)) continue;
    ASSERT_EQ(parseNumber(shortest(value)), value) << shortest(value);
  }
}

TEST(Text, FixedNeverPrintsMinusZeroAndRoundingAgreesWithIt) {
  EXPECT_EQ(fixed(-0.0000001, 6), "0.000000");
  EXPECT_EQ(fixed(-0.1937516, 6), "-0.193752");
  EXPECT_EQ(roundedTo(0.19375249, 6), 0.193752);
}

TEST(Text, NumbersRefuseTrailingTextAndInfinities) {
  EXPECT_FALSE(parseNumber("1.0x"));
  EXPECT_FALSE(parseNumber(""));
  EXPECT_FALSE(parseNumber("inf"));
  EXPECT_FALSE(parseNumber("1e999"));
}

TEST(Text, Utf8IsCheckedStrictly) {
  EXPECT_TRUE(isUtf8("馬櫻丹 é"));
  EXPECT_FALSE(isUtf8("\xC0\xAF"));
  EXPECT_FALSE(isUtf8("\xED\xA0\x80"));
  EXPECT_FALSE(isUtf8("\xE9\xA6"));
  EXPECT_EQ(countCharacters("馬櫻丹"), 3u);
}

TEST(Text, Big5IsRecognisedAndBinaryRefused) {
  const auto decoded = decodeText("\xB0\xA8\xC4\xE5\xA4\xA6");  // 馬櫻丹
  ASSERT_TRUE(decoded);
  EXPECT_EQ(decoded->utf8, "馬櫻丹");
  EXPECT_EQ(decoded->encoding, "Big5");
  EXPECT_FALSE(decodeText(std::string_view("\x00\x01\x02", 3)));
  EXPECT_EQ(decodeText("\xEF\xBB\xBFok")->utf8, "ok");
}

TEST(Text, EditDistanceCountsASwapOnce) {
  EXPECT_EQ(editDistance("Stme", "Stem"), 1u);
  EXPECT_EQ(editDistance("", "abc"), 3u);
  EXPECT_EQ(editDistance("GrowRate", "GrowRate"), 0u);
}

}  // namespace
}  // namespace axil
