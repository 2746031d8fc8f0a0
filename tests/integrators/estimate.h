#pragma once
// The radiance that a scene sends to one point of view, with its standard error.

#include <fmt/format.h>

#include "tests/scenes.h"

namespace pbrt::test {

inline constexpr double kSigmas = 4.5;

// The radiance that one-sample pixels measure, which all look at the same point.
struct Estimate {
  double mean = 0, variance = 0;  // of one sample
  double least = kInfinity, most = 0;
  int samples = 0;

  double error() const { return std::sqrt(variance / samples); }
};

inline std::string scene(const std::string& view, const std::string& parameters,
                         const std::string& world, int side) {
  return fmt::format(
      "LookAt {} Camera \"perspective\" \"float fov\" 0.001\n"
      "Film \"image\" \"integer xresolution\" {} \"integer yresolution\" {}\n"
      "PixelFilter \"box\" Sampler \"random\" \"integer pixelsamples\" 1\n"
      "Integrator {}\nWorldBegin\n{}\nWorldEnd",
      view, side, side, parameters, world);
}

inline Estimate estimate(const std::string& view, const std::string& integrator,
                         const std::string& world, int side = 100) {
  const Image image = test::renderText(scene(view, integrator, world, side));
  const std::vector<float>& values = *image.channel("G");
  Estimate e;
  e.samples = side * side;
  for (const float v : values) {
    e.mean += v / static_cast<double>(e.samples);
    e.least = std::min(e.least, double{v});
    e.most = std::max(e.most, double{v});
  }
  for (const float v : values) e.variance += sqr(v - e.mean) / (e.samples - 1);
  return e;
}

// Within the estimate's own error, and that of arithmetic in floats.
inline void expectMean(const Estimate& e, double expected) {
  EXPECT_NEAR(e.mean, expected, kSigmas * e.error() + 1e-5 * expected);
}

inline void expectSame(const Estimate& a, const Estimate& b) {
  EXPECT_GT(a.mean, 0.01);
  EXPECT_NEAR(a.mean, b.mean, kSigmas * std::hypot(a.error(), b.error()));
}

inline std::string path(int maxDepth, const std::string& more = "") {
  return fmt::format("\"path\" \"integer maxdepth\" {} {}", maxDepth, more);
}

inline const std::string kUniform = "\"string lightsamplestrategy\" \"uniform\"";
inline const std::string kSpatial = "\"string lightsamplestrategy\" \"spatial\"";

}  // namespace pbrt::test
