#pragma once
// A scene whose noise is known: every sample is a toss of a coin.

#include <fmt/format.h>

#include <string>

namespace pbrt::test {

// `size` x `size` pixels, the left half of each shines with a radiance of `light`, the right half
// is black: n independent samples in a pixel have the mean light / 2 and the variance
// light^2 / 4 / n. Sampled at random, with 16 samples per pixel, unless `options` say otherwise.
inline std::string stripes(int size, double light = 1, const std::string& options = "") {
  std::string points, indices;
  const double width = 2.0 / size;
  for (int i = 0; i < size; ++i) {
    const double left = -1 + i * width, right = left + width / 2;
    points += fmt::format("{0} -1 1 {1} -1 1 {1} 1 1 {0} 1 1 ", left, right);
    indices += fmt::format("{0} {1} {2} {0} {2} {3} ", 4 * i, 4 * i + 1, 4 * i + 2, 4 * i + 3);
  }
  return fmt::format(R"(Camera "orthographic" "float screenwindow" [-1 1 -1 1]
Film "image" "integer xresolution" {0} "integer yresolution" {0} "string filename" "stripes.exr"
PixelFilter "box"
Sampler "random" "integer pixelsamples" 16
SurfaceIntegrator "whitted"
{4}
WorldBegin
AreaLightSource "diffuse" "rgb L" [{1} {1} {1}] "bool twosided" "true"
Shape "trianglemesh" "integer indices" [{2}] "point P" [{3}]
WorldEnd
)",
                     size, light, indices, points, options);
}

}  // namespace pbrt::test
