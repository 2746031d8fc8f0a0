#pragma once
// Sobol's sequence in four dimensions, and ways to randomise points in base 2.

#include <array>

#include "core/base/lowdiscrepancy.h"

namespace pbrt {

enum class Randomization : std::uint8_t {
  none,
  permuteDigits,  // a digit goes through a permutation of its place: the same for all points
  owen            // the permutation depends on the digits before it (Owen 1995)
};

// A coordinate, as a fraction of 2^32, randomised by the bits of a key. nestedScramble() leaves no
// more variance than one random bit for each node of the tree of digits.
constexpr std::uint32_t randomize(std::uint32_t v, Randomization how, std::uint64_t key) {
  if (how == Randomization::none) return v;
  if (how == Randomization::permuteDigits) return v ^ static_cast<std::uint32_t>(key >> 32U);
  return reverseBits(nestedScramble(reverseBits(v), key));
}

constexpr std::size_t kSobolDimensions = 4;

// What every bit of the index adds to a coordinate, as fractions of 2^32: the direction numbers
// (Sobol 1967). They follow from a primitive polynomial over the field of two elements,
// x^s + a_1 x^(s-1) + ... + a_(s-1) x + 1, and s odd numbers m, here those of Joe and Kuo (2008,
// "Constructing Sobol Sequences with Better Two-Dimensional Projections"):
//   v_j = a_1 v_(j-1) ^ ... ^ a_(s-1) v_(j-s+1) ^ v_(j-s) ^ v_(j-s) / 2^s.
using SobolDirections = std::array<std::array<std::uint32_t, 32>, kSobolDimensions>;

constexpr SobolDirections makeSobolDirections() {
  struct Dimension {
    std::size_t s;
    std::uint32_t a;  // the bits a_1 ... a_(s-1)
    std::array<std::uint32_t, 3> m;
  };
  constexpr std::array<Dimension, kSobolDimensions - 1> further = {
      {{1, 0, {1}}, {2, 1, {1, 3}}, {3, 1, {1, 3, 1}}}};
  SobolDirections all{};
  for (std::size_t j = 0; j < 32; ++j) all[0][j] = 1U << (31 - j);
  for (std::size_t d = 1; d < kSobolDimensions; ++d) {
    const auto& [s, a, m] = further[d - 1];
    auto& v = all[d];
    for (std::size_t j = 0; j < s; ++j) v[j] = m[j] << (31 - j);
    for (std::size_t j = s; j < 32; ++j) {
      v[j] = v[j - s] ^ v[j - s] >> s;
      for (std::size_t k = 1; k < s; ++k)
        if (a >> (s - 1 - k) & 1U) v[j] ^= v[j - k];
    }
  }
  return all;
}

inline constexpr SobolDirections kSobolDirections = makeSobolDirections();

// Coordinate d < kSobolDimensions of a point, as a fraction of 2^32. The first two are the
// (0,2)-sequence of sobolSecond().
constexpr std::uint32_t sobol(std::uint32_t index, std::size_t d) {
  std::uint32_t x = 0;
  for (const std::uint32_t* v = kSobolDirections[d].data(); index > 0; ++v, index >>= 1U)
    x ^= *v & (0U - (index & 1U));
  return x;
}

}  // namespace pbrt
