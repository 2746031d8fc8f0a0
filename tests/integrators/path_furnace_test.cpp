// Path tracing in a furnace, closed walls of reflectance 0.6 that all shine with radiance 1,
// against the series of its bounces.

#include "tests/integrators/estimate.h"

namespace pbrt {
namespace {

using namespace test;

const std::string kInside = "0.2 0.1 0.3  0.9 -0.4 -0.2  0 0 1";
constexpr double kRho = 0.6;

// One light; and six.
std::string ball() {
  return "Material \"matte\" \"rgb Kd\" [0.6 0.6 0.6]\n"
         "AreaLightSource \"diffuse\" ReverseOrientation Shape \"sphere\" \"float radius\" 1.5\n";
}
std::string box() {
  std::string world =
      "Material \"matte\" \"rgb Kd\" [0.6 0.6 0.6]\n"
      "AreaLightSource \"diffuse\" \"bool twosided\" \"true\"\n";
  for (const char* turn :
       {"0 1 0 0", "90 1 0 0", "180 1 0 0", "270 1 0 0", "90 0 1 0", "270 0 1 0"})
    world += fmt::format(
        "TransformBegin Rotate {} Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3]\n"
        "\"point P\" [-1.2 -1.2 1.2  1.2 -1.2 1.2  1.2 1.2 1.2  -1.2 1.2 1.2] TransformEnd\n",
        turn);
  return world;
}

class Furnace : public testing::TestWithParam<std::string> {
 protected:
  std::string world() const { return GetParam().starts_with("Ball") ? ball() : box(); }
  std::string integrator(int maxDepth, const std::string& more = "") const {
    return path(maxDepth, more + (GetParam().ends_with("Spatial") ? kSpatial : kUniform));
  }
};

TEST_P(Furnace, EveryBounceAddsItsTermOfTheSeries) {
  double expected = 0, term = 1;
  for (int maxDepth = 0; maxDepth <= 6; ++maxDepth, term *= kRho) {
    expected += term;
    SCOPED_TRACE(maxDepth);
    expectMean(estimate(kInside, integrator(maxDepth), world()), expected);
  }
}

// Here f cos = rho pb, with pb the density of the BSDF's sampling; pl is the lights'. So a bounce
// adds at most rho pb pl / (pb^2 + pl^2) <= rho / 2 by the sample of the light and rho pb^2 /
// (pb^2 + pl^2) <= rho by the other, and what goes on is rho times what came, for every path.
TEST_P(Furnace, NoPathCarriesMoreThanItsBound) {
  const Estimate e = estimate(kInside, integrator(100, "\"float rrthreshold\" 0 "), world(), 50);
  EXPECT_GE(e.least, 1);
  EXPECT_LE(e.most, (1 + 1.5 * kRho / (1 - kRho)) * (1 + 1e-4));
}

TEST_P(Furnace, RouletteKeepsTheMeanAndSavesRays) {
  const auto rays = [&](const std::string& threshold) {
    const std::string more = "\"float rrthreshold\" " + threshold + " ";
    const auto built = test::buildText(scene(kInside, integrator(60, more), world(), 10));
    RenderControl control;
    built->integrator().render(*built, built->sampler(), built->film(), control);
    return control.rays.load();
  };
  for (const char* threshold : {"0", "0.02", "1", "1000"}) {
    SCOPED_TRACE(threshold);
    const std::string more = fmt::format("\"float rrthreshold\" {} ", threshold);
    expectMean(estimate(kInside, integrator(60, more), world(), 60), 1 / (1 - kRho));
  }
  EXPECT_LT(4 * rays("1"), rays("0"));
  EXPECT_LT(rays("1"), rays("0.02"));
}

// Glass that absorbs nothing cannot be seen there; inside it radiance is denser by the square of
// its index.
TEST_P(Furnace, GlassCannotBeSeen) {
  const std::string glass =
      "AttributeBegin Material \"glass\" Translate 0.55 -0.15 0.05\n"
      "Shape \"sphere\" \"float radius\" 0.25 AttributeEnd\n";
  expectMean(estimate(kInside, integrator(60), glass + world()), 1 / (1 - kRho));
}

INSTANTIATE_TEST_SUITE_P(Lights, Furnace, testing::Values("Ball", "BoxSpatial", "BoxUniform"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace pbrt
