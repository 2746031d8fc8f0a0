// Both strategies, and both integrators, mean the same light.

#include "tests/scenes.h"

namespace pbrt {
namespace {

struct Estimate {
  double mean = 0, variance = 0;  // of the mean
};

// The light from the origin, by many one-sample pixels.
Estimate estimate(const std::string& integrator, const std::string& world, int side = 100) {
  const Image image = test::renderText(
      "LookAt 0 -2 2  0 0 0  0 0 1 Camera \"perspective\" \"float fov\" 0.001\n"
      "Film \"image\" \"integer xresolution\" " +
      std::to_string(side) + " \"integer yresolution\" " + std::to_string(side) +
      " PixelFilter \"box\" Sampler \"random\" \"integer pixelsamples\" 1\nIntegrator " +
      integrator + "\nWorldBegin\n" + world +
      "\nShape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] "
      "\"point P\" [-9 -9 0  9 -9 0  9 9 0  -9 9 0]\nWorldEnd");
  const std::vector<float>& values = *image.channel("G");
  Estimate e;
  const auto n = static_cast<double>(values.size());
  for (const float v : values) e.mean += v / n;
  for (const float v : values) e.variance += sqr(v - e.mean) / (n - 1) / n;
  return e;
}

void expectSame(const Estimate& a, const Estimate& b) {
  EXPECT_GT(a.mean, 0.01);
  EXPECT_LT(std::abs(a.mean - b.mean), 4.5 * std::sqrt(a.variance + b.variance))
      << a.mean << " and " << b.mean;
}

const std::string kLights =
    "LightSource \"point\" \"rgb I\" [2 2 2] \"point from\" [1 1 2]\n"
    "AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [3 3 3] \"integer nsamples\" 2\n"
    "Translate 0 2.5 2 Shape \"sphere\" \"float radius\" 1.2 AttributeEnd\n"
    "AttributeBegin AreaLightSource \"diffuse\" Translate 0 0 3 Rotate 180 1 0 0\n"
    "Shape \"disk\" \"float radius\" 2 AttributeEnd\n";

class SameMean : public testing::TestWithParam<std::string> {};

TEST_P(SameMean, ByAllLightsOneLightAndWhitted) {
  const std::string world = kLights + "Material " + GetParam();
  const Estimate all = estimate("\"directlighting\"", world);
  expectSame(all, estimate("\"directlighting\" \"string strategy\" \"one\"", world, 300));
  expectSame(all, estimate("\"whitted\"", world, 500));
}

// shinymetal has a specular lobe beside the glossy one: it is no part of the sampled density.
INSTANTIATE_TEST_SUITE_P(Materials, SameMean,
                         testing::Values("\"matte\" \"rgb Kd\" [0.5 0.5 0.5]",
                                         "\"plastic\" \"float roughness\" 0.3",
                                         "\"shinymetal\" \"float roughness\" 0.3"),
                         [](const auto& test) {
                           return test.param.substr(1, test.param.find('"', 1) - 1);
                         });

}  // namespace
}  // namespace pbrt
