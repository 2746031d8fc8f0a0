#pragma once
// Eight numbers at once, by the vector extension that g++ and clang share. The sums of a vector
// have one order, whatever the machine's registers: results are the same on every instruction set.

#include <cstdint>

// Code that uses lanes is compiled once for each instruction set (see loops.h), each time in a
// namespace of this name, lest the linker take one copy for another.
#ifndef PBRT_LANES
#define PBRT_LANES portable
#endif

namespace pbrt::metaballs {

inline constexpr int kLanes = 8;
typedef float Floats __attribute__((vector_size(kLanes * sizeof(float))));
typedef double Doubles __attribute__((vector_size(kLanes * sizeof(double))));

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

template <class V>
Lane<V> sum(V v) {
  return ((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7]));
}

}  // namespace PBRT_LANES
}  // namespace pbrt::metaballs
