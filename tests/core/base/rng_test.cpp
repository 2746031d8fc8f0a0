#include "core/base/rng.h"

#include <gtest/gtest.h>

#include <bit>

#include "tests/chi_square.h"

namespace pbrt {
namespace {

TEST(MixBits, EveryInputBitFlipsHalfOfTheOutput) {
  Rng rng(3);
  for (int in = 0; in < 64; ++in) {
    std::vector<double> flips(64);
    const int rounds = 4000;
    for (int i = 0; i < rounds; ++i) {
      const std::uint64_t v = std::uint64_t{rng.bits()} << 32U | rng.bits();
      const std::uint64_t changed = mixBits(v) ^ mixBits(v ^ (std::uint64_t{1} << in));
      for (int out = 0; out < 64; ++out) flips[out] += static_cast<double>(changed >> out & 1U);
    }
    // Five standard deviations of a fair coin, and mix 13's own small bias.
    for (int out = 0; out < 64; ++out)
      EXPECT_NEAR(flips[out] / rounds, 0.5, 5 * 0.5 / std::sqrt(rounds) + 0.01)
          << "input bit " << in << ", output bit " << out;
  }
}

TEST(Hash, DependsOnEveryValueAndTheirOrder) {
  EXPECT_NE(hash(1, 2), hash(2, 1));
  EXPECT_NE(hash(1, 2), hash(1, 3));
  EXPECT_NE(hash(1, 2), hash(0, 2));
  EXPECT_NE(hash(1), hash(1, 0));
  EXPECT_NE(hash(0), hash(0, 0));
  static_assert(hash(1, 2) == hash(1, 2));
}

TEST(UniformFloat, CoversTheHalfOpenUnitInterval) {
  static_assert(uniformFloat(0) == 0);
  static_assert(uniformFloat(~0U) < 1);
  static_assert(uniformFloat(0x80000000U) == 0.5F);
}

// Cells of pairs of successive numbers, which also shows what single numbers would.
template <class Next>
double pairDeviation(int pairs, Next next) {
  std::vector<double> counts(256);
  for (int i = 0; i < pairs; ++i) {
    const auto [a, b] = next(i);
    counts[static_cast<std::size_t>(a * 16) * 16 + static_cast<std::size_t>(b * 16)] += 1;
  }
  return test::uniformDeviation(counts);
}

TEST(Rng, PairsOfOneSequenceAreUniform) {
  Rng rng(11);
  EXPECT_LT(pairDeviation(200000,
                          [&](int) {
                            const float a = rng.uniform();
                            return std::pair(a, rng.uniform());
                          }),
            4);
}

TEST(Rng, FirstNumbersOfNeighbouringSeedsAreUniform) {
  EXPECT_LT(pairDeviation(200000,
                          [](int seed) {
                            Rng rng(static_cast<std::uint64_t>(seed));
                            const float a = rng.uniform();
                            return std::pair(a, rng.uniform());
                          }),
            4);
  EXPECT_LT(pairDeviation(200000,
                          [](int seed) {
                            Rng a(static_cast<std::uint64_t>(seed));
                            Rng b(static_cast<std::uint64_t>(seed) + 1);
                            return std::pair(a.uniform(), b.uniform());
                          }),
            4);
}

TEST(Rng, NoSeedIsWeak) {
  for (const std::uint64_t seed : {std::uint64_t{0}, std::uint64_t{1}, ~std::uint64_t{0},
                                   std::uint64_t{1} << 63U, std::uint64_t{0x9e3779b97f4a7c15}}) {
    Rng rng(seed);
    int ones = 0;
    for (int i = 0; i < 8; ++i) ones += std::popcount(rng.bits());
    EXPECT_NEAR(ones, 128, 6 * 8) << seed;  // six standard deviations
    EXPECT_NE(Rng(seed).bits(), 0U) << seed;
  }
}

TEST(Rng, IntegersAreUniformAndBelowTheirBound) {
  Rng rng(5);
  std::vector<double> counts(7);
  for (int i = 0; i < 70000; ++i) {
    const std::uint32_t k = rng.uniform(7);
    ASSERT_LT(k, 7U);
    counts[k] += 1;
  }
  EXPECT_LT(test::uniformDeviation(counts), 4);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(rng.uniform(1), 0U);
}

TEST(Rng, SameSeedSameNumbers) {
  Rng a(9);
  Rng b(9);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(a.bits(), b.bits());
}

}  // namespace
}  // namespace pbrt
