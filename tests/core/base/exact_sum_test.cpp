// Sums against integers of 128 bits, which add without rounding.

#include "core/base/exact_sum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace pbrt {
namespace {

__extension__ using Wide = __int128;

double valueOf(const std::vector<double>& terms) {
  ExactSums<1> sums;
  for (const double x : terms) sums.add({x});
  return sums.value(0);
}

// A compiler that takes the compensation for zero, as with -ffast-math, fails here.
TEST(ExactSums, KeepWhatDoublesLose) {
  EXPECT_EQ(valueOf({1, 0x1p-60, -1}), 0x1p-60);
  EXPECT_EQ(valueOf({0x1p-60, 1, 0x1p-60, -1}), 0x1p-59);
  EXPECT_EQ(valueOf({1e30, 1, -1e30}), 1);
  EXPECT_EQ(valueOf({1, 0x1p-53, 0x1p-53}), 1 + 0x1p-52);
}

// Multiples of 2^-40 up to 2^30, of either sign: n |sum| is far below 2^106 q.
TEST(ExactSums, AreThoseOfIntegersInAnyOrder) {
  std::mt19937_64 random(1);
  std::vector<double> terms;
  Wide sum = 0;
  for (int i = 0; i < 20000; ++i) {
    const int bits = std::uniform_int_distribution(1, 53)(random);
    const auto k = static_cast<std::int64_t>(random() >> (64 - bits)) * (random() % 2 ? 1 : -1);
    const int shift = std::uniform_int_distribution(0, 70 - bits)(random);
    terms.push_back(std::ldexp(static_cast<double>(k), shift - 40));
    sum += static_cast<Wide>(k) << shift;
  }
  const double expected = std::ldexp(static_cast<double>(sum), -40);
  for (int order = 0; order < 20; ++order) {
    std::ranges::shuffle(terms, random);
    EXPECT_EQ(valueOf(terms), expected);
    // Cut into parts that are added up on their own.
    std::vector<ExactSums<1>> parts(1 + random() % 50);
    for (const double x : terms) parts[random() % parts.size()].add({x});
    ExactSums<1> all;
    for (const auto& part : parts) all += part;
    EXPECT_EQ(all.value(0), expected);
  }
}

TEST(ExactSums, StandSideBySide) {
  ExactSums<3> sums;
  sums.add({1, 2, 1e30});
  sums.add({0x1p-60, -2, 3});
  sums.add({-1, 0.5, -1e30});
  EXPECT_EQ(sums.value(0), 0x1p-60);
  EXPECT_EQ(sums.value(1), 0.5);
  EXPECT_EQ(sums.value(2), 3);
}

}  // namespace
}  // namespace pbrt
