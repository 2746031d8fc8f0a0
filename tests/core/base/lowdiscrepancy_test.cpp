#include "core/base/lowdiscrepancy.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/chi_square.h"

namespace pbrt {
namespace {

TEST(Permute, IsABijection) {
  for (std::uint32_t n = 1; n <= 130; ++n)
    for (std::uint64_t key = 0; key < 20; ++key) {
      std::set<std::uint32_t> images;
      for (std::uint32_t i = 0; i < n; ++i) images.insert(permute(i, n, mixBits(key)));
      ASSERT_EQ(images.size(), n);
      ASSERT_LT(*images.rbegin(), n);
    }
}

TEST(Permute, TakesEveryLengthOfIndexRange) {
  for (const std::uint32_t n : {1U << 20U, (1U << 20U) + 1, 0x7fffffffU, 0x80000000U})
    for (std::uint64_t key = 0; key < 100; ++key) EXPECT_LT(permute(n - 1, n, mixBits(key)), n);
}

TEST(Permute, SendsAnElementEverywhereAlike) {
  for (const std::uint32_t n : {2U, 3U, 4U, 9U, 16U, 25U, 100U})
    for (const std::uint32_t i : {0U, n / 2, n - 1}) {
      std::vector<double> counts(n);
      for (std::uint64_t key = 0; key < 100 * n; ++key) ++counts[permute(i, n, hash(key, 1))];
      EXPECT_LT(test::uniformDeviation(counts), 4) << i << " of " << n;
    }
}

// What the variance of an estimate depends on: where two elements go together.
TEST(Permute, SendsPairsEverywhereNearlyAlike) {
  for (const std::uint32_t n : {3U, 4U, 8U, 9U, 16U, 25U}) {
    double squares = 0, pairs = 0;
    constexpr double expected = 60;  // counts alone deviate by 0.13
    for (std::uint32_t i = 0; i < n; ++i)
      for (std::uint32_t j = i + 1; j < n; ++j) {
        std::vector<double> counts(std::size_t{n} * n);
        const auto trials = static_cast<std::uint64_t>(expected) * n * (n - 1);
        for (std::uint64_t t = 0; t < trials; ++t)
          ++counts[permute(i, n, hash(t, i, j)) * n + permute(j, n, hash(t, i, j))];
        for (std::uint32_t a = 0; a < n; ++a)
          for (std::uint32_t b = 0; b < n; ++b)
            if (a != b) {
              squares += sqr(counts[a * n + b] / expected - 1);
              ++pairs;
            }
      }
    EXPECT_LT(std::sqrt(squares / pairs), 0.17) << n;
  }
}

TEST(ReverseBits, MovesBitIToBit31MinusI) {
  for (std::uint32_t i = 0; i < 32; ++i) EXPECT_EQ(reverseBits(1U << i), 1U << (31 - i));
  EXPECT_EQ(reverseBits(reverseBits(0x12345678U)), 0x12345678U);
}

TEST(NestedScramble, KeepsLowBitsApartFromHighOnes) {
  Rng rng(3);
  for (int trial = 0; trial < 1000; ++trial) {
    const std::uint64_t key = hash(trial);
    const std::uint32_t v = rng.bits();
    for (int bit = 0; bit < 32; ++bit) {
      const std::uint32_t change = nestedScramble(v, key) ^ nestedScramble(v ^ 1U << bit, key);
      ASSERT_EQ(change & ((1U << bit) - 1U), 0U);     // lower bits do not notice
      ASSERT_EQ(change >> bit & 1U, 1U) << "a loss";  // the bit itself is flipped or kept
    }
  }
}

// Sobol's recurrence for the polynomial x + 1: direction numbers v_0 = 1/2, v_j = v_(j-1) ^
// v_(j-1) / 2 (Sobol' 1967; Bratley and Fox 1988).
TEST(SobolSecond, IsTheSequenceOfTheFirstPrimitivePolynomial) {
  Rng rng(4);
  for (int trial = 0; trial < 10000; ++trial) {
    const std::uint32_t index = trial < 5000 ? static_cast<std::uint32_t>(trial) : rng.bits();
    std::uint32_t expected = 0, direction = 0x80000000U;
    for (std::uint32_t rest = index; rest != 0; rest >>= 1U, direction ^= direction >> 1U)
      if (rest & 1U) expected ^= direction;
    ASSERT_EQ(sobolSecond(reverseBits(index)), expected) << index;
  }
}

TEST(SampleKeys, DifferBetweenSeedsPixelsSamplesAndDimensions) {
  std::set<std::uint64_t> keys;
  std::size_t count = 0;
  for (std::uint64_t seed = 0; seed < 4; ++seed)
    for (int x = -2; x < 6; ++x)
      for (int y = -2; y < 6; ++y)
        for (std::uint32_t index = 0; index < 8; ++index) {
          SampleKeys k(seed);
          k.start({x, y}, index);
          for (int d = 0; d < 8; ++d, ++count) {
            keys.insert(k.sample());
            k.nextDimension();
          }
        }
  EXPECT_EQ(keys.size(), count);
}

TEST(SampleKeys, PixelKeyIsSharedByTheSamplesOfAPixel) {
  SampleKeys a(7), b(7);
  a.start({3, 4}, 0);
  b.start({3, 4}, 99);
  EXPECT_EQ(a.pixel(), b.pixel());
  EXPECT_NE(a.sample(), b.sample());
}

}  // namespace
}  // namespace pbrt
