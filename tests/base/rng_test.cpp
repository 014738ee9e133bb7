#include "base/rng.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace axil {
namespace {

TEST(Rng, GivesTheSameNumbersEverywhere) {
  Rng rng(1);
  const std::array<std::uint64_t, 2> first = {rng.bits(), rng.bits()};
  Rng again(1);
  EXPECT_EQ(again.bits(), first[0]);
  EXPECT_EQ(again.bits(), first[1]);
  EXPECT_NE(Rng(2).bits(), first[0]);
}

TEST(Rng, ASubStreamDoesNotDependOnDrawsOfItsParent) {
  Rng a(5);
  const Rng b(5);
  a.bits();
  EXPECT_EQ(a.split(3, 4).bits(), b.split(3, 4).bits());
  EXPECT_NE(b.split(3, 4).bits(), b.split(4, 3).bits());
}

TEST(Rng, UniformAndNormalHaveTheirMoments) {
  Rng rng(11);
  const int n = 200000;
  double sum = 0, square = 0, even = 0;
  for (int i = 0; i < n; ++i) {
    const double x = rng.normal(2, 3);
    sum += x;
    square += (x - 2) * (x - 2);
    even += rng.uniform();
  }
  EXPECT_NEAR(sum / n, 2, 0.03);
  EXPECT_NEAR(std::sqrt(square / n), 3, 0.03);
  EXPECT_NEAR(even / n, 0.5, 0.003);
}

TEST(Rng, BelowReachesEveryOutcomeEvenly) {
  Rng rng(13);
  std::array<int, 6> count{};
  for (int i = 0; i < 60000; ++i) ++count[rng.below(6)];
  for (const int c : count) EXPECT_NEAR(c, 10000, 400);
}

}  // namespace
}  // namespace axil
