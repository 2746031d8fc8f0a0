#pragma once
// What samplers are built from, as pure functions: keys for every (pixel, sample, dimension),
// permutations, and the (0,2)-sequence.

#include <bit>

#include "core/base/rng.h"

namespace pbrt {

// The random bits of one sample without a generator: dimension d has a key that all samples of
// the pixel share (it picks permutations and scrambles) and one of its own for every sample (it
// picks the place within a stratum). Both are streams of SplitMix64 (Steele et al. 2014).
class SampleKeys {
 public:
  explicit SampleKeys(std::uint64_t seed) : seed_(hash(seed)) {}

  void start(Point2i pixel, std::uint32_t index) {
    const auto x = static_cast<std::uint32_t>(pixel.x);
    const auto y = static_cast<std::uint32_t>(pixel.y);
    pixel_ = mixBits(seed_ ^ (std::uint64_t{y} << 32U | x));
    sample_ = mixBits(pixel_ ^ 0xd1342543de82ef95ULL * (index + std::uint64_t{1}));
  }
  void nextDimension() {
    pixel_ += kStep;
    sample_ += kStep;
  }
  std::uint64_t pixel() const { return mixBits(pixel_); }
  std::uint64_t sample() const { return mixBits(sample_); }

 private:
  static constexpr std::uint64_t kStep = 0x9e3779b97f4a7c15ULL;

  std::uint64_t seed_, pixel_ = 0, sample_ = 0;
};

// The two halves of a key as a point of the unit square.
constexpr Point2 uniformPoint(std::uint64_t key) {
  return {uniformFloat(static_cast<std::uint32_t>(key >> 32U)),
          uniformFloat(static_cast<std::uint32_t>(key))};
}

// floor(x n / 2^32): {0, ..., n - 1} from 32 random bits.
constexpr std::uint32_t scaleBits(std::uint32_t bits, std::uint32_t n) {
  return static_cast<std::uint32_t>(std::uint64_t{bits} * n >> 32U);
}

// Element i of a random permutation of {0, ..., n - 1}; i < n. A bijection of the next power of
// two is repeated until it lands below n (Kensler 2013, "Correlated Multi-Jittered Sampling",
// section 5); a last rotation makes every element equally likely in every place. Products carry
// bits up; that the step down differs from key to key makes up for how few bits there are: two
// elements go to any two places, nearly equally likely.
constexpr std::uint32_t permute(std::uint32_t i, std::uint32_t n, std::uint64_t key) {
  const int bits = std::bit_width(n - 1);
  const std::uint32_t mask = (1U << (bits & 31)) - 1U;
  const int shift = (bits + 1) / 2;
  do {
    std::uint64_t k = key;
    for (int round = 0; round < 3; ++round) {
      i = (i ^ static_cast<std::uint32_t>(k >> 32U)) * (static_cast<std::uint32_t>(k >> 40U) | 1U);
      i &= mask;
      i ^= i >> shift ^ (i >> 1U & static_cast<std::uint32_t>(k >> 50U));
      k = k * 0xd1342543de82ef95ULL + 0x9e3779b97f4a7c15ULL;
    }
  } while (i >= n);
  i += scaleBits(static_cast<std::uint32_t>(key * 0x9e3779b97f4a7c15ULL >> 32U), n);
  return i >= n ? i - n : i;
}

// Columns and rows of a grid of n cells, columns as near below rows as they can be: 1 by n if n is
// prime. n > 0.
inline Point2i squarest(std::uint32_t n) {
  auto columns = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(n)));
  while (n % columns != 0) --columns;
  return {columns, n / columns};
}

// The cells of a grid over the unit square, numbered row by row.
class Strata {
 public:
  explicit Strata(Point2i grid)
      : columns_(grid.x), inverse_(1.0 / grid.x), width_(1.F / grid.x), height_(1.F / grid.y) {}

  // The point at `offset`, a part of the cell's size, within cell i.
  Point2 point(std::uint32_t i, Point2 offset) const {
    // Half a cell is more than the rounding of the quotient, for every 32-bit i.
    const auto row = static_cast<int>((i + 0.5) * inverse_);
    const auto column = static_cast<int>(i) - row * columns_;
    const Point2 p((column + offset.x) * width_, (row + offset.y) * height_);
    return glm::min(p, Point2(kOneMinusEpsilon));
  }

 private:
  int columns_;
  double inverse_;
  float width_, height_;
};

constexpr std::uint32_t reverseBits(std::uint32_t v) {
  v = v << 16U | v >> 16U;
  v = (v & 0x00ff00ffU) << 8U | (v >> 8U & 0x00ff00ffU);
  v = (v & 0x0f0f0f0fU) << 4U | (v >> 4U & 0x0f0f0f0fU);
  v = (v & 0x33333333U) << 2U | (v >> 2U & 0x33333333U);
  return (v & 0x55555555U) << 1U | (v >> 1U & 0x55555555U);
}

// A random bijection in which a bit depends on itself and on lower bits only. Applied to a
// reversed sample index it shuffles every aligned block of 2^k indices within itself, and such
// blocks as wholes. Products with even and odd numbers do it (Laine and Karras 2011, "Stratified
// Sampling for Stochastic Transparency", section 3.1); their factors come from the key.
constexpr std::uint32_t nestedScramble(std::uint32_t v, std::uint64_t key) {
  v += static_cast<std::uint32_t>(key);
  v ^= v * (static_cast<std::uint32_t>(key >> 32U) & ~1U);
  v += static_cast<std::uint32_t>(key >> 17U);
  return v ^ v * 0x53a22864U;
}

// The second coordinate of a point of Sobol's (0,2)-sequence from its first, the radical inverse
// of the index in base 2; both as fractions of 2^32.
// Digit i of it is the sum over j of binomial(j, i) a_j mod 2, with a_j bit j of the index. By
// Lucas' theorem the coefficient is 1 exactly if the bits of i are a subset of those of j: a sum
// over supersets, which goes one bit of j at a time.
constexpr std::uint32_t sobolSecond(std::uint32_t v) {
  v ^= (v & 0x55555555U) << 1U;
  v ^= (v & 0x33333333U) << 2U;
  v ^= (v & 0x0f0f0f0fU) << 4U;
  v ^= (v & 0x00ff00ffU) << 8U;
  return v ^ v << 16U;
}

}  // namespace pbrt
