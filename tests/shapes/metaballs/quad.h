#pragma once
// 113-bit floats.

namespace pbrt::metaballs::test {

__extension__ typedef __float128 Quad;

inline Quad abs(Quad x) {
  return x < 0 ? -x : x;
}

// Taylor's series of x / 2^12, then squared twelve times: relative error below 1e-28.
inline Quad exp(Quad x) {
  static constexpr Quad reciprocal[] = {Quad(1) / 1, Quad(1) / 2, Quad(1) / 3, Quad(1) / 4,
                                        Quad(1) / 5, Quad(1) / 6, Quad(1) / 7, Quad(1) / 8};
  x *= Quad(1) / 4096;
  Quad sum = 1;
  for (int i = 7; i >= 0; --i) sum = 1 + x * sum * reciprocal[i];
  for (int i = 0; i < 12; ++i) sum *= sum;
  return sum;
}

}  // namespace pbrt::metaballs::test
