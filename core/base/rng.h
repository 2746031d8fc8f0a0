#pragma once
// Random bits as pure functions of their arguments: no generator is shared between threads.

#include <cstdint>

#include "core/base/math.h"

namespace pbrt {

// A bijection on 64 bits without visible structure (David Stafford 2011, mix 13).
constexpr std::uint64_t mixBits(std::uint64_t v) {
  v ^= v >> 30U;
  v *= 0xbf58476d1ce4e5b9ULL;
  v ^= v >> 27U;
  v *= 0x94d049bb133111ebULL;
  v ^= v >> 31U;
  return v;
}

// One hash of several values; the order counts.
template <class... T>
constexpr std::uint64_t hash(T... values) {
  std::uint64_t h = 0x9e3779b97f4a7c15ULL;
  ((h = mixBits(h ^ (static_cast<std::uint64_t>(values) + 0x9e3779b97f4a7c15ULL))), ...);
  return h;
}

// Uniform in [0, 1) from the upper 24 of 32 random bits.
constexpr float uniformFloat(std::uint32_t bits) {
  return static_cast<float>(bits >> 8U) * 0x1p-24F;
}

// PCG32 (O'Neill 2014), seeded by one hash.
class Rng {
 public:
  // mixBits(0) is 0, from which the first numbers would be 0 as well.
  explicit Rng(std::uint64_t seed = 0)
      : state_(mixBits(seed + 0x9e3779b97f4a7c15ULL)), increment_(seed << 1U | 1U) {}

  std::uint32_t bits() {
    const std::uint64_t old = state_;
    state_ = old * 0x5851f42d4c957f2dULL + increment_;
    const auto shifted = static_cast<std::uint32_t>(((old >> 18U) ^ old) >> 27U);
    const auto rotation = static_cast<std::uint32_t>(old >> 59U);
    return shifted >> rotation | shifted << (-rotation & 31U);
  }
  // Uniform in [0, 1).
  float uniform() { return uniformFloat(bits()); }
  // Uniform in {0, ..., n - 1}; the bias, below n / 2^32, is accepted.
  std::uint32_t uniform(std::uint32_t n) {
    return static_cast<std::uint32_t>((std::uint64_t{bits()} * n) >> 32U);
  }

 private:
  std::uint64_t state_;
  std::uint64_t increment_;
};

}  // namespace pbrt
