#include "core/base/sobol.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace pbrt {
namespace {

TEST(Sobol, FirstTwoDimensionsAreTheZeroTwoSequence) {
  for (std::uint32_t i = 0; i < 5000; ++i) {
    const std::uint32_t index = i * 858993u;
    ASSERT_EQ(sobol(index, 0), reverseBits(index));
    ASSERT_EQ(sobol(index, 1), sobolSecond(reverseBits(index)));
  }
}

// The elementary boxes with 2^shift[d] parts along dimension d, of which there are 2^k, hold the
// same number of points each.
bool evenlyShared(std::uint32_t first, int points, const std::array<int, 4>& shift) {
  int k = 0;
  for (const int s : shift) k += s;
  std::vector<int> counts(std::size_t{1} << k);
  for (std::uint32_t i = first; i < first + (1U << points); ++i) {
    std::uint32_t box = 0;
    for (std::size_t d = 0; d < 4; ++d)
      box = box << shift[d] |
            static_cast<std::uint32_t>(std::uint64_t{sobol(i, d)} >> (32 - shift[d]));
    ++counts[box];
  }
  return std::all_of(counts.begin(), counts.end(), [&](int c) { return c == 1 << (points - k); });
}

// A (t,4)-sequence with t the sum of the polynomials' degrees, each less one: 0 + 0 + 1 + 2 (Sobol
// 1967; Niederreiter 1988). One alone is a (0,1)-sequence.
TEST(Sobol, IsAsEvenAsItsPolynomialsAllow) {
  constexpr int points = 9, t = 3;
  for (const std::uint32_t first : {0U, 7U << points})
    for (int a = 0; a <= points; ++a)
      for (int b = 0; a + b <= points; ++b)
        for (int c = 0; a + b + c <= points; ++c)
          for (int d = 0; a + b + c + d <= points; ++d) {
            const bool alone = std::max({a, b, c, d}) == a + b + c + d;
            if (alone || a + b + c + d <= points - t) {
              ASSERT_TRUE(evenlyShared(first, points, {a, b, c, d})) << a << b << c << d;
            }
          }
}

// Sobol's property A (1976), which Joe and Kuo's numbers keep: of every 16 points from a multiple
// of 16, one in each sixteenth that halving all four sides gives.
TEST(Sobol, HalvesOfAllSidesAreShared) {
  for (std::uint32_t first = 0; first < 1600; first += 16)
    ASSERT_TRUE(evenlyShared(first, 4, {1, 1, 1, 1})) << first;
}

TEST(Randomize, KeepsWhatItSays) {
  const std::uint64_t key = hash(5);
  for (std::uint32_t i = 0; i < 1000; ++i) {
    const auto v = static_cast<std::uint32_t>(hash(i));
    EXPECT_EQ(randomize(v, Randomization::none, key), v);
    EXPECT_EQ(randomize(v, Randomization::permuteDigits, key) ^ v,
              randomize(0, Randomization::permuteDigits, key));
    // Digits before the first that differs stay together, that one stays apart.
    for (int bit = 0; bit < 32; ++bit) {
      const std::uint32_t difference = randomize(v, Randomization::owen, key) ^
                                       randomize(v ^ 1U << bit, Randomization::owen, key);
      EXPECT_EQ(difference >> bit, 1U);
    }
  }
}

// Owen's scrambling as he defines it, a random bit for each node of the tree of digits.
std::uint32_t owen(std::uint32_t v, std::uint64_t key) {
  std::uint32_t flips = 0;
  for (int bit = 31; bit >= 12; --bit)
    flips |= static_cast<std::uint32_t>(hash(std::uint64_t{v} >> (bit + 1), bit, key) & 1U) << bit;
  return v ^ flips ^ static_cast<std::uint32_t>(hash(v, key) & 0xfffU);
}

// What scrambling is for is the variance of estimates: of a smooth function and of an edge, by the
// first n points of the (0,2)-sequence. 20000 estimates know it to 1 %.
TEST(Randomize, VarianceIsThatOfOwensScrambling) {
  for (const std::uint32_t n : {4U, 8U, 16U}) {
    double smooth[2] = {}, edge[2] = {};
    for (std::uint64_t trial = 0; trial < 20000; ++trial)
      for (const int which : {0, 1}) {
        const std::uint64_t keyX = hash(trial, which, 0), keyY = hash(trial, which, 1);
        double s = 0, e = 0;
        for (std::uint32_t i = 0; i < n; ++i) {
          const std::uint32_t u = sobol(i, 0), v = sobol(i, 1);
          const float x =
              uniformFloat(which ? randomize(u, Randomization::owen, keyX) : owen(u, keyX));
          const float y =
              uniformFloat(which ? randomize(v, Randomization::owen, keyY) : owen(v, keyY));
          s += std::exp(-x) * y;
          e += x + y < 0.8F ? 1 : 0;
        }
        smooth[which] += sqr(s / n - (1 - std::exp(-1)) / 2);
        edge[which] += sqr(e / n - 0.32);
      }
    EXPECT_NEAR(smooth[1] / smooth[0], 1, 0.08) << n;
    EXPECT_NEAR(edge[1] / edge[0], 1, 0.08) << n;
  }
}

}  // namespace
}  // namespace pbrt
