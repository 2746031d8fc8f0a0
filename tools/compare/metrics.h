#pragma once
// How far a picture is from a reference, in numbers.

#include <cstddef>
#include <string>

#include "core/base/image.h"

namespace pbrt {

// Over the N = 3 x pixels values of the linear channels R, G and B; I is the test, R the reference.
struct Errors {
  double mse = 0;     // mean of (I - R)^2
  double rmse = 0;    // its square root
  double relMse = 0;  // mean of (I - R)^2 / (R^2 + 0.01) without the floor(N / 1000) largest
  double mae = 0;     // mean of |I - R|
  double meanReference = 0, meanTest = 0;
  double largest = 0;       // of |I - R|
  Point2i largestPixel{0};  // where, in the picture's pixels: the first place in scanline order
};

// Values that are not finite make the results so. Throws Error, Failure::usage, unless both
// pictures have R, G and B over the same, not empty, window.
Errors measureErrors(const Image& reference, const Image& test);

// The mean of the terms without the largest floor(N / 1000) of them, unless one is not finite.
// There must be one.
double trimmedMean(std::vector<double> terms);

// The picture's pixel that stands at `index` of a channel.
inline Point2i pixelAt(const Image& image, std::size_t index) {
  const auto width = static_cast<std::size_t>(image.window.width());
  return image.window.lo +
         Point2i(static_cast<int>(index % width), static_cast<int>(index / width));
}

}  // namespace pbrt
