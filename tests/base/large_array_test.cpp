#include "base/large_array.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <numeric>

namespace axil {
namespace {

TEST(LargeArray, KeepsWhatIsInItWhereverItsMemoryMoves) {
  // Small blocks, the size from which large pages are asked for, and beyond it.
  LargeArray<std::uint32_t> array;
  for (const std::size_t size : {10u, 1000u, 1u << 20, (1u << 20) + 1, 3u << 20}) {
    const std::size_t before = array.size();
    array.resize(size);
    std::iota(array.begin() + static_cast<std::ptrdiff_t>(before), array.end(), static_cast<std::uint32_t>(before));
  }
  for (std::size_t i = 0; i < array.size(); ++i) ASSERT_EQ(array[i], i);
  const LargeArray<std::uint32_t> copy = array;
  EXPECT_EQ(copy, array);
  array.push_back(7);
  array.insert(array.end(), {8, 9});
  EXPECT_EQ(array.back(), 9u);
  EXPECT_NE(copy, array);
}

TEST(LargeArray, RoomForAVectorLosesNothing) {
  std::vector<double> values{1, 2, 3};
  growRoom(values, 1'000'000);
  EXPECT_GE(values.capacity(), 1'000'000u);
  EXPECT_EQ(values, (std::vector<double>{1, 2, 3}));
  growRoom(values, 2);
  EXPECT_EQ(values.size(), 3u);
}

}  // namespace
}  // namespace axil
