#pragma once
// Scenes with media, and how they are looked at: along one line, many times.

#include "tests/integrators/estimate.h"

namespace pbrt::test {

// pbrt-v1 and v2: regions, and integrators for surfaces and volumes; "volpath" does both.
inline std::string regionScene(const std::string& volume, const std::string& world,
                               const std::string& surface = "\"path\"", int side = 100,
                               const std::string& view = "0 0 -5 0 0 0 0 1 0") {
  return fmt::format(
      "LookAt {} Camera \"perspective\" \"float fov\" 0.001\n"
      "Film \"image\" \"integer xresolution\" {} \"integer yresolution\" {}\n"
      "PixelFilter \"box\" Sampler \"random\" \"integer pixelsamples\" 1\n"
      "SurfaceIntegrator {}\n{}\nWorldBegin\n{}\nWorldEnd",
      view, side, side, surface, volume.empty() ? "" : "VolumeIntegrator " + volume, world);
}

// The mean of each channel, with its variance.
struct Colour {
  DVec3 mean{0}, error{0};
};

inline Colour measure(const std::string& text, BuildOptions options = {}) {
  const Image image = renderText(text, 0, std::move(options));
  Colour colour;
  constexpr std::array kNames = {"R", "G", "B"};
  for (int c = 0; c < 3; ++c) {
    const std::vector<float>& values = *image.channel(kNames[c]);
    const auto n = static_cast<double>(values.size());
    for (const float v : values) colour.mean[c] += v / n;
    for (const float v : values) colour.error[c] += sqr(v - colour.mean[c]) / (n - 1) / n;
    colour.error[c] = std::sqrt(colour.error[c]);
  }
  return colour;
}

// `relative`: of arithmetic in floats; `absolute`: what is too rare to be met.
inline void expectColour(const Colour& measured, const DVec3& expected, double relative = 2e-5,
                         double absolute = 1e-6) {
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(measured.mean[c], expected[c],
                kSigmas * measured.error[c] + relative * expected[c] + absolute)
        << "channel " << c;
}

}  // namespace pbrt::test
