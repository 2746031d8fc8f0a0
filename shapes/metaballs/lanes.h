#pragma once
// Eight numbers at once, by the vector extension that g++ and clang share. Sums over the lanes have
// one order, whatever the machine's registers: results are the same on every instruction set.

#include <cmath>
#include <cstdint>
#include <type_traits>

// Code that uses lanes is compiled once for each instruction set (see loops.h), each time in a
// namespace of this name, lest the linker take one copy for another.
#ifndef PBRT_LANES
#define PBRT_LANES portable
#endif

namespace pbrt::metaballs {

inline constexpr int kLanes = 8;
using Floats __attribute__((vector_size(kLanes * sizeof(float)))) = float;
using Doubles __attribute__((vector_size(kLanes * sizeof(double)))) = double;

inline namespace PBRT_LANES {

// The number type of a vector, or of a number.
template <class V>
struct LaneOf {
  using Type = V;
};
template <>
struct LaneOf<Floats> {
  using Type = float;
};
template <>
struct LaneOf<Doubles> {
  using Type = double;
};
template <class V>
using Lane = typename LaneOf<V>::Type;

// All that follow take vectors or plain numbers.
template <class V>
V max(V a, V b) {
  return a > b ? a : b;
}
template <class V>
V min(V a, V b) {
  return a < b ? a : b;
}
template <class V>
V abs(V a) {
  return max(a, -a);
}
template <class V>
V positivePart(V a) {
  return max(a, V{});
}
template <class V>
V square(V a) {
  return a * a;
}

// Of lanes.
template <class V>
V squareRoot(V a) {
#ifdef __AVX__
  if constexpr (std::is_same_v<V, Floats>) return __builtin_ia32_sqrtps256(a);
#endif
  for (int i = 0; i < kLanes; ++i) a[i] = std::sqrt(a[i]);
  return a;
}

// Bit i tells whether a comparison held in lane i.
template <class Mask>
unsigned bits(Mask mask) {
#ifdef __AVX__
  if constexpr (sizeof(Mask) == 32)
    return static_cast<unsigned>(__builtin_ia32_movmskps256(reinterpret_cast<Floats>(mask)));
#endif
  unsigned all = 0;
  for (int i = 0; i < kLanes; ++i) all |= static_cast<unsigned>(mask[i] & 1) << i;
  return all;
}

// The sums of the lanes of each of eight vectors, as the lanes of one.
template <class V>
V sums(const V& a, const V& b, const V& c, const V& d, const V& e, const V& f, const V& g,
       const V& h) {
  const auto pairs = [](const V& x, const V& y) {
    return __builtin_shufflevector(x, y, 0, 8, 2, 10, 4, 12, 6, 14) +
           __builtin_shufflevector(x, y, 1, 9, 3, 11, 5, 13, 7, 15);
  };
  const auto fours = [](const V& x, const V& y) {
    return __builtin_shufflevector(x, y, 0, 1, 8, 9, 4, 5, 12, 13) +
           __builtin_shufflevector(x, y, 2, 3, 10, 11, 6, 7, 14, 15);
  };
  const V ad = fours(pairs(a, b), pairs(c, d)), eh = fours(pairs(e, f), pairs(g, h));
  return __builtin_shufflevector(ad, eh, 0, 1, 2, 3, 8, 9, 10, 11) +
         __builtin_shufflevector(ad, eh, 4, 5, 6, 7, 12, 13, 14, 15);
}

}  // namespace PBRT_LANES
}  // namespace pbrt::metaballs
