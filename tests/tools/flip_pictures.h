#pragma once
// What FLIP is tested with.

#include <cstdint>

#include "core/base/image.h"

namespace pbrt::test {

// Pictures from integers alone, so that every machine makes the same ones.
inline std::uint32_t hash(std::uint32_t x) {  // Wellons 2018, "lowbias32"
  x = (x ^ (x >> 16)) * 0x7feb352dU;
  x = (x ^ (x >> 15)) * 0x846ca68bU;
  return x ^ (x >> 16);
}

// In [0, 1), with 16 bits.
inline float noise(int x, int y, int c, int seed) {
  return static_cast<float>(hash(hash(hash(hash(x) + y) + c) + seed) >> 16) / 65536;
}

// Over 1e-3 to 1e4.
inline float bright(int x, int y, int c, int seed) {
  const int exponent = static_cast<int>(hash(hash(x / 3) + y / 3 + 77 * seed) % 24) - 10;
  return std::ldexp(1 + noise(x, y, c, seed), exponent);
}

template <class F>
Image picture(int width, int height, F f) {
  Image image{{{0, 0}, {width, height}}, {width, height}, {"R", "G", "B"}, {{}, {}, {}}, {}};
  for (int c = 0; c < 3; ++c)
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) image.channels[c].push_back(f(x, y, c));
  return image;
}

inline Image constant(int width, int height, float r, float g, float b) {
  return picture(width, height, [=](int, int, int c) { return c == 0 ? r : c == 1 ? g : b; });
}

inline Image noisy(int width, int height, int seed, float scale = 1) {
  return picture(width, height,
                 [=](int x, int y, int c) { return scale * bright(x, y, c, seed) / 16; });
}

}  // namespace pbrt::test
