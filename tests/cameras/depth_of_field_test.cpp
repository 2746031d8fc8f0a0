// The blur of what is out of focus, in closed form.

#include <fmt/format.h>

#include "tests/scenes.h"

namespace pbrt {
namespace {

// The share of a disc of radius 1 that lies at x < c.
double discBelow(double c) {
  c = std::clamp(c, -1.0, 1.0);
  return 0.5 + (c * std::sqrt(1 - c * c) + std::asin(c)) / std::numbers::pi;
}

struct Blur {
  std::string camera;
  double z, focus, lens;  // depth of the edge, and of what is sharp; radius of the lens
};

// A bright half-plane with its edge at x = 0, depth z, seen by a camera at the origin. A ray of the
// pixel that shows x on the plane at depth f, from the point l of the lens, meets depth z at
// x(z) + l (1 - z / f), where x(z) is what the pinhole sees: x z for a perspective camera of 90
// degrees, x for an orthographic one. So the brightness is the share of the lens with
// l_x |1 - z / f| < x(z), averaged over the pixel.
TEST(DepthOfField, AnEdgeIsAsBlurredAsTheCircleOfConfusionIsWide) {
  constexpr int kSide = 64, kSamples = 16;
  for (const Blur& b : {Blur{"perspective", 2, 4, 0.5}, Blur{"perspective", 9, 3, 0.4},
                        Blur{"perspective", 5, 1e30, 2}, Blur{"perspective", 4, 1e-3, 1e-4},
                        Blur{"orthographic", 3, 2, 1}, Blur{"orthographic", 3, 5, 0.5},
                        Blur{"perspective", 3, 3, 1}, Blur{"perspective", 3, 5, 0}}) {
    const double far = 20;
    const Image image = test::renderText(fmt::format(
        "Scale -1 1 1 Camera \"{}\" {} \"float lensradius\" {} \"float "
        "focaldistance\" {}\n"
        "Film \"image\" \"integer xresolution\" {} \"integer yresolution\" {}\n"
        "PixelFilter \"box\" Sampler \"random\" \"integer pixelsamples\" {}\n"
        "Integrator \"whitted\" WorldBegin\n"
        "AreaLightSource \"diffuse\" \"bool twosided\" \"true\" Shape \"trianglemesh\"\n"
        "\"integer indices\" [0 1 2 0 2 3] \"point P\" [0 {} {}  {} {} {}  {} {} {}  0 {} {}]\n"
        "WorldEnd",
        b.camera, b.camera == "perspective" ? "\"float fov\" 90" : "", b.lens, b.focus, kSide,
        kSide, kSamples, -far, b.z, -far, -far, b.z, -far, far, b.z, far, b.z));
    const std::vector<float>& pixels = *image.channel("G");
    double sum = 0;
    for (int x = 0; x < kSide; ++x) {
      double mean = 0, expected = 0;
      for (int y = 0; y < kSide; ++y) mean += double{pixels[std::size_t(y * kSide + x)]} / kSide;
      constexpr int kFine = 200;
      for (int i = 0; i < kFine; ++i) {
        const double screen = 2 * (x + (i + 0.5) / kFine) / kSide - 1;
        const double seen = b.camera == "perspective" ? screen * b.z : screen;
        const double radius = b.lens * std::abs(1 - b.z / b.focus);
        expected += (radius > 0 ? discBelow(seen / radius) : seen > 0 ? 1 : 0) / kFine;
      }
      const double n = kSide * kSamples;
      expected = std::min(expected, 1.0);
      const double error = std::sqrt(expected * (1 - expected) / n);
      EXPECT_NEAR(mean, expected, 4.5 * error + 3 / n * (error > 0) + 1e-6)
          << b.camera << " z " << b.z << " focus " << b.focus << " column " << x;
      sum += mean;
    }
    EXPECT_NEAR(sum / kSide, 0.5, 0.01);
  }
}

}  // namespace
}  // namespace pbrt
